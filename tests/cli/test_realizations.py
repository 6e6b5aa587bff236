"""Many packings of one recipe."""

import json
import signal
import subprocess
import time
import unittest

from cli_case import DENSE, MOVING, PROGRAM, Case


class Realizations(Case):
    def test_each_seed_gives_its_packing_for_any_number_of_threads(self):
        self.write("dense.toml", DENSE)
        done = self.run_program("pack", "dense.toml", "--realizations", "3", "--seed", "5",
                                "--threads", "2")
        names = ["dense-5.json", "dense-6.json", "dense-7.json"]
        self.assertEqual(self.files(), [*names, "dense.toml"])
        self.assertEqual([line.split()[0] for line in done.stdout.splitlines()], names)
        packings = [self.read(name) for name in names]
        self.assertEqual([packing["provenance"]["seed"] for packing in packings], [5, 6, 7])
        self.assertNotEqual(packings[0]["inclusions"], packings[1]["inclusions"])
        done = self.run_program("pack", "dense.toml", "--realizations", "3", "--seed", "5",
                                "--threads", "1", "--json")
        for name, packing, summary in zip(names, packings, json.loads(done.stdout)):
            self.assertEqual(self.read(name)["inclusions"], packing["inclusions"])
            self.assertEqual(summary["packing"], name)
            self.assertTrue(summary["target_reached"])
            self.run_program("check", name)
        self.run_program("pack", "dense.toml", "--seed", "6", "-o", "alone.json", "--quiet")
        self.assertEqual(self.read("alone.json")["inclusions"], packings[1]["inclusions"])

    def test_one_that_misses_its_target_ends_all_with_1(self):
        self.write("moving.toml", MOVING)
        done = self.run_program("pack", "moving.toml", "--realizations", "2", "--time-limit", "0.3 s",
                                code=1)
        self.assertEqual(self.files(), ["moving-1.json", "moving-2.json", "moving.toml"])
        self.assertIn("moving-2.json: target not reached: the time limit passed", done.stderr)

    def test_what_no_seed_can_make_ends_with_2(self):
        self.write("dense.toml", DENSE)
        done = self.run_program("pack", "dense.toml", "--realizations", "2", "--set",
                                "inclusions[0].fraction=0.95", code=2)
        self.assertIn("the densest packing there is", done.stderr)
        self.assertEqual(self.files(), ["dense.toml"])

    def test_an_interrupt_keeps_those_that_are_done(self):
        self.write("dense.toml", DENSE)
        process = subprocess.Popen([PROGRAM, "pack", "dense.toml", "--realizations", "100000"],
                                   cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertRegex(stderr, r"interrupted; \d+ of 100000 packings reached their target")
        made = [name for name in self.files() if name.endswith(".json")]
        self.assertGreater(len(made), 0)
        self.assertEqual(len(stdout.splitlines()), len(made))
        for name in made[:3]:
            self.run_program("check", name)


if __name__ == "__main__":
    unittest.main()
