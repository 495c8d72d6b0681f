"""Arrows and tubes in pictures: `bihive render --arrows` and `--trace`, and where they are refused."""

import json

from program import ProgramTest, main

SIZE = ["--size", "80x60", "--samples", "1", "--threads", "1"]
ENGINES = ("wide", "reference", "brute", "wide-brute")
VECTORS = "x,y,z,r,vx,vy,vz,mol\n0,0,0,0.5,0,2,0,1\n2,0,0,0.5,1,1,0,1\n4,1,0,0.5,2,0,-1,1\n6,0,0,0.5,0,0,0,1\n"


class Arrows(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("v.csv", VECTORS)

    def picture(self, *options):
        return self.succeed_json("render", "v.csv", "-o", "a.png", *SIZE, *options)["picture_hash"]

    def refused(self, *options):
        return self.fail_usage("render", "v.csv", *SIZE, "-o", "a.png", *options)

    def test_every_engine_draws_the_same_bits(self):
        for options in (["--arrows", "vx,vy,vz", "--arrow-colour", "vx:magma", "--ao"], ["--trace", "mol", "--ao", "--outline", "1"]):
            hashes = {self.picture(*options, "--engine", engine) for engine in ENGINES}
            self.assertEqual(len(hashes), 1, options)
            self.assertNotIn(self.picture("--ao"), hashes)
            # Copies, and cut open.
            cell = ["--cell-vectors", "8,0,0,0,5,0,0,0,5", "--replicate", "1x2x1"]
            self.assertEqual(len({self.picture(*options, *cell, "--engine", engine) for engine in ENGINES}), 1, options)
            clip = ["--clip", "plane:0,0,1,0"]
            self.assertEqual(len({self.picture(*options, *clip, "--engine", engine) for engine in ENGINES}), 1, options)

    def test_each_option_changes_the_picture(self):
        arrows = ["--eye", "3,0,20", "--look-at", "3,0,0", "--fog", "0", "--arrows", "vx,vy,vz"]
        seen = {self.picture(*arrows)}
        for option in (["--arrow-scale", "1.5"], ["--arrow-radius", "0.2"], ["--arrow-pivot", "middle"], ["--arrow-colour", "red"],
                       ["--arrow-colour", "vy:viridis"], ["--arrow-select", "index 1"]):
            picture = self.picture(*arrows, *option)
            self.assertNotIn(picture, seen, option)
            seen.add(picture)
        self.assertEqual(self.picture(*arrows, "--arrow-scale", "1"), self.picture(*arrows))
        self.assertEqual(self.picture(*arrows, "--arrow-radius", "0.125"), self.picture(*arrows))
        tubes = ["--eye", "3,0,20", "--look-at", "3,0,0", "--fog", "0", "--trace", "mol"]
        for option in ([], ["--trace-radius", "0.3"], ["--trace-radius", "0.1+x/20"], ["--trace-atoms", "shown"], ["--trace-select", "index < 2"]):
            picture = self.picture(*tubes, *option)
            self.assertNotIn(picture, seen, option)
            seen.add(picture)
        self.assertEqual(self.picture(*tubes, "--trace-radius", "r/4"), self.picture(*tubes))

    def test_the_whole_arrow_is_in_the_picture(self):
        self.write("one.csv", "x,y,z,r,vx\n0,0,0,1,40\n")
        self.succeed("render", "one.csv", "-o", "a.exr", *SIZE, "--arrows", "vx,0*vx,0*vx", "--layers", "depth,id")
        self.succeed("render", "one.csv", "-o", "a.png", *SIZE, "--arrows", "vx,0*vx,0*vx", "--floor", "grey")

    def test_a_legend_of_arrows_alone(self):
        arrows = ["--arrows", "vx,vy,vz", "--arrow-colour", "vy:viridis", "--colour", "grey"]
        self.assertNotEqual(self.picture(*arrows, "--legend"), self.picture(*arrows))
        self.assertIn("no meaning", self.refused("--arrows", "vx,vy,vz", "--arrow-colour", "red", "--colour", "grey", "--legend"))

    def test_transparent_ones_are_as_clear_as_their_spheres(self):
        clear = ["--arrows", "vx,vy,vz", "--opacity", "0.5"]
        for rule in ("once", "first", "as_one"):
            hashes = {self.picture(*clear, "--opacity-rule", rule, "--engine", engine) for engine in ("wide", "reference", "brute")}
            self.assertEqual(len(hashes), 1, rule)
            self.assertNotIn(self.picture("--arrows", "vx,vy,vz", "--opacity-rule", rule), hashes)

    def test_transparent_copies_are_those_of_a_file_with_the_copies(self):
        head, *rows = VECTORS.splitlines()
        moved = []
        for i in range(2):
            for row in rows:
                x, *rest = row.split(",")
                moved.append(",".join([str(float(x) + 8 * i), *rest]))
        self.write("copies.csv", "\n".join([head, *moved]) + "\n")
        view = ["--arrows", "vx,vy,vz", "--opacity", "0.4", "--colour", "red", "--fog", "0", "--eye", "6,1,30", "--look-at", "6,1,0"]
        for rule in ("each_surface", "once", "first", "as_one"):
            options = [*SIZE, *view, "--opacity-rule", rule, "--json"]
            copies = json.loads(self.succeed("render", "v.csv", "-o", "a.png", "--cell-vectors", "8,0,0,0,5,0,0,0,5", "--replicate", "2x1x1", *options))
            of_file = json.loads(self.succeed("render", "copies.csv", "-o", "b.png", *options))
            self.assertEqual(copies["picture_hash"], of_file["picture_hash"], rule)

    def test_a_legend_of_categories(self):
        self.write("v.csv", "\n".join(row + "," + phase for row, phase in zip(VECTORS.splitlines(), ("phase", "up", "down", "up", "down"))) + "\n")
        arrows = ["--arrows", "vx,vy,vz", "--arrow-colour", "phase", "--colour", "grey"]
        self.assertNotEqual(self.picture(*arrows, "--legend"), self.picture(*arrows))

    def test_what_is_refused(self):
        self.assertIn("expected three attributes", self.refused("--arrows", "vx,vy"))
        self.assertIn('there is no attribute "vw"', self.refused("--arrows", "vx,vy,vw"))
        self.assertIn("no colour, and there is no attribute", self.refused("--arrows", "vx,vy,vz", "--arrow-colour", "reed"))
        self.assertIn("--arrows", self.refused("--arrow-scale", "2"))
        self.assertIn("--arrows", self.refused("--arrow-pivot", "middle"))
        self.assertIn("--trace", self.refused("--trace-radius", "2"))
        self.assertIn('no attribute "chain"', self.refused("--trace", "chain"))
        self.assertIn("above 0", self.refused("--trace", "mol", "--trace-radius", "vx"))
        self.assertIn("tree", self.refused("--trace", "mol", "--view", "traversal"))
        self.assertIn("draws no bonds, arrows, tubes and links", self.refused("--trace", "mol", "--engine", "gpu"))

    def test_what_cannot_be_seen_is_told(self):
        def told(*options):
            done = self.run_bihive("render", "v.csv", "-o", "a.png", *SIZE, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stderr

        self.assertIn("all arrows end inside their spheres", told("--arrows", "vx,vy,vz", "--arrow-scale", "0.1"))
        self.assertNotIn("arrow", told("--arrows", "vx,vy,vz"))
        self.assertIn("all vectors are 0", told("--arrows", "0*vx,0*vx,0*vx"))
        self.assertIn("no two beads in a row", told("--trace", "mol", "--trace-select", "index 1"))
        self.write("nan.csv", "x,y,z,r,vx\n0,0,0,1,40\n2,0,0,1,nan\n")
        done = self.run_bihive("render", "nan.csv", "-o", "a.png", *SIZE, "--arrows", "vx,vx,vx")
        self.assertIn("1 sphere has no arrow", done.stderr)

    def test_tubes_alone_are_seen(self):
        done = self.run_bihive("render", "v.csv", "-o", "a.png", *SIZE, "--trace", "mol")
        self.assertEqual((done.returncode, "no sphere" in done.stderr), (0, False), done.stderr)

    def test_a_scene_file_has_them_too(self):
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "v.csv"}, "picture": {"arrows": "vx,vy,vz", "arrow_colour": "blue", "trace": "mol"}}))
        of_file = self.succeed_json("render", "s.json", "-o", "a.png", *SIZE)
        self.assertEqual(of_file["settings"]["arrows"], "vx,vy,vz")
        self.assertEqual(of_file["settings"]["trace"], "mol")
        without = self.succeed_json("render", "s.json", "-o", "b.png", *SIZE, "--arrows", "", "--trace", "none")
        self.assertNotEqual(of_file["picture_hash"], without["picture_hash"])

    def test_films_have_them_in_each_picture(self):
        self.write("f.xyz", "".join(f"2\nProperties=species:S:1:pos:R:3:vx:R:1:vy:R:1:vz:R:1\nC 0 0 0 {k} 0 0\nO 3 0 0 0 {k} 0\n" for k in (1, 2)))
        self.succeed("film", "f.xyz", "-o", "f%d.png", "--size", "64x48", "--samples", "1", "--arrows", "vx,vy,vz", "--arrow-scale", "2")
        self.assertIn("range", self.fail_usage("film", "f.xyz", "-o", "g%d.png", "--size", "64x48", "--arrows", "vx,vy,vz", "--arrow-scale", "5", "--arrow-colour", "vx"))


if __name__ == "__main__":
    main()
