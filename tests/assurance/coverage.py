#!/usr/bin/env python3
"""Branches taken at least once, by room, from the counters that a build of preset `coverage` left.

    coverage.py BUILD [--out FILE]

Branches that only an exception takes do not count (gcov marks them).
"""
import argparse
import collections
import gzip
import json
import pathlib
import subprocess
import tempfile


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
                    for line in file["lines"]:
                        for k, branch in enumerate(line["branches"]):
                            if branch["throw"]:
                                continue
                            key = (path.name, line["line_number"], k)
                            taken[room][key] = taken[room].get(key, 0) + branch["count"]
                report.unlink()
    return taken


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    result = [{"room": room, "branches": len(counts), "taken": sum(c > 0 for c in counts.values())}
              for room, counts in sorted(rooms_of(options.build.resolve(), root).items())]
    for row in result:
        print(f"{row['room']:16} {row['taken']:6} of {row['branches']:6} {100 * row['taken'] / row['branches']:5.1f} %")
    if options.out:
        options.out.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
