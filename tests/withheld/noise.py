"""Noise of the readings: independent, or correlated within a touched sphere and along a ballbar pass."""
import numpy as np


def sigma_mm(rows, noise_um):
    """One sigma of every row, 0 for device-less ones."""
    out = np.zeros(rows.n)
    for device, value in noise_um.items():
        out[rows.device == device] = value * 1e-3
    return out


def draw(rng, rows, sigma, correlated, memory=0.9, share=0.6):
    """Noise with standard deviation sigma per row.

    correlated: touches of one visit share a centre error (share of the variance), ballbar samples of one pass
    hold an AR(1) part of the same share with the given memory per sample.
    """
    white = rng.normal(size=rows.n)
    if not correlated:
        return sigma * white
    common = np.zeros(rows.n)
    for visit in np.unique(rows.visit[rows.read]):
        index = np.flatnonzero((rows.visit == visit) & rows.read)
        if rows.device[index[0]] == "ballbar":
            value = rng.normal()
            kicks = rng.normal(size=len(index)) * np.sqrt(1 - memory ** 2)
            for i, kick in zip(index, kicks):
                value = memory * value + kick
                common[i] = value
        else:
            common[index] = rows.dir[index] @ rng.normal(size=3)
    return sigma * np.where(rows.device == "sphere", white, np.sqrt(share) * common + np.sqrt(1 - share) * white)


def outliers(rng, rows, values, share=0.02, height_mm=5e-3):
    """A share of the readings jumps by +-height; returns the changed values and the rows."""
    read = np.flatnonzero(rows.read)
    hit = rng.choice(read, max(1, int(round(share * len(read)))), replace=False)
    out = values.copy()
    out[hit] += rng.choice([-1.0, 1.0], len(hit)) * height_mm
    return out, hit
