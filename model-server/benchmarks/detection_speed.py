# SPDX-License-Identifier: GPL-3.0-or-later
"""Speed of the method on a simulated film of 660 x 492 pixels: each part alone, and all of it together.

    python model-server/benchmarks/detection_speed.py [--frames 200] [--threads 2]

Processor time says what the parts cost on a busy machine, wall time what a user waits for.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is imported, as in memtrack.__main__

import cv2
import numpy as np

from memtrack.detector import padded
from memtrack.models import load_model
from memtrack.motion import FilmFeatures
from memtrack.pipeline import detect_film
from memtrack.pruning import faint, prune
from memtrack.refinement import refined
from memtrack.scene import Scene
from memtrack.settings import DetectionSettings
from memtrack.simulation.families import draw_recipe
from memtrack.simulation.film import simulate
from memtrack.stabilisation import measure_motion

T = TypeVar("T")


def main() -> None:
    """Prints milliseconds a frame for each part and frames a second for the whole."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=200)
    parser.add_argument("--threads", type=int, default=2)
    args = parser.parse_args()
    cv2.setNumThreads(1)
    recipe = draw_recipe("collagen", np.random.default_rng(7), width=660, height=492, frames=args.frames)
    recipe = replace(recipe, drift_per_frame=(0.05, 0.02), jitter=0.1, bits=8)
    film, model = simulate(recipe, 1).film, load_model()
    n = film.frame_count

    def silent(done: int, total: int) -> None:
        pass

    motion = timed("stabilisation", n, lambda: measure_motion(film, stabilise=True, report=silent))
    scene = timed("background", n, lambda: Scene(film, motion, report=silent))
    made = FilmFeatures(scene, model.card.features)
    # Dropped at once, as the method does: room for features that are kept takes as long as making them.
    timed("features", n, lambda: [len(made.channels(i)) for i in range(n)])
    features = [made.channels(i) for i in range(n)]
    engine, decoder = model.engine(), model.card.decoder
    engine.run(padded(features[0]))
    maps = timed("net", n, lambda: [engine.run(padded(f)) for f in features])
    found = timed("decoding", n, lambda: [decoder.decode(m, film.height, film.width) for m in maps])
    refiner = model.refiner()
    if refiner is not None:
        refined(found[0], features[0], refiner)
        found = timed("refining", n, lambda: [refined(d, f, refiner) for d, f in zip(found, features, strict=True)])
    settings = DetectionSettings(threads=args.threads)
    pruner = settings.pruner(model.card)
    timed("pruning", n, lambda: [faint(d, prune(d, pruner)[0], pruner) for d in found])
    timed("the whole", n, lambda: list(detect_film(film, model, settings, lambda stage, done, total: None)))


def timed(name: str, frames: int, work: Callable[[], T]) -> T:
    """Runs `work` and prints what it took a frame."""
    wall, processor = time.perf_counter(), time.process_time()
    result = work()
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    print(
        f"{name:14s} {1e3 * processor / frames:6.2f} ms of processor time, {1e3 * wall / frames:6.2f} ms a frame",
        end="",
    )
    print(f", {frames / wall:.0f} frames/s")
    return result


if __name__ == "__main__":
    main()
