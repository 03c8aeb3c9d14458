# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack train`: a model from a recipe, registered as a new version."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from memtrack.cli.arguments import count, make_folder
from memtrack.errors import EngineUnavailableError, SettingsError
from memtrack.models import user_models


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("recipe", type=Path, help="TOML file with the films, the net and the optimisation")
    parser.add_argument(
        "--workspace", type=Path, help="folder for samples, checkpoints and curves (default: RECIPE.work)"
    )
    parser.add_argument("--models", type=Path, help=f"registry to add the model to (default: {user_models()})")
    parser.add_argument("--device", default="cpu", help="cpu, cuda, cuda:1, mps ... (default: cpu)")
    parser.add_argument("--threads", type=count, default=1, help="threads of the optimisation on a CPU (default: 1)")
    parser.add_argument("--workers", type=count, default=1, help="processes that make films (default: 1)")


def run(args: argparse.Namespace) -> int:
    """Trains; progress goes to standard error, the model's folder to standard output.

    Raises:
        SettingsError: the recipe, the device or a folder cannot be used.
        EngineUnavailableError: PyTorch or nncf is not installed.
    """
    try:
        import nncf  # noqa: F401  # used at the end of hours of work
        import torch
    except ImportError as error:
        raise EngineUnavailableError(
            f"training needs PyTorch and nncf, and {error.name or 'one of them'} cannot be loaded ({error}); "
            'install both with pip install "memtrack[train]"'
        ) from error
    import cv2

    from memtrack.training.config import read_config
    from memtrack.training.optimise import Workspace
    from memtrack.training.recipe import train

    config = read_config(args.recipe)
    try:
        torch.empty(1, device=args.device)
    except (RuntimeError, AssertionError) as error:  # of what is no device, and of what PyTorch was built without
        reason = str(error).partition("\n")[0]
        raise SettingsError(f"--device is {args.device!r}, which PyTorch cannot use here: {reason}") from error
    torch.set_num_threads(args.threads)
    cv2.setNumThreads(args.threads)
    workspace = Workspace(args.workspace or args.recipe.with_suffix(".work"))
    make_folder(workspace.folder, "--workspace")
    make_folder(args.models or user_models(), "--models")

    model = train(
        config, workspace, args.models, base=args.recipe.parent, device=args.device, workers=args.workers, report=_say
    )
    print(model.folder)
    return 0


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
