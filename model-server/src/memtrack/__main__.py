# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `memtrack`: one subcommand a module of `memtrack.cli`, imported only when it is used."""

from __future__ import annotations

import argparse
import importlib
import io
import os
import sys
from collections.abc import Sequence

from memtrack import __version__
from memtrack.errors import MemtrackError

SUBCOMMANDS = {
    "serve": "answer the Fiji plug-in: detection as a gRPC service",
    "detect": "detect the bacteria of one film into a table",
    "simulate": "make films of bacteria with known tracks",
    "train": "train a model on annotated or simulated films",
    "evaluate": "compare detections or tracks with a ground truth",
    "models": "list the models, or check one",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs one subcommand; 0 on success, 2 with one sentence on standard error for what a user can mend."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding="utf-8", errors="replace")
    # Before numpy is imported: frames are worked on side by side as it is, and numpy's own threads wait for each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    words = list(sys.argv[1:] if arguments is None else arguments)
    parser = argparse.ArgumentParser(
        prog="memtrack", description="Finds bacteria and microrobots in films of dense, low-contrast media."
    )
    parser.add_argument("--version", action="version", version=f"memtrack {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, summary in SUBCOMMANDS.items():
        command = commands.add_parser(name, help=summary, description=summary[0].upper() + summary[1:] + ".")
        if words[:1] == [name]:
            module = importlib.import_module(f"memtrack.cli.{name}")
            module.add_arguments(command)
            command.set_defaults(run=module.run)
    try:
        options = parser.parse_args(words)
        return int(options.run(options))
    except MemtrackError as error:
        sentence = str(error)
    except OSError as error:
        place = "" if error.filename is None else f"{error.filename}: "
        sentence = f"{place}{error.strerror or error}; check the file, its rights and the space on the disk"
    except MemoryError:
        sentence = "there is not enough memory; close other programs, or use fewer or smaller frames"
    except KeyboardInterrupt:
        return 130
    print(f"memtrack: {sentence}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
