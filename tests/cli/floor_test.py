"""Floors: planes below the spheres, in a colour or seen by their shadows alone."""

import json
import math

from exr_file import ExrFile
from program import ProgramTest, main, png_numbers, png_text

BALLS = "x,y,z,r\n0,0,0,1\n3,1,0,1\n"
SIZE = ["--size", "120x90", "--samples", "1", "--outline", "0", "--fog", "0"]


class Floor(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", BALLS)

    def picture(self, *options, name="a.csv"):
        self.succeed("render", name, "-o", "a.png", *SIZE, "--turn", "20,30", *options)
        return png_numbers(self.read("a.png"))

    def test_a_floor_lies_below_the_lowest_sphere(self):
        plain, green = self.picture("--style", "plain"), self.picture("--style", "plain", "--floor", "#00ff00")
        below = green[88][5]
        self.assertTrue(below[1] > 60 and below[0] == below[2] == 0, below)
        # It hides nothing of the spheres, since it lies below them.
        seen = [(a, b) for row, other in zip(plain, green) for a, b in zip(row, other) if a != (255, 255, 255)]
        self.assertGreater(len(seen), 500)
        self.assertTrue(all(a == b for a, b in seen))
        self.assertEqual(self.picture("--style", "flat", "--floor", "#204060")[88][5], (0x20, 0x40, 0x60))

    def test_shadows_alone(self):
        for style in ("plain", "default", "studio"):
            plain, shaded = self.picture("--style", style, "--background", "#a0c0e0"), self.picture(
                "--style", style, "--background", "#a0c0e0", "--floor", "shadow")
            darker = sum(after < before for a, b in zip(plain, shaded) for before, after in zip(a, b))
            self.assertGreater(darker, 100, style)
            self.assertTrue(all(s <= p for a, b in zip(plain, shaded) for before, after in zip(a, b)
                                if before == (0xa0, 0xc0, 0xe0) for p, s in zip(before, after)), style)
            # Far away nearly nothing is hidden: the background has no edge at the horizon.
            for now, before in zip(shaded[0][0], (0xa0, 0xc0, 0xe0)):
                self.assertAlmostEqual(now, before, delta=2)
        self.assertEqual(self.picture("--style", "plain", "--background", "#a0c0e0", "--floor", "shadow")[88][2], (0xa0, 0xc0, 0xe0))

    def test_shadows_in_a_transparent_picture_are_black_with_opacity(self):
        """Over the background they give the picture that has it, up to rounding."""
        look = ["--style", "default", "--floor", "shadow", "--transfer", "none"]
        clear, white = self.picture(*look, "--background", "none"), self.picture(*look, "--background", "white")
        partly = 0
        for a, b in zip(clear, white):
            for (red, green, blue, alpha), (white_red, _, _) in zip(a, b):
                self.assertAlmostEqual(red * alpha / 255 + 255 - alpha, white_red, delta=2)
                partly += 0 < alpha < 255 and red == green == blue == 0
        self.assertGreater(partly, 100)

    def test_layers_know_spheres_alone(self):
        layers = {}
        for floor in ([], ["--floor", "shadow"]):
            done = self.run_bihive("render", "a.csv", "-o", "a.exr", *SIZE, "--turn", "20,30", *floor, "--layers", "depth,id,normal")
            if "no OpenEXR" in done.stderr:
                self.skipTest("built without OpenEXR")
            layers[len(floor)] = ExrFile(self.read("a.exr")).channels
        self.assertEqual(layers[2], layers[0])
        self.assertTrue(any(depth < math.inf for row in layers[0]["Z"] for depth in row))

    def test_engines_threads_and_crops_have_the_same_bits(self):
        look = ["--style", "studio", "--floor", "shadow", "--select", "index 1", "--opacity", "0.4"]
        whole = self.picture(*look)
        for more in (["--threads", "1"], ["--engine", "reference"], ["--engine", "brute"]):
            self.assertEqual(self.picture(*look, *more), whole, more)
        part = self.picture(*look, "--crop", "30,40,70,80")
        self.assertEqual(part, [row[30:70] for row in whole[40:80]])

    def test_what_is_up(self):
        def normal(*options):
            self.picture("--floor", "grey", *options)
            return json.loads(png_text(self.read("a.png"))["Settings"])["floor"]
        self.assertEqual(normal(), {"point": [0, -1, 0], "normal": [0, 1, 0], "shadows_only": False})
        self.assertEqual(normal("--up", "0,0,2")["normal"], [0, 0, 1])
        self.assertEqual(normal("--view-from", "top")["point"], [0, -1, 0])
        self.assertEqual(normal("--select", "index 0", "--hide")["point"], [0, 0, 0])

    def test_a_film_keeps_its_floor(self):
        self.write("f.xyz", "".join(f"2\n\nC 0 {y} 0\nC 4 0 0\n" for y in (0, 3, -2)))
        self.succeed("film", "f.xyz", "-o", "f/%d.png", "--floor", "shadow", *SIZE[:4])
        floors = [json.loads(png_text(self.read(f"f/{k}.png"))["Settings"])["floor"] for k in range(3)]
        self.assertEqual(floors, [floors[0]] * 3)
        self.assertIn("3 of 3 figures have the same bits", self.succeed("verify", "f"))

    def test_a_scene_file_may_have_such_a_plane(self):
        scene = {"bihive_scene": 2, "spheres": [[0, 0, 0, 1]], "lights": [{"position": [3, 9, 4]}],
                 "plane": {"point": [0, -1, 0], "normal": [0, 1, 0], "shadows_only": True}}
        self.write("s.json", json.dumps(scene))
        shown = self.picture(name="s.json")
        self.assertEqual(shown[88][2], (255, 255, 255))
        self.assertTrue(any(sum(pixel) < 700 for pixel in shown[80]))

    def test_what_is_refused(self):
        for options, said in [(["--no-shadows", "--style", "plain"], "the picture has none"), (["--view", "normal"], "is for the shaded picture"),
                              (["--engine", "gpu"], "draws no floors of shadows")]:
            self.assertIn(said, self.fail_usage("render", "a.csv", "-o", "a.png", "--floor", "shadow", *options))
        self.assertIn("a plane of its own", self.fail_usage("render", "scenario1", "--count", "5", "-o", "a.png", "--floor", "red"))


if __name__ == "__main__":
    main()
