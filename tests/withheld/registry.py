"""All effects of the contract that readings can show, by name, for a given machine; and the needs of campaigns."""
from functools import partial

import conditions
import effects

MOTIONS = ("radial", "axial", "tilt")
LINEAR_FORMS = {"scale": effects.linear_scale, "straightness": effects.linear_straightness,
                "angular": effects.linear_angular, "cyclic": effects.linear_cyclic,
                "backlash": effects.linear_backlash, "reversal_spike": effects.linear_reversal_spike,
                "lateral_play": effects.linear_lateral_play}
CONDITIONS = {"thermal.drift": conditions.thermal_drift, "thermal.expansion": conditions.thermal_expansion,
              "gravity.sag": conditions.gravity_sag, "probe.pretravel": conditions.probe_pretravel,
              "probe.radius": conditions.probe_radius, "probe.runout": conditions.probe_runout,
              "tool.length": conditions.tool_length, "ballbar.length": conditions.ballbar_length,
              "artefact.position": conditions.artefact_position, "artefact.form": conditions.artefact_form,
              "artefact.moved": conditions.artefact_moved, "clamp.shift": conditions.clamp_shift,
              "servo.mismatch": effects.servo_mismatch, "servo.contour": effects.servo_contour,
              "pivot.g54": effects.pivot_g54, "pivot.p1970x": effects.pivot_p1970x}
STEPS = {"control.rounding": (effects.rounded, (0.001, 0.002, 0.005, 0.01, 0.02)),
         "control.chord": (effects.chord, (0.35, 0.53, 0.71, 0.97, 1.3, 1.7, 2.3))}


def singles(letters):
    """name -> builder(rng, machine) of a scalable Effect; names of STEPS are handled by steps()."""
    out = {}
    for axis, letter in enumerate(letters):
        out[f"{letter}.positioning"] = partial(effects.rotary_positioning, axis=axis)
        out[f"{letter}.cyclic"] = partial(effects.rotary_cyclic, axis=axis)
        out[f"{letter}.backlash"] = partial(effects.rotary_backlash, axis=axis)
        for kind in MOTIONS:
            out[f"{letter}.{kind}"] = partial(effects.rotary_motion, axis=axis, kind=kind)
    for i, letter in enumerate("XYZ"):
        for form, builder in LINEAR_FORMS.items():
            out[f"{letter}.{form}"] = partial(builder, i=i)
    for pair in ("XY", "YZ", "ZX"):
        out[f"{pair}.squareness"] = partial(effects.squareness, pair=pair)
    out.update(CONDITIONS)
    return out


def all_names(letters):
    """Every effect a single set can hold."""
    return list(singles(letters)) + list(STEPS)


DEVICES = (("sphere",), ("ballbar",), ("sphere", "ballbar"), ("touch",), ("touch", "ballbar"))


def allowed_devices(needs):
    """Device combinations that can show what needs all these things."""
    out = []
    for devices in DEVICES:
        has = set(devices)
        probe = bool(has & {"sphere", "touch"})
        if ("ballbar" in needs and "ballbar" not in has) or ("touch" in needs and "touch" not in has):
            continue
        if "ballbar|touch" in needs and not has & {"ballbar", "touch"}:
            continue
        if needs & {"probe", "modes", "spindle", "clamp"} and not probe:
            continue
        out.append(devices)
    return out
