"""What is compared: for each job one command of slopegen and its peers."""

from dataclasses import dataclass, field

import paths


@dataclass
class Peer:
    label: str
    package: str  # its version goes into the table; "" where there is none
    job: str  # module:function, see worker.py
    parameters: dict
    said: str = ""  # what has to be known about the row
    readme: bool = False
    program: list = field(default_factory=list)  # a whole process in place of a job of ours


@dataclass
class Case:
    name: str
    title: str
    inputs: dict  # file name: (kind, parameters), see shapes.write
    command: str  # of slopegen; IN:name is an input, OUT a fresh output
    suffix: str  # of OUT
    check: tuple  # job and parameters that look at what slopegen wrote; () for none
    peers: list
    said: str = ""
    quick: bool = False
    readme: bool = False


# Label, package, function, remark, whether it stands in the README.
IGL = ("libigl, closest points", "libigl", "libigl", "level lines only", True)
MESHLIB = ("MeshLib, distance map", "meshlib", "meshlib", "level lines only; single precision", True)
SCIPY = ("scipy, distance transform", "scipy", "scipy_edt", "level lines only; half a cell taken off", True)
SKFMM = (
    "scikit-fmm, fast marching of order 2",
    "scikit-fmm",
    "scikit_fmm",
    "level lines only; starts from exact distances within 4 cells (not timed)",
    True,
)
PYKONAL = (
    "pykonal, fast marching",
    "pykonal",
    "pykonal",
    "starts from exact heights within 1.5 cells (not timed)",
    True,
)
BRUTE = ("numba, closed form of all segments", "numba", "numba_brute", "what the others are compared with", True)
GEOS = ("GEOS (shapely), 64 segments to a quarter", "shapely", "geos", "level lines only; simplifies its input", True)
CLIPPER = ("Clipper2 (pyclipr), arcs within 1 mm", "pyclipr", "clipper2", "level lines only", True)
SFCGAL = (
    "SFCGAL, extruded straight skeleton",
    "PySFCGAL",
    "sfcgal_roof",
    "another surface: mitred at convex corners; level rings only",
    True,
)
MANIFOLD = ("manifold3d, two booleans", "manifold3d", "manifold", "", True)
MESHLIB_VOLUME = ("MeshLib, two booleans", "meshlib", "meshlib", "single precision", True)


def peers(module, parameters, listed):
    return [Peer(label, package, f"{module}:{job}", parameters, *more) for label, package, job, *more in listed]


def heights(n, cells, sloping, listed, **more):
    kind = "sloping" if sloping else "level"
    line = f"{kind}_{n}.csv"
    parameters = {"n": n, "cells": cells, "sloping": sloping}
    return Case(
        f"heights-{kind}-{n}-{cells}",
        f"heights, {kind} ring of {n:,} vertices, {cells + 1:,}² nodes",
        {line: ("outline", {"n": n, "sloping": sloping})},
        f"sample IN:{line} --closed --slope 1:2 --raster OUT --cell {2000 / cells:g} --box=-1000,-1000,1000,1000",
        ".asc",
        ("heights:slopegen", parameters),
        peers("heights", parameters, listed),
        **more,
    )


def offsets(n, inside, listed, tolerance=None, **more):
    side = "inside" if inside else "outside"
    line = f"level_{n}.csv"
    levels = ",".join(str(200 - d) for d in range(10, 101, 10))
    # A little further than the last offset: where the slopes end there is the boundary, not a level curve.
    command = f"build IN:{line} --closed --side {side} --slope 1:1 --distance 101 --level {levels} -o OUT.ply --lines OUT --quiet"
    parameters = {"n": n, "inside": inside}
    return Case(
        f"offsets-{side}-{n}" + ("-fine" if tolerance else ""),
        f"ten offsets {side}, ring of {n:,} vertices" + (f", tolerance {tolerance}" if tolerance else ""),
        {line: ("outline", {"n": n})},
        command + (f" --tolerance {tolerance}" if tolerance else ""),
        ".geojson",
        ("offsets:slopegen", parameters),
        peers("offsets", parameters, listed),
        "with the mesh",
        **more,
    )


def roof(n, **more):
    line = f"level_{n}.csv"
    return Case(
        f"roof-{n}",
        f"surface inside a level ring of {n:,} vertices",
        {line: ("outline", {"n": n})},
        f"build IN:{line} --closed --side inside --slope 1:1 --distance 100 -o OUT --quiet",
        ".obj",
        ("offsets:slopegen_roof", {"n": n}),
        peers("offsets", {"n": n}, [SFCGAL]),
        **more,
    )


def volumes(name, count, utm, listed, cells=(), **more):
    kind = f"{name}_{count}" + ("_utm" if utm else "")
    pair = {"name": name, "count": count, "utm": utm}
    parameters = pair | {"reference": paths.inputs(f"{name}_{count}.reference.json")}
    a, b = f"{kind}_a.ply", f"{kind}_b.ply"
    all_peers = peers("volumes", parameters, listed)
    for cell in cells:
        label = f"numba, rasters of both, cells of {cell} m"
        all_peers.append(Peer(label, "numba", "volumes:raster", parameters | {"cell": cell}, readme=cell == 1))
    size = "a million" if count == 500_000 else f"{2 * count:,}"
    return Case(
        f"volumes-{kind.replace('_', '-')}",
        f"cut and fill of two meshes of {size} triangles, {name}" + (", UTM coordinates" if utm else ""),
        {a: ("pair", pair | {"which": 0}), b: ("pair", pair | {"which": 1})},
        f"volume IN:{a} IN:{b} --report OUT --quiet",
        ".json",
        ("volumes:slopegen", parameters),
        all_peers,
        **more,
    )


def whole(count, n, cells, **more):
    line, ground = f"road_{n}.csv", f"ground_{count}.ply"
    parameters = {"count": count, "n": n, "reference": paths.inputs(f"road_{n}_{count}.reference.json")}
    all_peers = []
    for cell in cells:
        label = f"numba, closed form and raster of the ground, cells of {cell} m"
        with_cell = parameters | {"ply": paths.inputs(ground), "cell": cell}
        all_peers.append(Peer(label, "numba", "volumes:whole_job", with_cell, "fill only; no mesh, no line", cell == 2))
    return Case(
        f"whole-{count}",
        f"fill of a sloping road of {n:,} vertices on ground of {2 * count:,} triangles, from files",
        {line: ("road", {"n": n}), ground: ("ground", {"count": count})},
        f"build IN:{line} --slope 1:2 --direction down --terrain IN:{ground} -o OUT.ply --report OUT --quiet",
        ".json",
        ("volumes:slopegen_whole", parameters),
        all_peers,
        "with mesh, daylight line and report",
        **more,
    )


def reading(count, suffix, listed, **more):
    ground = f"ground_{count}.{suffix}"
    parameters = {"path": paths.inputs(ground), "count": count}
    return Case(
        f"reading-{suffix}-{count}",
        f"reading {suffix.upper()}, {2 * count:,} triangles",
        {ground: ("ground", {"count": count})},
        f"volume IN:{ground} --to-elevation 100 --report OUT --quiet",
        ".json",
        (),
        peers("reading", parameters, listed),
        "reading, checksum, checks, volume to a level",
        **more,
    )


def all_cases(tobj):
    """`tobj` is the program that reads with tobj, or a word why there is none."""
    alone = ("tobj 4.0.5 (use_f64), whole process", "", "", "reading only", False, tobj)
    obj = [alone] + [(name, name, name, "reading only") for name in ("trimesh", "libigl")]
    ply = [
        ("numpy, frombuffer: a floor", "numpy", "numpy_ply", "reading only"),
        ("trimesh", "trimesh", "trimesh", "reading only"),
    ]
    return [
        heights(1_000, 500, False, [IGL, MESHLIB, SCIPY, SKFMM], quick=True),
        heights(1_000, 1_000, False, [IGL, MESHLIB, SCIPY, SKFMM], readme=True),
        heights(1_000, 2_000, False, [SCIPY, SKFMM]),
        heights(10_000, 1_000, False, [IGL, MESHLIB]),
        heights(1_000, 500, True, [BRUTE, PYKONAL], quick=True),
        heights(1_000, 1_000, True, [BRUTE, PYKONAL], readme=True),
        heights(1_000, 2_000, True, [PYKONAL]),
        heights(10_000, 1_000, True, [BRUTE], readme=True),
        offsets(1_000, False, [GEOS, CLIPPER], quick=True),
        offsets(1_000, True, [GEOS, CLIPPER]),
        offsets(10_000, False, [GEOS, CLIPPER], readme=True),
        offsets(10_000, False, [GEOS], tolerance="0.00001"),
        offsets(10_000, True, [GEOS, CLIPPER]),
        offsets(100_000, False, [GEOS]),
        roof(100, quick=True),
        roof(1_000, readme=True),
        volumes("rough", 50_000, False, [MANIFOLD, MESHLIB_VOLUME], cells=(4, 2, 1), quick=True),
        volumes("rough", 50_000, True, [MANIFOLD, MESHLIB_VOLUME], quick=True),
        volumes("wedge", 50_000, False, [MANIFOLD, MESHLIB_VOLUME], quick=True),
        volumes("rough", 500_000, False, [MANIFOLD, MESHLIB_VOLUME], cells=(4, 2, 1), readme=True),
        volumes("rough", 500_000, True, [MANIFOLD, MESHLIB_VOLUME], readme=True),
        whole(50_000, 1_000, (4, 2), quick=True),
        whole(1_000_000, 1_000, (4, 2, 1), readme=True),
        reading(50_000, "obj", obj, quick=True),
        reading(1_000_000, "obj", obj),
        reading(1_000_000, "ply", ply),
    ]
