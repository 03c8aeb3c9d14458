# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading and writing of small text files, in the same way everywhere."""

from __future__ import annotations

import contextlib
import os
import uuid
from pathlib import Path

from memtrack.errors import InvalidInputError


def read_text(path: Path) -> str:
    """The text of a file in UTF-8 (with or without byte order mark), or else in Latin-1, as older programs write it.

    Raises:
        InvalidInputError: the file cannot be read.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InvalidInputError(f"cannot read {path}: {error.strerror}; check the path") from error
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def write_text(path: Path, text: str) -> None:
    """Write `text` in UTF-8, whole or not at all; line ends stay as they are in `text`.

    Raises:
        InvalidInputError: the folder is missing or cannot be written to; or `path` cannot be replaced, and the message
            names a file beside it that has the text.
    """
    # Not tempfile's: its files can be read by their owner alone, and stay so after the renaming.
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex}")
    try:
        temporary.write_bytes(text.encode("utf-8"))
    except BaseException as error:
        with contextlib.suppress(OSError):
            temporary.unlink()
        if isinstance(error, OSError):
            raise InvalidInputError(
                f"cannot write {path}: {error.strerror}; check the folder and its rights"
            ) from error
        raise
    try:
        os.replace(temporary, path)
    except OSError as error:
        # Another program has it open, on Windows; hours of work may be in the text.
        raise InvalidInputError(
            f"cannot replace {path}: {error.strerror}; close it in other programs and rename {temporary.name}, "
            "which has what was to be written"
        ) from error
