"""What the tests of the program share: how it is run, in a folder of its own, and what it is given."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["PACKSTONE"]
EXAMPLES = pathlib.Path(os.environ["PACKSTONE_EXAMPLES"])

# Random sequential adsorption does not reach this fraction; of so few spheres it is never hopeless by
# much, so starts follow each other until the program is stopped.
ENDLESS = """[cell]
size = [1, 1, 1]
[[inclusions]]
name = "spheres"
shape = "sphere"
count = 20
fraction = 0.58
[packing]
method = "rsa"
"""

# Goes on until it is stopped.
MOVING = """[cell]
size = [1, 1]
[[inclusions]]
name = "ellipses"
shape = "ellipse"
aspect = 2
count = 100
fraction = 0.5
[packing.event-driven]
goal = "equilibrium"
collisions_per_body = 1e9
"""

# Three packings of this take moments.
DENSE = """[cell]
size = [1, 1]
[[inclusions]]
name = "disks"
shape = "disk"
count = 60
fraction = 0.6
[packing]
method = "event-driven"
"""

OVERLAPPING = {
    "format": "packstone-packing", "version": 1,
    "cell": {"size": [1, 1, 1], "periodic": [True, True, True]},
    "inclusions": [
        {"group": "a", "shape": "sphere", "center": [0.5, 0.5, 0.5], "radius": 0.1},
        {"group": "a", "shape": "sphere", "center": [0.65, 0.5, 0.5], "radius": 0.1}]}


class Case(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="packstone_cli_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, timeout=300,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    def read(self, name):
        return json.loads((self.folder / name).read_text())

    def files(self):
        return sorted(os.listdir(self.folder))

    def pack_fibers(self, *arguments):
        self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "fibers.json", *arguments)
        return self.read("fibers.json")
