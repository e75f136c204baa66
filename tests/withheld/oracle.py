"""Weighted least squares of base parameters and, if asked, the true effects' amplitudes."""
import numpy as np

RANK = 1e-5      # of the largest singular value: what is weaker is second order of tens of um


def jacobian(scene, base_values, effects, amplitudes):
    """Central differences of the readings by base parameters, then by each effect's amplitudes."""
    columns = []
    for k in range(scene.base.size):
        step = np.zeros(scene.base.size)
        step[k] = scene.base.step[k]
        columns.append((scene.readings(base_values + step, effects, amplitudes)
                        - scene.readings(base_values - step, effects, amplitudes)) / (2 * step[k]))
    for e, effect in enumerate(effects):
        for k in range(len(effect.amplitude)):
            step = effect.step[k]
            up, down = [a.copy() for a in amplitudes], [a.copy() for a in amplitudes]
            up[e][k] += step
            down[e][k] -= step
            columns.append((scene.readings(base_values, effects, up)
                            - scene.readings(base_values, effects, down)) / (2 * step))
    return np.array(columns).T


def solve(matrix, right):
    """Least squares with columns scaled to unit length; directions below RANK are left alone (least norm)."""
    norm = np.sqrt((matrix ** 2).sum(axis=0))
    norm[norm == 0] = 1.0
    return np.linalg.lstsq(matrix / norm, right, rcond=RANK)[0] / norm


class Fit:
    """Result: base values, amplitudes, rms of (measured - model)/sigma on the rows used."""

    def __init__(self, scene, values, sigma_mm, effects=(), sweeps=3):
        use = sigma_mm > 0
        base = np.zeros(scene.base.size)
        amplitudes = [e.amplitude.copy() for e in effects]
        matrix = jacobian(scene, base, effects, amplitudes)[use] / sigma_mm[use, None]
        for _ in range(sweeps):
            z = (values - scene.readings(base, effects, amplitudes))[use] / sigma_mm[use]
            delta = solve(matrix, z)
            base = base + delta[:scene.base.size]
            at = scene.base.size
            for k, amplitude in enumerate(amplitudes):
                amplitudes[k] = amplitude + delta[at:at + len(amplitude)]
                at += len(amplitude)
        z = (values - scene.readings(base, effects, amplitudes))[use] / sigma_mm[use]
        self.base, self.amplitudes, self.effects = base, amplitudes, effects
        self.z_rms = float(np.sqrt(np.mean(z ** 2)))

    def predict(self, scene):
        """Readings of another table (hold-out) of the same machine."""
        return scene.readings(self.base, self.effects, self.amplitudes)


class Projector:
    """Removes from whitened columns what the base parameters can absorb."""

    def __init__(self, scene, sigma_mm):
        self.use = sigma_mm > 0
        self.sigma = sigma_mm[self.use]
        matrix = jacobian(scene, np.zeros(scene.base.size), (), ())[self.use] / self.sigma[:, None]
        matrix /= np.maximum(np.sqrt((matrix ** 2).sum(axis=0)), 1e-300)
        left, size, _ = np.linalg.svd(matrix, full_matrices=False)
        self.basis = left[:, size > RANK * size[0]]

    def visible(self, column_mm):
        """Whitened column(s) less their part in the span of the base."""
        z = (column_mm[self.use].T / self.sigma).T
        return z - self.basis @ (self.basis.T @ z)

    def rms(self, column_mm):
        """Visible rms per reading, in sigma."""
        return float(np.sqrt(np.mean(self.visible(column_mm) ** 2)))
