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
        small = () if "--size" in arguments else ("--size", "64x48")
        return self.render(*arguments, *small, "--samples", "1")["settings"]["camera"]

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


# A row of ten spheres along x, the last of another kind, and one more far behind it.
BEADS = "x,y,z,r,kind\n" + "".join(f"{4 * i},0,0,1,{'b' if i == 9 else 'a'}\n" for i in range(10)) + "36,0,-60,1,c\n"


class Selected(CameraTest):
    """Cameras that selections place."""

    def setUp(self):
        super().setUp()
        self.write("beads.csv", BEADS)

    def test_look_at_a_selection_is_look_at_its_centre(self):
        for more in ([], ["--eye", "3,4,50"], ["--projection", "orthographic"]):
            for selection, point in [("kind b", "36,0,0"), ("index 0 3", "6,0,0"), ("index 3 or z < -10", "24,0,-30")]:
                self.assertEqual(self.camera("beads.csv", "--look-at", selection, *more),
                                 self.camera("beads.csv", "--look-at", point, *more), selection)

    def test_fit_is_the_camera_of_a_file_with_these_spheres_alone(self):
        self.write("two.csv", "x,y,z,r\n8,0,0,1\n12,0,0,1\n")
        for more in ([], ["--view-from", "iso"], ["--turn", "30,20"], ["--fov", "50"], ["--size", "90x200"], ["--zoom", "2"]):
            self.assertEqual(self.camera("beads.csv", "--fit", "index 2 3", *more), self.camera("two.csv", *more), more)
        # In parallel rays nothing lies before the eye's plane and is cut away.
        fitted = self.camera("beads.csv", "--fit", "z < -10", "--projection", "orthographic")
        self.assertAlmostEqual(fitted["shorter_side"], 2 / 0.92)
        self.assertGreater(fitted["eye"][2], 1)

    def test_zoom_to_keeps_direction_and_plane_of_the_eye(self):
        for more in ([], ["--view-from", "iso"], ["--turn", "30,20"], ["--projection", "orthographic"]):
            before = self.camera("beads.csv", *more)
            camera = self.camera("beads.csv", "--zoom-to", "kind b", *more)
            back = [eye - middle for eye, middle in zip(before["eye"], before["look_at"])]
            length = sum(x * x for x in back) ** 0.5
            moved = [a - b for a, b in zip(camera["eye"], before["eye"])]
            self.assertAlmostEqual(sum(m * b / length for m, b in zip(moved, back)), 0, places=6)
            now = [eye - middle for eye, middle in zip(camera["eye"], camera["look_at"])]
            far = sum(x * x for x in now) ** 0.5
            for a, b in zip(now, back):
                self.assertAlmostEqual(a / far, b / length, places=9)
            for a, b in zip(camera["up"], before["up"]):
                self.assertAlmostEqual(a, b, places=12)

    def test_the_selected_spheres_fill_the_picture(self):
        hide = ["--select", "not kind b", "--hide", "--no-shadows", "--samples", "1"]
        for option in ("--fit", "--zoom-to"):
            for more in ([], ["--projection", "orthographic"], ["--view-from", "top"], ["--fov", "80"]):
                self.render("beads.csv", "--size", "100x100", *more, *hide, option, "kind b")
                rows = png_pixels(self.read("a.png"))
                filled = [y for y, row in enumerate(rows) if any(pixel != WHITE for pixel in row)]
                self.assertTrue(3 <= filled[0] <= 5 and 94 <= filled[-1] <= 96, (option, more, filled[0], filled[-1]))

    def test_zoom_to_keeps_the_camera_of_a_scene_and_fit_makes_a_new_one(self):
        scene = {"bihive_scene": 2, "camera": {"eye": [50, 0, 0], "look_at": [0, 0, 0], "up": [0, 0, 1]},
                 "spheres": [[0, 0, 0, 1], [0, 5, 0, 1]]}
        self.write("s.json", json.dumps(scene))
        zoomed = self.camera("s.json", "--zoom-to", "index 1")
        self.assertAlmostEqual(zoomed["eye"][0], 50)
        self.assertAlmostEqual(zoomed["eye"][1], 5, places=6)
        self.assertEqual(zoomed["up"], [0, 0, 1])
        fitted = self.camera("s.json", "--fit", "index 1")
        self.assertEqual(fitted["up"], [0, 1, 0])
        self.assertGreater(fitted["eye"][2], 2)
        scene = {"bihive_scene": 2, "camera": {"eye": [0.5, 0, 0], "look_at": [-9, 0, 0]}, "spheres": [[0, 0, 0, 1]]}
        self.write("inside.json", json.dumps(scene))
        self.assertIn("--zoom-to: the camera is not in front of all spheres",
                      self.fail_usage("render", "inside.json", "-o", "a.png", "--zoom-to", "all"))

    def test_up_rolls_a_fitted_picture(self):
        upright = self.camera("beads.csv", "--fit", "kind a", "--up", "1,0,0", "--size", "90x200", "--projection", "orthographic")
        self.assertAlmostEqual(upright["shorter_side"], 34 / 0.92 * 90 / 200)
        for more in ([], ["--size", "200x90"], ["--view-from", "left"], ["--turn", "0,40"]):
            rolled = self.camera("beads.csv", "--up", "0,2,1", *more)
            self.assertEqual(rolled, self.camera("beads.csv", "--fit", "all", "--up", "0,2,1", *more), more)
        # The whole set fills the picture, where the camera of another direction up would leave room.
        self.assertLess(self.camera("beads.csv", "--up", "1,0,0", "--size", "90x200")["eye"][2],
                        0.7 * self.camera("beads.csv", "--size", "90x200")["eye"][2])

    def test_up_along_the_view_tips_the_world(self):
        for up, axis in [("0,0,1", -1), ("0,0,-3", 1)]:
            camera = self.camera("beads.csv", "--up", up)
            self.assertGreater(axis * (camera["eye"][1] - camera["look_at"][1]), 1)
            self.assertEqual(camera["up"], [0, 0, -axis])
        self.assertIn("--up is the direction of view", self.fail_usage(
            "render", "beads.csv", "-o", "a.png", "--view-from", "front", "--up", "0,0,1"))

    def test_selections_see_the_spheres_as_they_were_read(self):
        hidden = ["--select", "index 0..2", "--hide"]
        self.assertEqual(self.camera("beads.csv", *hidden, "--fit", "index 5"), self.camera("beads.csv", "--fit", "index 5"))
        # Hidden spheres and spheres that are cut away do not count.
        self.assertEqual(self.camera("beads.csv", *hidden, "--fit", "index 1..5"), self.camera("beads.csv", "--fit", "index 3..5"))
        self.assertEqual(self.camera("beads.csv", "--clip", "plane:1,0,0,14", "--fit", "index 1..5"),
                         self.camera("beads.csv", "--fit", "index 1..3"))
        for more in (hidden, ["--clip", "box:-9,-9,-9,9,9,9"]):
            self.assertIn("--fit: all spheres of the selection are hidden or cut away",
                          self.fail_usage("render", "beads.csv", "-o", "a.png", *more, "--fit", "index 1"))

    def test_an_eye_among_other_spheres_is_told(self):
        self.write("shell.csv", "x,y,z,r\n0,0,0,1\n0,0,4,1.5\n")
        done = self.run_bihive("render", "shell.csv", "-o", "a.png", "--fit", "index 0")
        self.assertEqual(done.returncode, 0)
        self.assertIn("the eye is inside 1 sphere,", done.stderr)

    def test_what_is_refused(self):
        for option in ("--fit", "--zoom-to", "--look-at"):
            said = self.fail_usage("render", "beads.csv", "-o", "a.png", option, "kind q")
            self.assertIn(f'{option} "kind q" selects no sphere: no sphere has kind q; there are a, b, c', said)
        for words, reason in [
            (["--fit", "all", "--zoom-to", "all"], "--fit excludes --zoom-to"),
            (["--fit", "all", "--eye", "0,0,9"], "--eye excludes --fit"),
            (["--zoom-to", "all", "--look-at", "0,0,9"], "--look-at excludes --zoom-to"),
            (["--look-at", "kind a", "--view-from", "top"], "excludes --"),
            (["--look-at", "1,2"], "--look-at: expected three numbers X,Y,Z or a selection"),
            (["--fit", "all", "--view", "tree"], "--fit is for pictures of spheres"),
        ]:
            self.assertIn(reason, self.fail_usage("render", "beads.csv", "-o", "a.png", *words), words)
        for option in ("--fit", "--zoom-to"):
            done = self.run_bihive("render", "beads.csv", "-o", "a.png", option, "kind a and")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"bihive: error: {option}: column ", done.stderr)


class DirectionsOfSpheres(CameraTest):
    def test_the_longest_axis_lies_across(self):
        self.write("rod.csv", "x,y,z,r\n" + "".join(f"0,0,{z},1\n" for z in range(0, 200, 3)))
        camera = self.camera("rod.csv", "--view-from", "principal", "--size", "200x100", "--projection", "orthographic")
        self.assertAlmostEqual(camera["shorter_side"], 200 / 0.92 / 2)
        upright = self.camera("rod.csv", "--view-from", "principal", "--size", "100x200")
        self.assertEqual([abs(round(x, 9)) for x in upright["up"]], [0, 0, 1])
        for more in (["--turn", "0,0,30"], ["--zoom", "2"], ["--projection", "orthographic"]):
            self.render("rod.csv", "--view-from", "principal", "--size", "60x40", *more)

    def test_the_axes_are_those_of_the_spheres_that_are_to_be_seen(self):
        self.write("two.csv", "x,y,z,r,kind\n0,0,0,1,a\n0,0,9,1,a\n50,0,0,1,b\n90,0,0,1,b\n")
        across = {"front": [0, 0, 1], "right": [1, 0, 0]}
        for options, side in [([], None), (["--fit", "kind a"], "right"), (["--zoom-to", "kind a"], "right"),
                              (["--fit", "kind b"], "front"), (["--select", "kind b", "--hide"], "right")]:
            camera = self.camera("two.csv", "--view-from", "principal", *options)
            back = [eye - middle for eye, middle in zip(camera["eye"], camera["look_at"])]
            length = sum(x * x for x in back) ** 0.5
            if side:
                for a, b in zip(back, across[side]):
                    self.assertAlmostEqual(a / length, b)

    def test_the_best_direction_shows_what_others_hide(self):
        # A small sphere in a ring of walls that is open towards -x alone.
        walls = [(x, y, z) for x in (0, 4) for y in (-4, 0, 4) for z in (-4, 0, 4) if (x, y, z) != (0, 0, 0)]
        self.write("niche.csv", "x,y,z,r,kind\n0,0,0,1,inner\n" + "".join(f"{x},{y},{z},3.4,wall\n" for x, y, z in walls))
        camera = self.camera("niche.csv", "--view-from", "best:kind inner")
        back = [eye - middle for eye, middle in zip(camera["eye"], camera["look_at"])]
        self.assertLess(back[0] / sum(x * x for x in back) ** 0.5, -0.9)
        hashes = {self.render("niche.csv", "--size", "48x36", "--view-from", "best:kind inner", *more)["picture_hash"]
                  for more in ([], ["--threads", "1"], ["--engine", "reference"])}
        self.assertEqual(len(hashes), 1)
        # Nothing stands before it: the front.
        self.write("one.csv", "x,y,z,r\n0,0,0,1\n")
        camera = self.camera("one.csv", "--view-from", "best:all")
        self.assertGreater(camera["eye"][2] - camera["look_at"][2], 0)

    def test_what_is_refused(self):
        self.write("nut.csv", "x,y,z,r\n0,0,0,1\n0,0,0,2\n")
        for view, reason in [("best:index 7", '--view-from "index 7" selects no sphere'), ("best", "principal or best:EXPR"),
                             ("best:index 0", "--view-from: no direction shows any sphere of the selection"),
                             ("longest", "expected one of front, back")]:
            self.assertIn(reason, self.fail_usage("render", "nut.csv", "-o", "a.png", "--view-from", view))
        self.assertIn(" excludes --",
                      self.fail_usage("render", "nut.csv", "-o", "a.png", "--view-from", "principal", "--eye", "0,0,9"))


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
