// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.HashMap;
import java.util.Map;
import org.jdom2.Element;
import org.junit.jupiter.api.Test;
import org.memtrack.client.Criterion;
import org.memtrack.client.DetectionSettings;
import org.memtrack.client.Thresholds;

class DetectorSettingsTest {
    private static Map<String, Object> others() {
        Map<String, Object> map = DetectorSettings.MAP.defaults();
        map.put("MODEL", "water");
        map.put("MODEL_VERSION", "2");
        map.put("THRESHOLDS", "GIVEN");
        map.put("THRESHOLD_LOW", 0.1);
        map.put("THRESHOLD_MEDIUM", 0.2);
        map.put("THRESHOLD_HIGH", 0.3);
        map.put("TARGET_CHANNEL", 2);
        map.put("CELL_LENGTH_PX", 9.5);
        map.put("MAXIMUM_SIZE_PX", 40.0);
        map.put("NMS_IOU", 0.6);
        map.put("STABILISE", false);
        map.put("RESTING", true);
        return map;
    }

    @Test
    void defaultsAreTheDefaultsOfDetection() {
        assertThat(DetectorSettings.check(DetectorSettings.MAP.defaults())).isNull();
        assertThat(DetectorSettings.fromMap(DetectorSettings.MAP.defaults())).isEqualTo(DetectionSettings.DEFAULTS);
        assertThat(DetectorSettings.channel(DetectorSettings.MAP.defaults())).isZero();
    }

    @Test
    void everySettingArrives() {
        assertThat(DetectorSettings.fromMap(others()))
                .isEqualTo(new DetectionSettings(
                        "water",
                        "2",
                        Criterion.MAXIMUM_PRECISION,
                        new Thresholds(0.1, 0.2, 0.3),
                        40.0,
                        0.6,
                        false,
                        true,
                        9.5,
                        null));
        assertThat(DetectorSettings.channel(others())).isEqualTo(1);
        Map<String, Object> f1 = others();
        f1.put("THRESHOLDS", "MAXIMUM_F1");
        assertThat(DetectorSettings.fromMap(f1).criterion()).isEqualTo(Criterion.MAXIMUM_F1);
        assertThat(DetectorSettings.fromMap(f1).thresholds()).isNull();
    }

    @Test
    void settingsSurviveXml() {
        Element element = new Element("DetectorSettings").setAttribute("DETECTOR_NAME", "MEMTRACK_DETECTOR");
        assertThat(DetectorSettings.MAP.marshal(others(), element)).isNull();
        Map<String, Object> read = new HashMap<>();
        assertThat(DetectorSettings.MAP.unmarshal(element, read)).isNull();
        assertThat(read).isEqualTo(others());
    }

    @Test
    void valuesOutOfRangeAreNamedInOneSentence() {
        Map<String, Object> map = others();
        map.put("THRESHOLD_HIGH", 1.5);
        assertThat(DetectorSettings.check(map)).contains("high level", "1.5");
        map = others();
        map.put("TARGET_CHANNEL", 0);
        assertThat(DetectorSettings.check(map)).isEqualTo("Channels are counted from 1, not 0.");
        map = others();
        map.put("MODEL", "../secret");
        assertThat(DetectorSettings.check(map)).contains("../secret");
        map = others();
        map.put("THRESHOLDS", "SOME");
        assertThat(DetectorSettings.check(map)).contains("MAXIMUM_PRECISION or MAXIMUM_F1 or GIVEN", "SOME");
        assertThat(DetectorSettings.check(null)).contains("no settings");
    }
}
