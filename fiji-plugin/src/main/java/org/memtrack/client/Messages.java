// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.client;

import com.google.protobuf.ByteString;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.memtrack.detection.Box;
import org.memtrack.detection.Detection;
import org.memtrack.detection.FrameDetections;
import org.memtrack.detection.Level;
import org.memtrack.v1.Accepted;
import org.memtrack.v1.FilmHeader;
import org.memtrack.v1.GetServerInfoResponse;
import org.memtrack.v1.LevelThresholds;
import org.memtrack.v1.PixelType;
import org.memtrack.v1.RegionOfInterest;
import org.memtrack.v1.Stage;
import org.memtrack.v1.StageTime;
import org.memtrack.v1.Summary;
import org.memtrack.video.Film;
import org.memtrack.video.FilmInfo;
import org.memtrack.video.RegionMask;
import org.memtrack.video.SampleType;

/** Translates between our values and the messages of the contract. */
final class Messages {
    private Messages() {}

    static FilmHeader header(Film film, DetectionSettings settings) {
        FilmInfo info = film.info();
        FilmHeader.Builder header = FilmHeader.newBuilder()
                .setProtocol(DetectionClient.PROTOCOL)
                .setWidth(info.width())
                .setHeight(info.height())
                .setFrameCount(info.frameCount())
                .setPixelType(pixelType(film.sampleType()))
                .setModelName(settings.model())
                .setModelVersion(settings.modelVersion())
                .setCriterion(criterion(settings.criterion()))
                .setNoStabilisation(!settings.stabilise())
                .setResting(settings.resting());
        info.pixelSizeMicrometres().ifPresent(header::setPixelSizeUm);
        info.frameIntervalSeconds().ifPresent(header::setFrameIntervalSeconds);
        if (settings.cellLengthPx() != null) {
            header.setCellLengthPx(settings.cellLengthPx());
        }
        if (settings.thresholds() != null) {
            header.setThresholds(thresholds(settings.thresholds()));
        }
        if (settings.maxSizePx() != null) {
            header.setMaxSizePx(settings.maxSizePx());
        }
        if (settings.nmsIou() != null) {
            header.setNmsIou(settings.nmsIou());
        }
        if (settings.region() != null) {
            header.setRegion(region(settings.region()));
        }
        return header.build();
    }

    static FrameDetections frame(org.memtrack.v1.FrameDetections message) {
        return new FrameDetections(
                message.getFrame(),
                detections(message.getDetectionsList()),
                message.getDriftX(),
                message.getDriftY(),
                detections(message.getFaintList()));
    }

    private static List<Detection> detections(List<org.memtrack.v1.Detection> messages) {
        List<Detection> detections = new ArrayList<>(messages.size());
        for (org.memtrack.v1.Detection detection : messages) {
            Box box = new Box(detection.getXMin(), detection.getYMin(), detection.getXMax(), detection.getYMax());
            double contrast = detection.hasContrast() ? detection.getContrast() : Double.NaN;
            double error = detection.hasError() ? detection.getError() : Double.NaN;
            detections.add(new Detection(box, detection.getScore(), level(detection.getLevel()), contrast, error));
        }
        return detections;
    }

    static ModelInUse model(Accepted message) {
        return new ModelInUse(
                message.getModelName(),
                message.getModelVersion(),
                message.getModelSha256(),
                thresholds(message.getThresholds()),
                message.getScale(),
                message.getEngine(),
                message.getWarningsList());
    }

    static DetectionSummary summary(Summary message) {
        Map<String, Double> seconds = new LinkedHashMap<>();
        for (StageTime time : message.getStageTimesList()) {
            seconds.merge(stage(time.getStage()), time.getSeconds(), Double::sum);
        }
        return new DetectionSummary(
                message.getFrameCount(),
                message.getCandidates(),
                message.getTooLarge(),
                message.getNearMisses(),
                message.getOverlapping(),
                message.getOutsideRegion(),
                message.getKept(),
                message.getCandidateFloor(),
                message.getFilmSha256(),
                seconds,
                message.getWarningsList());
    }

    static ServerInfo info(GetServerInfoResponse message) {
        return new ServerInfo(
                message.getProtocol(),
                message.getVersion(),
                message.getPythonVersion(),
                Map.copyOf(message.getLibrariesMap()),
                List.copyOf(message.getDevicesList()),
                message.getMaxFilmBytes(),
                message.getSpoolFreeBytes());
    }

    static ModelCard card(org.memtrack.v1.ModelCard message) {
        return new ModelCard(message.getName(), message.getVersion(), message.getDescription(), message.getSha256());
    }

    /** Name of a stage for the user. */
    static String stage(Stage stage) {
        return switch (stage) {
            case STAGE_RECEIVING -> "Sending the film";
            case STAGE_STABILISING -> "Stabilising";
            case STAGE_BACKGROUND -> "Background";
            case STAGE_DETECTING -> "Detecting";
            case STAGE_UNSPECIFIED, UNRECOGNIZED -> "Working";
        };
    }

    private static PixelType pixelType(SampleType type) {
        return switch (type) {
            case UINT8 -> PixelType.PIXEL_TYPE_UINT8;
            case UINT16 -> PixelType.PIXEL_TYPE_UINT16;
            case FLOAT32 -> PixelType.PIXEL_TYPE_FLOAT32;
        };
    }

    private static org.memtrack.v1.Criterion criterion(Criterion criterion) {
        return switch (criterion) {
            case MAXIMUM_PRECISION -> org.memtrack.v1.Criterion.CRITERION_MAX_PRECISION;
            case MAXIMUM_F1 -> org.memtrack.v1.Criterion.CRITERION_MAX_F1;
        };
    }

    private static Level level(org.memtrack.v1.Level level) {
        return switch (level) {
            case LEVEL_LOW -> Level.LOW;
            case LEVEL_MEDIUM -> Level.MEDIUM;
            case LEVEL_HIGH -> Level.HIGH;
            case LEVEL_UNSPECIFIED, UNRECOGNIZED -> Level.UNSPECIFIED;
        };
    }

    private static Thresholds thresholds(LevelThresholds message) {
        return new Thresholds(message.getLow(), message.getMedium(), message.getHigh());
    }

    private static LevelThresholds thresholds(Thresholds thresholds) {
        return LevelThresholds.newBuilder()
                .setLow(thresholds.low())
                .setMedium(thresholds.medium())
                .setHigh(thresholds.high())
                .build();
    }

    private static RegionOfInterest region(RegionMask region) {
        byte[] mask = new byte[(region.width() * region.height() + 7) / 8];
        region.inside().stream().forEach(bit -> mask[bit / 8] |= (byte) (0x80 >> bit % 8));
        return RegionOfInterest.newBuilder().setMask(ByteString.copyFrom(mask)).build();
    }
}
