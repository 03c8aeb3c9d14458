# SPDX-License-Identifier: GPL-3.0-or-later
"""What DetectFilm refuses, and with which sentence; the server goes on."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from typing import Any

import grpc
import numpy as np
import pytest

from memtrack.models import load_model
from memtrack.v1 import detection_pb2 as pb
from server.running import RunningServer, answer, check_order, chunks, eventually, header, noise, requests


def refusal(server: RunningServer, sent: Any) -> tuple[grpc.StatusCode, str]:
    """Status and sentence a call ends with."""
    with pytest.raises(grpc.RpcError) as refused:
        answer(server.call(sent))
    return refused.value.code(), refused.value.details() or ""


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_values_that_are_not_finite_are_refused(server: RunningServer, bad: float) -> None:
    film = noise(4, 20, 20, "float32")
    film[2, 3, 4] = bad
    status, sentence = refusal(server, requests(film))
    assert status is grpc.StatusCode.INVALID_ARGUMENT
    assert "frame 3 of the 4 used" in sentence


def test_a_stream_that_does_not_add_up_is_refused(server: RunningServer) -> None:
    film = noise(3, 20, 30)
    head = pb.DetectFilmRequest(header=header(film))
    invalid = grpc.StatusCode.INVALID_ARGUMENT
    first_wrong = (invalid, "the first message of a film must be its header")
    assert refusal(server, []) == first_wrong
    assert refusal(server, chunks(film)) == first_wrong
    assert refusal(server, [pb.DetectFilmRequest()]) == first_wrong
    assert refusal(server, [head]) == (invalid, "the film ended after 0 of 3 frames")
    assert refusal(server, [head, *chunks(film[:2])]) == (invalid, "the film ended after 2 of 3 frames")
    assert refusal(server, [head, *chunks(film), *chunks(film[:1], first=3)]) == (
        invalid,
        "more samples came after the last of 3 frames (frame 3, 600 bytes)",
    )
    assert refusal(server, [head, head]) == (invalid, "only chunks of frames may follow the header")
    assert refusal(server, [head, pb.DetectFilmRequest()]) == (invalid, "only chunks of frames may follow the header")
    eventually(lambda: server.spools() == 0, "the spools are gone")


def test_a_pixel_size_that_cannot_be_is_refused_before_the_film_is_sent(server: RunningServer) -> None:
    head = pb.DetectFilmRequest(header=header(noise(3, 20, 30), pixel_size_um=352.8))
    status, sentence = refusal(server, [head])
    assert status is grpc.StatusCode.INVALID_ARGUMENT
    assert sentence.startswith("a pixel size of 352.8 um means scaling the frames by 670")
    large = pb.FilmHeader(
        protocol=1, width=8000, height=4000, frame_count=1, pixel_type="PIXEL_TYPE_UINT8", pixel_size_um=1.5
    )
    status, sentence = refusal(server, [pb.DetectFilmRequest(header=large)])
    assert status is grpc.StatusCode.RESOURCE_EXHAUSTED
    assert "a frame of 8000 x 4000 pixels, enlarged 2.85 times" in sentence


def test_a_greatest_size_that_would_drop_every_box_is_refused_before_the_film_is_sent(server: RunningServer) -> None:
    status, sentence = refusal(server, [pb.DetectFilmRequest(header=header(noise(3, 20, 30), max_size_px=20))])
    assert status is grpc.StatusCode.INVALID_ARGUMENT
    assert sentence.startswith("max_size_px is 20, but all boxes of model default ")


def test_a_chunk_of_one_mebibyte_is_taken_and_one_byte_more_is_not(server: RunningServer) -> None:
    limit = 1 << 20
    row = np.zeros((1, 1, limit + 1), np.uint8)
    found = answer(server.call(requests(row[:, :, :limit])))
    assert found.summary[0].frame_count == 1
    assert refusal(server, requests(row, limit + 1)) == (
        grpc.StatusCode.INVALID_ARGUMENT,
        f"a chunk of frame 0 has {limit + 1} bytes, at most {limit} are allowed",
    )
    status, _ = refusal(server, requests(np.zeros((1, 1, 17 * limit), np.uint8), 17 * limit))
    assert status is grpc.StatusCode.RESOURCE_EXHAUSTED


def test_another_protocol_an_unknown_model_and_a_film_too_large_are_refused_on_the_header(
    server: RunningServer,
) -> None:
    film = noise(2, 10, 10)
    assert refusal(server, requests(film, protocol=2)) == (
        grpc.StatusCode.INVALID_ARGUMENT,
        "the plug-in speaks protocol 2 and the model server 1; install the same version of both",
    )
    status, sentence = refusal(server, requests(film, model_name="no-such-model"))
    assert status is grpc.StatusCode.NOT_FOUND
    assert "no-such-model" in sentence
    assert "default" in sentence
    status, sentence = refusal(server, requests(film, model_name="../../etc"))
    assert status is grpc.StatusCode.INVALID_ARGUMENT
    status, sentence = refusal(server, requests(film, width=8000, height=8000, frame_count=2000))
    assert status is grpc.StatusCode.RESOURCE_EXHAUSTED
    assert sentence.startswith("the film has 128.0 GB, the server takes 68.7 GB; ")


def test_a_damaged_model_and_a_missing_engine_are_refused(tmp_path: Path) -> None:
    shipped = load_model().folder
    registry = tmp_path / "models"
    for name in ("damaged", "torch-only"):
        shutil.copytree(shipped, registry / name / "1")
        card = json.loads((shipped / "model.json").read_text(encoding="utf-8")) | {"name": name}
        if name == "torch-only":
            card["files"] = {"weights.safetensors": card["files"]["weights.safetensors"]}
        (registry / name / "1" / "model.json").write_text(json.dumps(card), encoding="utf-8")
    weights = registry / "damaged" / "1" / "weights.safetensors"
    weights.write_bytes(weights.read_bytes()[:-1])
    without_torch = tmp_path / "without"
    (without_torch / "torch").mkdir(parents=True)
    (without_torch / "torch" / "__init__.py").write_text("raise ImportError('no torch here')", encoding="utf-8")
    path = os.pathsep.join([str(without_torch), os.environ.get("PYTHONPATH", "")])
    with RunningServer(tmp_path, environment={"MEMTRACK_MODELS": str(registry), "PYTHONPATH": path}) as server:
        status, sentence = refusal(server, requests(noise(2, 20, 20), model_name="damaged"))
        assert status is grpc.StatusCode.FAILED_PRECONDITION
        assert "weights.safetensors of model damaged 1 is missing or damaged" in sentence
        head = pb.DetectFilmRequest(header=header(noise(2, 20, 20), model_name="torch-only"))
        status, sentence = refusal(server, [head])
        assert status is grpc.StatusCode.FAILED_PRECONDITION
        assert "needs PyTorch" in sentence
        check_order(server.detect(noise(2, 20, 20)), 2)


def test_garbage_on_the_wire_is_refused_and_the_server_goes_on(server: RunningServer) -> None:
    world = np.random.default_rng(7)
    raw: Any = server.channel.stream_stream("/memtrack.v1.DetectionService/DetectFilm")
    good = next(requests(noise(2, 10, 10))).SerializeToString()
    for i in range(200):
        if i % 2:
            message = world.bytes(int(world.integers(0, 64)))
        else:
            damaged = bytearray(good)
            damaged[int(world.integers(len(damaged)))] = int(world.integers(256))
            message = bytes(damaged)
        with pytest.raises(grpc.RpcError) as refused:
            list(raw(iter([message]), metadata=server.metadata, timeout=20))
        # Bytes gRPC cannot parse are refused by gRPC itself, as INTERNAL or UNKNOWN.
        assert refused.value.code() in {
            grpc.StatusCode.INVALID_ARGUMENT,
            grpc.StatusCode.NOT_FOUND,
            grpc.StatusCode.RESOURCE_EXHAUSTED,
            grpc.StatusCode.INTERNAL,
            grpc.StatusCode.UNKNOWN,
        }
        assert "failed unexpectedly" not in str(refused.value.details())
    check_order(server.detect(noise(2, 10, 10)), 2)
    eventually(lambda: server.spools() == 0, "the spools are gone")
