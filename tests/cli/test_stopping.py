"""Runs that end early: interrupts, time limits, shortfalls, progress."""

import json
import os
import pty
import signal
import subprocess
import time
import unittest

from cli_case import ENDLESS, PROGRAM, Case


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
        self.assertRegex(stderr.split("\n")[0], r"\d+ of 20")
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
        line = text.decode().split("packstone: ")[0]
        self.assertGreater(line.count("\r"), 3)
        self.assertNotIn("\n", line)
        self.assertTrue(line.endswith("\r\x1b[K"), repr(line[-40:]))


if __name__ == "__main__":
    unittest.main()
