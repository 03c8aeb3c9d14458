# SPDX-License-Identifier: GPL-3.0-or-later
"""The service without a server: what gRPC does only now and then."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import NoReturn
from unittest.mock import create_autospec

import grpc
import pytest

from memtrack.config import Limits
from memtrack.service import DetectionService
from memtrack.spool import SpoolFolder
from memtrack.v1 import detection_pb2 as pb


class Aborted(Exception):
    """How gRPC leaves a call that the service aborts."""


@pytest.fixture
def service(tmp_path: Path) -> DetectionService:
    return DetectionService(SpoolFolder(tmp_path), Limits(max_films=1), 1)


def call(service: DetectionService, *, alive: bool = True) -> list[pb.DetectFilmResponse]:
    context = create_autospec(grpc.ServicerContext, instance=True)
    context.add_callback.return_value = alive
    context.abort.side_effect = _abort
    return list(service.DetectFilm(iter([]), context))


def _abort(code: grpc.StatusCode, details: str) -> NoReturn:
    raise Aborted(details)


def test_a_call_that_was_cancelled_before_its_turn_leaves_its_place_to_others(service: DetectionService) -> None:
    assert call(service, alive=False) == []
    with pytest.raises(Aborted, match="the first message of a film must be its header"):
        call(service)


def test_a_call_that_gets_no_thread_leaves_its_place_to_others(
    service: DetectionService, monkeypatch: pytest.MonkeyPatch
) -> None:
    def start(self: threading.Thread) -> None:
        raise RuntimeError("can't start new thread")

    with monkeypatch.context() as patch:
        patch.setattr(threading.Thread, "start", start)
        with pytest.raises(Aborted, match="can't start new thread"):
            call(service)
    with pytest.raises(Aborted, match="the first message of a film must be its header"):
        call(service)
