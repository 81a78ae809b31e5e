"""What is compared: for each job one command of slopegen and its peers."""

from dataclasses import dataclass, field

import paths


@dataclass
class Peer:
    label: str
    package: str  # its version goes into the table; "" where the tool is the script itself
    job: str  # module:function
    parameters: dict
    said: str = ""  # what has to be known about the row
    readme: bool = False
    program: list = field(default_factory=list)  # a whole process in place of a job of ours


@dataclass
class Case:
    name: str
    title: str
    inputs: dict  # file name: (kind, parameters), see shapes.write
    command: list  # of slopegen; {name} is an input, {out} a fresh output
    suffix: str  # of {out}
    check: tuple  # module:function, parameters; gets path=, report= by the first word of the key
    peers: list
    said: str = ""
    quick: bool = False
    readme: bool = False


EDT = "distance to cells, half a cell taken off"
FMM = "level lines only; starts from exact distances within 4 cells (not timed)"
KONAL = "starts from exact heights within 1.5 cells (not timed)"
SINGLE = "single precision"
WHOLE = "fill only; no mesh, no line"


def heights(n, cells, sloping, peers, **more):
    parameters = {"n": n, "cells": cells, "sloping": sloping}
    kind = "sloping" if sloping else "level"
    line = f"{kind}_{n}.csv"
    box = "-1000,-1000,1000,1000"
    command = ["sample", f"{{{line}}}", "--closed", "--slope", "1:2", "--raster", "{out}", "--cell", f"{2000 / cells:g}", f"--box={box}"]
    listed = [
        Peer(label, package, f"heights:{job}", parameters, said, readme)
        for label, package, job, said, readme in peers
    ]
    title = f"heights, {kind} ring of {n:,} vertices, {cells + 1:,}² nodes"
    inputs = {line: ("outline", {"n": n, "sloping": sloping})}
    return Case(f"heights-{kind}-{n}-{cells}", title, inputs, command, ".asc", ("heights:slopegen", "path", parameters), listed, **more)


def offsets(n, inside, peers, more_tolerance=None, **more):
    side = "inside" if inside else "outside"
    line = f"level_{n}.csv"
    levels = ",".join(str(200 - d) for d in range(10, 101, 10))
    command = ["build", f"{{{line}}}", "--closed", "--side", side, "--slope", "1:1", "--direction", "down", "--distance", "101"]
    command += ["--level", levels, "-o", "{out}.ply", "--lines", "{out}", "--quiet"]
    if more_tolerance:
        command += ["--tolerance", more_tolerance]
    parameters = {"n": n, "inside": inside}
    title = f"ten offsets {side}, ring of {n:,} vertices" + (f", tolerance {more_tolerance}" if more_tolerance else "")
    listed = [
        Peer(label, package, f"offsets:{job}", parameters, said, readme) for label, package, job, said, readme in peers
    ]
    name = f"offsets-{side}-{n}" + ("-fine" if more_tolerance else "")
    inputs = {line: ("outline", {"n": n})}
    return Case(name, title, inputs, command, ".geojson", ("offsets:slopegen", "path", parameters), listed, **more)


def roof(n, **more):
    line = f"level_{n}.csv"
    command = ["build", f"{{{line}}}", "--closed", "--side", "inside", "--slope", "1:1", "--direction", "down", "--distance", "100"]
    command += ["-o", "{out}", "--quiet"]
    said = "another surface: mitred at convex corners; level rings only"
    peers = [Peer("SFCGAL, extruded straight skeleton", "PySFCGAL", "offsets:sfcgal_roof", {"n": n}, said, True)]
    title = f"surface inside a level ring of {n:,} vertices"
    inputs = {line: ("outline", {"n": n})}
    return Case(f"roof-{n}", title, inputs, command, ".obj", ("offsets:slopegen_roof", "path", {"n": n}), peers, **more)


def volumes(name, count, utm, peers, **more):
    kind = f"{name}_{count}" + ("_utm" if utm else "")
    parameters = {"name": name, "count": count, "utm": utm, "reference": paths.inputs(f"{name}_{count}.reference.json")}
    files = {f"{kind}_{which}.ply": ("pair", {"name": name, "count": count, "utm": utm, "which": i}) for i, which in enumerate("ab")}
    command = ["volume", *(f"{{{file}}}" for file in files), "--report", "{out}", "--quiet"]
    listed = [
        Peer(label, package, f"volumes:{job}", parameters | extra, said, readme)
        for label, package, job, extra, said, readme in peers
    ]
    size = f"{2 * count // 1_000_000} million" if count >= 500_000 else f"{2 * count:,}"
    title = f"cut and fill of two meshes of {size} triangles, {name}" + (", UTM coordinates" if utm else "")
    return Case(f"volumes-{kind.replace('_', '-')}", title, files, command, ".json", ("volumes:slopegen", "report", parameters), listed, **more)


def whole(count, n, cells, **more):
    line, ground = f"road_{n}.csv", f"ground_{count}.ply"
    reference = paths.inputs(f"road_{n}_{count}.reference.json")
    parameters = {"count": count, "n": n, "reference": reference}
    command = ["build", f"{{{line}}}", "--slope", "1:2", "--direction", "down", "--terrain", f"{{{ground}}}"]
    command += ["-o", "{out}.ply", "--report", "{out}", "--quiet"]
    peers = [
        Peer(
            f"numba: closed form + raster of the ground, cells of {cell:g} m",
            "numba",
            "volumes:whole_job",
            parameters | {"ply": paths.inputs(ground), "cell": cell},
            WHOLE,
            cell == 2,
        )
        for cell in cells
    ]
    inputs = {line: ("road", {"n": n}), ground: ("ground", {"count": count})}
    title = f"fill of a sloping road of {n:,} vertices on ground of {2 * count:,} triangles, from files"
    said = "with mesh, daylight line and report"
    return Case(
        f"whole-{count}", title, inputs, command, ".json", ("volumes:slopegen_whole", "report", parameters), peers, said, **more
    )


def reading(count, suffix, peers, **more):
    ground = f"ground_{count}.{suffix}"
    command = ["volume", f"{{{ground}}}", "--to-elevation", "100", "--report", "{out}", "--quiet"]
    parameters = {"path": paths.inputs(ground), "count": count}
    listed = []
    for label, package, job, program, said in peers:
        listed.append(Peer(label, package, job and f"reading:{job}", parameters, said, False, program))
    title = f"reading {suffix.upper()}, {2 * count:,} triangles"
    said = "reading, checksum, checks, and volume to a level"
    return Case(f"reading-{suffix}-{count}", title, {ground: ("ground", {"count": count})}, command, ".json", None, listed, said, **more)


IGL = ("libigl, closest points", "libigl", "libigl", "level lines only", True)
MESHLIB = ("MeshLib, distance map", "meshlib", "meshlib", f"level lines only; {SINGLE}", True)
SCIPY = ("scipy, distance transform", "scipy", "scipy_edt", f"level lines only; {EDT}", False)
SKFMM = ("scikit-fmm, fast marching of order 2", "scikit-fmm", "scikit_fmm", FMM, False)
PYKONAL = ("pykonal, fast marching", "pykonal", "pykonal", KONAL, False)
BRUTE = ("numba, closed form of all segments", "numba", "numba_brute", "what the others are compared with", True)
GEOS = ("GEOS (shapely), 64 segments to a quarter", "shapely", "geos", "level lines only; simplifies its input", True)
CLIPPER = ("Clipper2 (pyclipr), arcs within 1 mm", "pyclipr", "clipper2", "level lines only", True)
MANIFOLD = ("manifold3d, two booleans", "manifold3d", "manifold", {}, "", True)
MESHLIB_VOLUME = ("MeshLib, two booleans", "meshlib", "meshlib", {}, SINGLE, True)


def rasters(*cells):
    return [(f"numba, rasters of both, cells of {c:g} m", "numba", "raster", {"cell": c}, "", c == 1) for c in cells]


def shown(peer):
    """The same peer, in the README as well."""
    return (*peer[:-1], True)


CASES = [
    heights(1_000, 500, False, [IGL, MESHLIB, SCIPY, SKFMM], quick=True),
    heights(1_000, 1_000, False, [IGL, MESHLIB, shown(SCIPY), shown(SKFMM)], readme=True),
    heights(1_000, 2_000, False, [SCIPY, SKFMM]),
    heights(10_000, 1_000, False, [IGL, MESHLIB]),
    heights(1_000, 500, True, [BRUTE, PYKONAL], quick=True),
    heights(1_000, 1_000, True, [BRUTE, shown(PYKONAL)], readme=True),
    heights(1_000, 2_000, True, [PYKONAL]),
    heights(10_000, 1_000, True, [BRUTE], readme=True),
    offsets(1_000, False, [GEOS, CLIPPER], quick=True),
    offsets(1_000, True, [GEOS, CLIPPER]),
    offsets(10_000, False, [GEOS, CLIPPER], readme=True),
    offsets(10_000, False, [GEOS], more_tolerance="0.00001"),
    offsets(10_000, True, [GEOS, CLIPPER]),
    offsets(100_000, False, [GEOS]),
    roof(100, quick=True),
    roof(1_000, readme=True),
    volumes("rough", 50_000, False, [MANIFOLD, MESHLIB_VOLUME, *rasters(4, 2, 1)], quick=True),
    volumes("rough", 50_000, True, [MANIFOLD, MESHLIB_VOLUME], quick=True),
    volumes("wedge", 50_000, False, [MANIFOLD, MESHLIB_VOLUME], quick=True),
    volumes("rough", 500_000, False, [MANIFOLD, MESHLIB_VOLUME, *rasters(4, 2, 1)], readme=True),
    volumes("rough", 500_000, True, [MANIFOLD, MESHLIB_VOLUME], readme=True),
    whole(50_000, 1_000, [4, 2], quick=True),
    whole(1_000_000, 1_000, [4, 2, 1], readme=True),
]


def io_cases(tobj):
    """Reading; `tobj` is the program that reads with tobj, or a word why there is none."""
    alone = ("tobj 4.0.5 (use_f64), whole process", "", "", tobj, "reading only")
    obj = [alone, ("trimesh", "trimesh", "trimesh", [], "reading only"), ("libigl", "libigl", "libigl", [], "reading only")]
    ply = [("numpy, frombuffer (a floor)", "numpy", "numpy_ply", [], "reading only"), ("trimesh", "trimesh", "trimesh", [], "reading only")]
    return [
        reading(50_000, "obj", obj, quick=True),
        reading(1_000_000, "obj", obj),
        reading(1_000_000, "ply", ply),
    ]
