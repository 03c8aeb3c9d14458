# SPDX-License-Identifier: GPL-3.0-or-later
"""The header of a film as a client sent it, checked field by field before any work."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool

from memtrack.config import PROTOCOL, Limits
from memtrack.errors import FilmError, ResourceLimitError, SettingsError
from memtrack.film import Calibration
from memtrack.settings import DetectionSettings
from memtrack.spool import FilmGeometry, megabytes
from memtrack.v1 import detection_pb2 as pb

DTYPES: dict[int, np.dtype[np.generic]] = {
    pb.PIXEL_TYPE_UINT8: np.dtype("<u1"),
    pb.PIXEL_TYPE_UINT16: np.dtype("<u2"),
    pb.PIXEL_TYPE_FLOAT32: np.dtype("<f4"),
}
CRITERIA = {
    pb.CRITERION_UNSPECIFIED: "max_f1",
    pb.CRITERION_MAX_PRECISION: "max_precision",
    pb.CRITERION_MAX_F1: "max_f1",
}


@dataclass(frozen=True, slots=True)
class FilmRequest:
    """What a client wants done with which film."""

    geometry: FilmGeometry
    calibration: Calibration
    settings: DetectionSettings


def read_header(header: pb.FilmHeader, limits: Limits) -> FilmRequest:
    """The request behind `header`.

    Raises:
        FilmError: no film has such a shape.
        SettingsError: another protocol, or a setting out of range.
        ResourceLimitError: the film is larger than the server takes.
    """
    if header.protocol != PROTOCOL:
        raise SettingsError(
            f"the plug-in speaks protocol {header.protocol} and the model server {PROTOCOL}; "
            "install the same version of both"
        )
    geometry = _geometry(header, limits)
    calibration = Calibration(
        _positive(header, "pixel_size_um", "um"), _positive(header, "frame_interval_seconds", "seconds")
    )
    return FilmRequest(geometry, calibration, _settings(header, geometry))


def check_scaled(geometry: FilmGeometry, scale: float, limits: Limits) -> None:
    """Holds the frames to the limit at the model's scale too.

    Raises:
        ResourceLimitError: they are larger than the server takes.
    """
    if geometry.width * geometry.height * scale**2 > limits.max_frame_pixels:
        raise ResourceLimitError(
            f"a frame of {geometry.width} x {geometry.height} pixels, enlarged {scale:.3g} times to the model's scale, "
            f"has more than the {limits.max_frame_pixels} pixels the server takes; crop it, or check its pixel size"
        )


def _geometry(header: pb.FilmHeader, limits: Limits) -> FilmGeometry:
    for name in ("width", "height", "frame_count"):
        value = getattr(header, name)
        if value < 1:
            raise FilmError(f"{name} is {value}; a film has at least 1")
    if header.pixel_type not in DTYPES:
        raise FilmError(
            f"pixel type {header.pixel_type} is unknown; convert the film to 8-bit, 16-bit or 32-bit float grey"
        )
    geometry = FilmGeometry(header.width, header.height, header.frame_count, DTYPES[header.pixel_type])
    if geometry.frame_count > limits.max_frames:
        raise ResourceLimitError(
            f"the film has {geometry.frame_count} frames, the server takes {limits.max_frames}; split it"
        )
    if geometry.width * geometry.height > limits.max_frame_pixels:
        raise ResourceLimitError(
            f"a frame has {geometry.width} x {geometry.height} pixels, the server takes {limits.max_frame_pixels} in "
            "all; crop the film or make it smaller"
        )
    if geometry.film_bytes > limits.max_film_bytes:
        raise ResourceLimitError(
            f"the film has {megabytes(geometry.film_bytes)}, the server takes {megabytes(limits.max_film_bytes)}; "
            "split it, crop it, or start the server with a greater --max-film-bytes"
        )
    return geometry


def _settings(header: pb.FilmHeader, geometry: FilmGeometry) -> DetectionSettings:
    if header.criterion not in CRITERIA:
        raise SettingsError(f"criterion {header.criterion} is unknown; use maximum precision or maximum F1")
    defaults = DetectionSettings()
    given = header.thresholds
    return DetectionSettings(
        model=header.model_name or defaults.model,
        version=header.model_version or None,
        criterion=CRITERIA[header.criterion],
        thresholds=(given.low, given.medium, given.high) if header.HasField("thresholds") else None,
        max_size_px=header.max_size_px if header.HasField("max_size_px") else defaults.max_size_px,
        nms_iou=header.nms_iou if header.HasField("nms_iou") else defaults.nms_iou,
        stabilise=not header.no_stabilisation,
        resting=header.resting,
        region=_region(header, geometry),
        cell_length_px=header.cell_length_px if header.HasField("cell_length_px") else None,
    )


def _region(header: pb.FilmHeader, geometry: FilmGeometry) -> Bool[np.ndarray, "height width"] | None:
    if not header.HasField("region"):
        return None
    pixels = geometry.width * geometry.height
    mask, expected = header.region.mask, (pixels + 7) // 8
    if len(mask) != expected:
        raise SettingsError(
            f"the mask of the region has {len(mask)} bytes, "
            f"one of {geometry.width} x {geometry.height} bits has {expected}"
        )
    bits = np.unpackbits(np.frombuffer(mask, np.uint8), count=pixels)
    return bits.astype(bool).reshape(geometry.height, geometry.width)


def _positive(header: pb.FilmHeader, name: str, unit: str) -> float | None:
    if not header.HasField(name):
        return None
    value: float = getattr(header, name)
    if not (math.isfinite(value) and value > 0):
        raise SettingsError(f"{name} is {value}; give a number of {unit} above 0, or leave it out when it is not known")
    return value
