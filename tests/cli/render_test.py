"""bihive render: its picture, its output, and the same picture by every engine and number of threads."""

import json
import os

from program import ProgramTest, is_sanitized, main, png_pixels, png_size, png_text

SMALL = ["--size", "48x32"]


class Render(ProgramTest):
    def render(self, *arguments, out="a.png"):
        """The JSON that the program prints; the picture is in `out`."""
        return self.succeed_json("render", *arguments, "-o", out)

    def settings(self, *arguments):
        return self.render(*arguments)["settings"]

    def test_defaults_of_a_file(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        self.succeed("render", "a.xyz", "-o", "a.png")
        self.assertEqual(png_size(self.read("a.png")), (1280, 720))
        settings = json.loads(png_text(self.read("a.png"))["Settings"])
        expected = {"samples_per_pixel": 4, "recursion": 5, "shadows": True, "transfer": "srgb", "view": "shaded"}
        self.assertEqual({key: settings[key] for key in expected}, expected)
        self.assertEqual(settings["background"], [1, 1, 1])
        self.assertEqual(settings["camera"]["fov_deg"], 30)
        self.assertEqual(png_pixels(self.read("a.png"))[0][0], (255, 255, 255))

    def test_defaults_of_the_thesis(self):
        for name in ["scenario1", "scenario2", "scenario3", "four-spheres"]:
            settings = self.settings(name, *SMALL)
            expected = {"samples_per_pixel": 1, "recursion": 5, "shadows": False, "transfer": "none"}
            self.assertEqual({key: settings[key] for key in expected}, expected)
            self.assertEqual(settings["background"], [0, 0, 0])
            self.assertEqual(settings["camera"], {"eye": [0, 0, 100], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 30})

    def test_every_option_arrives(self):
        settings = self.settings(
            *"demo --size 20x10 --recursion 3 --samples 2 --no-shadows --transfer none --background 0.25,0.5,1".split(),
            *"--eye 100,0,1 --look-at 0,0,1 --up 0,0,2 --fov 45 --radius 2 --radius-scale 0.5 --frame 0 --recenter".split(),
        )
        self.assertEqual((settings["width_px"], settings["height_px"]), (20, 10))
        self.assertEqual((settings["recursion"], settings["samples_per_pixel"]), (3, 2))
        self.assertEqual((settings["shadows"], settings["transfer"]), (False, "none"))
        self.assertEqual(settings["background"], [0.25, 0.5, 1])
        self.assertEqual(settings["camera"], {"eye": [100, 0, 1], "look_at": [0, 0, 1], "up": [0, 0, 2], "fov_deg": 45})
        self.assertEqual((settings["radius"], settings["radius_scale"], settings["recenter"]), (2, 0.5, True))
        self.assertTrue(self.settings("scenario1", *SMALL, "--shadows")["shadows"])

    def test_ambient_occlusion_by_option_and_scene_file(self):
        plain = self.render("demo", *SMALL, "--style", "plain")
        self.assertNotIn("ambient_occlusion", plain["settings"])
        self.assertEqual(plain["rays"]["ambient"], 0)
        by_option = self.render("demo", *SMALL, "--style", "plain", "--ao-distance", "10", "--ao-directions", "8")
        self.assertEqual(by_option["settings"]["ambient_occlusion"], {"distance": 10, "directions": 8})
        self.assertGreater(by_option["rays"]["ambient"], 0)
        self.assertNotEqual(by_option["picture_hash"], plain["picture_hash"])
        self.assertEqual(self.settings("demo", *SMALL, "--style", "plain", "--ao")["ambient_occlusion"], {"directions": 64})

        # A scene file says it too, from version 2 on; options replace it.
        scene = '{"bihive_scene": 2, "picture": {"ambient_occlusion": {"distance": 3}}, "spheres": [[0, 0, 0, 1], [1, 1, 0, 1]]}'
        self.write("a.json", scene)
        self.assertEqual(self.settings("a.json", *SMALL)["ambient_occlusion"], {"distance": 3, "directions": 64})
        changed = self.settings("a.json", *SMALL, "--ao-directions", "5")
        self.assertEqual(changed["ambient_occlusion"], {"distance": 3, "directions": 5})
        self.assertNotIn("ambient_occlusion", self.settings("a.json", *SMALL, "--no-ao"))

    def test_files_are_drawn_in_the_default_style_and_scenes_in_their_own(self):
        settings = self.settings("demo", *SMALL)
        self.assertEqual(settings["ambient_occlusion"], {"directions": 32})
        self.assertEqual((settings["outline_px"], settings["light_points"]), (1, 6))
        self.assertGreater(settings["fog"], 0)
        self.assertEqual(self.render("demo", *SMALL)["picture_hash"], self.render("demo", *SMALL, "--style", "default")["picture_hash"])
        for scene in ["four-spheres", "scenario1"]:
            self.assertNotIn("fog", self.settings(scene, *SMALL))
        self.succeed("scene", "four-spheres", "-o", "four.json")
        same = [self.render(name, *SMALL)["picture_hash"] for name in ["four-spheres", "four.json"]]
        self.assertEqual(same[0], same[1])
        # A style that is asked for fills what a scene file leaves open.
        self.write("open.json", '{"bihive_scene": 1, "background": [1, 0, 0], "spheres": [[0, 0, 0, 1]]}')
        self.assertNotIn("ambient_occlusion", self.settings("open.json", *SMALL))
        studio = self.settings("open.json", *SMALL, "--style", "studio")
        self.assertEqual((studio["ambient_occlusion"], studio["background"]), ({"directions": 48}, [1, 0, 0]))

    def test_each_style_light_and_material_draws_another_picture(self):
        styles = [style["name"] for style in self.succeed_json("styles")["styles"]]
        self.assertEqual(styles[:2], ["default", "plain"])
        hashes = {style: self.render("demo", *SMALL, "--style", style)["picture_hash"] for style in styles}
        for light in ["studio", "cloudy", "headlight"]:
            hashes[light] = self.render("demo", *SMALL, "--style", "plain", "--light", light)["picture_hash"]
        for material in ["matte", "plastic", "metal", "glass", "flat", "toon"]:
            hashes[material] = self.render("demo", *SMALL, "--style", "plain", "--material", material)["picture_hash"]
        self.assertEqual(len(set(hashes.values())), len(hashes), hashes)
        thesis = self.render("demo", *SMALL, "--style", "plain", "--light", "thesis")
        self.assertEqual(thesis["picture_hash"], hashes["plain"])

    def test_lights_of_ones_own(self):
        def hash_with(*lights):
            options = [option for light in lights for option in ["--light", light]]
            return self.render("demo", *SMALL, "--style", "plain", *options)["picture_hash"]

        left, right = "from:-1,0,1", "from:1,0,1"
        hashes = [hash_with(left), hash_with(right), hash_with(left, right), hash_with("studio", left), hash_with("studio")]
        hashes += [hash_with(left + ":orange"), hash_with(left + "::0.5"), hash_with("at:100,0,100"), hash_with("at:0,100,100")]
        self.assertEqual(len(set(hashes)), len(hashes))
        # A wide light throws soft shadows, and the place of a light does not depend on the camera.
        self.assertEqual(hash_with("at:100,0,100:white:1:0"), hash_with("at:100,0,100"))
        soft = ["--light-points", "8", "--shadows"]
        wide = self.render("demo", *SMALL, *soft, "--light", "at:100,0,100:white:1:30")["picture_hash"]
        sharp = self.render("demo", *SMALL, *soft, "--light", "at:100,0,100")["picture_hash"]
        self.assertNotEqual(wide, sharp)

    def test_options_change_parts_of_a_style(self):
        settings = self.settings("demo", *SMALL, "--outline", "2", "--fog", "0.5", "--light-points", "3", "--no-ao")
        self.assertEqual((settings["outline_px"], settings["fog"], settings["light_points"]), (2, 0.5, 3))
        self.assertNotIn("ambient_occlusion", settings)
        settings = self.settings("demo", *SMALL, "--outline", "0", "--fog", "0", "--no-shadows")
        self.assertNotIn("outline_px", settings)
        self.assertNotIn("fog", settings)
        self.write("own.json", '{"bihive_style": 1, "background": [0, 0, 1], "picture": {"fog": {"strength": 0.125}}}')
        settings = self.settings("demo", *SMALL, "--style", "own.json")
        self.assertEqual((settings["background"], settings["fog"]), ([0, 0, 1], 0.125))

    def test_outlines_of_a_selection_and_creases(self):
        def hash_with(*options):
            size = ["--size", "320x240", "--samples", "1"]  # lines fade where spheres appear small
            return self.render("demo", *size, "--style", "plain", *options)["picture_hash"]

        hashes = [hash_with(), hash_with("--outline", "2"), hash_with("--select", "chain A", "--outline", "2")]
        hashes += [hash_with("--crease", "chain"), hash_with("--crease", "resid")]
        self.assertEqual(len(set(hashes)), len(hashes))
        self.assertEqual(hash_with("--outline", "3", "--select", "all", "--outline", "2"), hashes[1])
        self.assertEqual(self.settings("demo", *SMALL, "--outline", "2", "--select", "water", "--outline", "0")["outline_px"], 2)
        # A scene file says it for a selection or for each sphere.
        looks = '"spheres": [[0, 0, 0, 1], [1, 0, 0, 1]], "looks": [{"select": "x > 0", "outline": 4, "crease": "x"}]'
        spheres = '"spheres": [[0, 0, 0, 1], {"centre": [1, 0, 0], "radius": 1, "outline": 4, "crease": 7}]'
        hashes = set()
        for i, text in enumerate([looks, spheres, '"spheres": [[0, 0, 0, 1], [1, 0, 0, 1]]']):
            self.write(f"lines{i}.json", '{"bihive_scene": 2, ' + text + "}")
            hashes.add(self.render(f"lines{i}.json", "--size", "160x120", "--view-from", "iso")["picture_hash"])
        self.assertEqual(len(hashes), 2)

    def test_looks_have_the_same_bits_everywhere(self):
        for look in [["--style", "default"], ["--style", "studio"], ["--style", "plain", "--material", "toon", "--light", "studio"]]:
            pictures = {
                self.render("demo", *SMALL, *look, "--engine", engine, "--threads", threads)["picture_hash"]
                for engine in ["wide", "reference", "brute"]
                for threads in ["1", "2", "7"]
            }
            self.assertEqual(len(pictures), 1, look)

    def test_bad_looks_are_refused(self):
        self.write("bad.json", '{"bihive_style": 1, "material": "wood"}')
        for arguments, code, words in [
            (["--style", "pretty"], 2, ['--style: there is no style "pretty"', "default, plain"]),
            (["--style", "none.json"], 1, ["none.json"]),
            (["--style", "bad.json"], 1, ["bad.json: /material", "matte, plastic"]),
            (["--material", "wood"], 2, ["--material", "matte"]),
            (["--light", "disco"], 2, ["--light", "studio"]),
            (["--light", "at:1,2"], 2, ["--light", "three numbers"]),
            (["--light", "from:1,0,0:mauve"], 2, ["--light", "mauve"]),
            (["--light", "studio", "--light", "cloudy"], 2, ["--light", "a preset already"]),
            (["--light-points", "0"], 2, ["--light-points"]),
            (["--outline", "0.5"], 2, ["--outline", "0 or a number from 1 to 16"]),
            (["--outline", "17"], 2, ["--outline"]),
            (["--outline", "1", "--outline", "2"], 2, ["--outline", "more than once"]),
            (["--select", "water", "--outline", "0.5"], 2, ["--outline", "0 or a number from 1 to 16"]),
            (["--crease", "chian"], 2, ["--crease", "did you mean 'chain'"]),
            (["--crease", ""], 2, ["--crease"]),
            (["--fog", "1.5"], 2, ["--fog"]),
            (["--style", "--fog"], 2, ["--style"]),
        ]:
            done = self.run_bihive("render", "demo", "-o", "c.png", *arguments)
            self.assertEqual(done.returncode, code, (arguments, done.stderr))
            for word in words:
                self.assertIn(word, done.stderr)
        done = self.run_bihive("render", "scenario1", "-o", "c.png", "--style", "studio")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--style is for files, not for scenario1", done.stderr)
        self.assertFalse(os.path.exists(self.path("c.png")))

    def test_bad_ambient_occlusion_is_refused(self):
        for arguments in (["--ao-distance", "0"], ["--ao-directions", "0"], ["--ao", "--no-ao"]):
            done = self.run_bihive("render", "demo", "-o", "c.png", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(arguments[0] if len(arguments) == 2 else arguments[-1], done.stderr)
        self.write("old.json", '{"bihive_scene": 1, "picture": {"ambient_occlusion": {}}, "spheres": [[0, 0, 0, 1]]}')
        done = self.run_bihive("render", "old.json", "-o", "c.png")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/picture/ambient_occlusion: expected no such key in version 1", done.stderr)
        self.assertFalse(os.path.exists(self.path("c.png")))

    def test_json_says_what_was_done(self):
        said = self.render("scenario2", *SMALL, "--count", "64", "--seed", "9")
        self.assertEqual((said["output"], said["scene"], said["seed"]), ("a.png", "scenario2", 9))
        self.assertEqual((said["size"], said["view"], said["engine"]), ("48x32", "shaded", "wide"))
        self.assertEqual(said["spheres"], 64)
        self.assertEqual(said["rays"]["primary"], 48 * 32)
        self.assertEqual(said["rays"]["shadow"], 0)
        self.assertGreater(said["rays"]["reflected"], 0)
        self.assertGreater(said["rays"]["transmitted"], 0)
        self.assertRegex(said["picture_hash"], r"\A[0-9a-f]{16}\Z")
        for key in ["read_ms", "build_ms", "render_ms", "write_ms", "mray_per_s"]:
            self.assertGreater(said[key], 0)
        self.assertGreater(said["peak_memory_bytes"], 4e6)

    def test_peak_memory_is_that_of_the_program_alone(self):
        if is_sanitized():
            self.skipTest("the address sanitizer takes much memory")
        held = bytearray(b"1") * 200_000_000  # by the program that calls bihive
        self.assertLess(self.render("demo", *SMALL)["peak_memory_bytes"], len(held) / 2)

    def test_text_is_one_line(self):
        said = self.succeed("render", "demo", "-o", "a.png", *SMALL)
        self.assertRegex(said, r"\Aa\.png: 48 x 32, 1,631 spheres; [^\n]+\n\Z")

    def test_text_chunks(self):
        self.render("scenario3", *SMALL, "--seed", "12")
        text = png_text(self.read("a.png"))
        self.assertRegex(text["Software"], r"\Abihive \d")
        self.assertEqual((text["Scene"], text["Seed"]), ("scenario3", "12"))
        self.render("demo", *SMALL)
        self.assertNotIn("Seed", png_text(self.read("a.png")))

    def test_names_beyond_ascii(self):
        self.write("grün.xyz", "1\n\nC 0 0 0\n")
        self.render("grün.xyz", *SMALL, out="größe.png")
        self.assertEqual(png_text(self.read("größe.png"))["Scene"], "grün.xyz")

    def test_the_same_bytes_for_any_engine_and_threads(self):
        for view in ["shaded", "recursion", "normal", "distance", "id"]:
            pictures = set()
            for options in [
                [],
                ["--engine", "brute"],
                ["--engine", "wide", "--max-prims", "3"],
                ["--engine", "reference", "--max-prims", "1"],
                ["--engine", "reference", "--threads", "1"],
                ["--threads", "7", "--max-prims", "1"],
                ["--max-depth", "3", "--max-prims", "unlimited"],
            ]:
                self.render("scenario3", "--count", "200", *SMALL, "--view", view, *options)
                pictures.add(self.read("a.png"))
            self.assertEqual(len(pictures), 1, view)

    def test_views_and_recursion_differ(self):
        views = ["shaded", "recursion", "traversal", "normal", "distance", "id", "tree"]
        hashes = {self.render("four-spheres", *SMALL, "--view", view)["picture_hash"] for view in views}
        self.assertEqual(len(hashes), len(views))
        depths = {self.render("four-spheres", "--size", "320x240", "--recursion", str(n))["picture_hash"] for n in range(1, 6)}
        self.assertEqual(len(depths), 5)

    def test_the_traversal_view_shows_the_tree(self):
        def picture(*options):
            return self.render("scenario1", "--count", "64", *SMALL, "--view", "traversal", *options)["picture_hash"]

        self.assertNotEqual(picture("--max-prims", "1"), picture("--max-prims", "32"))
        self.assertEqual(picture("--max-depth", "1"), picture("--max-prims", "unlimited"))

    def test_the_tree_view_draws_the_tree_of_any_input(self):
        self.write("a.csv", "x,y,z,r\n0,0,0,1\n9,0,0,1\n0,9,0,1\n0,0,9,1\n")
        for given in ["scenario3", "four-spheres", "demo", "a.csv"]:
            for size in ["96x64", "64x96"]:
                one = self.render(given, "--view", "tree", "--max-prims", "1", "--size", size)
                self.assertEqual(png_size(self.read("a.png")), tuple(map(int, size.split("x"))))
                self.assertGreater(len({pixel for row in png_pixels(self.read("a.png")) for pixel in row}), 20)
                self.assertEqual((one["settings"]["view"], one["settings"]["max_prims"]), ("tree", 1))
                again = self.render(given, "--view", "tree", "--max-prims", "1", "--size", size, "--threads", "3")
                self.assertEqual(one["picture_hash"], again["picture_hash"])
                other = self.render(given, "--view", "tree", "--max-prims", "unlimited", "--size", size)
                self.assertNotEqual(one["picture_hash"], other["picture_hash"])

    def test_a_gap_is_green_in_the_tree_view(self):
        # Two spheres far apart: the root's bar, at the top of the right part, is green in its middle.
        self.write("a.csv", "x,y,z,r\n0,0,0,1\n20,0,0,1\n")
        self.render("a.csv", "--view", "tree", "--max-prims", "1", "--size", "200x100")
        rows = png_pixels(self.read("a.png"))
        red, green, blue = rows[5][152]
        self.assertGreater(green, 2 * max(red, blue))

    def test_background_is_what_is_seen(self):
        def corner(*options):
            self.render("demo", *SMALL, *options)
            return png_pixels(self.read("a.png"))[0][0]

        self.assertEqual(corner("--background", "#204080"), (0x20, 0x40, 0x80))
        self.assertEqual(corner("--background", "#204080", "--transfer", "none"), (0x20, 0x40, 0x80))
        self.assertEqual(corner("--background", "red"), (255, 0, 0))
        self.assertEqual(corner("--background", "0,0.5,1", "--transfer", "none"), (0, 128, 255))
        self.assertEqual(corner("--background", "0,0.5,1"), (0, 188, 255))

    def test_the_side_that_is_seen(self):
        self.write("two.csv", "x,y,z,r\n0,0,0,1\n5,0,0,1\n")
        eyes = {}
        for side in ["front", "back", "left", "right", "top", "bottom", "iso"]:
            camera = self.settings("two.csv", *SMALL, "--view-from", side)["camera"]
            eyes[side] = [eye - middle for eye, middle in zip(camera["eye"], camera["look_at"])]
        self.assertEqual(eyes["front"], self.eye_of("two.csv"))
        self.assertTrue(eyes["front"][2] > 0 > eyes["back"][2])
        self.assertTrue(eyes["right"][0] > 0 > eyes["left"][0])
        self.assertTrue(eyes["top"][1] > 0 > eyes["bottom"][1])
        self.assertTrue(min(eyes["iso"]) > 0)

    def eye_of(self, given):
        camera = self.settings(given, *SMALL)["camera"]
        return [eye - middle for eye, middle in zip(camera["eye"], camera["look_at"])]

    def test_the_whole_set_is_in_view(self):
        for size in ["64x48", "48x64"]:
            self.render("demo", "--size", size)
            rows = png_pixels(self.read("a.png"))
            border = rows[0] + rows[-1] + [row[0] for row in rows] + [row[-1] for row in rows]
            self.assertEqual(set(border), {(255, 255, 255)})
            self.assertGreater(sum(pixel != (255, 255, 255) for row in rows for pixel in row), 64 * 48 / 5)

    def test_missing_parts_of_the_camera_are_filled_in(self):
        bounds = self.succeed_json("info", "demo")["bounds"]
        middle = [0.5 * lo + 0.5 * hi for lo, hi in zip(bounds["lo"], bounds["hi"])]
        camera = self.settings("demo", *SMALL, "--eye", "200,0,0")["camera"]
        self.assertEqual((camera["eye"], camera["look_at"], camera["up"]), ([200, 0, 0], middle, [0, 1, 0]))
        camera = self.settings("scenario1", *SMALL, "--eye", "0,100,0")["camera"]
        self.assertEqual((camera["look_at"], camera["up"]), ([0, 0, 0], [0, 0, -1]))
        camera = self.settings("scenario1", *SMALL, "--look-at", "5,0,0")["camera"]
        self.assertEqual((camera["eye"], camera["look_at"]), ([0, 0, 100], [5, 0, 0]))

    def test_radius_reaches_scenarios_and_files(self):
        self.write("a.csv", "x,y,z,r\n0,0,0,1\n9,0,0,1\n")
        for given in ["scenario1", "a.csv", "demo"]:
            wide = self.render(given, *SMALL, "--radius", "1.5")["picture_hash"]
            self.assertNotEqual(wide, self.render(given, *SMALL, "--radius", "0.5")["picture_hash"], given)

    def test_a_scene_file_with_everything(self):
        self.write(
            "s.json",
            """{"bihive_scene": 1, "name": "all of it",
            "camera": {"eye": [0, 2, 20], "look_at": [0, 0, 0], "fov_deg": 40},
            "lights": [{"position": [10, 20, 10]}, {"position": [-10, 20, 10], "colour": "blue"}],
            "materials": [{"name": "mirror", "reflective": 0.6, "colour": "grey"}],
            "plane": {"point": [0, -2, 0], "normal": [0, 1, 0], "checker": {"size": 1, "second_colour": "black"}},
            "background": "#102030", "picture": {"width_px": 40, "height_px": 30, "samples_per_pixel": 2},
            "spheres": [[0, 0, 0, 2], {"centre": [3, 0, 0], "radius": 1, "colour": "red", "opacity": 0.5}]}""",
        )
        said = self.render("s.json")
        self.assertEqual(png_size(self.read("a.png")), (40, 30))
        self.assertEqual(said["scene"], "all of it")
        self.assertEqual(said["settings"]["samples_per_pixel"], 2)
        self.assertGreater(said["rays"]["reflected"], 0)
        self.assertGreater(said["rays"]["shadow"], 0)
        self.assertGreater(said["rays"]["transmitted"], 0)
        self.assertEqual(self.settings("s.json", "--size", "8x6")["width_px"], 8)

    def test_a_scene_file_finds_its_spheres(self):
        os.mkdir(self.path("data"))
        self.write("data/a.xyz", "2\n\nC 0 0 0\nO 3 0 0\n")
        self.write("data/s.json", '{"bihive_scene": 1, "spheres": {"file": "a.xyz"}}')
        from_scene = self.render("data/s.json", *SMALL)["picture_hash"]
        self.assertEqual(from_scene, self.render("data/a.xyz", *SMALL, "--style", "plain")["picture_hash"])

    def test_a_link_is_followed(self):
        self.write("real.png", "old")
        os.symlink("real.png", self.path("link.png"))
        self.succeed("render", "demo", *SMALL, "-o", "link.png")
        self.assertTrue(os.path.islink(self.path("link.png")))
        self.assertEqual(png_size(self.read("real.png")), (48, 32))


if __name__ == "__main__":
    main()
