"""The style density: point sets at the first try, in pictures, films and their records."""

import json
import random

from program import ProgramTest, main, png_numbers

SIZE = ["--size", "96x72", "--samples", "4"]


def cloud(count, seed, spread=1.0):
    numbers = random.Random(seed)
    return [tuple(numbers.gauss(0, spread) for _ in range(3)) for _ in range(count)]


def csv(points):
    return "x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, y, z in points)


class Density(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("cloud.csv", csv(cloud(4000, 1) + [(400.0, 300.0, 0.0)]))

    def picture(self, *options, name="cloud.csv"):
        done = self.run_bihive("render", name, "-o", "a.png", *SIZE, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [[pixel[:3] for pixel in row] for row in png_numbers(self.read("a.png"))]

    def test_the_middle_is_bright_and_fills_the_picture(self):
        rows = self.picture("--style", "density")
        light = [[sum(pixel) for pixel in row] for row in rows]
        middle = sum(light[36][48 + i] for i in range(-4, 5)) / 9
        ends = sum(light[36][4 + i] for i in range(-2, 3)) / 5
        self.assertGreater(middle, 200)
        self.assertLess(ends, 0.2 * middle)
        # Without the share a point far away makes the cloud a speck.
        whole = self.picture("--style", "density", "--fit-share", "1")
        lit = lambda picture: sum(sum(pixel) > 24 for row in picture for pixel in row)
        self.assertGreater(lit(rows), 20 * lit(whole))

    def test_there_is_no_warning_and_the_reader_says_what_it_did(self):
        done = self.run_bihive("render", "cloud.csv", "-o", "a.png", *SIZE, "--style", "density")
        self.assertEqual((done.returncode, done.stderr.count("no radii")), (0, 0), done.stderr)
        done = self.run_bihive("render", "cloud.csv", "-o", "a.png", *SIZE)
        self.assertEqual(done.stderr.count("no radii"), 1)

    def test_ones_own_radius_and_opacity_go_first(self):
        automatic = self.picture("--style", "density")
        self.assertNotEqual(self.picture("--style", "density", "--radius", "0.1"), automatic)
        self.assertNotEqual(self.picture("--style", "density", "--radius-scale", "2"), automatic)
        opaque = self.picture("--style", "density", "--select", "all", "--opacity", "1")
        colours = {pixel for row in opaque for pixel in row}
        of_style = tuple(round(255 * (1.055 * light ** (1 / 2.4) - 0.055)) for light in (0.55, 0.75, 1))
        self.assertIn(of_style, colours)
        self.assertNotIn(of_style, {pixel for row in automatic for pixel in row})

    def test_a_record_gives_the_same_bits(self):
        self.picture("--style", "density")
        self.assertIn("the same bits", self.succeed("verify", "a.png"))

    def test_a_film_has_the_values_of_its_first_frame(self):
        frames = [cloud(300, 2), cloud(300, 2, spread=0.5)]
        self.write("run.xyz", "".join(f"{len(f)}\n\n" + "".join(f"Q {x} {y} {z}\n" for x, y, z in f) for f in frames))
        self.succeed("film", "run.xyz", "-o", "run/%d.png", *SIZE, "--style", "density")
        fixed = json.loads(self.read("run/film.json"))["fixed"]["density"]
        self.succeed("render", "run.xyz", "-o", "first.png", *SIZE, "--style", "density")
        self.assertEqual(png_numbers(self.read("run/0.png")), png_numbers(self.read("first.png")))
        self.assertGreater(fixed["radius"], 0)
        self.assertTrue(1 / 256 <= fixed["opacity"] <= 1)
        # The second frame alone is smaller, and so are its dots.
        self.succeed("render", "run.xyz", "--frame", "1", "-o", "second.png", *SIZE, "--style", "density")
        self.assertNotEqual(png_numbers(self.read("run/1.png")), png_numbers(self.read("second.png")))
        self.assertIn("the same bits", self.succeed("verify", "run/1.png"))

    def test_a_share_that_changes_nothing_is_refused(self):
        for other in (["--eye", "0,0,9"], ["--fit", "index 0:100"], ["--view", "tree"]):
            message = self.fail_with(2, "render", "cloud.csv", "-o", "a.png", "--radius", "0.1", "--fit-share", "0.9", *other)
            self.assertIn("--fit-share is for a camera that bihive places", message)
        self.assertIn("from 0.5 to 1", self.fail_with(2, "render", "cloud.csv", "-o", "a.png", "--fit-share", "0.4"))


if __name__ == "__main__":
    main()
