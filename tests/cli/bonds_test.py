"""Bonds in pictures: `bihive render --bonds`, the styles that draw them, and where they are refused."""

import json
import os

from program import ProgramTest, main

SIZE = ["--size", "80x60", "--samples", "1", "--threads", "1"]
WATER = "3\n\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\n"
SDF = """


  3  1  0  0  0  0            999 V2000
    0.0000    0.0000    0.0000 O   0  0
    0.9600    0.0000    0.0000 H   0  0
   -0.2400    0.9300    0.0000 H   0  0
  1  2  1  0
M  END
"""


class Bonds(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("w.xyz", WATER)
        self.write("w.sdf", SDF)
        self.write("points.csv", "x,y,z,r\n0,0,0,1\n1,0,0,1\n")

    def picture(self, *options):
        return self.succeed_json("render", "w.xyz", "-o", "a.png", *SIZE, *options)

    def test_every_engine_draws_the_same_bits(self):
        hashes = {self.picture("--style", "ball-and-stick", "--engine", engine)["picture_hash"]
                  for engine in ("wide", "reference", "brute", "wide-brute")}
        self.assertEqual(len(hashes), 1)
        self.assertNotIn(self.picture()["picture_hash"], hashes)

    def test_a_style_is_its_options(self):
        style = self.picture("--style", "licorice")["picture_hash"]
        self.assertEqual(self.picture("--bonds", "auto", "--stick-radius", "0.22", "--ball-scale", "0")["picture_hash"], style)
        self.assertNotEqual(self.picture("--style", "licorice", "--stick-radius", "0.3")["picture_hash"], style)
        # Without bonds a style of bonds draws spheres as they are.
        self.assertEqual(self.picture("--style", "licorice", "--bonds", "none")["picture_hash"], self.picture()["picture_hash"])

    def test_hidden_atoms_have_no_bonds(self):
        self.write("oh.xyz", "2\n\nO 0 0 0\nH 0.96 0 0\n")
        camera = ["--eye", "0,0,9", "--look-at", "0,0,0", "--fog", "0", "--style", "licorice"]
        hidden = self.picture("--select", "index 2", "--hide", *camera)["picture_hash"]
        alone = self.succeed_json("render", "oh.xyz", "-o", "b.png", *SIZE, *camera)["picture_hash"]
        self.assertEqual(hidden, alone)

    def test_bonds_found_too_far_or_nowhere(self):
        done = self.run_bihive("render", "w.xyz", "-o", "a.png", *SIZE, "--bonds", "distance", "--bond-reach", "0.5")
        self.assertEqual(done.returncode, 0)
        self.assertIn("no two atoms are near enough for a bond", done.stderr)

    def test_the_layers(self):
        self.succeed("render", "w.xyz", "-o", "a.exr", *SIZE, "--style", "licorice", "--layers", "depth,normal,id,attribute:element")

    def test_transparent_ones_count_by_every_rule(self):
        hashes = []
        for rule in ("each_surface", "once", "first", "as_one"):
            clear = ["--style", "ball-and-stick", "--opacity", "0.4", "--opacity-rule", rule]
            of_engines = {self.picture(*clear, "--engine", engine)["picture_hash"] for engine in ("wide", "reference", "brute")}
            self.assertEqual(len(of_engines), 1, rule)
            hashes += of_engines
        self.assertEqual(len(set(hashes)), 4)
        # Beside opaque ones, and between both: a bond of two parts.
        parts = ["--style", "ball-and-stick", "--select", "index 1", "--opacity", "0.4"]
        self.assertEqual(len({self.picture(*parts, "--engine", engine)["picture_hash"] for engine in ("wide", "reference", "brute")}), 1)
        self.assertIn("overlapping", self.fail_usage("render", "w.xyz", *SIZE, "-o", "a.png", "--opacity", "0.5", "--opacity-rule", "as_one",
                                                     "--engine", "gpu"))

    def test_what_is_refused(self):
        def refused(*words):
            return self.fail_usage("render", *words, *SIZE, "-o", "a.png")

        self.assertIn("known elements", refused("points.csv", "--bonds", "distance"))
        self.assertIn("states no bonds", refused("w.xyz", "--bonds", "file"))
        self.assertIn("bonds by distance", refused("w.sdf", "--bonds", "file", "--bond-reach", "1.3"))
        self.assertIn("tree", refused("w.xyz", "--bonds", "distance", "--view", "traversal"))
        self.assertIn("--bonds", refused("w.xyz", "--stick-radius", "0.1"))
        self.assertIn("--bonds", refused("w.xyz", "--ball-scale", "0.1"))
        self.assertIn("draws no bonds", refused("w.xyz", "--bonds", "distance", "--engine", "gpu"))

    def test_bonds_of_a_file(self):
        small = ["--ball-scale", "0.2"]  # else the atoms hide their bonds
        by_distance = self.picture("--bonds", "distance", *small)["picture_hash"]
        of_file = {bonds: self.succeed_json("render", "w.sdf", "-o", "a.png", *SIZE, "--bonds", bonds, *small)["picture_hash"]
                   for bonds in ("file", "auto", "distance")}
        # The file leaves one bond out.
        self.assertEqual(of_file["file"], of_file["auto"])
        self.assertNotEqual(of_file["file"], of_file["distance"])
        self.assertEqual(of_file["distance"], by_distance)
        self.assertIn("  bonds             1 stated (1 single)\n", self.succeed("info", "w.sdf"))
        self.assertEqual(self.succeed_json("info", "w.sdf")["bonds"], {"stated": 1, "orders": {"single": 1}, "by_distance": None})
        self.assertEqual(self.succeed_json("info", "w.xyz")["bonds"], {"stated": 0, "orders": {}, "by_distance": 2})
        self.assertIsNone(self.succeed_json("info", "points.csv")["bonds"]["by_distance"])

    def test_orders_of_a_file(self):
        self.write("d.sdf", SDF.replace("O   0  0\n    0.96", "C   0  0\n    1.20").replace("0.0000 H   0  0\n   -0.24", "0.0000 O   0  0\n   -0.24")
                   .replace("  3  1  0", "  3  2  0").replace("  1  2  1  0\n", "  1  2  2  0\n  1  3  1  0\n"))
        draw = ["d.sdf", "-o", "a.png", *SIZE, "--style", "ball-and-stick"]
        with_orders = {self.succeed_json("render", *draw, "--engine", engine)["picture_hash"] for engine in ("wide", "reference", "brute", "wide-brute")}
        self.assertEqual(len(with_orders), 1)
        without = self.succeed_json("render", *draw, "--no-bond-orders")
        self.assertNotIn(without["picture_hash"], with_orders)
        self.assertEqual(self.succeed_json("render", *draw, "--bonds", "distance")["picture_hash"], without["picture_hash"])
        # Licorice draws them if it is asked to.
        licorice = ["d.sdf", "-o", "a.png", *SIZE, "--style", "licorice"]
        self.assertEqual(self.succeed_json("render", *licorice, "--no-bond-orders")["picture_hash"], self.succeed_json("render", *licorice)["picture_hash"])
        drawn = self.succeed_json("render", *licorice, "--bond-orders")
        self.assertNotEqual(drawn["picture_hash"], self.succeed_json("render", *licorice)["picture_hash"])
        self.assertIs(drawn["settings"]["bond_orders"], True)
        # Transparent, between atoms of different opacity, cut and copied: the same on every engine.
        for more in (["--opacity", "0.4"], ["--select", "element O", "--opacity", "0.4"], ["--select", "all", "--clip", "plane:0,1,0,0"],
                     ["--cell-vectors", "4,0,0,0,4,0,0,0,4", "--replicate", "2x1x1"]):
            hashes = {self.succeed_json("render", *draw, *more, "--engine", engine)["picture_hash"] for engine in ("wide", "reference", "brute")}
            self.assertEqual(len(hashes), 1, more)
        self.assertIn("bonds of the file", self.fail_usage("render", "d.sdf", "-o", "a.png", *SIZE, "--bonds", "distance", "--bond-orders"))
        self.assertIn("--bonds", self.fail_usage("render", "d.sdf", "-o", "a.png", *SIZE, "--bond-orders"))

    def test_bonds_across_the_cell(self):
        self.write("c.xyz", "2\n\nO 0.1 5 5\nC 9.1 5 5\n")
        cell = ["--cell-vectors", "10,0,0,0,10,0,0,0,10"]
        self.assertEqual(self.succeed_json("info", "c.xyz", *cell)["bonds"]["by_distance"], 1)
        self.assertEqual(self.succeed_json("info", "c.xyz")["bonds"]["by_distance"], 0)
        small = ["c.xyz", "-o", "a.png", *SIZE, "--bonds", "distance", "--ball-scale", "0.2", "--json"]
        crossed = self.succeed_json("render", *small[:-1], *cell)["picture_hash"]
        alone = self.run_bihive("render", *small)  # warns that no two atoms are near
        self.assertNotEqual(json.loads(alone.stdout)["picture_hash"], crossed)

    def test_copies_have_bonds_on_every_engine(self):
        self.write("c.xyz", "2\n\nO 0.1 5 5\nC 9.1 5 5\n")
        copies = [*SIZE, "--style", "licorice", "--cell-vectors", "10,0,0,0,10,0,0,0,10", "--replicate", "2x1x2"]
        hashes = {self.succeed_json("render", "c.xyz", "-o", "a.png", *copies, "--engine", engine)["picture_hash"]
                  for engine in ("wide", "reference", "brute", "wide-brute")}
        self.assertEqual(len(hashes), 1)
        self.succeed("render", "c.xyz", "-o", "a.exr", *copies, "--layers", "depth,id,attribute:element")

    def test_clips_cut_sticks_on_every_engine(self):
        clip = ["--style", "licorice", "--select", "all", "--clip", "plane:0,0,1,0"]
        hashes = {self.picture(*clip, "--engine", engine)["picture_hash"] for engine in ("wide", "reference", "brute", "wide-brute")}
        self.assertEqual(len(hashes), 1)
        self.assertNotIn(self.picture("--style", "licorice")["picture_hash"], hashes)

    def test_a_scene_file_has_them_too(self):
        self.write("s.json", '{"bihive_scene": 2, "spheres": {"file": "w.xyz"}, "picture": {"bonds": "distance", "ball_scale": 0.25, "stick_radius": 0.2}}')
        of_file = self.succeed_json("render", "s.json", "-o", "a.png", *SIZE)
        self.assertEqual(of_file["settings"]["bonds"], "distance")
        without = self.succeed_json("render", "s.json", "-o", "b.png", *SIZE, "--bonds", "none")
        self.assertNotEqual(of_file["picture_hash"], without["picture_hash"])


if __name__ == "__main__":
    main()
