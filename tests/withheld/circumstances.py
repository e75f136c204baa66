"""What a day in a shop adds to a set: zeroing scatter, two sessions, readings of different sigma.

Drawn with `--circumstances zeros,sessions,sigma`: each set gets one of them, in turn.
"""
import numpy as np

ALL = ("zeros", "sessions", "sigma")
BY_TIME = ("thermal.", "artefact.moved")     # a new session begins their clock anew: they stay in one
ZERO_SIGMA = (0.1, 0.6)                      # scatter of a zero, over the noise of a reading
ROUGH = (0.2, 8.0)                           # share of rows with a larger sigma, and by how much


def suits(circumstance, wish, names, devices):
    """Whether a set with these effects may have it. Both days must see all that is set up: one probe."""
    if circumstance != "sessions":
        return True
    if len(devices) > 1 or devices[0] == "ballbar":
        return False
    return wish.kind not in ("outsider", "foreign") and not any(str(n).startswith(BY_TIME) for n in names)


def split_sessions(rows):
    """The second half, from a new visit on, is another day."""
    for i in range(rows.n // 2, rows.n):
        if rows.visit[i] != rows.visit[i - 1]:
            break
    rows.session = (np.arange(rows.n) >= i - (rows.device[i - 1] == "")).astype(int)


def split_zeros(rows, parts):
    """The probe's map in several tests, each zeroed anew; passes of the ballbar are tests already."""
    probe = np.flatnonzero(rows.probe | (~rows.bar & ~rows.read))
    visits = np.unique(rows.visit[rows.probe])
    for i in probe:
        at = np.searchsorted(visits, rows.visit[i] if rows.read[i] else rows.visit[min(i + 1, rows.n - 1)])
        rows.test[i] = f"{rows.test[i]}{int(at * parts / max(len(visits), 1))}"


def zero_shifts(rng, rows, sigma_mm, turned):
    """What wrong zeros add to the readings, mm: a shift of the table or of the machine for each test of the
    probe, an offset for each pass of the ballbar. `turned`: rotations M <- W by row."""
    out, part = np.zeros(rows.n), rng.uniform(*ZERO_SIGMA)
    with_table = rng.random() < 0.5
    for test in np.unique(rows.test[rows.read]):
        index = np.flatnonzero((rows.test == test) & rows.read)
        scatter_mm = part * np.median(sigma_mm[index])
        if rows.bar[index[0]]:
            out[index] += scatter_mm * rng.normal()
            continue
        shift = scatter_mm * rng.normal(size=3)
        moved = turned[index] @ shift if with_table else np.broadcast_to(shift, (len(index), 3))
        out[index] += np.einsum("ni,ni->n", rows.dir[index], moved)
    return out


def rough_rows(rng, sigma_mm):
    """Sigma by row: some readings are much less sure, and say so."""
    share, factor = ROUGH
    return np.where(rng.random(len(sigma_mm)) < share, factor, 1.0) * sigma_mm
