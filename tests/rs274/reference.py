#!/usr/bin/env python3
"""Programs with paths that LinuxCNC took elsewhere, in full precision: does trunnion take the same?

usage: reference.py TRUNNION FOLDER

FOLDER holds setup.toml and paths/NAME.nc with paths/NAME.path.csv (seq, kind, x..c, feed, plane,
turns, ci, cj, ck; machine mm and deg). End points agree within 2e-5 mm, centres within 5e-4 mm,
feeds within 1e-6 of themselves; where rotary axes move along or F is per revolution the two name
the feed differently (there the word F, here the speed of the point), so it is not compared.
"""
import csv
import glob
import os
import subprocess
import sys
import tempfile

from generate import PLANE_AXES

POINT_TOLERANCE, CENTRE_TOLERANCE_MM, FEED_TOLERANCE = 2e-5, 5e-4, 1e-6


def number(text):
    return float(text) if text else 0.0


def reference_moves(path):
    with open(path) as f:
        for row in csv.DictReader(f):
            if row["kind"] not in ("G0", "G1", "ARC"):
                continue
            kind = row["kind"]
            centre = None
            if kind == "ARC":
                kind = "G3" if number(row["turns"]) > 0 else "G2"
                centre = [number(row[c]) for c in ("ci", "cj", "ck")]
                normal = PLANE_AXES[int(row["plane"])][2]
                centre[normal] = None
            yield kind, [number(row[a]) for a in "xyzbc"], centre, number(row["feed"])


def our_moves(trunnion, program, setup):
    with tempfile.TemporaryDirectory() as folder:
        trace = os.path.join(folder, "trace.csv")
        done = subprocess.run([trunnion, "run", program, "--setup", setup, "--trace", trace],
                              capture_output=True, text=True)
        if done.returncode:
            raise ValueError(done.stderr.strip())
        with open(trace) as f:
            for row in csv.DictReader(f):
                at = [number(row[c]) for c in ("x_mm", "y_mm", "z_mm", "b_deg", "c_deg")]
                centre = None
                if row["center_x_mm"]:
                    centre = [number(row[f"center_{a}_mm"]) for a in "xyz"]
                yield row["motion"], at, centre, number(row["feed_mm_min"])


def apart(a, b):
    return max(abs(x - y) for x, y in zip(a, b) if x is not None and y is not None)


def without_standing(moves):
    kept, last = [], [0.0] * 5
    for move in moves:
        if move[2] is not None or apart(move[1], last) > POINT_TOLERANCE:
            kept.append(move)
        last = move[1]
    return kept


def difference(theirs, ours, per_revolution):
    turned = [a[1][3:] != b[1][3:] for a, b in zip(theirs, theirs[:1] + theirs)]
    for i, (a, b) in enumerate(zip(theirs, ours)):
        if a[0] != b[0] or apart(a[1], b[1]) > POINT_TOLERANCE:
            return f"move {i}: {a[0]} {a[1]} there, {b[0]} {b[1]} here"
        if a[2] and apart(a[2], b[2] or [1e9] * 3) > CENTRE_TOLERANCE_MM:
            return f"move {i}: centre {a[2]} there, {b[2]} here"
        named_alike = a[0] != "G0" and not turned[i] and not per_revolution
        if named_alike and abs(a[3] - b[3]) > FEED_TOLERANCE * max(1.0, a[3]):
            return f"move {i}: feed {a[3]} there, {b[3]} here"
    if len(theirs) != len(ours):
        return f"{len(theirs)} moves there, {len(ours)} here"
    return None


def main():
    trunnion, folder = sys.argv[1:3]
    setup = os.path.join(folder, "setup.toml")
    differing, programs = 0, sorted(glob.glob(os.path.join(folder, "paths", "*.nc")))
    for program in programs:
        theirs = without_standing(reference_moves(program[:-3] + ".path.csv"))
        with open(program, errors="replace") as f:
            per_revolution = "G95" in f.read()
        try:
            ours = without_standing(our_moves(trunnion, program, setup))
            what = difference(theirs, ours, per_revolution)
        except ValueError as error:
            what = str(error)
        if what:
            differing += 1
            print(f"{os.path.basename(program)}: {what}")
    print(f"{len(programs) - differing} of {len(programs)} paths equal")
    return 1 if differing or not programs else 0


if __name__ == "__main__":
    sys.exit(main())
