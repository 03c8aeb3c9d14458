# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack serve`: options of the model server."""

from __future__ import annotations

import argparse
import logging
import sys
from pathlib import Path

from memtrack.config import Limits, ServerConfig
from memtrack.errors import SettingsError
from memtrack.server import serve


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of the subcommand; each default is the one of ServerConfig or Limits."""
    config, limits = ServerConfig(), Limits()
    add = parser.add_argument
    add("--host", default=config.host, help="address to listen on (default: %(default)s, this machine only)")
    add("--port", type=int, default=config.port, help="port to listen on; 0, the default, takes any free one")
    token = parser.add_mutually_exclusive_group().add_argument
    token("--token-from-stdin", action="store_true", help="read the token callers must send from the first line of "
        "standard input, and end when standard input is closed")  # fmt: skip
    token("--token-file", type=Path, metavar="FILE", help="read that token from the first line of a file, and go on "
        "when standard input is closed")  # fmt: skip
    add("--parent-pid", type=int, help="end when this process does")
    add("--tls-cert", type=Path, help="certificate chain in PEM; needed on an address other machines can reach")
    add("--tls-key", type=Path, help="private key in PEM")
    add("--spool-folder", type=Path, default=config.spool_folder, help="where films lie while they are worked on "
        "(default: %(default)s)")  # fmt: skip
    add("--max-film-bytes", type=int, default=limits.max_film_bytes, help="largest film taken (default: %(default)s)")
    add("--max-films", type=int, default=limits.max_films, help="films taken at the same time (default: %(default)s)")
    add("--threads", type=int, default=config.threads, help="threads of the net (default here: %(default)s)")
    add("--idle-seconds", type=float, default=limits.idle_seconds, help="a film is given up when no frame comes for "
        "this long (default: %(default)s)")  # fmt: skip
    add("--grace-seconds", type=float, default=config.grace_seconds, help="what films get to finish after SIGTERM or "
        "Ctrl-C (default: %(default)s)")  # fmt: skip


def run(options: argparse.Namespace) -> int:
    """Serves until the process is told to end."""
    logging.basicConfig(level=logging.INFO, stream=sys.stderr, format="%(asctime)s %(levelname)s %(message)s")
    if not options.spool_folder.is_dir():
        raise SettingsError(f"the spool folder {options.spool_folder} does not exist; make it or give another one")
    config = ServerConfig(
        host=options.host,
        port=options.port,
        token=_token(options),
        tls_certificate=options.tls_cert,
        tls_key=options.tls_key,
        spool_folder=options.spool_folder,
        parent_pid=options.parent_pid,
        grace_seconds=options.grace_seconds,
        threads=options.threads,
        limits=Limits(
            max_film_bytes=options.max_film_bytes, max_films=options.max_films, idle_seconds=options.idle_seconds
        ),
    )
    return serve(config, watch_input=options.token_from_stdin)


def _token(options: argparse.Namespace) -> str | None:
    """What callers must send; None lets every program of this machine in."""
    if options.token_file is not None:
        return _token_in(options.token_file)
    if not options.token_from_stdin:
        return None
    token = sys.stdin.readline().strip()
    if not token:
        raise SettingsError("no token came on standard input; write it there as the first line")
    return token


def _token_in(file: Path) -> str:
    try:
        with file.open(encoding="utf-8-sig") as lines:
            token = lines.readline().strip()
    except OSError as error:
        raise SettingsError(f"cannot read the token file {file}: {error.strerror}; give a file with a token") from error
    except UnicodeDecodeError:
        token = ""
    if not token:
        raise SettingsError(f"no token is in {file}; write it there as the first line, in plain text")
    return token
