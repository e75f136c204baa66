"""The table of readings, its CSV form, and what the commanded positions say about travel and approach."""
import csv

import numpy as np

ROUNDING = 2.5e-6     # mm or deg: smaller steps of the six-decimal CSV are no motion


class Rows:
    """Columns as arrays of one length n. pos_mm (n,3), ang_deg (n,2) are commanded; dir (n,3) unit in M.

    Besides the CSV columns: path_* describe the ballbar's path of the linear axes (an arc in M: centre, axis,
    angle travelled since the test's start), visit numbers the found spheres and the ballbar passes.
    """
    NUMBERS = ("time_s", "feed_mm_min", "spindle_deg", "temperature_c", "load_kg", "clamped", "path_turn_rad",
               "path_radius_mm", "visit")
    TEXTS = ("test", "mode", "device", "feature")
    VECTORS = {"pos_mm": 3, "ang_deg": 2, "dir": 3, "path_center_mm": 3, "path_axis": 3}

    def __init__(self, records, side_before=(1, 1, 1, 1, 1)):
        """records: list of dicts, absent fields are 0 or empty; side_before: of each axis before its first move."""
        self.side_before = tuple(side_before)
        for name in self.NUMBERS:
            setattr(self, name, np.array([r.get(name, 0.0) for r in records], float))
        for name in self.TEXTS:
            setattr(self, name, np.array([r.get(name, "") for r in records], dtype="U24"))
        for name, width in self.VECTORS.items():
            setattr(self, name, np.array([r.get(name, (0.0,) * width) for r in records], float).reshape(-1, width))
        self.pos_mm, self.ang_deg = np.round(self.pos_mm, 6), np.round(self.ang_deg, 6)
        self.dir = np.round(self.dir, 9)
        self.time_s = np.round(self.time_s, 3)
        self.temperature_c = np.round(self.temperature_c, 3)
        self.session = np.zeros(len(records), int)
        self.derive()

    def derive(self):
        """Velocity, sign of travel and sign of approach of the five axes (contract's rules)."""
        self.n = len(self.time_s)
        self.read = self.device != ""
        self.probe = (self.device == "sphere") | (self.device == "touch")
        self.bar = self.device == "ballbar"
        axes = np.hstack([self.pos_mm, self.ang_deg])
        self.velocity = np.zeros((self.n, 5))       # mm/s, deg/s; ballbar rows only
        self.turning = np.zeros((self.n, 5), bool)  # an exact turning point: velocity 0 although the axis moves
        self.sign = approach_sign(axes, self.side_before)   # travel of a moving axis, else the side it came from
        self.last_side = tuple(int(side) for side in self.sign[-1]) if self.n else self.side_before
        for name in np.unique(self.test[self.bar]):
            index = np.flatnonzero(self.test == name)
            self._travel(index, axes[index])
        return self

    def _travel(self, index, axes):
        """Central differences within one test, one-sided at its ends."""
        last = len(index) - 1
        before, after = np.maximum(np.arange(last + 1) - 1, 0), np.minimum(np.arange(last + 1) + 1, last)
        step, span = axes[after] - axes[before], self.time_s[index][after] - self.time_s[index][before]
        still = np.abs(step) < ROUNDING
        self.velocity[index] = np.where(still, 0.0, step / span[:, None])
        self.turning[index] = still & (np.abs(axes[after] - axes) > ROUNDING)
        travel = np.where(still, self.sign[index], np.sign(step))
        self.sign[index] = np.where(self.turning[index], 0.0, travel)

    def weighted(self):
        """Rows that say something about reversal: read, and no moving axis exactly at its turning point."""
        return self.read & ~self.turning.any(axis=1)


def approach_sign(axes, side_before):
    """Sign of each axis's last non-zero move; before the first one the side that it came from."""
    moves = np.diff(axes, axis=0, prepend=axes[:1])
    signs = np.where(np.abs(moves) < ROUNDING, 0.0, np.sign(moves))
    for column, side in zip(signs.T, side_before):
        last = np.maximum.accumulate(np.where(column != 0, np.arange(len(column)), -1))
        column[:] = np.where(last < 0, side, column[last])
    return signs


def write_csv(path, rows, letters, values, optional, comments):
    """values (n,) in mm or None; optional: which of the optional columns to write."""
    angle = [f"{letter.lower()}_deg" for letter in letters]
    head = ["index", "time_s", "test", "mode", "device", "feature", "x_mm", "y_mm", "z_mm", *angle, "dir_x",
            "dir_y", "dir_z", *optional, "value_mm"]
    with open(path, "w", newline="") as out:
        out.write("".join(f"# {key} = {value}\n" for key, value in comments.items()))
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(head)
        for i in range(rows.n):
            direction = [f"{d:.9g}" for d in rows.dir[i]] if rows.probe[i] else ["", "", ""]
            extra = [f"day{rows.session[i] + 1}" if name == "session" else
                     "" if name == "sigma_mm" and not rows.read[i] else f"{getattr(rows, name)[i]:.10g}"
                     for name in optional]
            value = f"{values[i]:.7f}" if values is not None and rows.read[i] else ""
            writer.writerow([i, f"{rows.time_s[i]:.3f}", rows.test[i], rows.mode[i], rows.device[i],
                             rows.feature[i], *(f"{v:.6f}" for v in rows.pos_mm[i]),
                             *(f"{v:.6f}" for v in rows.ang_deg[i]), *direction, *extra, value])


def read_csv(path, letters):
    """Rows and values (nan where empty) of a readings file."""
    with open(path, newline="") as handle:
        table = list(csv.DictReader(line for line in handle if not line.startswith("#")))
    number = lambda row, name: float(row.get(name) or 0.0)
    records = []
    for row in table:
        record = {name: row.get(name) or "" for name in Rows.TEXTS}
        record.update({name: number(row, name) for name in Rows.NUMBERS})
        record["pos_mm"] = [number(row, f"{a}_mm") for a in "xyz"]
        record["ang_deg"] = [number(row, f"{letter.lower()}_deg") for letter in letters]
        record["dir"] = [number(row, f"dir_{a}") for a in "xyz"]
        records.append(record)
    values = np.array([float(row["value_mm"]) if row.get("value_mm") else np.nan for row in table])
    return Rows(records), values
