# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the model server's wheel among the plug-in's classes; called by the Maven build as wheel.py SERVER CLASSES WORK.

The wheel is built again only when a source of the server or of the contract has changed.
"""

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path


def main(server: Path, classes: Path, work: Path) -> None:
    """Builds the wheel of `server` in `work` if needed, and copies it with its name into `classes`."""
    stamp = work / "sources.sha256"
    digest = sources_digest(server)
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != digest:
        shutil.rmtree(work, ignore_errors=True)
        # Setuptools would put modules that are gone into the wheel again.
        shutil.rmtree(server / "build", ignore_errors=True)
        command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check", "--no-deps"]
        # Of the same sources always the same wheel: the plug-in tells builds of the server apart by its SHA-256.
        environment = {**os.environ, "SOURCE_DATE_EPOCH": "315532800"}
        subprocess.run([*command, "--wheel-dir", str(work), str(server)], check=True, env=environment)
        stamp.write_text(digest, encoding="utf-8")
    (wheel,) = work.glob("memtrack-*.whl")
    shutil.rmtree(classes, ignore_errors=True)
    classes.mkdir(parents=True)
    shutil.copy(wheel, classes)
    (classes / "name.txt").write_text(wheel.name, encoding="utf-8")


def sources_digest(server: Path) -> str:
    """SHA-256 over names and contents of everything the wheel is made of."""
    files = [server / "pyproject.toml", server / "setup.py", server / "generate.py"]
    files += (server / "src").rglob("*")
    files += (server.parent / "proto").rglob("*.proto")
    digest = hashlib.sha256()
    for file in sorted(files):
        generated = file.match("v1/*_pb2*") or "__pycache__" in file.parts or ".egg-info" in str(file)
        if file.is_file() and not generated:
            digest.update(file.relative_to(server.parent).as_posix().encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


if __name__ == "__main__":
    if sys.version_info < (3, 11):
        sys.exit(f"Building the plug-in needs Python 3.11 or newer, not {sys.version.split()[0]}; name one with "
                 "-Dmemtrack.python=/path/to/python")
    main(*(Path(argument).resolve() for argument in sys.argv[1:4]))
