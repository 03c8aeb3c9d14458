// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.ui;

import ij.ImagePlus;
import ij.Prefs;
import java.util.EnumMap;
import java.util.EnumSet;
import java.util.Map;
import java.util.Set;
import org.memtrack.macro.TrackOption;

/** The options of the last run, which the dialog begins with; macros never see them. */
final class RememberedOptions {
    private static final String PREFERENCE = "memtrack.";

    /** Told by each film itself; the last film's would be wrong for the next. */
    private static final Set<TrackOption> OF_THE_FILM = EnumSet.of(
            TrackOption.PIXEL_SIZE,
            TrackOption.FRAME_INTERVAL,
            TrackOption.CELL_LENGTH,
            TrackOption.FRAMES,
            TrackOption.CHANNEL,
            TrackOption.FIRST_FRAME,
            TrackOption.LAST_FRAME);

    private RememberedOptions() {}

    /** The values that the dialog begins with; the film's own are still missing. */
    static Map<TrackOption, String> of(ImagePlus image) {
        Map<TrackOption, String> values = new EnumMap<>(TrackOption.class);
        for (TrackOption option : TrackOption.values()) {
            String value = OF_THE_FILM.contains(option)
                    ? option.defaultValue()
                    : Prefs.get(PREFERENCE + option.key(), option.defaultValue());
            // An earlier version may have had other choices.
            boolean choosable =
                    option.kind() != TrackOption.Kind.CHOICE || option.choices().contains(value);
            values.put(option, choosable ? value : option.defaultValue());
        }
        values.compute(TrackOption.OUTPUT, (option, own) -> OfferedFolder.of(image, own));
        return values;
    }

    /** Keeps accepted values for the next film. */
    static void keep(ImagePlus image, Map<TrackOption, String> values) {
        values.forEach((option, value) -> {
            if (!OF_THE_FILM.contains(option)) {
                boolean folder = option == TrackOption.OUTPUT;
                Prefs.set(PREFERENCE + option.key(), folder ? OfferedFolder.own(image, value) : value);
            }
        });
    }

    /** Whether the second page of the dialog, which may stay closed, holds a value that is not the default. */
    static boolean changeWhatIsNotShown(Map<TrackOption, String> values) {
        return values.entrySet().stream()
                .filter(entry -> !entry.getKey().common() && !OF_THE_FILM.contains(entry.getKey()))
                .anyMatch(entry -> !entry.getValue().isEmpty()
                        && !entry.getValue().equals(entry.getKey().defaultValue()));
    }
}
