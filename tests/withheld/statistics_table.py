"""Counts, Wilson intervals, spread over seeds, and a plain text table."""
import math
from statistics import median


def wilson(hits, count, z=1.96):
    """95 % Wilson interval of a rate."""
    if count == 0:
        return (0.0, 1.0)
    rate, extra = hits / count, z * z / count
    middle = (rate + extra / 2) / (1 + extra)
    half = z * math.sqrt(rate * (1 - rate) / count + extra / (4 * count)) / (1 + extra)
    return (max(0.0, middle - half), min(1.0, middle + half))


def rate(records, predicate, seed_of=lambda r: r["seed"]):
    """Hits, count, Wilson interval and lowest and highest rate among the seeds."""
    by_seed = {}
    for record in records:
        by_seed.setdefault(seed_of(record), []).append(bool(predicate(record)))
    hits, count = sum(map(sum, by_seed.values())), len(records)
    rates = [sum(v) / len(v) for v in by_seed.values()]
    low, high = wilson(hits, count)
    return {"hits": hits, "count": count, "rate": hits / count if count else None, "wilson95": [low, high],
            "seeds": [min(rates), max(rates)] if rates else None}


def middle(records, value, seed_of=lambda r: r["seed"]):
    """Median over all records and the lowest and highest median among the seeds; None values are left out."""
    by_seed, everything = {}, []
    for record in records:
        number = value(record)
        if number is not None and math.isfinite(number):
            by_seed.setdefault(seed_of(record), []).append(number)
            everything.append(number)
    medians = [median(v) for v in by_seed.values()]
    return {"median": median(everything) if everything else None, "count": len(everything),
            "missing": len(records) - len(everything), "seeds": [min(medians), max(medians)] if medians else None}


def rate_line(label, result, target=""):
    """One row of the text table."""
    if not result["count"]:
        return f"{label:<52} {'-':>9}"
    low, high = result["wilson95"]
    spread = "" if result["seeds"] is None else f"  seeds {result['seeds'][0]:.2f}..{result['seeds'][1]:.2f}"
    return (f"{label:<52} {100 * result['rate']:6.1f} %  {result['hits']:>4}/{result['count']:<4} "
            f"[{100 * low:5.1f}, {100 * high:5.1f}]{spread}  {target}").rstrip()


def median_line(label, result, target=""):
    """One row with a median."""
    if result["median"] is None:
        return f"{label:<52} {'-':>9}" + (f"  ({result['missing']} without a figure)" if result["missing"] else "")
    spread = f"  seeds {result['seeds'][0]:.3f}..{result['seeds'][1]:.3f}"
    without = f"  ({result['missing']} without a figure)" if result["missing"] else ""
    return f"{label:<52} {result['median']:8.3f}  n {result['count']:<5}{spread}{without}  {target}".rstrip()
