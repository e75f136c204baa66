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
    """Result: base values, amplitudes, rms of (measured - model)/sigma on the rows used.

    Weak priors (base.known: 0.1 mm, 0.5 mrad unless calibrated; amplitudes: five times the effect's own) keep
    directions that these data do not show from running away.
    """

    def __init__(self, scene, values, sigma_mm, effects=(), sweeps=3):
        use, base = sigma_mm > 0, scene.base
        known = np.concatenate([base.known, *[np.zeros(len(e.amplitude)) for e in effects]])
        spread = np.concatenate([base.known_sigma, *[np.full(len(e.amplitude), 5 * np.sqrt(np.mean(e.amplitude ** 2)))
                                                     if len(e.amplitude) else [] for e in effects]])
        cuts = np.cumsum([base.size] + [len(e.amplitude) for e in effects])[:-1] if effects else []
        parts = lambda all_values: np.split(all_values, cuts)
        start = np.concatenate([base.known, *[e.amplitude for e in effects]])
        matrix = jacobian(scene, parts(start)[0], effects, parts(start)[1:])[use] / sigma_mm[use, None]
        matrix = np.vstack([matrix, np.diag(1 / spread)])
        for _ in range(sweeps):
            now = parts(start)
            z = (values - scene.readings(now[0], effects, now[1:]))[use] / sigma_mm[use]
            start = start + solve(matrix, np.concatenate([z, (known - start) / spread]))
        now = parts(start)
        z = (values - scene.readings(now[0], effects, now[1:]))[use] / sigma_mm[use]
        self.base, self.amplitudes, self.effects = now[0], now[1:], effects
        self.z_rms = float(np.sqrt(np.mean(z ** 2)))

    def predict(self, scene):
        """Readings of another table (hold-out) of the same machine."""
        return scene.readings(self.base, self.effects, self.amplitudes)


class Projector:
    """Removes from whitened columns what the base parameters (with their priors) can absorb."""

    def __init__(self, scene, sigma_mm):
        self.use = sigma_mm > 0
        self.sigma = sigma_mm[self.use]
        self.count, self.extra = int(self.use.sum()), scene.base.size
        matrix = jacobian(scene, np.zeros(scene.base.size), (), ())[self.use] / self.sigma[:, None]
        matrix = np.vstack([matrix, np.diag(1 / scene.base.known_sigma)])
        matrix /= np.sqrt((matrix ** 2).sum(axis=0))
        left, size, _ = np.linalg.svd(matrix, full_matrices=False)
        self.basis = left[:, size > RANK * size[0]]

    def visible(self, column_mm):
        """Whitened column(s) less what the base absorbs; the last rows are the price paid in the priors."""
        z = (column_mm[self.use].T / self.sigma).T
        z = np.concatenate([z, np.zeros((self.extra, *z.shape[1:]))])
        return z - self.basis @ (self.basis.T @ z)

    def rms(self, column_mm):
        """Visible rms per reading, in sigma."""
        return float(np.sqrt((self.visible(column_mm) ** 2).sum() / self.count))
