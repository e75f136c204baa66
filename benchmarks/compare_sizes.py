#!/usr/bin/env python3
"""Time and peak memory of `compare` on programs of many blocks. Every line differs in text and in
its block (three decimals, four decimals), the path is equal: the table in docs/compare.md.

usage: compare_sizes.py TRUNNION FOLDER [MILLION_BLOCKS...]
"""
import math
import os
import resource
import subprocess
import sys

HEAD = "%\nO1\nG90 G21 G94 G17 G54\nT1 M6\nS8000 M3\nG0 X0. Y0. Z50.\n"


def one_cut(f, blocks, decimals):
    """A spiral of short chords: no pass ends."""
    f.write("G1 Z0. F300.\n")
    for k in range(blocks):
        angle, radius = 0.02 * k, 20.0 + 60.0 * k / blocks
        f.write(f"X{radius * math.cos(angle):.{decimals}f} Y{radius * math.sin(angle):.{decimals}f}\n")


def short_cut(f, k, decimals):
    x, y = k % 1000 * 0.5 - 249.87654, k // 1000 % 500 * 0.5 + 0.12345
    f.write(f"G0 X{x:.{decimals}f} Y{y:.{decimals}f}\nZ{1.23456:.{decimals}f}\n"
            f"G1 Z{-1.23456:.{decimals}f} F300.\nX{x + 0.4:.{decimals}f} F800.\nG0 Z{5.43212:.{decimals}f}\n")


def many_passes(f, blocks, decimals):
    """Short cuts with a rapid to each: five blocks a pass."""
    for k in range(blocks // 5):
        short_cut(f, k, decimals)


def halves_exchanged(f, blocks, decimals):
    """The same passes, on side B the second half first."""
    count = blocks // 5
    for k in range(count):
        short_cut(f, k if decimals == 3 else (k + count // 2) % count, decimals)


def write(path, body, blocks, decimals):
    with open(path, "w") as f:
        f.write(HEAD)
        body(f, blocks, decimals)
        f.write("G0 Z100.\nM5\nM30\n%\n")
    return os.path.getsize(path) / 1e6


def measured(command):
    """CPU seconds, peak memory in MB and the first line of the answer."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(["/usr/bin/time", "-f", "%M", *command], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    peak_mb = float(done.stderr.split()[-1]) / 1024
    return cpu_s, peak_mb, done.stdout.splitlines()[0][:70]


def main():
    trunnion, folder = sys.argv[1:3]
    sizes = [float(v) for v in sys.argv[3:]] or [1.0]
    os.makedirs(folder, exist_ok=True)
    a, b = os.path.join(folder, "a.nc"), os.path.join(folder, "b.nc")
    print("| each side | file | CPU time | peak memory | of it the two files | answer |\n|---|---|---|---|---|---|")
    for million in sizes:
        for body in (one_cut, many_passes, halves_exchanged):
            size_mb = write(a, body, int(million * 1e6), 3)
            both_mb = size_mb + write(b, body, int(million * 1e6), 4)
            cpu_s, peak_mb, answer = measured([trunnion, "compare", a, b])
            print(f"| {million:g} M blocks, {body.__name__.replace('_', ' ')} | {size_mb:.0f} MB | {cpu_s:.1f} s"
                  f" | {peak_mb:.0f} MB | {both_mb:.0f} MB | {answer} |", flush=True)


if __name__ == "__main__":
    main()
