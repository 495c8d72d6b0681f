"""bihive render: the options of its camera."""

# ctest: asan-long

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


class WidePictures(CameraTest):
    def test_spheres_at_the_ends_of_a_wide_picture_look_round(self):
        self.write("row.csv", "x,y,z,r\n" + "".join(f"{3 * i},0,0,1\n" for i in range(12)))
        size = ["row.csv", "--size", "1200x240"]
        widths = self.widths(*size)
        self.assertEqual(len(widths), 12)
        self.assertLess(max(widths) / min(widths), 1.25)
        wide = self.widths(*size, "--fov", "30")
        self.assertGreater(max(wide) / min(wide), 1.4)
        # Up to a little over twice as wide as high, 30 degrees as ever.
        self.assertEqual(self.camera("row.csv", "--size", "640x300")["fov_deg"], 30)
        self.assertEqual(self.camera("row.csv", "--size", "300x640")["fov_deg"], 30)
        self.assertLess(self.camera("row.csv", "--size", "300x900")["fov_deg"], 30)

    def test_an_eye_inside_of_spheres_is_told(self):
        self.write("row.csv", ROW)
        for options, reason in [(["--projection", "orthographic", "--eye", "0,0,0.5", "--look-at", "0,0,-20"], "cuts 1 sphere,"),
                                (["--eye=-3,0.5,0", "--look-at=-3,0,-20"], "the eye is inside 1 sphere,")]:
            done = self.run_bihive("render", "row.csv", "-o", "a.png", "--size", "60x40", *options)
            self.assertEqual(done.returncode, 0)
            self.assertIn(reason, done.stderr)
        self.succeed("render", "row.csv", "-o", "a.png", "--size", "60x40", "--eye", "0,0,9")

    def test_points_and_sizes_in_print(self):
        self.write("row.csv", ROW)
        self.assertEqual(self.render("row.csv", "--size", "2x1cm", "--dpi", "254", "--line-unit", "pt", "--outline", "1")["size"], "200x100")
        for words, reason in [(["--size", "2x1cm"], "--size in print needs"), (["--line-unit", "pt"], "--line-unit pt needs")]:
            self.assertIn(reason, self.fail_usage("render", "row.csv", "-o", "a.png", *words))


class TurnAndZoom(CameraTest):
    def offset(self, *arguments):
        """From what the camera looks at to its eye, of length 1."""
        camera = self.camera(*arguments, "--size", "60x40")
        offset = [eye - middle for eye, middle in zip(camera["eye"], camera["look_at"])]
        length = sum(x * x for x in offset) ** 0.5
        return [x / length for x in offset]

    def test_a_turn_leads_to_the_other_sides(self):
        self.write("row.csv", ROW)
        for turn, side in [("90,0", "right"), ("-90,0", "left"), ("0,90", "top"), ("0,-90", "bottom"), ("180,0", "back")]:
            turned, from_side = self.offset("row.csv", "--turn", turn), self.offset("row.csv", "--view-from", side)
            self.assertTrue(all(abs(a - b) < 1e-9 for a, b in zip(turned, from_side)), turn)
            self.assertEqual(self.render("row.csv", "--size", "60x40", "--turn", turn)["picture_hash"],
                             self.render("row.csv", "--size", "60x40", "--view-from", side)["picture_hash"], turn)

    def test_the_set_is_fitted_from_any_direction(self):
        for projection in ["perspective", "orthographic"]:
            for turn in ["0,0,45", "37,0", "37,50", "-120,-30,200"]:
                self.render("demo", "--size", "90x60", "--turn", turn, "--projection", projection)
                rows = png_pixels(self.read("a.png"))
                border = rows[0] + rows[-1] + [row[0] for row in rows] + [row[-1] for row in rows]
                self.assertEqual(set(border), {WHITE}, turn)
                columns = list(zip(*rows))
                filled = [sum(any(pixel != WHITE for pixel in line) for line in lines) for lines in (rows, columns)]
                self.assertTrue(filled[0] >= 0.85 * 60 or filled[1] >= 0.85 * 90, (turn, filled))

    def test_a_camera_that_is_placed_turns_around_what_it_looks_at(self):
        for more in ([], ["--projection", "orthographic"]):
            camera = self.camera("scenario1", "--size", "60x40", "--turn", "90,0", *more)
            self.assertEqual(camera["look_at"], [0, 0, 0])
            self.assertEqual(camera["eye"], [100, 0, 0])
        camera = self.camera("demo", "--size", "60x40", "--eye", "0,0,90", "--look-at", "0,0,40", "--turn", "0,90")
        self.assertEqual((camera["eye"], camera["look_at"]), ([0, 50, 40], [0, 0, 40]))

    def test_zoom_draws_larger(self):
        self.write("one.csv", "x,y,z,r\n0,0,0,1\n")
        for more in ([], ["--projection", "orthographic"], ["--view-from", "iso"]):
            widths = [self.widths("one.csv", "--size", "400x400", "--zoom", zoom, *more)[0] for zoom in ("1", "0.5", "0.25")]
            self.assertLessEqual(abs(widths[0] - 2 * widths[1]), 2, more)
            self.assertLessEqual(abs(widths[0] - 4 * widths[2]), 4, more)
        eyes = [self.camera("one.csv", "--size", "40x40", "--zoom", zoom)["eye"] for zoom in ("1", "7")]
        self.assertEqual(eyes[0], eyes[1])

    def test_what_is_refused(self):
        for turn in ["", "1", "1,2,3,4", "a,b", "1,", "361,0", "nan,0"]:
            self.assertIn("--turn:", self.fail_usage("render", "demo", "-o", "a.png", "--turn=" + turn))
        for zoom in ["", "0", "-1", "inf", "2x", "1e6"]:
            self.assertIn("--zoom:", self.fail_usage("render", "demo", "-o", "a.png", "--zoom=" + zoom))


class Crop(CameraTest):
    def test_a_part_is_equal_to_the_whole(self):
        for view in ["shaded", "distance", "tree"]:
            self.render("demo", "--size", "90x60", "--view", view)
            whole = png_pixels(self.read("a.png"))
            said = self.render("demo", "--size", "90x60", "--view", view, "--crop", "11,20,75,41")
            self.assertEqual(said["size"], "64x21")
            self.assertEqual(said["settings"]["crop"], [11, 20, 75, 41])
            self.assertEqual(said["settings"]["width_px"], 90)
            part = png_pixels(self.read("a.png"))
            self.assertEqual(part, [row[11:75] for row in whole[20:41]], view)

    def test_a_small_part_of_a_huge_picture(self):
        said = self.succeed("render", "demo", "-o", "a.png", "--size", "65535x65535", "--crop", "30000,30000,30040,30030")
        self.assertRegex(said, r"\Aa\.png: 40 x 30, ")

    def test_what_is_refused(self):
        for crop in ["", "1,2,3", "0,0,0,9", "9,0,5,9", "-1,0,5,5", "a,0,5,5", "0,0,1.5,5", "0,0,65536,5", "1,2,3,4,5"]:
            self.assertIn("--crop:", self.fail_usage("render", "demo", "-o", "a.png", "--crop=" + crop))
        said = self.fail_usage("render", "demo", "-o", "a.png", "--size", "90x60", "--crop", "0,0,91,60")
        self.assertIn("--crop ends outside the picture of 90 x 60 pixels; ", said)


if __name__ == "__main__":
    main()
