"""bihive render -o a.exr: light and layers of numbers."""

import math
import os
import struct
import subprocess
import tempfile
import unittest

import numpy
from exr_file import ExrFile
from program import BIHIVE, PATIENCE_S, ProgramTest, main, png_numbers

SMALL = ["--size", "60x40"]
ALL = "radiance,albedo,depth,normal,id,attribute:b_factor"
# A ball before a plane, and nothing above: the second of three spheres is hidden.
SCENE = """{"bihive_scene": 2, "camera": {"eye": [0, 0, 10], "look_at": [0, 0, 0], "fov_deg": 40},
"picture": {"exposure": 3, "tone": "filmic", "title": "T", "shadows": false},
"materials": [{"name": "a", "colour": [0.5, 0.25, 1]}],
"spheres": {"file": "s.csv"}, "looks": [{"select": "index 1", "show": false}]}"""


def has_exr():
    with tempfile.TemporaryDirectory() as folder:
        call = [BIHIVE, "render", "demo", "--size", "1x1", "-o", folder + "/a.exr"]
        done = subprocess.run(call, capture_output=True, text=True, timeout=PATIENCE_S)
    return "has no OpenEXR" not in done.stderr


HAS_EXR = has_exr()


class ExrTest(ProgramTest):
    def draw(self, *arguments):
        self.succeed("render", *arguments, "-o", "a.exr")
        return ExrFile(self.read("a.exr"))


@unittest.skipIf(HAS_EXR, "this build has OpenEXR")
class WithoutOpenExr(ExrTest):
    def test_it_is_said(self):
        said = self.fail_with(3, "render", "demo", *SMALL, "-o", "a.exr")
        self.assertIn("this build of bihive has no OpenEXR", said)
        self.assertIn("libopenexr-dev", said)


@unittest.skipUnless(HAS_EXR, "this build has no OpenEXR")
class Layers(ExrTest):
    def test_the_light_is_that_of_the_png(self):
        light = self.draw("demo", *SMALL)
        self.assertEqual(light.types, {"B": "f", "G": "f", "R": "f"})
        self.succeed("render", "demo", *SMALL, "-o", "a.png", "--bits", "16")
        for y, row in enumerate(png_numbers(self.read("a.png"))):
            for x, pixel in enumerate(row):
                for channel, number in zip("RGB", pixel):
                    linear = min(light.channels[channel][y][x], 1)
                    shown = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
                    self.assertAlmostEqual(shown * 65535, number, delta=0.52)

    def test_opacity_multiplies_the_light(self):
        file = self.draw("demo", *SMALL, "--background", "none")
        self.assertEqual(file.types, {name: "f" for name in "ABGR"})
        on_black = self.draw("demo", *SMALL, "--background", "black", "--fog", "0")
        without_fog = self.draw("demo", *SMALL, "--background", "none", "--fog", "0")
        self.assertEqual({0, 0.25, 0.5, 0.75, 1}, set(sum(file.channels["A"], [])))
        numpy.testing.assert_allclose(without_fog.channels["R"], on_black.channels["R"], atol=1e-6)

    def test_exposure_and_curve_are_those_of_the_command_line(self):
        self.write("s.csv", "x,y,z,r\n0,0,0,2\n")
        self.write("s.json", SCENE.replace(', "looks": [{"select": "index 1", "show": false}]', ""))
        plain = self.draw("s.json", *SMALL).channels["G"]
        brighter = self.draw("s.json", *SMALL, "--exposure", "1").channels["G"]
        self.assertEqual(brighter[20][30], 2 * plain[20][30])
        self.assertNotEqual(self.draw("s.json", *SMALL, "--tone", "filmic").channels["G"], plain)

    def test_the_layers_are_of_the_nearest_hit_behind_the_middle(self):
        self.write("s.csv", "x,y,z,r,charge\n0,0,0,2,-1.5\n0,0,4,1,7\n1,0,0,2,\n")
        self.write("s.json", SCENE)
        file = self.draw("s.json", "--size", "61x41", "--layers", "id,depth,normal,albedo,attribute:charge,attribute:index")
        self.assertEqual(list(file.types), ["Z", "albedo.B", "albedo.G", "albedo.R", "attribute.charge", "attribute.index", "id",
                                            "normal.X", "normal.Y", "normal.Z"])
        self.assertEqual(file.types["id"], "I")
        at = {name: rows[20][30] for name, rows in file.channels.items()}
        self.assertEqual(at["id"], 0)
        self.assertEqual((at["Z"], at["normal.X"], at["normal.Z"]), (8, 0, 1))
        self.assertEqual((at["albedo.R"], at["albedo.G"], at["albedo.B"]), (0.5, 0.25, 1))
        self.assertEqual(at["attribute.charge"], -1.5)
        corner = {name: rows[0][0] for name, rows in file.channels.items()}
        self.assertEqual((corner["id"], corner["Z"], corner["normal.X"], corner["albedo.R"]), (2**32 - 1, math.inf, 0, 0))
        self.assertTrue(math.isnan(corner["attribute.charge"]))
        self.assertEqual(set(sum(file.channels["id"], [])), {0, 2, 2**32 - 1})
        for id_row, charges, indices in zip(*(file.channels[n] for n in ("id", "attribute.charge", "attribute.index"))):
            for sphere, charge, index in zip(id_row, charges, indices):
                self.assertEqual(math.isnan(charge), sphere != 0)
                self.assertEqual(math.isnan(index) if sphere > 2 else index == sphere, True)

    def test_ids_and_depths_are_those_of_bihive_trace(self):
        """The rays through the middles of the pixels, from a camera that the test makes itself."""
        width, height = 40, 30
        camera = ["--eye", "0,0,60", "--look-at", "0,0,0", "--up", "0,1,0", "--fov", "30", "--projection", "orthographic"]
        file = self.draw("scenario1", "--count", "2000", "--size", f"{width}x{height}", *camera, "--layers", "id,depth")
        step = 2 * 60 * math.tan(math.radians(15)) / height
        x, y = numpy.meshgrid(numpy.arange(width) + 0.5 - width / 2, height / 2 - numpy.arange(height) - 0.5)
        rays = numpy.zeros((width * height, 6), dtype=numpy.float32)
        rays[:, 0], rays[:, 1], rays[:, 2], rays[:, 5] = x.ravel() * step, y.ravel() * step, 60, -1
        numpy.save(self.path("rays.npy"), rays)
        self.succeed("trace", "scenario1", "--count", "2000", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy")
        ids = numpy.load(self.path("id.npy"))
        same = numpy.array(file.channels["id"], dtype=numpy.int64).ravel() == numpy.where(ids < 0, 2**32 - 1, ids)
        self.assertGreater(same.mean(), 0.999)  # the two cameras are rounded differently
        depths = numpy.array(file.channels["Z"]).ravel()
        hit = same & (ids >= 0)
        self.assertGreater(hit.sum(), 100)
        numpy.testing.assert_allclose(depths[hit], numpy.load(self.path("t.npy"))[hit], rtol=1e-3)
        self.assertTrue(numpy.isinf(depths[same & (ids < 0)]).all())

    def test_the_plane_has_its_own_id(self):
        ids = set(sum(self.draw("four-spheres", *SMALL, "--layers", "id").channels["id"], []))
        self.assertIn(2**32 - 2, ids)


@unittest.skipUnless(HAS_EXR, "this build has no OpenEXR")
class File(ExrTest):
    def test_threads_engines_bands_and_parts(self):
        arguments = ["demo", *SMALL, "--layers", ALL, "--background", "none"]
        whole = self.draw(*arguments)
        first = self.read("a.exr")
        for more in (["--threads", "1"], ["--threads", "2"], ["--threads", "7"], ["--engine", "brute"]):
            self.draw(*arguments, *more)
            self.assertEqual(self.read("a.exr"), first, more)
        large = ["demo", "--size", "150x90", "--layers", ALL]
        self.draw(*large)
        first = self.read("a.exr")
        done = self.run_bihive("render", *large, "-o", "a.exr", env={**os.environ, "BIHIVE_MEMORY": "900000"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.read("a.exr"), first)
        part = self.draw(*arguments, "--crop", "10,5,50,30")
        self.assertEqual((part.box("displayWindow"), part.box("dataWindow")), ((0, 0, 59, 39), (10, 5, 49, 29)))
        for name, rows in part.channels.items():
            cut = [row[10:50] for row in whole.channels[name][5:30]]
            self.assertTrue(numpy.array_equal(rows, cut, equal_nan=True), name)

    def test_what_the_file_says_of_itself(self):
        self.write("b\u00E4r.csv", "x,y,z,r\n1,2,3,1\n")
        file = self.draw("b\u00E4r.csv", *SMALL, "--dpi", "300", "--layers", "radiance,id")
        self.assertEqual(file.attributes["xDensity"], ("float", struct.pack("<f", 300)))
        self.assertIn(b"bihive", file.attributes["Software"][1])
        self.assertIn("b\u00E4r", file.attributes["Scene"][1].decode())
        self.assertIn(b'"layers":["radiance","id"]', file.attributes["Settings"][1])
        self.assertIn("chromaticities", file.attributes)
        self.assertNotIn("xDensity", self.draw("demo", *SMALL).attributes)
        report = self.succeed_json("render", "demo", *SMALL, "--layers", "depth,attribute:b_factor", "-o", "b.EXR")
        self.assertEqual(report["settings"]["layers"], ["depth", "attribute:b_factor"])
        self.assertEqual(report["rays"], {"primary": 2400, "all": 2400})

    def test_what_is_refused(self):
        for layers in ["colour", "radiance,", "attribute:", "Depth"]:
            said = self.fail_usage("render", "demo", "-o", "a.exr", "--layers=" + layers)
            self.assertIn("radiance, albedo, depth, normal, id, and attribute:NAME", said)
        for words, expected in [
            (["--layers", "id,id"], "the layer id stands twice"),
            (["--layers", "attribute:charge"], 'there is no attribute "charge"'),
            (["--layers", "attribute:chain"], "holds texts"),
            (["--bits", "16"], "--bits is for PNG"),
            (["--view", "normal"], "--layers normal"),
            (["--legend"], "labels"),
            (["--title", "T"], "labels"),
        ]:
            self.assertIn(expected, self.fail_usage("render", "demo", *SMALL, "-o", "a.exr", *words))
        self.assertIn(".exr", self.fail_usage("render", "demo", *SMALL, "-o", "a.png", "--layers", "id"))
        self.assertIn(".exr", self.fail_usage("render", "demo", *SMALL, "-o", "-", "--layers", "id"))

    def test_a_fault_leaves_no_file(self):
        os.symlink("/dev/full", self.path("full.exr"))
        self.assertIn("pipe or a device", self.fail_input("render", "demo", *SMALL, "-o", "full.exr"))


if __name__ == "__main__":
    main()
