"""Help, versions, and what wrong usage is told."""

import os
import unittest

from cli_case import ENDLESS, EXAMPLES, Case

COMMANDS = ["new", "pack", "relax", "check", "measure", "draw", "tessellate", "export"]


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
        for library in ["oneTBB", "HDF5", "Eigen", "nlohmann-json", "toml++", "CLI11", "BSD-3-Clause"]:
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
                          ("check", "missing.json", "--witness", "/proc/w.csv"),
                          ("measure", "missing.json", "-o", "/proc/r.json")]:
            done = self.run_program(*arguments, code=2)
            self.assertIn(arguments[-1] + ": cannot be written", done.stderr)
        for command, output in [("draw", "p.bmp"), ("export", "p.obj"), ("measure", "r.csv")]:
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


if __name__ == "__main__":
    unittest.main()
