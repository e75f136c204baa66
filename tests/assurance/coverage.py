#!/usr/bin/env python3
"""Branches taken at least once, by room, from the counters that a build of preset `coverage` left.

    coverage.py BUILD [--out FILE] [--list ROOM...]

Counted are the branches of lines that decide something. A call that may throw has two branches for
gcov: neither that of the exception (gcov marks it) nor its other half counts; nor do branches of
the compiler on a line without a decision (the first of a function, a static value). --list: the
lines of these rooms with branches not taken.
"""
import argparse
import collections
import gzip
import json
import pathlib
import re
import subprocess
import tempfile

DECISION = re.compile(r"\b(if|for|while|switch)\b|\?|&&|\|\|| (<|>|<=|>=|==|!=) ")

def decisions(branches):
    """Index and count of each branch that a decision of the program takes."""
    of_calls = set()
    for k, branch in enumerate(branches):
        if branch["throw"]:
            before = k > 0 and k - 1 not in of_calls and branches[k - 1]["fallthrough"]
            of_calls |= {k, k - 1 if before else k + 1}
    return [(k, branch["count"]) for k, branch in enumerate(branches) if k not in of_calls]


def rooms_of(build, root):
    taken = collections.defaultdict(dict)
    with tempfile.TemporaryDirectory() as folder:
        for counters in build.rglob("trunnion_*.dir/**/*.gcda"):
            subprocess.run(["gcov", "-b", "-j", str(counters)], cwd=folder, capture_output=True, check=False)
            for report in pathlib.Path(folder).glob("*.gcov.json.gz"):
                for file in json.loads(gzip.open(report).read())["files"]:
                    path = pathlib.Path(file["file"])
                    if not path.is_relative_to(root) or path.suffix != ".cpp":
                        continue
                    room = str(path.relative_to(root).parent)
                    text = path.read_text().splitlines()
                    for line in file["lines"]:
                        if not DECISION.search(text[line["line_number"] - 1]):
                            continue
                        for k, count in decisions(line["branches"]):
                            key = (path.name, line["line_number"], k)
                            taken[room][key] = taken[room].get(key, 0) + count
                report.unlink()
    return taken


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--list", nargs="*", default=[], metavar="ROOM")
    options = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    taken = rooms_of(options.build.resolve(), root)
    result = [{"room": room, "branches": len(counts), "taken": sum(c > 0 for c in counts.values())}
              for room, counts in sorted(taken.items())]
    for row in result:
        print(f"{row['room']:16} {row['taken']:6} of {row['branches']:6} {100 * row['taken'] / row['branches']:5.1f} %")
    for room in options.list:
        missed = collections.Counter((file, line) for (file, line, _), count in taken[room].items() if count == 0)
        for (file, line), branches in sorted(missed.items()):
            text = (root / room / file).read_text().splitlines()[line - 1].strip()
            print(f"{branches:3} {room}/{file}:{line}: {text}")
    if options.out:
        options.out.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
