# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import pytest
import tifffile

from film_checks import FILM, check
from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.video import open_film


@pytest.mark.parametrize(("unit", "factor"), [("um", 1), ("micron", 1), ("\\u00B5m", 1), ("nm", 1e-3), ("mm", 1e3)])
def test_imagej_tiff_tells_pixel_size_and_frame_interval(tmp_path: Path, unit: str, factor: float) -> None:
    path = tmp_path / "film.tif"
    tags = {"axes": "TYX", "unit": unit, "finterval": 0.5}
    tifffile.imwrite(path, FILM, imagej=True, metadata=tags, resolution=(4.0, 4.0))
    calibration = check(path, FILM)
    assert calibration.pixel_size_um == pytest.approx(0.25 * factor)
    assert calibration.frame_interval_seconds == 0.5


@pytest.mark.parametrize(("height", "said"), [(0.251, False), (0.3, True)])
def test_pixels_that_are_not_square_are_said(tmp_path: Path, height: float, said: bool) -> None:
    sentence = (
        f"The pixels are not square (0.25 x {height} um); their width, or the size that is given, is used in both "
        "directions."
    )
    notes = (sentence,) * said
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, imagej=True, metadata={"axes": "TYX", "unit": "um"}, resolution=(4.0, 1 / height))
    assert check(path, FILM, notes).pixel_size_um == 0.25
    path = tmp_path / "film.ome.tif"
    size = {"PhysicalSizeX": 0.25, "PhysicalSizeY": 1000 * height, "PhysicalSizeYUnit": "nm"}
    tifffile.imwrite(path, FILM, ome=True, metadata={"axes": "TYX", **size})
    assert check(path, FILM, notes).pixel_size_um == 0.25


@pytest.mark.parametrize("unit", ["pixel", "inch", "cm"])
def test_imagej_tiff_in_pixels_or_as_large_as_in_print_tells_no_size(tmp_path: Path, unit: str) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, imagej=True, metadata={"axes": "TYX", "unit": unit}, resolution=(72.0, 72.0))
    assert check(path, FILM) == Calibration()


def test_imagej_tiff_in_inches_of_a_microscope_tells_its_size(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, imagej=True, metadata={"axes": "TYX", "unit": "inch"}, resolution=(101600.0, 101600.0))
    assert check(path, FILM).pixel_size_um == pytest.approx(0.25)


def test_the_rate_of_imagejs_animation_is_no_frame_interval(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, imagej=True, metadata={"axes": "TYX", "fps": 7.0})
    assert check(path, FILM) == Calibration()


def test_ome_tiff_tells_pixel_size_and_time(tmp_path: Path) -> None:
    path = tmp_path / "film.ome.tif"
    size = {"PhysicalSizeX": 247.5, "PhysicalSizeXUnit": "nm", "TimeIncrement": 20.0, "TimeIncrementUnit": "ms"}
    tifffile.imwrite(path, FILM, ome=True, metadata={"axes": "TYX", **size})
    calibration = check(path, FILM)
    assert calibration.pixel_size_um == pytest.approx(0.2475)
    assert calibration.frame_interval_seconds == pytest.approx(0.02)


def test_a_given_calibration_goes_before_the_files(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(
        path, FILM, imagej=True, metadata={"axes": "TYX", "unit": "um", "finterval": 0.5}, resolution=(4, 4)
    )
    with open_film(path, Calibration(pixel_size_um=0.1)) as film:
        assert film.calibration == Calibration(0.1, 0.5)


def test_slices_are_taken_as_time_with_a_note(tmp_path: Path) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM, imagej=True, metadata={"axes": "ZYX"})
    check(path, FILM, ("The 12 slices of film.tif are taken as time points.",))


@pytest.mark.parametrize(
    ("axes", "found"), [("TZYX", "3 time points, 4 slices"), ("TCYX", "3 time points, 4 channels")]
)
def test_more_than_time_is_refused_with_what_was_found(tmp_path: Path, axes: str, found: str) -> None:
    path = tmp_path / "film.tif"
    tifffile.imwrite(path, FILM.reshape(3, 4, 9, 14), imagej=True, metadata={"axes": axes})
    with pytest.raises(FilmError, match=f"film.tif has {found}, but a film is one plane a time point"), open_film(path):
        pass
