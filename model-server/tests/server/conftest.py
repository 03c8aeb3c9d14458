# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from server.running import RunningServer


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """One server for the tests of a module that leave it as it was."""
    with RunningServer(tmp_path_factory.mktemp("spool")) as running:
        yield running


@pytest.fixture
def spool_folder(tmp_path: Path) -> Path:
    """A spool folder whose path is hard to get right."""
    folder = tmp_path / "sp[oo]l fÖlder 菌"
    folder.mkdir()
    return folder
