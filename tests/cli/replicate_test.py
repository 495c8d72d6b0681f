"""Periodic cells: --cell, --replicate, --cell-vectors, --cell-origin, --wrap and --unwrap."""

import json

import numpy
from program import ProgramTest, main, png_numbers, png_pixels

VIEW = ["--eye", "6,7,30", "--look-at", "3,3,0", "--size", "90x60", "--samples", "2"]
CELL = ["--cell-vectors", "4.1,0,0,0.7,4.3,0,0,0.1,5.7"]
BALLS = [(0, 0, 0, 1), (1.5, 2, 0.25, 0.5), (3, 1, 1, 0.75)]


def csv_of(balls):
    return "x,y,z,r\n" + "".join(f"{x!r},{y!r},{z!r},{r!r}\n" for x, y, z, r in balls)


def copies_of(balls, a, b, c, vectors):
    """By the rule of docs/pictures.md."""
    made = []
    for i in range(a):
        for j in range(b):
            for k in range(c):
                shift = [i * vectors[0][n] + j * vectors[1][n] + k * vectors[2][n] for n in range(3)]
                for ball in balls:
                    made.append(tuple(float(numpy.float32(float(numpy.float32(ball[n])) + shift[n])) for n in range(3)) + (ball[3],))
    return made


class Replicate(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", csv_of(BALLS))

    def hash_of(self, name, *options):
        return self.succeed_json("render", name, "-o", "a.png", *VIEW, *options)["picture_hash"]

    def test_copies_have_the_bits_of_stored_spheres(self):
        vectors = [(4.1, 0, 0), (0.7, 4.3, 0), (0, 0.1, 5.7)]
        self.write("copied.csv", csv_of(copies_of(BALLS, 2, 3, 2, vectors)))
        for options in ([], ["--colour-by", "z", "--ao"], ["--opacity", "0.5"], ["--opacity", "0.5", "--opacity-rule", "once"], ["--view", "id"], ["--material", "glass"]):
            stored = self.hash_of("copied.csv", *options)
            for engine in ("wide", "reference", "brute"):
                self.assertEqual(self.hash_of("a.csv", *CELL, "--replicate", "2x3x2", "--engine", engine, *options), stored, (engine, options))
            self.assertNotEqual(self.hash_of("a.csv", *options), stored)
        framed = ["--size", "60x60", "--samples", "1", "--projection", "orthographic", "--json"]
        one = json.loads(self.succeed("render", "copied.csv", "-o", "b.png", *framed))
        other = json.loads(self.succeed("render", "a.csv", "-o", "b.png", *CELL, "--replicate", "2x3x2", *framed))
        self.assertEqual(one["settings"]["camera"], other["settings"]["camera"])
        self.assertEqual(one["picture_hash"], other["picture_hash"])

    def test_one_copy_is_the_set(self):
        self.assertEqual(self.hash_of("a.csv", *CELL, "--replicate", "1x1x1"), self.hash_of("a.csv"))

    def test_trace_gives_the_ids_of_copies(self):
        numpy.save(self.path("rays.npy"), numpy.array([[0, 0, 50, 0, 0, -1], [8, 0, 50, 0, 0, -1]], dtype=numpy.float32))
        for engine in ("wide", "reference", "brute"):
            self.succeed("trace", "a.csv", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy", "--engine", engine,
                         "--cell-vectors", "8,0,0,0,8,0,0,0,10", "--replicate", "2x1x3")
            self.assertEqual(numpy.load(self.path("t.npy")).tolist(), [29, 29])
            self.assertEqual(numpy.load(self.path("id.npy")).tolist(), [6, 15])

    def test_scene_files_say_the_same(self):
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "cell": {"vectors": [[4.1, 0, 0], [0.7, 4.3, 0], [0, 0.1, 5.7]], "origin": [-1, 0, 0]},
            "replicate": [2, 1, 2], "wrapping": "wrap", "picture": {"cell_lines": {"width_px": 2}},
            "spheres": {"file": "a.csv"}}))
        options = ["--light", "headlight", "--style", "plain"]
        by_options = [*CELL, "--cell-origin=-1,0,0", "--replicate", "2x1x2", "--wrap", "--cell", *options]
        self.assertEqual(self.hash_of("s.json", *options), self.hash_of("a.csv", *by_options))
        self.assertNotEqual(self.hash_of("s.json", *options, "--replicate", "3x1x2"), self.hash_of("s.json", *options))
        self.write("old.json", json.dumps({"bihive_scene": 1, "replicate": [2, 1, 1], "spheres": [[0, 0, 0, 1]]}))
        self.assertIn("/replicate: expected no such key in version 1", self.fail_input("render", "old.json", "-o", "x.png"))

    def test_the_cell_is_drawn_and_hidden_by_spheres(self):
        self.write("one.csv", "x,y,z,r\n0,0,0,1\n")
        view = ["--eye", "0,0,20", "--look-at", "0,0,0", "--projection", "orthographic", "--size", "80x80", "--samples", "1",
                "--style", "flat", "--background", "white", "--outline", "0", "--line-unit", "px"]
        # An edge runs behind the sphere along y = 0, another one before it.
        behind = ["--cell-vectors", "4,0,0,0,4,0,0,0,-4", "--cell-origin=-2,0,-1.5"]
        before = ["--cell-vectors", "4,0,0,0,4,0,0,0,4", "--cell-origin=-2,0,1.5"]
        def middle(*options):
            self.succeed("render", "one.csv", "-o", "a.png", *view, *options)
            rows = png_pixels(self.read("a.png"))
            return rows[40][40], rows[40][79 - 8]
        bare = middle()
        self.assertEqual(middle(*behind, "--cell")[0], bare[0])
        self.assertLess(sum(middle(*before, "--cell")[0]), 200)
        for options in (behind, before):
            self.assertEqual(middle(*options), bare)

    def test_a_crop_of_a_cell_is_a_part_of_the_whole(self):
        options = [*VIEW, *CELL, "--cell", "--replicate", "2x2x1", "--background", "none"]
        self.succeed("render", "a.csv", "-o", "whole.png", *options)
        self.succeed("render", "a.csv", "-o", "part.png", *options, "--crop", "13,7,71,50")
        whole, part = png_numbers(self.read("whole.png")), png_numbers(self.read("part.png"))
        self.assertEqual([row[13:71] for row in whole[7:50]], part)

    def test_info_says_the_cell(self):
        self.write("c.xyz", '1\nLattice="4 0 0 1 4 0 0 0 5" Origin="1 2 3" Properties=species:S:1:pos:R:3\nC 9 0 0\n')
        info = self.succeed_json("info", "c.xyz", "--replicate", "2x1x3")
        self.assertEqual(info["cell"], {"origin": [1, 2, 3], "vectors": [[4, 0, 0], [1, 4, 0], [0, 0, 5]]})
        self.assertEqual(info["copies"], [2, 1, 3])
        self.assertIn("2 x 1 x 3: 6 spheres", self.succeed("info", "c.xyz", "--replicate", "2x1x3"))
        self.assertIsNone(self.succeed_json("info", "a.csv")["cell"])

    def test_wrap_and_unwrap(self):
        wrapped = self.succeed_json("info", "a.csv", "--cell-vectors", "2,0,0,0,2,0,0,0,2", "--cell-origin=-1,-1,-1", "--wrap", "--radius", "0")
        # 0, 1.5 and 3; 0, 2 and 1; 0, 0.25 and 1.
        self.assertEqual(wrapped["bounds"], {"lo": [-1, -1, -1], "hi": [0, 0, 0.25]})
        atoms = "1 7 1.5 0 0 1 0 -1\n2 7 -1.5 0 0 2 0 -1\n"
        dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n-2 2\n-2 2\n-2 2\nITEM: ATOMS id mol x y z ix iy iz\n"
        self.write("a.dump", dump + atoms)
        by_flags = self.succeed_json("info", "a.dump", "--unwrap", "--radius", "0")
        self.assertEqual(by_flags["bounds"], {"lo": [5.5, 0, -4], "hi": [6.5, 0, -4]})
        self.write("b.dump", (dump + atoms).replace(" ix iy iz", " a b c"))
        by_molecule = self.succeed_json("info", "b.dump", "--unwrap", "--radius", "0")
        self.assertEqual(by_molecule["bounds"], {"lo": [1.5, 0, 0], "hi": [2.5, 0, 0]})

    def test_bad_values_are_bad_usage(self):
        for option, value, said in [
            ("--replicate", "3x3", 'expected three whole numbers from 1 to 1000000 as 3x3x1, found "3x3"'),
            ("--replicate", "3x0x1", "three whole numbers from 1"),
            ("--replicate", "3x3x1000001", "three whole numbers from 1"),
            ("--cell-vectors", "1,2,3", "expected 9 finite numbers as AX,AY,AZ,BX,BY,BZ,CX,CY,CZ"),
            ("--cell-vectors", "1,0,0,0,1,0,0,0,inf", "9 finite numbers"),
            ("--cell-origin", "1,2", "expected 3 finite numbers as X,Y,Z"),
        ]:
            message = self.fail_usage("render", "a.csv", "-o", "x.png", option, value)
            self.assertIn(option, message)
            self.assertIn(said, message)
        self.assertIn("--unwrap", self.fail_usage("render", "a.csv", "-o", "x.png", *CELL, "--wrap", "--unwrap"))

    def test_what_inputs_lack_is_bad_input(self):
        for options, said in [
            (["--replicate", "2x2x2"], "there is no periodic cell to replicate by; give one with --cell-vectors"),
            (["--cell"], "there is no periodic cell that --cell could draw"),
            (["--wrap"], "there is no periodic cell to wrap by"),
            (["--unwrap"], "there is no periodic cell to unwrap by"),
            (["--cell-origin", "1,2,3"], "there is no periodic cell that could begin elsewhere"),
            ([*CELL, "--unwrap"], "nothing says which spheres belong together"),
            (["--cell-vectors", "1,0,0,0,1,0,1,1,0", "--wrap"], "the cell has no volume"),
            (["--cell-vectors", "1,0,0,0,0,0,1,1,0", "--replicate", "1x2x1"], "the cell has no extent along its vector b"),
            (["--cell-vectors", "3e38,0,0,0,1,0,0,0,1", "--replicate", "4x1x1"], "must fit single precision"),
        ]:
            message = self.fail_input("render", "a.csv", "-o", "x.png", *options)
            self.assertIn(said, message)
            self.assertIn("a.csv", message)
        self.write("bad.xyz", '1\nLattice="4 0 0 1 4 0 0 0" Properties=species:S:1:pos:R:3\nC 9 0 0\n')
        self.assertIn("bad.xyz:2", self.fail_input("info", "bad.xyz"))

    def test_what_copies_cannot_do(self):
        copies = [*CELL, "--replicate", "2x1x1"]
        for options, said in [
            (["--view", "tree"], "shows the tree of the stored spheres"),
            (["--view", "traversal"], "shows the tree of the stored spheres"),
            (["--engine", "gpu"], "draws no replicated spheres"),
            (["--clip", "plane:0,0,1,0"], "--clip does not cut the copies of --replicate"),
        ]:
            self.assertIn(said, self.fail_usage("render", "a.csv", "-o", "x.png", *copies, *options))
        self.assertIn("edges of a cell", self.fail_usage("render", "a.csv", "-o", "x.png", *CELL, "--cell", "--engine", "gpu"))
        self.assertIn("--cell draws on the shaded picture alone",
                      self.fail_usage("render", "a.csv", "-o", "x.png", *CELL, "--cell", "--view", "normal"))
        for words in [["select", "a.csv", "all"], ["stats", "a.csv"], ["info", "a.csv", "--attributes"], ["info", "a.csv", "--frames"],
                      *(["convert", "a.csv", "-o", "b." + ending] for ending in ["csv", "xyz", "extxyz", "npy", "ply"])]:
            self.assertIn("without copies, so --replicate changes nothing there", self.fail_usage(*words, *copies))
        self.succeed("convert", "a.csv", "-o", "b.json", *copies)
        self.assertEqual(self.succeed_json("info", "b.json")["copies"], [2, 1, 1])
        self.assertIn("the copies along the cell", self.succeed("convert", "b.json", "-o", "b.csv"))
        self.assertIn("--replicate is for files, not for scenario1",
                      self.fail_usage("render", "scenario1", "-o", "x.png", "--replicate", "2x1x1"))


if __name__ == "__main__":
    main()
