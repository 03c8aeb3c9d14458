// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import java.util.LinkedHashMap;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.memtrack.detection.DetectorException;

class OptionLineTest {
    @Test
    void valuesMayHoldSpacesBracketsAndEqualSigns() {
        assertThat(OptionLine.parse("  output=[/a b/[1]/c=d] model=x  overlay criterion=[maximum F1] "))
                .containsExactly(
                        Map.entry("output", "/a b/[1]/c=d"),
                        Map.entry("model", "x"),
                        Map.entry("overlay", "true"),
                        Map.entry("criterion", "maximum F1"));
        assertThat(OptionLine.parse(" ")).isEmpty();
        assertThat(OptionLine.parse("python=")).containsExactly(Map.entry("python", ""));
    }

    @Test
    void whatIsFormattedIsParsedAgain() {
        Map<String, String> options = new LinkedHashMap<>();
        options.put("output", "C:/Users/Jörg Müller/[films] 细菌");
        options.put("criterion", "maximum precision");
        options.put("max_age", "25");
        options.put("python", "");

        String line = OptionLine.format(options);

        options.remove("python");
        assertThat(OptionLine.parse(line)).isEqualTo(options);
    }

    @ParameterizedTest
    @ValueSource(strings = {"output=[/a b", "output=/my films/out", "model=a model=b", "=x", "output=[a]b]"})
    void whatCannotBeReadIsOneSentence(String line) {
        assertThatThrownBy(() -> OptionLine.parse(line))
                .isInstanceOf(DetectorException.class)
                .message()
                .isNotBlank()
                .doesNotContain("\n");
    }
}
