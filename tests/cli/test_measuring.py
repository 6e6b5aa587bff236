"""What is measured of packings."""

import json
import math
import unittest

from cli_case import OVERLAPPING, Case

# Rows of disks of diameter 1 from 0.3 to 20.3; the cell goes on to 25, and round along x.
LATTICE = {
    "format": "packstone-packing", "version": 1,
    "cell": {"size": [10, 25], "periodic": [True, False]},
    "inclusions": [{"group": "disks", "shape": "disk", "center": [x + 0.2, y + 0.8], "radius": 0.5}
                   for x in range(10) for y in range(20)]}


class Measuring(Case):
    def test_density_is_said_in_words_and_numbers(self):
        self.write("disks.json", LATTICE)
        text = self.run_program("measure", "disks.json", "--wall-margin", "1.3").stdout
        for words in ["200 inclusions", "whole cell        0.628319", "top y = 20.3",
                      "interior          0.785398", "window x 0 to 10, y 1.3 to 18.3",
                      "floor y = 0               0.2356"]:
            self.assertIn(words, text)

    def test_the_report_is_written_whole_with_profiles(self):
        self.write("disks.json", LATTICE)
        done = self.run_program("measure", "disks.json", "-o", "report.json", "--json",
                                "--wall-margin", "1.3", "--bin-width", "0.5")
        report = self.read("report.json")
        self.assertEqual(report, json.loads(done.stdout))
        self.assertEqual(report["packing"], "disks.json")
        density = report["density"]
        phi = math.pi / 4
        self.assertAlmostEqual(density["fraction"], 0.8 * phi, places=12)
        self.assertAlmostEqual(density["interior"]["fraction"], phi, places=12)
        self.assertLess(density["interior"]["error"], 1e-12)
        self.assertIsNone(density["why_no_interior"])
        missing = {d["boundary"]: d["length"] for d in density["deficits"]}
        self.assertEqual(list(missing), ["floor", "top", "ceiling"])
        self.assertAlmostEqual(missing["floor"], 0.3 * phi, places=12)
        self.assertAlmostEqual(missing["top"], 0.0, places=12)
        self.assertAlmostEqual(missing["ceiling"], 4.7 * phi, places=12)
        for profile, length in zip(density["profiles"], [10, 25]):
            edges, whole = profile["edges"], profile["whole"]
            self.assertEqual((edges[0], edges[-1], len(edges)), (0, length, len(whole) + 1))
            widths = [hi - lo for lo, hi in zip(edges, edges[1:])]
            mean = sum(f * w for f, w in zip(whole, widths)) / length
            self.assertAlmostEqual(mean, density["fraction"], places=12)

    def test_a_small_packing_has_no_interior_and_says_why(self):
        packing = json.loads(json.dumps(OVERLAPPING))
        packing["cell"]["periodic"][2] = False
        self.write("two.json", packing)
        done = self.run_program("measure", "two.json", "--only", "density")
        self.assertIn("no interior: the packing is too small: along z", done.stdout)
        density = json.loads(self.run_program("measure", "two.json", "--json").stdout)["density"]
        self.assertIsNone(density["interior"])
        self.assertIn("along z", density["why_no_interior"])
        self.assertIsNone(density["profiles"][0]["window"])

    def test_what_is_refused(self):
        self.write("disks.json", LATTICE)
        for arguments, words in [(["--wall-margin", "-1"], "--wall-margin: -1; allowed is a number >= 0"),
                                 (["--bin-width", "0"], "--bin-width: 0; allowed is a number > 0"),
                                 (["--bin-width", "1e-9"], "bin_width is 1e-09; allowed are"),
                                 (["--only", "gaps"], "gaps"),
                                 (["-o", "report.txt"], "report.txt: unknown ending .txt")]:
            done = self.run_program("measure", "disks.json", *arguments, code=2)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stdout, "")
        self.run_program("measure", "missing.json", code=2)
        self.assertEqual(self.files(), ["disks.json"])


if __name__ == "__main__":
    unittest.main()
