# SPDX-License-Identifier: GPL-3.0-or-later
"""What describes a simulated film: its scene, stage, lamp, camera and bacteria."""

from __future__ import annotations

from dataclasses import dataclass, field

from memtrack.simulation.optics import Look
from memtrack.simulation.swimming import Gait


@dataclass(frozen=True, slots=True)
class Recipe:
    """All that describes a simulated film but its random numbers; lengths in pixels, grey levels of an 8-bit camera.

    looks: one a bacterium, in the order of `gaits`. texture: standard deviation of the scene. shading: relative height
    of the uneven light. flicker: relative standard deviation of the lamp, lamp_drift: its slow change over the film.
    drift_per_frame: mean (x, y). jitter: of the stage, per axis and frame. jump: one sudden move of the stage. wobble:
    reach of fibre movement. restless: slow change of the scene, as a share of it. clutter: moving blurred blobs, their
    contrast in grey levels and their flow in pixels a frame. passing: bodies of up to 100 px that cross the field,
    the contrast of their grain and their speed in pixels a frame. shutter: share of a frame's time the camera sees.
    read_noise, shot_noise: sd in grey levels, the second at full scale. decoy_looks: of static rods like bacteria.
    jpeg: quality, 0 for none. caption: a clock and a scale bar are burnt in. video: the film was packed as MPEG-4 (8
    bits only). subtracted: its mean or median was subtracted from it.
    """

    width: int = 320
    height: int = 320
    frames: int = 80
    scene: str = "mottled"
    scale: float = 1.0
    bits: int = 8
    pixel_size_um: float = 0.2475
    frame_interval_seconds: float = 1 / 60
    level: float = 117.0
    texture: float = 18.0
    shading: float = 0.2
    flicker: float = 0.0
    lamp_drift: float = 0.0
    drift_per_frame: tuple[float, float] = (0.0, 0.0)
    jitter: float = 0.0
    jump: float = 0.0
    wobble: float = 0.0
    restless: float = 0.0
    clutter: int = 0
    clutter_contrast: float = 5.0
    clutter_flow: float = 0.0
    passing: int = 0
    passing_contrast: float = 15.0
    passing_speed: float = 1.0
    shutter: float = 0.0
    read_noise: float = 3.0
    shot_noise: float = 3.0
    noise_blur: float = 0.0
    dust: float = 0.0
    jpeg: int = 0
    caption: bool = False
    video: bool = False
    subtracted: bool = False
    speed_um_s: float = 10.0
    depth_spread: float = 0.6
    gaits: tuple[Gait, ...] = ()
    looks: tuple[Look, ...] = ()
    decoy_looks: tuple[Look, ...] = field(default=())
