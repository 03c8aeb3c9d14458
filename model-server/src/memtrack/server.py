# SPDX-License-Identifier: GPL-3.0-or-later
"""The model server as a process: bind, say where, serve until the end is wished for, and leave nothing behind."""

from __future__ import annotations

import json
import logging
import os
import ssl
import sys
from concurrent import futures
from pathlib import Path

import grpc
from grpc_health.v1 import health, health_pb2, health_pb2_grpc
from grpc_reflection.v1alpha import reflection

from memtrack import __version__
from memtrack.access import TokenInterceptor
from memtrack.config import CHUNK_BYTES, PROTOCOL, ServerConfig
from memtrack.errors import SettingsError
from memtrack.lifetime import Ending, on_death_of, on_end_of_input, on_signals
from memtrack.server_info import ServerService
from memtrack.service import DetectionService
from memtrack.spool import SpoolFolder, sweep
from memtrack.v1 import detection_pb2, detection_pb2_grpc, server_pb2, server_pb2_grpc

SERVICES = (
    detection_pb2.DESCRIPTOR.services_by_name["DetectionService"].full_name,
    server_pb2.DESCRIPTOR.services_by_name["ServerService"].full_name,
)
OPTIONS = (
    # A lab's proxy is not for the loopback.
    ("grpc.enable_http_proxy", 0),
    # A second server on the same port is an error, not a lottery.
    ("grpc.so_reuseport", 0),
    # The largest message is a header with the mask of a region, one bit a pixel.
    ("grpc.max_receive_message_length", 16 * CHUNK_BYTES),
    ("grpc.max_metadata_size", 16 << 10),
    # A client whose machine is gone is noticed within a minute, also while it only listens.
    ("grpc.keepalive_time_ms", 30_000),
    ("grpc.keepalive_timeout_ms", 20_000),
    ("grpc.http2.min_ping_interval_without_data_ms", 5_000),
)
_HARD_EXIT_SECONDS = 2.0
_log = logging.getLogger(__name__)


def serve(config: ServerConfig, *, watch_input: bool = False) -> int:
    """Serves until a signal, the parent's death or, if watched, the end of standard input; then ends the process.

    The first line on standard output is JSON with protocol, port, pid and version; nothing else is printed there.

    Raises:
        SettingsError: the address or the TLS files cannot be used.
    """
    ending = Ending()
    on_signals(ending)
    swept = sweep(config.spool_folder)
    if swept:
        _log.info("deleted %d spool file(s) of servers that died", swept)
    server, detection, healths, port = start(config)
    print(json.dumps({"protocol": PROTOCOL, "port": port, "pid": os.getpid(), "version": __version__}), flush=True)
    if config.token is None:
        _log.warning("no token: every program on this machine may use this server")
    if watch_input:
        on_end_of_input(ending)
    if config.parent_pid is not None:
        on_death_of(config.parent_pid, ending)
    ending.wait()
    _log.info("ending: %s", ending.reason)
    stop(server, detection, healths, grace_seconds=0 if ending.at_once else config.grace_seconds)
    # Threads of native libraries may hold an orderly exit up for ever; nothing is left to save.
    sys.stderr.flush()
    os._exit(0)


def start(config: ServerConfig) -> tuple[grpc.Server, DetectionService, health.HealthServicer, int]:
    """A running server, its detection service, its health, and its port."""
    # A film needs one thread for as long as it lasts; the rest answer the short calls.
    pool = futures.ThreadPoolExecutor(config.limits.max_films + 16, "call")
    interceptors: list[grpc.ServerInterceptor] = [] if config.token is None else [TokenInterceptor(config.token)]
    server = grpc.server(pool, options=OPTIONS, interceptors=interceptors)
    spool = SpoolFolder(config.spool_folder)
    detection = DetectionService(spool, config.limits, config.threads)
    detection_pb2_grpc.add_DetectionServiceServicer_to_server(detection, server)
    server_pb2_grpc.add_ServerServiceServicer_to_server(ServerService(spool, config.limits), server)
    healths = health.HealthServicer()
    health_pb2_grpc.add_HealthServicer_to_server(healths, server)
    if config.is_local:
        reflection.enable_server_reflection((*SERVICES, health.SERVICE_NAME, reflection.SERVICE_NAME), server)
    port = _bind(server, config)
    server.start()
    for name in ("", *SERVICES):
        healths.set(name, health_pb2.HealthCheckResponse.SERVING)
    return server, detection, healths, port


def stop(
    server: grpc.Server, detection: DetectionService, healths: health.HealthServicer, *, grace_seconds: float
) -> None:
    """Takes no more calls, gives those at work `grace_seconds`, then ends them with a sentence."""
    healths.enter_graceful_shutdown()
    stopped = server.stop(grace_seconds + _HARD_EXIT_SECONDS)
    if not stopped.wait(grace_seconds):
        detection.close()
        stopped.wait(_HARD_EXIT_SECONDS)


def _bind(server: grpc.Server, config: ServerConfig) -> int:
    try:
        if config.tls_certificate is None or config.tls_key is None:
            return server.add_insecure_port(config.address)
        return server.add_secure_port(config.address, _credentials(config.tls_certificate, config.tls_key))
    except RuntimeError as error:
        raise SettingsError(
            f"cannot listen on {config.address}; the port is in use or the address is not this machine's, "
            "choose another one, or port 0 for any free port"
        ) from error


def _credentials(certificate: Path, key: Path) -> grpc.ServerCredentials:
    """The TLS files, tried out first: gRPC says of wrong ones only that it cannot bind."""
    try:
        pair = (key.read_bytes(), certificate.read_bytes())
        ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(certificate, key, password=lambda: "")
        return grpc.ssl_server_credentials([pair])
    except ssl.SSLError as error:
        raise SettingsError(
            f"the certificate {certificate} and the key {key} cannot be used ({error}); "
            "give a certificate and its own key, both in PEM and without a password"
        ) from error
    except OSError as error:
        raise SettingsError(f"cannot read {error.filename}: {error.strerror}; check the TLS files") from error
