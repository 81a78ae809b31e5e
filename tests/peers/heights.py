"""Heights of a slope of 1:2 on the nodes of a grid."""

import numpy as np

import exact
import shapes

K = 0.5
CHECKED = 20_000  # nodes on which heights are compared, at random


def _nodes(cells):
    """Nodes of a square grid, from the south-west, and their distance."""
    axis = np.linspace(-shapes.BOX, shapes.BOX, cells + 1)
    x, y = np.meshgrid(axis, axis)
    return np.column_stack([x.ravel(), y.ravel()]), axis[1] - axis[0]


class Job:
    def __init__(self, n, cells, sloping):
        self.line = shapes.outline(n, sloping)
        self.nodes, self.cell = _nodes(cells)
        self.shape = (cells + 1, cells + 1)
        self.segments = exact.segments_of(self.line, True, K)

    def check(self, heights):
        some = np.random.default_rng(7).integers(0, len(self.nodes), CHECKED)
        return exact.errors(np.ravel(heights)[some], exact.falling(self.nodes[some], self.segments, K))

    def inside(self):
        """Nodes inside the ring: its radius is a function of the angle."""
        corners = np.arctan2(self.line[:, 1], self.line[:, 0]) % (2 * np.pi)
        order = np.argsort(corners)
        closed = self.line[np.append(order, order[0])]
        angle = np.arctan2(self.nodes[:, 1], self.nodes[:, 0]) % (2 * np.pi)
        at = (np.searchsorted(corners[order], angle, side="right") - 1) % len(order)
        a, b = closed[at, :2], closed[at + 1, :2]
        d, p = b - a, self.nodes - a
        return (d[:, 0] * p[:, 1] - d[:, 1] * p[:, 0] > 0).reshape(self.shape)

    def band(self, width):
        """Exact heights at the nodes nearer to the line than `width` cells; what a front starts from."""
        from scipy.ndimage import distance_transform_edt

        mask = self.inside()
        near = np.ravel(np.minimum(*(np.where(m, distance_transform_edt(m), np.inf) for m in (mask, ~mask))) <= width)
        return near, exact.falling(self.nodes[near], self.segments, K)


def numba_brute(**parameters):
    job = Job(**parameters)
    exact.falling(job.nodes[:10], job.segments, K)
    return lambda: exact.falling(job.nodes, job.segments, K), job.check


def libigl(**parameters):
    import igl

    job = Job(**parameters)
    n = len(job.line)
    points = np.column_stack([job.nodes, np.zeros(len(job.nodes))])
    vertices = job.line * [1, 1, 0]
    edges = np.column_stack([np.arange(n), np.roll(np.arange(n), -1)]).astype(np.int64)

    def work():
        return shapes.Z - K * np.sqrt(igl.point_mesh_squared_distance(points, vertices, edges)[0])

    return work, job.check


def meshlib(**parameters):
    from meshlib import mrmeshpy

    job = Job(**parameters)
    contour = mrmeshpy.std_vector_Vector2_float()
    for x, y, _ in [*job.line.tolist(), job.line[0].tolist()]:
        contour.append(mrmeshpy.Vector2f(x, y))
    contours = mrmeshpy.std_vector_std_vector_Vector2_float()
    contours.append(contour)
    corner = -shapes.BOX - job.cell / 2  # heights stand in the middle of pixels
    side = job.shape[0] * job.cell
    size = mrmeshpy.Vector2i(job.shape[1], job.shape[0])
    place = mrmeshpy.ContourToDistanceMapParams(size, mrmeshpy.Vector2f(corner, corner), mrmeshpy.Vector2f(side, side), False)

    def work():
        return mrmeshpy.distanceMapFromContours(mrmeshpy.Polyline2(contours), place)

    def check(distances):
        pixels = [distances.getValue(i) for i in range(distances.numPoints())]
        return job.check(shapes.Z - K * np.array(pixels))

    return work, check


def scipy_edt(**parameters):
    from scipy.ndimage import distance_transform_edt

    job = Job(**parameters)
    mask = job.inside()

    def work():
        cells = distance_transform_edt(mask) + distance_transform_edt(~mask)
        return shapes.Z - K * job.cell * (cells - 0.5)

    return work, job.check


def scikit_fmm(**parameters):
    import skfmm

    job = Job(**parameters)
    mask = job.inside()
    near, heights = job.band(4)
    phi = np.where(mask, 10 * job.cell, -10 * job.cell)
    phi.ravel()[near] = np.where(mask.ravel()[near], 1, -1) * (shapes.Z - heights) / K
    return lambda: shapes.Z - K * np.abs(skfmm.distance(phi, dx=float(job.cell), order=2)), job.check


def pykonal(**parameters):
    import pykonal as eikonal

    job = Job(**parameters)
    near, heights = job.band(1.5)
    top = heights.max()
    seeds = np.argwhere(near.reshape(job.shape))

    def again():
        solver = eikonal.EikonalSolver(coord_sys="cartesian")
        solver.velocity.min_coords = -shapes.BOX, -shapes.BOX, 0
        solver.velocity.node_intervals = job.cell, job.cell, 1
        solver.velocity.npts = (*job.shape, 1)
        solver.velocity.values = np.full((*job.shape, 1), 1 / K)
        for (row, column), height in zip(seeds.tolist(), heights.tolist(), strict=True):
            solver.traveltime.values[row, column, 0] = top - height
            solver.unknown[row, column, 0] = False
            solver.trial.push(row, column, 0)
        work.solver = solver

    def work():
        work.solver.solve()
        return work.solver

    def check(solver):
        return job.check(top - np.asarray(solver.traveltime.values)[:, :, 0])

    work.again = again
    return work, check


def slopegen(path, **parameters):
    job = Job(**parameters)

    def work():
        with open(path) as file:
            values = file.read().split("\n", 6)[-1]
        return np.fromstring(values, sep=" ").reshape(job.shape)[::-1]

    return work, job.check
