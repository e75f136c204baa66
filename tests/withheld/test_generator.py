#!/usr/bin/env python3
"""Self-test of the generator: frames and signs against the reference sets, closed forms, sizes, sealing.

`python3 test_generator.py [REFERENCE_FOLDER]`; without the folder the comparison with reference sets is skipped.
"""
import filecmp
import json
import os
import sys
import tempfile
import unittest

import numpy as np

import cases
import effects
import frames
import generate
import noise
import registry
from campaign import Plan, build
from forward import Errors, Scene
from machine import Base, draw_machine
from oracle import Fit
from reference import load_machine
from rows import approach_sign, read_csv

FOLDER = os.path.join(os.environ.get("TRUNNION_REFERENCE", ""), "readings")
REFERENCE = FOLDER if os.path.isdir(FOLDER) else None


def small_case(letters, devices=("sphere", "ballbar"), **plan):
    """A small campaign with its scene."""
    rng = np.random.Generator(np.random.PCG64(7))
    machine = draw_machine(rng, letters)
    machine.session_s = 3000.0
    plan = Plan(devices=devices, poses=30, touch_poses=6, bar_step_deg=6.0, **plan)
    train, _ = build(rng, machine, plan)
    base = Base(machine, set(devices))
    return rng, machine, base, train, Scene(machine, base, train)


@unittest.skipUnless(REFERENCE, "no reference sets")
class ReferenceSets(unittest.TestCase):
    """The contract's three examples must come out as their truth says."""

    def load(self, name):
        folder = os.path.join(REFERENCE, name)
        machine = load_machine(os.path.join(folder, "setup.toml"))
        train, values = read_csv(os.path.join(folder, "readings.csv"), machine.letters)
        hold, _ = read_csv(os.path.join(folder, "holdout.csv"), machine.letters)
        with open(os.path.join(folder, "truth.json")) as handle:
            truth = json.load(handle)
        base = Base(machine, set(train.device) - {""})
        sigma = noise.sigma_mm(train, machine.noise_um)
        return machine, Scene(machine, base, train), Scene(machine, base, hold), values, sigma, truth

    def hold_z(self, fit, scene, truth):
        sigma = np.array(truth["sigma"])
        use = sigma > 0
        return np.sqrt(np.mean(((fit.predict(scene) - truth["holdout"])[use] / sigma[use]) ** 2))

    def check(self, name, builder, amplitude):
        machine, scene, hold, values, sigma, truth = self.load(name)
        plain = Fit(scene, values, sigma)
        self.assertAlmostEqual(plain.z_rms, truth["base_train_z_rms"], delta=1e-3)
        self.assertAlmostEqual(self.hold_z(plain, hold, truth), truth["base_holdout_z_rms"], delta=1e-3)
        if builder:
            effect = builder(np.random.Generator(np.random.PCG64(1)), machine)
            full = Fit(scene, values, sigma, [effect])
            self.assertAlmostEqual(full.z_rms, 1.0, delta=0.05)
            self.assertAlmostEqual(self.hold_z(full, hold, truth), 1.0, delta=0.06)
            self.assertAlmostEqual(full.amplitudes[0][0] / amplitude(truth), 1.0, delta=0.01)

    def test_null(self):
        self.check("bc_probe_none", None, None)

    def test_x_backlash(self):
        self.check("ac_ballbar_x_backlash", registry.singles("AC")["X.backlash"],
                   lambda t: t["params"]["X.backlash"]["gap"])

    def test_c_backlash(self):
        self.check("bc_both_c_backlash", registry.singles("BC")["C.backlash"],
                   lambda t: t["params"]["C.backlash"]["gap"])


class Physics(unittest.TestCase):
    """Closed forms derived apart from the code under test."""

    def test_rotation(self):
        turn = frames.rotation_about(np.array([[0, 0, np.pi / 2]]))
        np.testing.assert_allclose(frames.apply(turn, np.array([1.0, 0, 0])), [[0, 1, 0]], atol=1e-15)

    def test_store_mismatch_is_what_a_control_with_wrong_stores_does(self):
        for letters in (("B", "C"), ("A", "C")):
            rng, machine, base, train, scene = small_case(letters, ("sphere",))
            dp, dd = rng.normal(size=3) * 0.01, rng.normal(size=3) * 0.01
            p, d = machine.points_mm[0], machine.points_mm[1] - machine.points_mm[0]
            n = train.n
            wide = lambda v: np.broadcast_to(v, (n, 3))
            def command(p, d):
                w = scene.center_mm - p - d            # work zero measured at home with these stores
                return p + frames.turn(scene.turned[0], wide(d) + frames.turn(scene.turned[1], w))
            moved = command(p + dp, d + dd) - command(p, d)
            np.testing.assert_allclose(effects.store_shift(scene, dp, dd), moved, atol=1e-12)

    def test_location_error_turns_with_its_carrier(self):
        rng, machine, base, train, scene = small_case(("B", "C"), ("sphere",))
        values = np.zeros(base.size)
        values[base.names.index(("shift", 1, 0))] = 0.010          # EX0C
        moved = scene.work_point(Errors(train.n), values, scene.center_mm) \
            - scene.work_point(Errors(train.n), np.zeros(base.size), scene.center_mm)
        tilt = -train.ang_deg[:, 0]                                 # direction of B is -Y
        expected = 0.010 * np.array([np.cos(np.radians(tilt)), 0 * tilt, -np.sin(np.radians(tilt))]).T
        np.testing.assert_allclose(moved, expected, atol=1e-12)

    def test_touch_contact_and_signs(self):
        rng, machine, base, train, scene = small_case(("A", "C"), ("touch",), overtravel_mm=2.0)
        touch = train.device == "touch"
        plain = scene.readings(np.zeros(base.size))
        np.testing.assert_allclose(plain[touch], -2.0, atol=2e-6)   # contact lies 2 mm before the end point
        larger = effects.Effect("", ["r_mm"], [0.004], lambda s, e, a: e.radius_mm.__iadd__(a[0]))
        np.testing.assert_allclose((scene.readings(np.zeros(base.size), [larger]) - plain)[touch], -0.004, atol=1e-9)

    def test_linear_backlash_flips_and_spares_found_spheres(self):
        rng, machine, base, train, scene = small_case(("B", "C"))
        effect = effects.linear_backlash(rng, machine, 0)
        change = scene.readings(np.zeros(base.size), [effect]) - scene.readings(np.zeros(base.size))
        self.assertEqual(np.abs(change[train.device == "sphere"]).max(), 0.0)
        side = (train.test == "xy_ccw_1000") & (np.abs(train.velocity[:, 0]) > 5)
        arm = (train.pos_mm - train.path_center_mm)[side, 0] / machine.bar_length_mm
        np.testing.assert_allclose(change[side], 0.5 * effect.amplitude[0] * train.sign[side, 0] * arm, atol=2e-7)

    def test_squareness_closed_form(self):
        rng, machine, base, train, scene = small_case(("B", "C"), ("ballbar",))
        effect = effects.squareness(rng, machine, "XY")
        change = scene.readings(np.zeros(base.size), [effect]) - scene.readings(np.zeros(base.size))
        pick = train.test == "xy_cw_1000"
        arm = (train.pos_mm - train.path_center_mm)[pick]
        y = train.pos_mm[pick, 1]
        np.testing.assert_allclose(change[pick], -effect.amplitude[0] * y * arm[:, 0] / machine.bar_length_mm, atol=3e-7)

    def test_approach_rule(self):
        axes = np.array([[0.0, 5], [0, 4], [1, 4], [1, 6], [0.5, 6]])
        signs = approach_sign(axes, (-1, 1))
        np.testing.assert_array_equal(signs[:, 0], [-1, -1, 1, 1, -1])
        np.testing.assert_array_equal(signs[:, 1], [1, -1, -1, 1, 1])

    def test_an_axis_that_stands_keeps_its_side(self):
        _, _, _, train, _ = small_case(("B", "C"), ("ballbar",), side_before=(1, 1, 1, 1, -1))
        circle = train.test == "xy_ccw_1000"
        self.assertEqual(set(train.sign[circle, 4]), {-1.0})
        self.assertEqual(set(train.sign[circle, 0]), {-1.0, 0.0, 1.0})
        later = train.test == "radial_B_pos"
        self.assertEqual(set(train.sign[later, 4]), {-1.0})       # C has not moved yet

    def test_commands_put_devices_on_their_nominal_value(self):
        for letters in (("B", "C"), ("A", "C")):
            rng, machine, base, train, scene = small_case(letters)
            self.assertLess(np.abs(scene.readings(np.zeros(base.size))).max(), 3e-6)


class Cases(unittest.TestCase):
    """Sizes, reproduction, sealing."""

    def test_every_single_reaches_its_size(self):
        names = registry.all_names(("B", "C"))
        rng = np.random.Generator(np.random.PCG64(11))
        for number, name in enumerate(names):
            letters = (("B", "C"), ("A", "C"))[number % 2]
            name = name.replace("B.", letters[0] + ".") if name.startswith("B.") else name
            case = cases.draw_case(rng, cases.Wish("size only", (name,), "right", letters))
            self.assertEqual(case.effects[0].name, name)
            self.assertTrue(0.75 < case.sizes[0] < 8.5, (name, case.sizes))

    def test_same_seed_same_bytes_and_nothing_leaks(self):
        with tempfile.TemporaryDirectory() as folder:
            for copy in "ab":
                generate.main([os.path.join(folder, copy), "--seed", "5", "--sets", "6"])
            for name in sorted(os.listdir(os.path.join(folder, "a", "sets"))):
                self.assertEqual(sorted(os.listdir(os.path.join(folder, "a", "sets", name))),
                                 ["holdout.csv", "readings.csv", "setup.toml"])
                for part in (f"sets/{name}/readings.csv", f"sets/{name}/holdout.csv", f"truth/{name}.json"):
                    self.assertTrue(filecmp.cmp(os.path.join(folder, "a", part), os.path.join(folder, "b", part), False))
                with open(os.path.join(folder, "a", "truth", name + ".json")) as handle:
                    truth = json.load(handle)
                self.assertTrue(0.85 < truth["oracle_train_z_rms"] < 1.15, truth["oracle_train_z_rms"])
                with open(os.path.join(folder, "a", "sets", name, "holdout.csv")) as handle:
                    data = [line for line in handle if not line.startswith(("#", "index"))]
                self.assertTrue(all(line.endswith(",\n") for line in data))
                self.assertEqual(len(data), len(truth["holdout"]))


if __name__ == "__main__":
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        REFERENCE = sys.argv.pop(1)
    unittest.main()
