#!/usr/bin/env python3
"""Writes the speed workloads, each as Fanuc (.nc) and LinuxCNC (.ngc) program with the same motion.

usage: workloads.py FOLDER [UNITS]      UNITS: blocks, iterations or calls (default 200000)
"""
import math
import os
import sys

START = ["G21 G90 G17 G94 G40 G80", "G54", "G0 X0 Y0 Z10"]


def line_blocks(units):
    """Three-axis finishing: a zigzag over a wavy surface."""
    for i in range(units):
        row, k = divmod(i, 400)
        x = -90 + 0.45 * (k if row % 2 == 0 else 399 - k)
        y = -90 + 0.35 * row
        z = 1.5 * math.cos(0.13 * x) * math.sin(0.09 * y) - 4
        yield f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f}" + (" F1500." if i == 0 else "")


def five_axis_blocks(units):
    """Simultaneous five-axis moves with a feed in every block."""
    for i in range(units):
        t = 0.0013 * i
        x, y, z = 55 * math.sin(t), 48 * math.cos(1.1 * t), 15 + 6 * math.sin(4 * t)
        b, c = 40 * math.sin(0.9 * t), 150 * math.cos(0.6 * t)
        yield f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f} B{b:.4f} C{c:.4f} F{1500 + 250 * math.cos(9 * t):.1f}"


def arc_blocks(units):
    """Half and quarter circles that stay near the origin, each tenth one a helix."""
    yield "G1 X0 Y0 Z0 F1200."
    x, y = 0.0, 0.0
    for i in range(units):
        radius = 1.5 + 0.2 * (i % 13)
        start = math.radians(90 * (i % 4))
        sweep = math.radians(90 if i % 3 else 180)
        cx, cy = x - radius * math.cos(start), y - radius * math.sin(start)
        ex, ey = cx + radius * math.cos(start + sweep), cy + radius * math.sin(start + sweep)
        if max(abs(ex), abs(ey)) > 300:
            yield "G1 X0.0 Y0.0"
            x = y = 0.0
            continue
        ex, ey = round(ex, 5), round(ey, 5)
        helix = f" Z{-(i % 50) * 0.02:.3f}" if i % 10 == 9 else ""
        yield f"G3 X{ex:.5f} Y{ey:.5f} I{cx - x:.5f} J{cy - y:.5f}{helix}"
        x, y = ex, ey


def loop(units, fanuc):
    """A macro loop of six statements and one move."""
    head = f"WHILE[#1LT{units}]DO1" if fanuc else f"o1 while [#1 LT {units}]"
    tail = "END1" if fanuc else "o1 endwhile"
    return ["#1=0", head, "#2=[#1*0.02]", "#3=[40.0*SIN[#2]]", "#4=[40.0*COS[#2]]",
            "#5=[SQRT[#3*#3+#4*#4]/8.0]", "#6=[ATAN[#3]/[#4+90.0]]", "G1 X[#3] Y[#4] Z[#5-#6*0.02] F900",
            "#1=[#1+1]", tail]


def calls(units, fanuc):
    """One macro call with two arguments for each unit."""
    if fanuc:
        return ["#100=0", f"WHILE[#100LT{units}]DO1", "G65 P9001 A#100 B3.5", "#100=#100+1", "END1"]
    return ["#100=0", f"o1 while [#100 LT {units}]", "o9001 call [#100] [3.5]", "#100=[#100+1]",
            "o1 endwhile"]


def write(folder, name, lines):
    with open(os.path.join(folder, name), "w", newline="\n") as f:
        f.write("\n".join(lines) + "\n")


def main():
    folder = sys.argv[1]
    units = int(sys.argv[2]) if len(sys.argv) > 2 else 200000
    os.makedirs(folder, exist_ok=True)
    for name, blocks in (("line3", line_blocks), ("line5", five_axis_blocks), ("arcs", arc_blocks)):
        body = list(blocks(units))
        write(folder, name + ".nc", ["%", "O1000"] + START + body + ["M30", "%"])
        write(folder, name + ".ngc", START + body + ["M2"])
    write(folder, "loop.nc", ["%", "O1000"] + START + loop(units, True) + ["M30", "%"])
    write(folder, "loop.ngc", START + loop(units, False) + ["M2"])
    sub = ["O9001", "G1 X[#1*0.001] Y#2 F1000", "M99"]
    write(folder, "calls.nc", ["%", "O1000"] + START + calls(units, True) + ["M30"] + sub + ["%"])
    sub = ["o9001 sub", "G1 X[#1*0.001] Y#2 F1000", "o9001 endsub"]
    write(folder, "calls.ngc", sub + START + calls(units, False) + ["M2"])


if __name__ == "__main__":
    main()
