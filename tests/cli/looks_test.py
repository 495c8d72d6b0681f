"""The options of `bihive render` that select, hide and colour."""

import json

import numpy
from program import ProgramTest, main, png_pixels, png_text

# Three spheres side by side, as the camera sees them.
ROW = "x,y,z,r,charge,part\n-3,0,0,1,-1,left\n0,0,0,1,,middle\n3,0,0,1,5,right\n"
VIEW = ["--eye", "0,0,30", "--look-at", "0,0,0", "--size", "90x30", "--samples", "1", "--no-shadows", "--background", "black"]


class Looks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", ROW)

    def middles(self, *options, name="a.csv"):
        """The pixels in the middles of the three spheres."""
        self.succeed("render", name, "-o", "a.png", *VIEW, "--style", "plain", *options)
        row = png_pixels(self.read("a.png"))[15]
        # One sphere's diameter is 2 of the 30 * 2 tan(15 degrees) = 16.08 units of 30 pixels.
        return [row[45 + round(x * 30 / 16.08)] for x in (-3, 0, 3)]

    def test_hide_and_show(self):
        all_three = self.middles()
        self.assertNotIn((0, 0, 0), all_three)
        left, middle, right = self.middles("--select", "charge > 0", "--hide")
        self.assertEqual([left, middle, right], [all_three[0], all_three[1], (0, 0, 0)])
        left, middle, right = self.middles("--hide", "--select", "x = 0", "--show")
        self.assertEqual([left, middle, right], [(0, 0, 0), all_three[1], (0, 0, 0)])

    def test_a_switch_whose_value_is_false_is_off(self):
        self.assertEqual(self.middles("--hide=false", "--no-water=false"), self.middles())

    def test_a_material_is_for_the_selection(self):
        before = self.middles("--colour", "red")
        flat = self.middles("--colour", "red", "--select", "part left", "--material", "flat")
        self.assertEqual(flat[0], (255, 0, 0))
        self.assertNotEqual(before[0], flat[0])
        self.assertEqual(before[1:], flat[1:])
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"},
            "looks": [{"colour": "red"}, {"select": "part left", "material": "flat"}]}))
        self.assertEqual(self.middles(name="s.json"), flat)

    def test_the_order_of_the_options_counts(self):
        def is_red(pixel):
            return pixel[0] > 100 and pixel[1] < 60

        last_red = self.middles("--colour", "blue", "--select", "part left", "--colour", "red", "--select", "part right", "--colour", "green")
        self.assertTrue(is_red(last_red[0]) and last_red[1][2] > 100 and last_red[2][1] > 100, last_red)
        last_blue = self.middles("--select", "part left", "--colour", "red", "--select", "all", "--colour", "blue")
        self.assertTrue(all(pixel[2] > 100 and pixel[0] < 60 for pixel in last_blue), last_blue)

    def test_a_colour_map_of_own_colours(self):
        own = self.middles("--colour-by", "charge:blue-white-red:-1,5")
        self.write("map.txt", "# mine\n0 0 255\n255 255 255\n255 0 0\n")
        self.assertEqual(self.middles("--colour-by", "charge:map.txt:-1,5"), own)
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"},
            "looks": [{"colour_by": {"attribute": "charge", "map": ["blue", "white", "#ff0000"], "range": [-1, 5]}}]}))
        self.assertEqual(self.middles(name="s.json"), own)
        self.assertTrue(own[0][2] > 100 > own[0][0] and own[2][0] > 100 > own[2][2], own)
        self.write("bad.txt", "0 0 1\n0 0\n")
        for value, message in [("charge:bad.txt", "bad.txt:2: expected a colour but found '0 0'; a line is #rrggbb"),
                               ("charge:none.txt", "none.txt"), ("charge:blue-wihte", "there is no colour map \"blue-wihte\"")]:
            self.assertIn(message, self.fail_with(2, "render", "a.csv", "-o", "b.png", "--colour-by", value))
        # A file that is read is not overwritten.
        self.assertIn("map.txt", self.fail_input("render", "a.csv", "-o", "map.txt", "--colour-by", "charge:map.txt"))
        self.assertIn(b"mine", self.read("map.txt"))

    def test_colour_by_a_number(self):
        left, middle, right = self.middles("--colour-by", "charge:coolwarm:-1,5", "--nan-colour", "#00ff00")
        self.assertGreater(left[2], left[0])
        self.assertGreater(right[0], right[2])
        self.assertGreater(middle[1], 2 * middle[0])

    def test_radius_scale_before_and_behind_a_select(self):
        def spheres(*options):
            self.succeed("render", "a.csv", "-o", "d.png", "--view", "distance", *VIEW, *options)
            return sum(pixel != (0, 0, 0) for row in png_pixels(self.read("d.png")) for pixel in row)

        one, half = spheres(), spheres("--radius-scale", "0.5")
        self.assertLess(half, one / 2)
        only_one = spheres("--select", "part left", "--radius-scale", "0.5")
        self.assertTrue(half < only_one < one, (half, only_one, one))
        self.assertEqual(spheres("--radius-scale", "2", "--select", "all", "--radius-scale", "0.5"), one)

    def test_ids_are_those_of_the_input(self):
        shown = self.middles("--view", "id")
        left = self.middles("--view", "id", "--select", "index 0", "--hide")
        self.assertEqual(left, [(0, 0, 0), shown[1], shown[2]])

    def test_trace_through_a_scene_file_with_looks(self):
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"}, "looks": [{"select": "part left", "show": False}]}))
        rays = numpy.array([[-3, 0, 9, 0, 0, -1], [0, 0, 9, 0, 0, -1], [3, 0, 9, 0, 0, -1]], dtype="float32")
        numpy.save(self.path("rays.npy"), rays)
        self.succeed("trace", "s.json", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy")
        self.assertEqual(numpy.load(self.path("id.npy")).tolist(), [-1, 1, 2])

    def test_a_scene_file_first_then_the_options(self):
        self.write("s.json", json.dumps({
            "bihive_scene": 2, "spheres": {"file": "a.csv"}, "looks": [{"show": False}, {"select": "index 0", "show": True}]}))
        pixels = self.middles(name="s.json")
        self.assertEqual([pixel == (0, 0, 0) for pixel in pixels], [False, True, True])
        pixels = self.middles("--select", "index 2", "--show", name="s.json")
        self.assertEqual([pixel == (0, 0, 0) for pixel in pixels], [False, True, False])

    def test_short_forms(self):
        self.write("w.pdb", "".join(
            f"HETATM{i:5}  {name:<3} {residue} A{i:4}    {x:8.3f}   0.000   0.000  1.00  0.00           {name[0]}\n"
            for i, name, residue, x in [(1, "C", "LIG", -3), (2, "O", "HOH", 0), (3, "H", "LIG", 3)]))
        shown = ["--radius", "1"]
        pixels = self.middles(*shown, "--no-water", name="w.pdb")
        self.assertEqual([pixel == (0, 0, 0) for pixel in pixels], [False, True, False])
        pixels = self.middles(*shown, "--no-hydrogens", "--no-water", name="w.pdb")
        self.assertEqual([pixel == (0, 0, 0) for pixel in pixels], [False, True, True])
        self.assertIn("--no-water: column 1: 'water' needs the names of residues",
                      self.run_bihive("render", "a.csv", "-o", "x.png", "--no-water").stderr)

    def test_element_colours(self):
        self.write("m.csv", "x,y,z,r,element\n-3,0,0,1,C\n0,0,0,1,O\n3,0,0,1,Fe\n")
        usual = self.middles(name="m.csv")
        self.assertEqual(self.middles("--element-colours", "jmol", name="m.csv"), usual)
        cpk = self.middles("--element-colours", "cpk", name="m.csv")
        self.assertGreater(cpk[0][0], usual[0][0])
        self.write("colours.txt", "# mine\nc #00ff00\n\nFE blue\n")
        green, same, blue = self.middles("--element-colours", "colours.txt", name="m.csv")
        self.assertTrue(green[1] > 100 > green[0] and blue[2] > 100 > blue[0], (green, blue))
        self.assertEqual(same, usual[1])

    def test_bad_element_colours(self):
        self.write("m.csv", "x,y,z,r,element\n-3,0,0,1,C\n")
        self.write("bad.txt", "C #909090\nQq red\n")
        self.write("bad2.txt", "C reddish\n")
        self.write("empty.txt", "")
        for name, message in [("bad.txt", "bad.txt:2:1: expected an element's symbol"), ("bad2.txt", "bad2.txt:1:3: expected a colour"),
                              ("empty.txt", "no line with an element"), ("nope.txt", "nope.txt")]:
            self.assertIn(message, self.fail_input("render", "m.csv", "-o", "x.png", "--element-colours", name))
        self.assertIn("--element-colours: the input has no elements",
                      self.fail_usage("render", "a.csv", "-o", "x.png", "--element-colours", "cpk"))

    def test_the_picture_and_the_report_tell_the_looks(self):
        report = self.succeed_json("render", "a.csv", "-o", "a.png", *VIEW, "--select", "x > 0", "--hide")
        self.assertEqual(report["spheres"], 2)
        self.assertEqual(report["settings"]["looks"], ["--select x > 0", "--hide"])
        self.assertEqual(json.loads(png_text(self.read("a.png"))["Settings"])["looks"], ["--select x > 0", "--hide"])
        self.assertNotIn("looks", self.succeed_json("render", "a.csv", "-o", "a.png", *VIEW)["settings"])

    def test_a_selection_without_spheres_is_said(self):
        done = self.run_bihive("render", "a.csv", "-o", "a.png", *VIEW, "--select", "part nowhere", "--hide")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(
            done.stderr,
            'bihive: warning: --select "part nowhere" selects no sphere: no sphere has part nowhere; there are left, middle, right\n',
        )

    def test_a_selection_without_an_action_is_an_error(self):
        for options in (["--select", "all"], ["--select", "all", "--select", "x > 0", "--hide"], ["--select", "all", "--no-water"]):
            done = self.run_bihive("render", "a.csv", "-o", "a.png", *VIEW, *options)
            self.assertEqual(done.returncode, 2, options)
            self.assertIn('--select "all" has no action after it, and changes nothing', done.stderr)

    def test_bad_values(self):
        for options, message in [
            (["--select", "x >"], "--select: column 4: expected a number"),
            (["--select", "chrage > 1", "--hide"], "--select: column 1: there is no attribute 'chrage'"),
            (["--colour", "reddish"], "--colour: expected #rrggbb"),
            (["--colour-by", "charge:jet"], '--colour-by: there is no colour map "jet"; there are viridis'),
            (["--colour-by", "charge:magma:5"], "--colour-by: expected a range MIN,MAX"),
            (["--colour-by", "chrage"], "did you mean 'charge'?"),
            (["--colour-by", "part:magma"], '"part" holds texts'),
            (["--select", "x > 0", "--colour", "red", "--colour-by", "chrage"], "--colour-by: there is no attribute"),
            (["--colour", "red", "--select", "x > 0", "--crease", "chrage"], "--crease: there is no attribute"),
            (["--nan-colour", "x"], "--nan-colour: expected"),
            (["--opacity", "2"], "--opacity: expected a number from 0 to 1"),
            (["--select", "all", "--radius-scale", "-1"], "--radius-scale: expected a number from 0"),
            (["--radius-scale", "1", "--radius-scale", "2"], "--radius-scale: is given more than once"),
            (["--hide"], "every sphere is hidden"),
        ]:
            done = self.run_bihive("render", "a.csv", "-o", "x.png", *VIEW, *options)
            self.assertEqual((done.returncode, done.stdout), (2, ""), options)
            self.assertIn(message, done.stderr.splitlines()[0], options)
            self.assertNotIn("x.png", " ".join(self.contents()))


if __name__ == "__main__":
    main()
