#!/usr/bin/env python3
"""Writes sealed data sets: OUT/sets/NAME/{setup.toml,readings.csv,holdout.csv} and OUT/truth/NAME.json."""
import argparse
import json
import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")     # small matrices: more threads only wait

import numpy as np

from cases import draw_case, schedule
from machine import setup_text
from rows import write_csv
from truth import describe


def write_set(folder, truth_folder, name, case):
    """One set; the truth goes to the other folder."""
    os.makedirs(os.path.join(folder, name))
    place = lambda file: os.path.join(folder, name, file)
    comments = {"schema": "trunnion.readings/1", "source": "real"}
    optional = (case.plan.columns() + (["sigma_mm"] if case.sigma_column else [])
                + (["session"] if case.base.sessions > 1 else []))
    with open(place("setup.toml"), "w") as out:
        out.write(setup_text(case.machine, set(case.plan.devices)))
        if case.plan.calibrated:
            out.write(case.base.calibration_text())
    letters = case.machine.letters
    case.train.sigma_mm, case.hold.sigma_mm = case.sigma_train, case.sigma_hold
    side = lambda rows: {"side": " ".join(f"{axis}{'+' if way > 0 else '-'}"
                                          for axis, way in zip("XYZ" + "".join(letters), rows.side_before))}
    told = side(case.train) if case.plan.side_told else {}
    write_csv(place("readings.csv"), case.train, letters, case.values, optional, comments | told)
    write_csv(place("holdout.csv"), case.hold, letters, None, optional, comments | side(case.hold))
    with open(os.path.join(truth_folder, name + ".json"), "w") as out:
        json.dump(describe(name, case), out)
        out.write("\n")


def parse(arguments):
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--sets", type=int, default=100)
    parser.add_argument("--kinds", help="comma-separated: null,single,multi,outsider,foreign,outliers")
    parser.add_argument("--truth", help="folder of the truth (default OUT/truth)")
    parser.add_argument("--effects", help="comma-separated names: singles of these only")
    parser.add_argument("--circumstances", help="comma-separated: zeros,sessions,sigma; each set gets one, in turn")
    return parser.parse_args(arguments)


def main(arguments=None):
    """Entry point."""
    options = parse(arguments)
    rng = np.random.Generator(np.random.PCG64(options.seed))
    kinds = options.kinds.split(",") if options.kinds else None
    effects = options.effects.split(",") if options.effects else None
    around = options.circumstances.split(",") if options.circumstances else ()
    wanted = schedule(rng, options.sets, kinds, effects, around)
    sets, truth = os.path.join(options.out, "sets"), options.truth or os.path.join(options.out, "truth")
    os.makedirs(sets, exist_ok=False)
    os.makedirs(truth, exist_ok=True)
    seeds = rng.integers(0, 2 ** 62, len(wanted))
    for number, (wish, seed) in enumerate(zip(wanted, seeds), 1):
        case = draw_case(np.random.Generator(np.random.PCG64(int(seed))), wish)
        write_set(sets, truth, f"w{number:03d}", case)
        if sys.stderr.isatty():
            print(f"\r{number}/{len(wanted)}", end="", file=sys.stderr)


if __name__ == "__main__":
    main()
