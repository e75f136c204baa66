#!/usr/bin/env python3
"""LinuxCNC's interpreter as the other control: does diagnose --program name what it does differently?

usage: gaps.py TRUNNION FOLDER

rs274 runs a program, its moves become a log with N numbers, and a setup that differs from LinuxCNC
in one documented way is asked about it. Exit code 77 without rs274, 1 when an answer is wrong.
"""
import json
import os
import re
import shutil
import subprocess
import sys

from agree import INCH_MM, Canon, numbers
from generate import PLANE_AXES

LINE = re.compile(r"\s*\d+ N(\S+)\s+(\w+)\((.*)\)")
TOOL_MM, OFFSET_MM = 10.5, (12.5, -8.0, 3.25)
HEAD = "G21 G90 G17 G40 G49 G80 G94 G54\nG0 X5. Y6. Z30.\n"

DRILLING = HEAD + """G99 G73 X10. Y10. Z-9. R3. Q4. F200
X25. Y12.
G73 X30. Y-5. Z-8. R3. Q3.
G80
G98 G83 X10. Y-10. Z-12. R3. Q5. F200
X-20. Y8.
G80
G0 Z40.
"""
LENGTH = HEAD + """G43 H1
G0 X20. Y10.
G1 Z2. F300
X30.
G0 Z30.
G49
X0. Y1.
Z25.
"""
POINTS = HEAD + """G0 X40 Y10
G1 X12 Y7 F300
G2 X22 Y17 I10 J0
G1 X20. Y3.
Z5
G0 Z30.
"""
ANGLES = HEAD + """#101=ATAN[-1.]/[1.]
G1 X#101 F400
#102=ATAN[-3.]/[-4.]
G1 Y[#102/2.]
G1 Z[ATAN[-2.]/[5.]]
G0 X1. Y1. Z30.
"""
CONTOUR = HEAD + """G0 Z2.
G1 X20. F300
G3 X30. Y16. I0. J10.
G2 X40. Y26. R10.
G1 X0. Y30.
G91 X5. Y-4.
G90 G0 Z30.
"""
ROUNDING = HEAD + """G1 X[FIX[-2.5]*4.] F300
Y[FUP[-1.25]*3.]
X[FIX[-7.5]*2.] Y4.
G0 Z31.
"""
REFERENCE = HEAD + """G0 X20. Y10.
G1 Z2. F300
X30.
G91 G28 Z0
G90 G0 X5. Y5.
Z20.
G1 X9. F200
G91 G28 X0 Y0
G90 X3.
"""
STALE = HEAD + """G0 X[20.+#500] Y10.
G1 Z2. F300
X30.
Y[12.-#500]
G0 Z30.
"""
TWO_OFFSETS = HEAD + """G0 X20. Y10. Z25.
G1 Z2. F300
X30.
G0 Z30.
G55 X5. Y5.
G1 Z1. F300
X25.
Y-10.
G0 Z30.
"""
USUAL = {3401: '"00000001"', 3410: "0.01", 5006: '"01000000"', 5114: "0.254", 5115: "0.254",
         6004: '"00000001"'}


class Case:
    """One program; `wrong` parameters, offset and tool differ from what LinuxCNC does. `left`: what
    an earlier program left in LinuxCNC's variables; `rivals` of the cause that must be named."""

    def __init__(self, name, text, wrong, answers, tool_mm=TOOL_MM, offset_mm=OFFSET_MM, left=None,
                 rivals=()):
        self.name, self.text, self.answers = name, text, answers
        self.left, self.rivals = left or {}, set(rivals)
        self.parameters = {**USUAL, **wrong}
        self.tool_mm, self.offset_mm = tool_mm, offset_mm

    def program(self):
        lines = (self.text + "M2\n").splitlines()
        return "\n".join(f"N{10 * (k + 1)} {line}" for k, line in enumerate(lines)) + "\n"

    def setup(self):
        parameters = "\n".join(f"{n} = {v}" for n, v in self.parameters.items())
        offset = ", ".join(f"{a} = {v}" for a, v in zip("XYZ", self.offset_mm))
        return f"""[machine]
name = "against rs274"
chain = "w b X Y Z t"
[control.work_offsets]
G54 = {{ {offset} }}
[control.tools]
1 = {{ length_mm = {self.tool_mm}, diameter_mm = 0 }}
[control.parameters]
{parameters}
"""


CASES = [
    Case("nothing", CONTOUR + LENGTH[len(HEAD):] + DRILLING[len(HEAD):], {}, {}),
    Case("peck", DRILLING, {5114: "1.0"}, {"5114": {"5114": 0.254}}),
    Case("clearance", DRILLING, {5115: "2.0"}, {"5115": {"5115": 0.254}}),
    Case("both", DRILLING, {5114: "1.0", 5115: "2.0"},
         {"5114": {"5114": 0.254}, "5115": {"5115": 0.254}}),
    Case("length moves", LENGTH, {5006: '"00000000"'}, {"5006#6=1": {}}),
    Case("points", POINTS, {3401: '"00000000"'}, {"3401#0=1": {}}),
    Case("angles", ANGLES, {6004: '"00000000"'}, {"6004#0=1": {}}),
    Case("offset", CONTOUR, {}, {"G54": {"G54.X": 12.5, "G54.Z": 3.25}},
         offset_mm=(12.53, -8.0, 3.2)),
    Case("tool", LENGTH, {}, {"H1": {"H1": TOOL_MM}}, tool_mm=10.46),
    Case("reference point", REFERENCE, {}, {}),
    Case("variable", STALE, {}, {"common variables": {"#500": 2.5}}, left={500: 2.5}),
    Case("left G92", TWO_OFFSETS, {}, {"external": {"external.X": 0.75, "external.Y": -2.0}},
         left={5210: 1, 5211: 0.75 / INCH_MM, 5212: -2.0 / INCH_MM}, rivals=("G52", "G92")),
    Case("no switch", ROUNDING, {}, None),
]


def run_rs274(program, left):
    with open("tools.tbl", "w") as f:
        f.write(f"T1 P1 Z{TOOL_MM / INCH_MM:.9f}\n")
    values = {n: 0 for n in range(5161, 5391)} | {5220: 1} | left
    values |= {5221 + k: v / INCH_MM for k, v in enumerate(OFFSET_MM)}
    with open("rs274.var", "w") as f:
        f.writelines(f"{n} {values[n]}\n" for n in sorted(values))
    done = subprocess.run(["rs274", "-t", "tools.tbl", "-v", "rs274.var", "-g", program],
                          capture_output=True, text=True)
    if "PROGRAM_END" not in done.stdout:
        sys.exit(f"{program}: refused by rs274: {done.stderr}")
    return done.stdout


def log_rows(text):
    """block, motion, end, centre, normal, turns of each move."""
    canon = Canon("")
    for line in text.splitlines():
        match = LINE.match(line)
        if not match:
            continue
        before, values = len(canon.moves), numbers(match[3])
        canon.take(match[2], match[3], values)
        for kind, end, centre in canon.moves[before:]:
            row = [match[1], kind, *(f"{v:.4f}" for v in end)]
            if centre:
                normal = PLANE_AXES[canon.plane][2]
                row += [f"{v if v is not None else 0:.4f}" for v in centre]
                row += ["1" if k == normal else "0" for k in range(3)] + [str(values[4])]
            else:
                row += [""] * 7
            yield row


def write_log(text):
    with open("log.csv", "w") as f:
        f.write("block,motion,x_mm,y_mm,z_mm,center_x_mm,center_y_mm,center_z_mm,"
                "normal_x,normal_y,normal_z,turns\n")
        f.writelines(",".join(row) + "\n" for row in log_rows(text))


def fault(case, result):
    """What is wrong with an answer, or None."""
    causes = {c["effect"]: {p["name"]: p["value"] for p in c["parameters"]}
              for c in result["causes"]}
    if case.answers is None:
        return None if result["verdict"] in ("unexplained", "partly-explained") else "explained"
    if set(causes) != set(case.answers):
        return f"{sorted(causes)} instead of {sorted(case.answers)}"
    for name, values in case.answers.items():
        for parameter, value in values.items():
            if abs(causes[name].get(parameter, 1e9) - value) > 2e-3:
                return f"{parameter}: {causes[name].get(parameter)} instead of {value}"
    if not case.answers:
        return None if result["verdict"] == "no-gap" else result["verdict"]
    if result["verdict"] not in ("explained", "ambiguous"):
        return result["verdict"]
    if any(not case.rivals <= set(c["rivals"]) for c in result["causes"]):
        return f"no {sorted(case.rivals)} among the rivals"
    if any(c["probability"] >= 1 for c in result["causes"]):
        return "probability 1"
    return None if result["after"]["explained"] > 0.99 else "explained too little"


def main():
    if not shutil.which("rs274"):
        print("no rs274 here")
        return 77
    trunnion = os.path.abspath(sys.argv[1])
    os.makedirs(sys.argv[2], exist_ok=True)
    os.chdir(sys.argv[2])
    wrong = 0
    for case in CASES:
        for name, text in (("part.nc", case.program()), ("setup.toml", case.setup())):
            with open(name, "w") as f:
                f.write(text)
        write_log(run_rs274("part.nc", case.left))
        done = subprocess.run([trunnion, "diagnose", "log.csv", "--program", "part.nc", "--setup",
                               "setup.toml", "--json"], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{case.name}: {done.stderr}")
        result = json.loads(done.stdout)
        what = fault(case, result)
        wrong += what is not None
        rms = f"{result['gap']['rms_um']:.1f} -> {result['after']['rms_um']:.3f} um"
        print(f"{case.name}: {result['verdict']}, {rms}" + (f": WRONG: {what}" if what else ""))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
