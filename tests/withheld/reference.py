"""Reads a setup.toml back into a Machine (self-test only: the reference sets)."""
import tomllib

import numpy as np

from machine import Artefact, Machine


def load_machine(path):
    """Machine of a setup.toml, as the generator understands the contract."""
    with open(path, "rb") as handle:
        doc = tomllib.load(handle)
    chain = doc["machine"]["chain"].split()
    letters = (chain[chain.index("b") - 1], chain[chain.index("b") - 2])
    axes = [doc["machine"]["axis"][letter] for letter in letters]
    machine = Machine(letters, np.array([a["point_mm"] for a in axes], float),
                      np.array([a["direction"] for a in axes], float))
    machine.tip_mm = np.array(doc.get("probe", {}).get("tip_mm", [0, 0, 0]), float)
    machine.ball_diameter_mm = doc.get("probe", {}).get("ball_diameter_mm", 6.0)
    bar = doc.get("ballbar", {})
    machine.cup_mm = np.array(bar.get("cup_mm", [0, 0, 0]), float)
    machine.bar_length_mm = bar.get("length_mm", 100.0)
    machine.bar_free = tuple(bar.get("free", ()))
    machine.noise_um = doc["model"]["noise_um"]
    machine.artefacts = [Artefact(a["name"], a["kind"], np.array(a["center_mm"], float), a["diameter_mm"],
                                  "center" in a.get("free", [])) for a in doc["artefact"]]
    return machine
