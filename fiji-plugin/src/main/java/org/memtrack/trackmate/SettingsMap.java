// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.function.Consumer;
import java.util.stream.Collectors;
import org.jdom2.Attribute;
import org.jdom2.Element;
import org.jspecify.annotations.Nullable;

/**
 * The flat map of settings that TrackMate keeps for a module, and its attributes in a TrackMate file.
 *
 * <p>Files outlive us: a setting that a file does not hold, because an older version wrote it, has its default. One that
 * is not known is refused, since what it asks for would silently not happen.
 */
final class SettingsMap {
    /** What TrackMate itself writes beside a module's settings. */
    private static final Set<String> NAMES_OF_MODULES = Set.of("DETECTOR_NAME", "TRACKER_NAME");

    private final String module;
    private final Map<String, Object> defaults;

    /**
     * Settings of a module.
     *
     * @param module its name, for messages
     * @param defaults every setting with its default: String, Integer, Double or Boolean
     */
    SettingsMap(String module, Map<String, Object> defaults) {
        this.module = module;
        this.defaults = new LinkedHashMap<>(defaults);
    }

    /** A new map of the defaults, which the caller may change. */
    Map<String, Object> defaults() {
        return new LinkedHashMap<>(defaults);
    }

    /** One sentence when the map is not made of these settings, each of its type; null when it is. */
    @Nullable
    String check(@Nullable Map<String, Object> settings) {
        if (settings == null) {
            return "The %s has no settings: take its defaults.".formatted(module);
        }
        for (Map.Entry<String, Object> setting : defaults.entrySet()) {
            Object value = settings.get(setting.getKey());
            Class<?> type = setting.getValue().getClass();
            if (!type.isInstance(value)) {
                return "The setting %s of the %s must be %s, not %s."
                        .formatted(setting.getKey(), module, nameOf(type), value);
            }
        }
        for (String key : settings.keySet()) {
            if (!defaults.containsKey(key)) {
                return "The %s has no setting %s: remove it, or choose one of %s."
                        .formatted(module, key, String.join(", ", defaults.keySet()));
            }
        }
        return null;
    }

    /** The same, and one sentence when their values cannot be converted. */
    @Nullable
    String check(@Nullable Map<String, Object> settings, Consumer<Map<String, Object>> conversion) {
        String problem = check(settings);
        if (problem != null || settings == null) {
            return problem;
        }
        try {
            conversion.accept(settings);
            return null;
        } catch (IllegalArgumentException e) {
            return e.getMessage() + ".";
        }
    }

    /** The constant that a setting names, in whatever case. */
    static <E extends Enum<E>> E choice(Class<E> type, String key, Map<String, Object> map) {
        String name = String.valueOf(map.get(key));
        try {
            return Enum.valueOf(type, name.trim().toUpperCase(Locale.ROOT));
        } catch (IllegalArgumentException e) {
            throw new IllegalArgumentException(
                    "The setting %s must be %s, not \"%s\"".formatted(key, names(type), name), e);
        }
    }

    private static <E extends Enum<E>> String names(Class<E> type) {
        return Arrays.stream(type.getEnumConstants()).map(Enum::name).collect(Collectors.joining(" or "));
    }

    /** Writes the settings as attributes; one sentence when they are not these settings, else null. */
    @Nullable
    String marshal(Map<String, Object> settings, Element element) {
        String problem = check(settings);
        if (problem == null) {
            defaults.keySet()
                    .forEach(key -> element.setAttribute(key, settings.get(key).toString()));
        }
        return problem;
    }

    /** Replaces the settings by those of the attributes; one sentence when one cannot be read, else null. */
    @Nullable
    String unmarshal(Element element, Map<String, Object> settings) {
        Map<String, Object> read = defaults();
        for (Attribute attribute : element.getAttributes()) {
            String key = attribute.getName();
            if (NAMES_OF_MODULES.contains(key)) {
                continue;
            }
            Object byDefault = defaults.get(key);
            if (byDefault == null) {
                return "The file has a setting %s that this version of the %s does not know: update MEMTrack."
                        .formatted(key, module);
            }
            Object value = parse(attribute.getValue(), byDefault.getClass());
            if (value == null) {
                return "The file's setting %s of the %s must be %s, not \"%s\"."
                        .formatted(key, module, nameOf(byDefault.getClass()), attribute.getValue());
            }
            read.put(key, value);
        }
        settings.clear();
        settings.putAll(read);
        return null;
    }

    private static @Nullable Object parse(String text, Class<?> type) {
        try {
            if (type == Integer.class) {
                return Integer.valueOf(text.trim());
            } else if (type == Double.class) {
                return Double.valueOf(text.trim());
            } else if (type == Boolean.class) {
                return switch (text.trim()) {
                    case "true" -> true;
                    case "false" -> false;
                    default -> null;
                };
            }
            return text;
        } catch (NumberFormatException e) {
            return null;
        }
    }

    private static String nameOf(Class<?> type) {
        if (type == Integer.class) {
            return "a whole number";
        } else if (type == Double.class) {
            return "a number";
        } else if (type == Boolean.class) {
            return "true or false";
        }
        return "a text";
    }
}
