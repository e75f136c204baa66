"""Thermal, load, probe, tool, ballbar, artefact and clamping effects in this generator's own forms."""
import numpy as np

import frames
from effects import Effect, spread


def thermal_drift(rng, machine):
    """The spindle grows away from the table, mostly along one axis: d (1 - exp(-t / tau))."""
    tau_s = float(rng.uniform(8, 50) * 60)
    def apply(scene, errors, a):
        errors.gauge_mm += (1 - np.exp(-scene.rows.time_s / tau_s))[:, None] * a
    return Effect("thermal.drift", ["X_mm", "Y_mm", "Z_mm"], spread(rng, 3, 8e-3), apply, keys={"tau_s": tau_s})


def thermal_expansion(rng, machine):
    """Scales of the linear axes grow with temperature above 20 C."""
    def apply(scene, errors, a):
        warm = (scene.rows.temperature_c - 20.0)[:, None]
        errors.gauge_mm += scene.rows.pos_mm * warm * a
    return Effect("thermal.expansion", [f"{k}_per_K" for k in "XYZ"], rng.uniform(0.6, 1.0, 3) * 1e-5, apply,
                  {"swing"}, step=1e-6)


def gravity_sag(rng, machine):
    """The trunnion twists under the weight of table and load: kappa (1 + m/m0) sin(tilt); plate sags a little."""
    mass_kg = float(rng.uniform(30, 120))
    plate = float(rng.uniform(0.0, 15.0))         # mm of plate sag per rad of twist
    def apply(scene, errors, a):
        weight = 1 + scene.rows.load_kg / mass_kg
        tilt = scene.word_rad[:, 0]
        errors.angle_rad[:, 0] += a[0] * weight * np.sin(tilt)
        errors.artefact_mm[:, 2] -= a[0] * plate * weight * np.cos(tilt)
    return Effect("gravity.sag", ["twist_rad"], [3e-5], apply, {"load"}, {"mass_kg": mass_kg, "plate_mm": plate})


def probe_pretravel(rng, machine):
    """Three-lobed pretravel of a kinematic probe, by azimuth of the touch in the spindle frame."""
    def apply(scene, errors, a):
        rows = scene.rows
        azimuth = np.arctan2(rows.dir[:, 1], rows.dir[:, 0]) - np.radians(rows.spindle_deg)
        level = np.hypot(rows.dir[:, 0], rows.dir[:, 1])
        lobes = a[0] * np.cos(3 * azimuth) + a[1] * np.sin(3 * azimuth)
        errors.value_mm += level * lobes * (rows.device == "touch")
    return Effect("probe.pretravel", ["cos3_mm", "sin3_mm"], spread(rng, 2, 2e-3), apply, {"touch", "no-sphere"})


def probe_radius(rng, machine):
    """The stylus ball acts larger than declared."""
    def apply(scene, errors, a):
        errors.radius_mm += a[0]
    return Effect("probe.radius", ["radius_mm"], [rng.choice([-1, 1]) * 3e-3], apply, {"touch", "no-sphere"})


def probe_runout(rng, machine):
    """Stylus off the spindle axis: turns with the spindle orientation."""
    def apply(scene, errors, a):
        angle = np.radians(scene.rows.spindle_deg)
        errors.tip_mm[:, 0] += a[0] * np.cos(angle) - a[1] * np.sin(angle)
        errors.tip_mm[:, 1] += a[0] * np.sin(angle) + a[1] * np.cos(angle)
    return Effect("probe.runout", ["X_mm", "Y_mm"], spread(rng, 2, 5e-3), apply, {"probe", "spindle"})


def tool_length(rng, machine):
    """The probe is longer than declared: its tip lies lower. Seen where the ballbar's cup is known."""
    def apply(scene, errors, a):
        errors.tip_mm[:, 2] -= a[0]
    return Effect("tool.length", ["length_mm"], [rng.choice([-1, 1]) * 8e-3], apply, {"probe", "ballbar", "cup known"})


def ballbar_length(rng, machine):
    """The bar is not as long as its calibration says. Seen where its length is not free."""
    def apply(scene, errors, a):
        errors.value_mm += a[0] * scene.rows.bar
    return Effect("ballbar.length", ["length_mm"], [rng.choice([-1, 1]) * 3e-3], apply, {"ballbar", "length known"})


def _sphere(rng, machine, free):
    """Index of a sphere, free or known."""
    return int(rng.choice([k for k, a in enumerate(machine.artefacts) if a.kind == "sphere" and a.free == free]))


def artefact_position(rng, machine):
    """A sphere whose place is declared as known is somewhere else on the table (W)."""
    known = [k for k, a in enumerate(machine.artefacts) if a.kind == "sphere" and not a.free]
    which = int(rng.choice(known)) if known else 0
    def apply(scene, errors, a):
        errors.artefact_mm += (scene.which == which)[:, None] * a
    return Effect("artefact.position", ["X_mm", "Y_mm", "Z_mm"], spread(rng, 3, 8e-3), apply,
                  {"probe", "artefact known"}, {"artefact": machine.artefacts[which].name})


def artefact_moved(rng, machine):
    """A sphere slips on the table during the session and stays there."""
    which = _sphere(rng, machine, True)
    share = float(rng.uniform(0.25, 0.75))
    def apply(scene, errors, a):
        late = scene.rows.time_s > share * machine.session_s
        errors.artefact_mm += ((scene.which == which) & late)[:, None] * a
    return Effect("artefact.moved", ["X_mm", "Y_mm", "Z_mm"], spread(rng, 3, 8e-3), apply, {"probe"},
                  {"artefact": machine.artefacts[which].name, "share_of_session": share})


def artefact_form(rng, machine):
    """A sphere out of round (second order), fixed to the table."""
    which = _sphere(rng, machine, True)
    def apply(scene, errors, a):
        turned = scene.turned[0] @ scene.turned[1]
        x, y, z = -np.einsum("nij,ni->jn", turned[:, :3, :3], scene.rows.dir)
        bump = a[0] * (3 * z ** 2 - 1) / 2 + a[1] * (x ** 2 - y ** 2) + a[2] * 2 * x * y
        errors.radius_mm += bump * (scene.which == which)
    return Effect("artefact.form", ["oblate_mm", "oval_mm", "oval45_mm"], spread(rng, 3, 2e-3), apply,
                  {"touch", "no-sphere"}, {"artefact": machine.artefacts[which].name})


def clamp_shift(rng, machine):
    """Closing the brakes pushes the table aside (M)."""
    def apply(scene, errors, a):
        errors.work_mm += scene.rows.clamped[:, None] * a
    return Effect("clamp.shift", ["X_mm", "Y_mm", "Z_mm"], spread(rng, 3, 4e-3), apply, {"clamp"})
