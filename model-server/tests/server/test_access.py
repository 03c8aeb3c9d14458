# SPDX-License-Identifier: GPL-3.0-or-later
"""Who may call."""

from __future__ import annotations

import grpc
import pytest
from grpc_health.v1 import health_pb2, health_pb2_grpc
from grpc_reflection.v1alpha import reflection_pb2, reflection_pb2_grpc

from memtrack.v1 import server_pb2
from server.running import TOKEN, RunningServer, answer, noise, requests

WRONG = {
    "missing": [],
    "empty": [("authorization", "")],
    "another token": [("authorization", "Bearer another token")],
    "a token that only begins right": [("authorization", f"Bearer {TOKEN}x")],
    "no scheme": [("authorization", TOKEN)],
    "another scheme": [("authorization", f"Basic {TOKEN}")],
    "given twice": [("authorization", f"Bearer {TOKEN}")] * 2,
    "not ASCII": [("authorization-bin", b"\xff")],
}


@pytest.mark.parametrize("metadata", WRONG.values(), ids=WRONG)
def test_a_wrong_token_is_refused_before_any_message(server: RunningServer, metadata: list[tuple[str, str]]) -> None:
    with pytest.raises(grpc.RpcError) as refused:
        server.server.GetServerInfo(server_pb2.GetServerInfoRequest(), metadata=metadata, timeout=10)
    assert refused.value.code() is grpc.StatusCode.UNAUTHENTICATED
    assert refused.value.details() == (
        "the token is missing or wrong; connect with the token this model server was started with"
    )
    with pytest.raises(grpc.RpcError) as refused:
        answer(server.detection.DetectFilm(requests(noise(2, 8, 8)), metadata=metadata, timeout=10))
    assert refused.value.code() is grpc.StatusCode.UNAUTHENTICATED


def test_the_right_token_lets_in(server: RunningServer) -> None:
    info = server.server.GetServerInfo(server_pb2.GetServerInfoRequest(), metadata=server.metadata, timeout=10)
    assert info.protocol == 1


def test_health_needs_no_token(server: RunningServer) -> None:
    health = health_pb2_grpc.HealthStub(server.channel).Check(health_pb2.HealthCheckRequest(), timeout=10)
    assert health.status == health_pb2.HealthCheckResponse.SERVING


def test_reflection_needs_the_token(server: RunningServer) -> None:
    stub = reflection_pb2_grpc.ServerReflectionStub(server.channel)
    asked = [reflection_pb2.ServerReflectionRequest(list_services="")]
    listed = next(stub.ServerReflectionInfo(iter(asked), metadata=server.metadata, timeout=10))
    assert {service.name for service in listed.list_services_response.service} == {
        "memtrack.v1.DetectionService",
        "memtrack.v1.ServerService",
        "grpc.health.v1.Health",
        "grpc.reflection.v1alpha.ServerReflection",
    }
    with pytest.raises(grpc.RpcError) as refused:
        next(stub.ServerReflectionInfo(iter(asked), timeout=10))
    assert refused.value.code() is grpc.StatusCode.UNAUTHENTICATED
