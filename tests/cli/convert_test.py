"""bihive convert: what was read, in another format, and what it says of it."""

import os

import numpy
from program import ProgramTest, main, png_pixels

PDB = (
    "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N  \n"
    "ATOM      2  CA  ALA A   1      12.100   6.200  -6.500  0.50 21.25           C  \n"
    "HETATM    3 ZN    ZN B   2      10.125   0.000   3.000  0.50 15.00          ZN  \n"
)


class Convert(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.pdb", PDB)

    def test_every_format_comes_back_with_the_same_numbers(self):
        first = self.succeed_json("info", "demo")
        for name in ("a.csv", "a.extxyz", "a.npy", "a.json"):
            self.succeed("convert", "demo", "-o", name)
            again = self.succeed_json("info", name)
            for key in ("spheres", "bounds"):
                self.assertEqual(again.get(key), first.get(key), name)
        self.succeed("convert", "a.csv", "-o", "b.csv")
        self.assertEqual(self.read("a.csv"), self.read("b.csv"))

    def test_formats_by_ending_and_by_option(self):
        self.assertEqual(
            self.succeed("convert", "a.pdb", "-o", "a.xyz"),
            "a.xyz: 3 spheres as XYZ, 55 bytes\n  not as it was: radius, occupancy, b_factor, resid, serial, record, chain, "
            "resname, name: plain XYZ holds symbols and places alone; extended XYZ (.extxyz) holds them\n",
        )
        self.assertEqual(self.read("a.xyz"), b"3\n\nN 11.104 6.134 -6.504\nC 12.1 6.2 -6.5\nZn 10.125 0 3\n")
        self.succeed("convert", "a.pdb", "-o", "a.txt", "--format", "csv")
        self.assertIn(b"element,x,y,z,radius", self.read("a.txt"))
        self.succeed("convert", "a.pdb", "-o", "a.ply")
        self.assertTrue(self.read("a.ply").startswith(b"ply\nformat ascii 1.0\n"))
        self.succeed("convert", "a.pdb", "-o", "a.npy")
        numpy.testing.assert_array_equal(
            numpy.load(self.path("a.npy"))[2], numpy.array([10.125, 0, 3, 1.39], dtype="float32")
        )

    def test_molecules_keep_their_bonds(self):
        head = "ethene\n\n\n  3  2  0  0  0  0            999 V2000\n"
        self.write("e.sdf", head + "    0.0000    0.0000    0.0000 C   0  5\n    1.3400    0.0000    0.0000 C   0  0\n"
                   "   -0.5000    0.9000    0.0000 H   0  0\n  1  2  2  0\n  1  3  1  0\nM  CHG  1   1  -1\nM  END\n$$$$\n")
        bonds = self.succeed_json("info", "e.sdf")["bonds"]
        self.assertEqual(bonds["orders"], {"single": 1, "double": 1})
        for name in ("b.sdf", "b.mol", "b.mol2"):
            self.succeed("convert", "e.sdf", "-o", name)
            again = self.succeed_json("info", name)
            self.assertEqual(again["bonds"], bonds, name)
            self.assertEqual(again["title"], "ethene", name)
            self.succeed("convert", name, "-o", "c.extxyz")
            self.assertIn(b"-1", self.read("c.extxyz").splitlines()[2], name)
        self.succeed("convert", "b.sdf", "-o", "c.sdf")
        self.assertEqual(self.read("b.sdf"), self.read("c.sdf"))
        # What no file states is found by distance.
        done = self.succeed("convert", "a.pdb", "-o", "d.mol2")
        self.assertIn("1 bond is found by distance", done)
        self.assertEqual(self.succeed_json("info", "d.mol2")["bonds"], {"stated": 1, "orders": {}, "by_distance": None})
        self.assertIn(b"2 CA 12.1 6.2 -6.5 C 1 ALA", self.read("d.mol2"))
        self.assertIn("single", self.succeed("convert", "a.pdb", "-o", "d.sdf"))

    def test_a_scene_draws_the_same_picture(self):
        self.succeed("convert", "a.pdb", "-o", "a.json")
        for source, options in (("a.pdb", ["--style", "plain"]), ("a.json", [])):
            self.succeed("render", source, *options, "-o", source + ".png", "--size", "64x36")
        self.assertEqual(png_pixels(self.read("a.pdb.png")), png_pixels(self.read("a.json.png")))

    def test_selected_spheres_alone(self):
        self.succeed("convert", "a.pdb", "-o", "b.csv", "--select", "element C or chain B")
        self.assertEqual(self.succeed_json("info", "b.csv")["spheres"], 2)
        self.assertIn("no sphere is selected", self.fail_input("convert", "a.pdb", "-o", "c.csv", "--select", "none"))
        done = self.run_bihive("convert", "a.pdb", "-o", "c.csv", "--select", "elephant C")
        self.assertEqual(done.returncode, 2)

    def test_standard_output_and_json(self):
        # The report goes to stderr.
        done = self.run_bihive("convert", "a.pdb", "-o", "-", "--format", "xyz")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(done.stdout, "3\n\nN 11.104 6.134 -6.504\nC 12.1 6.2 -6.5\nZn 10.125 0 3\n")
        self.assertIn("3 spheres as XYZ", done.stderr)
        self.assertFalse(os.path.exists(self.path("-")))
        report = self.succeed_json("convert", "a.pdb", "-o", "a.npy")
        self.assertEqual((report["spheres"], report["format"], report["input_format"]), (3, "npy", "PDB"))
        self.assertEqual(report["bytes"], len(self.read("a.npy")))
        self.assertEqual(len(report["left_out"]), 1)

    def test_what_is_refused(self):
        self.fail_usage("convert", "a.pdb", "-o", "a.jpg")
        self.fail_usage("convert", "a.pdb", "-o", "-")
        self.fail_usage("convert", "a.pdb", "-o", "-", "--format", "csv", "--json")
        self.fail_usage("convert", "a.pdb", "-o", "a.csv", "--format", "pdf")
        self.fail_usage("convert", "a.pdb")
        self.fail_input("convert", "a.pdb", "-o", "nowhere/a.csv")
        os.link(self.path("a.pdb"), self.path("b.csv"))
        self.assertIn("is the input a.pdb too", self.fail_input("convert", "a.pdb", "-o", "b.csv"))


if __name__ == "__main__":
    main()
