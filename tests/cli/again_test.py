"""bihive again and bihive verify: a PNG says how it was drawn, is drawn again, and is compared bit by bit."""

import json
import os
import re
import shutil
import struct
import unittest
import zlib

from exr_file import ExrFile
from program import ProgramTest, main, png_chunks, png_numbers, png_text

SMALL = ["--size", "60x40"]
MOLECULE = "2\n\nC 0 0 0\nO 1.2 0 0\n"


def chunk(kind, body):
    named = kind.encode() + body
    return struct.pack(">I", len(body)) + named + struct.pack(">I", zlib.crc32(named))


def with_changed_pixel(data):
    """The PNG with one byte of its last pixel changed."""
    out = data[:8]
    pixels = zlib.decompress(b"".join(body for kind, body in png_chunks(data) if kind == "IDAT"))
    pixels = pixels[:-1] + bytes([pixels[-1] ^ 7])
    done = False
    for kind, body in png_chunks(data):
        if kind == "IDAT":
            if done:
                continue
            body, done = zlib.compress(pixels), True
        out += chunk(kind, body)
    return out


def with_text(data, change):
    """The PNG with its texts changed: change(body) of each tEXt chunk."""
    return data[:8] + b"".join(chunk(kind, change(body) if kind == "tEXt" else body) for kind, body in png_chunks(data))


class AgainTest(ProgramTest):
    def record(self, name):
        return json.loads(png_text(self.read(name))["bihive"])

    def draw(self, *options, name="a.png"):
        self.succeed("render", *options, "-o", name)

    def verify_json(self, *arguments, code=0):
        done = self.run_bihive("verify", *arguments, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout)["figures"]


class Record(AgainTest):
    def test_it_has_the_request_and_neither_threads_nor_folders(self):
        os.mkdir(self.path("in"))
        self.write("in/m.xyz", MOLECULE)
        self.draw("in/m.xyz", *SMALL, "--threads", "2", "--engine", "reference", "--select", "element O", "--colour", "red", "--fog", "0")
        record = self.record("a.png")
        self.assertEqual([[file["option"], file["name"]] for file in record["files"]], [["input", "m.xyz"]])
        self.assertEqual(record["options"], [["size", "60x40"], ["fog", "0"], ["select", "element O"], ["colour", "red"]])
        self.assertEqual(len(record["pixels"]), 64)
        # The same file by any number of threads and any engine of the CPU.
        self.draw("in/m.xyz", "--fog", "0", *SMALL, "--select", "element O", "--colour", "red", name="b.png")
        self.assertEqual(self.read("a.png"), self.read("b.png"))

    def test_a_map_from_a_file_is_recorded_as_colours(self):
        self.write("map.txt", "#000000\n#ff0000\n")
        self.draw("demo", *SMALL, "--colour-by", "b_factor:map.txt")
        os.remove(self.path("map.txt"))
        self.succeed("verify", "a.png")

    def test_no_metadata_leaves_everything_out(self):
        self.draw("demo", *SMALL, "--no-metadata")
        self.assertEqual(png_text(self.read("a.png")), {})
        self.assertIn("does not say how it was drawn", self.fail_input("again", "a.png"))


class Again(AgainTest):
    def test_without_changes_it_is_the_same_file(self):
        self.draw("demo", *SMALL, "--style", "illustrative", "--turn", "30,20", "--select", "chain A", "--opacity", "0.3")
        self.succeed("again", "a.png")
        self.assertEqual(self.read("a.png"), self.read("a-again.png"))

    def test_changes_replace_what_is_recorded(self):
        self.draw("demo", *SMALL, "--style", "flat", "--colour-by", "b_factor", "--view-from", "left", "--select", "chain A", "--colour", "red")
        self.succeed("again", "a.png", "--size", "30x20", "--eye", "0,0,90", "--colour-by", "z", "-o", "b.png")
        self.draw("demo", "--size", "30x20", "--style", "flat", "--eye", "0,0,90", "--colour-by", "z", "--select", "chain A", "--colour", "red", name="c.png")
        self.assertEqual(self.read("b.png"), self.read("c.png"))
        # Selections of one's own come after the recorded ones.
        self.succeed("again", "a.png", "--select", "chain B", "--hide", "-o", "b.png")
        self.draw("demo", *SMALL, "--style", "flat", "--colour-by", "b_factor", "--view-from", "left", "--select", "chain A", "--colour", "red",
                  "--select", "chain B", "--hide", name="c.png")
        self.assertEqual(self.read("b.png"), self.read("c.png"))

    def test_an_option_and_a_selection_together(self):
        self.draw("demo", *SMALL, "--style", "flat")
        self.succeed("again", "a.png", "--size", "30x20", "--select", "chain B", "--hide", "-o", "b.png")
        self.draw("demo", "--size", "30x20", "--style", "flat", "--select", "chain B", "--hide", name="c.png")
        self.assertEqual(self.read("b.png"), self.read("c.png"))

    def test_another_input_is_drawn_alike(self):
        self.write("m.xyz", MOLECULE)
        self.write("n.xyz", MOLECULE.replace("1.2", "1.5"))
        self.draw("m.xyz", *SMALL, "--style", "glossy")
        self.succeed("again", "a.png", "n.xyz", "-o", "b.png")
        self.draw("n.xyz", *SMALL, "--style", "glossy", name="c.png")
        self.assertEqual(self.read("b.png"), self.read("c.png"))

    def test_files_are_found_beside_the_figure_or_named(self):
        os.mkdir(self.path("figures"))
        self.write("figures/m.xyz", MOLECULE)
        self.write("figures/s.json", '{"bihive_style": 1, "background": "black"}')
        self.draw("figures/m.xyz", *SMALL, "--style", "figures/s.json", name="figures/a.png")
        self.succeed("again", "figures/a.png", "-o", "b.png")
        self.assertEqual(self.read("figures/a.png"), self.read("b.png"))
        shutil.move(self.path("figures/a.png"), self.path("figures/m.xyz.png"))
        os.mkdir(self.path("x"))
        shutil.move(self.path("figures/m.xyz"), self.path("x/other.xyz"))
        error = self.fail_usage("again", "figures/m.xyz.png", "-o", "b.png")
        self.assertIn("m.xyz", error)
        self.assertIn("name the input after the figure", error)
        self.succeed("again", "figures/m.xyz.png", "x/other.xyz", "-o", "c.png")
        self.assertEqual(png_numbers(self.read("b.png")), png_numbers(self.read("c.png")))

    def test_words_in_a_record_are_data(self):
        self.write("m.xyz", MOLECULE)
        self.draw("m.xyz", *SMALL, "--background", "black")
        data = self.read("a.png")
        for old, new in [(b'"background","black"', b'"title_values","/x"'), (b'"name":"m.xyz"', b'"name":"../zz"'),
                         (b'"background","black"', b'"no_such","option"')]:
            out = data[:8]
            for kind, body in png_chunks(data):
                if kind == "tEXt" and body.startswith(b"bihive\0"):
                    self.assertIn(old, body)
                    body = body.replace(old, new)
                out += chunk(kind, body)
            self.write("b.png", out)
            done = self.run_bihive("again", "b.png", "-o", "c.png")
            self.assertIn(done.returncode, (1, 2), new)
            self.assertFalse(os.path.exists(self.path("c.png")))


class Verify(AgainTest):
    def test_the_same_bits(self):
        self.draw("demo", *SMALL, "--bits", "16", "--background", "none", "--crop", "5,5,50,30")
        self.assertEqual(self.succeed("verify", "a.png"), "a.png: the same bits\n")
        self.assertEqual(self.verify_json("a.png")[0]["verified"], True)

    def test_another_version_that_drew_the_same_bits(self):
        self.draw("demo", *SMALL)
        now = self.record("a.png")["version"]
        old = b'"version":"0.0.9"'
        self.write("old.png", with_text(self.read("a.png"), lambda body: body.replace(f'"version":"{now}"'.encode(), old)))
        self.assertEqual(self.record("old.png")["version"], "0.0.9")
        self.assertRegex(self.succeed("verify", "old.png"), rf"\Aold.png: the same bits, drawn by 0\.0\.9.*, now by {re.escape(now)}")
        verdict = self.verify_json("old.png")[0]
        self.assertEqual(verdict["verified"], True)
        self.assertRegex(verdict["drawn_by"], r"\A0\.0\.9")

    def test_a_changed_picture_is_told_and_shown(self):
        self.draw("demo", *SMALL)
        self.write("b.png", with_changed_pixel(self.read("a.png")))
        verdict = self.verify_json("b.png", "--difference", "d.png", code=1)[0]
        self.assertEqual((verdict["verified"], verdict["pixels_differ"], verdict["first_difference"]), (False, 1, [59, 39]))
        self.assertTrue(verdict["edited"])
        rows = png_numbers(self.read("d.png"))
        self.assertEqual([pixel for row in rows for pixel in row if pixel != (0, 0, 0)], [(0, 0, 255)])

    def test_another_input_is_told_also_where_all_pixels_agree(self):
        self.write("m.xyz", MOLECULE)
        self.draw("m.xyz", *SMALL)
        self.write("m.xyz", MOLECULE.replace("\n\n", "\nanother comment\n"))
        done = self.run_bihive("verify", "a.png")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the input has other bytes", done.stdout)
        self.assertIn("all pixels are the same", done.stdout)
        self.write("n.xyz", MOLECULE)
        self.succeed("verify", "a.png", "n.xyz")

    def test_the_bundled_molecule_is_its_file(self):
        self.draw("demo", *SMALL)
        molecule = os.path.join(os.environ["BIHIVE_SOURCE"], "data/1hpv.pdb")
        self.assertIn("the same bits", self.succeed("verify", "a.png", molecule))
        shutil.copy(molecule, self.path("1hpv.pdb"))
        self.draw("1hpv.pdb", *SMALL, name="b.png")
        self.succeed("verify", "b.png", "demo")
        self.write("m.xyz", MOLECULE)
        done = self.run_bihive("verify", "a.png", "m.xyz")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the input is not the built-in scene demo", done.stdout)

    def test_a_folder_of_figures(self):
        os.mkdir(self.path("f"))
        for number, style in enumerate(["flat", "xray"]):
            self.draw("demo", *SMALL, "--style", style, name=f"f/{number}.png")
        self.write("f/m.xyz", MOLECULE)
        self.draw("f/m.xyz", *SMALL, name="f/m.png")
        self.draw("demo", *SMALL, "--no-metadata", name="f/other.png")
        self.assertIn("3 of 3 figures have the same bits", self.succeed("verify", "f"))
        self.write("f/broken.png", self.read("f/0.png")[:-40])
        self.assertIn("f/broken.png: not drawn: is not a readable PNG", self.run_bihive("verify", "f").stdout)
        os.remove(self.path("f/broken.png"))
        os.remove(self.path("f/m.xyz"))
        verdicts = self.verify_json("f", code=1)
        self.assertEqual([verdict["verified"] for verdict in verdicts], [True, True, False])
        self.assertIn("m.xyz", verdicts[2]["error"])

    def test_words_for_a_methods_section(self):
        self.write("m.xyz", MOLECULE)
        said = self.succeed("render", "m.xyz", *SMALL, "-o", "a.png", "--methods", "--style", "illustrative").split("\n", 2)[2]
        self.assertRegex(said, r"^The figure was rendered with bihive [^[]* \[bihive\]: 2 spheres of m\.xyz \(SHA-256 [0-9a-f]{64}\), style illustrative, ")
        self.assertIn("60 x 40 pixels of 4 samples, fog, outlines. ", said)
        self.assertIn("@misc{bihive,", said)
        self.assertEqual(self.succeed("verify", "a.png", "--methods"), said)
        self.assertEqual(self.succeed_json("render", "m.xyz", *SMALL, "-o", "b.png", "--methods", "--style", "illustrative")["methods"], said)
        self.succeed("render", "scenario1", "-o", "c.png", "--projection", "orthographic", "--samples", "auto", "--ao", "--shadows", *SMALL)
        self.assertIn(
            " of the built-in scene scenario1, orthographic projection, 60 x 40 pixels of as many samples as each needs, shadows, "
            "ambient occlusion in ",
            self.succeed("verify", "c.png", "--methods"),
        )
        self.fail_usage("verify", "a.png", "--methods", "--json")
        self.write("m.xyz", MOLECULE + "\n")
        self.assertIn("other bytes", self.fail_input("verify", "a.png", "--methods"))

    def test_what_is_no_figure(self):
        self.write("a.png", b"nothing")
        self.assertEqual(self.run_bihive("verify", "a.png").returncode, 1)
        self.assertEqual(self.run_bihive("verify", "missing.png").returncode, 1)
        os.mkdir(self.path("empty"))
        self.assertIn("no picture", self.fail_input("verify", "empty"))


class OtherFiles(AgainTest):
    """TIFF and OpenEXR carry the same record."""

    def draw_or_skip(self, *options, name):
        done = self.run_bihive("render", *options, "-o", name)
        if done.returncode == 3 and "this build of bihive has no" in done.stderr:
            raise unittest.SkipTest(done.stderr)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_tiff_has_the_record_of_the_png(self):
        for more in ([], ["--bits", "16", "--background", "none"], ["--crop", "5,5,50,30"]):
            self.draw_or_skip("demo", *SMALL, *more, name="a.tif")
            self.draw("demo", *SMALL, *more)
            self.assertEqual(self.succeed("verify", "a.tif"), "a.tif: the same bits\n")
            self.assertIn(png_text(self.read("a.png"))["bihive"][:-1].encode(), self.read("a.tif"))
            self.succeed("again", "a.tif")
            self.assertEqual(self.read("a.tif"), self.read("a-again.tif"))
        self.succeed("again", "a.tif", "-o", "b.png")
        self.assertEqual(self.read("a.png"), self.read("b.png"))
        self.draw_or_skip("demo", *SMALL, "--no-metadata", name="b.tif")
        self.assertNotIn(b'"record"', self.read("b.tif"))
        self.assertIn("does not say how it was drawn", self.verify_json("b.tif", code=1)[0]["error"])

    def test_an_exr_has_layers_in_its_record(self):
        for layers in (None, "radiance,id,depth", "normal,attribute:b_factor"):
            more = [] if layers is None else ["--layers", layers]
            self.draw_or_skip("demo", *SMALL, "--background", "none", "--crop", "5,5,50,38", *more, name="a.exr")
            self.assertEqual(self.succeed("verify", "a.exr"), "a.exr: the same bits\n")
            record = json.loads(ExrFile(self.read("a.exr")).attributes["bihive"][1])
            self.assertEqual(record["layers"], (layers or "radiance").split(","))
            self.assertEqual(len(record["pixels"]), 64)
            self.succeed("again", "a.exr")
            self.assertEqual(self.read("a.exr"), self.read("a-again.exr"))
        self.assertIn("has layers", self.fail_input("scene", "save", "s.json", "a.exr"))
        self.draw_or_skip("demo", *SMALL, "--no-metadata", name="b.exr")
        self.assertNotIn("bihive", ExrFile(self.read("b.exr")).attributes)

    def test_threads_change_no_byte(self):
        for name in ("a.tif", "a.exr"):
            self.draw_or_skip("demo", *SMALL, "--threads", "1", name=name)
            first = self.read(name)
            self.draw_or_skip("demo", *SMALL, "--threads", "3", "--engine", "reference", name=name)
            self.assertEqual(first, self.read(name))

    def test_other_numbers_are_told(self):
        self.write("m.xyz", MOLECULE)
        for name in ("a.tif", "a.exr"):
            self.draw_or_skip("m.xyz", *SMALL, name=name)
            self.write("n.xyz", MOLECULE.replace("1.2", "1.5"))
            verdict = self.verify_json(name, "n.xyz", code=1)[0]
            self.assertGreater(verdict["pixels_differ"], 0)
            self.assertGreater(verdict["largest_difference"], 0)
            self.assertEqual((verdict["edited"], verdict["changed_files"]), (False, ["input"]))
        # A bit of the numbers.
        data = bytearray(self.read("a.exr"))
        data[-3] ^= 1
        self.write("b.exr", bytes(data))
        self.assertEqual(self.verify_json("b.exr", code=1)[0]["verified"], False)


main()
