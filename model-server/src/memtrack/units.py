# SPDX-License-Identifier: GPL-3.0-or-later
"""Units of length and time as films and tracks name them: free text; the plug-in knows the same words."""

from __future__ import annotations

_MICROMETRES = {
    1e-3: ("nm", "nanometer", "nanometre", "nanometers", "nanometres"),
    # Both micro signs: Latin-1 and Greek.
    1.0: ("µm", "μm", "um", "micron", "microns", "micrometer", "micrometre", "micrometers", "micrometres"),
    1e3: ("mm", "millimeter", "millimetre", "millimeters", "millimetres"),
    1e4: ("cm", "centimeter", "centimetre"),
    2.54e4: ("in", "inch", "inches"),
    1e6: ("m", "meter", "metre"),
}
_OF_PRINT = (1e4, 2.54e4)
# Pixels on a screen or in print are larger as a rule, 300 an inch being 85 um; those of a microscope are smaller.
_LARGEST_PIXEL_UM = 50.0
_SECONDS = {
    1e-6: ("µs", "μs", "us", "usec"),
    1e-3: ("ms", "msec", "millisecond", "milliseconds"),
    1.0: ("s", "sec", "second", "seconds"),
    60.0: ("min", "minute", "minutes"),
    3600.0: ("h", "hr", "hour", "hours"),
}


def micrometres(unit: str) -> float | None:
    """Micrometres in one `unit`; None where it is pixels or unknown."""
    return _found(unit, _MICROMETRES)


def pixel_micrometres(size: float, unit: str) -> float | None:
    """Edge in micrometres of a pixel of `size`; None as above, or where it is as large as in print.

    A TIFF tells in inches or centimetres how large it is in print, unless a microscope's software puts the true size
    there.
    """
    factor = micrometres(unit)
    if factor is None:
        return None
    return None if factor in _OF_PRINT and size * factor > _LARGEST_PIXEL_UM else size * factor


def seconds(unit: str) -> float | None:
    """Seconds in one `unit`; None where it is frames or unknown."""
    return _found(unit, _SECONDS)


def _found(unit: str, known: dict[float, tuple[str, ...]]) -> float | None:
    word = unit.strip().lower()
    return next((factor for factor, words in known.items() if word in words), None)
