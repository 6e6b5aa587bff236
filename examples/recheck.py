#!/usr/bin/env python3
"""Re-checks a packing from scratch: recheck.py PACKING.json WITNESSES.csv

Needs NumPy only and shares no code with Packstone. Exit code 0: every listed direction separates
its pair, and the boxes of all pairs that are not listed are apart. 1: not so.
"""
import json, sys
import numpy as np

def support(p, d):
    """How far the inclusion p reaches from its center along the unit vector d."""
    if p["shape"] in ("sphere", "disk"): return p["radius"]
    if p["shape"] == "ellipse":
        c, s = np.cos(p["angle"]), np.sin(p["angle"])
        return np.linalg.norm(np.array(p["axes"]) * ([[c, s], [-s, c]] @ d[:2]))
    if p["shape"] == "ellipsoid":
        w, v = p["quaternion"][0], np.array(p["quaternion"][1:])
        return np.linalg.norm(p["axes"] * (d - 2 * np.cross(v, w * d - np.cross(v, d))))
    along = np.dot(p["axis"], d)
    radial = d - along * np.array(p["axis"]) if p["shape"] == "cylinder" else d
    return p["half_length"] * abs(along) + p["radius"] * np.linalg.norm(radial)

def witnessed_gaps(packing, rows):
    """g(d) = d.r - S_a(d) - S_b(-d) of every row: more than 0 proves the pair apart."""
    pad = lambda v: np.array(v + [0.0] * (3 - len(v)))
    for a, b, *image, x, y, z, _ in rows:
        p, q = packing["inclusions"][int(a)], packing["inclusions"][int(b)]
        d = np.array([x, y, z]) / np.linalg.norm([x, y, z])
        r = pad(q["center"]) - pad(p["center"]) + image * pad(packing["cell"]["size"])
        yield d @ r - support(p, d) - support(q, -d)

def unlisted(packing, rows):
    """Pairs whose boxes meet though no row speaks of them. Compares all with all, row by row."""
    size, dim = np.array(packing["cell"]["size"]), len(packing["cell"]["size"])
    center = np.array([p["center"] for p in packing["inclusions"]])
    half = np.array([[support(p, e) for e in np.eye(3)[:dim]] for p in packing["inclusions"]])
    reach = np.ceil(2 * half.max(axis=0) / size + 1).astype(int) * packing["cell"]["periodic"]
    listed = {tuple(int(v) for v in row[: 2 + dim]) for row in rows}
    for image in np.ndindex(*(2 * reach + 1)):
        shift = np.array(image) - reach
        for a in range(len(center)):
            near = np.abs(center[a:] + shift * size - center[a]) < half[a:] + half[a]
            for b in a + np.flatnonzero(near.all(axis=1)):
                if (a < b or tuple(shift) > (0,) * dim) and (a, b, *shift) not in listed:
                    yield a, b, *shift

if __name__ == "__main__":
    packing = json.load(open(sys.argv[1]))
    rows = np.loadtxt(sys.argv[2], delimiter=",", ndmin=2)
    gaps = np.array(list(witnessed_gaps(packing, rows)))
    missing = list(unlisted(packing, rows))
    print(f"{len(gaps)} pairs listed, {np.sum(gaps <= 0)} not proven apart, {len(missing)} missing")
    sys.exit(1 if missing or np.any(gaps <= 0) else 0)
