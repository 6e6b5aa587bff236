#!/usr/bin/env python3
"""Checks that every file includes only what its layer may.

Layers include downward only; the siblings generate, tessellate, measure, voxelize never include each
other; io writes data and runs nothing, so it may not include them either; a few libraries may be
included in one place only. Prints each offence as file:line and exits 1 when there is any.
"""

import re
import subprocess
import sys

ALLOWED = {
    "core": {"core"},
    "geometry": {"core", "geometry"},
    "spatial": {"core", "geometry", "spatial"},
    "structure": {"core", "geometry", "spatial", "structure"},
    "io": {"core", "geometry", "structure", "io"},
}
for sibling in ("generate", "tessellate", "measure", "voxelize"):
    ALLOWED[sibling] = {"core", "geometry", "spatial", "structure", sibling}
ALLOWED["recipe"] = set(ALLOWED) | {"recipe"}
ALLOWED["apps"] = set(ALLOWED) | {"apps"}

# Library header -> where alone it may be included.
SEAMS = {
    r"tbb/|oneapi/|thread$|omp\.h": r"src/core/parallel\.cpp",
    r"hwy/": r"src/[a-z]+/batch/",
    r"[Hh]df5": r"src/io/",
    r"nlohmann/": r"(src/(io|recipe)|apps)/",
    r"toml\+\+/": r"src/recipe/",
    r"embree|cairo|png\.h": r"src/io/",
    r"CLI/": r"apps/",
    r"Random123/": r"src/core/random\.cpp",
    r"Eigen/": r"src/tessellate/",
}

INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')


def layer_of(path):
    match = re.match(r"(?:include/packstone|src)/([a-z0-9_]+)/", path)
    return match.group(1) if match else "apps" if path.startswith("apps/") else None


def offences(path, text):
    layer = layer_of(path)
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        included = match.group(1)
        target = re.match(r"(?:packstone/)?([a-z]+)/", included)
        if target and target.group(1) in ALLOWED and layer in ALLOWED:
            if target.group(1) not in ALLOWED[layer]:
                yield number, f"{layer} may not include {included}"
        for library, place in SEAMS.items():
            if re.match(library, included) and not re.match(place, path):
                yield number, f"{included} may be included in {place} only"


def main():
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "include", "src", "apps"],
        check=True, capture_output=True, text=True)
    files = [f for f in listed.stdout.split() if f.endswith((".hpp", ".cpp"))]
    unknown = [f for f in files if layer_of(f) not in ALLOWED and f != "include/packstone/packstone.hpp"]
    count = 0
    for path in files:
        with open(path, encoding="utf-8") as source:
            for number, message in offences(path, source.read()):
                print(f"{path}:{number}: {message}")
                count += 1
    for path in unknown:
        print(f"{path}:1: belongs to no known layer")
    print(f"{len(files)} files, {count + len(unknown)} offences")
    return 1 if count or unknown else 0


if __name__ == "__main__":
    sys.exit(main())
