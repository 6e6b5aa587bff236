"""Templates, examples, and recipes that are refused."""

import json
import unittest

from cli_case import ENDLESS, EXAMPLES, Case


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

    def check_pack(self, recipes):
        for recipe in recipes:
            with self.subTest(recipe.name):
                done = self.run_program("pack", recipe, "-o", "out.json", "--json")
                summary = json.loads(done.stdout)
                self.assertTrue(summary["target_reached"])
                self.assertTrue(summary["certificate"]["passed"])
                gap = summary["certificate"]["min_gap"]
                self.run_program("check", "out.json", "--min-gap", gap)

    def test_every_example_packs_and_checks(self):
        examples = sorted(EXAMPLES.glob("*.toml"))
        self.assertGreaterEqual(len(examples), 9)
        self.check_pack(examples)

    def test_every_recipe_of_ghossein_and_levesque_packs_and_checks(self):
        recipes = sorted((EXAMPLES / "ghossein_levesque_2013").glob("*.toml"))
        self.assertGreaterEqual(len(recipes), 9)
        self.check_pack(recipes)

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

    def test_before_the_work_it_is_said_what_is_chosen_why_and_what_to_expect(self):
        done = self.run_program("pack", EXAMPLES / "relaxed_fibers.toml", "-o", "f.json", "--set",
                                "packing.method=auto", "--json")
        plan, *_ = done.stderr.split("\n")
        self.assertRegex(plan, r"^packstone: relaxation \(auto: denser than rsa surely reaches\): "
                               r"\d+ inclusions, fraction 0\.2\d*; random packings of such reach "
                               r"about 0\.4\d; it takes a second or less$")
        told = json.loads(done.stdout)["plan"]
        self.assertAlmostEqual(told["fraction"], 0.25, places=2)
        self.assertAlmostEqual(told["reachable"], 0.42, delta=0.02)
        self.assertLess(told["seconds"], 2)
        self.assertIsNone(told["warning"])

    def test_what_random_packings_are_not_known_to_reach_is_warned_of_and_tried(self):
        dense = ENDLESS.replace('"rsa"', '"relaxation"').replace("0.58", "0.7")
        done = self.run_program("pack", self.write("dense.toml", dense), "-o", "out.json",
                                "--time-limit", "0.5 s", "--json", code=1)
        self.assertIn("packstone: warning: fraction 0.7 is above the 0.64 that random packings",
                      done.stderr)
        self.assertIsNone(json.loads(done.stdout)["plan"]["seconds"])
        done = self.run_program("pack", "dense.toml", "-o", "out.json", "--quiet", "--time-limit",
                                "0.1 s", code=1)
        self.assertNotIn("warning", done.stderr)

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


if __name__ == "__main__":
    unittest.main()
