"""From a wish (kind, effects, noise) to a case: machine, campaign, effects of the wanted size, noisy readings."""
from dataclasses import dataclass, field, replace

import numpy as np

import circumstances
import noise
import outsiders
import registry
from campaign import Plan, build, session_length
from forward import Scene
from machine import Base, draw_machine
from oracle import Projector
from rivals import find_rivals, nearest, signature

NULLS = ("right", "wrong", "repeats", "correlated-repeats")
OUTSIDE = (0.75, 0.85)   # an outsider's visible variance that one, two catalogue effects may reproduce
MULTI_BAD_PARTNERS = ("artefact.position", "tool.length", "ballbar.length", "control.rounding", "control.chord")


@dataclass
class Wish:
    """What one set shall hold."""
    kind: str
    effects: tuple = ()
    noise: str = "right"        # right, wrong (30 %, no repeats), repeats (setup wrong too), correlated, ...
    letters: tuple = ("B", "C")
    outliers: bool = False
    form_sigma: float = 0.0     # visible rms of smooth form errors on every axis
    around: str = ""            # zeros, sessions, sigma (circumstances.py)


@dataclass
class Case:
    """One finished set."""
    wish: Wish
    machine: object = None
    plan: Plan = None
    base: Base = None
    base_values: np.ndarray = None
    effects: list = field(default_factory=list)
    sizes: list = field(default_factory=list)
    sigma_column: bool = False
    nearest: list = field(default_factory=list)
    background: object = None


def schedule(rng, count, kinds, names, around=()):
    """A shuffled list of wishes: about 16 % null, 52 % single, 12 % two or three, 10 % outsiders, 6 % foreign."""
    wishes = []
    share = {"null": 0.16, "single": 0.52, "multi": 0.12, "outsider": 0.10, "foreign": 0.06, "outliers": 0.04}
    if kinds and "form" in kinds:
        share["form"] = 0.3
    share = {k: v for k, v in share.items() if not kinds or k in kinds}
    if names:
        share = {"single": 1.0}
    total = sum(share.values())
    numbers = {k: int(round(count * v / total)) for k, v in share.items()}
    largest = max(numbers, key=numbers.get)
    numbers[largest] += count - sum(numbers.values())
    for kind, number in numbers.items():
        pool = []
        for k in range(number):
            letters = (("B", "C"), ("A", "C"))[(k + k // 4) % 2 if kind != "single" else rng.integers(2)]
            if kind in ("single", "outliers", "form"):
                if not pool:
                    pool = list(rng.permutation(names or registry.all_names(("1", "C"))))
                effects = (str(pool.pop()).replace("1.", letters[0] + "."),)
            elif kind in ("outsider", "foreign"):
                source = outsiders.OUTSIDERS if kind == "outsider" else outsiders.FOREIGN
                pool = pool or list(rng.permutation(len(source)))
                effects = (source[pool.pop()],)
            else:
                effects = ("?",) * int(rng.choice([2, 3])) if kind == "multi" else ()
            sort = NULLS[k % len(NULLS)] if kind == "null" else str(
                rng.choice(["right", "wrong", "repeats", "correlated-repeats"], p=[0.5, 0.1, 0.25, 0.15]))
            form = float(np.exp(rng.uniform(np.log(0.7), np.log(12.0)))) if kind == "form" else 0.0
            wishes.append(Wish(kind, effects, sort, letters, kind == "outliers", form))
    for k, wish in enumerate(wishes):
        wish.around = around[k % len(around)] if around else ""
    return [wishes[i] for i in rng.permutation(len(wishes))]


def draw_plan(rng, needs, kind_of_noise):
    """A campaign that meets the needs; everything else is left to chance."""
    choices = registry.allowed_devices(needs)
    devices = choices[rng.integers(len(choices))]
    if "no-sphere" in needs:
        devices = ("touch",) if rng.random() < 0.5 else ("touch", "ballbar")
    if {"probe", "ballbar"} <= needs:
        devices = (str(rng.choice(["sphere", "touch"])), "ballbar")
    repeats = "repeats" in kind_of_noise
    single = len(devices) == 1
    probe = devices[0] != "ballbar"
    return Plan(devices=devices, poses=int(rng.integers(72, 200) if single else rng.integers(60, 110)),
                touch_poses=int(rng.integers(30, 54) if single else rng.integers(24, 36)),
                bar_step_deg=float(rng.choice([3.0, 4.0])) * (1.5 if repeats else 1.0), repeats=repeats,
                modes="modes" in needs or (probe and rng.random() < 0.6),
                swing_c=float(rng.uniform(3, 5)) if "swing" in needs or rng.random() < 0.1 else 1.2,
                load_kg=float(rng.integers(40, 160)) if "load" in needs or rng.random() < 0.08 else 0.0,
                clamp="clamp" in needs or (probe and rng.random() < 0.08),
                calibrated=bool(rng.random() < (0.5 if "modes" in needs else 0.06)),
                spindle="spindle" in needs or (probe and rng.random() < 0.3),
                touch_azimuth_deg=float(rng.integers(0, 30)), overtravel_mm=float(rng.choice([0.0, 2.0])),
                rotary_deg_s=float(rng.choice([4.0, 6.0, 10.0])),
                side_before=tuple(int(side) for side in rng.choice([-1, 1], 5)), side_told=bool(rng.random() < 0.5))


def set_noise(rng, case):
    """True sigma and what the setup says: equal, or 30 % off either way."""
    true = {"sphere": 0.8, "touch": 0.8, "ballbar": 0.3}
    true = {k: float(v * rng.uniform(0.8, 1.25)) for k, v in true.items() if k in case.plan.devices}
    factor = 1.0 if case.wish.noise == "right" else float(rng.choice([1.3, 1 / 1.3]))
    case.noise_um = true
    case.machine.noise_um = {k: v * factor for k, v in true.items()}
    case.correlated = case.wish.noise.startswith("correlated")
    case.sigma_column = case.wish.noise == "right" and rng.random() < 0.15


def prepare(rng, wish, needs, names=()):
    """Machine, campaign and base of a case whose effects need these things."""
    case = Case(wish)
    case.machine = draw_machine(rng, wish.letters)
    case.plan = draw_plan(rng, needs, wish.noise)
    if not circumstances.suits(wish.around, wish, names, case.plan.devices):
        case.wish = wish = replace(wish, around="zeros")
    case.machine.session_s = session_length(case.plan)
    if "cup known" in needs:
        case.machine.bar_free = ("length",)
    if "length known" in needs:
        case.machine.bar_free = ("cup",)
    if "artefact known" in needs:
        for k in rng.permutation(3)[:2]:      # one known sphere alone would be the same as a wrong pivot store
            case.machine.artefacts[k].free = False
    set_noise(rng, case)
    case.train, case.hold = build(rng, case.machine, case.plan)
    case.base = Base(case.machine, set(case.plan.devices), 2 if wish.around == "sessions" else 1)
    if wish.around == "sessions":
        circumstances.split_sessions(case.train)
    if wish.around == "zeros":
        circumstances.split_zeros(case.train, int(rng.integers(3, 7)))
    case.scene, case.scene_hold = (Scene(case.machine, case.base, rows) for rows in (case.train, case.hold))
    case.sigma_train, case.sigma_hold = (noise.sigma_mm(rows, case.noise_um) for rows in (case.train, case.hold))
    if wish.around == "sigma":
        case.sigma_train, case.sigma_column = circumstances.rough_rows(rng, case.sigma_train), True
    case.base_values = case.base.draw(rng)
    if case.plan.calibrated:
        case.base.calibrate(rng, case.base_values)
    case.projector = Projector(case.scene, case.sigma_train)
    return case


def plausible(effect):
    """Amplitudes a machine in use may have: 0.08 mm, 0.3 mrad, a worm's cyclic error 0.15 mrad."""
    limit = {"rad": 1.5e-4 if effect.name.endswith(".cyclic") else 3e-4, "mm": 0.08}
    return all(abs(a) <= limit.get(label.rsplit("_", 1)[-1], 1e9) for a, label in zip(effect.amplitude, effect.labels))


def to_size(case, effect, wanted):
    """The effect scaled to `wanted` sigma (visible rms), or None if that is beyond reason."""
    for _ in range(2):
        size = case.projector.rms(signature(case, effect))
        if size < 1e-4:
            return None
        effect = effect.scaled(wanted / size)
        if not plausible(effect):
            return None
    linear = abs(case.projector.rms(signature(case, effect)) / wanted - 1) < 0.05
    return effect if linear else None


def stepped(rng, case, name, wanted):
    """Of an effect with few possible sizes, the one nearest to `wanted` sigma."""
    builder, steps = registry.STEPS[name]
    found = [builder(rng, case.machine, step) for step in steps]
    sizes = np.array([case.projector.rms(signature(case, e)) for e in found])
    best = int(np.argmin(np.abs(np.log(np.maximum(sizes, 1e-6) / wanted))))
    return found[best] if 0.8 <= sizes[best] <= 8 else None


def needs_of(rng, wish, names):
    """Needs of effects given by name or builder."""
    scratch = draw_machine(rng, wish.letters)
    scratch.session_s = 1.0
    builders = registry.singles(wish.letters)
    out = set()
    for name in names:
        if name in registry.STEPS:
            out |= registry.STEPS[name][0](rng, scratch, 1.0).needs
        else:
            out |= (name if callable(name) else builders[name])(rng, scratch).needs
    return out


def distinct(case, effects):
    """Several effects: none may be mostly absorbed by the others (each alone keeps 60 % of its rms)."""
    columns = [case.projector.visible(signature(case, e)) for e in effects]
    for k, column in enumerate(columns):
        rest = np.array([c for j, c in enumerate(columns) if j != k]).T
        left = column - rest @ np.linalg.lstsq(rest, column, rcond=None)[0]
        if np.linalg.norm(left) < 0.6 * np.linalg.norm(column):
            return False
    return True


def try_case(rng, wish):
    """One attempt; None when the draw cannot show the effect at the wanted size."""
    names = list(wish.effects)
    builders = registry.singles(wish.letters)
    if "?" in names:
        pool = [n for n in builders if n not in MULTI_BAD_PARTNERS]
        names = [str(n) for n in rng.choice(pool, len(names), replace=False)]
    needs = needs_of(rng, wish, names)
    if "no-sphere" in needs and "modes" in needs and "ballbar|touch" in needs:
        return None
    case = prepare(rng, wish, needs, [n if isinstance(n, str) else "" for n in names])
    low, high = (2.0, 6.0) if wish.kind in ("multi", "form") else (1.0, 6.0)
    for name in names:
        wanted = float(rng.uniform(low, high))
        if name in registry.STEPS:
            effect = stepped(rng, case, name, wanted)
        else:
            effect = to_size(case, (name if callable(name) else builders[name])(rng, case.machine), wanted)
        if effect is None:
            return None
        case.effects.append(effect)
    if len(case.effects) > 1 and not distinct(case, case.effects):
        return None
    case.sizes = [case.projector.rms(signature(case, e)) for e in case.effects]
    if wish.kind == "outsider":
        case.nearest = nearest(case, case.effects[0])
        if any(share > limit for (_, share), limit in zip(case.nearest, OUTSIDE)):
            return None
    if wish.form_sigma:
        case.background = to_size(case, outsiders.form_errors(rng, case.machine), wish.form_sigma)
        if case.background is None:
            return None
    case.rivals = [find_rivals(case, e) if wish.kind in ("single", "outliers", "multi", "form") else {} for e in case.effects]
    if any(r["cannot_tell"] and r["simpler"] for rivals in case.rivals for r in rivals.values()) and rng.random() < 0.7:
        return None
    return case


def other_effect(rng, wish):
    """A wish that no campaign can grant gets another effect of its kind."""
    if wish.kind in ("outsider", "foreign"):
        source = outsiders.OUTSIDERS if wish.kind == "outsider" else outsiders.FOREIGN
        return replace(wish, effects=(source[rng.integers(len(source))],))
    if wish.kind in ("single", "outliers", "form"):
        return replace(wish, effects=(str(rng.choice(registry.all_names(wish.letters))),))
    return wish


def find_case(rng, wish, tries=25, rounds=8):
    """A case without readings yet."""
    for _ in range(rounds):
        for _ in range(tries):
            case = try_case(rng, wish)
            if case is not None:
                return case
        wish = other_effect(rng, wish)
    raise RuntimeError(f"no campaign shows {wish} at the wanted size")


def draw_case(rng, wish):
    """A finished case for a wish."""
    case = find_case(rng, wish)
    true = case.effects + ([case.background] if case.background else [])
    case.clean = case.scene.readings(case.base_values, true)
    case.clean_hold = case.scene_hold.readings(case.base_values, true)
    case.values = case.clean + noise.draw(rng, case.train, case.sigma_train, case.correlated)
    case.values_hold = case.clean_hold + noise.draw(rng, case.hold, case.sigma_hold, case.correlated)
    if case.wish.around == "zeros":
        turned = (case.scene.turned[0] @ case.scene.turned[1])[:, :3, :3]
        case.values = case.values + circumstances.zero_shifts(rng, case.train, case.sigma_train, turned)
    case.outlier_rows = []
    if wish.outliers:
        case.values, case.outlier_rows = noise.outliers(rng, case.train, case.values)
    return case
