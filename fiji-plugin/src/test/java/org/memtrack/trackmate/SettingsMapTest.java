// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import org.jdom2.Element;
import org.junit.jupiter.api.Test;

class SettingsMapTest {
    private static final Map<String, Object> DEFAULTS = new LinkedHashMap<>();

    static {
        DEFAULTS.put("TEXT", "a \"quoted\" <text>");
        DEFAULTS.put("EMPTY", "");
        DEFAULTS.put("WHOLE", 7);
        DEFAULTS.put("NUMBER", 0.1 + 0.2);
        DEFAULTS.put("SWITCH", true);
    }

    private static final SettingsMap MAP = new SettingsMap("test module", DEFAULTS);

    private static Element element(String key, String value) {
        return new Element("TrackerSettings").setAttribute(key, value);
    }

    @Test
    void whatIsMarshalledIsUnmarshalledEqual() {
        Map<String, Object> settings = MAP.defaults();
        settings.put("WHOLE", -3);
        settings.put("SWITCH", false);
        Element element = element("TRACKER_NAME", "KEY");
        assertThat(MAP.marshal(settings, element)).isNull();
        Map<String, Object> read = new HashMap<>(Map.of("OF_ANOTHER_MODULE", 1));
        assertThat(MAP.unmarshal(element, read)).isNull();
        assertThat(read).isEqualTo(settings);
    }

    @Test
    void aMissingAttributeHasItsDefault() {
        Map<String, Object> read = new HashMap<>();
        assertThat(MAP.unmarshal(element("WHOLE", "9"), read)).isNull();
        assertThat(read)
                .containsEntry("WHOLE", 9)
                .containsEntry("TEXT", DEFAULTS.get("TEXT"))
                .hasSize(5);
    }

    @Test
    void anUnknownOrUnreadableAttributeIsRefusedAndNothingIsChanged() {
        Map<String, Object> read = new HashMap<>(Map.of("KEPT", 1));
        assertThat(MAP.unmarshal(element("NEWER", "9"), read)).contains("NEWER", "update MEMTrack");
        assertThat(MAP.unmarshal(element("WHOLE", "9.5"), read)).contains("WHOLE", "a whole number", "\"9.5\"");
        assertThat(MAP.unmarshal(element("NUMBER", "much"), read)).contains("NUMBER", "a number", "\"much\"");
        assertThat(MAP.unmarshal(element("SWITCH", "yes"), read)).contains("SWITCH", "true or false", "\"yes\"");
        assertThat(read).isEqualTo(Map.of("KEPT", 1));
    }

    @Test
    void theCheckNamesTheSettingAndItsValue() {
        assertThat(MAP.check(MAP.defaults())).isNull();
        assertThat(MAP.check(null)).contains("no settings");
        Map<String, Object> wrong = MAP.defaults();
        wrong.put("WHOLE", 7.0);
        assertThat(MAP.check(wrong)).contains("WHOLE", "a whole number", "7.0");
        Map<String, Object> missing = MAP.defaults();
        missing.put("NUMBER", null);
        assertThat(MAP.check(missing)).contains("NUMBER", "null");
        Map<String, Object> more = MAP.defaults();
        more.put("MORE", 1);
        assertThat(MAP.check(more)).contains("MORE").contains("TEXT, EMPTY");
    }

    @Test
    void callersCannotChangeTheDefaults() {
        MAP.defaults().put("WHOLE", 8);
        assertThat(MAP.defaults()).isEqualTo(DEFAULTS);
    }
}
