"""bihive render: the options of its camera."""

import json

from program import ProgramTest, main, png_pixels

WHITE = (255, 255, 255)
# Three spheres of equal radius in a row, each farther away than the one before.
ROW = "x,y,z,r\n-3,0,0,1\n0,0,-20,1\n3,0,-40,1\n"


class CameraTest(ProgramTest):
    def render(self, *arguments, out="a.png"):
        return self.succeed_json("render", *arguments, "-o", out)

    def camera(self, *arguments):
        return self.render(*arguments)["settings"]["camera"]

    def widths(self, *arguments):
        """The spheres' widths in pixels along the middle row of the picture."""
        self.render(*arguments, "--no-shadows", "--samples", "1")
        rows = png_pixels(self.read("a.png"))
        row = rows[len(rows) // 2]
        starts = [x for x in range(1, len(row)) if row[x] != WHITE and row[x - 1] == WHITE]
        ends = [x for x in range(1, len(row)) if row[x] == WHITE and row[x - 1] != WHITE]
        return [end - start for start, end in zip(starts, ends)]


class ProjectionOption(CameraTest):
    def test_equal_spheres_are_equally_wide_at_any_depth(self):
        self.write("row.csv", ROW)
        for more in ([], ["--eye", "0,0,9"], ["--fov", "80"]):
            widths = self.widths("row.csv", "--size", "400x120", "--projection", "orthographic", *more)
            self.assertEqual(len(widths), 3, more)
            self.assertLessEqual(max(widths) - min(widths), 1, more)
            self.assertGreater(min(widths), 10, more)
        widths = self.widths("row.csv", "--size", "400x120", "--eye", "0,0,9", "--fov", "60")
        self.assertGreater(max(widths) - min(widths), 5, "perspective")

    def test_the_set_is_fitted_with_its_margin(self):
        self.write("row.csv", ROW)
        camera = self.camera("row.csv", "--size", "400x200", "--projection", "orthographic")
        self.assertEqual(camera["projection"], "orthographic")
        # 8 wide, 92 % of the longer side of 400 pixels.
        self.assertAlmostEqual(camera["shorter_side"], 8 / 0.92 / 2, places=5)
        self.assertGreater(camera["eye"][2], 1)

    def test_what_is_behind_the_plane_of_the_eye_is_not_seen(self):
        self.write("row.csv", ROW)
        self.assertEqual(len(self.widths("row.csv", "--projection", "orthographic", "--eye", "0,0,-10", "--look-at", "0,0,-30",
                                         "--fov", "60", "--size", "300x300")), 2)

    def test_engines_and_threads_draw_the_same(self):
        for view in ["shaded", "distance", "normal"]:
            pictures = set()
            for more in ([], ["--engine", "reference"], ["--engine", "brute"], ["--threads", "1"], ["--threads", "7"]):
                self.render("scenario3", "--count", "200", "--size", "61x47", "--view", view, "--projection", "orthographic", *more)
                pictures.add(self.read("a.png"))
            self.assertEqual(len(pictures), 1, view)

    def test_by_scene_file_and_option(self):
        scene = {
            "bihive_scene": 2,
            "camera": {"eye": [0, 0, 10], "look_at": [0, 0, 0], "projection": "orthographic", "shorter_side": 4},
            "spheres": [[0, 0, 0, 1]],
        }
        self.write("s.json", json.dumps(scene))
        small = ["--size", "64x48"]
        self.assertEqual(self.widths("s.json", *small), [24])
        camera = self.camera("s.json", *small)
        self.assertEqual((camera["projection"], camera["shorter_side"]), ("orthographic", 4))
        self.assertNotIn("projection", self.camera("s.json", *small, "--projection", "perspective"))
        fitted = self.camera("s.json", *small, "--view-from", "left")
        self.assertAlmostEqual(fitted["shorter_side"], 2 / 0.92)

    def test_what_is_refused(self):
        self.assertIn("--projection:", self.fail_usage("render", "demo", "-o", "a.png", "--projection", "fisheye"))
        for engine in ["gpu", "gpu-brute"]:
            said = self.fail_usage("render", "demo", "-o", "a.png", "--projection", "orthographic", "--engine", engine)
            self.assertIn("orthographic", said)
            self.assertIn("--engine " + engine, said)


if __name__ == "__main__":
    main()
