"""Pictures of cavities: --show-cavities of render, film and scene files, and what it is refused with."""

import csv
import itertools
import json

from program import ProgramTest, main, png_pixels

VIEW = ["--size", "60x60", "--samples", "1", "--projection", "orthographic", "--background", "black", "--style", "plain"]


def hollow():
    """A cube of balls of radius 0.5 at whole numbers, without the one in the middle, and a ball far away."""
    places = [p for p in itertools.product((-1, 0, 1), repeat=3) if any(p)] + [(9, 0, 0)]
    return "x,y,z,r\n" + "".join(f"{x},{y},{z},0.5\n" for x, y, z in places)


class Cavities(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", hollow())

    def hash_of(self, name, *options):
        return self.succeed_json("render", name, "-o", "a.png", *VIEW, *options)["picture_hash"]

    def test_walls_are_drawn_and_nothing_else(self):
        # The balls grow to 0.75, and the camera frames those that line the cavity: 3.5 units for 60 pixels or fewer. The ball
        # at the front of the middle is wider than the cavity before it: its silhouette ends within 1 of the middle.
        self.succeed("render", "a.csv", "-o", "a.png", *VIEW, "--show-cavities", "0.25")
        lit = [(x, y) for y, row in enumerate(png_pixels(self.read("a.png"))) for x, pixel in enumerate(row) if pixel != (0, 0, 0)]
        self.assertTrue(lit)
        self.assertIn((30, 30), lit)
        self.assertLess(max(abs(x - 29.5) for x, _ in lit), 60 / 3.5)
        self.assertLess(max(abs(y - 29.5) for _, y in lit), 60 / 3.5)
        self.assertGreater(max(abs(x - 29.5) for x, _ in lit), 5)

    def test_all_engines_and_a_scene_file_draw_the_same(self):
        hashes = {self.hash_of("a.csv", "--show-cavities", "0.25", "--ao", "--engine", engine) for engine in ("wide", "reference", "brute")}
        self.assertEqual(len(hashes), 1)
        self.assertNotIn(self.hash_of("a.csv", "--ao"), hashes)
        self.assertNotIn(self.hash_of("a.csv", "--ao", "--show-cavities", "0.3"), hashes)
        self.succeed("scene", "save", "s.json", "a.csv", *VIEW, "--ao", "--show-cavities", "0.25")
        self.assertIn(self.succeed_json("render", "s.json", "-o", "a.png")["picture_hash"], hashes)
        self.write("p.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "a.csv"}, "picture": {"show_cavities": 0.25}}))
        of_file = self.hash_of("p.json", "--light", "headlight")
        self.assertEqual(of_file, self.hash_of("a.csv", "--light", "headlight", "--show-cavities", "0.25"))
        self.assertEqual(self.succeed_json("render", "p.json", "-o", "a.png", *VIEW)["settings"]["show_cavities"], 0.25)

    def test_the_molecule(self):
        """As many spheres line cavities as measure says: the lining of all of them."""
        self.succeed("measure", "demo", "--probe", "1.4", "--cavities", "c.csv")
        with open(self.path("c.csv"), encoding="utf-8") as file:
            lining = {int(sphere) for row in csv.DictReader(file) for sphere in row["spheres"].split()}
        self.assertGreater(len(lining), 10)
        answer = self.succeed_json("render", "demo", "-o", "a.png", *VIEW, "--show-cavities", "1.4")
        self.assertEqual(answer["settings"]["spheres"], len(lining))

    def test_none_is_said(self):
        done = self.run_bihive("render", "a.csv", "-o", "a.png", *VIEW, "--show-cavities", "0")
        self.assertEqual(done.returncode, 0)
        self.assertIn("no cavity for a probe of radius 0", done.stderr)
        self.assertEqual({pixel for row in png_pixels(self.read("a.png")) for pixel in row}, {(0, 0, 0)})

    def test_a_film_has_them_in_each_frame(self):
        frames = ""
        for size in (1, 3):
            places = [p for p in itertools.product((-1, 0, 1), repeat=3) if any(p)]
            frames += "26\nProperties=species:S:1:pos:R:3:radius:R:1\n"
            frames += "".join(f"C {size * x} {size * y} {size * z} 0.5\n" for x, y, z in places)
        self.write("t.extxyz", frames)
        self.succeed("film", "t.extxyz", "-o", "f/%d.png", *VIEW, "--show-cavities", "0.25", "--eye", "0,0,30", "--look-at", "0,0,0")
        colours = [len({pixel for row in png_pixels(self.read(f"f/{n}.png")) for pixel in row}) for n in (0, 1)]
        self.assertGreater(colours[0], 1)
        self.assertEqual(colours[1], 1)

    def test_what_cannot_be_drawn_with_them_is_refused(self):
        for options, said in [
            (["--clip", "plane:0,0,1,0"], "cut spheres"),
            (["--engine", "gpu"], "gpu"),
            (["--view", "tree"], "tree"),
            (["--show-cavities", "-1"], "show-cavities"),
        ]:
            message = self.fail_with(2, "render", "a.csv", "-o", "b.png", "--show-cavities", "0.25", *options)
            self.assertIn(said, message)
        self.write("m.xyz", "3\n\nC 0 0 0\nO 1.2 0 0\nH -0.6 0.9 0\n")
        self.assertIn("bonds", self.fail_usage("render", "m.xyz", "-o", "b.png", "--show-cavities", "0", "--bonds", "distance"))


if __name__ == "__main__":
    main()
