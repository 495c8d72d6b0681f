"""bihive render: exposure and tone curves."""

import json

from program import ProgramTest, main, png_numbers

SMALL = ["--size", "60x40"]
SPHERE = '{"bihive_scene": 2, "spheres": [[0, 0, 0, 1]], "lights": [], "materials": [{"name": "a", "colour": [0.5, 0.25, 0.125], "ambient": 1}]%s}'


class Tone(ProgramTest):
    def picture(self, *arguments):
        self.succeed("render", *arguments, "-o", "a.png")
        return png_numbers(self.read("a.png"))

    def middle(self, *arguments):
        """The light of a sphere of colour 0.5, 0.25, 0.125 in the middle of the picture, without a curve to the screen."""
        self.write("s.json", SPHERE % "")
        pixels = self.picture("s.json", *SMALL, "--transfer", "none", "--bits", "16", *arguments)
        self.assertEqual(pixels[0][0], (65535, 65535, 65535), "the background stays white")
        return [number / 65535 for number in pixels[20][30]]

    def assert_light(self, found, expected):
        for ours, wanted in zip(found, expected):
            self.assertAlmostEqual(ours, wanted, delta=1e-5)

    def test_stops_double_the_light(self):
        self.assert_light(self.middle(), [0.5, 0.25, 0.125])
        self.assert_light(self.middle("--exposure", "1"), [1, 0.5, 0.25])
        self.assert_light(self.middle("--exposure", "-2.5"), [share * 2**-2.5 for share in (0.5, 0.25, 0.125)])
        self.assert_light(self.middle("--exposure", "2"), [1, 1, 0.5])

    def test_curves(self):
        # 4 is the white of the soft curve; the other channels keep their ratio.
        self.assert_light(self.middle("--exposure", "3", "--tone", "soft"), [1, 0.5, 0.25])
        self.assert_light(self.middle("--tone", "soft"), [0.5, 0.25, 0.125])
        filmic = [x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14) for x in (1, 0.5, 0.25)]
        self.assert_light(self.middle("--exposure", "1", "--tone", "filmic"), filmic)

    def test_options_scene_files_and_style_files_agree(self):
        options = self.picture("demo", *SMALL, "--style", "plain", "--exposure", "0.5", "--tone", "filmic")
        self.write("style.json", '{"bihive_style": 1, "picture": {"exposure": 0.5, "tone": "filmic"}}')
        self.assertEqual(self.picture("demo", *SMALL, "--style", "style.json"), options)
        self.assertEqual(self.picture("demo", *SMALL, "--style", "style.json", "--exposure", "0", "--tone", "none"),
                         self.picture("demo", *SMALL, "--style", "plain"))
        self.write("s.json", SPHERE % ', "picture": {"exposure": 1, "tone": "soft"}')
        of_file = self.picture("s.json", *SMALL)
        self.write("s.json", SPHERE % "")
        self.assertEqual(self.picture("s.json", *SMALL, "--exposure", "1", "--tone", "soft"), of_file)

    def test_engines_threads_and_parts(self):
        look = ["demo", *SMALL, "--exposure", "0.3", "--tone", "filmic"]
        whole = self.picture(*look)
        for more in (["--engine", "reference"], ["--threads", "1"], ["--threads", "7"]):
            self.assertEqual(self.picture(*look, *more), whole, more)
        self.assertEqual(self.picture(*look, "--crop", "10,5,50,30"), [row[10:50] for row in whole[5:30]])

    def test_the_report_says_it(self):
        report = self.succeed_json("render", "demo", *SMALL, "-o", "a.png", "--exposure", "-1")
        self.assertEqual(report["settings"]["exposure"], -1)
        self.assertEqual(report["settings"]["tone"], "none")
        self.assertNotIn("exposure", self.succeed_json("render", "demo", *SMALL, "-o", "a.png")["settings"])

    def test_what_is_refused(self):
        for value in ["x", "33", "-33", "nan", "1e9"]:
            said = self.fail_usage("render", "demo", "-o", "a.png", "--exposure=" + value)
            self.assertIn("--exposure: expected a number", said)
        self.assertIn("--tone: expected one of none, soft, filmic", self.fail_usage("render", "demo", "-o", "a.png", "--tone", "aces"))
        for text, place in [('"exposure": 40', "/picture/exposure: expected a number from -32 to 32"),
                            ('"tone": "hard"', '/picture/tone: expected one of none, soft, filmic')]:
            self.write("s.json", SPHERE % (', "picture": {%s}' % text))
            self.assertIn(place, self.fail_input("render", "s.json", "-o", "a.png"))
            self.write("style.json", json.dumps({"bihive_style": 1}).replace("1}", '1, "picture": {%s}}' % text))
            self.assertIn(place, self.fail_input("render", "demo", "-o", "a.png", "--style", "style.json"))
        for key in ("exposure", "tone"):
            self.write("s.json", (SPHERE % ', "picture": {"exposure": 1, "tone": "soft"}').replace('scene": 2', 'scene": 1'))
            self.assertIn("expected no such key in version 1", self.fail_input("render", "s.json", "-o", "a.png"), key)


if __name__ == "__main__":
    main()
