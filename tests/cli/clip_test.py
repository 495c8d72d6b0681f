"""The option --clip of `bihive render`: what it takes away, and what it refuses."""

import json

import numpy
from program import ProgramTest, main, png_pixels

VIEW = ["--eye", "0,0,30", "--look-at", "0,0,0", "--size", "90x30", "--samples", "1", "--background", "black", "--style", "plain"]
PLANE = "plane:0,0,1,0"


class Clip(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", "x,y,z,r\n-3,0,0,1\n0,0,0,1\n3,0,5,1\n")

    def picture(self, name, *options):
        self.succeed("render", name, "-o", "a.png", *VIEW, *options)
        return png_pixels(self.read("a.png"))

    def hash_of(self, name, *options):
        return self.succeed_json("render", name, "-o", "a.png", *VIEW, *options)["picture_hash"]

    def test_every_engine_draws_the_same_cut(self):
        options = ["--clip", PLANE, "--select", "x < 0", "--clip", "box:-9,0,-9,9,9,9", "--clip", "sphere:-3,0,0,0.5", "--ao"]
        hashes = {self.hash_of("a.csv", *options, "--engine", engine) for engine in ("wide", "reference", "brute")}
        self.assertEqual(len(hashes), 1)
        self.assertNotIn(self.hash_of("a.csv", "--ao"), hashes)

    def test_a_clip_is_for_the_selection(self):
        middle = 15
        columns = [45 + round(x * 30 / 16.08) for x in (-3, 0, 3)]
        cut = self.picture("a.csv", "--select", "x > 0", "--clip", "sphere:3,0,5,2", "--no-shadows")[middle]
        self.assertEqual([cut[x] == (0, 0, 0) for x in columns], [False, False, True])

    def test_a_scene_file_says_the_same(self):
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"},
            "looks": [{"select": "x < 1", "clip": [{"plane": {"normal": [0, 0, 1], "offset": 0}},
                                                  {"sphere": {"centre": [0, 0, 0], "radius": 0.5}}]}]}))
        by_options = self.hash_of("a.csv", "--select", "x < 1", "--clip", PLANE, "--clip", "sphere:0,0,0,.5")
        rules = ["--light", "headlight"]
        self.assertEqual(self.hash_of("s.json", *rules), self.hash_of("a.csv", *rules, "--select", "x < 1", "--clip", PLANE,
                                                                      "--clip", "sphere:0,0,0,.5"))
        self.assertNotEqual(by_options, self.hash_of("a.csv"))

    def test_trace_meets_caps(self):
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "clips": [{"plane": {"normal": [0, 0, 2], "offset": 0}}],
            "spheres": [{"centre": [0, 0, 0], "radius": 1, "clips": [0]}, [9, 0, 0, 1]]}))
        rays = numpy.array([[0, 0, 5, 0, 0, -1], [9, 0, 5, 0, 0, -1]], dtype=numpy.float32)
        numpy.save(self.path("rays.npy"), rays)
        for engine in ("wide", "reference", "brute"):
            self.succeed("trace", "s.json", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy", "--engine", engine)
            self.assertEqual(numpy.load(self.path("t.npy")).tolist(), [5, 4])
            self.assertEqual(numpy.load(self.path("id.npy")).tolist(), [0, 1])

    def test_bad_values_are_bad_usage(self):
        for value, said in [
            ("cone:1,2,3", "plane:NX,NY,NZ,D, box:X0,Y0,Z0,X1,Y1,Z1 or sphere:X,Y,Z,R"),
            ("plane:0,0,1", 'expected 4 numbers as plane:NX,NY,NZ,D, found "0,0,1"'),
            ("plane:0,0,one,0", 'expected a number between -3.4e38 and 3.4e38 in plane:NX,NY,NZ,D, found "one"'),
            ("plane:0,0,0,1", "the normal of the plane must not be 0,0,0"),
            ("box:0,0,0,1,1,0", "the box must be larger than 0 along x, y and z, and is not along z"),
            ("sphere:0,0,0,-1", "the radius of the sphere must be above 0"),
        ]:
            message = self.fail_usage("render", "a.csv", "-o", "x.png", "--clip", value)
            self.assertIn("--clip", message)
            self.assertIn(said, message)

    def test_what_clips_cannot_do(self):
        self.assertIn("every sphere is cut away or hidden", self.fail_usage("render", "a.csv", "-o", "x.png", "--clip", "plane:0,0,1,-50"))
        self.assertIn("tree of whole spheres", self.fail_usage("render", "a.csv", "-o", "x.png", "--clip", PLANE, "--view", "tree"))
        self.assertIn("draws no cut spheres", self.fail_usage("render", "a.csv", "-o", "x.png", "--clip", PLANE, "--engine", "gpu"))


if __name__ == "__main__":
    main()
