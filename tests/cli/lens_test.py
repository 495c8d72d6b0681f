"""bihive render: depth of field and adaptive samples."""

from program import ProgramTest, main, png_numbers

SMALL = ["--size", "60x40"]
SCENE = '{"bihive_scene": 2, "camera": {"eye": [0, 0, 20], "look_at": [0, 0, 0]%s}, "picture": {"samples_per_pixel": %s}, "spheres": [[0, 0, 0, 1], [2, 0, 10, 1]]}'


class LensTest(ProgramTest):
    def picture(self, *arguments):
        self.succeed("render", *arguments, "-o", "a.png")
        return png_numbers(self.read("a.png"))

    def render(self, *arguments):
        return self.succeed_json("render", *arguments, "-o", "a.png")


class DepthOfField(LensTest):
    def test_options_and_scene_file_agree(self):
        self.write("s.json", SCENE % ("", 9))
        sharp = self.picture("s.json", *SMALL)
        options = self.picture("s.json", *SMALL, "--aperture", "1.5", "--focus", "12", "--samples", "9")
        self.assertNotEqual(options, sharp)
        self.write("lens.json", SCENE % (', "aperture": 1.5, "focus": 12', 9))
        self.assertEqual(self.picture("lens.json", *SMALL), options)
        self.assertEqual(self.picture("lens.json", *SMALL, "--aperture", "0"), sharp)
        auto = self.picture("s.json", *SMALL, "--aperture", "1.5", "--samples", "9")
        self.assertEqual(self.picture("s.json", *SMALL, "--aperture", "1.5", "--samples", "9", "--focus", "20"), auto)
        self.assertEqual(self.picture("lens.json", *SMALL, "--focus", "auto"), auto)

    def test_focus_on_spheres(self):
        self.write("s.json", SCENE % ("", 9))
        lens = ["s.json", *SMALL, "--aperture", "1.5", "--samples", "9"]
        near = self.picture(*lens, "--focus", "10")
        self.assertNotEqual(near, self.picture(*lens))
        self.assertEqual(self.picture(*lens, "--focus", "index 1"), near)
        self.assertEqual(self.picture(*lens, "--focus", "all"), self.picture(*lens, "--focus", "15"))
        self.write("lens.json", SCENE % (', "aperture": 1.5, "focus": "x > 1"', 9))
        self.assertEqual(self.picture("lens.json", *SMALL), near)
        self.assertIn("--focus: the selection matches no sphere", self.fail_usage("render", *lens, "-o", "a.png", "--focus", "x > 9"))
        behind = ["--eye", "0,0,-20", "--look-at", "0,0,-30"]
        self.assertIn("not in front of the camera", self.fail_usage("render", *lens, *behind, "-o", "a.png", "--focus", "all"))
        self.write("bad.json", SCENE % (', "aperture": 1.5, "focus": "name"', 9))
        self.assertIn("bad.json: /camera/focus: ", self.run_bihive("render", "bad.json", "-o", "a.png").stderr)

    def test_an_aperture_brings_its_samples(self):
        report = self.render("demo", *SMALL, "--style", "plain", "--aperture", "1", "--focus", "70")
        self.assertEqual(report["settings"]["samples_per_pixel"], 64)
        self.assertEqual(report["settings"]["camera"]["aperture"], 1)
        self.assertEqual(report["settings"]["camera"]["focus"], 70)
        report = self.render("demo", *SMALL, "--style", "plain", "--aperture", "1", "--samples", "5")
        self.assertEqual(report["settings"]["samples_per_pixel"], 5)
        # The default focus is where the camera looks at.
        camera = report["settings"]["camera"]
        distance = sum((a - b) ** 2 for a, b in zip(camera["eye"], camera["look_at"])) ** 0.5
        self.assertAlmostEqual(camera["focus"], distance)
        self.assertNotIn("aperture", self.render("demo", *SMALL, "--style", "plain")["settings"]["camera"])

    def test_engines_threads_and_parts(self):
        for view in ["shaded", "distance", "normal"]:
            look = ["scenario3", "--count", "99", *SMALL, "--aperture", "4", "--samples", "6", "--view", view]
            whole = self.picture(*look)
            for more in (["--engine", "reference"], ["--engine", "brute"], ["--threads", "1"], ["--threads", "7"]):
                self.assertEqual(self.picture(*look, *more), whole, more)
            self.assertEqual(self.picture(*look, "--crop", "10,5,50,30"), [row[10:50] for row in whole[5:30]])

    def test_what_is_refused(self):
        def said(*arguments):
            return self.fail_usage("render", "demo", "-o", "a.png", *arguments)

        for value in ["-1", "x", "nan", "1e39"]:
            self.assertIn("--aperture: expected a number", said("--aperture=" + value))
        for value in ["0", "-1", "1e39"]:
            self.assertIn('--focus: expected a number above 0 and up to 3.4e38, "auto" or a selection', said("--aperture", "1", "--focus=" + value))
        self.assertIn("--focus: 'x' needs values or a comparison after it", said("--aperture", "1", "--focus", "x"))
        self.assertIn("--focus changes nothing without an aperture", said("--focus", "3"))
        self.assertIn("orthographic camera has no lens", said("--aperture", "1", "--projection", "orthographic"))
        for keys, place in [('"aperture": -1', "/camera/aperture: expected a number of at least 0"),
                            ('"focus": 0', "/camera/focus: expected a number above 0"),
                            ('"aperture": 1, "projection": "orthographic"', "/camera: an orthographic camera has no lens")]:
            self.write("s.json", SCENE % (", " + keys, 4))
            self.assertIn(place, self.fail_input("render", "s.json", "-o", "a.png"))
        self.write("s.json", (SCENE % (', "aperture": 1', 4)).replace('scene": 2', 'scene": 1'))
        self.assertIn("/camera/aperture: expected no such key in version 1", self.fail_input("render", "s.json", "-o", "a.png"))


class AdaptiveSamples(LensTest):
    def test_options_scene_and_style_agree(self):
        self.write("s.json", SCENE % ("", 9))
        auto = self.picture("s.json", *SMALL, "--samples", "auto")
        few, many = (self.picture("s.json", *SMALL, "--samples", n) for n in ("4", "16"))
        self.assertNotIn(auto, (few, many))
        for row, of_few, of_many in zip(auto, few, many):
            for pixel, pixel_of_few, pixel_of_many in zip(row, of_few, of_many):
                self.assertIn(pixel, (pixel_of_few, pixel_of_many))
        self.write("auto.json", SCENE % ("", '"auto"'))
        self.assertEqual(self.picture("auto.json", *SMALL), auto)
        self.assertEqual(self.picture("auto.json", *SMALL, "--samples", "4"), few)
        self.write("style.json", '{"bihive_style": 1, "picture": {"samples_per_pixel": "auto"}}')
        self.assertEqual(self.picture("demo", *SMALL, "--style", "style.json"),
                         self.picture("demo", *SMALL, "--style", "plain", "--samples", "auto"))

    def test_engines_threads_and_parts(self):
        look = ["demo", *SMALL, "--samples", "auto"]
        whole = self.picture(*look)
        for more in (["--engine", "reference"], ["--threads", "1"], ["--threads", "7"]):
            self.assertEqual(self.picture(*look, *more), whole, more)
        self.assertEqual(self.picture(*look, "--crop", "10,5,50,30"), [row[10:50] for row in whole[5:30]])

    def test_the_report_counts_the_rays(self):
        report = self.render("demo", *SMALL, "--samples", "auto")
        self.assertEqual(report["settings"]["samples_per_pixel"], "auto")
        self.assertGreater(report["rays"]["primary"], 60 * 40 * 4)
        self.assertLess(report["rays"]["primary"], 60 * 40 * 20)

    def test_what_is_refused(self):
        for value in ["0", "4097", "Auto", "4.0"]:
            said = self.fail_usage("render", "demo", "-o", "a.png", "--samples=" + value)
            self.assertIn('--samples: expected a whole number from 1 to 4096 or "auto"', said)
        said = self.fail_usage("render", "demo", "-o", "a.png", "--samples", "auto", "--aperture", "1")
        self.assertIn("depth of field needs many samples everywhere", said)
        said = self.fail_usage("render", "demo", "-o", "a.png", "--samples", "auto", "--engine", "gpu", "--style", "plain")
        self.assertIn("draws no adaptive samples", said)
        self.write("s.json", SCENE % ("", '"all"'))
        self.assertIn('/picture/samples_per_pixel: expected a whole number from 1 to 4096, or "auto"', self.fail_input("render", "s.json", "-o", "a.png"))
        self.write("s.json", (SCENE % ("", '"auto"')).replace('scene": 2', 'scene": 1'))
        self.assertIn("/picture/samples_per_pixel: expected no such key in version 1", self.fail_input("render", "s.json", "-o", "a.png"))


if __name__ == "__main__":
    main()
