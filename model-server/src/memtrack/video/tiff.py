# SPDX-License-Identifier: GPL-3.0-or-later
"""Films in TIFF files: any tool's multi-page files, ImageJ hyperstacks (also beyond 4 GB), OME."""

from __future__ import annotations

import contextlib
import math
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import defusedxml.ElementTree
import numpy as np
import tifffile
from jaxtyping import Shaped

from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.video.source import Source, notes_on

_MICROMETRES = {"um": 1.0, "µm": 1.0, "μm": 1.0, "micron": 1.0, "microns": 1.0, "micrometer": 1.0, "nm": 1e-3,
                "mm": 1e3, "cm": 1e4, "m": 1e6, "inch": 25400.0}  # fmt: skip
_SECONDS = {"s": 1.0, "sec": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "min": 60.0, "h": 3600.0}
_AXIS_WORDS = {"T": "time points", "Z": "slices", "C": "channels"}


@contextlib.contextmanager
def open_tiff(path: Path) -> Iterator[Source]:
    """The film in a TIFF; frames are read when they are asked for.

    Raises:
        FilmError: it is no TIFF, or has more than one dimension besides the plane.
    """
    try:
        file = tifffile.TiffFile(path)
    except (tifffile.TiffFileError, OSError, ValueError) as error:
        raise FilmError(f"{path.name} cannot be read as TIFF ({error}); save the film again from Fiji") from error
    with file:
        if not file.series:
            raise FilmError(f"{path.name} holds no image; save the film again from Fiji")
        series = file.series[0]
        count, notes = _frames(series, path.name)
        if len(file.series) > 1:
            notes.append(f"Only the first of {len(file.series)} series of images in {path.name} is used.")
        height, width = series.shape[series.axes.index("Y")], series.shape[series.axes.index("X")]
        read = _reader(file, series)
        notes += notes_on(read(0))
        yield Source(count, height, width, read, _calibration(file), tuple(notes))


def _frames(series: tifffile.TiffPageSeries, name: str) -> tuple[int, list[str]]:
    """The number of frames, and what was assumed about the axis they lie on."""
    axes = dict(zip(series.axes, series.shape, strict=True))
    if not {"Y", "X"} <= axes.keys() or ("S" in axes and series.axes[-1] != "S"):
        raise FilmError(f"the axes of {name} are {series.axes}; save it from Fiji as a stack of grey frames")
    long = {axis: size for axis, size in axes.items() if axis not in "YXS" and size > 1}
    if len(long) > 1 or "C" in long:
        found = ", ".join(f"{size} {_AXIS_WORDS.get(axis, axis)}" for axis, size in long.items())
        raise FilmError(
            f"{name} has {found}, but a film is one plane a time point; "
            "keep one channel and one slice (in Fiji: Image > Duplicate) and save again"
        )
    notes = []
    if "Z" in long:
        notes.append(f"The {long['Z']} slices of {name} are taken as time points.")
    return math.prod(long.values()), notes


def _reader(file: tifffile.TiffFile, series: tifffile.TiffPageSeries) -> Callable[[int], Shaped[np.ndarray, "..."]]:
    """Reads one frame: straight from its place where frames lie one after the other, else page by page."""
    plane = tuple(size for axis, size in zip(series.axes, series.shape, strict=True) if axis in "YXS")
    lock = threading.Lock()
    if series.dataoffset is not None:
        start, dtype = int(series.dataoffset), np.dtype(file.byteorder + series.dtype.char)
        samples = math.prod(plane)

        def read_contiguous(index: int) -> Shaped[np.ndarray, "..."]:
            with lock:
                found = file.filehandle.read_array(dtype, samples, start + index * samples * dtype.itemsize)
            return found.reshape(plane)

        return read_contiguous

    def read_page(index: int) -> Shaped[np.ndarray, "..."]:
        page = series.pages[index] if index < len(series.pages) else None
        if page is None:
            raise FilmError(f"frame {index} is missing in {file.filename}; save the film again from Fiji")
        with lock:
            return page.asarray()

    return read_page


def _calibration(file: tifffile.TiffFile) -> Calibration:
    """What ImageJ or OME wrote; the resolution of other TIFFs is about printing and means nothing here."""
    if file.imagej_metadata is not None:
        return _imagej(file.imagej_metadata, file)
    if file.ome_metadata is not None:
        return _ome(file.ome_metadata)
    return Calibration()


def _imagej(tags: dict[str, Any], file: tifffile.TiffFile) -> Calibration:
    unit = str(tags.get("unit", "")).replace("\\u00B5", "µ").lower()
    resolution = file.pages.first.tags.get("XResolution")
    size = None
    if unit in _MICROMETRES and resolution is not None and resolution.value[0] > 0:
        size = resolution.value[1] / resolution.value[0] * _MICROMETRES[unit]
    interval = float(tags.get("finterval", 0) or 0) * _SECONDS.get(str(tags.get("tunit", "sec")).lower(), 0)
    if interval <= 0 and float(tags.get("fps", 0) or 0) > 0:
        interval = 1 / float(tags["fps"])
    return Calibration(size, interval if interval > 0 else None)


def _ome(text: str) -> Calibration:
    try:
        root = defusedxml.ElementTree.fromstring(text)
    except (defusedxml.ElementTree.ParseError, defusedxml.DefusedXmlException):
        return Calibration()
    pixels = root.find(".//{*}Pixels")
    values = {} if pixels is None else pixels.attrib
    return Calibration(
        _quantity(values, "PhysicalSizeX", "µm", _MICROMETRES), _quantity(values, "TimeIncrement", "s", _SECONDS)
    )


def _quantity(values: dict[str, str], name: str, default_unit: str, units: dict[str, float]) -> float | None:
    try:
        value = float(values[name]) * units[values.get(f"{name}Unit", default_unit)]
    except (KeyError, ValueError):
        return None
    return value if 0 < value < math.inf else None
