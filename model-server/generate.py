# SPDX-License-Identifier: GPL-3.0-or-later
"""Generates src/memtrack/v1/*_pb2.py, *_pb2.pyi and *_pb2_grpc.py from the contract.

Runs in every build of the wheel (setup.py), and by hand after a change of the contract:

    python model-server/generate.py
"""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def contract() -> Path:
    """The folder proto/ of the repository, or the copy that a source archive carries."""
    for folder in (HERE.parent / "proto", HERE / "proto"):
        if (folder / "memtrack" / "v1").is_dir():
            return folder
    raise FileNotFoundError(f"no contract (proto/memtrack/v1) beside or in {HERE}; build from a whole clone")


def generate(target: Path = HERE / "src") -> None:
    """Writes the Python of the contract below `target`."""
    from grpc_tools import protoc

    root = contract()
    files = sorted(str(file.relative_to(root).as_posix()) for file in root.glob("memtrack/v1/*.proto"))
    outputs = [f"--{kind}_out={target}" for kind in ("python", "pyi", "grpc_python")]
    if protoc.main(["protoc", f"-I{root}", *outputs, *files]) != 0:
        raise RuntimeError(f"protoc failed on {', '.join(files)}")


if __name__ == "__main__":
    generate()
    sys.exit(0)
