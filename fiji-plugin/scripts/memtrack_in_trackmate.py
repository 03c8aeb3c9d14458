# SPDX-License-Identifier: GPL-3.0-or-later
# Detects and tracks one film with MEMTrack inside TrackMate, and saves a TrackMate file. Jython. In Fiji: open it in the script editor, or
#   fiji --headless --run memtrack_in_trackmate.py 'film="film.tif",output="film.xml",pixelSize=0.2475,frameInterval=0.0167'
#@ File film
#@ File output
#@ Double(label = "Pixel size (um); 0: the film's own", value = 0) pixelSize
#@ Double(label = "Frame interval (s); 0: the film's own", value = 0) frameInterval

from fiji.plugin.trackmate import Logger, Settings, TrackMate
from fiji.plugin.trackmate.io import TmXmlWriter
from ij import IJ
from org.memtrack.trackmate import MemtrackDetectorFactory, MemtrackTrackerFactory

image = IJ.openImage(film.getAbsolutePath())
if image is None:
    raise IOError("ImageJ cannot open " + str(film))
if image.getNFrames() == 1:  # frames that were opened as slices
    image.setDimensions(image.getNChannels(), 1, image.getNSlices())
if pixelSize > 0:
    image.getCalibration().pixelWidth = pixelSize
    image.getCalibration().pixelHeight = pixelSize
    image.getCalibration().setUnit("um")
if frameInterval > 0:
    image.getCalibration().frameInterval = frameInterval
    image.getCalibration().setTimeUnit("sec")

settings = Settings(image)
settings.detectorFactory = MemtrackDetectorFactory()
detector_settings = settings.detectorFactory.getDefaultSettings()
detector_settings["THRESHOLDS"] = "MAXIMUM_F1"  # or MAXIMUM_PRECISION, or GIVEN with THRESHOLD_LOW, _MEDIUM and _HIGH
settings.detectorSettings = detector_settings
settings.trackerFactory = MemtrackTrackerFactory()
tracker_settings = settings.trackerFactory.getDefaultSettings()
tracker_settings["MINIMUM_TRACK_LENGTH"] = 30  # frames; the command has 60 in collagen and 30 in water, at most half of the film
settings.trackerSettings = tracker_settings
settings.addAllAnalyzers()

trackmate = TrackMate(settings)
trackmate.getModel().setLogger(Logger.DEFAULT_LOGGER)
if not trackmate.checkInput() or not trackmate.process():
    raise RuntimeError(trackmate.getErrorMessage())

writer = TmXmlWriter(output)
writer.appendModel(trackmate.getModel())
writer.appendSettings(settings)
writer.writeToFile()
print("%d tracks in %s" % (trackmate.getModel().getTrackModel().nTracks(True), output))
