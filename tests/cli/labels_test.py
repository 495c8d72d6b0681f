"""The options of `bihive render` that write on a picture."""

import json
import os

from program import ProgramTest, main, png_pixels, png_text

ROW = "x,y,z,r,charge,part\n-3,0,0,1,-1,left\n0,0,0,1,,middle\n3,0,0,1,5,right\n"
SIZE = ["--size", "240x160", "--samples", "1"]
ALL = ["--legend", "--scale-bar", "--axes", "--title", "Ångström, β²", "--colour-by", "charge", "--projection", "orthographic"]


class Labels(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", ROW)

    def picture(self, *options, name="a.csv", output="a.png"):
        self.succeed("render", name, "-o", output, *SIZE, *options)
        return png_pixels(self.read(output))

    def test_each_label_changes_its_corner_alone(self):
        # A camera of one's own, so that labels get no room.
        look = ["--colour-by", "charge", "--projection", "orthographic", "--eye", "0,0,20", "--look-at", "0,0,0", "--fog", "0"]
        plain = self.picture(*look)
        corners = {"--title=Title": (80, 0, 160, 25), "--axes": (0, 80, 90, 160), "--scale-bar": (150, 120, 240, 160),
                   "--legend": (150, 0, 240, 160)}
        for option, (x0, y0, x1, y1) in corners.items():
            labelled = self.picture(*look, option)
            changed = [(x, y) for y in range(160) for x in range(240) if plain[y][x] != labelled[y][x]]
            self.assertGreater(len(changed), 30, option)
            self.assertTrue(all(x0 <= x < x1 and y0 <= y < y1 for x, y in changed), (option, min(changed), max(changed)))

    def test_labels_that_would_cover_spheres_get_room(self):
        """The legend moves the spheres to the left; a title that lies over nothing moves nothing."""
        def camera(*options):
            self.picture("--colour-by", "charge", "--projection", "orthographic", *options)
            return json.loads(png_text(self.read("a.png"))["Settings"])["camera"]

        free = camera()
        self.assertEqual(camera("--title", "T"), free)
        beside = camera("--legend")
        self.assertGreater(beside["shorter_side"], free["shorter_side"])
        self.assertGreater(beside["look_at"][0], free["look_at"][0])
        own = ["--eye", "0,0,20", "--look-at", "0,0,0"]
        self.assertEqual(camera("--legend", *own)["eye"], [0, 0, 20])

    def said(self, *options, name="a.csv"):
        """What a picture says on stderr."""
        return self.run_bihive("render", name, "-o", "a.png", *SIZE, *options).stderr

    def test_a_legend_of_unknown_numbers_has_no_bar(self):
        self.write("n.csv", "x,y,z,r,v\n0,0,0,.5,nan\n1,0,0,.5,nan\n")
        text = self.said("--colour-by", "v", "--legend", "--style", "flat", "--fog", "0", name="n.csv")
        self.assertIn("no sphere has a number of v: all have the colour of unknown numbers", text)
        yellow = [p for row in png_pixels(self.read("a.png")) for p in row if p[0] > 225 and p[1] > 200 and p[2] < 60]
        self.assertEqual(yellow, [])

    def test_zero_lies_below_a_logarithm(self):
        self.write("z.csv", "x,y,z,r,v\n0,0,0,.5,0\n1,0,0,.5,0.001\n2,0,0,.5,50\n")
        look = ["--style", "flat", "--outline", "0", "--fog", "0", "--colour-by", "v:viridis:1,100:log"]
        row = self.picture(*look, name="z.csv")[80]
        left, middle = row[50][:3], row[120][:3]
        self.assertEqual(left, middle)
        with_legend = self.picture(*look, "--legend", name="z.csv")
        self.assertEqual(self.said(*look, "--legend", name="z.csv"), "")
        self.assertIn(left, {p[:3] for r in with_legend for p in r[180:]})

    def test_letters_that_the_font_lacks_are_told(self):
        self.assertEqual(self.said("--title", "Ångström, β², …"), "")
        self.assertIn("the title has boxes in place of letters that DejaVu Sans lacks: 水; choose a font by --font", self.said("--title", "水 水"))
        self.write("w.csv", "x,y,z,r,part\n0,0,0,1,水\n")
        self.assertIn("the legend has boxes", self.said("--colour-by", "part", "--legend", name="w.csv"))

    def test_letters_of_another_font(self):
        """Each file of DejaVu Sans has other letters; a picture depends on the bytes of the file alone."""
        fonts = "/usr/share/fonts/truetype/dejavu/"
        own, bold, mono = fonts + "DejaVuSans.ttf", fonts + "DejaVuSans-Bold.ttf", fonts + "DejaVuSansMono.ttf"
        if not all(map(os.path.exists, (own, bold, mono))):
            self.skipTest("fonts-dejavu-core is not installed")
        look = ["--legend", "--colour-by", "part", "--title", "Kerning: AVAT, β²"]
        if "reads no fonts" in self.said(*look, "--font", own):
            self.skipTest("built without FreeType")
        plain = self.picture(*look)
        self.assertEqual(self.picture(*look, "--font", own), plain)  # the same outlines and kerning
        heavy = self.picture(*look, "--font", bold)
        self.assertNotEqual(heavy, plain)
        self.assertNotEqual(self.picture(*look, "--font", mono), heavy)
        # Cyrillic is not among the letters that come along.
        self.assertIn("DejaVu Sans lacks: Вода", self.said("--title", "Вода"))
        self.assertEqual(self.said("--title", "Вода", "--font", bold), "")
        self.assertIn("neither the chosen font nor DejaVu Sans has: 水", self.said("--title", "水", "--font", mono))
        # The figure names the file, and is drawn again with it alone.
        self.picture(*look, "--font", bold)
        self.assertIn("DejaVuSans-Bold.ttf (--font), which is neither beside it", self.run_bihive("verify", "a.png").stdout)
        os.symlink(bold, os.path.join(self.folder, "DejaVuSans-Bold.ttf"))
        self.assertIn("the same bits", self.succeed("verify", "a.png"))
        for name, said in [("a.csv", "is no font that FreeType can read"), ("none.ttf", "No such file")]:
            self.assertIn(said, self.fail_input("render", "a.csv", "-o", "b.png", "--font", name))

    def test_long_names_stay_beside_the_spheres(self):
        self.write("l.csv", "x,y,z,r,part\n" + "".join(
            f"{i % 4 * 2},{i // 4 * 2},0,1,{'polyethylene_glycol_methyl_ether_methacrylate_ba' if i % 2 else 'Na'}\n" for i in range(8)))
        look = ["--style", "flat", "--outline", "0", "--fog", "0", "--colour-by", "part", "--size", "640x480", "--samples", "1"]

        def drawn(*options):
            self.succeed("render", "l.csv", "-o", "a.png", *look, *options)
            return png_pixels(self.read("a.png"))

        pixels = drawn("--legend")
        colours = {p[:3] for row in drawn() for p in row if max(p) - min(p) > 60}
        spheres = [x for row in pixels for x, p in enumerate(row[:500]) if p[:3] in colours]
        letters = [x for row in pixels for x, p in enumerate(row) if max(p[:3]) < 60]
        self.assertGreater(min(letters), max(spheres) - 40)

    def test_a_picture_without_a_sphere_is_told(self):
        for options, reason in [(["--radius", "0"], "all have radius 0"), (["--opacity", "0"], "all have opacity 0"),
                                (["--eye", "0,0,9", "--look-at", "0,0,20"], "the camera looks past them")]:
            self.assertIn(reason, self.said(*options))
        for options in (["--opacity", "0", "--select", "index 1", "--opacity", "1"], ["--eye", "0,0,9", "--look-at", "0,0,0"]):
            self.assertEqual(self.said(*options), "")

    def test_edges_of_a_cell_are_seen_before_any_background(self):
        cell = ["--cell-vectors", "10,0,0,0,10,0,0,0,10", "--cell-origin=-5,-5,-5", "--cell", "--fog", "0", "--line-unit", "px"]
        for background in ("black", "#101020", "white"):
            pixels = self.picture(*cell, "--background", background)
            behind = pixels[2][2]
            far = max(max(abs(p[k] - behind[k]) for k in range(3)) for row in pixels[:40] for p in row)
            self.assertGreater(far, 90, background)
        dark = self.picture(*cell, "--background", "black", "--cell-colour", "#303030")
        self.assertLess(max(max(p) for p in dark[0]), 90)

    def test_threads_and_crops_have_the_same_bits(self):
        whole = self.picture(*ALL, "--threads", "1")
        for threads in ("2", "7"):
            self.assertEqual(self.picture(*ALL, "--threads", threads), whole)
        part = self.picture(*ALL, "--crop", "150,10,240,150")
        self.assertEqual(part, [row[150:240] for row in whole[10:150]])

    def test_settings_are_in_the_file(self):
        self.picture(*ALL, "--length-unit", "nm")
        settings = json.loads(png_text(self.read("a.png"))["Settings"])
        self.assertEqual(settings["labels"], {"legend": True, "scale_bar": True, "axes": True, "title": "Ångström, β²", "length_unit": "nm"})

    def test_a_scene_file_and_a_style_ask_for_the_same(self):
        by_options = self.picture(*ALL)
        labels = {"legend": True, "scale_bar": True, "axes": True, "title": "Ångström, β²"}
        self.write("labels.json", json.dumps({"bihive_style": 1, "picture": labels}))
        plain_options = ["--colour-by", "charge", "--projection", "orthographic"]
        plain = self.picture("--style", "plain", *ALL)
        self.assertEqual(self.picture("--style", "./labels.json", *plain_options), plain)
        self.assertNotEqual(plain, by_options)
        scene = {"bihive_scene": 2, "spheres": {"file": "a.csv"}, "looks": [{"colour_by": {"attribute": "charge"}}], "picture": labels}
        self.write("s.json", json.dumps(scene))
        self.assertEqual(self.picture("--projection", "orthographic", name="s.json"), plain)
        without = self.picture("--projection", "orthographic", "--no-labels", name="s.json")
        scene["picture"] = {}
        self.write("t.json", json.dumps(scene))
        self.assertEqual(without, self.picture("--projection", "orthographic", name="t.json"))
        scene["bihive_scene"] = 1
        scene["picture"] = {"title": "T"}
        del scene["looks"]
        self.write("old.json", json.dumps(scene))
        self.assertIn("/picture/title", self.fail_with(1, "render", "old.json", "-o", "b.png"))

    def test_a_scene_s_label_without_sense_is_left_out_with_a_warning(self):
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": [[0, 0, 0, 1]], "picture": {"scale_bar": True, "legend": True}}))
        stderr = self.run_bihive("render", "s.json", "-o", "a.png", *SIZE).stderr
        self.assertIn("--scale-bar", stderr)
        self.assertIn("perspective", stderr)
        self.assertIn("--legend", stderr)

    def test_bad_options(self):
        for options, words in [
            (["--scale-bar"], ["--scale-bar", "perspective", "--projection orthographic"]),
            (["--legend", "--colour", "red"], ["--legend", "--colour-by"]),
            (["--legend", "--colour-by", "charge", "--view", "normal"], ["--legend", "view"]),
            (["--length-unit", "nm"], ["--length-unit", "--scale-bar"]),
            (["--title"], ["--title"]),
        ]:
            stderr = self.fail_with(2, "render", "a.csv", "-o", "b.png", *options)
            for word in words:
                self.assertIn(word, stderr)


if __name__ == "__main__":
    main()
