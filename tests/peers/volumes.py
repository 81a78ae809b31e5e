"""Cut and fill: between two meshes, and of a road on a terrain."""

import json

import numba
import numpy as np

import exact
import paths
import shapes

K = 0.5
NEAR = 20.0  # m from the road within which all its fill lies: at most 6 m high, 1:2


def _relative(got, wanted):
    """The greater of the relative errors."""
    return {"max": max(abs(g - w) / w for g, w in zip(got, wanted, strict=True)), "unit": "relative"}


class Job:
    """Volumes of the wedge are known; those of rough ground are what manifold3d finds near the origin."""

    def __init__(self, name, count, utm, reference):
        self.name, self.count, self.utm, self.reference = name, count, utm, reference

    def check(self, got):
        if self.name == "wedge":
            return _relative(got, shapes.WEDGE)
        if not paths.fresh(self.reference):
            return {}
        with open(self.reference) as file:
            return _relative(got, json.load(file))


def _manifold(vertices, triangles):
    import manifold3d

    return manifold3d.Manifold(manifold3d.Mesh64(vertices, triangles.astype(np.uint64)))


def manifold(**parameters):
    job = Job(**parameters)
    a, b = shapes.solids(job.name, job.count, job.utm)

    def work():
        design, existing = _manifold(*a), _manifold(*b)
        return (existing - design).volume(), (design - existing).volume()

    def check(got):
        if job.name != "wedge" and not job.utm:
            with open(job.reference, "w") as file:
                json.dump(got, file)
            return {"said": "the reference of the others"}
        return job.check(got)

    return work, check


def meshlib(**parameters):
    from meshlib import mrmeshnumpy, mrmeshpy

    job = Job(**parameters)
    solids = [(v, t.astype(np.int32)) for v, t in shapes.solids(job.name, job.count, job.utm)]

    def work():
        design, existing = (mrmeshnumpy.meshFromFacesVerts(t, v) for v, t in solids)
        got = []
        for a, b in ((existing, design), (design, existing)):
            result = mrmeshpy.boolean(a, b, mrmeshpy.BooleanOperation.DifferenceAB)
            if not result.valid():
                raise RuntimeError(result.errorString)
            got.append(result.mesh.volume())
        return got

    return work, job.check


@numba.njit(cache=True)
def _rasterise(vertices, triangles, x0, y0, cell, columns, rows):
    """Heights of a TIN at the centres of cells; NaN beside it."""
    out = np.full((rows, columns), np.nan)
    for t in range(len(triangles)):
        a, b, c = vertices[triangles[t, 0]], vertices[triangles[t, 1]], vertices[triangles[t, 2]]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        left, right = min(a[0], b[0], c[0]), max(a[0], b[0], c[0])
        low, high = min(a[1], b[1], c[1]), max(a[1], b[1], c[1])
        first = max(int(np.ceil((left - x0) / cell - 0.5)), 0)
        last = min(int(np.floor((right - x0) / cell - 0.5)), columns - 1)
        for j in range(max(int(np.ceil((low - y0) / cell - 0.5)), 0), min(int(np.floor((high - y0) / cell - 0.5)), rows - 1) + 1):
            y = y0 + (j + 0.5) * cell
            for i in range(first, last + 1):
                x = x0 + (i + 0.5) * cell
                v = (x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])
                w = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
                if v >= 0 and w >= 0 and v + w <= area:
                    out[j, i] = a[2] + (v * (b[2] - a[2]) + w * (c[2] - a[2])) / area
    return out


def _compile():
    _rasterise(np.eye(3), np.array([[0, 1, 2]], np.int32), 0.0, 0.0, 1.0, 2, 2)


def raster(cell, **parameters):
    job = Job(**parameters)
    surfaces = shapes.pair(job.name, job.count, job.utm)
    x0, y0 = shapes.UTM if job.utm else (0.0, 0.0)
    cells = round(shapes.SIDE / cell)
    _compile()

    def work():
        design, existing = (_rasterise(v, t, x0, y0, cell, cells, cells) for v, t in surfaces)
        over = (design - existing)[np.isfinite(design) & np.isfinite(existing)]
        return -np.minimum(over, 0).sum() * cell**2, np.maximum(over, 0).sum() * cell**2

    return work, job.check


def slopegen(path, **parameters):
    job = Job(**parameters)

    def work():
        with open(path) as file:
            volumes = json.load(file)["volumes"]
        return volumes["cut"], volumes["fill"]

    return work, job.check


def _fill(ground, line, cell, blocks=1):
    """Fill under the slopes of a road: cells of the box of the road, in `blocks` by `blocks` pieces; those of which nothing can
    be near the road are passed over where there are several."""
    vertices, triangles = ground
    segments = exact.segments_of(line, False, K)
    x0, y0 = np.floor(line[:, :2].min(axis=0) - NEAR)
    x1, y1 = np.ceil(line[:, :2].max(axis=0) + NEAR)
    side = np.ceil(max(x1 - x0, y1 - y0) / blocks)  # whole cells
    total = 0.0
    for bx in range(blocks):
        for by in range(blocks):
            left, low = x0 + bx * side, y0 + by * side
            columns = int(np.ceil(min(side, x1 - left) / cell))
            rows = int(np.ceil(min(side, y1 - low) / cell))
            if columns <= 0 or rows <= 0:
                continue
            near, known = segments, triangles
            if blocks > 1:
                middle = np.array([left + side / 2, low + side / 2])
                away = np.abs(segments[:, :2] - middle).max(axis=1)
                # A foot lies within 12 m of any place with fill; segments are shorter than 10 m.
                near = np.ascontiguousarray(segments[away <= side / 2 + 2 * NEAR])
                if len(near) == 0:
                    continue
                corner = vertices[triangles[:, 0], :2]
                known = triangles[np.abs(corner - middle).max(axis=1) <= side / 2 + NEAR]
            heights = _rasterise(vertices, known, left, low, cell, columns, rows)
            i, j = np.meshgrid(np.arange(columns), np.arange(rows))
            places = np.column_stack([(left + (i.ravel() + 0.5) * cell), (low + (j.ravel() + 0.5) * cell)])
            over = exact.falling(places, near, K) - heights.ravel()
            total += np.maximum(over[np.isfinite(over)], 0).sum() * cell**2
    return total


def _reference(count, n, path):
    """The fill with cells of a quarter of a metre, kept in a file. Cells of 0.5 m and of 0.125 m differ by 2e-8 of it."""
    if not paths.fresh(path):
        with open(path, "w") as file:
            json.dump([_fill(shapes.ground(count), shapes.road(n), 0.25, blocks=40)], file)
    with open(path) as file:
        return json.load(file)


def whole_job(ply, count, n, cell, reference):
    line = shapes.road(n)
    _compile()
    exact.falling(np.zeros((1, 2)), exact.segments_of(line, False, K), K)
    wanted = _reference(count, n, reference)
    return (lambda: [_fill(shapes.read_ply(ply), line, cell)]), lambda got: _relative(got, wanted)


def slopegen_whole(path, count, n, reference):
    wanted = _reference(count, n, reference)

    def work():
        with open(path) as file:
            return [json.load(file)["volumes"]["fill"]]

    return work, lambda got: _relative(got, wanted)
