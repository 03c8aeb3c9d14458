// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import static org.assertj.core.api.Assertions.assertThat;
import static org.memtrack.client.ScriptedServer.accepted;
import static org.memtrack.client.ScriptedServer.frame;
import static org.memtrack.client.ScriptedServer.progress;
import static org.memtrack.client.ScriptedServer.summary;

import io.grpc.stub.StreamObserver;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.List;
import java.util.OptionalDouble;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Test;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.Level;
import org.memtrack.v1.Criterion;
import org.memtrack.v1.DetectFilmResponse;
import org.memtrack.v1.FilmHeader;
import org.memtrack.v1.PixelType;
import org.memtrack.video.RegionMask;
import org.memtrack.video.SampleType;

class DetectionClientTest {
    private static final SyntheticFilm FILM = new SyntheticFilm(7, 5, 4, SampleType.UINT16);

    @Test
    void everySampleArrivesInOrderAndEveryAnswerComesBack() throws Exception {
        try (ScriptedServer server = new ScriptedServer(DetectionClientTest::answerFourFrames)) {
            DetectionResult result = server.client().detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE);

            assertThat(server.received.toByteArray()).isEqualTo(allSamples(FILM));
            assertThat(server.chunkFrames).containsExactly(0, 1, 2, 3);
            assertThat(result.frames()).extracting(f -> f.detections().size()).containsExactly(0, 1, 2, 3);
            assertThat(result.frames().get(2).detections().get(1))
                    .isEqualTo(new Detection(new Box(1, 11, 21, 41), 0.75, Level.MEDIUM, -0.5, 0.25));
            assertThat(result.frames().get(2).faint())
                    .containsExactly(new Detection(new Box(50, 60, 80, 90), 0.125, Level.LOW));
            assertThat(result.frames().get(3).driftY()).isEqualTo(-0.5);
            assertThat(result.accepted())
                    .isEqualTo(new ModelInUse(
                            "collagen",
                            "1.2.3",
                            "abc",
                            new Thresholds(0.5, 0.6, 0.7),
                            1.5,
                            "some engine",
                            List.of("A warning.")));
            assertThat(result.warnings()).containsExactly("A warning.", "2 of 3 frames are dark.");
            assertThat(result.summary().nearMisses()).isEqualTo(20);
            assertThat(result.summary().describe(result.accepted().thresholds()))
                    .isEqualTo("72 detections above 0.50 (low), 0.60 (medium), 0.70 (high);"
                            + " 20 weaker boxes, down to 0.20 and several on each cell, are not among them");
        }
    }

    @Test
    void theModelThatTakesOverInACrowdIsTheOneInUse() throws Exception {
        try (ScriptedServer server = new ScriptedServer(responses -> {
            responses.onNext(accepted());
            DetectFilmResponse.Builder crowd = accepted().toBuilder();
            crowd.getAcceptedBuilder()
                    .setModelName("crowded")
                    .getThresholdsBuilder()
                    .setLow(0.25);
            responses.onNext(crowd.build());
            answerFrames(responses, 4);
        })) {
            DetectionResult result = server.client().detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE);

            assertThat(result.accepted().name()).isEqualTo("crowded");
            assertThat(result.accepted().thresholds().low()).isEqualTo(0.25);
            assertThat(result.warnings()).containsExactly("A warning.", "2 of 3 frames are dark.");
        }
    }

    @Test
    void theHeaderSaysAllThatWasSetAndLeavesOutWhatWasNot() throws Exception {
        BitSet inside = new BitSet();
        inside.set(0);
        inside.set(9);
        DetectionSettings all = new DetectionSettings(
                "mine",
                "2.0.0",
                org.memtrack.client.Criterion.MAXIMUM_F1,
                new Thresholds(0.1, 0.2, 0.3),
                33.0,
                0.6,
                false,
                true,
                8.0,
                new RegionMask(7, 5, inside));
        try (ScriptedServer server = new ScriptedServer(DetectionClientTest::answerFourFrames)) {
            server.client().detect(FILM, all, Progress.NONE);
            server.client().detect(FILM, DetectionSettings.DEFAULTS, Progress.NONE);

            FilmHeader full = server.headers.get(0);
            assertThat(full.getProtocol()).isEqualTo(1);
            assertThat(List.of(full.getWidth(), full.getHeight(), full.getFrameCount()))
                    .containsExactly(7, 5, 4);
            assertThat(full.getPixelType()).isEqualTo(PixelType.PIXEL_TYPE_UINT16);
            assertThat(full.getPixelSizeUm()).isEqualTo(0.25);
            assertThat(full.getFrameIntervalSeconds()).isEqualTo(0.016);
            assertThat(full.getModelName() + " " + full.getModelVersion()).isEqualTo("mine 2.0.0");
            assertThat(full.getCriterion()).isEqualTo(Criterion.CRITERION_MAX_F1);
            assertThat(full.getThresholds().getMedium()).isEqualTo(0.2);
            assertThat(full.getMaxSizePx()).isEqualTo(33);
            assertThat(full.getNmsIou()).isEqualTo(0.6);
            assertThat(full.getNoStabilisation()).isTrue();
            assertThat(full.getResting()).isTrue();
            assertThat(full.getCellLengthPx()).isEqualTo(8);
            // Bits 0 and 9 of 35, most significant bit first.
            assertThat(full.getRegion().getMask().toByteArray()).containsExactly(0x80, 0x40, 0, 0, 0);

            FilmHeader plain = server.headers.get(1);
            assertThat(plain.hasThresholds() || plain.hasMaxSizePx() || plain.hasNmsIou())
                    .isFalse();
            assertThat(plain.hasCellLengthPx() || plain.hasRegion()).isFalse();
            assertThat(plain.getNoStabilisation() || plain.getResting()).isFalse();
        }
    }

    @Test
    void aLargeFrameTravelsInChunksOfAtMostOneMebibyte() throws Exception {
        SyntheticFilm large = new SyntheticFilm(700, 900, 4, SampleType.FLOAT32);
        try (ScriptedServer server = new ScriptedServer(DetectionClientTest::answerFourFrames)) {
            server.client().detect(large, DetectionSettings.DEFAULTS, Progress.NONE);

            assertThat(server.chunkFrames).startsWith(0, 0, 0, 0, 0, 1).hasSize(20);
            assertThat(server.chunkSizes).allMatch(size -> size <= 1 << 20);
            assertThat(server.received.toByteArray()).isEqualTo(allSamples(large));
        }
    }

    @Test
    void progressTellsStageFractionAndTimeLeft() throws Exception {
        List<String> said = new ArrayList<>();
        CountDownLatch heard = new CountDownLatch(1);
        Progress progress = new Progress() {
            @Override
            public void report(String stage, double fraction, OptionalDouble secondsLeft, String message) {
                said.add("%s %s %s %s".formatted(stage, fraction, secondsLeft.orElse(-1), message));
                heard.countDown();
            }

            @Override
            public boolean cancelled() {
                return false;
            }
        };
        try (ScriptedServer server = new ScriptedServer(responses -> {
            responses.onNext(accepted());
            responses.onNext(progress(0.5));
            await(heard);
            answerFrames(responses, 4);
        })) {
            server.client().detect(FILM, DetectionSettings.DEFAULTS, progress.between(0.5, 1));
        }
        assertThat(said).containsExactly("Detecting 0.75 12.5 frame 3 of 4");
    }

    static void answerFourFrames(StreamObserver<DetectFilmResponse> responses) {
        responses.onNext(accepted());
        answerFrames(responses, 4);
    }

    private static void answerFrames(StreamObserver<DetectFilmResponse> responses, int frameCount) {
        for (int i = 0; i < frameCount; i++) {
            responses.onNext(frame(i));
        }
        responses.onNext(summary(frameCount));
        responses.onCompleted();
    }

    private static void await(CountDownLatch heard) {
        try {
            // The client passes over a standing when the end has come.
            assertThat(heard.await(10, TimeUnit.SECONDS)).isTrue();
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    private static byte[] allSamples(SyntheticFilm film) throws IOException {
        ByteArrayOutputStream all = new ByteArrayOutputStream();
        for (int i = 0; i < film.info().frameCount(); i++) {
            all.write(film.frame(i));
        }
        return all.toByteArray();
    }
}
