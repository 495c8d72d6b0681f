"""Trails, hydrogen bonds and dashes: `bihive render --trail, --hbonds, --link-dashes`, films and scene files."""

import json

from program import ProgramTest, main, png_pixels

VIEW = ["--size", "80x60", "--samples", "1", "--threads", "1", "--eye", "4,0,30", "--look-at", "4,0,0", "--fog", "0"]
NEAR = ["--size", "80x60", "--samples", "1", "--threads", "1", "--eye", "1.5,0,9", "--look-at", "1.5,0,0"]
ENGINES = ("wide", "reference", "brute")
WATERS = "6\n\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\nO 2.8 0 0\nH 3.1 0.9 0\nH 3.1 -0.9 0\n"


def run_of(frames):
    """Two spheres: one walks along x, one rests."""
    return "".join(f"2\n\nAr {2 * i} {i % 2} 0\nAr 0 6 0\n" for i in range(frames))


class Trails(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("run.xyz", run_of(5))
        self.write("w.xyz", WATERS)

    def picture(self, *options, of="run.xyz"):
        return self.succeed_json("render", of, "-o", "a.png", *VIEW, *options)["picture_hash"]

    def test_every_engine_draws_the_same_bits(self):
        for rule in ("each_surface", "once", "first", "as_one"):
            hashes = {self.picture("--frame", "4", "--trail", "3", "--opacity-rule", rule, "--engine", engine) for engine in ENGINES}
            self.assertEqual(len(hashes), 1, rule)
            self.assertNotIn(self.picture("--frame", "4", "--opacity-rule", rule), hashes)

    def test_each_option_changes_the_picture(self):
        seen = set()
        for options in ([], ["--trail", "1"], ["--trail", "2"], ["--trail", "4"], ["--trail", "4", "--trail-radius", "0.1"]):
            picture = self.picture("--frame", "4", *options)
            self.assertNotIn(picture, seen, options)
            seen.add(picture)
        # A longer trail than there are frames fades more slowly. The other sphere rests.
        self.assertNotIn(self.picture("--frame", "4", "--trail", "9"), seen)
        self.assertIn("no sphere has moved", self.run_bihive("render", "run.xyz", "-o", "a.png", *VIEW, "--frame", "4", "--trail", "4", "--trail-select", "index 1").stderr)
        self.assertEqual(self.picture("--frame", "4", "--trail", "4", "--trail-select", "index 0"), self.picture("--frame", "4", "--trail", "4"))
        self.assertEqual(self.picture("--frame", "4", "--trail", "0"), self.picture("--frame", "4"))
        self.assertEqual(self.picture("--frame", "-1", "--trail", "2"), self.picture("--frame", "4", "--trail", "2"))

    def test_frames_that_are_not_there(self):
        done = self.run_bihive("render", "run.xyz", "-o", "a.png", *VIEW, "--trail", "3")
        self.assertEqual(done.returncode, 0)
        self.assertIn("no frame before frame 0", done.stderr)
        self.write("other.xyz", "1\n\nAr 0 0 0\n" + run_of(2))
        done = self.run_bihive("render", "other.xyz", "-o", "a.png", *VIEW, "--frame", "2", "--trail", "3")
        self.assertIn("frame 0 has another number of spheres", done.stderr)
        done = self.run_bihive("render", "-", "-o", "a.png", *VIEW, "--trail", "3", input=run_of(2))
        self.assertEqual(done.returncode, 2)
        self.assertIn("standard input", done.stderr)
        self.assertIn("--trail N", self.fail_usage("render", "run.xyz", "-o", "a.png", *VIEW, "--trail-radius", "3"))

    def test_a_scene_file_says_the_same(self):
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "run.xyz", "frame": 4}, "picture": {"trail": 3, "trail_radius": 0.2}}))
        by_file = self.picture(of="s.json")
        self.assertEqual(by_file, self.picture("--frame", "4", "--trail", "3", "--trail-radius", "0.2", "--style", "plain"))
        self.write("first.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "run.xyz", "frame": 4}, "picture": {"trail": 9, "trail_radius": 0.2}}))
        self.assertEqual(self.picture(of="first.json"), self.picture("--frame", "4", "--trail", "9", "--trail-radius", "0.2", "--style", "plain"))
        self.succeed("scene", "save", "saved.json", "run.xyz", *VIEW, "--frame", "4", "--trail", "3")
        self.assertEqual(self.succeed_json("render", "saved.json", "-o", "b.png")["picture_hash"], self.picture("--frame", "4", "--trail", "3"))

    def test_a_film_has_the_trail_of_each_frame(self):
        self.succeed("film", "run.xyz", "-o", "run/%d.png", *VIEW, "--trail", "2")
        for frame in range(5):
            self.run_bihive("render", "run.xyz", "-o", "one.png", *VIEW, "--frame", str(frame), "--trail", "2")  # it warns of frame 0
            with open(self.path(f"run/{frame}.png"), "rb") as film, open(self.path("one.png"), "rb") as one:
                self.assertEqual(png_pixels(film.read()), png_pixels(one.read()), frame)
        self.assertIn("align", self.fail_usage("film", "run.xyz", "-o", "more/%d.png", *VIEW, "--trail", "2", "--align", "all"))


class HydrogenBonds(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("w.xyz", WATERS)

    def picture(self, *options, of="w.xyz"):
        return self.succeed_json("render", of, "-o", "a.png", *NEAR, *options)["picture_hash"]

    def test_they_are_drawn_in_a_colour_of_their_own(self):
        sticks = ["--style", "ball-and-stick"]
        seen = {self.picture(*sticks)}
        for options in (["--hbonds"], ["--hbonds", "--hbond-radius", "0.1"], ["--hbonds", "--hbond-colour", "red"], ["--hbonds", "--ball-scale", "0.1"]):
            of_engines = {self.picture(*sticks, *options, "--engine", engine) for engine in ENGINES}
            self.assertEqual(len(of_engines), 1, options)
            self.assertFalse(of_engines & seen, options)
            seen |= of_engines
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "w.xyz"}, "picture": {"hbonds": True}}))
        small = ["--radius-scale", "0.2"]
        plain = [*small, "--style", "plain"]
        self.assertEqual(self.picture(*small, of="s.json"), self.picture(*plain, "--hbonds"))
        self.assertEqual(self.picture(*small, "--no-hbonds", of="s.json"), self.picture(*plain))
        self.assertNotEqual(self.picture(*plain, "--hbonds"), self.picture(*plain))

    def test_a_style_may_state_them(self):
        sticks = {"hbonds": True, "hbond_radius": 0.1, "arrows": "x,y,z", "arrow_scale": 0.5, "arrow_colour": "x:magma:0,3", "ball_scale": 0.1, "bonds": "distance"}
        self.write("own.json", json.dumps({"bihive_style": 1, "picture": sticks}))
        options = [f"--{name.replace('_', '-')}" if value is True else f"--{name.replace('_', '-')}={value}" for name, value in sticks.items()]
        self.assertEqual(self.picture("--style", "own.json"), self.picture("--style", "plain", *options))

    def test_there_may_be_none(self):
        self.write("far.xyz", "2\n\nO 0 0 0\nO 9 0 0\n")
        done = self.run_bihive("render", "far.xyz", "-o", "a.png", *VIEW, "--hbonds")
        self.assertEqual(done.returncode, 0)
        self.assertIn("no hydrogen bond", done.stderr)
        self.write("points.csv", "x,y,z,r\n0,0,0,1\n1,0,0,1\n")
        self.assertIn("known elements", self.fail_usage("render", "points.csv", "-o", "a.png", *VIEW, "--hbonds"))
        self.assertIn("--hbonds", self.fail_usage("render", "w.xyz", "-o", "a.png", *VIEW, "--hbond-radius", "1"))

    def test_links_may_be_dashes(self):
        self.write("s.csv", "x,y,z,r\n0,0,0,0.5\n6,0,0,0.5\n")
        self.write("l.csv", "first,second\n0,1\n")
        links = ["--links", "l.csv", "--link-radius", "0.2"]
        self.assertNotEqual(self.picture(*links, of="s.csv"), self.picture(*links, "--link-dashes", of="s.csv"))
        self.assertIn("--links", self.fail_usage("render", "s.csv", "-o", "a.png", *VIEW, "--link-dashes"))


if __name__ == "__main__":
    main()
