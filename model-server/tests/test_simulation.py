# SPDX-License-Identifier: GPL-3.0-or-later
import argparse
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
import tifffile

from memtrack.cli import simulate as command
from memtrack.errors import SettingsError
from memtrack.film import Calibration
from memtrack.motility import motility_of, peak_diffusivity
from memtrack.simulation import scenes
from memtrack.simulation.families import FAMILIES, draw_recipe
from memtrack.simulation.film import simulate
from memtrack.simulation.optics import Look, apparent_centre, draw
from memtrack.simulation.recipe import Recipe
from memtrack.simulation.swimming import Gait, World, path_diffusivity, swim
from memtrack.simulation.truth import _smoothed_norm
from memtrack.tracks import Motility, TrackTable
from memtrack.tracks_io import read_tracks

LOOK = Look(length=9, width=4, contrast=100, halo=0.2, halo_radius=11, flip=0, relief=0, relief_angle=0)
QUIET = Recipe(width=160, height=120, frames=12, texture=0.0, shading=0.0, read_noise=0.0, shot_noise=0.0)


def test_the_same_seed_makes_the_same_film_and_another_one_another() -> None:
    recipe = replace(QUIET, gaits=(Gait.SWIMMING,) * 3, looks=(LOOK,) * 3, read_noise=2.0)
    first, again, other = simulate(recipe, 1), simulate(recipe, 1), simulate(recipe, 2)
    np.testing.assert_array_equal(first.film.frames, again.film.frames)
    np.testing.assert_array_equal(first.truth.x, again.truth.x)
    assert (first.film.frames != other.film.frames).any()


def test_a_cell_stands_where_the_truth_says_with_its_contrast_and_halo() -> None:
    recipe = replace(QUIET, gaits=(Gait.SWIMMING,), looks=(LOOK,), depth_spread=0.0, level=100.0)
    for seed in range(20):
        made = simulate(recipe, seed)
        x, y = made.truth.x, made.truth.y
        for row in np.flatnonzero((x > 40) & (x < 120) & (y > 40) & (y < 80)):
            frame = made.film.frames[made.truth.frames[row]].astype(float) - 100
            rows, columns = np.mgrid[:120, :160]
            core = np.clip(frame, 30, None) - 30
            assert (core * columns).sum() / core.sum() == pytest.approx(x[row], abs=0.15)
            assert (core * rows).sum() / core.sum() == pytest.approx(y[row], abs=0.15)
            assert frame.max() == pytest.approx(98, abs=8)
            assert -28 < frame.min() < -12
            return
    pytest.fail("no seed put the cell inside")


def test_under_oblique_light_the_truth_is_where_the_cell_seems_to_be() -> None:
    oblique = replace(LOOK, halo=0.0, length=6, width=6, relief=2.0, relief_angle=0.7)
    dx, dy = apparent_centre(oblique, 0.3, 0.0)
    sigma = 6 / 2.355
    # Centroid of the square of (1 + r u) exp(-u^2 / 2) along the light, u in units of sigma: r / (1 + r^2 / 2).
    assert np.hypot(dx, dy) == pytest.approx(sigma * 2 / 3, rel=0.03)
    assert np.arctan2(dy, dx) == pytest.approx(0.7, abs=0.02)
    assert apparent_centre(LOOK, 0.3, 0.5) == (0.0, 0.0)


def test_truth_follows_the_drift() -> None:
    recipe = replace(QUIET, gaits=(Gait.STUCK,), looks=(LOOK,), drift_per_frame=(1.5, -0.5), frames=10)
    made = next(m for m in (simulate(recipe, s) for s in range(30)) if len(m.truth) == 10)
    np.testing.assert_allclose(made.truth.x - made.truth.x[0], 1.5 * np.arange(10), atol=1e-9)
    np.testing.assert_allclose(made.truth.y - made.truth.y[0], -0.5 * np.arange(10), atol=1e-9)
    assert set(made.truth.motility) == {Motility.NONE}


def test_a_stuck_cell_is_no_truth_to_find_and_a_bright_swimmer_is_while_its_centre_is_in_the_field() -> None:
    shaking = replace(QUIET, jitter=0.5, gaits=(Gait.STUCK,) * 12, looks=(LOOK,) * 12)
    stuck = simulate(shaking, 3).truth
    assert len(stuck) > 0
    assert stuck.ignored.all()
    swimming = simulate(replace(QUIET, gaits=(Gait.SWIMMING,) * 40, looks=(LOOK,) * 40, depth_spread=0.1), 3).truth
    outside = (swimming.x < -0.5) | (swimming.x > 159.5) | (swimming.y < -0.5) | (swimming.y > 119.5)
    assert outside.any()
    assert swimming.ignored[outside].all()
    assert swimming.ignored[~outside].mean() < 0.3


def test_a_tethered_cell_never_leaves_its_place_and_is_there_to_find_even_as_it_passes_its_median() -> None:
    recipe = replace(QUIET, read_noise=8.0, frames=60, gaits=(Gait.TETHERED,) * 12, looks=(LOOK,) * 12)
    truth = simulate(recipe, 3).truth
    moves = []
    for track in truth.tracks():
        away = np.hypot(track.x - np.median(track.x), track.y - np.median(track.y)) * recipe.pixel_size_um
        moves.append(float(away.max()))
        if _well_in(track.x.min(), track.y.min()) and _well_in(track.x.max(), track.y.max()):
            assert len(set(track.ignored)) == 1  # of the whole film, not now and then
    assert min(moves) > 0
    assert max(moves) < 3
    assert not truth.ignored.all()
    assert simulate(replace(recipe, read_noise=200.0), 3).truth.ignored.all()


def test_what_is_too_faint_to_find_does_not_depend_on_the_stage() -> None:
    recipe = replace(QUIET, read_noise=8.0, gaits=(Gait.TRAPPED,) * 12, looks=(LOOK,) * 12)
    still, shaking = simulate(recipe, 5).truth, simulate(replace(recipe, jitter=0.4), 5).truth
    verdicts = [
        {(t.frames[k], t.ids[k]): t.ignored[k] for k in range(len(t)) if _well_in(t.x[k], t.y[k])}
        for t in (still, shaking)
    ]
    both = verdicts[0].keys() & verdicts[1].keys()
    assert {verdicts[0][row] for row in both} == {True, False}
    assert all(verdicts[0][row] == verdicts[1][row] for row in both)


def test_a_medium_that_moves_hides_faint_bacteria_and_no_strong_ones() -> None:
    def known(contrast: float, wobble: float = 0.0, restless: float = 0.0) -> float:
        look = replace(LOOK, contrast=contrast)
        recipe = replace(QUIET, frames=60, texture=20.0, read_noise=3.0, gaits=(Gait.SWIMMING,) * 20)
        recipe = replace(recipe, wobble=wobble, restless=restless)
        return float(1 - simulate(replace(recipe, looks=(look,) * 20), 5).truth.ignored.mean())

    still = known(10.0)
    assert still > 0.75
    assert known(10.0, wobble=0.6) < 0.8 * still
    assert known(10.0, restless=0.5) < 0.5 * still
    assert known(200.0, wobble=0.6) == known(200.0, restless=0.5) == known(200.0) > 0.75


@pytest.mark.parametrize("blur", [0.0, 0.5, 0.8])
def test_smoothed_noise_disturbs_as_much_as_is_counted(blur: float) -> None:
    y, x = np.mgrid[-8:9, -8:9]
    signal = np.exp(-(x * x + 2.0 * y * y) / 18).astype(np.float32)
    white = np.random.default_rng(1).standard_normal((1200, 1200)).astype(np.float32)
    noise = cv2.GaussianBlur(white, (0, 0), blur) if blur else white
    products = cv2.filter2D(noise / noise.std(), -1, signal)[20:-20, 20:-20]
    assert products.std() == pytest.approx(_smoothed_norm(signal, blur), rel=0.03)


def _well_in(x: float, y: float) -> bool:
    return 3 < x < 157 and 3 < y < 117


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0.0, Motility.NONE), (0.075, Motility.NONE), (0.076, Motility.LOW), (0.9, Motility.MEDIUM), (1.1, Motility.HIGH)],
)
def test_classes_are_the_papers(value: float, expected: Motility) -> None:
    assert motility_of(value) is expected


def test_brownian_motion_has_its_diffusivity_and_a_straight_run_more_at_longer_lags() -> None:
    rng = np.random.default_rng(0)
    walk = np.cumsum(rng.normal(0, np.sqrt(2 * 0.4 * 0.02), (20000, 2)), axis=0)
    assert path_diffusivity(walk[:, :], 0.02) == pytest.approx(0.4, rel=0.35)
    run = np.stack([np.arange(101) * 0.1, np.zeros(101)], axis=1)
    assert path_diffusivity(run, 0.02) == pytest.approx((0.1 * 25) ** 2 / (4 * 25 * 0.02))
    assert path_diffusivity(run[:1], 0.02) == 0


def test_the_class_in_the_truth_is_of_shorter_lags_than_that_of_a_track() -> None:
    x = np.arange(101) * 0.1
    track = TrackTable.of(np.arange(101), 0, x, 0.0, calibration=Calibration(1.0, 0.02))
    path = path_diffusivity(np.stack([x, np.zeros(101)], axis=1), 0.02)
    assert peak_diffusivity(track, track.calibration) == pytest.approx(2 * path)


def test_each_gait_moves_as_its_name_says() -> None:
    world = World(200, 200, 300, 0.25, 1 / 60, 15.0, 0.5)
    rng = np.random.default_rng(4)
    spread = {
        gait: np.median([path_diffusivity(swim(gait, world, rng).xy * 0.25, 1 / 60) for _ in range(15)])
        for gait in Gait
    }
    assert spread[Gait.STUCK] == 0
    assert spread[Gait.STUCK] < spread[Gait.TETHERED] < spread[Gait.SWIMMING]
    assert spread[Gait.STUCK] < spread[Gait.BROWNIAN] < spread[Gait.HOPPING] < spread[Gait.SWIMMING]
    assert spread[Gait.SWIMMING] > 1


@pytest.mark.parametrize("name", sorted(scenes.SCENES))
def test_scenes_are_standardised_and_of_any_size(name: str) -> None:
    for shape in ((100, 190), (230, 120)):
        image = scenes.SCENES[name](*shape, 1.0, np.random.default_rng(1))
        assert image.shape == shape
        assert image.dtype == np.float32
        assert float(image.mean()) == pytest.approx(0, abs=1e-3)
        assert float(image.std()) == pytest.approx(1, abs=1e-3)


def test_drawing_outside_the_image_changes_nothing_and_half_outside_half() -> None:
    image = np.zeros((60, 60), np.float32)
    draw(image, LOOK, -100, 30, 0.0, 0.0)
    assert not image.any()
    draw(image, LOOK, 0.0, 30.0, 0.0, 0.0)
    assert image[30, 0] == pytest.approx(LOOK.contrast, rel=0.05)


def test_collagen_looks_as_measured() -> None:
    """Against two stills of real collagen: sd 17-21 without shading, autocorrelation 0.5 at 7 px and gone at 16-27,
    noise 3-5 levels, cells 76 to 132 levels bright with a dark halo of 16 to 28 at radius 9-14."""
    texture = scenes.mottled(400, 400, 1.0, np.random.default_rng(3))
    spectrum = np.abs(np.fft.fft2(texture)) ** 2
    correlation = np.fft.ifft2(spectrum).real[0] / spectrum.mean()
    correlation = correlation / correlation[0]
    half = int(np.argmax(correlation < 0.5))
    assert 4 <= half <= 11
    assert np.abs(correlation[24:60]).max() < 0.25
    drawn = [draw_recipe("collagen", np.random.default_rng(k), width=660, height=492) for k in range(300)]
    textures, noises, brights, densities = [], [], [], []
    for recipe in drawn:
        textures.append(recipe.texture)
        noises.append(np.hypot(recipe.read_noise, recipe.shot_noise * np.sqrt(recipe.level / 255)))
        brights += [look.contrast for look in recipe.looks if look.contrast > 0]
        densities.append(len(recipe.gaits) * 660 * 492 / (708 * 540))
    for values, low, high in ((textures, 17, 21), (noises, 3, 5), (brights, 76, 132), (densities, 4, 14)):
        below, above = np.mean(np.less(values, low)), np.mean(np.greater(values, high))
        assert below > 0.01  # what was measured lies inside, with harder and easier films around it
        assert above > 0.03
        assert below + above < 0.98


def test_held_out_scenes_are_in_no_training_family() -> None:
    held_out = {"foam", "granular"}
    seen = {
        draw_recipe(family, np.random.default_rng(k), width=64, height=64).scene
        for family in FAMILIES
        if family not in held_out
        for k in range(60)
    }
    assert seen.isdisjoint(held_out)
    assert draw_recipe("foam", np.random.default_rng(1), width=64, height=64).scene == "foam"


def drawn(family: str) -> list[Recipe]:
    return [draw_recipe(family, np.random.default_rng(k), width=200, height=160) for k in range(40)]


def test_families_that_are_hard_in_one_respect_are_so() -> None:
    slow = [gait for recipe in drawn("slow") for gait in recipe.gaits]
    assert np.mean([gait in (Gait.BROWNIAN, Gait.TRAPPED) for gait in slow]) > 0.7
    tethered = [gait for recipe in drawn("tethered") for gait in recipe.gaits]
    assert 0.3 < np.mean([gait is Gait.TETHERED for gait in tethered]) < 0.7
    for recipe in drawn("faint"):
        noise = np.hypot(recipe.read_noise, recipe.shot_noise * np.sqrt(recipe.level / 255))
        assert np.median([abs(look.contrast) for look in recipe.looks] or [0]) <= 5 * noise + 1e-6
    for recipe in drawn("specks"):
        assert len(recipe.gaits) <= 6
        assert not recipe.decoy_looks or (len(recipe.decoy_looks) >= 5 and recipe.wobble >= 0.1)
    rooms = [248 * 208 / len(recipe.gaits) for recipe in drawn("crowded") if recipe.gaits]
    assert min(rooms) > 490
    assert np.quantile(rooms, [0.2, 0.8]) == pytest.approx([760, 2640], rel=0.3)
    assert all(6 <= recipe.frames <= 30 for recipe in drawn("brief"))
    asked = [draw_recipe(family, np.random.default_rng(1), width=200, height=160, frames=77) for family in FAMILIES]
    assert {recipe.frames for recipe in asked} == {77}


@pytest.mark.parametrize("bits", [8, 16])
def test_a_caption_changes_a_small_part_of_each_frame_and_no_truth(bits: int) -> None:
    recipe = replace(next(recipe for recipe in drawn("captioned") if recipe.gaits), frames=12, bits=bits)
    plain, written = (simulate(replace(recipe, caption=caption), 3) for caption in (False, True))
    differs = plain.film.frames != written.film.frames
    assert 0 < differs.mean() < 0.1
    assert (differs[0] != differs[-1]).any()  # the clock runs
    np.testing.assert_array_equal(plain.truth.x, written.truth.x)


def arguments(*words: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    command.add_arguments(parser)
    return parser.parse_args(words)


def test_the_command_writes_a_calibrated_film_and_its_truth_in_three_formats(tmp_path: Path) -> None:
    path = tmp_path / "Gel ä 1.tif"
    words = (str(path), "--frames", "6", "--width", "200", "--height", "150", "--seed", "3", "--family", "water")
    assert command.run(arguments(*words)) == 0
    with tifffile.TiffFile(path) as file:
        assert file.asarray().shape == (6, 150, 200)
        assert file.imagej_metadata is not None
        assert file.imagej_metadata["unit"] == "micron"
    csv, xml, mdf = (read_tracks(path.with_suffix(end)) for end in (".csv", ".xml", ".mdf"))
    assert len(csv) == len(xml) > csv.ignored.sum() == xml.ignored.sum() > 0
    np.testing.assert_allclose(np.sort(csv.x[~csv.ignored]), np.sort(mdf.x), atol=1e-3)
    assert not list(tmp_path.glob("*.part"))


def test_sizes_out_of_range_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="--frames is 0"):
        command.run(arguments(str(tmp_path / "a.tif"), "--frames", "0"))
    with pytest.raises(SettingsError, match=r"let it end in \.tif"):
        command.run(arguments(str(tmp_path / "a.avi")))
