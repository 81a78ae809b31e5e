"""Ten offsets of a level outline, 10 to 100 m: the level curves of a slope of 1:1. And the surface inside, beside a straight
skeleton."""

import json

import numpy as np

import exact
import shapes

DISTANCES = np.arange(10.0, 101.0, 10.0)
SCALE = 1_000_000  # whole numbers of Clipper2 to a metre
CHECKED = 2_000  # places of each curve, half of them vertices, half of them in the middle of edges


class Job:
    def __init__(self, n, inside):
        self.line = shapes.outline(n)
        self.sign = -1 if inside else 1
        self.segments = exact.segments_of(self.line, True, 1.0)

    def check(self, curves):
        """`curves`: for each distance a list of rings (m, 2), the first vertex repeated or not."""
        wrong = []
        for distance, rings in zip(DISTANCES, curves, strict=True):
            ends = [np.asarray(ring, dtype=float) for ring in rings]
            places = np.concatenate([p for ring in ends for p in (ring, (ring + np.roll(ring, -1, axis=0)) / 2)])
            some = np.random.default_rng(7).integers(0, len(places), CHECKED)
            wrong.append(shapes.Z - exact.falling(places[some], self.segments, 1.0) - distance)
        found = exact.errors(np.concatenate(wrong), 0.0)
        loops = sum(len(rings) for rings in curves)
        return found | ({} if loops == len(DISTANCES) else {"said": f"{loops} loops"})


def geos(n, inside):
    import shapely

    job = Job(n, inside)
    outline = shapely.Polygon(job.line[:, :2])

    def work():
        return [shapely.buffer(outline, job.sign * d, quad_segs=64) for d in DISTANCES]

    def check(polygons):
        rings = [[np.asarray(part.exterior.coords)[:-1] for part in shapely.get_parts(p)] for p in polygons]
        return job.check(rings)

    return work, check


def clipper2(n, inside):
    import pyclipr

    job = Job(n, inside)

    def work():
        curves = []
        for d in DISTANCES:
            offset = pyclipr.ClipperOffset()
            offset.scaleFactor = SCALE
            offset.arcTolerance = 0.001 * SCALE
            offset.addPath(job.line[:, :2], pyclipr.JoinType.Round, pyclipr.EndType.Polygon)
            curves.append(offset.execute(job.sign * d))
        return curves

    return work, job.check


def sfcgal_roof(n):
    from pysfcgal.geometry import Polygon

    job = Job(n, True)
    outline = Polygon([tuple(p) for p in job.line[:, :2].tolist()])

    def work():
        return outline.extrude_straight_skeleton(100.0)

    def check(solid):
        corners = {tuple(v) for face in _faces(solid.to_coordinates()) for v in face}
        corners = np.array([c for c in corners if len(c) == 3 and c[2] > 0])
        return exact.errors(corners[:, 2], shapes.Z - exact.falling(corners[:, :2], job.segments, 1.0))

    return work, check


def _faces(nested):
    """Rings of vertices in lists nested to any depth."""
    if nested and isinstance(nested[0][0], (int, float)):
        yield nested
    else:
        for inner in nested:
            yield from _faces(inner)


def slopegen(path, n, inside):
    job = Job(n, inside)

    def work():
        with open(path) as file:
            features = json.load(file)["features"]
        curves = [f["geometry"]["coordinates"] for f in features if f["properties"]["kind"] == "level_curve"]
        found = [[] for _ in DISTANCES]
        for curve in map(np.asarray, curves):
            distance = round((shapes.Z - curve[0, 2]) / 10) * 10
            if distance in DISTANCES:
                found[distance // 10 - 1].append(curve[:-1, :2])
        return found

    return work, job.check


def slopegen_roof(path, n):
    """The vertices of the mesh against the closed form."""
    job = Job(n, True)

    def work():
        with open(path) as file:
            return np.array([line.split()[1:4] for line in file if line.startswith("v ")], dtype=float)

    return work, lambda v: exact.errors(v[:, 2], exact.falling(v[:, :2], job.segments, 1.0))
