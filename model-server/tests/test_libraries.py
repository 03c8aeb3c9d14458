# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import importlib
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import memtrack
from memtrack.libraries import engine_threads, library_versions, working_devices

TWO_AT_ONCE = """
import threading
import numpy as np
from memtrack.models import load_model
model = load_model()
frame = np.full((len(model.card.features.channels), 64, 64), 128, np.uint8)
begin = threading.Barrier(2)
def work():
    engine = model.engine("openvino")
    begin.wait()
    engine.run(frame)
threads = [threading.Thread(target=work) for _ in range(2)]
for thread in threads: thread.start()
for thread in threads: thread.join()
"""


def test_two_threads_may_begin_at_the_same_moment() -> None:
    # One process in seven hung here before the first operation was left to one thread.
    for _ in range(4):
        subprocess.run([sys.executable, "-c", TWO_AT_ONCE], check=True, timeout=120)


def test_openvino_is_reached_through_its_one_door_only() -> None:
    sources = Path(memtrack.__file__).parent
    direct = re.compile(r"^\s*(import|from) openvino\b", re.MULTILINE)
    found = {f.relative_to(sources).as_posix() for f in sources.rglob("*.py") if direct.search(f.read_text("utf-8"))}
    # The export runs in a process of its own, in one thread.
    assert found == {"libraries.py", "training/export.py"}


def test_versions_and_devices_are_those_of_this_machine() -> None:
    assert {"numpy", "openvino", "grpcio"} <= set(library_versions())
    assert "openvino CPU" in working_devices()
    assert 1 <= engine_threads() <= 8


def test_windows_is_told_where_the_runtime_of_cpp_lies(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []
    monkeypatch.setattr(os, "add_dll_directory", told.append, raising=False)
    monkeypatch.setattr(sys, "platform", "win32")
    importlib.reload(memtrack)
    assert told == [sys.prefix]
