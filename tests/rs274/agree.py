#!/usr/bin/env python3
"""Random programs on trunnion and on LinuxCNC's interpreter: is every end point and centre the same?

usage: agree.py TRUNNION FOLDER [COUNT] [FIRST_SEED]

rs274 prints four decimals of the program's unit, so points agree within 2e-4 mm, or 4e-3 mm in a
program with inches. Exit code 1 when a program differs; it stays in FOLDER.
"""
import csv
import math
import os
import re
import subprocess
import sys

from generate import INCH_MM, PLANE_AXES, Program

TOOLS_MM = {1: 10.5, 2: 20.25, 3: -3.0}
SETUP = """schema = "trunnion.setup/1"
[machine]
name = "against rs274"
chain = "w b X Y Z t"
axis.X = { direction = [1, 0, 0] }
axis.Y = { direction = [0, 1, 0] }
axis.Z = { direction = [0, 0, 1] }
[control.tools]
%s
[control.parameters]
3410 = 0.01
5114 = 0.254
5115 = 0.254
6004 = "00000001"
""" % "\n".join(f"{n} = {{ length_mm = {mm}, diameter_mm = 0 }}" for n, mm in TOOLS_MM.items())
LINE = re.compile(r"\s*\d+ N\S+\s+(\w+)\((.*)\)")


def numbers(text):
    try:
        return [float(v) for v in text.replace(",", " ").split()]
    except ValueError:
        return []


class Canon:
    """LinuxCNC's canonical calls as (kind, end in machine mm, centre by axis index) rows."""

    def __init__(self, text):
        self.offsets = {"SET_G5X_OFFSET": [0.0] * 3, "SET_G92_OFFSET": [0.0] * 3,
                        "USE_TOOL_LENGTH_OFFSET": [0.0] * 3}
        self.unit_mm, self.plane, self.moves = 1.0, 17, []
        for line in text.splitlines():
            if match := LINE.match(line):
                self.take(match[1], match[2], numbers(match[2]))

    def point(self, values):
        offset = [sum(o[i] for o in self.offsets.values()) for i in range(3)]
        return [None if v is None else self.unit_mm * (v + o) for v, o in zip(values, offset)]

    def take(self, call, text, v):
        if call == "USE_LENGTH_UNITS":
            unit_mm = INCH_MM if "INCH" in text else 1.0
            for offset in self.offsets.values():
                offset[:] = [o * self.unit_mm / unit_mm for o in offset]
            self.unit_mm = unit_mm
        elif call in self.offsets:
            self.offsets[call] = v[1:4] if call == "SET_G5X_OFFSET" else v[:3]
        elif call == "SELECT_PLANE":
            self.plane = {"XY": 17, "XZ": 18, "YZ": 19}[text[-2:]]
        elif call in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            self.moves.append(("G0" if call.endswith("TRAVERSE") else "G1", self.point(v[:3]), None))
        elif call == "ARC_FEED":
            a, b, normal = PLANE_AXES[self.plane]
            end, centre = [0.0] * 3, [None] * 3
            end[a], end[b], end[normal] = v[0], v[1], v[5]
            centre[a], centre[b] = v[2], v[3]
            self.moves.append(("G3" if v[4] > 0 else "G2", self.point(end), self.point(centre)))


def run_rs274(program):
    with open("tools.tbl", "w") as f:  # rs274 reads its tool table in inches
        f.writelines(f"T{n} P{n} Z{mm / INCH_MM:.9f}\n" for n, mm in TOOLS_MM.items())
    with open("rs274.var", "w") as f:  # every offset zero, G54 active
        f.writelines(f"{n} {1 if n == 5220 else 0}\n" for n in range(5161, 5391))
    done = subprocess.run(["rs274", "-t", "tools.tbl", "-v", "rs274.var", "-g", program],
                          capture_output=True, text=True)
    return None if "PROGRAM_END" not in done.stdout else Canon(done.stdout).moves


def run_trunnion(trunnion, program):
    done = subprocess.run([trunnion, "run", program, "--setup", "setup.toml", "--trace", "trace.csv"],
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{program}: {done.stderr}")

    def moves():
        with open("trace.csv") as f:
            for row in csv.DictReader(f):
                centre = [float(row[f"center_{a}_mm"]) for a in "xyz"] if row["center_x_mm"] else None
                yield row["motion"], [float(row[f"{a}_mm"]) for a in "xyz"], centre, int(row["line"])

    return list(moves())


def without_standing(moves, tolerance_mm):
    """Cycles of either side may contain moves of no length."""
    kept, last = [], [0.0] * 3
    for move in moves:
        if move[2] is not None or math.dist(move[1], last) > tolerance_mm:
            kept.append(move)
        last = move[1]
    return kept


def difference(expected, found, tolerance_mm):
    """The first difference in words, or None."""
    for theirs, ours in zip(expected, found):
        apart = math.dist(theirs[1], ours[1])
        if theirs[0] != ours[0] or apart > tolerance_mm:
            return f"line {ours[3]}: {theirs[0]} {theirs[1]} there, {ours[0]} {ours[1]} here"
        for there, here in zip(theirs[2] or [], ours[2] or []):
            if there is not None and abs(there - here) > 10 * tolerance_mm:
                return f"line {ours[3]}: centre {theirs[2]} there, {ours[2]} here"
    if len(expected) != len(found):
        return f"{len(expected)} moves there, {len(found)} here"
    return None


def main():
    trunnion, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    first = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    with open("setup.toml", "w") as f:
        f.write(SETUP)
    compared = moves = differing = 0
    for seed in range(first, first + count):
        program, name = Program(seed), f"random_{seed}.nc"
        with open(name, "w") as f:
            f.write("\n".join(program.lines) + "\n")
        expected = run_rs274(name)
        if expected is None:
            print(f"{name}: refused by rs274")
            continue
        found = run_trunnion(trunnion, name)
        inches = any("G20" in line for line in program.lines)
        tolerance_mm = 4e-3 if inches else 2e-4
        what = difference(without_standing(expected, tolerance_mm),
                          without_standing(found, tolerance_mm), tolerance_mm)
        compared += 1
        moves += len(found)
        if what:
            differing += 1
            print(f"{name}: {what}")
        else:
            os.remove(name)
    print(f"{compared} of {count} programs compared, {moves} moves, {differing} programs differ")
    return 1 if differing or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
