// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import fiji.plugin.trackmate.action.TrackMateAction;
import fiji.plugin.trackmate.action.TrackMateActionFactory;
import ij.gui.Plot;
import ij.measure.ResultsTable;
import java.util.Arrays;
import java.util.DoubleSummaryStatistics;
import java.util.OptionalDouble;
import java.util.stream.Collectors;
import javax.swing.ImageIcon;
import org.jspecify.annotations.Nullable;
import org.memtrack.motility.MotilityClass;
import org.memtrack.motility.TrackMotility;
import org.memtrack.tracking.Track;
import org.memtrack.tracking.TrackPoint;
import org.scijava.plugin.Plugin;

/** Shows how the visible tracks move: a table, speeds and classes of motility. */
final class MotilityAction extends ModelAction {
    /** Offers the action to TrackMate. */
    @Plugin(type = TrackMateActionFactory.class)
    public static final class Factory implements TrackMateActionFactory {
        @Override
        public TrackMateAction create() {
            return new MotilityAction();
        }

        @Override
        public String getKey() {
            return "MEMTRACK_MOTILITY";
        }

        @Override
        public String getName() {
            return "Motility analysis (MEMTrack)";
        }

        @Override
        public String getInfoText() {
            return "<html>Speeds, diffusivity and class of motility (none, low, medium, high) of every visible track, as a"
                    + " table and as plots. The film needs a pixel size and a frame interval for more than speeds in pixels per"
                    + " frame: set them in Image > Properties. Interpolated spots are left out.</html>";
        }

        @Override
        public @Nullable ImageIcon getIcon() {
            return MemtrackIcon.SMALL;
        }
    }

    @Override
    void act(ModelTracks tracks) {
        table(tracks).show("Motility of " + tracks.info().title());
        speeds(tracks).show();
        if (tracks.info().calibrated()) {
            classes(tracks).show();
        }
        say("Motility of %d tracks.".formatted(tracks.names().size()));
    }

    static ResultsTable table(ModelTracks tracks) {
        ResultsTable table = new ResultsTable();
        table.setPrecision(4);
        for (int i = 0; i < tracks.names().size(); i++) {
            Track track = tracks.tracked().tracks().get(i);
            TrackMotility motility = tracks.tracked().motility().get(i);
            table.addRow();
            table.addValue("Track", tracks.names().get(i));
            table.addValue("First frame", track.firstFrame());
            table.addValue("Frames", track.length());
            table.addValue(
                    "Interpolated",
                    track.points().stream().filter(TrackPoint::interpolated).count());
            add(table, "Speed (px/frame)", motility.meanSpeedPixelsPerFrame());
            add(table, "Speed (um/s)", motility.meanSpeed());
            add(table, "Lag speed (px/frame)", motility.lagSpeedPixelsPerFrame());
            add(table, "Lag speed (um/s)", motility.lagSpeed());
            add(table, "Peak diffusivity (um^2/s)", motility.peakDiffusivity());
            table.addValue(
                    "Motility",
                    motility.motilityClass().map(MotilityAction::nameOf).orElse(""));
        }
        return table;
    }

    private static void add(ResultsTable table, String column, OptionalDouble value) {
        table.addValue(column, value.orElse(Double.NaN));
    }

    /** Histogram of the speeds over the lag, which errors of position spoil less than those from frame to frame. */
    static Plot speeds(ModelTracks tracks) {
        boolean calibrated = tracks.info().calibrated();
        double[] speeds = tracks.tracked().motility().stream()
                .map(calibrated ? TrackMotility::lagSpeed : TrackMotility::lagSpeedPixelsPerFrame)
                .flatMapToDouble(OptionalDouble::stream)
                .toArray();
        Plot plot = new Plot(
                "Speeds in " + tracks.info().title(),
                "speed over %s (%s)".formatted(tracks.tracked().speedLag(), calibrated ? "um/s" : "px/frame"),
                "tracks");
        plot.setColor("black", "lightgray");
        addHistogram(plot, speeds);
        return plot;
    }

    /**
     * The axis of counts begins at 0, and speeds that are all alike are one bar: ImageJ alone would draw neither these nor
     * bars of one height.
     */
    private static void addHistogram(Plot plot, double[] speeds) {
        DoubleSummaryStatistics range = Arrays.stream(speeds).summaryStatistics();
        if (range.getCount() == 0) {
            plot.setLimits(0, 1, 0, 1);
            return;
        }
        double width = range.getMax() > 0 ? range.getMax() / 10 : 1;
        if (range.getMax() - range.getMin() < width / 100) {
            plot.addHistogram(speeds, width, range.getMin());
            plot.setLimits(range.getMin() - width, range.getMin() + width, 0, Double.NaN);
        } else {
            plot.addHistogram(speeds);
            plot.setLimits(Double.NaN, Double.NaN, 0, Double.NaN);
        }
    }

    static Plot classes(ModelTracks tracks) {
        MotilityClass[] classes = MotilityClass.values();
        double[] shares = new double[classes.length];
        for (TrackMotility track : tracks.tracked().motility()) {
            track.motilityClass()
                    .ifPresent(motilityClass -> shares[motilityClass.ordinal()] +=
                            1.0 / tracks.tracked().motility().size());
        }
        // ImageJ takes what stands in braces for names, one below each whole number.
        String names = "{%s}"
                .formatted(Arrays.stream(classes).map(MotilityAction::nameOf).collect(Collectors.joining(",")));
        Plot plot = new Plot("Motility in " + tracks.info().title(), names, "share of the tracks");
        plot.setFormatFlags(Plot.getDefaultFlags() & ~(Plot.X_TICKS | Plot.X_MINOR_TICKS | Plot.X_GRID));
        plot.setColor("black", "lightgray");
        plot.add("separated bar", new double[] {0, 1, 2, 3}, shares);
        plot.setLimits(-0.5, classes.length - 0.5, 0, 1);
        return plot;
    }

    private static String nameOf(MotilityClass motilityClass) {
        return motilityClass.name().toLowerCase(java.util.Locale.ROOT);
    }
}
