# SPDX-License-Identifier: GPL-3.0-or-later
"""How the server starts: what it says, what it refuses, what it clears away."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

import grpc
import pytest
import trustme
from grpc_health.v1 import health_pb2, health_pb2_grpc

from memtrack import __version__
from memtrack.models import CARD, WEIGHTS, load_model
from memtrack.v1 import server_pb2, server_pb2_grpc
from server.running import PATIENCE_SECONDS, TOKEN, RunningServer


def test_the_first_line_tells_protocol_port_pid_and_version(spool_folder: Path) -> None:
    begun = time.monotonic()
    with RunningServer(spool_folder) as server:
        seconds = time.monotonic() - begun
        assert server.hello == {
            "protocol": 1,
            "port": server.hello["port"],
            "pid": server.process.pid,
            "version": __version__,
        }
        assert 1024 <= server.hello["port"] <= 65535
        health = health_pb2_grpc.HealthStub(server.channel)
        for service in ("", "memtrack.v1.DetectionService", "memtrack.v1.ServerService"):
            answer = health.Check(health_pb2.HealthCheckRequest(service=service))
            assert answer.status == health_pb2.HealthCheckResponse.SERVING
    # Below 0.5 s on an idle machine; the libraries that compute are loaded by the first film.
    assert seconds < 5


def test_nothing_but_the_first_line_goes_to_standard_output(spool_folder: Path) -> None:
    server = RunningServer(spool_folder)
    assert server.process.stdin is not None
    assert server.process.stdout is not None
    server.process.stdin.close()
    assert server.process.stdout.read() == ""
    assert server.end() == 0


def test_without_a_token_the_loopback_is_open_and_the_log_says_so(spool_folder: Path) -> None:
    with RunningServer(spool_folder, token=None) as server:
        assert server.server.GetServerInfo(server_pb2.GetServerInfoRequest()).protocol == 1
        assert "no token: every program on this machine may use this server" in server.log
        server.process.terminate()
        assert server.process.wait(PATIENCE_SECONDS) == 0


def test_server_info_tells_versions_limits_and_working_devices(spool_folder: Path) -> None:
    with RunningServer(spool_folder, "--max-film-bytes", "123456789") as server:
        quick = server.server.GetServerInfo(server_pb2.GetServerInfoRequest(), metadata=server.metadata)
        assert (quick.protocol, quick.version, quick.max_film_bytes) == (1, __version__, 123456789)
        assert quick.python_version == ".".join(map(str, sys.version_info[:3]))
        assert {"numpy", "grpcio", "openvino"} <= set(quick.libraries)
        assert quick.spool_free_bytes > 0
        assert list(quick.devices) == []
        tested = server.server.GetServerInfo(
            server_pb2.GetServerInfoRequest(test_devices=True), metadata=server.metadata
        )
        assert "openvino CPU" in tested.devices


def test_the_models_are_listed_with_their_cards(server: RunningServer) -> None:
    models = server.server.ListModels(server_pb2.ListModelsRequest(), metadata=server.metadata).models
    default = next(model for model in models if model.name == "default")
    assert len(default.sha256) == 64
    assert default.min_cell_length_px <= default.max_cell_length_px
    for thresholds in (default.max_precision, default.max_f1):
        assert all(0 < value < 1 for value in (thresholds.low, thresholds.medium, thresholds.high))


def test_a_damaged_model_is_left_out_of_the_list(spool_folder: Path, tmp_path: Path) -> None:
    for name in ("good", "damaged"):
        shutil.copytree(load_model().folder, tmp_path / "models" / name / "1")
        card = tmp_path / "models" / name / "1" / CARD
        values = json.loads(card.read_text(encoding="utf-8")) | {"name": name, "version": "1"}
        card.write_text(json.dumps(values), encoding="utf-8")
    (tmp_path / "models/damaged/1" / WEIGHTS).write_bytes(b"damaged")
    with RunningServer(spool_folder, environment={"MEMTRACK_MODELS": str(tmp_path / "models")}) as server:
        models = server.server.ListModels(server_pb2.ListModelsRequest(), metadata=server.metadata).models
        assert {"good", "default", "crowded"} == {model.name for model in models}
        assert "left out: weights.safetensors of model damaged 1 is missing or damaged" in server.log


def _refusal(*options: str, line: str = "") -> str:
    """What `memtrack serve` says when it ends with code 2."""
    done = subprocess.run(
        [sys.executable, "-m", "memtrack", "serve", *options],
        input=line,
        capture_output=True,
        encoding="utf-8",
        timeout=PATIENCE_SECONDS,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    return done.stderr


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.1", "example.org"])
def test_other_machines_are_let_in_only_with_tls_and_a_token(host: str) -> None:
    assert f"{host} can be reached from other machines, which needs TLS and a token" in _refusal("--host", host)
    assert "needs TLS" in _refusal("--host", host, "--token-from-stdin", line="token\n")


def test_a_token_from_a_file_is_asked_for_and_the_server_goes_on_without_standard_input(
    spool_folder: Path, tmp_path: Path
) -> None:
    file = tmp_path / "token"
    file.write_text(f"{TOKEN}\na second line\n", encoding="utf-8")
    with RunningServer(spool_folder, "--token-file", str(file), token=None) as server:
        assert server.process.stdin is not None
        server.process.stdin.close()
        info, asked = server.server.GetServerInfo, server_pb2.GetServerInfoRequest()
        with pytest.raises(grpc.RpcError, match="the token is missing or wrong"):
            info(asked, timeout=PATIENCE_SECONDS)
        assert info(asked, metadata=[("authorization", f"Bearer {TOKEN}")], timeout=PATIENCE_SECONDS).protocol == 1
        server.process.terminate()
        assert server.process.wait(PATIENCE_SECONDS) == 0


def test_a_token_file_without_a_token_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "token"
    assert f"cannot read the token file {file}: No such file" in _refusal("--token-file", str(file))
    for content in (b"", b"\ntoken\n", "token".encode("utf-16")):
        file.write_bytes(content)
        said = f"no token is in {file}; write it there as the first line"
        assert said in _refusal("--token-file", str(file))
    assert "not allowed with" in _refusal("--token-file", str(file), "--token-from-stdin")


def test_a_port_in_use_is_said(spool_folder: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert f"cannot listen on 127.0.0.1:{port}; the port is in use" in _refusal("--port", str(port))


def test_unusable_options_get_one_sentence(tmp_path: Path) -> None:
    assert "port 70000 does not exist" in _refusal("--port", "70000")
    for option, name in (("--max-films", "max_films"), ("--max-film-bytes", "max_film_bytes")):
        assert f"{name} is 0; give a number above 0" in _refusal(option, "0")
    for bad in ("-1", "0", "nan"):
        assert f"idle_seconds is {float(bad)}; give a number above 0" in _refusal("--idle-seconds", bad)
    assert "grace_seconds is -1.0; give a number from 0 to 86400" in _refusal("--grace-seconds", "-1")
    assert "TLS needs both a certificate and its key" in _refusal("--tls-cert", "x.pem")
    assert "no token came on standard input" in _refusal("--token-from-stdin", line="\n")
    missing = tmp_path / "missing"
    assert f"the spool folder {missing} does not exist" in _refusal("--spool-folder", str(missing))
    pair = ("--tls-cert", str(missing), "--tls-key", str(missing))
    assert f"cannot read {missing}: No such file" in _refusal(*pair)


def test_tls_files_that_cannot_be_used_are_not_called_a_port_in_use(tmp_path: Path) -> None:
    authority = trustme.CA()
    one, other = (authority.issue_cert("localhost") for _ in range(2))
    certificate, key, text = tmp_path / "cert.pem", tmp_path / "key.pem", tmp_path / "text.pem"
    one.cert_chain_pems[0].write_to_path(certificate)
    other.private_key_pem.write_to_path(key)
    text.write_text("not a certificate", encoding="utf-8")
    for pair in ((certificate, key), (text, key), (certificate, text)):
        said = _refusal("--tls-cert", str(pair[0]), "--tls-key", str(pair[1]))
        assert f"the certificate {pair[0]} and the key {pair[1]} cannot be used (" in said
        assert "give a certificate and its own key" in said


def test_tls_serves_who_trusts_the_certificate(spool_folder: Path) -> None:
    authority = trustme.CA()
    issued = authority.issue_cert("localhost", "127.0.0.1")
    certificate, key = spool_folder / "cert.pem", spool_folder / "key.pem"
    issued.private_key_pem.write_to_path(key)
    issued.cert_chain_pems[0].write_to_path(certificate)
    with RunningServer(spool_folder, "--host", "0.0.0.0", "--tls-cert", str(certificate), "--tls-key", str(key)) as s:
        trusting = grpc.ssl_channel_credentials(authority.cert_pem.bytes())
        with grpc.secure_channel(s.address, trusting) as channel:
            info = server_pb2_grpc.ServerServiceStub(channel).GetServerInfo(
                server_pb2.GetServerInfoRequest(), metadata=s.metadata, timeout=PATIENCE_SECONDS
            )
        assert info.protocol == 1
        with pytest.raises(grpc.RpcError) as refused:
            s.server.GetServerInfo(server_pb2.GetServerInfoRequest(), metadata=s.metadata, timeout=PATIENCE_SECONDS)
        assert refused.value.code() is grpc.StatusCode.UNAVAILABLE


def test_spools_of_dead_servers_are_swept_and_nothing_else(spool_folder: Path) -> None:
    stale, fresh, foreign = (spool_folder / n for n in ("memtrack-spool-a.raw", "memtrack-spool-b.raw", "film.raw"))
    for file in (stale, fresh, foreign):
        file.write_bytes(b"x")
    for file in (stale, foreign):
        os.utime(file, (1, 1))
    with RunningServer(spool_folder, token=TOKEN) as server:
        assert "deleted 1 spool file(s)" in server.log
        assert [stale.exists(), fresh.exists(), foreign.exists()] == [False, True, True]
