# SPDX-License-Identifier: GPL-3.0-or-later
import re
from pathlib import Path

import pytest

from memtrack import units

UNITS_OF_THE_PLUG_IN = Path(__file__).parents[2] / "fiji-plugin/src/main/java/org/memtrack/video/Units.java"


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("um", 1),
        ("µm", 1),
        ("μm", 1),
        (" Micron ", 1),
        ("nm", 1e-3),
        ("millimetres", 1e3),
        ("cm", 1e4),
        ("inch", 2.54e4),
        ("m", 1e6),
    ],
)
def test_a_length_is_brought_to_micrometres(unit: str, factor: float) -> None:
    assert units.micrometres(unit) == factor


@pytest.mark.parametrize("unit", ["", "pixel", "s", "parsec"])
def test_what_is_no_length_in_the_world_is_none(unit: str) -> None:
    assert units.micrometres(unit) is None


@pytest.mark.parametrize(
    ("size", "unit", "expected"),
    [
        (1e-5, "inch", 0.254),
        (2.5e-5, "cm", 0.25),
        (72, "um", 72),
        (1 / 72, "inch", None),
        (1 / 72, "cm", None),
        (1, "pixel", None),
    ],
)
def test_a_pixel_as_large_as_in_print_has_no_size(size: float, unit: str, expected: float | None) -> None:
    assert units.pixel_micrometres(size, unit) == (expected if expected is None else pytest.approx(expected))


@pytest.mark.parametrize(("unit", "factor"), [("µs", 1e-6), ("msec", 1e-3), ("Sec", 1), ("min", 60), ("hours", 3600)])
def test_a_time_is_brought_to_seconds(unit: str, factor: float) -> None:
    assert units.seconds(unit) == factor


@pytest.mark.parametrize("unit", ["", "frame", "um"])
def test_what_is_no_time_is_none(unit: str) -> None:
    assert units.seconds(unit) is None


def test_the_plug_in_knows_the_same_words() -> None:
    source = UNITS_OF_THE_PLUG_IN.read_text(encoding="utf-8").replace("\\u00b5", "µ").replace("\\u03bc", "μ")
    lengths, times = source.split("frameIntervalSeconds(Calibration")
    for java, python in ((lengths, units._MICROMETRES), (times, units._SECONDS)):
        cases = re.findall(r'case ("[^>]*) -> ([\d.e-]+);', java)
        assert {float(factor): set(re.findall('"([^"]*)"', words)) for words, factor in cases} == {
            factor: set(words) for factor, words in python.items()
        }
