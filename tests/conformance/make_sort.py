# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes sort.json: small worlds and what SORT, written with full matrices and SciPy's assignment, gives for them.

Independent of the plug-in's tracker, which splits the filter into its axes and has its own assignment. Run it by hand:
`python tests/conformance/make_sort.py`; it needs NumPy and SciPy. Written from the paper of SORT (Bewley et al. 2016)
and the values its authors published.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from scipy.optimize import linear_sum_assignment

TRANSITION = np.eye(7) + np.diag([1, 1, 1], 4)
OBSERVATION = np.eye(4, 7)
MEASUREMENT_NOISE = np.diag([1.0, 1.0, 10.0, 10.0])
PROCESS_NOISE = np.diag([1, 1, 1, 1, 0.01, 0.01, 0.0001])
START = np.diag([10.0, 10.0, 10.0, 10.0, 1e4, 1e4, 1e4])


def measure(box: np.ndarray) -> np.ndarray:
    """Centre, area and aspect of x_min y_min x_max y_max."""
    width, height = box[2] - box[0], box[3] - box[1]
    return np.array([(box[0] + box[2]) / 2, (box[1] + box[3]) / 2, width * height, width / height])


def corners(state: np.ndarray) -> np.ndarray:
    """The box of a state."""
    width = np.sqrt(state[2] * state[3])
    height = state[2] / width
    return np.array([state[0] - width / 2, state[1] - height / 2, state[0] + width / 2, state[1] + height / 2])


def overlap(a: np.ndarray, b: np.ndarray) -> float:
    """Intersection over union."""
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    if width <= 0 or height <= 0:
        return 0.0
    common = width * height
    return common / ((a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - common)


class Target:
    """A track that grows."""

    def __init__(self, number: int, box: np.ndarray) -> None:
        self.number = number
        self.state = np.concatenate([measure(box), np.zeros(3)])
        self.covariance = START.copy()
        self.missing = 0
        self.streak = 0

    def predict(self) -> None:
        if self.state[2] + self.state[6] <= 0:
            self.state[6] = 0
        self.state = TRANSITION @ self.state
        self.covariance = TRANSITION @ self.covariance @ TRANSITION.T + PROCESS_NOISE
        self.streak = 0 if self.missing else self.streak
        self.missing += 1

    def update(self, box: np.ndarray) -> None:
        innovation = OBSERVATION @ self.covariance @ OBSERVATION.T + MEASUREMENT_NOISE
        gain = self.covariance @ OBSERVATION.T @ np.linalg.inv(innovation)
        self.state = self.state + gain @ (measure(box) - OBSERVATION @ self.state)
        rest = np.eye(7) - gain @ OBSERVATION
        self.covariance = rest @ self.covariance @ rest.T + gain @ MEASUREMENT_NOISE @ gain.T
        self.missing = 0
        self.streak += 1


def track(frames: list[np.ndarray], iou_gate: float, maximum_age: int, minimum_hits: int) -> list[list[float]]:
    """Rows of frame, number, x_min, y_min, x_max, y_max."""
    targets: list[Target] = []
    rows: list[list[float]] = []
    begun = 0
    for frame, boxes in enumerate(frames):
        for target in targets:
            target.predict()
        ious = np.array([[overlap(box, corners(target.state)) for target in targets] for box in boxes])
        pairs: list[tuple[int, int]] = []
        if ious.size:
            above = ious > iou_gate
            if above.sum(0).max() == 1 and above.sum(1).max() == 1:
                pairs = [tuple(pair) for pair in np.argwhere(above)]
            else:
                pairs = [pair for pair in zip(*linear_sum_assignment(-ious), strict=True) if ious[pair] >= iou_gate]
        for box, target in pairs:
            targets[target].update(boxes[box])
        for box in set(range(len(boxes))) - {pair[0] for pair in pairs}:
            targets.append(Target(begun, boxes[box]))
            begun += 1
        for target in targets:
            reported = target.missing == 0 or target.missing < maximum_age
            if reported and (target.streak >= minimum_hits or frame + 1 <= minimum_hits):
                rows.append([frame, target.number, *np.round(corners(target.state), 6).tolist()])
        targets = [target for target in targets if target.missing <= maximum_age]
    return rows


def world(seed: int, frame_count: int, swimmers: int, size: float, speed: float) -> list[np.ndarray]:
    """Boxes a frame: swimmers that cross, are missed at random and for a while, and false alarms; one frame is empty."""
    random = np.random.default_rng(seed)
    place = random.uniform(0, 150, (swimmers, 2))
    velocity = random.normal(0, speed, (swimmers, 2))
    growth = random.uniform(0.93, 1.03, swimmers)
    frames = []
    for frame in range(frame_count):
        place += velocity
        velocity[(place < 0) | (place > 150)] *= -1
        seen = random.random(swimmers) < 0.8
        seen[0] &= not 10 <= frame < 16
        centres = [*place[seen], *random.uniform(0, 150, (random.poisson(0.3), 2))]
        sizes = [*(size * growth[seen] ** frame), *[size] * (len(centres) - int(seen.sum()))]
        boxes = []
        for centre, edge in zip(centres, sizes, strict=True):
            half = edge * random.uniform(0.9, 1.1, 2) / 2
            boxes.append(np.round([*(centre - half), *(centre + half)], 3))
        frames.append(np.array(boxes).reshape(-1, 4) if frame != 7 else np.zeros((0, 4)))
    return frames


def main() -> None:
    """Write sort.json beside this file."""
    cases = []
    for name, seed, settings, shape in (
        ("SORT's own settings", 1, (0.3, 1, 3), (30, 6, 30, 2)),
        ("the paper's settings", 2, (0.05, 25, 0), (40, 6, 30, 2)),
        ("tracks that end and begin again", 3, (0.05, 4, 0), (40, 8, 20, 3)),
        ("hits and gaps", 4, (0.1, 6, 2), (30, 10, 25, 2)),
    ):
        frames = world(seed, *shape)
        iou_gate, maximum_age, minimum_hits = settings
        cases.append(
            {
                "name": name,
                "iou_gate": iou_gate,
                "maximum_age": maximum_age,
                "minimum_hits": minimum_hits,
                "frames": [boxes.tolist() for boxes in frames],
                "expected": track(frames, *settings),
            }
        )
    rows = ",\n".join(json.dumps(case) for case in cases)
    Path(__file__).with_name("sort.json").write_text(f"[{rows}]\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
