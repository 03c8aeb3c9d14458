# SPDX-License-Identifier: GPL-3.0-or-later
"""What several subcommands ask of their arguments; each refusal says what was given."""

from __future__ import annotations

import argparse
import math
import os
from pathlib import Path

from memtrack.errors import SettingsError


def positive(word: str) -> float:
    """A number above 0."""
    value = _number(word)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{word!r} is not a positive number")
    return value


def share(word: str) -> float:
    """A number from 0 to 1."""
    value = _number(word)
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError(f"{word!r} is not a number from 0 to 1")
    return value


def count(word: str) -> int:
    """A whole number above 0."""
    value = _number(word)
    if not 1 <= value < math.inf or value != int(value):
        raise argparse.ArgumentTypeError(f"{word!r} is not a whole number above 0")
    return int(value)


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return math.nan


def thresholds(text: str) -> tuple[float, float, float]:
    """Lowest scores of the low, medium and high level, with commas between them.

    Raises:
        SettingsError: these are not three numbers.
    """
    try:
        low, medium, high = (float(word) for word in text.split(","))
    except ValueError:
        raise SettingsError(f"--thresholds is {text!r}; give three numbers such as 0.4,0.4,0.5") from None
    return low, medium, high


def check_target(path: Path) -> None:
    """Raises SettingsError where no file `path` can be written, or replaced, before any work is done."""
    folder = path.resolve().parent
    if not folder.is_dir():
        raise SettingsError(f"the folder of {path} does not exist; make it, or write elsewhere")
    if path.is_dir():
        raise SettingsError(f"{path} is a folder; give the name of a file")
    if not os.access(folder, os.W_OK):
        raise SettingsError(f"the folder of {path} cannot be written to; write elsewhere")
    if path.exists():
        try:
            path.open("ab").close()  # changes nothing; refused on Windows while another program has it open
        except OSError as error:
            raise SettingsError(
                f"cannot write to {path}: {error.strerror}; close it in other programs, or write elsewhere"
            ) from error


def make_folder(path: Path, option: str) -> None:
    """Makes the folder `path`, which `option` names.

    Raises:
        SettingsError: it is a file, or cannot be made.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SettingsError(f"cannot make the folder {path}: {error.strerror}; choose another {option}") from error
