// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.nio.file.Path;
import java.util.HashSet;
import java.util.Map;
import java.util.OptionalDouble;
import java.util.Set;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Thresholds;
import org.memtrack.detection.DetectorException;
import org.memtrack.run.TrackingSettings;
import org.memtrack.server.ServerSettings;
import org.memtrack.tracking.Association;
import org.memtrack.tracking.Interpolation;
import org.memtrack.tracking.SortSettings;
import org.memtrack.tracking.TrackFilter;
import org.memtrack.video.FilmOptions;
import org.memtrack.video.FrameAxis;

class TrackRequestTest {
    private static final TrackingSettings DEFAULTS =
            new TrackingSettings(DetectionSettings.DEFAULTS, SortSettings.DEFAULTS, ServerSettings.DEFAULTS, true);

    @Test
    void whatIsLeftOutHasTheDefaultOfEachComponent() {
        TrackRequest request = of("output=/out");
        assertThat(request.settings()).isEqualTo(DEFAULTS);
        assertThat(request.film()).isEqualTo(FilmOptions.DEFAULTS);
        assertThat(request.output()).isEqualTo(Path.of("/out"));
        assertThat(request.overlay()).isTrue();
    }

    @Test
    void everyOptionReachesItsSetting() {
        TrackRequest request = of("output=/out preset=water criterion=[Maximum F1] model=mine model_version=2"
                + " pixel_size=0.25 frame_interval=0.0167 cell_length=8.5 stabilise=false resting=true overlay=false frames=z channel=2"
                + " first_frame=3 last_frame=40 threshold_low=0.1 threshold_medium=0.2 threshold_high=0.3 max_size=33"
                + " nms_iou=0.6 min_length_sure=20 min_score=0.25 max_age=24 min_hits=4 iou_gate=0.07 association=overlap interpolation=authors"
                + " second_look=false python=/p/python server=host:1");
        assertThat(request.film())
                .isEqualTo(new FilmOptions(FrameAxis.Z, 2, 3, 40, OptionalDouble.of(0.25), OptionalDouble.of(0.0167)));
        assertThat(request.settings().detection().model()).isEqualTo("mine");
        assertThat(request.settings().detection().modelVersion()).isEqualTo("2");
        assertThat(request.settings().detection().criterion()).isEqualTo(Criterion.MAXIMUM_F1);
        assertThat(request.settings().detection().thresholds()).isEqualTo(new Thresholds(0.1, 0.2, 0.3));
        assertThat(request.settings().detection().maxSizePx()).isEqualTo(33);
        assertThat(request.settings().detection().nmsIou()).isEqualTo(0.6);
        assertThat(request.settings().detection().stabilise()).isFalse();
        assertThat(request.settings().detection().resting()).isTrue();
        assertThat(request.settings().detection().cellLengthPx()).isEqualTo(8.5);
        assertThat(request.settings().tracking())
                .isEqualTo(new SortSettings(
                        Association.OVERLAP, 0.07, 24, 4, Interpolation.AUTHORS, false, new TrackFilter(30, 20, 0.25)));
        assertThat(request.settings().secondLook()).isFalse();
        assertThat(request.settings().server().address()).isEqualTo("host:1");
        assertThat(request.settings().server().python()).hasFileName("python");
        assertThat(request.overlay()).isFalse();
    }

    @Test
    void noOverlapAtAllMayBeAskedFor() {
        assertThat(of("output=/out nms_iou=0").settings().detection().nmsIou()).isZero();
    }

    @Test
    void pathsMayStandInQuotes() {
        TrackRequest request = of("output=[\"/my films/out\"] python=\"/p/python\"");
        assertThat(request.output()).isEqualTo(Path.of("/my films/out"));
        assertThat(request.settings().server().python()).isEqualTo(Path.of("/p/python"));
    }

    @Test
    void faintCellsAreLookedForUnlessTheUserGivesThresholds() {
        assertThat(of("output=/out").settings().secondLook()).isTrue();
        assertThat(of("output=/out second_look=false").settings().secondLook()).isFalse();
        assertThat(of("output=/out threshold_low=0.5 threshold_medium=0.5 threshold_high=0.5")
                        .settings()
                        .secondLook())
                .isFalse();
        assertThat(of("output=/out smooth=false").settings().tracking().smooth())
                .isFalse();
        assertThat(of("output=/out interpolation=authors").settings().tracking().smooth())
                .isFalse();
        assertThat(of("output=/out interpolation=authors").settings().secondLook())
                .isFalse();
    }

    @Test
    void whereTheSecondLookIsOffByItselfTheUserIsToldWhy() {
        String thresholds = "output=/out threshold_low=0.5 threshold_medium=0.5 threshold_high=0.5";
        assertThat(of(thresholds).warningsFor(120))
                .containsExactly("Look again for faint cells (second_look) is off, as thresholds are given.");
        assertThat(of("output=/out interpolation=authors").warningsFor(120))
                .containsExactly(
                        "Look again for faint cells (second_look) is off, as Interpolation (interpolation) is authors.");
        assertThat(of(thresholds + " second_look=false").warningsFor(120)).isEmpty();
        assertThat(of("output=/out").warningsFor(120)).isEmpty();
    }

    @Test
    void aShortFilmKeepsTracksOfHalfItsLengthUnlessTheUserSaysOtherwise() {
        assertThat(of("output=/out").settingsFor(120)).isEqualTo(DEFAULTS);
        assertThat(of("output=/out").settingsFor(119).tracking().filter()).isEqualTo(new TrackFilter(59, 15, 0.3));
        assertThat(of("output=/out min_length_sure=7")
                        .settingsFor(60)
                        .tracking()
                        .filter())
                .isEqualTo(new TrackFilter(30, 7, 0.3));
        assertThat(of("output=/out preset=water")
                        .settingsFor(1)
                        .tracking()
                        .filter()
                        .minimumLength())
                .isEqualTo(1);
        assertThat(of("output=/out min_length=60")
                        .settingsFor(61)
                        .tracking()
                        .filter()
                        .minimumLength())
                .isEqualTo(60);
    }

    @Test
    void thatTheFilmIsShortIsTold() {
        assertThat(of("output=/out").warningsFor(119))
                .containsExactly(
                        "The film is short: tracks of 59 frames are kept, not only those of 60; Least track length (min_length) sets another length.");
        assertThat(of("output=/out min_length=60").warningsFor(119)).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "output=/out",
                "output=/out preset=water min_length=12",
                "output=/out min_length_sure=7 second_look=false",
                "output=/out threshold_low=0.5 threshold_medium=0.5 threshold_high=0.5"
            })
    void theOptionsInForceSayAllOfTheSettingsForAFilmOfAnyLength(String line) {
        for (int frames : new int[] {1, 50, 120, 1000}) {
            TrackRequest request = of(line);
            Map<String, String> inForce = request.optionsFor(frames);
            assertThat(inForce).containsKeys("min_length", "min_length_sure", "second_look", "smooth");
            TrackRequest again = of(OptionLine.format(inForce));
            assertThat(again.settingsFor(frames)).isEqualTo(request.settingsFor(frames));
            assertThat(again.warningsFor(frames)).isEmpty();
        }
    }

    @Test
    void theOptionsOfARequestRepeatIt() {
        TrackRequest request = of("output=[/a b/c] preset=water min_length=12 threshold_low=0.1 threshold_medium=0.2"
                + " threshold_high=0.3 stabilise=false");
        assertThat(of(OptionLine.format(request.options()))).isEqualTo(request);
    }

    @Test
    void theLeastLengthGoesBeforeThePreset() {
        assertThat(of("output=/out preset=collagen min_length=12")
                        .settings()
                        .tracking()
                        .filter())
                .isEqualTo(new TrackFilter(12, 12, 0.3));
        assertThat(of("output=/out min_length=12 min_length_sure=8 min_score=0")
                        .settings()
                        .tracking()
                        .filter())
                .isEqualTo(new TrackFilter(12, 8, 0));
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    model=x                       | output=
                    output=out                    | The output folder "out" would lie wherever Fiji was started: give its whole path
                    output=../out                 | give its whole path, as in /films/tracks or C:/films/tracks.
                    output=/o thresold=1           | "thresold" is no option
                    output=/o criterion=best       | [maximum precision] or [maximum F1]
                    output=/o preset=agar          | collagen or water
                    output=/o stabilise=maybe      | true or false
                    output=/o max_age=2.5          | a whole number
                    output=/o pixel_size=0,25      | Pixel size (pixel_size) cannot be "0,25": give a number, with a point and not a comma
                    output=/o pixel_size=-1        | pixel size must be a positive number
                    output=/o pixel_size=NaN       | pixel size must be a positive number
                    output=/o iou_gate=1           | IoU gate
                    output=/o min_length=0         | minimum track length
                    output=/o min_length_sure=0    | length of sure tracks
                    output=/o min_score=1.5        | track score must lie in 0 to 1, not 1.5
                    output=/o nms_iou=2            | overlap
                    output=/o nms_iou=NaN          | overlap
                    output=/o threshold_low=0.5    | give all three, Threshold, low level (threshold_low),
                    output=/o threshold_low=2 threshold_medium=1 threshold_high=1 | low level must lie in 0 to 1, not 2.0
                    output=/o channel=0            | counted from 1
                    output=/o first_frame=9 last_frame=3 | 9 to 3
                    output=/o model=../secret      | name
                    output=/o cell_length=0.9      | cell length must lie in 1 to 200 pixels, not 0.9
                    output=/o cell_length=201      | cell length must lie in 1 to 200 pixels, not 201.0
                    output=/o cell_length=NaN      | not NaN
                    """)
    void aWrongValueIsOneSentenceWithTheValue(String line, String expected) {
        assertThatThrownBy(() -> of(line))
                .isInstanceOf(DetectorException.class)
                .hasMessageContaining(expected)
                .message()
                .endsWith(".")
                .doesNotContain("\n");
    }

    @Test
    void everyChoiceStandsForWhatItSays() {
        assertThat(TrackOption.PRESET.meaning("collagen")).hasValue(SortSettings.COLLAGEN);
        assertThat(TrackOption.PRESET.meaning("Water")).hasValue(SortSettings.WATER);
        assertThat(TrackOption.CRITERION.meaning("maximum precision")).hasValue(Criterion.MAXIMUM_PRECISION);
        assertThat(TrackOption.FRAMES.meaning("z")).hasValue(FrameAxis.Z);
        assertThat(TrackOption.ASSOCIATION.meaning("motion")).hasValue(Association.MOTION);
        assertThat(TrackOption.INTERPOLATION.meaning("fill gaps")).hasValue(Interpolation.FILL_GAPS);
        assertThat(TrackOption.INTERPOLATION.meaning("fill")).isEmpty();
    }

    @Test
    void keysAreUniqueAndHelpIsThere() {
        Set<String> keys = new HashSet<>();
        for (TrackOption option : TrackOption.values()) {
            assertThat(keys.add(option.key())).isTrue();
            assertThat(option.help()).isNotBlank();
            for (TrackOption other : TrackOption.values()) {
                // What the dialog does not show is named as it does show it, too.
                String rest = option.help().replace(other.bothNames(), "");
                assertThat(rest.contains(other.key()) && other.key().contains("_"))
                        .as("%s in the help of %s", other.key(), option.key())
                        .isFalse();
            }
            assertThat(option.kind() == TrackOption.Kind.CHOICE)
                    .isEqualTo(!option.choices().isEmpty());
        }
    }

    private static TrackRequest of(String line) {
        return TrackRequest.of(OptionLine.parse(line));
    }
}
