// SPDX-License-Identifier: GPL-3.0-or-later
package fiji.plugin.trackmate;

import fiji.plugin.trackmate.detection.SpotDetectorFactoryBase;
import fiji.plugin.trackmate.tracking.SpotTrackerFactory;
import ij.ImagePlus;
import ij.gui.Roi;
import java.util.Map;

public class Settings {
    public final ImagePlus imp;
    public double dt;
    public double dx;
    public double dy;
    public int tstart;
    public int tend;
    public SpotDetectorFactoryBase<?> detectorFactory;
    public SpotTrackerFactory trackerFactory;
    public Map<String, Object> detectorSettings;
    public Map<String, Object> trackerSettings;

    public Settings(ImagePlus image) {
        imp = image;
        throw new UnsupportedOperationException();
    }

    public void setRoi(Roi roi) {
        throw new UnsupportedOperationException();
    }

    public void addAllAnalyzers() {
        throw new UnsupportedOperationException();
    }
}
