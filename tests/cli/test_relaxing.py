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

    def test_fibers_of_many_lengths_keep_the_tensor_and_their_diameter(self):
        done = self.run_program("pack", EXAMPLES / "fiber_lengths.toml", "-o", "f.json", "--json")
        orientation = json.loads(done.stdout)["groups"][0]["orientation"]
        self.assertEqual(orientation["weighting"], "number")
        self.assertTrue(orientation["turned"])
        for key in ("tensor", "tensor_ordered"):
            for i, wanted in enumerate([0.65, 0.30, 0.05]):
                self.assertAlmostEqual(orientation[key][i][i], wanted, places=10)
        fibers = self.read("f.json")["inclusions"]
        self.assertEqual({fiber["radius"] for fiber in fibers}, {0.006})
        self.assertGreater(len({fiber["half_length"] for fiber in fibers}), 100)
        for i, wanted in enumerate([0.65, 0.30, 0.05]):  # of what stands in the file
            mean = sum(fiber["axis"][i] ** 2 for fiber in fibers) / len(fibers)
            self.assertAlmostEqual(mean, wanted, places=10)
        self.run_program("check", "f.json")

    def test_the_goal_densest_tells_by_how_much_sizes_grew(self):
        done = self.run_program("pack", EXAMPLES / "relaxed_fibers.toml", "-o", "f.json", "--json",
                                "--set", "packing.relaxation.goal=densest", "--set",
                                "inclusions.fibers.fraction=0.1", "--time-limit", "2 s")
        summary = json.loads(done.stdout)
        self.assertIn(summary["stop"], ["jammed", "out_of_time"])
        self.assertTrue(summary["target_reached"])
        fraction = summary["certificate"]["fraction"]
        self.assertGreater(fraction, 0.15)
        grown = summary["relaxation"]["size_factor"]
        self.assertAlmostEqual(fraction, grown ** 3 * summary["groups"][0]["fraction_ordered"])
        self.run_program("check", "f.json")
        text = self.run_program("pack", EXAMPLES / "relaxed_fibers.toml", "-o", "f.json", "--set",
                                "packing.relaxation.goal=densest", "--time-limit", "0.5 s").stdout
        self.assertIn("of those ordered", text)
        done = self.run_program("pack", EXAMPLES / "relaxed_fibers.toml", "-o", "f.json", "--set",
                                "packing.relaxation.least_step=0.5", code=2)
        self.assertIn("packing.relaxation.least_step = 0.5; allowed is a number > 0 and <= "
                      "first_step = 0.08", done.stderr)

    def test_what_stays_overlapping_is_kept_but_not_passed_off_as_done(self):
        self.write("many.toml", TOO_MANY)
        done = self.run_program("pack", "many.toml", "-o", "m.json", code=1)
        self.assertIn("NOT CERTIFIED", done.stdout)
        self.assertIn("no attempt came to rest without overlaps", done.stderr)
        self.assertIn("the state that overlaps least, not valid, is in m.json", done.stderr)
        check = self.run_program("check", "m.json", code=1)
        self.assertIn("FAILED", check.stdout)

    def test_what_stalls_names_the_worst_pair_its_image_and_depth(self):
        self.write("many.toml", TOO_MANY)
        done = self.run_program("pack", "many.toml", "-o", "m.json", "--json", code=1)
        certificate = json.loads(done.stdout)["certificate"]
        self.assertLess(certificate["smallest_gap"], 0)
        first, second = certificate["worst_pair"]
        image = certificate["worst_image"]
        where = f" in image {image}" if any(image) else ""
        self.assertIn(f"worst: inclusions {first} and {second}{where} by "
                      f"{-certificate['smallest_gap']:.4g}, deepest of", done.stderr)

    def test_what_cannot_be_taken_out_of_a_wall_is_named_with_wall_and_depth(self):
        # Wider than the cell: 0.1 too much, which it can at best halve between the two walls.
        sphere = {"group": "a", "shape": "sphere", "center": [0.5, 0.5, 0.52], "radius": 0.55}
        self.write("wide.json", {"format": "packstone-packing", "version": 1, "cell": {
            "size": [2, 2, 1], "periodic": [True, True, False]}, "inclusions": [sphere]})
        done = self.run_program("relax", "wide.json", "-o", "w.json", "--json", code=1)
        summary = json.loads(done.stdout)
        self.assertEqual(summary["stop"], "stalled")
        self.assertEqual(summary["deepest_crossing"]["inclusion"], 0)
        self.assertEqual(summary["deepest_crossing"]["axis"], "z")
        self.assertAlmostEqual(summary["deepest_crossing"]["depth"], 0.05, places=3)
        self.assertRegex(done.stderr, r"worst: inclusion 0 by 0\.0\d+ through the wall z = [01]\n")

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
