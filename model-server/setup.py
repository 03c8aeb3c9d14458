# SPDX-License-Identifier: GPL-3.0-or-later
"""Build steps pyproject.toml cannot say: generate the contract's Python, and carry the contract in source archives."""

import shutil
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

sys.path.insert(0, str(Path(__file__).resolve().parent))
import generate


class BuildWithContract(build_py):  # type: ignore[misc]
    """Generates memtrack.v1 before the package is collected; also in an editable install."""

    def run(self) -> None:
        generate.generate()
        super().run()


class ArchiveWithContract(sdist):  # type: ignore[misc]
    """Puts the contract and the generator beside the sources."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        super().make_release_tree(base_dir, files)
        shutil.copytree(generate.contract(), Path(base_dir) / "proto", dirs_exist_ok=True)
        shutil.copy(generate.__file__, base_dir)


setup(cmdclass={"build_py": BuildWithContract, "sdist": ArchiveWithContract})
