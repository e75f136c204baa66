#!/usr/bin/env python3
"""Mutation score of rooms: changes one thing in one line, builds the room's tests, runs them (with
those of tests/nc where these hold what the room does). A mutant that they leave alive is given to
the tests of the rooms that use it and to those of the program (BESIDE).

    mutate.py BUILD ROOM... [--mutants 20] [--seed 1] [--named FILE] [--minutes N] [--longest S] [--out FILE]

A mutant is killed when its tests fail or take four times as long; "beside" is one that only the tests of
BESIDE kill. One that does not compile counts as nothing. Survivors are printed with file, line and change.
FILE holds mutants to be tried besides those drawn (JSON: file, text, instead). After N minutes a room is
left with the mutants judged by then. Cases that take longer than S seconds are not run; those below half a
second are run first. The source is changed in place and always put back; run it in a clone of its own.
"""
import argparse
import json
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

# What is looked for, and what stands in its place. Each is one plausible slip of a programmer.
CHANGES = [(r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "), (r" == ", " != "),
           (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "), (r" \+ ", " - "), (r" - ", " + "),
           (r" \* ", " / "), (r" / ", " * "), (r" \+= ", " -= "), (r" -= ", " += "), (r"\btrue\b", "false"),
           (r"\bfalse\b", "true"), (r"\(!", "("), (r"\bstd::min\b", "std::max"), (r"\bstd::max\b", "std::min"),
           (r"\bstd::cos\b", "std::sin"), (r"\bstd::sin\b", "std::cos"), (r"\b0\.5\b", "0.25"),
           (r"\breturn false;", "return true;"), (r"\bcontinue;", "break;")]
# Rooms whose behaviour the NC programs of tests/nc hold, besides their own tests.
WITH_NC = {"interpreter", "offsets", "positioning", "controller"}
# Whose tests see what the tests of a room leave alive.
BESIDE = {"base": ["cli", "faults"], "geometry": ["kinematics", "positioning", "regression"],
          "interpreter": ["controller", "check"], "offsets": ["controller", "positioning", "setup"],
          "kinematics": ["positioning", "emulator"], "positioning": ["controller", "emulator"],
          "controller": ["emulator", "check"], "estimation": ["identification", "diagnosis"],
          "identification": ["diagnosis", "cli"], "diagnosis": ["cli"], "regression": ["cli"]}
QUICK_S = 0.5
MEMORY_BYTES = 8 << 30  # a mutant that takes more ends
PASSED_OVER = re.compile(r"^\s*(//|#|template|using|static_assert|raise_|throw|case )|fmt::|\"")


def candidates(root, room):
    for path in sorted((root / room).glob("*.cpp")):
        for number, line in enumerate(path.read_text().splitlines()):
            if PASSED_OVER.search(line):
                continue
            for pattern, instead in CHANGES:
                for match in re.finditer(pattern, line.split("//")[0]):
                    yield path, number, match.span(), instead


def named(root, room, file):
    """Mutants of a room that somebody asked for; an error when a text does not stand in just one place."""
    for wish in json.loads(file.read_text()) if file else []:
        if pathlib.PurePath(wish["file"]).parent != pathlib.PurePath(room):
            continue
        path = root / wish["file"]
        places = [(number, line.find(wish["text"]))
                  for number, line in enumerate(path.read_text().splitlines()) if wish["text"] in line]
        if len(places) != 1:
            sys.exit(f"mutate: {wish['text']!r} stands in {len(places)} lines of {wish['file']}")
        number, begin = places[0]
        yield path, number, (begin, begin + len(wish["text"])), wish["instead"]


def run(command, limit):
    try:
        return subprocess.run(command, capture_output=True, timeout=limit).returncode
    except subprocess.TimeoutExpired:
        return -1


def tests_of(room):
    return [f"test_{room}"] + (["test_nc"] if room in WITH_NC else [])


def builds(build, tests):
    return run(["cmake", "--build", str(build), "--target", *tests], 3600) == 0


def plain_run(build, what, tests, longest_s, folder):
    """What is run for each mutant: (command, seconds it takes), the quick cases first."""
    runs, left_out = [], []
    for test in tests:
        program = str(build / "bin" / test)
        report = folder / f"{test}.xml"
        if run([program, "-r", "xml", "-d", "yes", "-o", str(report)], 3600) != 0:
            sys.exit(f"mutate: {test} fails before anything is changed")
        cases = [(float(case.find("OverallResult").get("durationInSeconds")), case.get("name"))
                 for case in xml.etree.ElementTree.parse(report).iter("TestCase")]
        left_out += [case for case in cases if case[0] > longest_s]
        for name, low_s, high_s in (("quick", 0, QUICK_S), ("slow", QUICK_S, longest_s)):
            group = [case for case in cases if low_s <= case[0] < high_s]
            names = folder / f"{test}.{name}"
            # In a list of names Catch reads a comma as the end of one, and # as a remark.
            escaped = [case.replace(",", "\\,") for _, case in group]
            names.write_text("".join(f'"{case}"\n' for case in escaped))
            if not group:
                continue
            found = subprocess.run([program, "--list-test-names-only", "-f", str(names)],
                                   capture_output=True, text=True).stdout.splitlines()
            if len(found) != len(group):
                sys.exit(f"mutate: {test} finds {len(found)} of {len(group)} cases by their names")
            runs.append((name, [program, "--abort", "-f", str(names)], sum(s for s, _ in group)))
    runs.sort(key=lambda each: each[0] != "quick")
    print(f"{what}: {sum(s for _, _, s in runs):.1f} s, not run: {left_out}", flush=True)
    return [(command, seconds) for _, command, seconds in runs]


def tests_beside(room):
    return ["trunnion"] + [f"test_{beside}" for beside in BESIDE.get(room, [])]


def lives(runs):
    return all(run(command, 4 * seconds + 10) == 0 for command, seconds in runs)


def judge(build, room, mutant, runs, runs_beside):
    path, number, (begin, end), instead = mutant
    before = path.read_text()
    lines = before.splitlines(keepends=True)
    line = lines[number]
    lines[number] = line[:begin] + instead + line[end:]
    try:
        path.write_text("".join(lines))
        if not builds(build, tests_of(room)):
            return "no build", lines[number].strip()
        if not lives(runs):
            return "killed", lines[number].strip()
        if not builds(build, tests_beside(room)):
            return "no build", lines[number].strip()
        return ("survived" if lives(runs_beside) else "beside"), lines[number].strip()
    finally:
        path.write_text(before)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("rooms", nargs="+")
    parser.add_argument("--mutants", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--named", type=pathlib.Path)
    parser.add_argument("--minutes", type=float, default=600)
    parser.add_argument("--longest", type=float, default=3600)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    result = []
    for room in options.rooms:
        random.seed(f"{options.seed} {room}")
        every = list(candidates(root, room))
        chosen = list(named(root, room, options.named))
        chosen += random.sample(every, min(options.mutants, len(every)))
        if not builds(options.build, tests_of(room) + tests_beside(room)):
            sys.exit(f"mutate: the tests of {room} do not build")
        survivors, count = [], {"killed": 0, "beside": 0, "survived": 0, "no build": 0}
        with tempfile.TemporaryDirectory() as folder:
            runs = plain_run(options.build, room, tests_of(room), options.longest, pathlib.Path(folder))
            runs_beside = plain_run(options.build, "beside", tests_beside(room)[1:], options.longest,
                                    pathlib.Path(folder))
            start = time.monotonic()
            for mutant in chosen:
                if time.monotonic() - start > 60 * options.minutes:
                    break
                verdict, text = judge(options.build, room, mutant, runs, runs_beside)
                count[verdict] += 1
                place = f"{mutant[0].relative_to(root)}:{mutant[1] + 1}"
                print(f"{verdict:8} {place}: {text}", flush=True)
                if verdict == "survived":
                    survivors.append(f"{place}: {text}")
        builds(options.build, tests_of(room) + tests_beside(room))
        result.append({"room": room, "candidates": len(every), "killed": count["killed"],
                       "beside": count["beside"], "survivors": survivors})
        print(f"{room}: {count}", flush=True)
    if options.out:
        options.out.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
