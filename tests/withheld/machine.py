"""The two table machines, their set-up as declared (setup.toml) and the base parameters.

Frames: M bed, W table (equal to M at home), S spindle gauge point. Rotary axis 0 is the carrier next to the
bed (B or A), axis 1 is C. `direction` is what a + command does to the carried body, right-hand rule.
"""
from dataclasses import dataclass, field

import numpy as np

LINEAR = "XYZ"
UNIT = {"A": np.array([1.0, 0, 0]), "B": np.array([0, 1.0, 0]), "C": np.array([0, 0, 1.0])}
ALONG = {"A": 0, "B": 1, "C": 2}      # index of the machine axis a rotary axis turns about


@dataclass
class Artefact:
    """A sphere or a ballbar's centre pivot fixed to the table; centre in W."""
    name: str
    kind: str
    center_mm: np.ndarray
    diameter_mm: float = 25.4
    free: bool = True


@dataclass
class Machine:
    """Declared geometry; nothing here is in error."""
    letters: tuple                      # ("B", "C") or ("A", "C")
    points_mm: np.ndarray               # (2, 3) a point of each axis line in M, at home
    directions: np.ndarray              # (2, 3)
    artefacts: list = field(default_factory=list)
    tip_mm: np.ndarray = None           # stylus ball centre in S
    ball_diameter_mm: float = 6.0
    cup_mm: np.ndarray = None           # ballbar's tool cup in S
    bar_length_mm: float = 100.0
    bar_free: tuple = ("cup", "length")
    tilt_limits_deg: tuple = (-110.0, 110.0)
    noise_um: dict = field(default_factory=dict)   # as declared in the set-up, may be wrong

    def radial(self, axis):
        """The two machine directions (0..2) across rotary axis 0 or 1."""
        return [i for i in range(3) if i != ALONG[self.letters[axis]]]


def draw_machine(rng, letters):
    """A random but sensible trunnion machine with three spheres and a centre pivot."""
    tilt_point = np.round(rng.uniform([-20, -20, -10], [20, 20, 40]), 1)
    offset = np.round(np.array([rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(20, 60)]), 1)
    if rng.random() < 0.3:
        offset[:2] = 0.0
    turn_point = np.round(tilt_point + offset, 1)
    directions = np.array([-UNIT[letters[0]], -UNIT["C"]])
    machine = Machine(letters, np.array([tilt_point, turn_point]), directions)
    machine.tip_mm = np.array([0.0, 0.0, -float(rng.integers(110, 190))])
    machine.cup_mm = np.array([0.0, 0.0, -float(rng.integers(90, 160))])
    machine.bar_length_mm = float(rng.choice([100.0, 150.0]))
    top = turn_point[2] + rng.uniform(40, 70)
    azimuth = rng.uniform(0, 2 * np.pi) + np.array([0, 2.1, 4.2]) + rng.uniform(-0.3, 0.3, 3)
    radius = rng.uniform(70, 150, 3)
    for i in range(3):
        center = turn_point + [radius[i] * np.cos(azimuth[i]), radius[i] * np.sin(azimuth[i]), 0]
        center[2] = top + rng.uniform(0, 90)
        machine.artefacts.append(Artefact(f"S{i + 1}", "sphere", np.round(center, 1)))
    pivot = turn_point + [rng.uniform(50, 90), rng.uniform(-15, 25), 0]
    pivot[2] = top + rng.uniform(10, 60)
    machine.artefacts.append(Artefact("P1", "center_pivot", np.round(pivot, 1)))
    return machine


class Base:
    """The base parameters the simulation re-identifies: location errors and free set-up quantities.

    Order: per rotary axis two positions (mm) and two tilts (rad) across it, then free artefact centres in W,
    then cup in S and bar length (mm).
    """

    def __init__(self, machine, devices, sessions=1):
        self.machine, self.names, self.sessions = machine, [], sessions
        for axis, letter in enumerate(machine.letters):
            across = machine.radial(axis)
            self.names += [("shift", axis, i) for i in across] + [("tilt", axis, i) for i in across]
        for k, artefact in enumerate(machine.artefacts):
            used = devices & ({"ballbar"} if artefact.kind == "center_pivot" else {"sphere", "touch"})
            if artefact.free and used:
                self.names += [("center", k, i) for i in range(3)]
        if "ballbar" in devices:
            self.names += [("cup", 0, i) for i in range(3)] if "cup" in machine.bar_free else []
            self.names += [("length", 0, 0)] if "length" in machine.bar_free else []
        self.single = list(self.names)                      # of one session
        anew = [n for n in self.names if n[0] not in ("shift", "tilt")]
        self.names += anew * (sessions - 1)
        self.size = len(self.names)
        tilt = np.array([n[0] == "tilt" for n in self.names])
        self.step = np.where(tilt, 1e-5, 1e-3)
        self.known = np.zeros(self.size)                    # prior: value and sigma; wide unless calibrated
        self.known_sigma = np.where(tilt, 5e-4, 0.1)

    def calibrate(self, rng, values):
        """Location errors known beforehand to 1-2 um and 5-10 urad ([model.calibration])."""
        for k, (kind, _, _) in enumerate(self.names):
            if kind in ("shift", "tilt"):
                self.known_sigma[k] = float(f"{rng.uniform(1e-3, 2e-3) if kind == 'shift' else rng.uniform(5e-6, 1e-5):.3g}")
                self.known[k] = float(f"{rng.normal(values[k], self.known_sigma[k]):.6g}")

    def calibration_text(self):
        """The [model.calibration] table."""
        lines = ["[model.calibration]"]
        for k, (label, name) in enumerate(zip(self.labels(), self.names)):
            if name[0] in ("shift", "tilt"):
                short, unit = label.rsplit("_", 1)
                lines.append(f"{short} = {{ value_{unit} = {float(self.known[k])!r}, sigma_{unit} = {float(self.known_sigma[k])!r} }}")
        return "\n".join(lines) + "\n"

    def draw(self, rng):
        """Location errors 2-30 um and 10-100 urad, set-up offsets 5-30 um, random signs."""
        span = {"shift": (0.002, 0.030), "tilt": (1e-5, 1e-4)}
        low_high = np.array([span.get(n[0], (0.005, 0.030)) for n in self.names])
        return rng.uniform(low_high[:, 0], low_high[:, 1]) * rng.choice([-1.0, 1.0], self.size)

    def of_session(self, values, session):
        """The values of one session in the order of a single one: the set-up is its own."""
        if session == 0:
            return values[:len(self.single)]
        located = sum(n[0] in ("shift", "tilt") for n in self.single)
        own = len(self.single) - located
        first = len(self.single) + (session - 1) * own
        return np.concatenate([values[:located], values[first:first + own]])

    def split(self, values):
        """Parameter vector to arrays: axis shift (2,3), axis tilt (2,3), centres (k,3), cup (3), bar length."""
        parts = {"shift": np.zeros((2, 3)), "tilt": np.zeros((2, 3)),
                 "center": np.zeros((len(self.machine.artefacts), 3)), "cup": np.zeros((1, 3)),
                 "length": np.zeros((1, 1))}
        for (kind, row, col), value in zip(self.single, values):
            parts[kind][row, col] = value
        return parts

    def labels(self):
        """Contract-style names, for the truth file."""
        out = []
        for kind, row, col in self.single:
            if kind in ("shift", "tilt"):
                prefix = ("EX0", "EY0", "EZ0")[col] if kind == "shift" else ("EA0", "EB0", "EC0")[col]
                out.append(prefix + self.machine.letters[row] + ("_mm" if kind == "shift" else "_rad"))
            elif kind == "center":
                out.append(f"{self.machine.artefacts[row].name}.{LINEAR[col]}_mm")
            else:
                out.append(f"{kind}.{LINEAR[col]}_mm" if kind == "cup" else "bar_length_mm")
        located = sum(n[0] in ("shift", "tilt") for n in self.single)
        for session in range(1, self.sessions):
            out += [f"{label}.day{session + 1}" for label in out[located:len(self.single)]]
        return out


def setup_text(machine, devices):
    """The setup.toml that the diagnoser sees."""
    first, second = machine.letters
    lines = ['schema = "trunnion.setup/1"', "[machine]", f'name = "{first}{second} table machine"',
             f'chain = "w {second} {first} b X Y Z t"']
    for axis, letter in enumerate(machine.letters):
        limits = list(machine.tilt_limits_deg) if axis == 0 else [-36000, 36000]
        lines += [f"[machine.axis.{letter}]", f"direction = {[int(d) for d in machine.directions[axis]]}",
                  f"point_mm = {[float(p) for p in machine.points_mm[axis]]}", f"limits_deg = {limits}"]
    for i, letter in enumerate(LINEAR):
        lines += [f"[machine.axis.{letter}]", f"direction = {[int(i == k) for k in range(3)]}",
                  "limits_mm = [-900, 900]"]
    lines += ["[control]", 'dialect = "fanuc"']
    if devices & {"sphere", "touch"}:
        lines += ["[probe]", f"tip_mm = {machine.tip_mm.tolist()}", f"ball_diameter_mm = {machine.ball_diameter_mm}"]
    if "ballbar" in devices:
        free = ", ".join(f'"{name}"' for name in machine.bar_free)
        lines += ["[ballbar]", f"cup_mm = {machine.cup_mm.tolist()}", f"length_mm = {machine.bar_length_mm}",
                  f"free = [{free}]"]
    noise = ", ".join(f"{d} = {machine.noise_um[d]:.4g}" for d in sorted(devices))
    lines += ["[model]", 'modelled = ["location"]', f"noise_um = {{ {noise} }}"]
    for artefact in machine.artefacts:
        used = devices & ({"ballbar"} if artefact.kind == "center_pivot" else {"sphere", "touch"})
        if used:
            free = '["center"]' if artefact.free else "[]"
            lines += ["[[artefact]]", f'name = "{artefact.name}"', f'kind = "{artefact.kind}"',
                      f"center_mm = {[float(c) for c in artefact.center_mm]}",
                      f"diameter_mm = {artefact.diameter_mm}", f"free = {free}"]
    return "\n".join(lines) + "\n"
