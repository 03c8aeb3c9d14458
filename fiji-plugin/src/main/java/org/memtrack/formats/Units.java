// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.formats;

import java.util.Locale;
import java.util.OptionalDouble;

/** Names of units that ImageJ and TrackMate write. */
final class Units {
    private Units() {}

    /** Micrometres of a unit of length; empty for pixels and for a name nobody knows. */
    static OptionalDouble micrometres(String unit) {
        return switch (unit.strip().toLowerCase(Locale.ROOT)) {
            // Micro sign and Greek mu.
            case "um",
                    "\u00b5m",
                    "\u03bcm",
                    "micron",
                    "microns",
                    "micrometer",
                    "micrometers",
                    "micrometre",
                    "micrometres" -> OptionalDouble.of(1);
            case "nm", "nanometer", "nanometre" -> OptionalDouble.of(1e-3);
            case "mm", "millimeter", "millimetre" -> OptionalDouble.of(1e3);
            default -> OptionalDouble.empty();
        };
    }

    /** Seconds of a unit of time; empty for frames and for a name nobody knows. */
    static OptionalDouble seconds(String unit) {
        return switch (unit.strip().toLowerCase(Locale.ROOT)) {
            case "s", "sec", "secs", "second", "seconds" -> OptionalDouble.of(1);
            case "ms", "msec", "millisecond", "milliseconds" -> OptionalDouble.of(1e-3);
            case "min", "minute", "minutes" -> OptionalDouble.of(60);
            case "h", "hour", "hours" -> OptionalDouble.of(3600);
            default -> OptionalDouble.empty();
        };
    }
}
