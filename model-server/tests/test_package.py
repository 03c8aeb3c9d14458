# SPDX-License-Identifier: GPL-3.0-or-later
"""The package as it is built from a fresh clone."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parents[1]
GENERATED = {f"memtrack/v1/{name}_{kind}" for name in ("detection", "server") for kind in ("pb2.py", "pb2_grpc.py")}


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sources without anything that a build has made; the path is hard to get right."""
    root = tmp_path_factory.mktemp("clöne mit [Leerzeichen] 库")
    made = shutil.ignore_patterns("*_pb2*", "*.egg-info", "build", "dist", "__pycache__", ".*_cache", ".hypothesis")
    shutil.copytree(HERE, root / "model-server", ignore=made)
    shutil.copytree(HERE.parent / "proto", root / "proto")
    return root


def build(folder: Path, kind: str, out: Path) -> Path:
    """Calls the build backend as pip does, in the environment of the tests."""
    code = f"import sys; from setuptools import build_meta; print(build_meta.build_{kind}(sys.argv[1]))"
    out.mkdir(exist_ok=True)
    done = subprocess.run(
        [sys.executable, "-c", code, str(out)], cwd=folder, capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return out / done.stdout.splitlines()[-1]


def check_wheel(wheel: Path) -> None:
    assert wheel.name.endswith("-py3-none-any.whl")
    with zipfile.ZipFile(wheel) as content:
        names = set(content.namelist())
        (metadata,) = (content.read(name).decode() for name in names if name.endswith(".dist-info/METADATA"))
    runtime = re.findall("^Requires-Dist: msvc-runtime.*", metadata, re.MULTILINE)
    assert len(runtime) == 1
    assert 'sys_platform == "win32"' in runtime[0]
    assert names >= GENERATED
    assert {"memtrack/__main__.py", "memtrack/py.typed", "memtrack/cli/serve.py", "memtrack/video/tiff.py"} <= names
    assert any(name.endswith(".dist-info/licenses/LICENSE") for name in names)
    models = {name for name in names if name.startswith("memtrack/models/default/")}
    assert {Path(name).name for name in models} >= {"model.json", "weights.safetensors"}


def test_the_licence_is_the_repositorys() -> None:
    assert (HERE / "LICENSE").read_bytes() == (HERE.parent / "LICENSE").read_bytes()


def test_a_wheel_from_a_fresh_clone_has_the_contract_and_the_models(clone: Path, tmp_path: Path) -> None:
    check_wheel(build(clone / "model-server", "wheel", tmp_path))


def test_a_source_archive_builds_the_same_wheel_without_the_repository(clone: Path, tmp_path: Path) -> None:
    archive = build(clone / "model-server", "sdist", tmp_path / "sdist")
    with tarfile.open(archive) as content:
        content.extractall(tmp_path / "unpacked", filter="data")
    (folder,) = (tmp_path / "unpacked").iterdir()
    check_wheel(build(folder, "wheel", tmp_path / "wheel"))
