"""The sealed side of a set: effects, parameters, hold-out values, what the best possible fit would leave."""
import numpy as np

from oracle import Fit
from outsiders import form_parts
from rivals import signature


def forms_of(case):
    """Visible rms, in sigma, of each single error of the smooth forms: {} without any."""
    return {name: case.projector.rms(signature(case, part)) for name, part in form_parts(case.background).items()} \
        if case.background else {}


def excess_um(predicted, clean, use):
    """rms of prediction - noise-free truth."""
    return float(np.sqrt(np.mean((predicted - clean)[use] ** 2)) * 1e3)


def shrink(before, after):
    """Part of the excess over the noise floor that is gone."""
    return 1.0 - after / before if before > 0 else 0.0


def describe(name, case):
    """Contents of truth/NAME.json (mm and rad)."""
    use = case.hold.weighted() & (case.sigma_hold > 0)
    sigma_hold = case.sigma_hold * case.hold.weighted()
    weights = case.sigma_train * case.train.weighted()
    weights[case.outlier_rows] = 0.0
    z_rms = lambda predicted: float(np.sqrt(np.mean(((predicted - case.values_hold)[use] / sigma_hold[use]) ** 2)))
    plain = Fit(case.scene, case.values, weights)
    best = Fit(case.scene, case.values, weights, case.effects) if case.effects else plain
    before, after = plain.predict(case.scene_hold), best.predict(case.scene_hold)
    before_um, after_um = excess_um(before, case.clean_hold, use), excess_um(after, case.clean_hold, use)
    return {
        "name": name, "kind": case.wish.kind, "noise_case": case.wish.noise, "around": case.wish.around, "machine": "".join(case.machine.letters),
        "devices": list(case.plan.devices), "plan": vars(case.plan) | {"devices": list(case.plan.devices)},
        "effects": [e.name for e in case.effects] or ["none"],
        "params": {e.name: e.parameters() for e in case.effects},
        "readings": int((case.sigma_train > 0).sum()), "size_sigma": case.sizes, "form_sigma": case.wish.form_sigma, "forms": forms_of(case),
        "rivals": case.rivals, "nearest": case.nearest, "outlier_rows": [int(i) for i in case.outlier_rows],
        "noise_um_true": case.noise_um, "noise_um_setup": case.machine.noise_um,
        "base": dict(zip(case.base.labels(), map(float, case.base_values))),
        "base_train_z_rms": plain.z_rms, "base_holdout_z_rms": z_rms(before),
        "oracle_train_z_rms": best.z_rms, "oracle_holdout_z_rms": z_rms(after),
        "base_excess_um": before_um, "oracle_excess_um": after_um, "oracle_shrink": shrink(before_um, after_um),
        "holdout": [float(v) for v in case.values_hold], "holdout_clean": [float(v) for v in case.clean_hold],
        "sigma": [float(s) for s in sigma_hold],
    }
