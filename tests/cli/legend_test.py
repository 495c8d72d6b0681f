"""The legend of `bihive render`: its title, names of selections, fog behind it, and colours that stand for two things."""

import json

from program import ProgramTest, main, png_pixels, png_text

ROW = "x,y,z,r,charge,part\n-3,0,0,1,-1,left\n0,0,0,1,,middle\n3,0,-9,1,5,right\n"
SIZE = ["--size", "240x160", "--samples", "1"]
FLAT = ["--style", "flat", "--outline", "0"]


class Legend(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", ROW)

    def picture(self, *options, name="a.csv"):
        self.succeed("render", name, "-o", "a.png", *SIZE, *options)
        return png_pixels(self.read("a.png"))

    def settings(self):
        return json.loads(png_text(self.read("a.png"))["Settings"])

    def warning(self, *options):
        done = self.run_bihive("render", "a.csv", "-o", "a.png", *SIZE, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_a_title_replaces_the_name_of_the_attribute(self):
        look = ["--style", "plain", "--colour-by", "charge", "--eye", "0,0,30", "--look-at", "0,0,0"]
        named = self.picture(*look, "--legend")
        self.assertEqual(self.picture(*look, "--legend", "--legend-title", "charge"), named)
        titled = self.picture(*look, "--legend", "--legend-title", "Charge (e)")
        self.assertNotEqual(titled, named)
        self.assertEqual(self.settings()["labels"], {"legend": True, "legend_title": "Charge (e)"})
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"}, "looks": [{"colour_by": {"attribute": "charge"}}],
            "picture": {"legend": True, "legend_title": "Charge (e)"}}))
        self.assertEqual(self.picture("--style", "plain", "--eye", "0,0,30", "--look-at", "0,0,0", name="s.json"), titled)
        # A name of a look that colours by an attribute is the title of that key alone.
        self.assertEqual(self.picture(*look, "--legend", "--legend-name", "Charge (e)"), titled)
        message = self.fail_usage("render", "a.csv", "-o", "b.png", "--colour-by", "part", "--legend-title", "x")
        self.assertIn("--legend-title is for the legend, and the picture has none", message)

    def test_a_selection_has_its_name_beside_its_colour(self):
        look = [*FLAT, "--colour", "white", "--select", "part left", "--colour", "#0000ff", "--eye", "0,0,40", "--look-at", "0,0,0"]
        without = self.picture(*look)
        named = self.picture(*look, "--legend-name", "ligand", "--legend")
        blue = [sum(row.count((0, 0, 255)) for row in picture) for picture in (without, named)]
        self.assertGreater(blue[1], blue[0] + 30, "the square of the key")
        # The name comes after the colour in whatever order they are given, and in a scene file.
        swapped = [*FLAT, "--colour", "white", "--select", "part left", "--legend-name", "ligand", "--colour", "#0000ff",
                   "--eye", "0,0,40", "--look-at", "0,0,0", "--legend"]
        self.assertEqual(self.picture(*swapped), named)
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"}, "picture": {"legend": True},
            "looks": [{"colour": "white"}, {"select": "part left", "colour": "#0000ff", "legend_name": "ligand"}]}))
        self.assertEqual(self.picture(*FLAT, "--eye", "0,0,40", "--look-at", "0,0,0", name="s.json"), named)
        # A later colour has no name; hidden spheres have no key.
        for more in (["--select", "all", "--colour", "red"], ["--hide"]):
            self.assertIn("no meaning", self.fail_usage("render", "a.csv", "-o", "b.png", *swapped, *more))

    def test_wrong_names(self):
        self.assertIn("at least one character", self.fail_usage("render", "a.csv", "-o", "b.png", "--colour", "red", "--legend-name", ""))
        message = self.fail_usage("render", "a.csv", "-o", "b.png", "--select", "part left", "--colour", "red",
                                  "--select", "all", "--legend-name", "everything")
        self.assertIn("--legend-name: a name in the legend stands beside one colour, and these spheres have several", message)

    def test_two_things_of_one_colour_are_told(self):
        both = ["--select", "part left", "--colour", "red", "--legend-name", "a", "--select", "part middle", "--colour", "#ff0000", "--legend-name"]
        self.assertIn("the legend has one colour for a and b", self.warning(*both, "b", "--legend"))
        self.assertEqual(self.warning(*both, "a", "--legend"), "", "one name for both")
        self.assertEqual(self.warning(*both, "b"), "", "without a legend")

    def test_no_fog_behind_a_legend_unless_asked_for(self):
        look = [*FLAT, "--colour-by", "part", "--fog-start", "0", "--fog", "0.5"]
        self.write("style.json", json.dumps({"bihive_style": 1, "material": {"glow": 1, "ambient": 0, "diffuse": 0}, "lights": [],
                                             "picture": {"fog": {"strength": 0.5}}}))
        foggy = ["--style", "style.json", "--colour-by", "part"]
        self.picture(*foggy)
        self.assertEqual(self.settings()["fog"], 0.5)
        self.picture(*foggy, "--legend")
        self.assertNotIn("fog", self.settings())
        self.picture(*foggy, "--legend", "--fog", "0.5")
        self.assertEqual(self.settings()["fog"], 0.5)
        self.picture(*look, "--legend")
        self.assertEqual(self.settings()["fog"], 0.5)
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "a.csv"}, "picture": {"fog": {"strength": 0.25}}}))
        self.picture("--colour-by", "part", "--legend", name="s.json")
        self.assertEqual(self.settings()["fog"], 0.25)


if __name__ == "__main__":
    main()
