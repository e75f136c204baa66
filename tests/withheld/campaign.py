"""Measuring campaigns: sphere maps, touched spheres, ballbar tests; commanded positions only.

Every pose begins with a device-less approach row. Times in s, positions mm, words deg.
"""
from dataclasses import dataclass

import numpy as np

import frames
from rows import Rows

MODES = ("dpp", "rtdfo", "rtcp", "tw")


@dataclass
class Plan:
    """What a campaign contains; columns beyond the required ones follow from it."""
    devices: tuple = ("sphere",)
    poses: int = 84
    touch_poses: int = 32
    bar_step_deg: float = 3.0
    repeats: bool = False
    modes: bool = True
    swing_c: float = 1.2          # temperature change
    load_kg: float = 0.0
    clamp: bool = False
    spindle: bool = False
    calibrated: bool = False
    touch_azimuth_deg: float = 0.0
    overtravel_mm: float = 2.0    # commanded end point beyond nominal contact
    rotary_deg_s: float = 6.0
    side_before: tuple = (1, 1, 1, 1, 1)   # from which X Y Z and the rotary axes came before their first move
    side_told: bool = True                 # the table's head says so

    def columns(self):
        """Optional CSV columns of this campaign."""
        return (["feed_mm_min", "temperature_c"] + (["spindle_deg"] if self.spindle else [])
                + (["load_kg"] if self.load_kg else []) + (["clamped"] if self.clamp else []))


class Builder:
    """Appends records while a clock runs."""

    def __init__(self, rng, machine, plan, start_s=0.0, session_s=7200.0, side_before=None):
        self.rng, self.machine, self.plan = rng, machine, plan
        self.side_before = plan.side_before if side_before is None else side_before
        self.time_s, self.session_s, self.records, self.visit = start_s, session_s, [], 0

    def turned(self, words_deg):
        """(n,4,4) nominal M <- W for words (n,2)."""
        m, n = self.machine, len(words_deg)
        chain = np.broadcast_to(np.eye(4), (n, 4, 4))
        for k in (0, 1):
            point = np.broadcast_to(m.points_mm[k], (n, 3))
            spin = frames.rotation_about(np.radians(words_deg[:, k, None]) * m.directions[k])
            chain = chain @ frames.translation(point) @ spin @ frames.translation(-point)
        return chain

    def temperature(self, time_s):
        """Shop and machine temperature: warming, and a swing if the plan wants a large change."""
        if self.plan.swing_c < 2:
            return 20.0 + self.plan.swing_c * (1 - np.exp(-time_s / 5400.0))
        return 20.0 + self.plan.swing_c * np.sin(2 * np.pi * time_s / (0.75 * self.session_s))

    def add(self, wait_s, **fields):
        """One row after wait_s."""
        self.time_s += wait_s
        fields.update(time_s=self.time_s, temperature_c=self.temperature(self.time_s))
        if self.plan.load_kg:
            third = int(self.time_s / (self.session_s / 3)) % 2
            fields["load_kg"] = self.plan.load_kg * third
        self.records.append(fields)

    def rows(self):
        """Finished table."""
        return Rows(self.records, self.side_before)

    # --- probing -------------------------------------------------------------------------------------
    def poses(self, count, grid):
        """Random poses: sphere, words, approach offsets, mode, spindle, clamp."""
        rng, plan = self.rng, self.plan
        low, high = np.array(self.machine.tilt_limits_deg) * 0.82
        steps = np.round(np.linspace(low, high, int(rng.choice([9, 13, 37]))))
        tilt = rng.choice(steps, count) if grid else rng.uniform(low, high, count)
        turn = rng.choice(np.arange(0, 360, 15), count) + rng.uniform(-9, 9, count) if grid \
            else rng.uniform(-20, 360, count)
        spheres = [a.name for a in self.machine.artefacts if a.kind == "sphere"]
        out = []
        for i in range(count):
            out.append(dict(feature=spheres[i % len(spheres)], words=np.array([tilt[i], turn[i]]),
                            approach=6.0 * rng.choice([-1.0, 1.0], 2),
                            mode=str(rng.choice(MODES)) if plan.modes else "rtcp",
                            spindle_deg=float(rng.choice([0, 180])) if plan.spindle else 0.0,
                            clamped=float(rng.integers(2)) if plan.clamp else 0.0))
        return [out[i] for i in rng.permutation(count)]

    def with_repeats(self, poses):
        """About a third of the poses (at least 20) come again later, unchanged."""
        again = [poses[i] for i in self.rng.permutation(len(poses))[:max(20, len(poses) // 3)]]
        both = poses + again
        return [both[i] for i in self.rng.permutation(len(both))]

    def gauge(self, pose, words):
        """Gauge point that puts the stylus on the declared sphere centre."""
        center = next(a.center_mm for a in self.machine.artefacts if a.name == pose["feature"])
        return frames.apply(self.turned(words[None]), center)[0] - self.machine.tip_mm

    def visit_fields(self, pose):
        """Columns that all rows of a pose share."""
        return {k: pose[k] for k in ("feature", "mode", "spindle_deg", "clamped")}

    def sphere_map(self, name, poses):
        """Approach row, then three components of the found centre."""
        for pose in poses:
            before = pose["words"] + pose["approach"]
            common = dict(test=name, **self.visit_fields(pose))
            self.add(6.0, pos_mm=self.gauge(pose, before), ang_deg=before, **common)
            self.visit += 1
            for k in range(3):
                self.add(22.0 if k == 0 else 0.0, device="sphere", pos_mm=self.gauge(pose, pose["words"]),
                         ang_deg=pose["words"], dir=np.eye(3)[k], visit=self.visit, **common)

    def touch_pattern(self):
        """Nine approach directions in M: pole, four at the equator, four at 45 deg between them."""
        azimuth = np.radians(self.plan.touch_azimuth_deg) + np.arange(8) * np.pi / 4
        lift = np.where(np.arange(8) % 2 == 0, 0.0, np.pi / 4)
        sides = np.array([np.cos(azimuth) * np.cos(lift), np.sin(azimuth) * np.cos(lift), np.sin(lift)]).T
        return -np.vstack([[0, 0, 1], sides])

    def touch_map(self, name, poses):
        """Approach row, then nine touches, each from a stand-off point along its direction."""
        machine = self.machine
        for pose in poses:
            before = pose["words"] + pose["approach"]
            common = dict(test=name, **self.visit_fields(pose))
            self.add(6.0, pos_mm=self.gauge(pose, before) + [0, 0, 60], ang_deg=before, **common)
            self.visit += 1
            at = self.gauge(pose, pose["words"])
            contact = (machine.artefacts[0].diameter_mm + machine.ball_diameter_mm) / 2
            for along in self.touch_pattern():
                common["ang_deg"] = pose["words"]
                self.add(2.0, pos_mm=at - along * (contact + 8.0), **common)
                self.add(1.5, device="touch", dir=along, visit=self.visit, feed_mm_min=60.0,
                         pos_mm=at - along * (contact - self.plan.overtravel_mm), **common)

    # --- ballbar -------------------------------------------------------------------------------------
    def planar(self, name, plane, turn, feed, step_deg):
        """Circle of the linear axes about the centre pivot; turn +1 ccw seen from the plane's normal."""
        pivot = next(a for a in self.machine.artefacts if a.kind == "center_pivot")
        radius = self.machine.bar_length_mm
        first, second = {"xy": (0, 1), "zx": (0, 2), "yz": (1, 2)}[plane]
        span = (0.0, 360.0) if plane == "xy" else (-20.0, 200.0)
        angles = np.arange(span[0], span[1] + 1e-9, step_deg)
        swing = -turn if plane == "zx" else turn        # x towards z is clockwise about +Y
        if swing < 0:
            angles = angles[::-1]
        center = pivot.center_mm - self.machine.cup_mm
        e1, e2 = np.eye(3)[first], np.eye(3)[second]
        self.visit += 1
        wait = 20.0
        for angle in np.radians(angles):
            self.add(wait, test=name, device="ballbar", feature=pivot.name, feed_mm_min=feed,
                     pos_mm=center + radius * (np.cos(angle) * e1 + np.sin(angle) * e2), visit=self.visit,
                     path_center_mm=center, path_axis=np.cross(e1, e2) * swing, path_radius_mm=radius,
                     path_turn_rad=abs(angle - np.radians(angles[0])), clamped=float(self.plan.clamp))
            wait = np.radians(step_deg) * radius / (feed / 60.0)

    def rotary(self, name, axis, bar, turn, step_deg):
        """One rotary axis turns, the linear axes follow; bar: its direction at home, fixed to the table."""
        machine = self.machine
        pivot = next(a for a in machine.artefacts if a.kind == "center_pivot")
        span = (0.0, 360.0) if axis == 1 else (-30.0, min(90.0, machine.tilt_limits_deg[1]))
        words = np.zeros((int(round((span[1] - span[0]) / step_deg)) + 1, 2))
        words[:, axis] = np.linspace(*span, len(words))[::1 if turn > 0 else -1]
        cup = pivot.center_mm + machine.bar_length_mm * np.asarray(bar, float)
        line = machine.directions[axis]
        foot = machine.points_mm[axis] + line * np.dot(cup - machine.points_mm[axis], line)
        place = frames.apply(self.turned(words), cup) - machine.cup_mm
        self.visit += 1
        wait = 20.0
        for word, point in zip(words, place):
            self.add(wait, test=name, mode="rtcp", device="ballbar", feature=pivot.name, feed_mm_min=1500.0,
                     pos_mm=point, ang_deg=word, visit=self.visit, path_center_mm=foot - machine.cup_mm,
                     path_axis=line * turn, path_radius_mm=np.linalg.norm(cup - foot),
                     path_turn_rad=np.radians(abs(word[axis] - words[0, axis])))
            wait = step_deg / self.plan.rotary_deg_s

    def bar_tests(self):
        """Planar circles at two feeds both ways, radial and axial tests of both rotary axes, out and back."""
        step = self.plan.bar_step_deg
        first, second = self.machine.letters
        bars = {(0, "radial"): (0, 0, 1), (1, "radial"): (1, 0, 0), (1, "axial"): (0, 0, 1),
                (0, "axial"): (0, 1, 0) if first == "B" else (1, 0, 0)}
        for suffix in ("", "_r2") if self.plan.repeats else ("",):
            for plane in ("xy", "zx", "yz"):
                for feed in (1000, 4000):
                    for label, turn in (("ccw", 1), ("cw", -1)):
                        self.planar(f"{plane}_{label}_{feed}{suffix}", plane, turn, float(feed), step)
            for axis in (0, 1):
                for kind in ("radial", "axial"):
                    for label, turn in (("pos", 1), ("neg", -1)):
                        self.rotary(f"{kind}_{self.machine.letters[axis]}_{label}{suffix}", axis,
                                    bars[axis, kind], turn, step / 2 if axis == 0 else step)

    def bar_holdout(self):
        """Another feed, another step, oblique bars."""
        for plane in ("xy", "zx", "yz"):
            for label, turn in (("ccw", 1), ("cw", -1)):
                self.planar(f"{plane}_{label}_2500", plane, turn, 2500.0, 7.0)
        for axis in (0, 1):
            bar = self.rng.normal(size=3)
            bar[2] = abs(bar[2]) + 0.5
            bar /= np.linalg.norm(bar)
            for label, turn in (("pos", 1), ("neg", -1)):
                self.rotary(f"oblique_{self.machine.letters[axis]}_{label}", axis, bar, turn,
                            1.5 if axis == 0 else 3.0)


def session_length(plan):
    """Rough duration of the training part in s, for temperature and load schedules."""
    extra = 1.35 if plan.repeats else 1.0
    bar = 1000.0 * (2 if plan.repeats else 1) if "ballbar" in plan.devices else 0.0
    probe = plan.poses * 28.0 * extra if "sphere" in plan.devices else 0.0
    return bar + probe + (plan.touch_poses * 37.5 * extra if "touch" in plan.devices else 0.0)


def build(rng, machine, plan):
    """(training rows, hold-out rows)."""
    length = session_length(plan)
    train = Builder(rng, machine, plan, 0.0, length)
    for device, count, run in (("sphere", plan.poses, train.sphere_map), ("touch", plan.touch_poses, train.touch_map)):
        if device in plan.devices:
            poses = train.poses(count, True)
            run("map" if device == "sphere" else "touch_map", train.with_repeats(poses) if plan.repeats else poses)
    if "ballbar" in plan.devices:
        train.bar_tests()
    rows = train.rows()
    hold = Builder(rng, machine, plan, train.time_s + 300.0, length, rows.last_side)
    if "sphere" in plan.devices:
        hold.sphere_map("map", hold.poses(max(40, plan.poses // 3), False))
    if "touch" in plan.devices:
        hold.touch_map("touch_map", hold.poses(16, False))
    if "ballbar" in plan.devices:
        hold.bar_holdout()
    return rows, hold.rows()
