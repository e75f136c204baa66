#!/usr/bin/env python3
"""What an observer says who knows how the sets of kind `form` are drawn: the most that can be asked of a diagnosis.

    ideal.py --seed 181101 --sets 80 [--json FILE]

The observer knows the machine, the campaign, the noise and its correlation, that exactly one effect of the registry
is there with 2 to 6 sigma, in this generator's own form, and that the axes have the generator's smooth errors
(waves of 100 to 600 mm, random phases and heights, one common size of 0.7 to 12 sigma). It compares the
Gaussian evidence of all effects, averaged over keys (a few dozen drawn settings of each), sizes and the size of the
forms; small errors are linear. No diagnosis knows as much; what this observer does not name first, the readings hardly
decide.
"""
import argparse
import json
import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import registry
from all_claims import LEAST as LEAST_FORM
from cases import draw_case, plausible, schedule
from oracle import Fit
from rivals import columns_of, possible, signature
from statistics_table import rate, rate_line
from truth import forms_of

FORM_SIGMA = np.exp(np.linspace(np.log(0.7), np.log(12.0), 9))
SIZE_SIGMA = (1.6, 2.4, 3.5, 5.2)
LENGTHS_MM = np.exp(np.linspace(np.log(100.0), np.log(600.0), 26))
KEYS = {"thermal.drift": 10, "artefact.moved": 40, "artefact.form": 24, "artefact.position": 24, "gravity.sag": 12,
        "A.cyclic": 24, "B.cyclic": 24, "C.cyclic": 24, "X.cyclic": 24, "Y.cyclic": 24, "Z.cyclic": 24,
        "X.reversal_spike": 6, "Y.reversal_spike": 6, "Z.reversal_spike": 6}
LEAST = 1.0   # sigma: an effect that at its largest plausible size shows less is not offered


class Whitening:
    """Rows with unit, independent noise, less what location and set-up absorb."""

    def __init__(self, case):
        self.case, self.use = case, case.sigma_train > 0
        self.factors = list(self.blocks())
        matrix = [self.scaled(column) for column in self.base_columns()]
        matrix = np.vstack([np.array(matrix).T, np.diag(1 / case.base.known_sigma)])
        self.extra = case.base.size
        left, size, _ = np.linalg.svd(matrix / np.sqrt((matrix ** 2).sum(axis=0)), full_matrices=False)
        self.basis = left[:, size > 1e-6 * size[0]]

    def blocks(self):
        """(rows, inverse of the factor of their covariance) where noise is correlated."""
        case, rows = self.case, self.case.train
        if not case.correlated:
            return
        share, memory = 0.6, 0.9      # as in noise.draw
        for visit in np.unique(rows.visit[rows.read]):
            index = np.flatnonzero((rows.visit == visit) & rows.read & self.use)
            if not len(index) or rows.device[index[0]] == "sphere":
                continue
            if rows.device[index[0]] == "ballbar":
                away = np.abs(np.subtract.outer(np.arange(len(index)), np.arange(len(index))))
                common = memory ** away
            else:
                common = rows.dir[index] @ rows.dir[index].T
            yield index, np.linalg.inv(np.linalg.cholesky(share * common + (1 - share) * np.eye(len(index))))

    def scaled(self, column_mm):
        z = np.where(self.use, column_mm / np.where(self.use, self.case.sigma_train, 1.0), 0.0)
        for index, factor in self.factors:
            z[index] = factor @ z[index]
        return z[self.use]

    def base_columns(self):
        scene, zero = self.case.scene, np.zeros(self.case.base.size)
        for k in range(len(zero)):
            step = zero.copy()
            step[k] = scene.base.step[k]
            yield (scene.readings(step) - scene.readings(-step)) / (2 * step[k])

    def visible(self, columns_mm):
        """(n, k) of columns in mm."""
        z = np.array([self.scaled(c) for c in np.atleast_2d(columns_mm.T)]).T
        z = np.vstack([z, np.zeros((self.extra, z.shape[1]))])
        return z - self.basis @ (self.basis.T @ z)


def form_columns(case):
    """Cosine and sine waves of all lengths, for each curve of each axis, mm, with the heights of form_errors()."""
    rows, out = case.train, []
    scene, base = case.scene, np.zeros(case.base.size)
    plain = scene.readings(base)
    # Forms enter as displacements of the gauge point: derivatives of the readings along X, Y, Z.
    slopes = []
    for direction in np.eye(3):
        def apply(scene, errors, a, direction=direction):
            errors.gauge_mm += 1e-3 * direction
        slopes.append((scene.readings(base, [Push(apply)]) - plain) / 1e-3)
    for i in range(3):
        for length in LENGTHS_MM:
            angle = 2 * np.pi * rows.pos_mm[:, i] / length
            for slope in slopes:
                out += [length * np.cos(angle) * slope, length * np.sin(angle) * slope]
    return np.array(out).T


class Push:
    """Something that has `apply` and no amplitude."""
    amplitude = np.zeros(0)

    def __init__(self, apply):
        self.apply = apply


def candidates(case, white, rng):
    """(name, columns with unit prior at 1 sigma of visible rms, or one fixed signature as (n, 1), fixed)."""
    count = white.use.sum()
    for name, builder in registry.singles(case.machine.letters).items():
        if not possible(case, name):
            continue
        seen = set()
        for _ in range(KEYS.get(name, 1)):
            effect = builder(rng, case.machine)
            if str(effect.keys) in seen:
                continue
            seen.add(str(effect.keys))
            usual = np.mean([np.abs(builder(rng, case.machine).amplitude) for _ in range(8)], axis=0) + 1e-300
            columns = white.visible(columns_of(case, effect) * usual)
            rms = np.sqrt((columns ** 2).sum() / count)
            if rms < 1e-9:
                continue
            if not plausible(effect.scaled(LEAST / rms * np.sqrt((usual ** 2).mean() / (effect.amplitude ** 2).mean()))):
                continue
            yield name, columns / rms, False
    for name, (builder, steps) in registry.STEPS.items():
        for step in steps:
            column = white.visible(signature(case, builder(rng, case.machine, step))[:, None])
            if 0.7 <= np.sqrt((column ** 2).sum() / count) <= 9:
                yield name, column, True


def log_mean(values):
    top = max(values)
    return top + np.log(np.mean(np.exp(np.array(values) - top)))


def evidence_of(case):
    """name -> log evidence of one effect of this name beside the forms, minus that of the forms alone."""
    white = Whitening(case)
    plain = Fit(case.scene, case.values, case.sigma_train * case.train.weighted())
    values = np.where(white.use, case.values - plain.predict(case.scene), 0.0)
    y = white.visible(values[:, None])[:, 0]
    form = white.visible(form_columns(case))
    form /= np.sqrt((form ** 2).sum() / white.use.sum())
    left, size, _ = np.linalg.svd(form, full_matrices=False)
    groups = list(candidates(case, white, np.random.Generator(np.random.PCG64(5))))
    columns = np.hstack([y[:, None]] + [g[1] for g in groups])
    gram, inside = columns.T @ columns, left.T @ columns
    each, alone = {}, []
    for sigma in FORM_SIGMA:
        ratio = (sigma * size) ** 2
        g = gram - inside.T @ (inside * (ratio / (1 + ratio))[:, None])
        base = -0.5 * g[0, 0] - 0.5 * np.log1p(ratio).sum()
        alone.append(base)
        at = 1
        for k, (name, part, fixed) in enumerate(groups):
            end = at + part.shape[1]
            info, h = g[at:end, at:end], g[at:end, 0]
            if fixed:
                gains = [h[0] - 0.5 * info[0, 0]]
            else:
                gains = []
                for tau in SIZE_SIGMA:
                    m = np.eye(len(h)) + tau ** 2 * info
                    gains.append(0.5 * tau ** 2 * h @ np.linalg.solve(m, h) - 0.5 * np.linalg.slogdet(m)[1])
            each.setdefault(name, {}).setdefault(k, []).append(base + log_mean(gains))
            at = end
    # The mean over the size of the forms and over the keys.
    return {name: log_mean([log_mean(v) for v in keys.values()]) - log_mean(alone) for name, keys in each.items()}


def judge(seed, number, case):
    evidence = evidence_of(case)
    top = max(evidence.values())
    weight = {name: float(np.exp(e - top)) for name, e in evidence.items()}
    total = sum(weight.values())
    order = sorted(weight, key=weight.get, reverse=True)
    truth = case.effects[0].name
    present = {name for name, size in forms_of(case).items() if size >= LEAST_FORM}
    return {"seed": seed, "name": f"w{number:03d}", "truth": truth, "size": case.sizes[0], "form": case.wish.form_sigma,
            "first": order[0], "second": order[1], "probability": weight.get(truth, 0.0) / total,
            "stated": weight[order[0]] / total, "noise": case.wish.noise, "devices": list(case.plan.devices),
            "first_but_true": next(name for name in order if name == truth or name not in present)}


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--sets", type=int, default=80)
    parser.add_argument("--json")
    options = parser.parse_args(arguments)
    rng = np.random.Generator(np.random.PCG64(options.seed))
    wanted = schedule(rng, options.sets, ["form"], None)
    seeds = rng.integers(0, 2 ** 62, len(wanted))
    records = []
    for number, (wish, seed) in enumerate(zip(wanted, seeds), 1):
        case = draw_case(np.random.Generator(np.random.PCG64(int(seed))), wish)
        records.append(judge(options.seed, number, case))
        r = records[-1]
        if r["first"] != r["truth"]:
            print(f"{r['seed']}/{r['name']} {'+'.join(r['devices'])} {r['noise']}: {r['truth']} ({r['size']:.1f} beside "
                  f"{r['form']:.1f}) {r['probability']:.3f}, first {r['first']} {r['stated']:.3f}", flush=True)
    if options.json:
        with open(options.json, "w") as out:
            json.dump(records, out, indent=1)
    print(rate_line("  first", rate(records, lambda r: r["first"] == r["truth"])))
    print(rate_line("  the same, other errors that the machine has apart",
                    rate(records, lambda r: r["first_but_true"] == r["truth"])))
    print(rate_line("  first or second", rate(records, lambda r: r["truth"] in (r["first"], r["second"]))))
    print(f"  mean probability of the truth {np.mean([r['probability'] for r in records]):.3f}, stated "
          f"{np.mean([r['stated'] for r in records]):.3f}")


if __name__ == "__main__":
    main()
