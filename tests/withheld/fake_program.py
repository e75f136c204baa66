#!/usr/bin/env python3
"""Stands in for `trunnion` to test the pipeline: fits location and set-up only and never names a cause.

diagnose READINGS --setup S --json --out OUT, and predict READINGS --setup OUT. Its score is the floor: silent on
null, nothing found, no shrink.
"""
import json
import sys

import numpy as np

import noise
from forward import Scene
from machine import Base
from oracle import Fit
from reference import load_machine
from rows import read_csv

MARK = "# fake_program base = "


def option(arguments, name):
    """Value after a flag."""
    return arguments[arguments.index(name) + 1] if name in arguments else None


def scene_of(readings, setup):
    """Machine, scene and values."""
    machine = load_machine(setup)
    rows, values = read_csv(readings, machine.letters)
    base = Base(machine, set(rows.device) - {""})
    return machine, Scene(machine, base, rows), values


def diagnose(readings, setup, out):
    """Base fit; a gap is whatever leaves more than 1.5 sigma."""
    machine, scene, values = scene_of(readings, setup)
    fit = Fit(scene, np.nan_to_num(values), noise.sigma_mm(scene.rows, machine.noise_um))
    gap = fit.z_rms > 1.5
    with open(setup) as source, open(out, "w") as target:
        target.write(source.read() + MARK + json.dumps(fit.base.tolist()) + "\n")
    print(json.dumps({"schema": "trunnion.diagnosis/1", "verdict": "unexplained" if gap else "no-gap",
                      "noise_source": "assumed", "gap": {"rms_um": fit.z_rms, "p_value": 0.0 if gap else 1.0},
                      "where": [], "causes": [{"effect": "unknown", "probability": 1.0, "rivals": []}] if gap else [],
                      "after": {"heldout_shrink": 0.0, "ci95": [-0.05, 0.05]}, "next_measurement": []}))


def predict(readings, setup):
    """The table with values."""
    with open(setup) as handle:
        base = next(json.loads(line[len(MARK):]) for line in handle if line.startswith(MARK))
    _, scene, _ = scene_of(readings, setup)
    values = scene.readings(np.array(base))
    with open(readings) as handle:
        lines = handle.read().splitlines()
    at = -1
    for line in lines:
        if not line.startswith("#") and at >= 0 and scene.rows.read[at]:
            line = line + f"{values[at]:.9f}"
        at += not line.startswith("#")
        print(line)


def main(arguments):
    """Entry point."""
    if arguments[0] == "diagnose":
        diagnose(arguments[1], option(arguments, "--setup"), option(arguments, "--out"))
    else:
        predict(arguments[1], option(arguments, "--setup"))


if __name__ == "__main__":
    main(sys.argv[1:])
