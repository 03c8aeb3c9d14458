# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from memtrack.config import Limits
from memtrack.errors import FilmError, MemtrackError, ResourceLimitError, SettingsError
from memtrack.film import Calibration
from memtrack.headers import check_scaled, read_header
from memtrack.settings import DetectionSettings
from memtrack.spool import FilmGeometry
from memtrack.v1 import detection_pb2 as pb

GOOD: dict[str, Any] = {"protocol": 1, "width": 660, "height": 492, "frame_count": 60, "pixel_type": 1}
NAN, INFINITY = float("nan"), float("inf")


def test_a_bare_header_means_the_defaults() -> None:
    request = read_header(pb.FilmHeader(**GOOD), Limits())
    assert (request.geometry.width, request.geometry.height, request.geometry.frame_count) == (660, 492, 60)
    assert request.geometry.film_bytes == 660 * 492 * 60
    assert request.calibration == Calibration()
    assert request.settings == DetectionSettings()


def test_every_field_arrives() -> None:
    mask = np.random.default_rng(0).random((492, 660)) < 0.5
    request = read_header(
        pb.FilmHeader(
            **{**GOOD, "pixel_type": pb.PIXEL_TYPE_UINT16},
            pixel_size_um=0.2475,
            frame_interval_seconds=1 / 60,
            cell_length_px=8.5,
            model_name="mine",
            model_version="3",
            criterion=pb.CRITERION_MAX_F1,
            thresholds=pb.LevelThresholds(low=0.1, medium=0.2, high=0.3),
            max_size_px=40,
            nms_iou=0.5,
            no_stabilisation=True,
            resting=True,
            region=pb.RegionOfInterest(mask=np.packbits(mask).tobytes()),
        ),
        Limits(),
    )
    assert request.geometry.dtype == np.dtype("<u2")
    assert request.calibration == Calibration(0.2475, 1 / 60)
    settings = request.settings
    assert (settings.model, settings.version, settings.criterion) == ("mine", "3", "max_f1")
    assert (settings.thresholds, settings.max_size_px, settings.nms_iou) == ((0.1, 0.2, 0.3), 40, 0.5)
    assert (settings.stabilise, settings.resting, settings.cell_length_px) == (False, True, 8.5)
    assert settings.region is not None
    np.testing.assert_array_equal(settings.region, mask)


BAD: list[tuple[dict[str, Any], type[MemtrackError], str]] = [
    ({"protocol": 0}, SettingsError, "speaks protocol 0 and the model server 1"),
    ({"protocol": 2}, SettingsError, "speaks protocol 2 and the model server 1"),
    ({"width": 0}, FilmError, "width is 0; a film has at least 1"),
    ({"height": -5}, FilmError, "height is -5"),
    ({"frame_count": 0}, FilmError, "frame_count is 0"),
    ({"pixel_type": 0}, FilmError, "pixel type 0 is unknown"),
    ({"pixel_type": 99}, FilmError, "pixel type 99 is unknown"),
    ({"frame_count": 1_000_001, "width": 1, "height": 1}, ResourceLimitError, "has 1000001 frames, the server takes"),
    ({"width": 2**31 - 1, "height": 2**31 - 1}, ResourceLimitError, "has 2147483647 x 2147483647 pixels"),
    ({"frame_count": 300_000}, ResourceLimitError, r"has 97\.4 GB, the server takes 68\.7 GB"),
    ({"pixel_size_um": 0}, SettingsError, r"pixel_size_um is 0\.0"),
    ({"pixel_size_um": NAN}, SettingsError, "pixel_size_um is nan"),
    ({"frame_interval_seconds": -1}, SettingsError, r"frame_interval_seconds is -1\.0"),
    ({"frame_interval_seconds": INFINITY}, SettingsError, "frame_interval_seconds is inf"),
    ({"cell_length_px": 0}, SettingsError, "cell_length_px is 0"),
    ({"cell_length_px": NAN}, SettingsError, "cell_length_px is nan"),
    ({"criterion": 7}, SettingsError, "criterion 7 is unknown"),
    ({"thresholds": pb.LevelThresholds(low=1.5)}, SettingsError, r"1\.5"),
    ({"thresholds": pb.LevelThresholds(high=NAN)}, SettingsError, "nan"),
    ({"max_size_px": 0}, SettingsError, "max_size_px is 0"),
    ({"nms_iou": 1.01}, SettingsError, r"nms_iou is 1\.01"),
    ({"nms_iou": NAN}, SettingsError, "nms_iou is nan"),
    ({"region": pb.RegionOfInterest(mask=b"123")}, SettingsError, "mask of the region has 3 bytes, .* has 40590"),
    ({"region": pb.RegionOfInterest()}, SettingsError, "mask of the region has 0 bytes"),
]


@pytest.mark.parametrize(("fields", "kind", "sentence"), BAD, ids=[str(bad[0])[:40] for bad in BAD])
def test_each_bad_field_gets_its_sentence(fields: dict[str, Any], kind: type[MemtrackError], sentence: str) -> None:
    with pytest.raises(kind, match=sentence) as refused:
        read_header(pb.FilmHeader(**{**GOOD, **fields}), Limits())
    assert "\n" not in str(refused.value)


def test_the_limit_on_a_frame_holds_at_the_models_scale_too() -> None:
    geometry = FilmGeometry(1000, 500, 1, np.dtype("u1"))
    limits = Limits(max_frame_pixels=2_000_000)
    check_scaled(geometry, 2.0, limits)
    with pytest.raises(ResourceLimitError, match=r"1000 x 500 pixels, enlarged 2\.1 times .* more than the 2000000"):
        check_scaled(geometry, 2.1, limits)


numbers = st.floats(allow_nan=True, allow_infinity=True)
sizes = st.integers(-(2**31), 2**31 - 1) | st.integers(-2, 70)


@given(
    st.fixed_dictionaries(
        {"protocol": st.sampled_from([1, 1, 1, 0, 5]), "width": sizes, "height": sizes, "frame_count": sizes},
        optional={
            "pixel_type": st.integers(0, 5),
            "pixel_size_um": numbers,
            "frame_interval_seconds": numbers,
            "cell_length_px": numbers,
            "model_name": st.text(max_size=80),
            "model_version": st.text(max_size=80),
            "criterion": st.integers(0, 4),
            "thresholds": st.builds(pb.LevelThresholds, low=numbers, medium=numbers, high=numbers),
            "max_size_px": numbers,
            "nms_iou": numbers,
            "no_stabilisation": st.booleans(),
            "resting": st.booleans(),
            "region": st.builds(pb.RegionOfInterest, mask=st.binary(max_size=600)),
        },
    )
)
@example({**GOOD, "width": 8, "height": 8, "region": pb.RegionOfInterest(mask=b"12345678")})
def test_any_header_is_understood_or_refused_within_the_limits(fields: dict[str, Any]) -> None:
    limits = Limits(max_film_bytes=1 << 20)
    try:
        request = read_header(pb.FilmHeader(**fields), limits)
    except MemtrackError:
        return
    assert 0 < request.geometry.film_bytes <= limits.max_film_bytes
    for value in (request.calibration.pixel_size_um, request.calibration.frame_interval_seconds):
        assert value is None or 0 < value < INFINITY
