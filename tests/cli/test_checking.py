"""Verdicts on packings, and files that are none."""

import json
import pathlib
import subprocess
import unittest

from cli_case import OVERLAPPING, PROGRAM, Case


class Checking(Case):
    def test_an_overlap_is_an_honest_no(self):
        self.write("bad.json", OVERLAPPING)
        done = self.run_program("check", "bad.json", code=1)
        self.assertIn("1 pair overlaps", done.stdout)
        self.assertIn("between inclusions 0 and 1", done.stdout)
        certificate = json.loads(self.run_program("check", "bad.json", "--json", code=1).stdout)
        self.assertFalse(certificate["passed"])
        self.assertEqual(certificate["overlaps"], 1)
        self.assertAlmostEqual(certificate["smallest_gap"], -0.05, places=12)

    def test_who_crosses_a_wall_is_named_with_the_wall_and_how_far(self):
        packing = json.loads(json.dumps(OVERLAPPING))
        packing["cell"]["periodic"] = [True, True, False]
        packing["inclusions"][1]["center"] = [0.5, 0.5, 0.95]
        radius = packing["inclusions"][1]["radius"]
        packing["inclusions"][0]["center"] = [0.1, 0.1, radius - 0.01]
        self.write("out.json", packing)
        done = self.run_program("check", "out.json", code=1)
        self.assertIn("2 inclusions cross a wall; deepest: inclusion 1 by %.4g through the wall z = 1"
                      % (radius - 0.05), done.stdout)
        certificate = json.loads(self.run_program("check", "out.json", "--json", code=1).stdout)
        self.assertEqual(certificate["outside_walls"], 2)
        self.assertAlmostEqual(certificate["deepest_crossing"].pop("depth"), radius - 0.05)
        self.assertEqual(certificate["deepest_crossing"], {"inclusion": 1, "axis": "z", "wall": 1})

    def test_the_least_gap_is_checked_when_asked_for(self):
        packing = json.loads(json.dumps(OVERLAPPING))
        packing["inclusions"][1]["center"][0] = 0.75
        self.write("near.json", packing)
        self.run_program("check", "near.json")
        self.run_program("check", "near.json", "--min-gap", "0.04")
        done = self.run_program("check", "near.json", "--min-gap", "0.06", code=1)
        self.assertIn("closer than 0.06", done.stdout)
        self.run_program("check", "near.json", "--min-gap", "-1", code=2)

    def test_what_is_no_packing_ends_with_2(self):
        self.write("text.json", "hello")
        self.write("other.json", {"format": "something"})
        for name in ["text.json", "other.json", "missing.json"]:
            done = self.run_program("check", name, code=2)
            self.assertIn(name, done.stderr)
            self.assertEqual(done.stdout, "")

    def test_the_hdf5_library_adds_nothing_about_a_damaged_file(self):
        damaged = pathlib.Path(__file__).parents[1] / "fuzz/corpus/packing_hdf5/found_huge_header.h5"
        done = self.run_program("check", damaged, code=2)
        self.assertIn("found_huge_header.h5", done.stderr)
        self.assertNotIn("closing library", done.stderr)

    def test_a_damaged_file_that_crashes_the_hdf5_library_ends_in_a_message(self):
        # What the library reads beyond its buffers, and so whether it crashes, is left to chance.
        done = subprocess.run([PROGRAM, "check", pathlib.Path(__file__).parent / "damaged_early_format.h5"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertIn(done.returncode, [0, 1, 2], done.stderr)

    def test_a_witness_is_written_beside_the_verdict(self):
        self.pack_fibers()
        self.run_program("check", "fibers.json", "--witness", "w.csv")
        self.assertTrue((self.folder / "w.csv").read_text().startswith("# packstone-witness 1"))
        done = self.run_program("check", "fibers.json", "--witness", "nowhere/w.csv", code=2)
        self.assertIn("nowhere", done.stderr)


if __name__ == "__main__":
    unittest.main()
