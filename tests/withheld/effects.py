"""Rotary, linear and control effects in this generator's own forms.

An Effect adds to forward.Errors. Amplitudes enter (nearly) linearly and are scaled to the wanted size; keys
(periods, phases, time constants) are drawn once. Signs: actual = commanded + error; rotary angles about the
axis's `direction`, E.. errors along and about + axes of M (of the carrier for C).
"""
import numpy as np

import frames


class Effect:
    """name: contract's name. labels: one per amplitude, with unit. needs: what a campaign must contain."""

    def __init__(self, name, labels, amplitude, apply, needs=(), keys=None, step=None, fixed=False):
        self.name, self.labels = name, list(labels)
        self.amplitude = np.asarray(amplitude, float)
        self.apply, self.needs, self.keys, self.fixed = apply, set(needs), keys or {}, fixed
        unit = {"rad": 1e-5, "mm": 1e-3}
        self.step = np.array([step or unit.get(label.rsplit("_", 1)[-1], 1.0) for label in self.labels])

    def scaled(self, factor):
        """The same effect, `factor` times as large."""
        return Effect(self.name, self.labels, self.amplitude * factor, self.apply, self.needs, self.keys,
                      self.step[0] if len(set(self.step)) == 1 else None, self.fixed)

    def parameters(self):
        """For the truth file."""
        return {**dict(zip(self.labels, map(float, self.amplitude))), **self.keys}


def spread(rng, count, scale):
    """Amplitudes of one group: all alive, one of them large."""
    values = rng.normal(size=count) * 0.4
    values[rng.integers(count)] = rng.choice([-1.0, 1.0])
    return values * scale


def harmonics(angle_rad, orders):
    """Columns cos k, sin k for each order: (n, 2*len)."""
    return np.stack([f(k * angle_rad) for k in orders for f in (np.cos, np.sin)], axis=1)


def wave_labels(orders, unit, prefix=""):
    """Names of the amplitudes of harmonics()."""
    return [f"{prefix}{f}{k}_{unit}" for k in orders for f in ("cos", "sin")]


# --- rotary axes -------------------------------------------------------------------------------------
def rotary_positioning(rng, machine, axis, orders=(1, 2)):
    """Angle error a1 cos + b1 sin + ..., e.g. an eccentric encoder (order 1)."""
    def apply(scene, errors, a):
        errors.angle_rad[:, axis] += harmonics(scene.word_rad[:, axis], orders) @ a
    return Effect(machine.letters[axis] + ".positioning", wave_labels(orders, "rad"),
                  spread(rng, 2 * len(orders), 4e-5), apply)


def rotary_cyclic(rng, machine, axis):
    """Angle error once per tooth of worm or gear."""
    teeth = int(rng.choice([36, 40, 45, 72, 90, 180]))
    def apply(scene, errors, a):
        errors.angle_rad[:, axis] += harmonics(scene.word_rad[:, axis], (teeth,)) @ a
    return Effect(machine.letters[axis] + ".cyclic", ["cos_rad", "sin_rad"], spread(rng, 2, 2e-5), apply,
                  keys={"per_turn": teeth})


def rotary_motion(rng, machine, axis, kind, orders=None):
    """Error motion: radial (two directions across), axial, or tilt about the two directions across."""
    orders = orders or ((1, 2) if axis == 0 or kind != "radial" else (2, 3))
    across = machine.radial(axis)
    where = [i for i in range(3) if i not in across] if kind == "axial" else across
    unit, scale = ("rad", 2e-5) if kind == "tilt" else ("mm", 2e-3)
    labels = [label for i in where for label in
              wave_labels(orders, unit, f"E{'ABC'[i] if kind == 'tilt' else 'XYZ'[i]}{machine.letters[axis]}_")]
    def apply(scene, errors, a):
        target = errors.axis_tilt_rad if kind == "tilt" else errors.axis_shift_mm
        waves = harmonics(scene.word_rad[:, axis], orders)
        for row, i in enumerate(where):
            target[axis][:, i] += waves @ a[row * waves.shape[1]:(row + 1) * waves.shape[1]]
    return Effect(f"{machine.letters[axis]}.{kind}", labels, spread(rng, len(labels), scale), apply)


def rotary_backlash(rng, machine, axis):
    """actual = commanded + gap/2 * sign of travel or approach; mostly lost motion of a worn worm."""
    def apply(scene, errors, a):
        errors.angle_rad[:, axis] += 0.5 * a[0] * scene.rows.sign[:, 3 + axis]
    return Effect(machine.letters[axis] + ".backlash", ["gap_rad"], [rng.choice([-1, 1, 1]) * 5e-5], apply)


# --- linear axes -------------------------------------------------------------------------------------
def linear_scale(rng, machine, i):
    """Position error proportional to position."""
    def apply(scene, errors, a):
        errors.gauge_mm[:, i] += a[0] * scene.rows.pos_mm[:, i]
    return Effect("XYZ"[i] + ".scale", ["slope_mm_per_mm"], [rng.choice([-1, 1]) * 2e-5], apply, step=1e-5)


def linear_straightness(rng, machine, i):
    """A bow of the guide about machine zero, sideways in both directions; mm at 200 mm."""
    side = [k for k in range(3) if k != i]
    def apply(scene, errors, a):
        bow = (scene.rows.pos_mm[:, i] / 200.0) ** 2
        errors.gauge_mm[:, side] += bow[:, None] * a
    return Effect("XYZ"[i] + ".straightness", [f"E{'XYZ'[k]}{'XYZ'[i]}_bow_mm" for k in side],
                  spread(rng, 2, 2e-3), apply)


def linear_angular(rng, machine, i):
    """Roll, pitch, yaw proportional to position, turning the slides further along too; rad at 200 mm."""
    def apply(scene, errors, a):
        errors.carriage_rad[i] += (scene.rows.pos_mm[:, i] / 200.0)[:, None] * a
    return Effect("XYZ"[i] + ".angular", [f"E{'ABC'[k]}{'XYZ'[i]}_rad" for k in range(3)], spread(rng, 3, 2e-5),
                  apply)


def linear_cyclic(rng, machine, i):
    """Once per turn of the ball screw."""
    pitch = float(rng.choice([5.0, 8.0, 10.0, 12.0, 16.0, 20.0]))
    def apply(scene, errors, a):
        errors.gauge_mm[:, i] += harmonics(2 * np.pi / pitch * scene.rows.pos_mm[:, i], (1,)) @ a
    return Effect("XYZ"[i] + ".cyclic", ["cos_mm", "sin_mm"], spread(rng, 2, 1.5e-3), apply, keys={"pitch_mm": pitch})


def reversing(scene):
    """Rows where linear reversal shows: in a found sphere it cancels."""
    return ~(scene.rows.device == "sphere")


def linear_backlash(rng, machine, i):
    """actual = commanded + gap/2 * sign."""
    def apply(scene, errors, a):
        errors.gauge_mm[:, i] += 0.5 * a[0] * scene.rows.sign[:, i] * reversing(scene)
    return Effect("XYZ"[i] + ".backlash", ["gap_mm"], [rng.choice([-1, 1, 1]) * 4e-3], apply, {"ballbar|touch"})


def since_reversal_rad(rows, i):
    """Path angle since axis i last reversed in its test (inf before the first reversal)."""
    out = np.full(rows.n, np.inf)
    for name in np.unique(rows.test[rows.bar]):
        index = np.flatnonzero(rows.test == name)
        speed, turn = rows.velocity[index, i], rows.path_turn_rad[index]
        flips = np.flatnonzero((speed[:-1] * speed[1:] < 0) | ((speed[:-1] == 0) & (speed[1:] != 0)))
        for k in flips:
            if k == 0:
                continue
            share = 0.0 if speed[k] == speed[k + 1] else speed[k] / (speed[k] - speed[k + 1])
            at = turn[k] + share * (turn[k + 1] - turn[k])
            out[index[k + 1:]] = turn[k + 1:] - at
    return out


def linear_reversal_spike(rng, machine, i):
    """Friction holds the axis back after a reversal: -sign * height * exp(-path angle since / decay)."""
    decay = np.radians(rng.uniform(2.0, 9.0))
    def apply(scene, errors, a):
        errors.gauge_mm[:, i] -= a[0] * scene.rows.sign[:, i] * np.exp(-since_reversal_rad(scene.rows, i) / decay)
    return Effect("XYZ"[i] + ".reversal_spike", ["height_mm"], [6e-3], apply, {"ballbar"}, {"decay_rad": float(decay)})


def linear_lateral_play(rng, machine, i):
    """A worn guide steps sideways with the direction of travel."""
    side = [k for k in range(3) if k != i]
    def apply(scene, errors, a):
        errors.gauge_mm[:, side] += 0.5 * (scene.rows.sign[:, i] * reversing(scene))[:, None] * a
    return Effect("XYZ"[i] + ".lateral_play", [f"{'XYZ'[k]}_mm" for k in side], spread(rng, 2, 3e-3), apply,
                  {"ballbar|touch"})


def squareness(rng, machine, pair):
    """XY: X shifts by -s*y; YZ: Y by -s*z; ZX: X by +s*z (s: angle error of the second axis, rad)."""
    moved, by, sign = {"XY": (0, 1, -1), "YZ": (1, 2, -1), "ZX": (0, 2, 1)}[pair]
    def apply(scene, errors, a):
        errors.gauge_mm[:, moved] += sign * a[0] * scene.rows.pos_mm[:, by]
    return Effect(pair + ".squareness", ["angle_rad"], [rng.choice([-1, 1]) * 3e-5], apply)


# --- control and servo -------------------------------------------------------------------------------
def servo_mismatch(rng, machine):
    """Each linear axis runs late by its own time: -lag * velocity."""
    lag = rng.choice([-1, 1], 3) * rng.uniform(0.3, 1.0, 3)
    lag[rng.integers(3)] = 0.0
    def apply(scene, errors, a):
        errors.gauge_mm -= scene.rows.velocity[:, :3] * a
    return Effect("servo.mismatch", ["lag_X_s", "lag_Y_s", "lag_Z_s"], lag * 1e-4, apply, {"ballbar"}, step=1e-4)


def servo_contour(rng, machine):
    """A first-order loop shrinks circles: inwards by half (time constant)^2 * v^2 / radius."""
    def apply(scene, errors, a):
        rows = scene.rows
        arm = rows.pos_mm - rows.path_center_mm
        radius = np.maximum(rows.path_radius_mm, 1.0)
        pull = (rows.velocity[:, :3] ** 2).sum(axis=1) / radius ** 2 * rows.bar
        errors.gauge_mm -= a[0] * pull[:, None] * arm
    return Effect("servo.contour", ["half_time_squared_s2"], [5e-5], apply, {"ballbar"}, step=1e-6)


def rounded(rng, machine, step):
    """The control rounds every commanded position to its increment (same number for mm and deg)."""
    def apply(scene, errors, a):
        rows = scene.rows
        errors.gauge_mm += np.round(rows.pos_mm / step) * step - rows.pos_mm
        errors.angle_rad += np.radians(np.round(rows.ang_deg / step) * step - rows.ang_deg)
    return Effect("control.rounding", [], [], apply, keys={"step": step}, fixed=True)


def chord(rng, machine, block_mm):
    """Circles cut into straight blocks of block_mm: the tool runs on the chord, inside the arc."""
    def apply(scene, errors, a):
        rows = scene.rows
        radius = np.maximum(rows.path_radius_mm, 1e-9)
        arc = np.minimum(block_mm / radius, 0.5)
        part = np.mod(rows.path_turn_rad / arc, 1.0)
        inward = (1 - part) * np.cos(part * arc) + part * np.cos((1 - part) * arc) - 1
        ahead = -(1 - part) * np.sin(part * arc) + part * np.sin((1 - part) * arc)
        arm = (rows.pos_mm - rows.path_center_mm) * rows.bar[:, None]
        arm -= rows.path_axis * np.einsum("ni,ni->n", arm, rows.path_axis)[:, None]
        errors.gauge_mm += inward[:, None] * arm + ahead[:, None] * np.cross(rows.path_axis, arm)
    return Effect("control.chord", [], [], apply, {"ballbar"}, {"block_mm": block_mm}, fixed=True)


def store_shift(scene, delta_first, delta_second):
    """How far a store in error moves the tool against the declared one, in M: -(home-zeroed e) of each row.

    e = (R0 R1 - I)(d0 + d1) - (R0 - I) d1 with exact rotations of the commanded words.
    """
    n = scene.rows.n
    total = np.broadcast_to(delta_first + delta_second, (n, 3))
    second = np.broadcast_to(delta_second, (n, 3))
    both = frames.turn(scene.turned[0], frames.turn(scene.turned[1], total))
    return -(both - total - frames.turn(scene.turned[0], second) + second)


def pivot_g54(rng, machine):
    """The work zero of the four programs: in force - declared, rows of dpp and rtdfo."""
    def apply(scene, errors, a):
        use = np.isin(scene.rows.mode, ("dpp", "rtdfo"))
        errors.gauge_mm += store_shift(scene, a, np.zeros(3)) * use[:, None]
    return Effect("pivot.g54", [f"dg_{k}_mm" for k in "xyz"], spread(rng, 3, 1e-2), apply, {"modes"})


def pivot_p1970x(rng, machine):
    """Parameters 19700-19702 (dp) and 19703-19705 (dd): in force - declared, rows of rtcp and tw."""
    amplitude = spread(rng, 6, 1e-2) * np.repeat(rng.choice([[1, 1], [1, 0], [0, 1]]), 3)
    if not amplitude.any():
        amplitude[0] = 1e-2
    def apply(scene, errors, a):
        use = np.isin(scene.rows.mode, ("rtcp", "tw"))
        errors.gauge_mm += store_shift(scene, a[:3], a[3:]) * use[:, None]
    return Effect("pivot.p1970x", [f"d{s}_{k}_mm" for s in "pd" for k in "xyz"], amplitude, apply, {"modes"})
