#!/usr/bin/env python3
"""Random NC programs of a few lines: what a run refuses, check must refuse.

    tests/assurance/refused_blocks.py build/release/bin/trunnion --programs 20000 --seed 1

Draws programs from lists of codes, statements and kinds of numbers, checks them all, and runs those that check does not
refuse. Prints how many a run refuses all the same, by kind, and of a sample of the refused ones how many a run passes.
With --show, each of the former is printed. Exit code: 0, or 1 where a run ends otherwise than with its end, an alarm or
a limit, or prints nan. The share has no limit: what check cannot know (an unset variable, a skip signal) stays open.
Same seed, same programs. 20,000 programs take about 40 s on two processors.
"""
import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

# The first PLAIN values can be read as numbers; the others are expressions, or wrong.
VALUES = """0 1 -1 2 2.5 29.7 3. 10. -7.5 100 .5 17 300 360. -360. 1000 0.25 98 6000 9999 99999 8 12345678 123456789
1234567890 -0 1.00005 99999.999 -.5 +2 #100 [1+2] [1/0] #0 -#101 #[100] SQRT[-1] ASIN[2] [#1EQ#0] FIX[2.7] 1e5 . --1
1.5.2 ATAN[1]/[0] ATAN[0]/[0] LN[0] POW[0,-1] #-1 #99999 #33 #149 #500 #1000 #3001 #5021 #20001 ACOS[-1.1] [2 2]
TAN[90] EXP[800] ROUND[2.5] BIN[10] BCD[-1] BIN[255] MOD [7MOD0] 1E2 999999999999 0.000000001 00000000012
1.0000000000000""".split() + ["", "[1 AND 2.5]", "[-1 OR 2]"]
PLAIN = 30
G_CODES = """0 1 2 3 4 5 5.1 7.1 8 9 10 10.6 11 12 12.1 13.1 15 16 17 18 19 20 21 22 23 27 28 29 30 31 31.8 33 34 37 38 39
40 40.1 41 41.2 41.5 42 42.2 43 43.1 43.4 43.5 43.7 44 45 46 47 48 49 50 50.1 50.2 51 51.1 52 53 53.1 53.6 54 54.1 54.2
54.4 55 59 60 61 62 63 64 65 66 66.1 67 68 68.2 68.3 68.4 69 69.1 72.1 73 74 75 76 77 80 80.4 81 82 83 84 84.2 85 86 87
88 89 90 91 92 92.1 93 94 95 96 97 98 99 107 150 254 777""".split()
M_CODES = """0 1 2 3 4 5 6 8 9 19 29 30 98 99 96 97 100 101 128 129 198 199 1000 29.7 -1 00 099 100000000 123456789 98.
30.0 200 126 127 10 11 31 32 60""".split()
LETTERS = "ABCDEFHIJKLPQRSTUVWXYZ"
NUMBERS = """1 33 34 99 100 149 199 200 500 531 999 1000 1005 1100 1132 2000 2001 2500 3000 3001 3003 3004 3005 3006
3007 3011 3012 3020 3901 4001 4130 5001 5021 5041 5061 5081 5201 5221 5320 5401 7001 10001 12001 13001 14001 20000 20001
98000 99999 100000 1000000 0 -1 2.5""".split()
# $: a value; @: a number of a variable; ;: the next block.
STATEMENTS = """@=$|#[$]=$|IF[$EQ$]GOTO$|IF[$LT$]THEN@=$|GOTO$|WHILE[$LT$]DO1;END1|END1|DO4|END2|WHILE[1EQ1]DO$|POPEN|PCLOS
DPRNT[X@[53]]|DPRNT[ABC@[$]]|BPRNT[A@[3]]|@=@/$|#3000=$|#3006=$|@=@+$*$|N$|/$|/ G0 X1.|G65 P$ A1. B$|G66 P$ L$|M98 P$ L$
M98 P$|M99 P$|G10 L$ P$ R$|G10 L2 P$ X$|G10 L20 P$ X$|G10 L52|G10 L50;N1005R$;G11|G10 L10 P$ R$|G68.2 X0 Y0 Z0 I$ J$ K$
G68.2 P$ X0 Y0 Z0 I$ J$ K$|G43 H$|G43.4 H$|G41 D$|G41 D1 X10.|G2 X$ Y$ R$|G2 X$ Y$ I$ J$|G3 I$ J$ K$ L$
G81 X1. Y1. Z-5. R$ F$ L$|G83 X1. Z-5. R2. Q$ F100.|G84 X1. Z-5. R2. F$ S$|G76 X1. Z-5. R2. Q$|G4 P$|G4 X$|G54 P$|G54.1 P$
G54.2 P$|G54.4 P$|G51.1 X$|G51 X0 Y0 P$|G51 X0 Y0 I$ J$ K$|G68 X0 Y0 R$|G28 X$|G30 P$ X0|G31 X$ F$|G31 P$ X1.|G53 X$|G52 X$
G92 X$|G16;G0 X$ Y$|G5.1 Q$|G7.1 C$|G12.1;G1 X$ C$|G33 X$ F$|G95 S$ F$|G93 F$;G1 X1.|G96 S$ P$|G22 X$ Y$|T$ M6|S$ M3|T$|F$
H$|D$|O$|(A|A)|(())|%|G0 X1. X2.|G0 G1|G17 G18|G1 X1. ,R$|G1 X1. ,C$|G1 X1. ,A$|M3 M5|M0 M30|M98 P1|M99|@=$@|X@ Y-@
G0 X[@]|@=[[[[[[1]]]]]]|@=PRM[$]|@=AX[$]|G325|G65|G66|G67|X1.&|"x"|G0 x1. y2.|G 0 X 1 0 .|G01X1,2|?|N99999 G0|N0
N123456789|/0 G0|//G0|/10G0|G90.5|G54.25|G-0|G1.|G01.|G0.0|M06.|M--6""".replace("\n", "|").split("|")
BEFORE = [""] * 12 + """G43.4 H1|G41 D1;G1 X10. F100.|G68.2 X0 Y0 Z0 I10. J10. K0;G53.1|G54.2 P1
G68.2 X0 Y0 Z0 I10. J10. K0|G81 X1. Y1. Z-5. R2. F100.|G16|G51 X0 Y0 P2000|G68 X0 Y0 R30.|G91|G20|G95 S100|G93|G18|G12.1
G41 D1|G66 P1 A1.|G2|G43 H1|G49;G10 L50|M128|G54.4 P1|G96 S10|G7.1 C50.|G51.1 X0|G90 G0|G22""".replace("\n", "|").split("|")


def random_block(rng):
    if rng.random() < 0.55:
        text = rng.choice(STATEMENTS).replace(";", "\n")
        while "$" in text:
            text = text.replace("$", rng.choice(VALUES[:PLAIN] if rng.random() < 0.7 else VALUES), 1)
        return text.replace("@", "#" + rng.choice(NUMBERS))
    words = ["G" + rng.choice(G_CODES) for _ in range(rng.choice([0, 1, 1, 1, 2]))]
    if rng.random() < 0.25:
        words.append("M" + rng.choice(M_CODES))
    words += [rng.choice(LETTERS) + rng.choice(VALUES) for _ in range(rng.choice([0, 1, 2, 3, 4]))]
    return " ".join(words) or rng.choice(LETTERS) + rng.choice(VALUES)


def random_program(rng, number):
    before, block = rng.choice(BEFORE).replace(";", "\n"), random_block(rng)
    more = random_block(rng) if rng.random() < 0.15 else ""
    lines = ["%", f"O{number:04d}", "G21 G90 G54 G17 G94 G40", "T1", "#100=7", before, more, block, "M30", "%"]
    return "\n".join(line for line in lines if line) + "\n"


def refused_by_check(program, paths):
    """Paths in which check finds an error."""
    refused = set()
    for k in range(0, len(paths), 1000):
        done = subprocess.run([program, "check", "--json", *paths[k:k + 1000]], capture_output=True, text=True)
        if done.returncode not in (0, 1):
            sys.exit(f"refused_blocks: check ends with {done.returncode}: {done.stderr[-300:]}")
        refused |= {f["path"] for f in json.loads(done.stdout)["findings"] if f["severity"] == "error"}
    return refused


def run(program, path):
    """Exit code and alarm of a run; code 99 where it does not end."""
    try:
        done = subprocess.run([program, "run", path, "--max-blocks", "2000", "--max-seconds", "5", "--json"],
                              capture_output=True, text=True, timeout=20)
    except subprocess.TimeoutExpired:
        return 99, None
    if "nan" in done.stdout.lower():
        return 98, None
    return done.returncode, json.loads(done.stdout)["alarm"] if done.returncode == 3 else None


def kind_of(alarm):
    if "#" in alarm["block"]:
        return "a variable in the block"
    return {"78": "a sequence number that is not there (M99 P, GOTO)", "9": "an axis that the machine has not"}.get(
        str(alarm["number"]), "others")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("--programs", type=int, default=20000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sample", type=int, default=400, help="refused programs that are run all the same")
    parser.add_argument("--show", action="store_true", help="print what only a run refuses")
    options = parser.parse_args()
    program, rng = os.path.abspath(options.program), random.Random(options.seed)
    if not os.access(program, os.X_OK) or options.programs < 1:
        parser.error(f"no program at {options.program}" if options.programs > 0 else "--programs must be 1 or more")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        paths = []
        for k in range(options.programs):
            # A folder each: a call must not find another program.
            os.mkdir(f"{folder}/{k}")
            paths.append(f"{folder}/{k}/p.nc")
            with open(paths[-1], "w") as file:
                file.write(random_program(rng, k % 9999 + 1))
        refused = refused_by_check(program, paths)
        rest = [p for p in paths if p not in refused]
        sample = rng.sample(sorted(refused), min(options.sample, len(refused)))
        ends = list(pool.map(lambda p: run(program, p), rest))
        passed = [p for p, (code, _) in zip(sample, pool.map(lambda p: run(program, p), sample)) if code == 0]
        odd = [(p, code) for p, (code, _) in zip(rest, ends) if code not in (0, 3, 4)]
        kinds = Counter(kind_of(alarm) for _, alarm in ends if alarm)
        if options.show:
            for path, (_, alarm) in zip(rest, ends):
                if alarm:
                    print(f"{alarm['number']}: {alarm['block']} ({alarm['text']})")
        for path, code in odd:
            print(f"ends with {code}:\n{open(path).read()}")
    share = 100 * sum(kinds.values()) / options.programs
    print(f"{options.programs} programs, seed {options.seed}: check refuses {len(refused)}; of the rest a run refuses "
          f"{sum(kinds.values())} ({share:.1f} %)")
    for kind, count in kinds.most_common():
        print(f"  {count} with {kind}")
    print(f"of {len(sample)} that check refuses a run passes {len(passed)}")
    sys.exit(1 if odd else 0)


if __name__ == "__main__":
    main()
