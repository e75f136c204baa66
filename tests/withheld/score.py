#!/usr/bin/env python3
"""Opens the truth after all verdicts are written and prints the score table (text, and JSON with --json FILE).

score.py FOLDER...: each folder (one seed) holds sets/, truth/ and results/ with NAME.json (diagnose --json) and
NAME.csv (predict on holdout.csv); a folder of such folders is accepted too.
"""
import argparse
import csv
import json
import math
import os
import sys

from all_claims import false_claims, is_right, score_claims
from statistics_table import median_line, middle, rate, rate_line

SIZES = ((0.0, 2.0), (2.0, 3.0), (3.0, 4.5), (4.5, 99.0))
ADMITTED = ("unexplained", "partly-explained")


def seed_folders(paths):
    """Folders that hold a truth, directly or one level below."""
    out = []
    for path in paths:
        inside = [path] + [os.path.join(path, name) for name in sorted(os.listdir(path))]
        out += [p for p in inside if os.path.isdir(os.path.join(p, "truth"))]
    return out


def read_predictions(path, count):
    """value_mm in row order, or None."""
    try:
        with open(path, newline="") as handle:
            table = list(csv.DictReader(line for line in handle if not line.startswith("#")))
        values = [float(row["value_mm"]) if row["value_mm"] else math.nan for row in table]
        return values if len(values) == count else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def rms_um(first, second, sigma):
    """rms difference over rows with a sigma; None if a prediction is missing."""
    squares = [(a - b) ** 2 for a, b, s in zip(first, second, sigma) if s > 0]
    total = math.fsum(squares) / len(squares)
    return 1e3 * math.sqrt(total) if math.isfinite(total) else None


def number(value):
    """A finite float or None."""
    return float(value) if isinstance(value, (int, float)) and math.isfinite(value) else None


def read_verdict(path):
    """The JSON object, or {} where there is none."""
    try:
        with open(path) as handle:
            found = json.load(handle)
        return found if isinstance(found, dict) else {}
    except (OSError, ValueError):
        return {}


def load(folder):
    """Records of one seed: truth and verdict side by side."""
    records = []
    for file in sorted(os.listdir(os.path.join(folder, "truth"))):
        if not file.endswith(".json"):
            continue
        with open(os.path.join(folder, "truth", file)) as handle:
            truth = json.load(handle)
        name = truth["name"]
        verdict = read_verdict(os.path.join(folder, "results", name + ".json"))
        values = read_predictions(os.path.join(folder, "results", name + ".csv"), len(truth["sigma"]))
        records.append(judge(os.path.basename(os.path.normpath(folder)), truth, verdict, values))
    return records


def judge(seed, truth, verdict, values):
    """One record."""
    causes = [c for c in verdict.get("causes", []) if isinstance(c, dict)]
    claimed = [str(c.get("effect")) for c in causes]
    free = [c.get("form") == "table" for c in causes]
    rivals = [[str(r) for r in c.get("rivals") or []] for c in causes]
    after = verdict.get("after") or {}
    record = {"seed": seed, "name": truth["name"], "kind": truth["kind"], "noise": truth["noise_case"],
              "around": truth.get("around", ""), "between": after.get("between_places"),
              "explained": number(after.get("explained")), "measured_explained": None,
              "machine": truth["machine"], "devices": "+".join(truth["devices"]),
              "truth": [e for e in truth["effects"] if e != "none"], "sizes": truth["size_sigma"],
              "size": min(truth["size_sigma"], default=0.0), "readings": truth["readings"],
              "equivalents": [[n for n, r in e.items() if r["cannot_tell"]] for e in truth["rivals"]],
              "alike": [[n for n, r in e.items() if r["share"] >= 0.95] for e in truth["rivals"]],
              "verdict": verdict.get("verdict"), "noise_source": verdict.get("noise_source"),
              "claimed": claimed, "free": free, "rivals": rivals, "p_value": number((verdict.get("gap") or {}).get("p_value")),
              "probability": number(causes[0].get("probability")) if causes else None,
              "probabilities": [number(c.get("probability")) for c in causes], "forms": truth.get("forms", {}),
              "oracle_shrink": truth["oracle_shrink"], "claimed_shrink": number(after.get("heldout_shrink")),
              "ci95": after.get("ci95"), "measured_shrink": None, "z_after": None}
    if values is not None and truth["base_excess_um"] > 0:
        left = rms_um(values, truth["holdout_clean"], truth["sigma"])
        if left is not None:
            record["measured_shrink"] = 1.0 - left / truth["base_excess_um"]
            z = [((a - b) / s) ** 2 for a, b, s in zip(values, truth["holdout"], truth["sigma"]) if s > 0]
            record["z_after"] = math.sqrt(math.fsum(z) / len(z))
            excess = truth["base_holdout_z_rms"] ** 2 - 1.0
            if excess > 0 and sum(s > 0 for s in truth["sigma"]) >= 100:
                record["measured_explained"] = (truth["base_holdout_z_rms"] ** 2 - record["z_after"] ** 2) / excess
            record["z_before"] = truth["base_holdout_z_rms"]
    return record


# --- judgements --------------------------------------------------------------------------------------
def silent(r):
    """Nothing claimed on a null set."""
    return r["verdict"] == "no-gap" and not r["claimed"]


def first(r):
    """The one true effect is the first claim."""
    return r["claimed"][:1] == r["truth"]


def first_or_rival(r):
    """... or stands among the rivals of the first claim."""
    return first(r) or bool(r["rivals"] and r["truth"][0] in r["rivals"][0])


def first_or_equivalent(r):
    """... or nothing in these readings tells the first claim from the truth (chi-square below 20)."""
    return first(r) or bool(r["claimed"] and r["claimed"][0] in r["equivalents"][0])


def first_or_alike(r):
    """... or the first claim reproduces at least 0.95 of the truth's visible signature."""
    return first_or_equivalent(r) or bool(r["claimed"] and r["claimed"][0] in r["alike"][0])


def covered(r):
    """All true effects are claimed."""
    return set(r["truth"]) <= set(r["claimed"])


def covered_or_rival(r):
    """All true effects are claimed or a rival of a claim."""
    return set(r["truth"]) <= set(r["claimed"]) | {x for rivals in r["rivals"] for x in rivals}


def admitted(r):
    """The diagnosis says that it cannot explain (all of) the gap, or names an error in free form instead of a fault."""
    return r["verdict"] in ADMITTED or "unknown" in r["claimed"] or any(r["free"])


def not_fooled(r):
    """The same, or the verdict is at least not `explained`, or a jump of the machine is among the rivals of the first."""
    return admitted(r) or r["verdict"] == "ambiguous" or any("machine.jump" in x for x in r["rivals"][:1])


def shrink_ratio(r):
    """Measured shrink over the oracle's."""
    return None if r["measured_shrink"] is None or r["oracle_shrink"] <= 0.02 else \
        r["measured_shrink"] / r["oracle_shrink"]


def shrink_error(r):
    """|claimed - measured|."""
    if r["claimed_shrink"] is None or r["measured_shrink"] is None:
        return None
    return abs(r["claimed_shrink"] - r["measured_shrink"])


def explained_error(r):
    """|after.explained - the part of the excess square that is gone on the withheld readings|, for gaps of three
    times the noise."""
    if r["explained"] is None or r["measured_explained"] is None or r.get("z_before", 0.0) ** 2 - 1.0 < 9.0:
        return None
    return abs(r["explained"] - min(1.0, max(0.0, r["measured_explained"])))


def in_interval(r):
    """The measured shrink lies in the claimed interval."""
    ends = r["ci95"]
    return isinstance(ends, list) and len(ends) == 2 and None not in ends and r["measured_shrink"] is not None \
        and ends[0] <= r["measured_shrink"] <= ends[1]


class Table:
    """Lines of text and the same figures as JSON."""

    def __init__(self):
        self.lines, self.figures = [], {}

    def head(self, text):
        self.lines += ["", text]

    def rate(self, key, label, records, predicate, target=""):
        self.figures[key] = rate(records, predicate)
        self.lines.append(rate_line("  " + label, self.figures[key], target))

    def median(self, key, label, records, value, target=""):
        self.figures[key] = middle(records, value)
        self.lines.append(median_line("  " + label, self.figures[key], target))


def score_nulls(table, records):
    """Silence by noise case."""
    table.head("null sets: silent (no-gap, nothing claimed)")
    nulls = [r for r in records if r["kind"] == "null"]
    quiet = [r for r in nulls if r["noise"] != "wrong"]
    table.rate("null.right_or_repeats", "right noise, or repeats", quiet, silent, "reach 98 %")
    for around in sorted({r["around"] for r in nulls if r["around"]}):
        table.rate(f"null.{around}", f"  with {around}", [r for r in nulls if r["around"] == around], silent)
    for noise in ("right", "repeats", "correlated-repeats", "wrong"):
        table.rate(f"null.{noise}", f"  noise: {noise}", [r for r in nulls if r["noise"] == noise], silent)
    wrong = [r for r in records if r["noise"] == "wrong"]
    table.rate("null.wrong_says_assumed", "wrong noise, no repeats: noise_source is assumed", wrong,
               lambda r: r["noise_source"] == "assumed")


def score_singles(table, records):
    """First claim, overall, by size and by effect."""
    singles = [r for r in records if r["kind"] == "single"]
    table.head("one effect")
    table.rate("single.first", "claimed first", singles, first, "reach 95 %")
    table.rate("single.first_or_rival", "first, or rival of the first", singles, first_or_rival, "reach 98 %")
    table.rate("single.anywhere", "claimed or rival anywhere", singles, covered_or_rival)
    table.rate("single.first_or_equivalent", "first, or one that no reading tells from it", singles,
               first_or_equivalent)
    table.rate("single.first_or_alike", "first, or one that reproduces 0.95 of it", singles, first_or_alike)
    alone = [r for r in singles if not r["equivalents"][0]]
    table.rate("single.first_without_equivalent", "first, where the readings decide", alone, first)
    table.rate("single.missed", "missed (no-gap)", singles, lambda r: r["verdict"] == "no-gap")
    table.rate("single.only", "nothing else claimed beside it", [r for r in singles if first(r)],
               lambda r: len(r["claimed"]) == 1)
    table.median("single.rivals", "rivals named beside the first (median)", [r for r in singles if r["claimed"]],
                 lambda r: float(len(r["rivals"][0])))
    for low, high in SIZES:
        some = [r for r in singles if low <= r["size"] < high]
        name = f"{low:g} to {high:g} sigma" if high < 50 else f"{low:g} sigma and more"
        table.rate(f"single.first.{low:g}", f"  first at {name}", some, first)
        table.rate(f"single.first_or_rival.{low:g}", f"  first or rival at {name}", some, first_or_rival)
    for key in ("machine", "devices", "noise", "around"):
        for value in sorted({r[key] for r in singles if r[key]}):
            table.rate(f"single.first.{value}", f"  first, {key} {value}", [r for r in singles if r[key] == value], first)
    outliers = [r for r in records if r["kind"] == "outliers"]
    table.rate("outliers.first_or_rival", "with 2 % outliers of 5 um: first or rival", outliers, first_or_rival)


def score_others(table, records):
    """Two or three effects, outsiders, foreign forms."""
    multi = [r for r in records if r["kind"] == "multi"]
    table.head("two or three effects")
    table.rate("multi.all", "all claimed", multi, covered, "reach 90 %")
    table.rate("multi.all_or_rival", "all claimed or rival", multi, covered_or_rival)
    table.rate("multi.nothing_else", "nothing else claimed", multi, lambda r: set(r["claimed"]) <= set(r["truth"]))
    for count in (2, 3):
        table.rate(f"multi.all.{count}", f"  all claimed, {count} effects", [r for r in multi if len(r["truth"]) == count],
                   covered)
    outsiders = [r for r in records if r["kind"] == "outsider"]
    table.head("outside any catalogue")
    table.rate("outsider.admitted", "admitted (unexplained, partly, unknown)", outsiders, admitted, "reach 95 %")
    table.rate("outsider.not_fooled", "  the same, or not `explained`, or a jump named", outsiders, not_fooled, "reach 92 %")
    table.rate("outsider.missed", "missed (no-gap)", outsiders, lambda r: r["verdict"] == "no-gap")
    for low, high in SIZES:
        table.rate(f"outsider.admitted.{low:g}", f"  admitted from {low:g} sigma",
                   [r for r in outsiders if low <= r["size"] < high], admitted)
    foreign = [r for r in records if r["kind"] == "foreign"]
    table.head("known families in a form of their own")
    table.rate("foreign.family_or_admitted", "family first or rival, or admitted", foreign,
               lambda r: first_or_rival(r) or admitted(r))
    table.rate("foreign.family", "  family first or rival", foreign, first_or_rival)


def score_form(table, records):
    """One effect beside smooth form errors on every axis."""
    form = [r for r in records if r["kind"] == "form"]
    if not form:
        return
    table.head("one effect beside smooth form errors of 0.7 to 12 sigma on every axis")
    table.rate("form.anywhere", "the effect is claimed, or rival", form, covered_or_rival, "reach 92 %")
    table.rate("form.first", "  claimed first, free forms apart", form, first_named)
    table.rate("form.first_but_true", "  the same, other errors that the machine has apart", form, first_but_true)
    table.median("form.z_after", "rms left on the withheld positions, in sigma", form, lambda r: r["z_after"])


def first_named(r):
    """The first claim that is no free form is the truth."""
    named = [c for c, free in zip(r["claimed"], r["free"]) if not free]
    return named[:1] == r["truth"]


def first_but_true(r):
    """The same, but what is part of the smooth forms (X.scale, Y.straightness) may be named before it, and a table
    of the effect's own name, which contains it, is the effect."""
    named = [c for c, free in zip(r["claimed"], r["free"])
             if c in r["truth"] or not (free or is_right(c, free, r["truth"], r["forms"]))]
    return named[:1] == r["truth"]


def score_shrink(table, records):
    """Held-out figures."""
    known = [r for r in records if r["kind"] in ("single", "multi", "outliers")]
    table.head("on the withheld positions")
    table.median("shrink.ratio", "shrink / the true effect's (one, two, three)", known, shrink_ratio, "reach 0.95")
    for low, high in SIZES:
        table.median(f"shrink.ratio.{low:g}", f"  from {low:g} sigma", [r for r in known if low <= r["size"] < high],
                     shrink_ratio)
    for kind in ("outsider", "foreign"):
        table.median(f"shrink.{kind}", f"  {kind}: shrink", [r for r in records if r["kind"] == kind],
                     lambda r: r["measured_shrink"])
    table.median("shrink.z_after", "rms left, in sigma (one, two, three)", known, lambda r: r["z_after"])
    table.median("shrink.null_z", "  the same on null sets", [r for r in records if r["kind"] == "null"],
                 lambda r: r["z_after"])
    large = [r for r in records if r["kind"] != "null" and r["size"] >= 3]
    table.median("shrink.claim_error", "|claimed - measured shrink| from 3 sigma", large, shrink_error, "reach 0.05")
    table.median("shrink.claim_error_known", "  the same, one, two or three effects",
                 [r for r in large if r in known], shrink_error)
    table.median("shrink.explained_error", "|after.explained - measured|, gaps from 3 times the noise", records,
                 explained_error, "reach 0.05")
    table.median("shrink.explained_error_form", "  the same beside form errors",
                 [r for r in records if r["kind"] == "form"], explained_error, "reach 0.05")
    table.median("shrink.explained_error_between", "  the same where it holds between the places",
                 [r for r in records if r["between"] is not False], explained_error, "reach 0.05")
    law = [r for r in records if r.get("z_before") and r["z_after"] is not None]
    table.rate("shrink.no_harm", "the written setup predicts no worse (2 % of the rms)", law,
               lambda r: r["z_after"] <= 1.02 * r["z_before"], "all")
    with_ends = [r for r in large if r["ci95"] and r["measured_shrink"] is not None]
    table.rate("shrink.ci95", "measured shrink inside ci95, from 3 sigma", with_ends, in_interval)


def score_calibration(table, records):
    """Stated probability against how often the first claim was right."""
    table.head("probability of the first claim: stated, and how often right (or equivalent)")
    stated = [r for r in records if r["kind"] == "single" and r["probability"] is not None]
    for low, high in ((0.0, 0.5), (0.5, 0.8), (0.8, 0.95), (0.95, 1.01)):
        table.rate(f"probability.{low:g}", f"  stated {low:g} to {min(high, 1):g}",
                   [r for r in stated if low <= r["probability"] < high], first_or_equivalent)


def mistakes(records):
    """What went wrong, set by set."""
    lines = []
    for r in records:
        right = {"null": silent, "single": first_or_rival, "outliers": first_or_rival, "multi": covered, "form": covered_or_rival,
                 "outsider": admitted, "foreign": lambda r: first_or_rival(r) or admitted(r)}[r["kind"]](r)
        if not right or (r["kind"] == "single" and not first(r)):
            mark = "wrong" if not right else "rival"
            sizes = ",".join(f"{s:.1f}" for s in r["sizes"])
            said = " ".join(f"{c}({'|'.join(v)})" if v else c for c, v in zip(r["claimed"], r["rivals"])) or "nothing"
            same = {x for e in r["equivalents"] for x in e}
            lines.append(f"  {mark} {r['seed']}/{r['name']} {r['machine']} {r['devices']} {r['kind']} {r['noise']}: "
                         f"{' '.join(r['truth']) or 'none'} ({sizes}) -> {r['verdict']}: {said}"
                         + (f"   undecidable here: {' '.join(sorted(same))}" if same else ""))
    return lines


def by_effect(records):
    """Single effects, one line each."""
    singles = [r for r in records if r["kind"] == "single"]
    lines = []
    for name in sorted({r["truth"][0] for r in singles}):
        some = [r for r in singles if r["truth"] == [name]]
        lines.append(f"  {name:<22} first {sum(map(first, some)):>3}/{len(some):<3} or rival "
                     f"{sum(map(first_or_rival, some)):>3}/{len(some):<3} or equivalent "
                     f"{sum(map(first_or_equivalent, some)):>3}/{len(some):<3}")
    return lines


def by_outsider(records):
    """Outsiders and foreign forms, one line each, with what was said of them."""
    lines = []
    for kind in ("outsider", "foreign"):
        some = [r for r in records if r["kind"] == kind]
        for name in sorted({r["truth"][0] for r in some}):
            mine = [r for r in some if r["truth"] == [name]]
            said = {}
            for r in mine:
                claim = r["claimed"][0] if r["claimed"] else str(r["verdict"])
                said[claim] = said.get(claim, 0) + 1
            text = ", ".join(f"{c} {n}" for c, n in sorted(said.items(), key=lambda item: -item[1]))
            lines.append(f"  {kind:<9}{name:<30} admitted {sum(map(admitted, mine)):>3}/{len(mine):<3} first said: {text}")
    return lines


def main(arguments=None):
    """Entry point."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--json", help="also write the figures and all records here")
    parser.add_argument("--brief", action="store_true", help="without the lists by effect and by set")
    options = parser.parse_args(arguments)
    records = [r for folder in seed_folders(options.folders) for r in load(folder)]
    if not records:
        sys.exit("score: no truth found")
    table = Table()
    table.lines.append(f"{len(records)} sets, {len({r['seed'] for r in records})} seeds; "
                       "rate, hits/count, Wilson 95 %, lowest and highest seed")
    table.rate("verdicts", "a verdict and predictions were given", records,
               lambda r: r["verdict"] is not None and r["measured_shrink"] is not None)
    for part in (score_nulls, score_singles, score_others, score_form, score_shrink, score_calibration, score_claims):
        part(table, records)
    if not options.brief:
        table.lines += ["", "single effects", *by_effect(records), "", "outsiders and foreign forms",
                        *by_outsider(records), "", "not as wished", *mistakes(records),
                        "", "false with 0.95 and more", *false_claims(records)]
    print("\n".join(table.lines))
    if options.json:
        with open(options.json, "w") as out:
            json.dump({"schema": "trunnion.blind/1", "figures": table.figures, "records": records}, out, indent=1)


if __name__ == "__main__":
    main()
