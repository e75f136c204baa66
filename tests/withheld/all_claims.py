"""Every claim, free forms included, against the truth: how often right at which stated probability.

A claim is right when the machine has that error:
- a named effect: it is one of the true effects, or part of the smooth forms (X.straightness, X.scale, XY.squareness);
- a free form ("form": "table"): the forms hold an error of this axis and family, or a true effect is one
  (X.scale and X.cyclic are X.positioning);
- "free form of X": the forms hold any error of the axis, or a true effect is one of its positioning, straightness,
  angular, radial, axial, tilt.
Of the forms counts what does LEAST sigma rms on the readings beside location and set-up (`forms` of the truth). That
the readings cannot tell a false claim from the truth is no excuse: then its probability must say so. `unknown` is
not counted.
"""
from statistics_table import rate

LEAST = 0.7
LIMITS = ((0.5, 0.8), (0.8, 0.95), (0.95, 1.01))
FAMILIES = ("positioning", "straightness", "angular", "radial", "axial", "tilt")
FAMILY_OF = {"scale": "positioning", "cyclic": "positioning"}
MERGED = "free form of "


def family(effect):
    """(axis, family) of an effect's free form; the kind itself where it has none."""
    axis, _, kind = effect.partition(".")
    return axis, FAMILY_OF.get(kind, kind)


def is_right(claim, free, truth, forms):
    """claim: name; free: it is a free form; truth: true effects; forms: name -> sigma."""
    present = {name for name, size in forms.items() if size >= LEAST}
    if claim.startswith(MERGED):
        errors = {family(name) for name in [*truth, *present]}
        return any(axis == claim[len(MERGED):] and kind in FAMILIES for axis, kind in errors)
    if claim in truth or claim in present:
        return True
    return free and family(claim) in {family(name) for name in truth}


def claims_of(records):
    """One record for each claim with a probability."""
    return [{"seed": r["seed"], "name": r["name"], "kind": r["kind"], "claim": claim, "free": free, "truth": r["truth"],
             "rivals": rivals, "probability": p, "right": is_right(claim, free, r["truth"], r["forms"])}
            for r in records if r["kind"] not in ("outsider", "foreign")
            for claim, free, rivals, p in zip(r["claimed"], r["free"], r["rivals"], r["probabilities"])
            if claim != "unknown" and p is not None]


def score_claims(table, records):
    """All claims by stated probability, with and without smooth forms."""
    claims = claims_of(records)
    for key, text, some in (("claims", "", [c for c in claims if c["kind"] != "form"]),
                            ("form_claims", " beside form errors", [c for c in claims if c["kind"] == "form"])):
        if not some:
            continue
        table.head(f"every claim{text}: stated, and how often right")
        for low, high in LIMITS:
            stated = [c for c in some if low <= c["probability"] < high]
            name, asked = f"  stated {low:g} to {min(high, 1):g}", "reach 95 %" if low == 0.95 else ""
            table.rate(f"{key}.{low:g}", name, stated, lambda c: c["right"], asked)
            for form, free in (("named", False), ("free form", True)):
                table.rate(f"{key}.{low:g}.{form}", f"    {form}", [c for c in stated if c["free"] == free],
                           lambda c: c["right"])


def false_claims(records):
    """The false ones from 0.95, one line each."""
    return [f"  {c['probability']:.3f} {c['seed']}/{c['name']}: {c['claim']}{' (table)' if c['free'] else ''}"
            f"{' rivals ' + '|'.join(c['rivals']) if c['rivals'] else ''}   truth: {' '.join(c['truth'])}"
            for c in claims_of(records) if c["probability"] >= 0.95 and not c["right"]]
