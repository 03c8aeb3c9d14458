#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds MEMTrack and runs it from a clone; needs a JDK 17 or newer, Maven, Python 3.11 or newer, and internet.

On Windows write `py` for `python3`; fiji-plugin/docs/install.md says how to come by these, and how much is fetched.

    python3 build.py track [FILM] [--output FOLDER] [--options "KEY=VALUE ..."]
    python3 build.py test
    python3 build.py jar [--with-python PLATFORM]
    python3 build.py accuracy [--data FOLDER] [--peers] [--trackmate CLASSPATH]

`track` sets everything up, makes a film if none is given, and tracks it in headless ImageJ with the plug-in's jar.
`test` sets everything up and runs every test. `jar` leaves the plug-in at fiji-plugin/target/MEMTrack_-<version>.jar,
and with a platform also cpython-<version>-<platform>.jar beside it, with a Python for machines that have none.
`accuracy` measures the whole method on simulated films (model-server/docs/comparison.md has its options and results).
"""

from __future__ import annotations

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent
SERVER = ROOT / "model-server"
VENV = ROOT / ".venv"
PYTHON_PLATFORMS = ("windows-x86_64", "macosx-arm64", "macosx-x86_64", "linux-x86_64")
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def main() -> int:
    """Runs the command line; 0 when everything it did succeeded."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    track = commands.add_parser("track", help="track a film")
    track.add_argument("film", nargs="?", type=Path, help="TIFF, AVI or folder of PNGs; none: a film is simulated")
    track.add_argument("--output", type=Path, default=ROOT / "out", help="folder for the results (default: out)")
    track.add_argument("--options", default="", help="further options of the macro command, as in a macro")
    commands.add_parser("test", help="run every test")
    jar = commands.add_parser("jar", help="build the plug-in")
    jar.add_argument("--with-python", choices=PYTHON_PLATFORMS, help="fetch also a Python for this platform")
    commands.add_parser("accuracy", help="measure the method on films with known tracks", add_help=False)
    arguments, rest = parser.parse_known_args()
    if rest and arguments.command != "accuracy":
        parser.error(f"unrecognized arguments: {' '.join(rest)}")
    try:
        if arguments.command == "track":
            run_track(arguments.film, arguments.output, arguments.options)
        elif arguments.command == "test":
            run_tests()
        elif arguments.command == "accuracy":
            run_accuracy(rest)
        else:
            install_server(extras="")
            platform = arguments.with_python
            maven("package", "-DskipTests", *([f"-Dpython.platform={platform}"] if platform else []))
    except subprocess.CalledProcessError as error:
        print(f"Failed with exit code {error.returncode}: {' '.join(map(str, error.cmd))}", file=sys.stderr)
        return 1
    return 0


def run_track(film: Path | None, output: Path, options: str) -> None:
    """Tracks `film`, or a simulated one, in headless ImageJ; the results are in `output` afterwards."""
    if film is not None and not film.exists():
        sys.exit(f"There is no film {film}; give the path of a TIFF, an AVI or a folder of PNG frames.")
    output = output.resolve()
    install_server(extras="")
    maven("package", "-DskipTests")
    output.mkdir(parents=True, exist_ok=True)
    if film is None:
        film = output / "simulated-film" / "collagen.tif"
        film.parent.mkdir(exist_ok=True)
        step(f"Simulating a film of bacteria in collagen, with its true tracks beside it: {film}")
        run(PYTHON, "-m", "memtrack", "simulate", "--family", "collagen", "--seed", "8", film)
    step(f"Tracking {film} in headless ImageJ")
    in_imagej(film, output, options)


def in_imagej(film: Path, output: Path, options: str) -> None:
    """Tracks `film` in headless ImageJ with the plug-in's jar, which is built."""
    classpath = (ROOT / "tests/target/classpath.txt").read_text(encoding="utf-8").strip()
    run(
        "java",
        "--add-opens=java.base/java.lang=ALL-UNNAMED",
        "-Djava.awt.headless=true",
        "-Dfile.encoding=UTF-8",
        "-cp",
        os.pathsep.join([str(ROOT / "tests/target/classes"), classpath]),
        "org.memtrack.tests.HeadlessImageJ",
        film.resolve(),
        output,
        options,
        # In the plain "C" locale Java cannot name a file with an umlaut.
        environment={
            "MEMTRACK_PYTHON": str(PYTHON),
            "LC_ALL": os.environ.get("LC_ALL") or os.environ.get("LANG") or "C.UTF-8",
        },
    )


def run_tests() -> None:
    """Runs the checks and tests of both languages, then those of the whole."""
    install_server(extras="[dev]")
    step("Checking the contract")
    run(PYTHON.with_name("buf"), "lint", cwd=ROOT / "proto")
    run(PYTHON.with_name("buf"), "breaking", "--against", "baseline.binpb", cwd=ROOT / "proto")
    step("Checking and testing the model server")
    run(PYTHON, "-m", "ruff", "check", ".", cwd=SERVER)
    run(PYTHON, "-m", "ruff", "format", "--check", ".", cwd=SERVER)
    run(PYTHON, "-m", "mypy", cwd=SERVER)
    run(PYTHON.with_name("lint-imports"), cwd=SERVER)
    run(PYTHON, "-m", "pytest", cwd=SERVER)
    step("Building and testing the plug-in, then the whole")
    maven("verify")


def run_accuracy(arguments: list[str]) -> None:
    """Builds everything, then measures the whole method; the arguments are those of the benchmark."""
    install_server(extras="[baselines]" if "--peers" in arguments else "")
    maven("package", "-DskipTests")
    run(PYTHON, SERVER / "benchmarks" / "accuracy", *arguments)


def install_server(extras: str) -> None:
    """Brings the virtual environment .venv in step with model-server/pyproject.toml and the contract."""
    if sys.version_info < (3, 11):
        sys.exit(f"Python {sys.version.split()[0]} is too old; run build.py with Python 3.11 or newer.")
    sources = [SERVER / "pyproject.toml", *sorted((ROOT / "proto").rglob("*.proto"))]
    digest = hashlib.sha256(extras.encode() + b"".join(source.read_bytes() for source in sources)).hexdigest()
    stamp, place = VENV / "memtrack-install.txt", f"{VENV}\n"
    wanted, found = place + digest, stamp.read_text(encoding="utf-8") if stamp.is_file() else place
    if found == wanted:
        return
    step(f"Setting up Python in {VENV} (a few minutes the first time)")
    if not found.startswith(place):  # came along with a copy of the folder, and runs what lies in the old one
        shutil.rmtree(VENV)
    if not PYTHON.is_file():
        try:
            venv.create(VENV, with_pip=True)
        except BaseException as error:  # interrupted, too: half of one would never work
            shutil.rmtree(VENV, ignore_errors=True)
            if not isinstance(error, subprocess.CalledProcessError):
                raise
            sys.exit(
                "Python cannot make a virtual environment; on Debian and Ubuntu, install the package python3-venv."
            )
    run(PYTHON, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--editable", f"{SERVER}{extras}")
    stamp.write_text(wanted, encoding="utf-8")


def maven(*goals: str) -> None:
    """Runs Maven over all modules; the build finds the Python of the virtual environment in MEMTRACK_PYTHON."""
    step("Maven: " + " ".join(goals))
    program = shutil.which("mvn") or sys.exit(
        "Maven (mvn) is not on the PATH; fiji-plugin/docs/install.md says what to do."
    )
    run(program, "--batch-mode", "--no-transfer-progress", *goals, environment={"MEMTRACK_PYTHON": str(PYTHON)})


def step(title: str) -> None:
    """Says what comes next."""
    print(f"== {title}", flush=True)


def run(*command: str | Path, cwd: Path = ROOT, environment: dict[str, str] | None = None) -> None:
    """Runs a program; its failure ends the build."""
    subprocess.run([str(part) for part in command], cwd=cwd, env={**os.environ, **(environment or {})}, check=True)


if __name__ == "__main__":
    sys.exit(main())
