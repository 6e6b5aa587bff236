"""Drives the program as a user does: exit codes, messages, files. Standard library only."""

import json
import os
import pathlib
import pty
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["PACKSTONE"]
EXAMPLES = pathlib.Path(os.environ["PACKSTONE_EXAMPLES"])
COMMANDS = ["new", "pack", "check", "draw", "export"]

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


class Usage(Case):
    def test_help_fits_a_screen_and_ends_with_an_example(self):
        for command in [[], *[[c] for c in COMMANDS]]:
            text = self.run_program(*command, "--help").stdout
            lines = text.rstrip("\n").split("\n")
            self.assertLessEqual(len(lines), 24, text)
            self.assertLessEqual(max(map(len, lines)), 80, text)
            self.assertIn("Example: packstone", lines[-1], text)

    def test_help_shows_what_is_built_and_nothing_else(self):
        text = self.run_program("--help").stdout
        listed = text[text.index("Subcommands:"):].split("\n")[1:]
        self.assertEqual([line.split()[0] for line in listed if line.startswith("  ")], COMMANDS)

    def test_version_names_libraries_and_licenses(self):
        text = self.run_program("--version").stdout
        self.assertRegex(text, r"^packstone \d+\.\d+\.\d+ \(Apache-2\.0\)")
        for library in ["oneTBB", "HDF5", "nlohmann-json", "toml++", "CLI11", "BSD-3-Clause"]:
            self.assertIn(library, text)
        self.assertIn("No component under the GPL", text)

    def test_wrong_usage_ends_with_2_and_speaks_on_standard_error(self):
        fibers = EXAMPLES / "fibers.toml"
        for arguments in [[], ["frobnicate"], ["pack"], ["pack", "--frobnicate"], ["check"],
                          ["draw", "x.json"], ["new"], ["new", "cubes"],
                          ["pack", fibers, "--seed", "-1"], ["pack", fibers, "--seed", "x"],
                          ["pack", fibers, "--threads", "-2"],
                          ["pack", fibers, "--time-limit", "soon"]]:
            done = self.run_program(*arguments, code=2)
            self.assertEqual(done.stdout, "", arguments)
            self.assertNotEqual(done.stderr, "", arguments)
        self.assertEqual(self.files(), [])

    def test_an_output_that_cannot_be_written_is_refused_before_work(self):
        recipe = self.write("endless.toml", ENDLESS)
        (self.folder / "taken.json").mkdir()
        for output, words in [("out.xyz", "allowed is one of .json, .h5"), ("out", "no ending"),
                              ("nowhere/out.json", "there is no folder nowhere"),
                              ("taken.json", "is a folder"),
                              ("/proc/out.json", "/proc/out.json: cannot be written")]:
            done = self.run_program("pack", recipe, "-o", output, code=2)
            self.assertIn(words, done.stderr)
        for arguments in [("draw", "missing.json", "-o", "/proc/p.png"),
                          ("export", "missing.json", "-o", "/proc/p.vtu"),
                          ("check", "missing.json", "--witness", "/proc/w.csv")]:
            done = self.run_program(*arguments, code=2)
            self.assertIn(arguments[-1] + ": cannot be written", done.stderr)
        for command, output in [("draw", "p.bmp"), ("export", "p.obj")]:
            done = self.run_program(command, "missing.json", "-o", output, code=2)
            self.assertIn("unknown ending", done.stderr)

    def test_messages_say_what_is_wrong_and_what_was_likely_meant(self):
        fibers = EXAMPLES / "fibers.toml"
        self.pack_fibers()
        self.write("flat.toml", "[cell]\nsize = [1, 1]\n[[inclusions]]\nshape = \"disk\"\n"
                                "radius = 0.1\ncount = 3\n")
        self.run_program("pack", "flat.toml")
        (self.folder / "folder").mkdir()
        for arguments, words in [
                ([], "a command is missing; commands: new, pack"),
                (["pakc", fibers], "pakc is no command; did you mean pack?"),
                (["pack", fibers, "--seeed", "3"],
                 "--seeed is no option of pack; did you mean --seed?"),
                (["pack", fibers, "--time-limit", "soon"], "soon; allowed is a time > 0"),
                (["pack", "folder"], "cannot read folder: it is a folder"),
                (["pack", "missing.toml"], "missing.toml: there is no such file"),
                (["pack", fibers, "--set", "pakcing.seed=3"],
                 '--set pakcing.seed=3: unknown key "pakcing"; did you mean "packing"?'),
                (["check", "fibers.json", "--min-gap", "-1"], "--min-gap: -1; allowed is a number"),
                (["draw", "fibers.json", "-o", "x.png", "--color-by", "hue"],
                 "hue; allowed is group, size or orientation"),
                (["draw", "fibers.json", "-o", "x.png", "--elevation", "90"],
                 "--elevation: 90; allowed is -89 to 89"),
                (["export", "flat.json", "-o", "x.stl"], "flat.json is a packing in the plane")]:
            done = self.run_program(*arguments, code=2)
            self.assertTrue(done.stderr.startswith("packstone: "), done.stderr)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stdout, "", arguments)

    @unittest.skipIf(os.geteuid() == 0, "the administrator may write everywhere")
    def test_a_folder_without_permission_is_refused_before_work(self):
        recipe = self.write("endless.toml", ENDLESS)
        (self.folder / "locked").mkdir(mode=0o500)
        done = self.run_program("pack", recipe, "-o", "locked/out.json", code=2)
        self.assertIn("no permission", done.stderr)


class Recipes(Case):
    def test_every_template_is_listed_and_is_an_example(self):
        examples = [path.read_text() for path in EXAMPLES.glob("*.toml")]
        listed = self.run_program("new", "--list").stdout.splitlines()
        self.assertGreaterEqual(len(listed), 8)
        for line in listed:
            name = line.split()[0]
            self.run_program("new", name, "-o", f"{name}.toml")
            text = self.run_program("new", name).stdout
            self.assertEqual(text, (self.folder / f"{name}.toml").read_text())
            self.assertIn(text, examples)

    def test_every_example_packs_and_checks(self):
        examples = sorted(EXAMPLES.glob("*.toml"))
        self.assertGreaterEqual(len(examples), 9)
        for example in examples:
            with self.subTest(example.name):
                done = self.run_program("pack", example, "-o", "out.json", "--json")
                summary = json.loads(done.stdout)
                self.assertTrue(summary["target_reached"])
                gap = summary["certificate"]["min_gap"]
                self.run_program("check", "out.json", "--min-gap", gap)

    def test_a_wrong_recipe_ends_with_2_and_names_file_line_and_range(self):
        recipe = self.write("bad.toml", ENDLESS.replace("0.58", "1.5").replace("count", "cuont"))
        done = self.run_program("pack", recipe, code=2)
        self.assertIn('bad.toml:6: unknown key "inclusions[0].cuont"; did you mean "count"?',
                      done.stderr)
        self.assertIn("bad.toml:7: inclusions[0].fraction = 1.5; allowed is a number > 0 and < 1",
                      done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), ["bad.toml"])
        self.run_program("pack", "missing.toml", code=2)

    def test_what_is_proven_impossible_is_refused_before_work(self):
        recipe = self.write("r.toml", ENDLESS)
        for override, words in [("inclusions[0].fraction=0.75", "the densest packing there is"),
                                ("packing.min_gap=0.3", "allowed")]:
            done = self.run_program("pack", recipe, "--set", override, code=2)
            self.assertIn(words, done.stderr)
        for group, words in [
                ('shape = "sphere"\nradius = 1e-6\nfraction = 0.1', "e+16 inclusions"),
                ('shape = "cylinder"\ncount = 3\naspect = 1e6\nfraction = 0.01', "500 periods"),
                ('shape = "sphere"\nradius = 0.6\ncount = 1', "its own periodic image")]:
            text = "[cell]\nsize = [1, 1, 1]\n[[inclusions]]\n" + group + "\n"
            done = self.run_program("pack", self.write("hopeless.toml", text), code=2)
            self.assertRegex(done.stderr, r"hopeless\.toml:[5-7]: inclusions\[0\]\.\w+ = ")
            self.assertIn(words, done.stderr)
        (self.folder / "hopeless.toml").unlink()
        self.write("large.toml", "[cell]\nsize = [1, 1, 1]\n[[inclusions]]\nshape = \"sphere\"\n"
                                 "radius = 0.6\n")
        self.assertNotEqual(self.run_program("pack", "large.toml", code=2).stderr, "")
        self.assertEqual(self.files(), ["large.toml", "r.toml"])

    def test_overrides_change_the_recipe_and_are_kept_with_the_packing(self):
        packing = self.pack_fibers("--seed", "7", "--set", "inclusions.fibers.count=20",
                                   "--set", "inclusions[1].count=15", "--set", "cell.size=[2,2,2]",
                                   "--time-limit", "1 min")
        groups = [inclusion["group"] for inclusion in packing["inclusions"]]
        self.assertEqual((groups.count("fibers"), groups.count("beads")), (20, 15))
        self.assertEqual(packing["cell"]["size"], [2, 2, 2])
        recipe = packing["provenance"]["recipe"]
        self.assertEqual(recipe["packing"]["seed"], 7)
        self.assertEqual(recipe["packing"]["time_limit"], 60)
        done = self.run_program("pack", EXAMPLES / "fibers.toml", "--set", "packing.sed=1", code=2)
        self.assertIn("--set packing.sed=1: unknown key", done.stderr)


class Packing(Case):
    def test_the_packing_is_certified_and_says_where_it_came_from(self):
        packing = self.pack_fibers()
        self.assertEqual(len(packing["inclusions"]), 100)
        self.assertAlmostEqual(packing["certificate"]["fraction"], 0.20, places=12)
        self.assertEqual(packing["certificate"]["overlaps"], 0)
        self.assertEqual(packing["provenance"]["method"], "rsa")
        self.assertEqual(packing["provenance"]["stop"], "target_reached")
        self.assertRegex(packing["provenance"]["version"], r"^\d+\.\d+\.\d+$")

    def test_the_same_recipe_gives_the_same_packing_for_any_number_of_threads(self):
        first = self.pack_fibers("--threads", "1")["inclusions"]
        self.assertEqual(first, self.pack_fibers("--threads", "3")["inclusions"])
        self.assertNotEqual(first, self.pack_fibers("--seed", "2")["inclusions"])

    def test_a_packing_is_its_own_recipe(self):
        first = self.pack_fibers("--seed", "5")["inclusions"]
        self.run_program("pack", "fibers.json", "-o", "again.h5")
        self.run_program("pack", "again.h5", "-o", "third.json")
        self.assertEqual(first, self.read("third.json")["inclusions"])
        self.assertIn("-o is missing", self.run_program("pack", "fibers.json", code=2).stderr)

    def test_without_o_the_packing_takes_the_name_of_the_recipe(self):
        shutil.copy(EXAMPLES / "walls.toml", self.folder)
        self.run_program("pack", "walls.toml", "--quiet")
        self.assertEqual(self.files(), ["walls.json", "walls.toml"])

    def test_the_summary_is_for_people_or_one_json_object(self):
        text = self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "f.json").stdout
        for words in ["f.json", "60 of 60", "40 of 40", "certified: no overlap", "auto"]:
            self.assertIn(words, text)
        done = self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "f.json", "--json")
        summary = json.loads(done.stdout)
        self.assertEqual(summary["packing"], "f.json")
        self.assertEqual([group["count"] for group in summary["groups"]], [60, 40])
        self.assertTrue(summary["certificate"]["passed"])
        self.assertTrue(summary["derived"])
        self.assertGreaterEqual(summary["trials"], 100)

    def test_quiet_is_silent(self):
        done = self.run_program("pack", EXAMPLES / "fibers.toml", "-o", "f.json", "--quiet")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_order_is_reported_beside_what_chance_gives(self):
        done = self.run_program("pack", EXAMPLES / "ellipsoids.toml", "-o", "e.json", "--json")
        orientation = json.loads(done.stdout)["groups"][0]["orientation"]
        for name in ("nematic_order", "rho"):
            chance = orientation[name]["random"]
            low, high = chance["interval_95"]
            self.assertLess(low, chance["mean"])
            self.assertLess(chance["mean"], high)
            self.assertLess(low - chance["standard_deviation"], orientation[name]["value"])
            self.assertLess(orientation[name]["value"], high + chance["standard_deviation"])
        done = self.run_program("pack", EXAMPLES / "ellipsoids.toml", "-o", "e.json")
        self.assertRegex(done.stdout, r"order S 0\.\d+ \(random 0\.\d+, 95 % in .* rho 1\.\d+ \(random")

    def test_redrawn_orientations_are_reported(self):
        recipe = EXAMPLES / "salnikov_mixture.toml"
        self.assertIn("redrawn", self.run_program("pack", recipe, "-o", "s.json").stdout)
        done = self.run_program("pack", recipe, "-o", "s.json", "--json")
        orientation = json.loads(done.stdout)["groups"][0]["orientation"]
        self.assertTrue(orientation["redrawn"])
        for tensor in (orientation["tensor"], orientation["tensor_ordered"]):
            self.assertAlmostEqual(sum(tensor[i][i] for i in range(3)), 1.0, places=12)
        self.assertNotEqual(orientation["tensor"], orientation["tensor_ordered"])

    def test_a_prescribed_tensor_is_met_by_what_stands(self):
        done = self.run_program("pack", EXAMPLES / "injection_fibers.toml", "-o", "i.json", "--json")
        tensor = json.loads(done.stdout)["groups"][0]["orientation"]["tensor"]
        ordered = [[0.70, 0.05, 0.0], [0.05, 0.25, 0.0], [0.0, 0.0, 0.05]]
        for i in range(3):
            for j in range(3):
                # The exact correction of the sample promises 1e-12; placing changes no direction.
                self.assertAlmostEqual(tensor[i][j], ordered[i][j], delta=1e-11)

    def test_a_size_alone_fills_the_cell_until_nothing_fits(self):
        done = self.run_program("pack", EXAMPLES / "saturated_spheres.toml", "-o", "s.json",
                                "--json", "--set", "cell.size=[12, 12, 12]")
        summary = json.loads(done.stdout)
        self.assertEqual(summary["stop"], "saturated")
        self.assertIsNone(summary["groups"][0]["count_ordered"])
        # 0.384 in the limit; a cell of six diameters spreads by a few percent.
        self.assertAlmostEqual(summary["certificate"]["fraction"], 0.384, delta=0.03)


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


class Motion(Case):
    def test_a_dense_recipe_is_packed_by_moving_bodies_and_says_so(self):
        recipe = EXAMPLES / "dense_ellipsoids.toml"
        text = self.run_program("pack", recipe, "-o", "d.json").stdout
        for words in ["100 of 100, fraction 0.55", "changed by the collisions", "<uu> as drawn",
                      "event-driven (as ordered)", "collisions, reduced pressure", "certified"]:
            self.assertIn(words, text)
        done = self.run_program("pack", EXAMPLES / "dense_mixture.toml", "-o", "m.json", "--json")
        summary = json.loads(done.stdout)
        self.assertEqual(summary["method"], "event-driven")
        self.assertIn("denser than rsa", summary["method_reason"])
        self.assertEqual(summary["motion"]["size_factor"], 1)
        self.assertGreater(summary["motion"]["collisions"], 100)
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


class Pictures(Case):
    def test_a_packing_is_drawn_and_exported_by_ending(self):
        self.pack_fibers()
        self.run_program("draw", "fibers.json", "-o", "f.png", "--color-by", "orientation", "--cut",
                         "--azimuth", "-20", "--width", "64", "--height", "48", "--samples", "1")
        data = (self.folder / "f.png").read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (64, 48))
        for name in ["f.vtu", "f.csv", "f.stl"]:
            self.run_program("export", "fibers.json", "-o", name, "--segments", "12", "--images")
            self.assertGreater((self.folder / name).stat().st_size, 1000)
        lines = (self.folder / "f.csv").read_text().splitlines()
        self.assertTrue(lines[0].endswith(",image_x,image_y,image_z,cuts"))
        for line in lines[1:]:
            x, y, z, cuts = line.split(",")[-4:]
            self.assertTrue(cuts or (x, y, z) == ("0", "0", "0"), line)
        self.run_program("draw", "fibers.json", "-o", "f.png", "--color-by", "taste", code=2)

    def test_a_packing_in_the_plane_is_drawn_as_svg(self):
        self.run_program("pack", EXAMPLES / "ellipses_2d.toml", "-o", "e.json", "--quiet")
        self.run_program("draw", "e.json", "-o", "e.svg")
        self.assertIn("<svg", (self.folder / "e.svg").read_text())
        self.pack_fibers()
        self.run_program("draw", "fibers.json", "-o", "f.svg", code=2)
        self.assertNotIn("f.svg", self.files())


if __name__ == "__main__":
    unittest.main()
