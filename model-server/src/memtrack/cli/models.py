# SPDX-License-Identifier: GPL-3.0-or-later
"""`memtrack models`: what is in the registry."""

from __future__ import annotations

import argparse

from memtrack.models import list_models, load_model


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("name", nargs="?", help="show this model's card and check its files; without it, list all")
    parser.add_argument("version", nargs="?", help="of this version (default: the newest)")


def run(args: argparse.Namespace) -> int:
    """Lists the models, or prints one card after its files were found to match it.

    Raises:
        ModelNotFoundError: there is no such model.
        ModelCorruptError: a file of it is damaged.
    """
    if args.name is None:
        for card in list_models():
            print(f"{card.name} {card.version}\t{card.description}")
    else:
        model = load_model(args.name, args.version)
        print(f"# {model.folder}\n{model.card.to_json()}", end="")
    return 0
