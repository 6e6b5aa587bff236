"""Overlaps that are relaxed away, or that stay."""

import json
import unittest

from cli_case import EXAMPLES, OVERLAPPING, Case

TOO_MANY = """
[cell]
size = [1, 1, 1]
periodic = true
[[inclusions]]
name = "grains"
shape = "ellipsoid"
aspect = 2
count = 30
fraction = 0.8
[packing]
method = "relaxation"
[packing.relaxation]
max_restarts = 0
max_relocations = 1
"""


class Relaxing(Case):
    def test_auto_relaxes_a_dense_mixture_and_says_so(self):
        done = self.run_program("pack", EXAMPLES / "dense_mixture.toml", "-o", "m.json", "--json")
        summary = json.loads(done.stdout)
        self.assertEqual(summary["method"], "relaxation")
        self.assertIn("denser than rsa", summary["method_reason"])
        self.assertGreater(summary["relaxation"]["iterations"], 10)
        self.assertIsNone(summary["motion"])
        self.assertTrue(summary["certificate"]["passed"])
        self.run_program("check", "m.json")

    def test_fibers_keep_the_tensor_ordered_and_leave_a_timeline(self):
        done = self.run_program("pack", EXAMPLES / "relaxed_fibers.toml", "-o", "f.json",
                                "--timeline", "t.csv", "--json")
        orientation = json.loads(done.stdout)["groups"][0]["orientation"]
        wanted = [[0.7, 0, 0], [0, 0.25, 0], [0, 0, 0.05]]
        for row, row_wanted in zip(orientation["tensor"], wanted):
            for value, value_wanted in zip(row, row_wanted):
                self.assertAlmostEqual(value, value_wanted, places=10)
        heading, *lines = (self.folder / "t.csv").read_text().splitlines()
        self.assertEqual(heading, "iteration [-],energy [L^2],deepest [L],contacts [-]")
        energies = [float(line.split(",")[1]) for line in lines]
        self.assertGreater(len(energies), 10)
        self.assertLess(energies[-1], 1e-3 * energies[0])
        self.run_program("check", "f.json")

    def test_what_stays_overlapping_is_kept_but_not_passed_off_as_done(self):
        self.write("many.toml", TOO_MANY)
        done = self.run_program("pack", "many.toml", "-o", "m.json", code=1)
        self.assertIn("NOT CERTIFIED", done.stdout)
        self.assertIn("no attempt came to rest without overlaps", done.stderr)
        self.assertIn("the state that overlaps least, not valid, is in m.json", done.stderr)
        check = self.run_program("check", "m.json", code=1)
        self.assertIn("FAILED", check.stdout)


    def test_relax_opens_the_gaps_of_a_packing_and_ends_overlaps(self):
        self.write("overlapping.json", OVERLAPPING)
        done = self.run_program("relax", "overlapping.json", "-o", "apart.json", "--timeline", "t.csv")
        self.assertIn("passed: no two inclusions overlap", done.stdout)
        heading, *lines = (self.folder / "t.csv").read_text().splitlines()
        self.assertTrue(heading.startswith("iteration [-],energy [L^2]"))
        self.assertLess(float(lines[-1].split(",")[1]), float(lines[0].split(",")[1]))
        self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "f.json")
        done = self.run_program("relax", "f.json", "--min-gap", "0.003", "-o", "g.h5", "--json")
        certificate = json.loads(done.stdout)
        self.assertTrue(certificate["passed"])
        self.assertGreater(certificate["smallest_gap"], 0.003)
        self.assertEqual(certificate["stop"], "target_reached")
        self.run_program("check", "g.h5", "--min-gap", "0.003")

    def test_relax_says_what_it_cannot_do_and_refuses_what_makes_no_sense(self):
        self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "f.json")
        done = self.run_program("relax", "f.json", "--min-gap", "0.2", "-o", "g.json",
                                "--time-limit", "1 s", code=1)
        self.assertIn("not every gap could be opened", done.stderr)
        self.assertIn("closer than 0.2", done.stdout)
        done = self.run_program("relax", "f.json", "-o", "g.json", "--rotate", "fre", code=2)
        self.assertIn("fre", done.stderr)
        done = self.run_program("relax", "f.json", "-o", "g.txt", code=2)
        self.assertIn("g.txt", done.stderr)
        done = self.run_program("relax", "f.json", "-o", "g.json", "--timeline", "t.txt", code=2)
        self.assertIn("t.txt", done.stderr)
        done = self.run_program("relax", "f.json", "-o", "g.json", "--min-gap", "2", code=2)
        self.assertIn("min_gap is 2", done.stderr)


if __name__ == "__main__":
    unittest.main()
