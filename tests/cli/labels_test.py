"""The options of `bihive render` that write on a picture."""

# ctest: asan-long

import json

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
        look = ["--colour-by", "charge", "--projection", "orthographic", "--eye", "0,0,20", "--look-at", "0,0,0"]
        plain = self.picture(*look)
        corners = {"--title=Title": (80, 0, 160, 20), "--axes": (0, 100, 60, 160), "--scale-bar": (150, 130, 240, 160),
                   "--legend": (180, 20, 240, 140)}
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
