#!/usr/bin/python3
"""Is the sigma that identify prints honest? Asked of many random machines.

    campaign.py run --machines 5000 --out all.csv
    campaign.py run --machines 5000 --shard 3/50 --out part-3.csv
    campaign.py merge part-*.csv --out all.csv
    campaign.py show all.csv

Machine k has its own random location errors and its own noise, whatever the shard, so the
merged parts are byte for byte the file of one process. On Slurm:

    #SBATCH --array=1-50
    python3 campaign.py run --machines 5000 --shard $SLURM_ARRAY_TASK_ID/50 \\
        --out part-$SLURM_ARRAY_TASK_ID.csv
"""
import argparse
import concurrent.futures
import math
import os
import random

import trunnion

SPREAD = {"mm": 0.02, "rad": 1e-4}  # one sigma of the random errors


def poses(setup):
    """Positions to measure at: those of the shipped program O8002, which finds a sphere."""
    return setup.run("O8002").readings


def random_errors(setup, base, number):
    """One draw of the location errors that the base identification names."""
    draw = random.Random(number)
    return {
        p["name"]: draw.gauss(0.0, SPREAD[p["unit"]])
        for p in base.parameters
        if p["effect"] == "location"
    }


def one_machine(setup, readings, base, number):
    """A line of the result: the number, then (found - true) / sigma of each error."""
    true = random_errors(setup, base, number)
    machine = setup.with_effect("location", **true)
    measured = machine.predict(readings, noise_seed=number).readings
    found = {p["name"]: p for p in setup.identify(measured, ["location"]).parameters}
    pulls = []
    for name, value in true.items():
        sigma = found[name]["sigma"]
        pulls.append(repr((found[name]["value"] - value) / sigma) if sigma else "")
    return ",".join([str(number), *pulls])


def run(options):
    index, count = map(int, options.shard.split("/"))
    setup = trunnion.Setup(options.setup)
    readings = poses(setup)
    base = setup.identify(readings, ["location"])
    numbers = range(index, options.machines + 1, count)
    with concurrent.futures.ThreadPoolExecutor(options.threads) as pool:
        lines = list(pool.map(lambda k: one_machine(setup, readings, base, k), numbers))
    names = list(random_errors(setup, base, 1))
    head = [f"# machines = {options.machines}", ",".join(["machine", *names])]
    write(options.out, [*head, *lines])


def write(path, lines):
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read().splitlines()


def merge(options):
    tables = [read(path) for path in options.parts]
    head = tables[0][:2]
    if any(table[:2] != head for table in tables):
        raise SystemExit("campaign.py: these are parts of different campaigns")
    lines = sorted((line for table in tables for line in table[2:]), key=number_of)
    if [number_of(line) for line in lines] != list(range(1, int(head[0].split()[-1]) + 1)):
        raise SystemExit("campaign.py: a part is missing or given twice")
    write(options.out, [*head, *lines])


def number_of(line):
    return int(line.split(",")[0])


def show(options):
    """An honest sigma gives a root mean square of 1 within its own scatter."""
    _, head, *lines = read(options.table)
    print(f"{len(lines)} machines: rms of (found - true) / sigma")
    for j, name in enumerate(head.split(",")[1:], start=1):
        cells = [line.split(",")[j] for line in lines]
        pulls = [float(cell) for cell in cells if cell]
        if not pulls:
            print(f"  {name:8} not observable from these readings")
            continue
        rms = math.sqrt(sum(p * p for p in pulls) / len(pulls))
        print(f"  {name:8} {rms:.3f} (expected 1 +- {1 / math.sqrt(2 * len(pulls)):.3f})")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words = parser.add_subparsers(required=True)
    word = words.add_parser("run")
    word.add_argument("--machines", type=int, default=5000)
    word.add_argument("--shard", default="1/1")
    word.add_argument("--setup", default="")
    word.add_argument("--threads", type=int, default=os.cpu_count())
    word.add_argument("--out", required=True)
    word.set_defaults(do=run)
    word = words.add_parser("merge")
    word.add_argument("parts", nargs="+")
    word.add_argument("--out", required=True)
    word.set_defaults(do=merge)
    word = words.add_parser("show")
    word.add_argument("table")
    word.set_defaults(do=show)
    options = parser.parse_args()
    options.do(options)


if __name__ == "__main__":
    main()
