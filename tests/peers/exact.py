"""The closed form, written down once more: for every point, the highest of the heights every segment gives. Nothing of slopegen
is used here. (docs/theory.md, section 2: height = z + g s' - k |x - p(s')|, s' being where the ruling through x leaves the
segment.)"""

import numba
import numpy as np


@numba.njit(parallel=True, cache=True)
def _falling(points, segments, k):
    out = np.empty(len(points))
    for i in numba.prange(len(points)):
        best = -np.inf
        for s in range(len(segments)):
            dx, dy = points[i, 0] - segments[s, 0], points[i, 1] - segments[s, 1]
            along = dx * segments[s, 3] + dy * segments[s, 4]
            across = abs(dx * segments[s, 4] - dy * segments[s, 3])
            foot = min(max(along + across * segments[s, 7], 0.0), segments[s, 5])
            height = segments[s, 2] + segments[s, 6] * foot - k * np.sqrt((along - foot) ** 2 + across**2)
            best = max(best, height)
        out[i] = best
    return out


def segments_of(line, closed, k):
    """Per segment: beginning, unit direction, length, gradient, and how far along the ruling leans per length across."""
    a = line if closed else line[:-1]
    b = np.roll(line, -1, axis=0) if closed else line[1:]
    d = b - a
    length = np.hypot(d[:, 0], d[:, 1])
    gradient = d[:, 2] / length
    lean = gradient / np.sqrt(k**2 - gradient**2)
    return np.ascontiguousarray(np.column_stack([a, d[:, 0] / length, d[:, 1] / length, length, gradient, lean]))


def falling(points, segments, k):
    """Heights of the falling sheet of slope k at points (n, 2)."""
    return _falling(np.ascontiguousarray(points, dtype=float), segments, k)


def errors(got, exact, unit="m"):
    difference = np.asarray(got) - exact
    return {"rms": float(np.sqrt(np.mean(difference**2))), "max": float(np.max(np.abs(difference))), "unit": unit}
