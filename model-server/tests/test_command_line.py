# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `memtrack` as a user calls it."""

from __future__ import annotations

import errno
import hashlib
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile

from memtrack import __version__
from memtrack.__main__ import SUBCOMMANDS, main
from memtrack.cli import detect, simulate
from memtrack.detections_io import read_detections


def memtrack(*words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "memtrack", *map(str, words)],
        capture_output=True,
        encoding="utf-8",
        timeout=120,
        check=False,
    )


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("ordner mit ümlaut 细") / "film [1].tif"
    frames = np.random.default_rng(0).normal(120, 5, (12, 60, 90)).astype(np.uint8)
    tifffile.imwrite(
        path, frames, imagej=True, metadata={"axes": "TYX", "unit": "um", "finterval": 0.1}, resolution=(4, 4)
    )
    return path


def test_the_version_and_the_subcommands_are_told() -> None:
    assert memtrack("--version").stdout == f"memtrack {__version__}\n"
    shown = memtrack("--help").stdout
    assert set(SUBCOMMANDS) == {"serve", "detect", "simulate", "train", "evaluate", "models"}
    assert all(name in shown for name in SUBCOMMANDS)
    assert memtrack().returncode == 2


def test_neither_help_nor_the_servers_start_imports_a_computing_library() -> None:
    code = (
        "import sys, memtrack.server, memtrack.cli.serve; print([m for m in ('torch', 'openvino') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert done.stdout == "[]\n"


def test_numpy_is_imported_only_after_its_threads_were_limited() -> None:
    code = (
        "import os, sys; os.environ.pop('OPENBLAS_NUM_THREADS', None); import memtrack.__main__ as command; "
        "print('numpy' in sys.modules); command.main(['models']); "
        "print('numpy' in sys.modules, os.environ['OPENBLAS_NUM_THREADS'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True)
    assert done.stdout.splitlines()[0] == "False"
    assert done.stdout.splitlines()[-1] == "True 1"


def test_detect_writes_a_table_with_its_provenance(film: Path, tmp_path: Path) -> None:
    out = tmp_path / "détections.csv"
    done = memtrack(
        "detect", film, "--out", out, "--thresholds", "0,0,0", "--nms-iou", "1", "--max-size-px", "1000", "--resting"
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [str(out), str(tmp_path / "détections.provenance.json")]
    told = json.loads((tmp_path / "détections.provenance.json").read_text(encoding="utf-8"))
    assert told["memtrack"] == __version__
    assert told["film"]["name"] == "film [1].tif"
    assert told["film"]["sha256"] == hashlib.sha256(tifffile.imread(film).tobytes()).hexdigest()
    assert (told["film"]["pixel_size_um"], told["film"]["frame_interval_seconds"]) == (0.25, 0.1)
    assert told["model"]["name"] == "default"
    assert told["thresholds"] == {"low": 0, "medium": 0, "high": 0}
    assert told["settings"]["resting"] is True
    kept = sum(len(frame.detections) for frame in read_detections(out))
    assert kept == told["counts"]["kept"] == told["counts"]["candidates"]
    assert f"{kept} detections kept" in done.stderr


def test_what_a_user_can_mend_ends_with_two_and_one_sentence(film: Path, tmp_path: Path) -> None:
    out, folder, recipe = tmp_path / "d.csv", tmp_path / "taken.tif", tmp_path / "small.toml"
    folder.mkdir()
    films = "[[{}]]\nfamily = 'water'\ncount = 1\nseed = 1\n"
    recipe.write_text("[model]\nname = 'a'\n" + films.format("training") + films.format("validation"), encoding="utf-8")
    for words, sentence in [
        (("detect", tmp_path / "missing.tif", "--out", out), "there is no film"),
        (("detect", film, "--out", tmp_path / "d.xls"), "d.xls must end in .csv or .json"),
        (("detect", film, "--out", tmp_path / "missing" / "d.csv"), "does not exist; make it"),
        (("detect", film, "--out", out, "--model", "nobody"), "nobody"),
        (("detect", film, "--out", out, "--nms-iou", "7"), "nms_iou is 7.0"),
        (("detect", film, "--out", out, "--region", tmp_path / "missing.png"), "cannot read the region"),
        (("detect", film, "--out", out, "--thresholds", "0.4,0.5"), "--thresholds is '0.4,0.5'; give three numbers"),
        (
            ("simulate", tmp_path / "missing" / "a.tif"),
            f"folder of {tmp_path / 'missing' / 'a.tif'} does not exist; make",
        ),
        (("simulate", folder), "taken.tif is a folder; give the name of a file"),
        (("train", tmp_path / "missing.toml"), "cannot read the training recipe"),
        (("train", recipe, "--device", "toaster"), "--device is 'toaster', which PyTorch cannot use here"),
        (("train", recipe, "--workspace", film), "choose another --workspace"),
        (("train", recipe, "--workspace", tmp_path / "work", "--models", film), "choose another --models"),
    ]:
        done = memtrack(*words)
        assert done.returncode == 2
        assert done.stderr.startswith("memtrack: ")
        assert done.stderr.count("\n") == 1
        assert sentence in done.stderr
        assert not out.exists()


def failing(error: BaseException) -> Callable[..., None]:
    def fail(*_: object) -> None:
        raise error

    return fail


def test_what_the_system_refuses_ends_with_two_and_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    made = [str(tmp_path / "a.tif"), "--frames", "2", "--width", "64", "--height", "64"]
    for error, sentence in [
        (MemoryError(), "there is not enough memory; close other programs, or use fewer or smaller frames"),
        (
            OSError(errno.ENOSPC, "No space left on device", "a.csv"),
            "a.csv: No space left on device; check the file, its rights and the space on the disk",
        ),
        (OSError("the spool ended"), "the spool ended; check the file, its rights and the space on the disk"),
    ]:
        monkeypatch.setattr(simulate, "write", failing(error))
        assert main(["simulate", *made]) == 2
        assert capsys.readouterr().err == f"memtrack: {sentence}\n"


def test_a_result_that_another_program_holds_is_said_before_any_work(
    film: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    opened = Path.open

    def held(path: Path, *words: Any, **options: Any) -> Any:
        if path.suffix in (".csv", ".json", ".mdf") and words == ("ab",):
            raise PermissionError(errno.EACCES, "Permission denied")
        return opened(path, *words, **options)

    monkeypatch.setattr(Path, "open", held)
    monkeypatch.setattr(simulate, "simulate", failing(AssertionError("it simulates")))
    monkeypatch.setattr(detect, "detect_film", failing(AssertionError("it detects")))
    for command, name in [
        (["detect", str(film), "--out", str(tmp_path / "d.csv")], "d.csv"),
        (["detect", str(film), "--out", str(tmp_path / "e.csv")], "e.provenance.json"),
        (["simulate", str(tmp_path / "a.tif")], "a.mdf"),
    ]:
        (tmp_path / name).write_text("of before", encoding="utf-8")
        assert main(command) == 2
        assert capsys.readouterr().err == (
            f"memtrack: cannot write to {tmp_path / name}: Permission denied; close it in other programs, or write "
            "elsewhere\n"
        )
        assert (tmp_path / name).read_text(encoding="utf-8") == "of before"


def test_detect_tells_what_the_server_would_warn_of(tmp_path: Path) -> None:
    tifffile.imwrite(tmp_path / "one.tif", np.full((32, 40), 90, np.uint8))
    done = memtrack("detect", tmp_path / "one.tif", "--out", tmp_path / "d.csv")
    assert done.returncode == 0, done.stderr
    notes = json.loads((tmp_path / "d.provenance.json").read_text(encoding="utf-8"))["film"]["notes"]
    assert [line.removeprefix("Note: ") for line in done.stderr.splitlines() if line.startswith("Note: ")] == notes
    assert [note.partition(";")[0] for note in notes] == [
        "The film has no pixel size and no cell length was given, so it is used at its own scale, or at a "
        "smaller one where more cells are found then",
        "The film has 1 frame(s)",
    ]


def test_a_mistyped_value_is_refused_by_the_parser(film: Path, tmp_path: Path) -> None:
    detect = ("detect", film, "--out", tmp_path / "d.csv")
    for words, sentence in [
        ((*detect, "--pixel-size-um", "-1"), "argument --pixel-size-um: '-1' is not a positive number"),
        ((*detect, "--frame-interval-s", "soon"), "argument --frame-interval-s: 'soon' is not a positive number"),
        ((*detect, "--criterion", "best"), "argument --criterion: invalid choice: 'best'"),
        (("evaluate", "--out", tmp_path, "--iou", "2"), "argument --iou: '2' is not a number from 0 to 1"),
        (("train", tmp_path / "r.toml", "--workers", "0.5"), "argument --workers: '0.5' is not a whole number above 0"),
    ]:
        done = memtrack(*words)
        assert done.returncode == 2
        assert sentence in done.stderr
