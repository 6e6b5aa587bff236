"""Bodies that move: timelines, checkpoints, and going on from them."""

import json
import signal
import subprocess
import time
import unittest

from cli_case import DENSE, EXAMPLES, MOVING, PROGRAM, Case


class Motion(Case):
    def test_a_dense_recipe_is_packed_by_moving_bodies_and_says_so(self):
        recipe = EXAMPLES / "dense_ellipsoids.toml"
        text = self.run_program("pack", recipe, "-o", "d.json").stdout
        for words in ["100 of 100, fraction 0.55", "orientations were changed", "<uu> as drawn",
                      "event-driven (as ordered)", "collisions, reduced pressure", "certified"]:
            self.assertIn(words, text)
        done = self.run_program("pack", EXAMPLES / "dense_mixture.toml", "-o", "m.json", "--json",
                                "--set", "packing.method=event-driven")
        summary = json.loads(done.stdout)
        self.assertEqual(summary["method"], "event-driven")
        self.assertEqual(summary["motion"]["size_factor"], 1)
        self.assertGreater(summary["motion"]["collisions"], 100)
        self.assertIsNone(summary["relaxation"])
        self.assertTrue(summary["groups"][0]["orientation"]["turned"])
        self.run_program("check", "m.json")

    def test_the_timeline_is_a_table_with_units(self):
        self.write("dense.toml", DENSE)
        self.run_program("pack", "dense.toml", "--timeline", "t.csv", "--quiet")
        heading, *lines = (self.folder / "t.csv").read_text().splitlines()
        names = heading.split(",")
        self.assertEqual(names[0], "time [L/v]")
        self.assertEqual(len(names), 9)
        rows = [[float(number) for number in line.split(",")] for line in lines]
        self.assertTrue(rows and all(len(row) == 9 for row in rows))
        self.assertEqual(rows, sorted(rows))
        self.assertAlmostEqual(rows[-1][names.index("fraction [-]")], 0.6, places=9)
        self.assertEqual(rows[-1][names.index("size_factor [-]")], 1)

    def test_a_method_that_moves_nothing_has_no_timeline_and_says_so(self):
        done = self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "f.json", "--timeline",
                                "t.csv", "--checkpoint", "c.h5")
        self.assertIn("--timeline t.csv: not written; the method rsa moves nothing", done.stderr)
        self.assertIn("--checkpoint c.h5: not written", done.stderr)
        self.assertEqual(self.files(), ["f.json"])

    def test_the_densest_packing_is_what_was_ordered_and_a_target_out_of_reach_is_not(self):
        self.write("dense.toml", DENSE)
        faster = ["--set", "packing.event-driven.slowest_growth=0.01"]
        done = self.run_program("pack", "dense.toml", "-o", "d.json", *faster, "--set",
                                "packing.event-driven.goal=densest")
        self.assertRegex(done.stdout, r"sizes are 1\.\d+ of those ordered")
        self.assertIn("ended: jammed", done.stdout)
        done = self.run_program("pack", "dense.toml", "-o", "t.json", *faster, "--set",
                                "inclusions[0].fraction=0.9", code=1)
        self.assertRegex(done.stderr, r"jammed.*; sizes are 0\.\d+ of those ordered; disks: 60 of 60")
        self.run_program("check", "t.json")

    def test_a_run_out_of_time_goes_on_from_its_checkpoint(self):
        self.write("moving.toml", MOVING)
        done = self.run_program("pack", "moving.toml", "-o", "part.json", "--checkpoint", "c.h5",
                                "--time-limit", "0.3 s", code=1)
        self.assertIn("go on with: packstone pack --resume c.h5 -o part.json", done.stderr)
        self.run_program("check", "part.json")
        # The recipe is inside: what was left to do, and how long it may take, may be changed.
        done = self.run_program("pack", "--resume", "c.h5", "-o", "whole.json", "--time-limit", "1 h",
                                "--set", "packing.event-driven.collisions_per_body=100")
        self.assertIn("from a checkpoint", done.stdout)
        self.run_program("check", "whole.json")
        done = self.run_program("pack", "--resume", "c.h5", "-o", "other.json", "--set",
                                "inclusions[0].count=99", code=2)
        self.assertIn("c.h5: the checkpoint does not belong to the recipe", done.stderr)

    def test_an_interrupt_leaves_a_checkpoint(self):
        self.write("moving.toml", MOVING)
        process = subprocess.Popen([PROGRAM, "pack", "moving.toml", "--checkpoint", "c.h5",
                                    "--timeline", "t.csv"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("--resume c.h5", stderr)
        self.assertEqual(self.files(), ["c.h5", "moving.json", "moving.toml", "t.csv"])
        self.run_program("check", "moving.json")
        self.run_program("pack", "--resume", "c.h5", "-o", "more.json", "--timeline", "more.csv",
                         "--time-limit", "0.3 s", code=1)
        last = (self.folder / "t.csv").read_text().splitlines()[-1].split(",")
        first = (self.folder / "more.csv").read_text().splitlines()[1].split(",")
        self.assertLess(float(last[0]), float(first[0]))
        self.assertLess(int(last[1]), int(first[1]))

    def test_what_makes_no_sense_together_is_refused(self):
        self.write("dense.toml", DENSE)
        for arguments, words in [
                (["dense.toml", "--resume", "c.h5"], "--resume and RECIPE exclude each other"),
                (["--resume", "c.h5", "-o", "x.json", "--seed", "3"], "--resume and --seed exclude"),
                (["--resume", "c.h5"], "-o is missing"),
                (["--resume", "c.h5", "-o", "x.json"], "c.h5: cannot be read"),
                (["dense.toml", "--realizations", "2", "--timeline", "t.csv"], "exclude each other"),
                (["dense.toml", "--realizations", "0"], "--realizations"),
                (["dense.toml", "--timeline", "t.txt"], "--timeline t.txt: unknown ending .txt"),
                (["dense.toml", "--checkpoint", "c.json"], "--checkpoint c.json: unknown ending"),
                (["dense.toml", "-o", "c.h5", "--checkpoint", "c.h5"], "-o names the same file")]:
            done = self.run_program("pack", *arguments, code=2)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.files(), ["dense.toml"])


if __name__ == "__main__":
    unittest.main()
