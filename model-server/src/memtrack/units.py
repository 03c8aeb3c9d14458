# SPDX-License-Identifier: GPL-3.0-or-later
"""Units of length and time as films and tracks name them: free text; the plug-in knows the same words."""

from __future__ import annotations

_MICROMETRES = {
    1e-3: ("nm", "nanometer", "nanometre", "nanometers", "nanometres"),
    # Both micro signs: Latin-1 and Greek.
    1.0: ("µm", "μm", "um", "micron", "microns", "micrometer", "micrometre", "micrometers", "micrometres"),
    1e3: ("mm", "millimeter", "millimetre", "millimeters", "millimetres"),
    1e4: ("cm", "centimeter", "centimetre"),
    1e6: ("m", "meter", "metre"),
}
_SECONDS = {
    1e-6: ("µs", "μs", "us", "usec"),
    1e-3: ("ms", "msec", "millisecond", "milliseconds"),
    1.0: ("s", "sec", "second", "seconds"),
    60.0: ("min", "minute", "minutes"),
    3600.0: ("h", "hr", "hour", "hours"),
}


def micrometres(unit: str) -> float | None:
    """Micrometres in one `unit`; None where it is pixels, inches of a screen, or unknown."""
    return _found(unit, _MICROMETRES)


def seconds(unit: str) -> float | None:
    """Seconds in one `unit`; None where it is frames or unknown."""
    return _found(unit, _SECONDS)


def _found(unit: str, known: dict[float, tuple[str, ...]]) -> float | None:
    word = unit.strip().lower()
    return next((factor for factor, words in known.items() if word in words), None)
