// SPDX-License-Identifier: GPL-3.0-or-later
// Detects and tracks one film with MEMTrack inside TrackMate, and saves a TrackMate file. In Fiji: open it in the script editor, or
//   fiji --headless --run memtrack_in_trackmate.groovy 'film="film.tif",output="film.xml",pixelSize=0.2475,frameInterval=0.0167'
#@ File film
#@ File output
#@ Double(label = "Pixel size (um); 0: the film's own", value = 0) pixelSize
#@ Double(label = "Frame interval (s); 0: the film's own", value = 0) frameInterval

import fiji.plugin.trackmate.Logger
import fiji.plugin.trackmate.Settings
import fiji.plugin.trackmate.TrackMate
import fiji.plugin.trackmate.io.TmXmlWriter
import ij.IJ
import org.memtrack.trackmate.MemtrackDetectorFactory
import org.memtrack.trackmate.MemtrackTrackerFactory

def image = IJ.openImage(film.absolutePath)
if (image == null) throw new IOException("ImageJ cannot open " + film)
if (image.NFrames == 1) image.setDimensions(image.NChannels, 1, image.NSlices) // frames that were opened as slices
if (pixelSize > 0) {
    image.calibration.pixelWidth = pixelSize
    image.calibration.pixelHeight = pixelSize
    image.calibration.setUnit("um")
}
if (frameInterval > 0) {
    image.calibration.frameInterval = frameInterval
    image.calibration.setTimeUnit("sec")
}

def settings = new Settings(image)
settings.detectorFactory = new MemtrackDetectorFactory()
settings.detectorSettings = settings.detectorFactory.defaultSettings
settings.detectorSettings.THRESHOLDS = "MAXIMUM_F1" // or MAXIMUM_PRECISION, or GIVEN with THRESHOLD_LOW, _MEDIUM and _HIGH
settings.trackerFactory = new MemtrackTrackerFactory()
settings.trackerSettings = settings.trackerFactory.defaultSettings
settings.trackerSettings.MINIMUM_TRACK_LENGTH = 30 // frames; the command has 60 in collagen and 30 in water, at most half of the film
settings.addAllAnalyzers()

def trackmate = new TrackMate(settings)
trackmate.model.logger = Logger.DEFAULT_LOGGER
if (!trackmate.checkInput() || !trackmate.process()) throw new RuntimeException(trackmate.errorMessage)

def writer = new TmXmlWriter(output)
writer.appendModel(trackmate.model)
writer.appendSettings(settings)
writer.writeToFile()
println "${trackmate.model.trackModel.nTracks(true)} tracks in ${output}"
