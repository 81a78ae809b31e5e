"""Inputs from closed formulas: outlines, a road, terrains. The same arrays for peers, the same digits in files for slopegen."""

import numpy as np

Z = 200.0  # elevation of level outlines, m
BOX = 1000.0  # heights are asked for on the square from -BOX to BOX
SIDE = 2000.0  # side of the square under terrains, m
BASE = -100.0  # where solids for mesh booleans end, m
# A shift that rounds nothing: coordinates are multiples of GRAIN, and have 43 bits after it.
UTM = (524_288.0, 5_242_880.0)
GRAIN = 2.0**-20


def outline(n, sloping=False):
    """A smooth ring of radius 410 to 590 m; sloping: up and down by 31 m, gradients below 0.19. (n, 3)"""
    t = 2 * np.pi * np.arange(n) / n
    r = 500 * (1 + 0.12 * np.sin(3 * t + 0.4) + 0.05 * np.sin(7 * t + 1.1) + 0.01 * np.sin(13 * t))
    z = Z + (25 * np.sin(2 * t + 0.3) + 6 * np.sin(5 * t) if sloping else 0 * t)
    return np.column_stack([r * np.cos(t), r * np.sin(t), z])


def gentle(x, y):
    """Ground under the road: gradients below 0.15, so that what a slope of 1:2 fills hangs together."""
    return 100 + 12 * np.sin(x / 180) * np.cos(y / 220) + 3 * np.sin(x / 45 + 1) * np.sin(y / 60)


def road(n):
    """A winding road of 4.5 km over the ground `gentle`, 2 to 6 m above it; bends of 40 m and more. (n, 3)"""
    t = np.linspace(0, 1, n)
    x = 150 + 1700 * t
    y = 1000 + 450 * np.sin(4 * np.pi * t)
    return np.column_stack([x, y, gentle(x, y) + 4 + 2 * np.sin(23 * t)])


def hills(x, y, phase):
    """Hills of several sizes."""
    z = np.full_like(x, 100.0)
    for length, height in [(200, 30), (70, 8), (21, 2), (6, 0.5)]:
        z += height * np.sin(x / length + phase) * np.cos(y / length - 0.7 * phase)
    return z


def mesh(columns, rows, seed, height):
    """Triangles over a square: nodes of a lattice moved by up to a fifth of its spacing, squares cut along either diagonal at
    random. Returns vertices (n, 3), triangles (m, 3), counter-clockwise from above."""
    random = np.random.default_rng(seed)
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    du, dv = random.uniform(-0.2, 0.2, (2, rows, columns))
    u = i + np.where((i > 0) & (i < columns - 1), du, 0)
    v = j + np.where((j > 0) & (j < rows - 1), dv, 0)
    x = np.round(u * (SIDE / (columns - 1)) / GRAIN) * GRAIN
    y = np.round(v * (SIDE / (rows - 1)) / GRAIN) * GRAIN
    z = np.round(height(x, y) / GRAIN * 16) * GRAIN / 16  # the wedge is exact, too
    at = (j * columns + i)[:-1, :-1].ravel()
    a, b, c, d = at, at + 1, at + columns + 1, at + columns
    one = random.integers(0, 2, at.size).astype(bool)[:, None]
    first = np.where(one, np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    second = np.where(one, np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    return np.column_stack([x.ravel(), y.ravel(), z.ravel()]), np.concatenate([first, second]).astype(np.int32)


def pair(name, count, utm=False):
    """Design and existing surface of about `count` vertices each, their triangles unrelated. `rough`: hills against other hills;
    `wedge`: a level plane against one that rises 1 in 16 from x = 500."""
    n = int(np.sqrt(count))
    heights = {
        "rough": (lambda x, y: hills(x, y, 0.0), lambda x, y: hills(x, y, 1.3)),
        "wedge": (lambda x, y: np.full_like(x, 100.0), lambda x, y: 100 + (x - 500) / 16),
    }[name]
    meshes = [mesh(n, n, 1, heights[0]), mesh(n + 3, n - 3, 2, heights[1])]
    if utm:
        meshes = [(v + [*UTM, 0.0], t) for v, t in meshes]
    return meshes


# Cut and fill of the wedge: triangles of 1500 m and 500 m, 2000 m long.
WEDGE = (SIDE * 1500**2 / 2 / 16, SIDE * 500**2 / 2 / 16)


def ground(count):
    """The terrain of the whole job and of reading."""
    n = int(np.sqrt(count))
    return mesh(n, n, 3, gentle)


def solid(vertices, triangles, columns, rows):
    """The terrain closed by walls and a floor at BASE, for mesh booleans."""
    index = np.arange(columns * rows).reshape(rows, columns)
    rim = np.concatenate([index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]])
    low = len(vertices) + np.arange(len(rim))
    centre = len(vertices) + len(rim)
    floor = vertices[rim] * [1, 1, 0] + [0, 0, BASE]
    after, low_after = np.roll(rim, -1), np.roll(low, -1)
    walls = [np.column_stack([low, low_after, after]), np.column_stack([low, after, rim])]
    bottom = np.column_stack([low_after, low, np.full(len(rim), centre)])
    middle = (vertices[index[0, 0]] + vertices[index[-1, -1]]) / 2
    all_vertices = np.concatenate([vertices, floor, [[middle[0], middle[1], BASE]]])
    return all_vertices, np.concatenate([triangles, *walls, bottom]).astype(np.int32)


def solids(name, count, utm):
    n = int(np.sqrt(count))
    (a, ta), (b, tb) = pair(name, count, utm)
    return solid(a, ta, n, n), solid(b, tb, n + 3, n - 3)


def write_line(path, line):
    with open(path, "w") as file:
        file.write("x,y,z\n")
        file.writelines(f"{x!r},{y!r},{z!r}\n" for x, y, z in line.tolist())


def write_ply(path, vertices, triangles):
    faces = np.empty(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    with open(path, "wb") as file:
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        head += "".join(f"property double {c}\n" for c in "xyz")
        head += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
        file.write(head.encode())
        file.write(vertices.astype("<f8").tobytes())
        file.write(faces.tobytes())


def read_ply(path):
    """What `write_ply` wrote."""
    with open(path, "rb") as file:
        data = file.read()
    head, _, _ = data.partition(b"end_header\n")
    n, m = (int(line.split()[-1]) for line in head.decode().splitlines() if line.startswith("element"))
    start = len(head) + len("end_header\n")
    vertices = np.frombuffer(data, "<f8", 3 * n, start).reshape(n, 3)
    faces = np.frombuffer(data, [("n", "u1"), ("v", "<i4", 3)], m, start + 24 * n)
    return vertices, faces["v"]


def write_obj(path, vertices, triangles):
    with open(path, "w") as file:
        file.writelines(f"v {x:.4f} {y:.4f} {z:.4f}\n" for x, y, z in vertices.tolist())
        file.writelines(f"f {a} {b} {c}\n" for a, b, c in (triangles + 1).tolist())


def write(path, kind, **parameters):
    """One input file, by what it is."""
    if kind in ("outline", "road"):
        write_line(path, outline(**parameters) if kind == "outline" else road(**parameters))
    elif kind == "pair":
        which = parameters.pop("which")
        write_ply(path, *pair(**parameters)[which])
    elif kind == "ground":
        (write_obj if path.endswith(".obj") else write_ply)(path, *ground(**parameters))
