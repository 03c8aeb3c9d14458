# SPDX-License-Identifier: GPL-3.0-or-later
"""Films in TIFF files: any tool's multi-page files, ImageJ hyperstacks (also beyond 4 GB), OME."""

from __future__ import annotations

import contextlib
import math
import os
import struct
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import cv2
import defusedxml.ElementTree
import numpy as np
import tifffile
from jaxtyping import Shaped

from memtrack.errors import FilmError
from memtrack.film import Calibration
from memtrack.units import micrometres, pixel_micrometres, seconds
from memtrack.video.source import Source, notes_on, red_first

_AXIS_WORDS = {"T": "time points", "Z": "slices", "C": "channels"}


@contextlib.contextmanager
def open_tiff(path: Path) -> Iterator[Source]:
    """The film in a TIFF; frames are read when they are asked for.

    Raises:
        FilmError: it is no TIFF, or has more than one dimension besides the plane.
    """
    with contextlib.ExitStack() as stack:
        with _readable(path.name):
            file = stack.enter_context(tifffile.TiffFile(path))
            series = _first_series(file)
            count, notes = _frames(series, path.name)
            _check_whole(file, series, count)
            if len(file.series) > 1:
                notes.append(f"Only the first of {len(file.series)} series of images in {path.name} is used.")
            height, width = series.shape[series.axes.index("Y")], series.shape[series.axes.index("X")]
            read = _reader(file, series)
            notes += notes_on(read(0))
            calibration, shape = _calibration(file)
            notes += shape
        yield Source(count, height, width, read, calibration, tuple(notes))


def read_tiff(path: Path) -> Shaped[np.ndarray, "..."]:
    """The one image in a TIFF.

    Raises:
        FilmError: it is no TIFF, or holds several images.
    """
    with _readable(path.name), tifffile.TiffFile(path) as file:
        series = _first_series(file)
        count, _ = _frames(series, path.name)
        if count > 1:
            raise FilmError(
                f"{path.name} holds {count} images, but a folder is read as one image a file; give the file"
            )
        return _reader(file, series)(0)


@contextlib.contextmanager
def _readable(what: str) -> Iterator[None]:
    """Turns whatever a damaged or unknown TIFF makes tifffile and OpenCV raise into a FilmError."""
    try:
        yield
    except FilmError:
        raise
    except Exception as error:
        raise FilmError(f"{what} cannot be read as TIFF ({error}); save the film again from Fiji") from error


def _first_series(file: tifffile.TiffFile) -> tifffile.TiffPageSeries:
    if not file.series:
        raise FilmError(f"{file.filename} holds no image; save the film again from Fiji")
    return file.series[0]


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


def _check_whole(file: tifffile.TiffFile, series: tifffile.TiffPageSeries, count: int) -> None:
    """Refuses a film that broke off when it was written or copied, of which tifffile gives the frames that are left."""
    promised = _promised(file)
    held = count
    if series.dataoffset is not None:
        held = min(count, (file.filehandle.size - series.dataoffset) // (series.nbytes // count))
    if held < max(count, promised):
        raise FilmError(
            f"{file.filename} holds {held} of {max(count, promised)} frames, the rest is lost; "
            "copy it again, or save it again from Fiji"
        )
    if promised < 2 and _next_page(file) != 0:
        raise FilmError(f"{file.filename} breaks off after {count} frame(s); copy it again, or save it again from Fiji")


def _promised(file: tifffile.TiffFile) -> int:
    """Frames the film has by what ImageJ, OME or tifffile noted in its first page; 0 where none of them did."""
    if file.imagej_metadata is not None:
        return int(file.imagej_metadata.get("frames", 1)) * int(file.imagej_metadata.get("slices", 1))
    if file.ome_metadata is not None:
        sizes = _ome_pixels(file.ome_metadata)
        return int(sizes.get("SizeT", 0)) * int(sizes.get("SizeZ", 1))
    if file.shaped_metadata is not None:
        return math.prod(file.shaped_metadata[0]["shape"]) // math.prod(file.pages.first.shape)
    return 0


def _next_page(file: tifffile.TiffFile) -> int:
    """Where the page after the last one that can be read is said to be; 0 says that there is none."""
    tiff, handle = file.tiff, file.filehandle
    handle.seek(file.pages[-1].offset)
    (tags,) = struct.unpack(tiff.tagnoformat, handle.read(tiff.tagnosize))
    handle.seek(tags * tiff.tagsize, os.SEEK_CUR)
    (offset,) = struct.unpack(tiff.offsetformat, handle.read(tiff.offsetsize))
    return int(offset)


def _reader(file: tifffile.TiffFile, series: tifffile.TiffPageSeries) -> Callable[[int], Shaped[np.ndarray, "..."]]:
    """Reads one frame: straight from its place where frames lie one after the other, else page by page."""
    plane = tuple(size for axis, size in zip(series.axes, series.shape, strict=True) if axis in "YXS")
    lock = threading.Lock()
    if series.dataoffset is not None:
        start, dtype = int(series.dataoffset), np.dtype(file.byteorder + series.dtype.char)
        samples = math.prod(plane)

        def read_contiguous(index: int) -> Shaped[np.ndarray, "..."]:
            with lock, _readable(f"frame {index + 1} of {file.filename}"):
                found = file.filehandle.read_array(dtype, samples, start + index * samples * dtype.itemsize)
            return found.reshape(plane)

        return read_contiguous

    codec = series.keyframe
    known = codec.compression in tifffile.TIFF.DECOMPRESSORS and codec.predictor in tifffile.TIFF.UNPREDICTORS

    def read_page(index: int) -> Shaped[np.ndarray, "..."]:
        with lock, _readable(f"frame {index + 1} of {file.filename}"):
            page = series.pages[index] if index < len(series.pages) else None
            if page is None:
                raise FilmError(f"frame {index + 1} is missing in {file.filename}; save the film again from Fiji")
            return page.asarray() if known else _decoded_by_opencv(file, page)

    return read_page


def _decoded_by_opencv(file: tifffile.TiffFile, page: Any) -> Shaped[np.ndarray, "..."]:
    """A page in a compression that tifffile leaves to a library of its own, such as LZW.

    OpenCV decodes the first page; so it gets the file, mapped, with this page's place in its header.
    """
    ends = [start + size for start, size in zip(page.dataoffsets, page.databytecounts, strict=True)]
    if max(ends) > file.filehandle.size:
        raise ValueError("the file ends within it")
    mapped = np.memmap(file.filehandle.path, np.uint8, "c")
    struct.pack_into(file.tiff.offsetformat, mapped.data, file.tiff.offsetsize, page.offset)
    image = cv2.imdecode(mapped, cv2.IMREAD_UNCHANGED)
    if image is None:
        raise ValueError(f"its compression is {page.keyframe.compression!r}")
    return red_first(image)


def _calibration(file: tifffile.TiffFile) -> tuple[Calibration, list[str]]:
    """What ImageJ or OME wrote, and a note where its pixels are not square; the resolution of other TIFFs is about
    printing and means nothing here."""
    if file.imagej_metadata is not None:
        return _imagej(file.imagej_metadata, file)
    if file.ome_metadata is not None:
        return _ome(file.ome_metadata)
    return Calibration(), []


def _imagej(tags: dict[str, Any], file: tifffile.TiffFile) -> tuple[Calibration, list[str]]:
    unit = str(tags.get("unit", "")).replace("\\u00B5", "µ")
    width, height = (_edge(file, name, unit) for name in ("XResolution", "YResolution"))
    # Not by "fps": that is the rate of ImageJ's animation, whatever the film was recorded at.
    interval = float(tags.get("finterval", 0) or 0) * (seconds(str(tags.get("tunit", "sec"))) or 0)
    return Calibration(width, interval if interval > 0 else None), _shape(width, height)


def _edge(file: tifffile.TiffFile, resolution: str, unit: str) -> float | None:
    tag = file.pages.first.tags.get(resolution)
    return None if tag is None or min(tag.value) <= 0 else pixel_micrometres(tag.value[1] / tag.value[0], unit)


def _shape(width: float | None, height: float | None) -> list[str]:
    """What is to be said of pixels of this width and height in micrometres."""
    if width is None or height is None or abs(height / width - 1) <= 0.01:
        return []
    return [
        f"The pixels are not square ({width:g} x {height:g} um); their width, or the size that is given, is used in "
        "both directions."
    ]


def _ome_pixels(text: str) -> dict[str, str]:
    """What OME says of the first image."""
    try:
        root = defusedxml.ElementTree.fromstring(text)
    except (defusedxml.ElementTree.ParseError, defusedxml.DefusedXmlException):
        return {}
    pixels = root.find(".//{*}Pixels")
    return {} if pixels is None else dict(pixels.attrib)


def _ome(text: str) -> tuple[Calibration, list[str]]:
    values = _ome_pixels(text)
    width, height = (_quantity(values, f"PhysicalSize{axis}", "µm", micrometres) for axis in "XY")
    return Calibration(width, _quantity(values, "TimeIncrement", "s", seconds)), _shape(width, height)


def _quantity(
    values: dict[str, str], name: str, default_unit: str, factor: Callable[[str], float | None]
) -> float | None:
    try:
        value = float(values[name]) * (factor(values.get(f"{name}Unit", default_unit)) or 0)
    except (KeyError, ValueError):
        return None
    return value if 0 < value < math.inf else None
