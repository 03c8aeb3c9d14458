// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.macro;

import java.util.EnumMap;
import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;
import java.util.OptionalDouble;
import java.util.OptionalInt;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.memtrack.detection.DetectorException;

/** Values of all options of "MEMTrack Track", checked one by one; what is not given has its default. */
final class OptionValues {
    private final Map<TrackOption, String> values = new EnumMap<>(TrackOption.class);

    /** @throws DetectorException when there is no such option */
    OptionValues(Map<String, String> given) {
        for (TrackOption option : TrackOption.values()) {
            values.put(option, option.defaultValue());
        }
        given.forEach((key, value) -> values.put(TrackOption.of(key).orElseThrow(() -> unknown(key)), value.strip()));
    }

    /** Every option that has a value, by its key. */
    Map<String, String> asMap() {
        Map<String, String> map = new LinkedHashMap<>();
        values.forEach((option, value) -> {
            if (!value.isEmpty()) {
                map.put(option.key(), value);
            }
        });
        return map;
    }

    String text(TrackOption option) {
        return values.getOrDefault(option, "");
    }

    boolean given(TrackOption option) {
        return !text(option).isEmpty();
    }

    OptionalDouble number(TrackOption option) {
        if (!given(option)) {
            return OptionalDouble.empty();
        }
        try {
            return OptionalDouble.of(Double.parseDouble(text(option)));
        } catch (NumberFormatException e) {
            throw wrong(option, "a number, with a point and not a comma");
        }
    }

    OptionalInt integer(TrackOption option) {
        if (!given(option)) {
            return OptionalInt.empty();
        }
        try {
            return OptionalInt.of(Integer.parseInt(text(option)));
        } catch (NumberFormatException e) {
            throw wrong(option, "a whole number");
        }
    }

    boolean flag(TrackOption option) {
        return switch (text(option).toLowerCase(Locale.ROOT)) {
            case "true" -> true;
            case "false" -> false;
            default -> throw wrong(option, "true or false");
        };
    }

    /** What the option's choice stands for. */
    <T> T choice(TrackOption option, Class<T> type) {
        return option.meaning(text(option))
                .map(type::cast)
                .orElseThrow(() -> wrong(
                        option,
                        option.choices().stream()
                                .map(choice -> choice.contains(" ") ? "[" + choice + "]" : choice)
                                .collect(Collectors.joining(" or "))));
    }

    DetectorException wrong(TrackOption option, String expected) {
        return new DetectorException(
                "%s cannot be \"%s\": give %s.".formatted(option.bothNames(), text(option), expected));
    }

    private static DetectorException unknown(String key) {
        return new DetectorException("\"%s\" is no option of MEMTrack Track: the options are %s."
                .formatted(
                        key,
                        Stream.of(TrackOption.values()).map(TrackOption::key).collect(Collectors.joining(", "))));
    }
}
