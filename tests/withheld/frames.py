"""Batched exact 4x4 transforms (float64). Lengths mm, angles rad, right-hand rule.

Every function takes arrays whose first dimension is the reading (n) and returns (n, 4, 4).
"""
import numpy as np


def translation(offset_mm):
    """4x4 shifts by offset_mm (n, 3)."""
    offset_mm = np.asarray(offset_mm, float)
    out = np.zeros((offset_mm.shape[0], 4, 4))
    out[:, range(4), range(4)] = 1.0
    out[:, :3, 3] = offset_mm
    return out


def rotation_about(rotvec_rad):
    """4x4 exact rotations exp([rotvec]x) for rotation vectors (n, 3)."""
    rotvec_rad = np.asarray(rotvec_rad, float)
    angle = np.sqrt(np.einsum("ij,ij->i", rotvec_rad, rotvec_rad))
    small = angle < 1e-12
    safe = np.where(small, 1.0, angle)
    first = np.where(small, 1.0, np.sin(safe) / safe)
    second = np.where(small, 0.5, 2.0 * (np.sin(safe / 2.0) / safe) ** 2)
    cross = np.zeros((rotvec_rad.shape[0], 3, 3))
    x, y, z = rotvec_rad.T
    cross[:, 0, 1], cross[:, 0, 2] = -z, y
    cross[:, 1, 0], cross[:, 1, 2] = z, -x
    cross[:, 2, 0], cross[:, 2, 1] = -y, x
    out = np.zeros((rotvec_rad.shape[0], 4, 4))
    out[:, 3, 3] = 1.0
    out[:, :3, :3] = np.eye(3) + first[:, None, None] * cross + second[:, None, None] * (cross @ cross)
    return out


def apply(transform, point_mm):
    """Points (n, 3) or (3,) moved by transforms (n, 4, 4)."""
    point_mm = np.broadcast_to(point_mm, (transform.shape[0], 3))
    return np.einsum("nij,nj->ni", transform[:, :3, :3], point_mm) + transform[:, :3, 3]


def turn(transform, vector):
    """Directions (n, 3) or (3,) turned by the rotation part of transforms (n, 4, 4)."""
    vector = np.broadcast_to(vector, (transform.shape[0], 3))
    return np.einsum("nij,nj->ni", transform[:, :3, :3], vector)
