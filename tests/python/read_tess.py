"""Reads a tessellation file of Neper, written after its documentation ("File and Directory Formats",
format 2.0), and checks what the format promises.

Usage: read_tess.py FILE DIMENSION SIZE_X SIZE_Y SIZE_Z PERIODIC_AXES CELLS
PERIODIC_AXES: of "xyz", or "-". CELLS: in the packing; those in the file carry its numbers, from 1.
"""
import itertools
import sys

path = sys.argv[1]
dimension = int(sys.argv[2])
size = [float(word) for word in sys.argv[3:6]]
periodic = [axis in sys.argv[6] for axis in "xyz"]
inclusions = int(sys.argv[7])

words = iter(open(path).read().split())


def expect(*wanted):
    for word in wanted:
        got = next(words)
        assert got == word, (got, word)


def number():
    return int(next(words))


def reals(count):
    return [float(next(words)) for _ in range(count)]


def numbered(count):
    """Yields the numbers 1 to count, each of which must begin its own entry."""
    for k in range(1, count + 1):
        assert number() == k, k
        yield k


def close(a, b, tolerance=1e-9):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


expect("***tess", "**format", "2.0", "**general", str(dimension),
       "periodic" if any(periodic) else "standard", "**cell")
cells = number()
expect("*id")
ids = [number() for _ in range(cells)]
assert all(1 <= i <= inclusions for i in ids)
expect("*seed")
seeds = {k: reals(4)[:3] for k in numbered(cells)}

expect("**vertex")
vertices = {}
for k in numbered(number()):
    vertices[k] = reals(3)
    assert number() == 0
expect("**edge")
edges = {}
for k in numbered(number()):
    edges[k] = (number(), number())
    assert number() == 0

expect("**face")
faces, face_edges = {}, {}
for k in numbered(number()):
    faces[k] = [number() for _ in range(number())]
    face_edges[k] = [number() for _ in range(number())]
    assert len(faces[k]) == len(face_edges[k]) >= 3
    for e, a, b in zip(face_edges[k], faces[k], faces[k][1:] + faces[k][:1]):
        assert (edges[e] if e > 0 else edges[-e][::-1]) == (a, b)
    d, *normal = reals(4)
    assert abs(dot(normal, normal) - 1) < 1e-12
    assert all(abs(dot(normal, vertices[v]) - d) < 1e-7 for v in faces[k])
    around = [0.0, 0.0, 0.0]
    spokes = [minus(vertices[v], vertices[faces[k][0]]) for v in faces[k][1:]]
    for a, b in zip(spokes, spokes[1:]):
        around = [x + y for x, y in zip(around, cross(a, b))]
    assert dot(around, normal) >= 0, "corners run around the normal"
    expect("0", "-1" if dimension == 2 else "0", "0", "0", "0")


def area(face):
    at = [vertices[v] for v in faces[face]]
    return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(at, at[1:] + at[:1]))


def volume(polyhedron):
    six = 0.0
    for f in polyhedron:
        at = [minus(vertices[v], vertices[faces[abs(f)][0]]) for v in faces[abs(f)]]
        origin = vertices[faces[abs(f)][0]]
        for a, b in zip(at, at[1:]):
            six += (1 if f > 0 else -1) * dot(origin, cross(a, b))
    return six / 6


if dimension == 3:
    expect("**polyhedron")
    total = 0.0
    for k in numbered(number()):
        polyhedron = [number() for _ in range(number())]
        passed = sorted((1 if f > 0 else -1) * e for f in polyhedron for e in face_edges[abs(f)])
        assert passed == sorted(-e for e in passed), "a polyhedron is not closed"
        own = volume(polyhedron)
        assert own > 0
        total += own
    assert k == cells
    box = size[0] * size[1] * size[2]
else:
    assert len(faces) == cells
    total = sum(area(f) for f in faces)
    box = size[0] * size[1]
assert abs(total - box) < 1e-9 * box, (total, box)

expect("**domain", "*general", "square" if dimension == 2 else "cube", "*vertex")
corners, labels = {}, {}
for k in numbered(number()):
    corners[k] = reals(3)
    labels[k] = next(words)
    wanted = "".join("xyz"[a] + ("1" if corners[k][a] else "0") for a in range(dimension))
    assert labels[k] == wanted
    assert number() == 1
    vertex = number()
    if vertex == 0:
        assert any(periodic)
    else:
        assert close(vertices[vertex], corners[k])
assert len(corners) == 2 ** dimension


def on_wall(v, label):
    axis = "xyz".index(label[0])
    return abs(vertices[v][axis] - (size[axis] if label[1] == "1" else 0.0)) < 1e-9


expect("*edge")
domain_edges = {}
for k in numbered(number()):
    domain_edges[k] = [number() for _ in range(number())]
    assert len(domain_edges[k]) == 2
    label = next(words)
    walls = [label[i:i + 2] for i in range(0, len(label), 2)]
    assert all(wall in labels[v] for v in domain_edges[k] for wall in walls)
    inside = [number() for _ in range(number())]
    assert all(on_wall(v, wall) for e in inside for v in edges[e] for wall in walls)
    if not any(periodic):
        length = sum(abs(x) for e in inside for x in minus(vertices[edges[e][0]], vertices[edges[e][1]]))
        a, b = domain_edges[k]
        assert abs(length - sum(abs(x) for x in minus(corners[a], corners[b]))) < 1e-9
if dimension == 3:
    expect("*face")
    for k in numbered(number()):
        ring = [number() for _ in range(number())]
        assert len(ring) == 4
        for a, b in zip(ring, ring[1:] + ring[:1]):
            assert sum(x != y for x, y in zip(corners[a], corners[b])) == 1
        assert number() == 4
        assert all(set(domain_edges[number()]) <= set(ring) for _ in range(4))
        expect("plane", "4")
        d, *normal = reals(4)
        label = next(words)
        assert all(abs(dot(normal, corners[v]) - d) < 1e-12 and label in labels[v] for v in ring)
        inside = [number() for _ in range(number())]
        assert all(on_wall(v, label) for f in inside for v in faces[f])
        assert bool(inside) == (not periodic["xyz".index(label[0])])

if any(periodic):
    expect("**periodicity", "*general")
    assert [number() for _ in range(3)] == [int(p) for p in periodic]
    distance = reals(3)
    assert distance == [s if p else 0.0 for s, p in zip(size, periodic)]
    expect("*seed")
    count = number()
    images = list(itertools.product(*[(-1, 0, 1) if p else (0,) for p in periodic]))
    assert count == (len(images) - 1) * cells
    for k in range(count):
        assert number() == cells + 1 + k
        assert 1 <= number() <= cells
        assert all(abs(number()) <= 1 for _ in range(3))

    def secondary(section, turned):
        """Secondary -> (primary, shift); of edges and faces that run as their primaries do."""
        expect(section)
        pairs = {}
        for _ in range(number()):
            k, primary = number(), number()
            pairs[k] = (primary, [number() * d for d in distance])
            if turned:
                assert number() == 1
        assert not set(pairs) & {primary for primary, _ in pairs.values()}
        return pairs

    moved = secondary("*vertex", False)
    for k, (primary, shift) in moved.items():
        assert any(shift)
        assert close(minus(vertices[k], vertices[primary]), shift)
    for k, (primary, shift) in secondary("*edge", True).items():
        for a, b in zip(edges[k], edges[primary]):
            assert close(minus(vertices[a], vertices[b]), shift)
    if dimension == 3:
        for k, (primary, shift) in secondary("*face", True).items():
            for a, b in zip(faces[k], faces[primary]):
                assert close(minus(vertices[a], vertices[b]), shift)
    # No two vertices are the same one moved by periods unless the file says so.
    places = {}
    for k, at in vertices.items():
        if k in moved:
            continue
        at = tuple(round(x / s, 11) % 1 if p else round(x, 11) for x, s, p in zip(at, size, periodic))
        assert at not in places, (k, places[at])
        places[at] = k
expect("***end")
assert next(words, None) is None
