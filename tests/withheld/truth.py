"""The sealed side of a set: effects, parameters, hold-out values, what the best possible fit would leave."""
import numpy as np

import registry
from oracle import Fit

REACH = 0.95     # share of the visible signature that a rival must reproduce to count as equivalent


def excess_um(predicted, clean, use):
    """rms of prediction - noise-free truth."""
    return float(np.sqrt(np.mean((predicted - clean)[use] ** 2)) * 1e3)


def shrink(before, after):
    """Part of the excess over the noise floor that is gone."""
    return 1.0 - after / before if before > 0 else 0.0


def equivalents(case, effect, rng):
    """Catalogue effects whose own form reproduces at least REACH of this effect's visible signature here."""
    from cases import signature
    target = case.projector.visible(signature(case, effect))
    total = float(target @ target)
    out = {}
    for name, builder in registry.singles(case.machine.letters).items():
        if name == effect.name or (name == "artefact.position" and all(a.free for a in case.machine.artefacts)):
            continue
        rival = builder(rng, case.machine)
        columns = case.projector.visible(jacobian_of(case, rival))
        scale = np.sqrt((columns ** 2).sum(axis=0))
        columns = columns[:, scale > 1e-9]
        if columns.shape[1] == 0:
            continue
        left, size, _ = np.linalg.svd(columns / np.sqrt((columns ** 2).sum(axis=0)), full_matrices=False)
        share = float(((left[:, size > 1e-6 * size[0]].T @ target) ** 2).sum() / total)
        if share >= REACH:
            out[name] = round(share, 4)
    return out


def jacobian_of(case, effect):
    """Columns of one effect's amplitudes alone (others at zero), in mm per unit."""
    columns, zero = [], np.zeros(case.base.size)
    plain = case.scene.readings(zero)
    for k, step in enumerate(effect.step):
        up = np.zeros(len(effect.step))
        up[k] = step
        columns.append((case.scene.readings(zero, [effect], [up]) - plain) / step)
    return np.array(columns).T


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
    rng = np.random.Generator(np.random.PCG64(1))
    rivals = [equivalents(case, e, rng) if case.wish.kind in ("single", "outliers", "multi") else {}
              for e in case.effects]
    return {
        "name": name, "kind": case.wish.kind, "noise_case": case.wish.noise, "machine": "".join(case.machine.letters),
        "devices": list(case.plan.devices), "plan": vars(case.plan) | {"devices": list(case.plan.devices)},
        "effects": [e.name for e in case.effects] or ["none"],
        "params": {e.name: e.parameters() for e in case.effects},
        "size_sigma": case.sizes, "equivalents": rivals, "outlier_rows": [int(i) for i in case.outlier_rows],
        "noise_um_true": case.noise_um, "noise_um_setup": case.machine.noise_um,
        "base": dict(zip(case.base.labels(), map(float, case.base_values))),
        "base_train_z_rms": plain.z_rms, "base_holdout_z_rms": z_rms(before),
        "oracle_train_z_rms": best.z_rms, "oracle_holdout_z_rms": z_rms(after),
        "base_excess_um": before_um, "oracle_excess_um": after_um, "oracle_shrink": shrink(before_um, after_um),
        "holdout": [float(v) for v in case.values_hold], "holdout_clean": [float(v) for v in case.clean_hold],
        "sigma": [float(s) for s in sigma_hold],
    }
