#!/usr/bin/env python3
"""Whole-process times of trunnion and LinuxCNC's rs274 on the same workloads, in turn, and their ratios.

usage: against_rs274.py TRUNNION FOLDER [UNITS] [ROUNDS]

Both times include starting the program; the ratio of the medians is what counts.
"""
import os
import shutil
import statistics
import subprocess
import sys
import time

SETUP = """schema = "trunnion.setup/1"
[machine]
name = "speed"
chain = "w C B b X Y Z t"
axis.B = { direction = [0, -1, 0], point_mm = [0, 0, 0] }
axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }
axis.X = { direction = [1, 0, 0] }
axis.Y = { direction = [0, 1, 0] }
axis.Z = { direction = [0, 0, 1] }
"""
GOALS = {"line3": 10, "line5": 10, "arcs": 10, "loop": 30, "calls": 30}


def seconds(command):
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.decode()[:300]}")
    return time.perf_counter() - start


def main():
    trunnion, folder = sys.argv[1:3]
    units = int(sys.argv[3]) if len(sys.argv) > 3 else 200000
    rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 5
    here = os.path.dirname(os.path.abspath(__file__))
    subprocess.run([sys.executable, os.path.join(here, "workloads.py"), folder, str(units)], check=True)
    setup = os.path.join(folder, "speed.toml")
    with open(setup, "w") as f:
        f.write(SETUP)
    rs274 = shutil.which("rs274")
    if rs274 is None:
        print("rs274 is not here (Debian package linuxcnc-uspace): trunnion alone")
    print(f"{'workload':9}{'rs274 1/s':>12}{'trunnion 1/s':>14}{'ratio':>8}{'goal':>6}{'with trace 1/s':>16}{'ratio':>8}{'goal':>6}")
    for name, goal in GOALS.items():
        nc = os.path.join(folder, name + ".nc")
        base = [trunnion, "run", nc, "--setup", setup, "--json"]
        times = {"rs274": [], "plain": [], "trace": []}
        for _ in range(rounds):
            if rs274:
                times["rs274"].append(seconds([rs274, "-g", os.path.join(folder, name + ".ngc"), os.devnull]))
            times["plain"].append(seconds(base))
            times["trace"].append(seconds(base + ["--trace", os.path.join(folder, "trace.csv")]))
        rate = {k: units / statistics.median(v) for k, v in times.items() if v}
        reference = rate.get("rs274", float("nan"))
        print(f"{name:9}{reference:12,.0f}{rate['plain']:14,.0f}{rate['plain'] / reference:8.1f}{goal:6}"
              f"{rate['trace']:16,.0f}{rate['trace'] / reference:8.1f}{3:6}")


if __name__ == "__main__":
    main()
