"""Cells for the inclusions of a packing."""

import csv
import json
import signal
import subprocess
import time
import unittest

from cli_case import EXAMPLES, PROGRAM, Case

ELLIPSES = """[cell]
size = [2, 1]
[[inclusions]]
name = "ellipses"
shape = "ellipse"
aspect = 2
count = 60
fraction = 0.5
[packing]
method = "relaxation"
"""


class Tessellating(Case):
    def pack_ellipses(self, *arguments):
        self.run_program("pack", self.write("e.toml", ELLIPSES), "-o", "e.json", *arguments)

    def table(self, name):
        with open(self.folder / name, newline="") as lines:
            return list(csv.DictReader(lines))

    def test_cells_measure_as_ordered_and_the_published_ones_are_told_beside(self):
        self.pack_ellipses()
        done = self.run_program("tessellate", "e.json", "-o", "c.vtu", "-o", "c.csv")
        self.assertIn("c.vtu, c.csv\n60 cells of ", done.stdout)
        self.assertRegex(done.stdout, r"\n  made +\d")
        self.assertRegex(done.stdout, r"\n  published +0\.\d")
        rows = self.table("c.csv")
        self.assertEqual([row["inclusion"] for row in rows], [str(i) for i in range(60)])
        self.assertAlmostEqual(sum(float(row["area"]) for row in rows), 2, places=9)
        for row in rows:
            self.assertAlmostEqual(float(row["area"]) / float(row["ordered_area"]), 1, places=8)
        self.assertGreater((self.folder / "c.vtu").stat().st_size, 10000)

    def test_the_summary_for_machines_has_files_and_errors(self):
        self.pack_ellipses()
        done = self.run_program("tessellate", "e.json", "-o", "c.csv", "--json", "--shape-rounds", 3)
        summary = json.loads(done.stdout)
        self.assertEqual(summary["files"], ["c.csv"])
        self.assertEqual((summary["cells"], summary["stop"]), (60, "finished"))
        self.assertEqual(summary["shape_rounds"], 3)
        self.assertLess(summary["made"]["largest_measure_error"], 1e-8)
        self.assertGreater(summary["published"]["measure_spread"], 0.01)

    def test_options_change_the_cells_and_threads_do_not(self):
        self.pack_ellipses()
        tables = {}
        for options in [[], ["--published"], ["--no-inflate"], ["--no-ordered-measures"],
                        ["--spacing", "0.2"], ["--shape-rounds", "2"]]:
            self.run_program("tessellate", "e.json", "-o", "c.csv", "--quiet", *options)
            tables[" ".join(options)] = (self.folder / "c.csv").read_text()
        self.assertEqual(len(set(tables.values())), len(tables))
        self.run_program("tessellate", "e.json", "-o", "c.csv", "--quiet", "--threads", "2")
        self.assertEqual((self.folder / "c.csv").read_text(), tables[""])
        self.run_program("tessellate", "e.json", "-o", "c.csv", "--quiet", "--no-inflate",
                         "--no-ordered-measures")
        self.assertEqual((self.folder / "c.csv").read_text(), tables["--published"])

    def test_every_format_of_polygons_comes_from_one_run(self):
        self.pack_ellipses()
        names = ["c.csv", "c.geo", "c.png", "c.svg", "c.tess", "c.vtu"]
        self.run_program("tessellate", "e.json", "--color-by", "orientation", "--inclusions",
                         *[word for name in names for word in ("-o", name)])
        self.assertEqual(self.files(), [*names, "e.json", "e.toml"])
        self.assertIn("Periodic Curve", (self.folder / "c.geo").read_text())
        self.assertTrue((self.folder / "c.tess").read_text().startswith("***tess"))
        self.assertIn("<svg", (self.folder / "c.svg").read_text())
        self.assertEqual((self.folder / "c.png").read_bytes()[:4], b"\x89PNG")

    def test_inclusions_in_space_get_polyhedra(self):
        self.run_program("pack", EXAMPLES / "spheres.toml", "-o", "s.json", "--quiet")
        self.run_program("tessellate", "s.json", "-o", "c.csv", "-o", "c.vtu", "--quiet")
        rows = self.table("c.csv")
        self.assertEqual(len(rows), len(self.read("s.json")["inclusions"]))
        self.assertTrue(all(int(row["neighbors"]) >= 4 for row in rows))
        for name in ["c.geo", "c.svg"]:
            done = self.run_program("tessellate", "s.json", "-o", name, code=2)
            self.assertIn("the cells of s.json are polyhedra; write .vtu", done.stderr)
        self.run_program("tessellate", "s.json", "-o", "c.tess", "--inclusions", code=2)
        self.assertNotIn("c.tess", self.files())

    def test_ctrl_c_keeps_the_cells_so_far(self):
        self.pack_ellipses()
        running = subprocess.Popen([PROGRAM, "tessellate", "e.json", "-o", "c.csv", "--shape-rounds",
                                    "1000", "--spacing", "0.02"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        running.send_signal(signal.SIGINT)
        _, errors = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 130, errors)
        self.assertIn("interrupted", errors)
        self.assertAlmostEqual(sum(float(row["area"]) for row in self.table("c.csv")), 2, places=9)

    def test_a_time_limit_keeps_the_cells_so_far_and_says_so(self):
        self.pack_ellipses()
        done = self.run_program("tessellate", "e.json", "-o", "c.csv", "--shape-rounds", "1000",
                                "--spacing", "0.02", "--time-limit", "0.3 s", code=1)
        self.assertIn("time limit", done.stderr)
        self.assertIn("c.csv", self.files())

    def test_what_makes_no_sense_is_refused_before_work(self):
        self.pack_ellipses()
        for arguments, words in [(["-o", "c.xyz"], "unknown ending .xyz"),
                                 (["-o", "c.vtu", "-o", "no/c.csv"], "there is no folder no"),
                                 (["-o", "c.vtu", "--spacing", "2"], "2; allowed is 0.01 to 1"),
                                 (["-o", "c.vtu", "--published", "--shape-rounds", "2"],
                                  "--published has no rounds")]:
            done = self.run_program("tessellate", "e.json", *arguments, code=2)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.files(), ["e.json", "e.toml"])


if __name__ == "__main__":
    unittest.main()
