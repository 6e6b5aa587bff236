"""Drawing and exports."""

import struct
import unittest

from cli_case import EXAMPLES, Case


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
