#!/usr/bin/env python3
"""Random single edits judged by LinuxCNC's interpreter: does `compare` call an edit equal that
changes motion, feed, spindle, coolant, dwell or tool?

usage: edits.py TRUNNION FOLDER [COUNT] [FIRST_SEED]

rs274 runs each program before and after the edit and gives its canonical calls; nothing of trunnion
takes part in that judgement. What rs274 refuses, and what lies near a tolerance (0.02 mm, 2 % of
feed), is not judged. Exit code 1 when an edit that changes something is called equal; both programs
stay in FOLDER.
"""
import json
import math
import os
import random
import re
import subprocess
import sys

from agree import LINE, numbers
from generate import INCH_MM, PLANE_AXES

TOOLS_MM = {1: (25.4, 6.0), 2: (50.8, 10.0), 3: (38.1, 5.0)}  # length, diameter
FAR_MM, FEED_RATIO = 0.02, 0.02
SAME_MM, SAME_FEED_RATIO = 0.001, 0.004
SETUP = """schema = "trunnion.setup/1"
[machine]
name = "against rs274"
chain = "w b X Y Z t"
axis.X = { direction = [1, 0, 0] }
axis.Y = { direction = [0, 1, 0] }
axis.Z = { direction = [0, 0, 1] }
[control.work_offsets]
G55 = { X = 7.0, Y = -4.0, Z = 2.0 }
[control.tools]
%s
[control.parameters]
6004 = "00000001"
""" % "\n".join(f"{n} = {{ length_mm = {l}, diameter_mm = {d} }}" for n, (l, d) in TOOLS_MM.items())

CODES = """G0 G1 G2 G3 G17 G18 G19 G20 G21 G40 G41 G42 G49 G54 G55 G61 G64 G73 G80 G81 G82 G83 G85 G89
G90 G91 G93 G94 G98 G99 M0 M1 M3 M4 M5 M7 M8 M9""".split()
BLOCKS = CODES + """T1 T2 T3 M6 S1500 F222. G4_P2 G0_Z60. G1_X3._F150. X9. Y-7. Z4. G1 G43_H1_Z70. G43_H3_Z70.
G10_L2_P1_X1. G10_L2_P2_Y3. G92_X1. G52_X2.""".split()


class Writer:
    """A program in the words that both controls read alike, each section with its own risks."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.lines = ["G21 G90 G17 G40 G49 G80 G94 G54", "F100."]
        for section in self.random.sample([self.contour, self.planes, self.cycles, self.inverse,
                                           self.inch, self.steps, self.frames], 4):
            self.begin()
            section()
            self.lines += ["G0 Z80.", "M9", "M5"]
        self.lines.append("M2")

    def length(self, low, high):
        return f"{self.random.uniform(low, high):.3f}"

    def begin(self):
        tool = self.random.choice(list(TOOLS_MM))
        self.lines += [f"T{tool} M6", f"S{self.random.randrange(1000, 9000, 100)} M3", "G0 X0. Y-40.",
                       f"G43 H{tool} Z80.", self.random.choice(["M8", "M7"]), "Z5."]

    def contour(self):
        side, x, y = self.random.choice(["G41", "G42"]), self.length(10, 30), self.length(10, 30)
        self.lines += ["G1 Z-2. F200.", f"{side} D1 X-40. Y-30. F400."]
        if side == "G41":  # clockwise around the part
            self.lines += [f"X-{x} Y0.", f"Y{y}", f"G2 X0. Y{float(x) + float(y):.3f} I{x} J0. F300.", f"G1 X{x} F400.",
                           "Y-20."]
        else:
            self.lines += [f"X0. Y-{y}", f"X{x}", f"G3 X{x} Y{y} I0. J{y}", f"G1 X-{x}", "Y-20."]
        self.lines += ["G40 X-60. Y-50.", "G0 Z20."]

    def planes(self):
        r = self.length(4, 12)
        self.lines += [f"G0 X20. Y0.", "Z10.", f"G18 G2 X{20 + float(r):.3f} Z{10 + float(r):.3f} "
                       f"I{r} K0. F350.", f"G19 G3 Y{r} Z{10 + 2 * float(r):.3f} J0. K{r} F250.",
                       "G17", f"G3 X{20 + float(r):.3f} Y{r} I-{r} J0.", "G4 P3", "G1 X0. F500."]

    def cycles(self):
        for code in self.random.sample(["G81", "G82", "G83", "G73", "G85", "G89"], 3):
            more = " P2" if code in ("G82", "G89") else " Q1.5" if code in ("G83", "G73") else ""
            self.lines += [f"{self.random.choice(['G98', 'G99'])} {code} X{self.length(-20, 20)} Y5. "
                           f"Z-{self.length(4, 9)} R2.{more} F{self.random.randint(60, 200)}.",
                           f"X{self.length(-20, 20)}", f"Y{self.length(8, 20)}", "G80"]

    def inverse(self):
        self.lines += ["G1 Z0. F300.", "G93"]
        self.lines += [f"G1 {self.random.choice('XY')}{self.length(-30, 30)} F{self.random.randint(5, 40)}."
                       for _ in range(4)]
        self.lines += ["G94", "X0. F333."]

    def inch(self):
        self.lines += ["G20", "G1 Z-.1 F9.", f"X{self.length(-1, 1)} F20.", f"Y{self.length(-1, 1)}",
                       "G2 X.5 Y.5 R2.", "G21", "G1 X3. F400."]

    def steps(self):
        self.lines += ["G1 Z-1. F150.", "G91"]
        self.lines += [f"G1 {self.random.choice('XYZ')}{self.length(-9, 9)} F{self.random.randint(100, 900)}."
                       for _ in range(5)] + ["G90", "Y0."]

    def frames(self):
        self.lines += ["G55", "G0 X5. Y5.", "G1 Z-1. F250.", "X25.", "G10 L2 P2 X9. Y-2. Z1.",
                       "G0 Z9.", "G55 G0 X4.", "G1 Z0. F260.", "Y22.", "G54", "G0 X2."]


def shared(lines):
    """Only words that mean the same on both controls: G41, G42 without D, G43 without H or with H0
    (LinuxCNC: the loaded tool) and codes that one of both does not know or uses otherwise (G8, G38,
    G92.1) are left out."""
    known = set(CODES) | {"G4", "G10", "G43", "G52", "G92", "M2", "M6", "M30"}
    for line in lines:
        words = line.split()
        letters = {w[0] for w in words}
        codes = {w for w in words if w[0] in "GM"}
        plain = {re.sub(r"^([GM])0+(?=\d)", r"\1", w) for w in codes}
        if plain - known or ({"G41", "G42"} & plain and "D" not in letters):
            return False
        if "G43" in plain and ("H" not in letters or "H0" in words) or "G4" in plain and letters != {"G", "P"}:
            return False
    return True


def edited(lines, chance):
    """The lines with one edit, or None where the edit chosen does not fit."""
    lines, at = list(lines), chance.randrange(1, len(lines) - 1)
    words = lines[at].split()
    kind = chance.choice(["digit"] * 4 + ["sign", "code", "letter", "drop", "move", "insert", "insert",
                                          "erase", "twice", "swap"])
    k = chance.randrange(len(words))
    if kind == "insert":
        lines.insert(at, chance.choice(BLOCKS).replace("_", " "))
    elif kind == "erase":
        del lines[at]
    elif kind == "twice":
        lines.insert(at, lines[at])
    elif kind == "swap":
        lines[at], lines[at + 1] = lines[at + 1], lines[at]
    elif kind == "move" and len(words) > 1:
        lines[at + 1] += " " + words.pop(k)
        lines[at] = " ".join(words)
    elif kind == "drop" and len(words) > 1:
        del words[k]
        lines[at] = " ".join(words)
    else:
        word = words[k]
        if kind == "digit":
            places = [i for i, c in enumerate(word) if c.isdigit()]
            i = chance.choice(places)
            word = word[:i] + chance.choice("0123456789") + word[i + 1:]
        elif kind == "sign" and word[0] in "XYZIJKRQ":
            word = word[0] + (word[2:] if word[1] == "-" else "-" + word[1:])
        elif kind == "code" and word[0] in "GM":
            word = chance.choice(CODES)
        elif kind == "letter" and word[0] not in "GM":
            word = chance.choice("XYZIJKFSTHDPQR") + word[1:]
        words[k] = word
        lines[at] = " ".join(words)
    return lines


class Judgement:
    """Canonical calls as moves (points, values) and functions with their places."""

    def __init__(self, text):
        self.offset = {"SET_G5X_OFFSET": [0.0] * 3, "SET_G92_OFFSET": [0.0] * 3,
                       "USE_TOOL_LENGTH_OFFSET": [0.0] * 3}  # so places are those of the spindle
        self.unit_mm, self.plane, self.feed, self.inverse = 1.0, 17, 0.0, False
        self.turning, self.speed, self.mist, self.flood, self.tool = 0, 0.0, False, False, 0
        self.at, self.moves, self.functions = [0.0] * 3, [], []
        for line in text.splitlines():
            if match := LINE.match(line):
                self.take(match[1], match[2], numbers(match[2]))
            elif "PROGRAM_END" in line:
                break

    def values(self, rapid):
        if rapid:
            return None
        return (self.feed * self.unit_mm, self.turning * self.speed, self.mist, self.flood, self.tool)

    def place(self, v):
        return [self.unit_mm * v[i] + sum(o[i] for o in self.offset.values()) for i in range(3)]

    def move(self, points, rapid):
        if any(math.dist(p, self.at) > 1e-9 for p in points):
            self.moves.append(([self.at] + points, self.values(rapid)))
        self.at = points[-1]

    def note(self, what, value=0.0):
        self.functions.append((what, value, self.at))

    def take(self, call, text, v):
        if call == "USE_LENGTH_UNITS":
            self.unit_mm = INCH_MM if "INCH" in text else 1.0
        elif call in self.offset:
            xyz = v[1:4] if call == "SET_G5X_OFFSET" else v[:3]
            self.offset[call] = [self.unit_mm * x for x in xyz]
        elif call == "SELECT_PLANE":
            self.plane = {"XY": 17, "XZ": 18, "YZ": 19}[text[-2:]]
        elif call in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            self.move([self.place(v[:3])], call == "STRAIGHT_TRAVERSE")
        elif call == "ARC_FEED":
            self.arc(v)
        elif call == "SET_FEED_RATE":
            self.feed = v[0]
        elif call in ("START_SPINDLE_CLOCKWISE", "START_SPINDLE_COUNTERCLOCKWISE"):
            self.turning = -1 if "COUNTER" in call else 1
        elif call == "STOP_SPINDLE_TURNING":
            self.turning = 0
        elif call == "SET_SPINDLE_SPEED":
            self.speed = v[-1]
        elif call in ("FLOOD_ON", "FLOOD_OFF"):
            self.flood = call.endswith("ON")
        elif call in ("MIST_ON", "MIST_OFF"):
            self.mist = call.endswith("ON")
        elif call == "CHANGE_TOOL":
            self.tool = v[0] if v else self.tool
            self.note(call, self.tool)
        elif call == "DWELL":
            self.note(call, v[0])
        elif call in ("PROGRAM_STOP", "OPTIONAL_PROGRAM_STOP"):
            self.note(call)

    def arc(self, v):
        a, b, normal = PLANE_AXES[self.plane]
        end, centre = [0.0] * 3, [0.0] * 3
        end[a], end[b], end[normal] = v[0], v[1], v[5]
        centre[a], centre[b] = v[2], v[3]
        end, centre = self.place(end), self.place(centre)
        start, turns = self.at, v[4]
        radius = math.hypot(start[a] - centre[a], start[b] - centre[b])
        grown = math.hypot(end[a] - centre[a], end[b] - centre[b]) - radius
        begin = math.atan2(start[b] - centre[b], start[a] - centre[a])
        sweep = math.atan2(end[b] - centre[b], end[a] - centre[a]) - begin
        turn = 2 * math.pi
        sweep = sweep % turn if turns > 0 else -((-sweep) % turn)
        if abs(sweep) < 1e-6:
            sweep = math.copysign(turn, turns)
        points = []
        for k in range(1, 65):
            p, share = [0.0] * 3, k / 64
            angle, r = begin + share * sweep, radius + share * grown
            p[a], p[b] = centre[a] + r * math.cos(angle), centre[b] + r * math.sin(angle)
            p[normal] = start[normal] + share * (end[normal] - start[normal])
            points.append(p)
        self.move(points, False)


def feeds_alike(p, q, ratio):
    if (p is None) != (q is None):
        return False
    return p is None or (abs(p[0] - q[0]) <= ratio * max(p[0], 1e-9) and
                         abs(p[1] - q[1]) <= ratio * abs(p[1]) and p[2:] == q[2:])


def from_segment(p, a, b):
    d = [q - r for q, r in zip(b, a)]
    length2 = sum(x * x for x in d)
    t = max(0.0, min(1.0, sum((p[i] - a[i]) * d[i] for i in range(3)) / length2)) if length2 else 0.0
    return math.dist(p, [a[i] + t * d[i] for i in range(3)])


def leaves(moves, others):
    """Some point of `moves` lies off everything in `others` that has the same values."""
    for points, values in moves:
        middles = [[(x + y) / 2 for x, y in zip(p, q)] for p, q in zip(points, points[1:])]
        for p in (points + middles)[::4] if len(points) > 9 else points + middles:
            if all(from_segment(p, a, b) > 2 * FAR_MM
                   for others_points, v in others if feeds_alike(values, v, FEED_RATIO)
                   for a, b in zip(others_points, others_points[1:])):
                return True
    return False


def functions_alike(a, b, far_mm):
    return len(a) == len(b) and all(
        p[0] == q[0] and abs(p[1] - q[1]) <= 0.01 * abs(p[1]) and
        math.dist(p[2], q[2]) <= far_mm for p, q in zip(a, b))


def verdict(a, b):
    """'changed', 'same' or None: not sure."""
    if not functions_alike(a.functions, b.functions, FAR_MM):
        return "changed"
    if len(a.moves) != len(b.moves):
        return "changed" if leaves(a.moves, b.moves) or leaves(b.moves, a.moves) else None
    same = functions_alike(a.functions, b.functions, SAME_MM)
    for (p, v), (q, w) in zip(a.moves, b.moves):
        if len(p) != len(q):
            return None
        far = max(math.dist(x, y) for x, y in zip(p, q))
        if not feeds_alike(v, w, FEED_RATIO):
            return "changed"
        same = same and far <= SAME_MM and feeds_alike(v, w, SAME_FEED_RATIO)
    # An end that slides along the path, or a tool that turns back on it, is not judged.
    if not same and (leaves(a.moves, b.moves) or leaves(b.moves, a.moves)):
        return "changed"
    return "same" if same else None


def judged(program):
    with open("rs274.var", "w") as f:
        f.writelines(f"{n} {value}\n" for n, value in
                     [(n, {5220: 1, 5241: 7.0, 5242: -4.0, 5243: 2.0}.get(n, 0))
                      for n in range(5161, 5391)])
    done = subprocess.run(["rs274", "-t", "tools.tbl", "-v", "rs274.var", "-g", program],
                          capture_output=True, text=True)
    return Judgement(done.stdout) if "PROGRAM_END" in done.stdout else None


def write(path, lines):
    with open(path, "w") as f:
        f.write("%\nO1000\n" + "\n".join(lines) + "\n%\n" if path.startswith(("a/", "b/"))
                else "\n".join(lines) + "\n")


def pairs(count, first):
    """Name and rs274's opinion of each edit; writes a/NAME and b/NAME for trunnion."""
    opinions, seed, skipped = {}, first, 0
    while len(opinions) < count:
        chance, lines = random.Random(-seed), Writer(seed).lines
        write("one.ngc", lines)
        before = judged("one.ngc")
        assert before, f"seed {seed}: rs274 refuses the program"
        for n in range(25):
            after_lines = edited(lines, chance)
            write("one.ngc", after_lines)
            after = judged("one.ngc") if shared(after_lines) else None
            opinion = verdict(before, after) if after else None
            if opinion is None:
                skipped += 1
                continue
            name = f"s{seed}_{n}.nc"
            opinions[name] = opinion
            write("a/" + name, lines)
            write("b/" + name, after_lines)
        seed += 1
    return opinions, skipped


def main():
    trunnion, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 1200
    first = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    for side in ("a", "b"):
        os.makedirs(os.path.join(folder, side), exist_ok=True)
    os.chdir(folder)
    for side in ("a", "b"):
        for name in os.listdir(side):
            os.remove(os.path.join(side, name))
    write("setup.toml", [SETUP])
    write("tools.tbl", [f"T{n} P{n} Z{l / INCH_MM:.9f} D{d / INCH_MM:.9f}"
                        for n, (l, d) in TOOLS_MM.items()])
    opinions, skipped = pairs(count, first)
    done = subprocess.run([trunnion, "compare", "a", "b", "--setup", "setup.toml", "--json"],
                          capture_output=True, text=True)
    cases = {re.sub(r".*/", "", c["name"]): c for c in json.loads(done.stdout)["cases"]}
    counts = {(o, e): 0 for o in ("changed", "same") for e in (True, False)}
    for name, opinion in opinions.items():
        # M and T codes without an effect on a cut differ by `functions`; rs274 says nothing of them.
        equal = cases[name]["equal"] or (opinion == "same" and cases[name]["by"] == "functions")
        counts[opinion, equal] += 1
        if equal == (opinion == "changed"):
            print(f"{name}: rs274 says {opinion}, {cases[name]['verdict']}")
        else:
            os.remove("a/" + name)
            os.remove("b/" + name)
    changed = counts["changed", True] + counts["changed", False]
    same = counts["same", True] + counts["same", False]
    print(f"{len(opinions)} edits judged by rs274 ({skipped} more not judged): {changed} change machining,"
          f" {counts['changed', True]} of them called equal; {same} do not, {counts['same', False]} of"
          f" them called different")
    return 1 if counts["changed", True] or not changed else 0


if __name__ == "__main__":
    sys.exit(main())
