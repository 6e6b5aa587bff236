"""Meshes a script with Gmsh, and checks the mesh: every cell filled, opposite faces matched.

Usage: mesh_geo.py FILE.geo SIZE_X SIZE_Y PERIODIC_AXES AREA [AREA ...]
PERIODIC_AXES: "x", "y", "xy" or "-". AREA: of each cell, in order; 0 for an empty one.
"""
import collections
import os
import shutil
import subprocess
import sys

if shutil.which("gmsh") is None:
    sys.exit(77)

path = sys.argv[1]
size = [float(sys.argv[2]), float(sys.argv[3])]
periodic = [axis in sys.argv[4] for axis in "xy"]
areas = [float(word) for word in sys.argv[5:]]
mesh = os.path.splitext(path)[0] + ".msh"
done = subprocess.run(["gmsh", "-2", "-format", "msh2", path, "-o", mesh], capture_output=True,
                      text=True, timeout=120)
assert done.returncode == 0 and "Error" not in done.stdout + done.stderr, done.stdout + done.stderr


def section(name):
    with open(mesh) as lines:
        text = lines.read()
    return text[text.index("$" + name) + len(name) + 1:text.index("$End" + name)].split("\n")[1:-1]


nodes = {}
for line in section("Nodes")[1:]:
    number, x, y, _ = line.split()
    nodes[int(number)] = (float(x), float(y))
names = {}
for line in section("PhysicalNames")[1:]:
    dimension, tag, name = line.split(maxsplit=2)
    names[int(dimension), int(tag)] = name.strip('"')

meshed = collections.defaultdict(float)
faces = collections.defaultdict(list)
edges = collections.Counter()
for line in section("Elements")[1:]:
    _, kind, tags, physical, *rest = map(int, line.split())
    corners = rest[tags - 1:]
    if kind == 1:
        faces[names[1, physical]].append(corners)
    if kind == 2:
        (ax, ay), (bx, by), (cx, cy) = (nodes[n] for n in corners)
        area = 0.5 * ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
        assert area > 0
        assert names[2, physical] == f"inclusion {physical - 1}"
        meshed[physical - 1] += area
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges[min(a, b), max(a, b)] += 1

for cell, area in enumerate(areas):
    assert abs(meshed[cell] - area) < 1e-9 * size[0] * size[1], (cell, meshed[cell], area)

# Conforming: each edge has two triangles, or lies at the boundary of the box.
for (a, b), count in edges.items():
    if count == 1:
        outside = [all(abs(nodes[n][axis] - at) < 1e-9 for n in (a, b))
                   for axis in range(2) for at in (0.0, size[axis])]
        assert any(outside), (nodes[a], nodes[b])

for axis in range(2):
    name = "xy"[axis]
    assert (name + "-" in faces) == periodic[axis], faces.keys()
    if not periodic[axis]:
        continue
    along = [sorted(nodes[n][1 - axis] for line in faces[name + side] for n in line) for side in "-+"]
    assert len(along[0]) == len(along[1])
    assert max(abs(a - b) for a, b in zip(*along)) < 1e-9
    for side, at in (("-", 0.0), ("+", size[axis])):
        assert all(nodes[n][axis] == at for line in faces[name + side] for n in line)
        length = sum(abs(nodes[a][1 - axis] - nodes[b][1 - axis]) for a, b in faces[name + side])
        assert abs(length - size[1 - axis]) < 1e-9
