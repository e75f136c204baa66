"""Effects that no catalogue of the contract holds, and known families in a form of their own.

OUTSIDERS: a diagnosis should admit that it cannot explain them. FOREIGN: the family is known, its form is not
the usual one; naming the family or admitting a remainder are both right.
"""
import numpy as np

from effects import (Effect, harmonics, reversing, rotary_motion, rotary_positioning, since_reversal_rad, spread)


# --- outside any catalogue ---------------------------------------------------------------------------
def drift_two_times(rng, machine):
    """A fast rise that a slow process takes back and overshoots (a chiller catching up), along Z and X."""
    fast, slow = float(rng.uniform(0.10, 0.18) * machine.session_s), float(rng.uniform(0.3, 0.5) * machine.session_s)
    lean = float(rng.uniform(-0.6, 0.6))
    def apply(scene, errors, a):
        t = scene.rows.time_s
        shape = (1 - np.exp(-t / fast)) - 1.25 * (1 - np.exp(-(t / slow) ** 2))
        errors.gauge_mm += a[0] * shape[:, None] * np.array([lean, 1.0, 0.7])
    return Effect("outsider.drift_two_times", ["height_mm"], [1e-2], apply, keys={"fast_s": fast, "slow_s": slow})


def backlash_by_position(rng, machine):
    """Reversal value that grows along the screw and changes sign in the middle of the arc used."""
    i = int(rng.integers(2))
    middle = float(machine.artefacts[-1].center_mm[i] - machine.cup_mm[i])
    def apply(scene, errors, a):
        way = (scene.rows.pos_mm[:, i] - middle) / 100.0
        errors.gauge_mm[:, i] += 0.5 * a[0] * way * scene.rows.sign[:, i] * reversing(scene)
    return Effect("outsider.backlash_by_position", ["gap_per_100mm_mm"], [4e-3], apply, {"ballbar"}, {"axis": "XY"[i]})


def guide_bump(rng, machine):
    """A dent in a guide: a bell of 20-40 mm width sideways."""
    i = int(rng.integers(2))
    place, width = float(machine.artefacts[-1].center_mm[i] + rng.uniform(-60, 60)), float(rng.uniform(20, 40))
    def apply(scene, errors, a):
        bell = np.exp(-0.5 * ((scene.rows.pos_mm[:, i] - place) / width) ** 2)
        errors.gauge_mm[:, 1 - i] += a[0] * bell
        errors.gauge_mm[:, 2] += a[1] * bell
    return Effect("outsider.guide_bump", ["side_mm", "up_mm"], [4e-3, -2e-3], apply,
                  keys={"axis": "XY"[i], "at_mm": place, "width_mm": width})


def cubic_bow(rng, machine):
    """An S-shaped guide: sideways with the third Legendre polynomial of the part of the travel in use."""
    i = int(rng.integers(2))
    middle = float(machine.artefacts[-1].center_mm[i]) * float(rng.choice([0.0, 1.0]))
    def apply(scene, errors, a):
        way = (scene.rows.pos_mm[:, i] - middle) / 180.0
        errors.gauge_mm[:, 1 - i] += a[0] * (2.5 * way ** 3 - 1.5 * way)
    return Effect("outsider.cubic_bow", ["bow_mm"], [3e-3], apply, keys={"axis": "XY"[i], "middle_mm": middle})


def over_centre_play(rng, machine):
    """The tilting body falls through its play after its centre of gravity has passed over the axis.

    Friction holds it a while: the fall comes `late` beyond the balance, on the side the axis moves to.
    """
    at, soft = float(np.radians(rng.uniform(-10, 10))), float(np.radians(rng.uniform(0.5, 3)))
    late = float(np.radians(rng.uniform(8, 25)))
    def apply(scene, errors, a):
        fall = scene.word_rad[:, 0] - at - late * scene.rows.sign[:, 3]
        errors.angle_rad[:, 0] += 0.5 * a[0] * np.tanh(fall / soft)
    return Effect("outsider.over_centre_play", ["play_rad"], [5e-5], apply,
                  keys={"at_rad": at, "soft_rad": soft, "late_rad": late})


def harmonic_five(rng, machine):
    """Five waves a turn of C, in angle and along the axis together (a bearing with five distortions)."""
    def apply(scene, errors, a):
        waves = harmonics(scene.word_rad[:, 1], (5,))
        errors.angle_rad[:, 1] += waves @ a[:2]
        errors.axis_shift_mm[1][:, 2] += waves @ a[2:]
    return Effect("outsider.c_harmonic_5", ["cos_rad", "sin_rad", "axial_cos_mm", "axial_sin_mm"],
                  [2e-5, -1e-5, 1e-3, 2e-3], apply)


def jump_in_y(rng, machine):
    """The spindle side jumps along Y during the session (a collision, a lost count)."""
    share = float(rng.uniform(0.3, 0.7))
    def apply(scene, errors, a):
        errors.gauge_mm[:, 1] += a[0] * (scene.rows.time_s > share * machine.session_s)
    return Effect("outsider.jump_in_y", ["jump_mm"], [8e-3], apply, keys={"share_of_session": share})


def stick_slip(rng, machine):
    """Sawtooth in position at low speed, fading as speed grows."""
    i, wave, fade = int(rng.integers(2)), float(rng.uniform(22, 45)), float(rng.uniform(10, 30))
    def apply(scene, errors, a):
        rows = scene.rows
        speed = np.abs(rows.velocity[:, i])
        saw = np.mod(rows.pos_mm[:, i] * rows.sign[:, i] / wave, 1.0) - 0.5
        errors.gauge_mm[:, i] -= a[0] * saw * rows.sign[:, i] * np.exp(-speed / fade) * rows.bar
    return Effect("outsider.stick_slip", ["stroke_mm"], [4e-3], apply, {"ballbar"},
                  {"axis": "XY"[i], "wave_mm": wave, "fade_mm_s": fade})


def angle_interaction(rng, machine):
    """C's angle error depends on the tilt: an unbalanced table turned against gravity."""
    def apply(scene, errors, a):
        tilt, turn = scene.word_rad.T
        errors.angle_rad[:, 1] += np.sin(tilt) * (a[0] * np.cos(turn) + a[1] * np.sin(turn))
    return Effect("outsider.c_angle_by_tilt", ["cos_rad", "sin_rad"], [4e-5, 2e-5], apply)


def wander(rng, machine):
    """Slow random wandering of the spindle against the table in all directions."""
    knots = np.linspace(0, 1.6 * machine.session_s, 17)
    path = rng.normal(size=(17, 3))
    def apply(scene, errors, a):
        smooth = [np.interp(scene.rows.time_s, knots, path[:, k]) for k in range(3)]
        errors.gauge_mm += a[0] * np.array(smooth).T
    return Effect("outsider.wander", ["rms_mm"], [3e-3], apply, {"probe"})


# --- known families, other forms ---------------------------------------------------------------------
def positioning_high(rng, machine):
    """Rotary positioning of orders 3 and 4."""
    return rotary_positioning(rng, machine, int(rng.integers(2)), (3, 4))


def radial_high(rng, machine):
    """C radial error motion of orders 4 and 5."""
    return rotary_motion(rng, machine, 1, "radial", (4, 5))


def straightness_sine(rng, machine):
    """A guide shaped like a sine of 500 mm length."""
    i, phase = int(rng.integers(3)), float(rng.uniform(0, 2 * np.pi))
    side = [k for k in range(3) if k != i]
    def apply(scene, errors, a):
        errors.gauge_mm[:, side] += np.sin(2 * np.pi * scene.rows.pos_mm[:, i] / 500.0 + phase)[:, None] * a
    return Effect("XYZ"[i] + ".straightness", ["first_mm", "second_mm"], spread(rng, 2, 3e-3), apply,
                  keys={"wave_mm": 500.0, "phase_rad": phase})


def scale_one_side(rng, machine):
    """A screw stretched only on its positive half."""
    i = int(rng.integers(2))
    def apply(scene, errors, a):
        errors.gauge_mm[:, i] += a[0] * np.maximum(scene.rows.pos_mm[:, i], 0.0)
    return Effect("XYZ"[i] + ".scale", ["slope_mm_per_mm"], [3e-5], apply, step=1e-5)


def drift_stretched(rng, machine):
    """Warming with a stretched exponential: fast at first, long tail."""
    tau_s = float(rng.uniform(0.2, 0.5) * machine.session_s)
    def apply(scene, errors, a):
        errors.gauge_mm += (1 - np.exp(-np.sqrt(scene.rows.time_s / tau_s)))[:, None] * a
    return Effect("thermal.drift", ["X_mm", "Y_mm", "Z_mm"], spread(rng, 3, 1e-2), apply, keys={"tau_s": tau_s})


def spike_in_time(rng, machine):
    """Reversal spike that lasts a time, not an angle, and takes a moment to rise."""
    i, lasts_s = int(rng.integers(2)), float(rng.uniform(0.3, 0.8))
    def apply(scene, errors, a):
        rows = scene.rows
        turn_speed = np.maximum(rows.feed_mm_min / 60.0 / np.maximum(rows.path_radius_mm, 1.0), 1e-3)
        late = since_reversal_rad(rows, i) / turn_speed / lasts_s
        late = np.where(np.isfinite(late), late, 50.0)
        errors.gauge_mm[:, i] -= a[0] * rows.sign[:, i] * late * np.exp(1 - late)
    return Effect("XYZ"[i] + ".reversal_spike", ["height_mm"], [6e-3], apply, {"ballbar"}, {"lasts_s": lasts_s})


def backlash_by_tilt(rng, machine):
    """C's lost motion grows as the table tilts."""
    def apply(scene, errors, a):
        gap = a[0] * (0.6 + 0.8 * np.abs(np.sin(scene.word_rad[:, 0])))
        errors.angle_rad[:, 1] += 0.5 * gap * scene.rows.sign[:, 4]
    return Effect("C.backlash", ["gap_rad"], [5e-5], apply)


def expansion_late(rng, machine):
    """Scales follow the temperature with a lag."""
    lag_s = float(0.06 * machine.session_s)
    def apply(scene, errors, a):
        period = 0.75 * machine.session_s
        amplitude = np.ptp(scene.rows.temperature_c) / 2
        warm = amplitude * np.sin(2 * np.pi * (scene.rows.time_s - lag_s) / period)
        errors.gauge_mm += scene.rows.pos_mm * warm[:, None] * a
    return Effect("thermal.expansion", [f"{k}_per_K" for k in "XYZ"], [1e-5, 0.8e-5, 0.9e-5], apply, {"swing"},
                  {"lag_s": lag_s}, step=1e-6)


def sag_off_centre(rng, machine):
    """Centre of gravity off the plane of symmetry: twist with sin(tilt + angle), stiffening with load."""
    mass_kg, angle = float(rng.uniform(30, 120)), float(rng.uniform(0.3, 0.8))
    def apply(scene, errors, a):
        weight = 1 + np.tanh(scene.rows.load_kg / mass_kg)
        errors.angle_rad[:, 0] += a[0] * weight * np.sin(scene.word_rad[:, 0] + angle)
    return Effect("gravity.sag", ["twist_rad"], [4e-5], apply, {"load"}, {"mass_kg": mass_kg, "angle_rad": angle})


def pretravel_two_lobes(rng, machine):
    """Pretravel with two lobes beside three."""
    def apply(scene, errors, a):
        rows = scene.rows
        azimuth = np.arctan2(rows.dir[:, 1], rows.dir[:, 0]) - np.radians(rows.spindle_deg)
        lobes = a[0] * np.cos(3 * azimuth) + a[1] * np.cos(2 * azimuth) + a[2] * np.sin(2 * azimuth)
        errors.value_mm += np.hypot(rows.dir[:, 0], rows.dir[:, 1]) * lobes * (rows.device == "touch")
    return Effect("probe.pretravel", ["cos3_mm", "cos2_mm", "sin2_mm"], [2e-3, 1e-3, 1e-3], apply,
                  {"touch", "no-sphere"})


def clamp_on_carrier(rng, machine):
    """C's brake pushes the table against the carrier: the shift tilts with it."""
    def apply(scene, errors, a):
        errors.axis_shift_mm[1] += scene.rows.clamped[:, None] * a
    return Effect("clamp.shift", ["X_mm", "Y_mm", "Z_mm"], spread(rng, 3, 4e-3), apply, {"clamp", "probe"})


def form_errors(rng, machine):
    """Every linear axis as it is: its position and both straightnesses follow smooth curves of no named form."""
    waves = 5
    length = np.exp(rng.uniform(np.log(100.0), np.log(600.0), (3, 3, waves)))
    phase = rng.uniform(0.0, 2 * np.pi, (3, 3, waves))
    size = rng.normal(size=(3, 3, waves)) * (length / 600.0)
    def apply(scene, errors, a):
        for i in range(3):
            errors.gauge_mm += a[i] * form_curves(waves_of, scene.rows, i)
    waves_of = (length, phase, size)
    return Effect("form", ["X_mm", "Y_mm", "Z_mm"], [3e-3, 3e-3, 3e-3], apply, keys={"waves_of": waves_of})


def form_curves(waves_of, rows, i):
    """The curves of axis i at the rows, per amplitude: (n,3), along X, Y, Z."""
    length, phase, size = waves_of
    angle = 2 * np.pi * rows.pos_mm[:, i, None, None] / length[i] + phase[i]
    return (size[i] * np.sin(angle)).sum(axis=2)


def straight_part(rows, i, curves):
    """The part of curves of axis i that is proportional to its position, over the rows that are read."""
    use, way = rows.read, rows.pos_mm[:, i] - rows.pos_mm[rows.read, i].mean()
    slope = way[use] @ curves[use] / max(way[use] @ way[use], 1e-12)
    return way[:, None] * slope


def form_parts(form):
    """The single errors that form_errors() consists of, by the names that a diagnosis may give them.

    X.positioning and X.straightness: the whole curves. X.scale and XY.squareness: their parts that are proportional
    to position, which are parts of the former too.
    """
    waves_of, parts = form.keys["waves_of"], {}
    def part(name, take):
        def apply(scene, errors, a):
            for i in range(3):
                errors.gauge_mm += a[i] * take(scene.rows, i, form_curves(waves_of, scene.rows, i))
        parts[name] = Effect(name, form.labels, form.amplitude, apply)
    for k, axis in enumerate("XYZ"):
        along = np.eye(3)[k]
        part(axis + ".positioning", lambda rows, i, c, k=k, along=along: c * along * (i == k))
        part(axis + ".straightness", lambda rows, i, c, k=k, along=along: c * (1 - along) * (i == k))
        part(axis + ".scale", lambda rows, i, c, k=k, along=along: straight_part(rows, i, c) * along * (i == k))
    for pair in ((0, 1), (1, 2), (2, 0)):
        def lean(rows, i, c, pair=pair):
            other = np.eye(3)[pair[1 - pair.index(i)]] if i in pair else np.zeros(3)
            return straight_part(rows, i, c) * other
        part("".join("XYZ"[k] for k in pair) + ".squareness", lean)
    return parts

OUTSIDERS = (drift_two_times, backlash_by_position, guide_bump, cubic_bow, over_centre_play, harmonic_five, jump_in_y,
             stick_slip, angle_interaction, wander)
FOREIGN = (positioning_high, radial_high, straightness_sine, scale_one_side, drift_stretched,
           spike_in_time, backlash_by_tilt, expansion_late, sag_off_centre, pretravel_two_lobes, clamp_on_carrier)
