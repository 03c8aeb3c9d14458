# SPDX-License-Identifier: GPL-3.0-or-later
"""What the server is told at its start: where it listens, who may call it and how much it takes."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from pathlib import Path

from memtrack.errors import SettingsError
from memtrack.libraries import engine_threads
from memtrack.spool import default_folder

PROTOCOL = 1
"""Version of the contract in proto/memtrack/v1."""

CHUNK_BYTES = 1 << 20
"""Most bytes of samples in one message."""

MAX_GRACE_SECONDS = 86400.0


@dataclass(frozen=True, slots=True)
class Limits:
    """What one film may take; each is checked on the header, before any work.

    max_film_bytes: all samples of a film. max_frame_pixels: width x height, since a few whole frames are held in
    memory. max_frames: frames of a film. max_films: films received or worked on at the same time. idle_seconds: how
    long a client may stay silent before its film is complete.

    Raises:
        SettingsError: a limit is not above 0, so that no film could be taken.
    """

    max_film_bytes: int = 64 << 30
    max_frame_pixels: int = 64 << 20
    max_frames: int = 1_000_000
    max_films: int = 16
    idle_seconds: float = 120.0

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if not value > 0:
                raise SettingsError(f"{name} is {value}; give a number above 0")


@dataclass(frozen=True, slots=True)
class ServerConfig:
    """Address, access and limits of a server.

    host, port: where it listens; port 0 lets the system choose. token: what callers must send; None lets every local
    program in. tls_certificate, tls_key: PEM files. spool_folder: where films lie while they are worked on.
    parent_pid: the server ends when this process does. grace_seconds: what films get to finish at the end.
    threads: threads a net runs on.

    Raises:
        SettingsError: the combination would let strangers in, or cannot work.
    """

    host: str = "127.0.0.1"
    port: int = 0
    token: str | None = None
    tls_certificate: Path | None = None
    tls_key: Path | None = None
    spool_folder: Path = field(default_factory=default_folder)
    parent_pid: int | None = None
    grace_seconds: float = 5.0
    threads: int = field(default_factory=engine_threads)
    limits: Limits = field(default_factory=Limits)

    def __post_init__(self) -> None:
        if not 0 <= self.port <= 65535:
            raise SettingsError(f"port {self.port} does not exist; give one from 1 to 65535, or 0 for any free one")
        if not 1 <= self.threads <= 256:
            raise SettingsError(f"threads is {self.threads}; give a number from 1 to 256")
        if not 0 <= self.grace_seconds <= MAX_GRACE_SECONDS:
            raise SettingsError(f"grace_seconds is {self.grace_seconds}; give a number from 0 to {MAX_GRACE_SECONDS:g}")
        if (self.tls_certificate is None) != (self.tls_key is None):
            raise SettingsError("TLS needs both a certificate and its key; give --tls-cert and --tls-key")
        if not self.is_local and (self.tls_certificate is None or not self.token):
            raise SettingsError(
                f"{self.host} can be reached from other machines, which needs TLS and a token; "
                "add --tls-cert, --tls-key and --token-file, or listen on 127.0.0.1"
            )

    @property
    def is_local(self) -> bool:
        """True when only this machine can reach the address."""
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False

    @property
    def address(self) -> str:
        """Host and port as gRPC wants them."""
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"
