"""Runs that end early: interrupts, time limits, shortfalls, progress."""

import json
import os
import pty
import signal
import subprocess
import time
import unittest

from cli_case import ENDLESS, PROGRAM, Case

# Denser than these can be: attempts, or steps, follow each other until they are stopped.
OVERLAPPING_FOR_EVER = """[cell]
size = [1, 1, 1]
[[inclusions]]
shape = "cylinder"
aspect = 2
count = 300
fraction = 0.9
[packing]
method = "{method}"
[packing.relaxation]
max_restarts = 1000000
[packing.time-driven]
energy_threshold = 0
stagnation_steps = 100000000
max_steps = 100000000
"""


class Stopping(Case):
    def start(self, stderr):
        self.write("endless.toml", ENDLESS)
        return subprocess.Popen([PROGRAM, "pack", "endless.toml", "-o", "out.json"],
                                cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=stderr)

    def check_kept(self, stop):
        packing = self.read("out.json")
        self.assertGreater(len(packing["inclusions"]), 10)
        self.assertEqual(packing["provenance"]["stop"], stop)
        self.run_program("check", "out.json")
        # Nothing half written beside it.
        self.assertEqual(self.files(), ["endless.toml", "out.json"])

    def test_an_interrupt_keeps_the_best_valid_state_and_ends_with_130(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start(subprocess.PIPE)
            time.sleep(1.0)
            process.send_signal(number)
            _, stderr = process.communicate(timeout=120)
            self.assertEqual(process.returncode, 130, stderr)
            self.assertIn("interrupted", stderr)
            self.check_kept("cancelled")

    def test_the_time_limit_keeps_the_best_valid_state_and_ends_with_1(self):
        self.write("endless.toml", ENDLESS)
        done = self.run_program("pack", "endless.toml", "-o", "out.json", "--time-limit", "1 s",
                                code=1)
        self.assertIn("the time limit passed", done.stderr)
        self.assertRegex(done.stderr, r"spheres: \d+ of 20")
        self.check_kept("out_of_time")

    def check_what_overlaps(self, stderr, stop):
        """The state was kept, and its certificate and the message name the pair that is worst."""
        packing = self.read("out.json")
        certificate = packing["certificate"]
        self.assertEqual(packing["provenance"]["stop"], stop)
        self.assertEqual(certificate["count"], 300)
        self.assertGreater(certificate["overlaps"], 0)
        self.assertLess(certificate["smallest_gap"], 0)
        first, second = certificate["worst_pair"]
        self.assertIn(f"worst: inclusions {first} and {second} ", stderr)
        self.assertIn(f"by {-certificate['smallest_gap']:.4g}, deepest of "
                      f"{certificate['overlaps']} overlap", stderr)
        self.assertIn("the state that overlaps least", stderr)
        self.run_program("check", "out.json", code=1)

    def interrupted(self, *arguments):
        """What a program says that is interrupted after a second."""
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("interrupted", stderr)
        return stderr

    def test_an_interrupted_relaxation_keeps_its_state_and_says_what_overlaps(self):
        for method in ("relaxation", "time-driven"):
            self.write("dense.toml", OVERLAPPING_FOR_EVER.format(method=method))
            stderr = self.interrupted("pack", "dense.toml", "-o", "out.json")
            self.check_what_overlaps(stderr, "cancelled")
            self.assertEqual(self.files(), ["dense.toml", "out.json"])

    def test_a_relaxation_out_of_time_keeps_its_state_and_says_what_overlaps(self):
        for method in ("relaxation", "time-driven"):
            self.write("dense.toml", OVERLAPPING_FOR_EVER.format(method=method))
            done = self.run_program("pack", "dense.toml", "-o", "out.json", "--time-limit", "1 s",
                                    code=1)
            self.assertIn("the time limit passed", done.stderr)
            self.check_what_overlaps(done.stderr, "out_of_time")

    def test_an_interrupt_while_bodies_are_placed_keeps_a_state_too(self):
        # Most of the time until then goes into random sequential adsorption.
        self.write("dense.toml", OVERLAPPING_FOR_EVER.format(method="relaxation") +
                   "[packing.rsa]\nmax_trials = 1000000000\n")
        stderr = self.interrupted("pack", "dense.toml", "-o", "out.json", "--set",
                                  "packing.relaxation.start_fraction=0.6")
        self.check_what_overlaps(stderr, "cancelled")

    def test_an_interrupt_of_growth_by_relaxation_keeps_a_packing_without_overlap(self):
        self.write("dense.toml", OVERLAPPING_FOR_EVER.format(method="relaxation"))
        stderr = self.interrupted("pack", "dense.toml", "-o", "out.json", "--set",
                                  "packing.relaxation.goal=densest", "--set",
                                  "packing.relaxation.least_step=1e-9")
        self.assertIn("the best valid packing is in out.json", stderr)
        self.run_program("check", "out.json")

    def test_an_interrupt_or_time_limit_ends_relax_likewise(self):
        self.write("dense.toml", OVERLAPPING_FOR_EVER.format(method="relaxation"))
        self.run_program("pack", "dense.toml", "-o", "start.json", "--time-limit", "0.1 s", code=1)
        self.write("many.toml", OVERLAPPING_FOR_EVER.format(method="relaxation")
                   .replace("count = 300", "count = 20000"))
        self.run_program("pack", "many.toml", "-o", "many.json", "--time-limit", "0.1 s", code=1)
        stderr = self.interrupted("relax", "many.json", "-o", "out.json")
        packing = self.read("out.json")
        self.assertEqual(packing["provenance"]["stop"], "cancelled")
        self.assertGreater(packing["certificate"]["overlaps"], 0)
        self.assertIn("worst: inclusions", stderr)
        done = self.run_program("relax", "start.json", "-o", "out.json", "--time-limit", "0.2 s",
                                code=1)
        self.check_what_overlaps(done.stderr, "out_of_time")

    def test_a_folder_that_vanishes_during_the_work_ends_with_1_and_says_so(self):
        (self.folder / "gone").mkdir()
        self.write("endless.toml", ENDLESS)
        process = subprocess.Popen([PROGRAM, "pack", "endless.toml", "-o", "gone/out.json", "--quiet",
                                    "--time-limit", "2 s"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.0)
        (self.folder / "gone").rmdir()
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 1, stderr)
        self.assertIn("gone/out.json: cannot be written", stderr)

    def test_a_shortfall_is_one_in_json_too(self):
        self.write("endless.toml", ENDLESS)
        done = self.run_program("pack", "endless.toml", "-o", "out.json", "--set",
                                "packing.rsa.max_restarts=0", "--json", code=1)
        summary = json.loads(done.stdout)
        self.assertFalse(summary["target_reached"])
        self.assertEqual(summary["stop"], "saturated")
        self.assertLess(summary["groups"][0]["count"], 60)
        self.check_kept("saturated")

    def test_progress_in_a_log_is_plain_lines(self):
        process = self.start(subprocess.PIPE)
        time.sleep(3.0)
        process.send_signal(signal.SIGINT)
        stderr = process.communicate(timeout=120)[1]
        plan, warning, progress = stderr.split("\n")[:3]
        self.assertTrue(plan.startswith("packstone: rsa (as ordered): 20 inclusions"), plan)
        self.assertTrue(warning.startswith("packstone: warning: rsa never moves"), warning)
        self.assertRegex(progress, r"\d+ of 20")
        self.assertNotIn("\r", stderr)

    def test_progress_on_a_terminal_is_one_line_that_is_wiped_at_the_end(self):
        terminal, side = pty.openpty()
        process = self.start(side)
        os.close(side)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=120)
        text = b""
        try:
            while chunk := os.read(terminal, 65536):
                text += chunk
        except OSError:  # the other side is closed
            pass
        os.close(terminal)
        line = text.decode().split("packstone: ")[2].split("\n", 1)[1]  # after plan and warning
        self.assertGreater(line.count("\r"), 3)
        self.assertNotIn("\n", line)
        self.assertTrue(line.endswith("\r\x1b[K"), repr(line[-40:]))


if __name__ == "__main__":
    unittest.main()
