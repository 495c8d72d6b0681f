"""bihive render: transparent pictures, 16 bits, the size in print, and the picture on the standard output."""

import os
import struct
import subprocess

from program import BIHIVE, PATIENCE_S, ProgramTest, main, png_chunks, png_numbers, png_size

SMALL = ["--size", "60x40"]


def light_of(number, most):
    """Linear light of a number on the sRGB curve."""
    share = number / most
    return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4


class PublishTest(ProgramTest):
    def picture(self, *arguments):
        self.succeed("render", *arguments, "-o", "a.png")
        return png_numbers(self.read("a.png"))


class Transparent(PublishTest):
    def test_laid_over_white_it_is_the_picture_on_white(self):
        transparent = self.picture("demo", *SMALL, "--background", "none", "--samples", "16", "--bits", "16")
        on_white = self.picture("demo", *SMALL, "--samples", "16", "--bits", "16")
        opacities = set()
        for seen, expected in zip(sum(transparent, []), sum(on_white, [])):
            opacity = seen[3] / 65535
            opacities.add(seen[3])
            for number, whole in zip(seen, expected):
                laid = opacity * light_of(number, 65535) + (1 - opacity)
                self.assertAlmostEqual(laid, light_of(whole, 65535), delta=1e-4)
        self.assertEqual(transparent[0][0], (0, 0, 0, 0))
        self.assertIn(65535, opacities)
        self.assertEqual(opacities, {round(k * 65535 / 16) for k in range(17)} & opacities)
        self.assertGreater(len(opacities), 8)

    def test_the_edge_of_a_sphere_keeps_its_colour(self):
        self.write("s.json", '{"bihive_scene": 2, "picture": {"transparent": true, "shadows": false}, "lights": [], "materials": '
                             '[{"name": "a", "colour": [0.5, 0.25, 1], "ambient": 1}], "spheres": [[0, 0, 0, 1]]}')
        pixels = set(sum(self.picture("s.json", *SMALL), []))
        colours = {pixel[:3] for pixel in pixels if pixel[3] > 0}
        self.assertEqual(colours, {(188, 137, 255)})
        self.assertEqual({pixel[3] for pixel in pixels}, {0, 64, 128, 191, 255})
        # An option replaces the scene's word.
        self.assertEqual(self.picture("s.json", *SMALL, "--background", "black")[0][0], (0, 0, 0))

    def test_every_engine_thread_and_part(self):
        pictures = set()
        for more in ([], ["--engine", "reference"], ["--engine", "brute"], ["--threads", "1"], ["--threads", "7"]):
            self.picture("scenario3", "--count", "99", *SMALL, "--background", "none", "--samples", "3", *more)
            pictures.add(self.read("a.png"))
        self.assertEqual(len(pictures), 1)
        whole = self.picture("demo", *SMALL, "--background", "none")
        part = self.picture("demo", *SMALL, "--background", "none", "--crop", "10,5,50,30")
        self.assertEqual(part, [row[10:50] for row in whole[5:30]])

    def test_what_is_refused(self):
        for view in ["traversal", "tree"]:
            said = self.fail_usage("render", "demo", "-o", "a.png", "--background", "none", "--view", view)
            self.assertIn("transparent", said)
        self.write("old.json", '{"bihive_scene": 1, "picture": {"transparent": true}, "spheres": [[0, 0, 0, 1]]}')
        said = self.fail_input("render", "old.json", "-o", "a.png")
        self.assertIn("/picture/transparent: expected no such key in version 1", said)


class File(PublishTest):
    def test_sixteen_bits_are_finer_and_agree_with_eight(self):
        fine = self.picture("demo", *SMALL, "--bits", "16")
        coarse = self.picture("demo", *SMALL, "--bits", "8")
        plain = self.picture("demo", *SMALL)
        self.assertEqual(coarse, plain)
        for ours, theirs in zip(sum(fine, []), sum(coarse, [])):
            for number, byte in zip(ours, theirs):
                self.assertLessEqual(abs(number / 257 - byte), 0.51)
        self.assertGreater(len(set(sum(fine, []))), len(set(sum(coarse, []))) // 2)
        for bits in ["", "7", "24", "8.0"]:
            self.assertIn("--bits:", self.fail_usage("render", "demo", "-o", "a.png", "--bits=" + bits))

    def test_the_size_in_print(self):
        self.picture("demo", *SMALL)
        self.assertNotIn("pHYs", dict(png_chunks(self.read("a.png"))))
        for dpi, per_metre in [("300", 11811), ("72", 2835), ("0.5", 20)]:
            self.picture("demo", *SMALL, "--dpi", dpi)
            self.assertEqual(struct.unpack(">IIB", dict(png_chunks(self.read("a.png")))["pHYs"]), (per_metre, per_metre, 1))
        for dpi in ["", "0", "-72", "x", "1e7"]:
            self.assertIn("--dpi:", self.fail_usage("render", "demo", "-o", "a.png", "--dpi=" + dpi))

    def test_the_standard_output_gets_the_picture_and_nothing_else(self):
        call = [BIHIVE, "render", "demo", *SMALL, "-o", "-"]
        done = subprocess.run(call, cwd=self.folder, capture_output=True, timeout=PATIENCE_S)
        # The report goes to stderr (issue 19): before, nobody saw it.
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, rb"\A-: 60 x 40, [^\n]+\n\Z")
        self.picture("demo", *SMALL)
        self.assertEqual(done.stdout, self.read("a.png"))
        self.assertEqual(png_size(done.stdout), (60, 40))
        self.assertEqual(os.listdir(self.folder), ["a.png"])
        said = self.fail_usage("render", "demo", "-o", "-", "--json")
        self.assertIn("--json", said)

    def test_a_full_disk_is_said(self):
        with open("/dev/full", "w") as full:
            done = self.run_bihive("render", "demo", *SMALL, "-o", "-", stdout=full)
        self.assertEqual(done.returncode, 1)
        self.assert_one_error_line(done.stderr)


class Matte(PublishTest):
    def assert_shows(self, page, numbers, *options, delta=0):
        """Mixed as screens do it, over its page the picture is the one with this background."""
        most = 2 ** (16 if "16" in options else 8) - 1
        transparent = self.picture("demo", *SMALL, "--samples", "16", *options, "--background", "none", "--matte", page)
        opaque = self.picture("demo", *SMALL, "--samples", "16", *options, "--background", page)
        for seen, expected in zip(sum(transparent, []), sum(opaque, [])):
            mixed = [(seen[3] * number + (most - seen[3]) * behind) / most for number, behind in zip(seen, numbers)]
            for number, whole in zip(mixed, expected):
                self.assertLessEqual(abs(int(number + 0.5) - whole), delta, (seen, mixed, expected))
        return transparent

    def test_over_its_page_it_is_the_picture_with_this_background(self):
        on_white = self.assert_shows("white", (255, 255, 255), "--style", "plain")
        self.assert_shows("black", (0, 0, 0), "--style", "plain")
        self.assert_shows("#304060", (0x30, 0x40, 0x60), "--fog", "0.7")
        self.assert_shows("#304060", (0x3030, 0x4040, 0x6060), "--style", "plain", "--bits", "16", delta=1)
        self.assertEqual(on_white[0][0], (255, 255, 255, 0))
        without = self.picture("demo", *SMALL, "--samples", "16", "--style", "plain", "--background", "none")
        self.assertNotEqual(on_white, without)

    def test_letters_and_scene_files(self):
        self.assert_shows("#304060", (0x30, 0x40, 0x60), "--style", "plain", "--title", "A title", delta=1)
        self.write("s.json", '{"bihive_scene": 2, "spheres": [[0, 0, 0, 1]], "picture": {"transparent": true, "matte": "#304060"}}')
        self.assertEqual(self.picture("s.json", *SMALL)[0][0], (0x30, 0x40, 0x60, 0))
        self.assertEqual(self.picture("s.json", *SMALL, "--matte", "white")[0][0], (255, 255, 255, 0))
        self.assertEqual(self.picture("s.json", *SMALL, "--background", "white")[0][0], (255, 255, 255))

    def test_what_cannot_be(self):
        message = self.fail_usage("render", "demo", "-o", "b.png", "--matte", "white")
        self.assertIn("--matte is the colour behind a transparent picture, and this one has a background", message)
        self.assertIn("colour", self.fail_usage("render", "demo", "-o", "b.png", "--background", "none", "--matte", "whiet"))
        self.fail_usage("render", "demo", "-o", "b.exr", "--background", "none", "--matte", "white")


class Srgb(PublishTest):
    def chunks(self, *options):
        self.picture(*options, *SMALL, "--samples", "1")
        return {name: data for name, data in png_chunks(self.read("a.png")) if name in ("sRGB", "gAMA")}

    def test_pictures_for_the_eye_say_that_they_are_srgb(self):
        self.assertEqual(self.chunks("demo"), {"sRGB": b"\0", "gAMA": struct.pack(">I", 45455)})
        self.assertEqual(self.chunks("demo", "--background", "none", "--bits", "16").keys(), {"sRGB", "gAMA"})
        self.assertEqual(self.chunks("demo", "--view", "normal"), {}, "numbers")
        self.assertEqual(self.chunks("demo", "--view", "id"), {}, "numbers")
        self.assertEqual(self.chunks("scenario1", "--count", "9"), {}, "pixels of the thesis are light")
        self.succeed("film", "demo", "-o", "run/%d.png", "--turntable", "90", "--pictures", "2", *SMALL, "--samples", "1")
        self.assertIn("sRGB", [name for name, _ in png_chunks(self.read("run/0.png"))])


if __name__ == "__main__":
    main()
