"""Packings: what they hold, and what is said about them."""

import json
import shutil
import unittest

from cli_case import EXAMPLES, Case


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


if __name__ == "__main__":
    unittest.main()
