"""Which other effects of the catalogue look the same on a set's readings: the confounding that physics imposes."""
import numpy as np

import registry

REACH = 0.90          # share of the visible signature from which a rival is listed
CANNOT_TELL = 20.0    # chi-square that separates the two on these readings; below, no method can be sure
DRAWS = {"thermal.drift": 4, "artefact.moved": 6, "A.cyclic": 3, "B.cyclic": 3, "C.cyclic": 3}   # keys tried


def signature(case, effect):
    """What the effect adds to the training readings, in mm."""
    return case.scene.readings(case.base_values, [effect]) - case.scene.readings(case.base_values)


def columns_of(case, effect):
    """Readings per unit of each amplitude of one effect (the others zero), in mm."""
    columns, zero = [], np.zeros(case.base.size)
    plain = case.scene.readings(zero)
    for k, step in enumerate(effect.step):
        up = np.zeros(len(effect.step))
        up[k] = step
        columns.append((case.scene.readings(zero, [effect], [up]) - plain) / step)
    return np.array(columns).T


def span(columns):
    """Orthonormal basis of the visible columns."""
    scale = np.sqrt((columns ** 2).sum(axis=0))
    columns = columns[:, scale > 1e-9 * max(scale.max(), 1e-300)]
    if columns.shape[1] == 0:
        return columns
    left, size, _ = np.linalg.svd(columns / np.sqrt((columns ** 2).sum(axis=0)), full_matrices=False)
    return left[:, size > 1e-5 * size[0]]


def possible(case, name):
    """Whether the set-up leaves room for this effect at all."""
    if name == "artefact.position":
        return not all(a.free for a in case.machine.artefacts)
    return not (name == "artefact.moved" and not any(a.free for a in case.machine.artefacts if a.kind == "sphere"))


def bases(case, skip=""):
    """(name, orthonormal basis of what it can do visibly) of the catalogue's effects, some with several keys."""
    rng = np.random.Generator(np.random.PCG64(1))
    for name, builder in registry.singles(case.machine.letters).items():
        if name != skip and possible(case, name):
            for _ in range(DRAWS.get(name, 1)):
                yield name, span(case.projector.visible(columns_of(case, builder(rng, case.machine))))


def find_rivals(case, effect):
    """name -> share reproduced, chi-square left, whether that is too little to tell, whether it is no richer."""
    target = case.projector.visible(signature(case, effect))
    total, own, out = float(target @ target), max(1, len(effect.amplitude)), {}
    for name, basis in bases(case, effect.name):
        share = float(((basis.T @ target) ** 2).sum() / total)
        if share >= max(REACH, out.get(name, {}).get("share", 0.0)):
            left = max(0.0, (1 - share) * total)
            out[name] = {"share": round(share, 5), "chi2": round(left, 2), "cannot_tell": left < CANNOT_TELL,
                         "simpler": basis.shape[1] <= own}
    return out


def nearest(case, effect):
    """How far the catalogue reaches for an outsider: best one and (greedy) best two effects, with their shares."""
    target = case.projector.visible(signature(case, effect))
    target /= np.linalg.norm(target)
    known = list(bases(case))
    found, taken = [], np.zeros((len(target), 0))
    for _ in range(2):
        shares = []
        for name, basis in known:
            rest = basis - taken @ (taken.T @ basis)
            left, size, _ = np.linalg.svd(rest, full_matrices=False)
            left = left[:, size > 1e-2]
            shares.append((float(((left.T @ target) ** 2).sum()), name, left))
        best = max(shares, key=lambda entry: entry[0])
        taken = np.hstack([taken, best[2]])
        found.append([best[1], round(float(((taken.T @ target) ** 2).sum()), 4)])
    return found
