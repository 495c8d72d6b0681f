"""`bihive render --stereo` and `bihive film --stereo`."""

import json

from program import ProgramTest, main, png_pixels

# A sphere in the plane of the target, one in front of it and one behind, one above the other.
ROW = "x,y,z,r\n0,0,0,1\n0,4,6,1\n0,-4,-6,1\n"
VIEW = ["--style", "flat", "--outline", "0", "--fog", "0", "--colour", "red", "--eye", "0,0,30", "--look-at", "0,0,0", "--samples", "1"]


def middle(row, is_sphere):
    columns = [x for x, pixel in enumerate(row) if is_sphere(pixel)]
    return sum(columns) / len(columns)


class Stereo(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", ROW)

    def picture(self, *options, name="a.csv"):
        self.succeed("render", name, "-o", "a.png", *VIEW, *options)
        return png_pixels(self.read("a.png"))

    def test_both_eyes_see_the_target_in_one_place(self):
        for projection in ("perspective", "orthographic"):
            picture = self.picture("--size", "400x200", "--stereo", "side", "--eye-distance", "0.1", "--projection", projection)
            left, right = [[row[x : x + 200] for row in picture] for x in (0, 200)]
            shifts = []
            for y in (50, 100, 150):
                at = [middle(half[y], lambda pixel: pixel != (255, 255, 255)) for half in (left, right)]
                shifts.append(at[0] - at[1])
            self.assertAlmostEqual(shifts[1], 0, delta=0.6, msg=projection)
            # What is near lies further to the right for the left eye; so it is seen in front of the screen.
            self.assertGreater(shifts[0], 2, projection)
            self.assertLess(shifts[2], -2, projection)

    def test_cross_changes_sides(self):
        side = self.picture("--size", "120x60", "--stereo", "side")
        cross = self.picture("--size", "120x60", "--stereo", "cross")
        self.assertEqual(cross, [row[60:] + row[:60] for row in side])
        self.assertNotEqual(cross, side)
        self.assertEqual(self.picture("--size", "120x60", "--stereo", "side", "--eye-distance", repr(1 / 30)), side)

    def test_an_anaglyph_is_red_for_the_left_eye(self):
        picture = self.picture("--size", "100x100", "--stereo", "anaglyph", "--eye-distance", "0.1")
        self.assertTrue(all(green == blue for row in picture for _, green, blue in row))
        near = picture[25]
        red, cyan = [middle(near, lambda pixel, c=c: pixel[c] < 200) for c in (0, 1)]
        self.assertGreater(red, cyan + 1)
        self.assertEqual(picture[2][2], (255, 255, 255))

    def test_labels_stand_in_each_view(self):
        target = ["--select", "index > 0", "--hide"]
        plain = self.picture("--size", "400x150", "--stereo", "side", *target)
        titled = self.picture("--size", "400x150", "--stereo", "side", *target, "--title", "Two")
        changed = {(x, y) for y in range(150) for x in range(400) if plain[y][x] != titled[y][x]}
        self.assertGreater(len(changed), 60)
        left = {(x, y) for x, y in changed if x < 200}
        self.assertEqual({(x - 200, y) for x, y in changed - left}, left)
        red_and_cyan = self.picture("--size", "200x150", "--stereo", "anaglyph", *target, "--title", "One")
        self.assertEqual(len({pixel for row in red_and_cyan[:20] for pixel in row} - {(g, g, g) for g in range(256)}), 0)

    def test_all_spheres_are_in_both_views(self):
        self.succeed("render", "demo", "-o", "a.png", "--stereo", "side", "--size", "200x100", "--samples", "1", "--style", "flat")
        picture = png_pixels(self.read("a.png"))
        for x in (0, 99, 100, 199):
            self.assertEqual({row[x] for row in picture}, {(255, 255, 255)}, x)

    def test_scene_files_engines_and_threads(self):
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "a.csv"}, "picture": {"stereo": "side", "eye_distance": 0.1}}))
        expected = self.picture("--size", "120x60", "--stereo", "side", "--eye-distance", "0.1")
        self.assertEqual(self.picture("--size", "120x60", name="s.json"), expected)
        for more in (["--engine", "reference"], ["--threads", "1"], ["--threads", "3"]):
            self.assertEqual(self.picture("--size", "120x60", "--stereo", "side", "--eye-distance", "0.1", *more), expected)
        self.assertNotEqual(self.picture("--size", "120x60", "--stereo", "none", name="s.json"), expected)

    def test_a_figure_proves_itself(self):
        self.picture("--size", "120x60", "--stereo", "anaglyph")
        self.assertIn("the same", self.succeed("verify", "a.png"))

    def test_films(self):
        self.succeed("film", "a.csv", "-o", "run/%d.png", "--turntable", "90", "--pictures", "2", "--samples", "1", "--size", "120x60", "--stereo", "side")
        first = png_pixels(self.read("run/0.png"))
        self.assertNotEqual([row[:60] for row in first], [row[60:] for row in first])

    def test_what_cannot_be(self):
        for options, message in [
            (["--size", "101x50", "--stereo", "side"], "--stereo makes two halves of the picture, and 101 pixels have none"),
            (["--eye-distance", "0.1"], "--eye-distance is for stereo pictures"),
            (["--stereo", "side", "--eye-distance", "0"], "--eye-distance"),
            (["--stereo", "both"], "expected one of none, side, cross, anaglyph"),
            (["--stereo", "side", "--view", "normal"], "--stereo draws the shaded picture alone"),
            (["--stereo", "side", "--crop", "0,0,9,9"], "--stereo draws the whole picture"),
            (["--stereo", "anaglyph", "--background", "none"], "--stereo anaglyph has no transparent background"),
            (["--stereo", "side", "--engine", "gpu"], "draws no stereo pictures"),
        ]:
            self.assertIn(message, self.fail_usage("render", "a.csv", "-o", "b.png", *options), options)
        self.assertIn("--stereo", self.fail_usage("render", "a.csv", "-o", "b.exr", "--stereo", "side"))


if __name__ == "__main__":
    main()
