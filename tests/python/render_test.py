"""bihive.render: the bits of the command line, layers, errors, Ctrl-C, threads."""

import copy
import errno
import os
import pickle
import resource
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import bihive as bh
import numpy as np
from exr_file import ExrFile
from program import PATIENCE_S, ProgramTest, main, png_numbers

SIZE = (48, 36)


def pixels_of_file(data):
    return np.array(png_numbers(data))


class SameBits(ProgramTest):
    """Each picture beside that of the command line with the same options."""

    def assert_same(self, input_name, words, spheres=None, **options):
        report = self.succeed_json("render", input_name, "-o", "a.png", "--size", "48x36", *words)
        picture = bh.render(self.path(input_name) if spheres is None else spheres, size=SIZE, **options)
        self.assertEqual(f"{picture.hash:016x}", report["picture_hash"], options)
        np.testing.assert_array_equal(np.asarray(picture), pixels_of_file(self.read("a.png")))
        return picture

    def test_the_options_of_the_command_line(self):
        for words, options in [
            ([], {}),
            (["--style", "illustrative"], {"style": "illustrative"}),
            (["--view-from", "left", "--projection", "orthographic"], {"camera": bh.Orthographic("left")}),
            (["--view-from", "top"], {"camera": "top"}),
            (["--view-from", "principal", "--zoom-to", "resname 478"], {"camera": bh.Perspective("principal", zoom_to="resname 478")}),
            (["--view-from", "best:resname 478", "--fit", "chain A"], {"camera": "best:resname 478", "fit": "chain A"}),
            (["--look-at", "resname 478"], {"look_at": "resname 478"}),
            (
                ["--eye", "-40,5,60", "--look-at=0,1,-2.5", "--up", "0,0,1", "--fov", "25"],
                {"camera": bh.Perspective(eye=(-40, 5, 60), look_at=np.array([0, 1, -2.5]), up=[0, 0, 1], fov=25)},
            ),
            (["--turn", "30,-20", "--zoom", "1.5"], {"turn": (30, -20), "zoom": np.float32(1.5)}),
            (["--aperture", "2", "--focus", "resname 478", "--samples", "8"], {"aperture": 2, "focus": "resname 478", "samples": 8}),
            (["--no-shadows", "--recursion", "2", "--samples", "auto"], {"shadows": False, "recursion": 2, "samples": "auto"}),
            (["--ao-distance", "5", "--ao-directions", "8"], {"ao_distance": 5, "ao_directions": 8}),
            (["--light", "studio", "--fog", "0.3", "--outline", "2"], {"light": "studio", "fog": 0.3, "outline": 2}),
            (["--light", "at:9,9,50", "--light", "from:1,1,1:red"], {"light": ["at:9,9,50", "from:1,1,1:red"]}),
            (["--background", "none"], {"background": "none"}),
            (["--bits", "16", "--background", "0.1,0.2,0.3"], {"bits": 16, "background": bh.linear((0.1, 0.2, 0.3))}),
            (["--crop", "8,4,40,30"], {"crop": (8, 4, 40, 30)}),
            (["--view", "normal"], {"view": "normal"}),
            (["--view", "traversal", "--max-prims", "1"], {"view": "traversal", "max_prims": 1}),
            (["--view", "tree"], {"view": "tree"}),
            (["--engine", "reference", "--threads", "1"], {"engine": "reference", "threads": 1}),
            (["--legend", "--axes", "--title", "Häuser {spheres}"], {"legend": True, "axes": True, "title": "Häuser {spheres}"}),
            (["--colour-by", "b_factor:magma", "--legend"], {"colour_by": "b_factor:magma", "legend": True}),
            (["--opacity", "0.4", "--no-water"], {"opacity": 0.4, "no_water": True}),
            (["--clip", "plane:1,0,0,2", "--clip", "sphere:0,0,0,4"], {"clip": ["plane:1,0,0,2", "sphere:0,0,0,4"]}),
            (
                ["--select", "chain A", "--colour", "red", "--material", "metal", "--select", "water", "--hide"],
                {"looks": [bh.Look("chain A", colour="red", material="metal"), bh.Look("water", show=False)]},
            ),
            (["--select", "not (chain B)", "--hide"], {"select": "chain B"}),
            (["--exposure", "0.5", "--tone", "filmic", "--transfer", "none"], {"exposure": 0.5, "tone": "filmic", "transfer": "none"}),
        ]:
            with self.subTest(options=options):
                report = self.succeed_json("render", "demo", "-o", "a.png", "--size", "48x36", *words)
                picture = bh.render("demo", size=SIZE, **options)
                self.assertEqual(f"{picture.hash:016x}", report["picture_hash"])
                np.testing.assert_array_equal(np.asarray(picture), pixels_of_file(self.read("a.png")))
                # Spheres that were read first are the same spheres.
                read_first = bh.render(bh.read("demo"), size=SIZE, **options)
                self.assertEqual(read_first, picture)

    def test_arrays_as_a_file_of_them(self):
        rng = np.random.default_rng(3)
        four = rng.random((200, 4)).astype(np.float32)
        np.save(self.path("a.npy"), four)
        self.assert_same("a.npy", [], bh.Spheres(four))
        self.assert_same("a.npy", [], bh.Spheres(four[:, :3].astype(float), four[:, 3]))
        self.assert_same("a.npy", ["--colour-by", "r:coolwarm"], bh.Spheres(four), colour_by="r:coolwarm")
        self.assert_same("a.npy", ["--radius", "0.05"], radius=0.05)

    def test_copies_read_as_spheres_of_their_own(self):
        self.write("cell.extxyz", '2\nLattice="2 0 0 0 3 0 0 0 4" Properties=species:S:1:pos:R:3:q:R:1\nC 0 0 0 1.5\nO 1 1 1 -1\n')
        s = bh.read(self.path("cell.extxyz"), replicate=(2, 3, 1))
        self.assert_same("cell.extxyz", ["--replicate", "2x3x1"], s)
        self.assertEqual(len(s), 12)
        shifts = [[2 * i, 3 * j, 0] for i in range(2) for j in range(3)]
        expected = {tuple(np.add(shift, at)) for shift in shifts for at in ([0, 0, 0], [1, 1, 1])}
        self.assertEqual({tuple(at) for at in s.xyz.tolist()}, expected)
        self.assertEqual(s.xyz[:2].tolist(), [[0, 0, 0], [1, 1, 1]])
        self.assertEqual(s["q"].tolist(), [1.5, -1] * 6)
        self.assertEqual(s.elements.tolist(), ["C", "O"] * 6)
        self.assertEqual(s.cell.tolist(), [[4, 0, 0], [0, 9, 0], [0, 0, 4], [0, 0, 0]])
        # They are an infinite crystal, as the two alone are.
        one = bh.read(self.path("cell.extxyz"))
        for points, radius in [(s.xyz, 3.5), ([[0.3, 0.2, 0.1]], 9.0)]:
            small, large = (bh.Tree(some).within(points, radius, to="centre") for some in (one, s))
            self.assertEqual(small.counts.tolist(), large.counts.tolist())
            np.testing.assert_allclose(np.sort(small.distance), np.sort(large.distance), rtol=1e-6)
        self.assertEqual(pickle.loads(pickle.dumps(s)), s)
        self.assertEqual(len(s[bh.select(s, "element C and x < 1")]), 3)
        with self.assertRaises(bh.Error) as caught:
            bh.read(self.path("cell.extxyz"), replicate=(10000, 10000, 100))
        self.assertIn("memory", str(caught.exception))
        self.write("no_cell.xyz", "1\n\nC 0 0 0\n")
        with self.assertRaises(bh.InputError):
            bh.read(self.path("no_cell.xyz"), replicate=(2, 1, 1))

    def test_scenes_and_cells(self):
        self.succeed("scene", "four-spheres", "-o", "four.json")
        self.assert_same("four.json", ["--recursion", "3"], recursion=3)
        report = self.succeed_json("render", "scenario2", "-o", "a.png", "--size", "48x36", "--count", "300", "--seed", "5")
        self.assertEqual(f"{bh.render('scenario2', size=SIZE, count=300, seed=5).hash:016x}", report["picture_hash"])
        self.write("cell.extxyz", '2\nLattice="2 0 0 0 3 0 0 0 4" Properties=species:S:1:pos:R:3\nC 0 0 0\nO 1 1 1\n')
        s = bh.read(self.path("cell.extxyz"))
        self.assert_same("cell.extxyz", ["--replicate", "2x3x1", "--cell"], s, replicate=(2, 3, 1), cell=True)

    def test_columns_and_parts_of_files(self):
        self.write("table.csv", "px,py,pz,size,mass\n0,0,0,1,2\n3,0,0,2,4\n0,4,1,1,6\n")
        columns = {"x": "px", "y": "py", "z": "pz", "r": "size"}
        self.assert_same("table.csv", ["--columns", "x=px,y=py,z=pz,r=size"], columns=columns)
        s = bh.read(self.path("table.csv"), columns={"x": 1, "y": 2, "z": 3, "r": 4})
        self.assertEqual((s.xyz.tolist(), s.radius.tolist()), ([[0, 0, 0], [3, 0, 0], [0, 4, 1]], [1, 2, 1]))
        with self.assertRaises(bh.Error):
            bh.read(self.path("table.csv"), columns={"x": "absent"})
        with self.assertRaises(bh.FileError):
            bh.read(self.path("absent.h5") + ":/points")

    def test_styles_of_ones_own(self):
        keys = {"material": "metal", "background": "black", "picture": {"shadows": False}}
        self.write("own.json", '{"bihive_style": 1, "material": "metal", "background": "black", "picture": {"shadows": false}}')
        report = self.succeed_json("render", "demo", "-o", "a.png", "--size", "48x36", "--style", "own.json")
        for style in [keys, bh.Style(keys), pickle.loads(pickle.dumps(bh.Style(keys))), self.path("own.json")]:
            self.assertEqual(f"{bh.render('demo', size=SIZE, style=style).hash:016x}", report["picture_hash"])
        with self.assertRaisesRegex(bh.InputError, "unknown key"):
            bh.render("demo", size=SIZE, style={"materiel": "metal"})

    def test_a_saved_picture_is_the_programs_file(self):
        self.succeed("render", "demo", "-o", "a.png", "--size", "48x36", "--dpi", "300", "--title", "Ä")
        picture = bh.render("demo", size=SIZE, dpi=300, title="Ä")
        picture.save(self.path("b.png"))
        self.assertEqual(self.read("b.png"), self.read("a.png"))
        self.assertEqual(picture._repr_png_(), self.read("a.png"))

    def test_any_number_of_threads(self):
        one = bh.render("demo", size=SIZE, threads=1)
        self.assertEqual(one, bh.render("demo", size=SIZE, threads=7))


class ArraysOfLooks(ProgramTest):
    """A row for each sphere: the pictures are those of looks for one sphere each, and of sets with these values."""

    def setUp(self):
        super().setUp()
        rng = np.random.default_rng(8)
        self.n = 20
        self.xyz = rng.random((self.n, 3)) * 4
        self.colours = rng.random((self.n, 3))
        self.opacity = np.round(rng.random(self.n), 3)
        self.radius = 0.1 + 0.5 * rng.random(self.n)
        self.spheres = bh.Spheres(self.xyz, radius=0.4)
        self.some = np.arange(self.n) % 3 > 0

    def picture(self, spheres=None, **options):
        return bh.render(self.spheres if spheres is None else spheres, size=SIZE, samples=1, camera=bh.Perspective(eye=(2, 2, 12), look_at=(2, 2, 2)), **options)

    def test_they_are_looks_of_single_spheres(self):
        for transfer in ("srgb", "none"):
            for name, values in [("colour", self.colours), ("opacity", self.opacity)]:
                single = [bh.Look([i], **{name: values[i]}) for i in np.flatnonzero(self.some)]
                self.assertEqual(
                    self.picture(looks=bh.Look(self.some, **{name: values}), transfer=transfer), self.picture(looks=single, transfer=transfer)
                )
                single = [bh.Look([i], **{name: values[i]}) for i in range(self.n)]
                self.assertEqual(self.picture(**{name: values}, transfer=transfer), self.picture(looks=single, transfer=transfer))
        self.assertNotEqual(self.picture(colour=self.colours), self.picture())

    def test_they_are_values_of_sets(self):
        self.assertEqual(self.picture(opacity=self.opacity), self.picture(bh.Spheres(self.xyz, radius=0.4, opacity=self.opacity)))
        radius = np.where(self.some, self.radius, 0.4)
        self.assertEqual(self.picture(looks=bh.Look(self.some, radius=self.radius)), self.picture(bh.Spheres(self.xyz, radius=radius)))
        self.assertEqual(
            self.picture(looks=bh.Look(radius=self.radius, radius_scale=0.5)), self.picture(bh.Spheres(self.xyz, radius=0.5 * self.radius))
        )
        self.assertEqual(
            self.picture(looks=[bh.Look(radius_scale=3), bh.Look(radius=self.radius)]), self.picture(bh.Spheres(self.xyz, radius=self.radius))
        )
        light = bh.Spheres(self.xyz, radius=0.4, colour=bh.linear(self.colours))
        self.assertEqual(self.picture(colour=bh.linear(self.colours)), self.picture(light))
        names = ["orange" if one else "blue" for one in self.some]
        self.assertEqual(self.picture(colour=names), self.picture(looks=[bh.Look(colour="blue"), bh.Look(self.some, colour="orange")]))
        eight = (255 * self.colours).astype(np.uint8)
        self.assertEqual(self.picture(colour=eight), self.picture(colour=eight / 255))

    def test_later_looks_replace_earlier_ones(self):
        array, one = bh.Look(colour=self.colours), bh.Look([3], colour="red")
        changed = self.colours.copy()
        changed[3] = 1, 0, 0
        self.assertEqual(self.picture(looks=[array, one]), self.picture(colour=changed))
        self.assertEqual(self.picture(looks=[one, array]), self.picture(colour=self.colours))
        self.assertEqual(self.picture(colour=self.colours, looks=one), self.picture(colour=changed))
        self.assertEqual(self.picture(looks=[bh.Look([0], show=False), array]), self.picture(looks=[array, bh.Look([0], show=False)]))
        self.assertEqual(self.picture(colour=self.colours, select=self.some), self.picture(self.spheres[self.some], colour=self.colours[self.some]))

    def test_they_can_be_compared_and_pickled_and_do_not_change_with_their_arrays(self):
        values = self.opacity.copy()
        look = bh.Look(opacity=values, colour=self.colours)
        self.assertEqual(pickle.loads(pickle.dumps(look)), look)
        self.assertEqual(look, bh.Look(opacity=self.opacity, colour=self.colours))
        self.assertEqual(hash(look), hash(pickle.loads(pickle.dumps(look))))
        self.assertNotEqual(look, bh.Look(opacity=self.opacity[::-1], colour=self.colours))
        np.testing.assert_array_equal(np.asarray(look.opacity), self.opacity)
        values[:] = 0
        np.testing.assert_array_equal(np.asarray(look.opacity), self.opacity)

    def test_the_report_says_that_there_was_an_array(self):
        said = self.picture(looks=bh.Look(self.some, colour=self.colours, opacity=self.opacity, radius=self.radius)).report["settings"]["looks"]
        self.assertIn("--colour (array)", said)
        self.assertIn("--opacity (array)", said)
        self.assertIn("radius (array)", said)

    def test_what_does_not_fit_is_refused(self):
        for make, argument in [
            (lambda: self.picture(colour=self.colours[:5]), "colour"),
            (lambda: self.picture(looks=bh.Look(opacity=self.opacity[:5])), "opacity"),
            (lambda: self.picture(looks=bh.Look(radius=self.radius[:5])), "radius"),
            (lambda: bh.Look(colour=np.zeros((4, 4))), "colour"),
            (lambda: bh.Look(colour=2 * np.ones((4, 3))), "colour"),
            (lambda: bh.Look(opacity=[0.5, 1.5]), "opacity"),
            (lambda: bh.Look(opacity=[[0.5]]), "opacity"),
            (lambda: bh.Look(radius=[1, -1]), "radius"),
            (lambda: bh.Look(radius=[1, np.nan]), "radius"),
            (lambda: bh.Look(radius=2), "radius"),
            (lambda: bh.render("demo", size=SIZE, colour=np.zeros((1631, 3))), "colour"),
        ]:
            with self.assertRaises(bh.UsageError) as caught:
                make()
            self.assertEqual(caught.exception.argument, argument)
        with self.assertRaises(bh.UsageError) as caught:
            bh.render("demo", size=SIZE, looks=bh.Look(opacity=np.ones(1631)))
        self.assertIn("bihive.read(path)", str(caught.exception))
        # No file has the arrays, so no figure can be drawn again.
        self.picture(colour=self.colours).save(self.path("a.png"))
        with self.assertRaises(bh.Error) as caught:
            bh.again(self.path("a.png"))
        self.assertTrue(str(caught.exception))


class Pictures(ProgramTest):
    def test_array(self):
        picture = bh.render("demo", size=SIZE)
        self.assertEqual((picture.size, np.asarray(picture).shape, np.asarray(picture).dtype), (SIZE, (36, 48, 3), np.uint8))
        self.assertEqual(np.asarray(picture, dtype=float).dtype, float)
        with self.assertRaises(ValueError):
            np.asarray(picture)[0, 0, 0] = 1
        deep = np.asarray(bh.render("demo", size=SIZE, bits=16, background="none"))
        self.assertEqual((deep.shape, deep.dtype), ((36, 48, 4), np.uint16))
        self.assertTrue(deep.dtype.isnative)

    def test_layers(self):
        s = bh.Spheres([[0, 0, 0], [0.5, 0, -3]], radius=1, columns={"charge": [-0.5, 7]})
        picture = bh.render(s, camera=bh.Orthographic(eye=(0, 0, 10), look_at=(0, 0, 0)), size=(21, 15))
        ids, depth, normal = picture.layer("id"), picture.layer("depth"), picture.layer("normal")
        self.assertEqual((ids.dtype, ids.shape, normal.shape), (np.int64, (15, 21), (15, 21, 3)))
        self.assertEqual(set(np.unique(ids)), {-1, 0, 1})
        self.assertEqual(ids[7, 10], 0)
        self.assertAlmostEqual(float(depth[7, 10]), 9, places=5)
        np.testing.assert_array_equal(depth[ids == -1], np.inf)
        np.testing.assert_allclose(np.linalg.norm(normal[ids >= 0], axis=1), 1, atol=1e-6)
        charge = picture.layer("attribute:charge")
        np.testing.assert_array_equal(charge[ids == 1], 7)
        self.assertTrue(np.isnan(charge[ids == -1]).all())
        self.assertEqual(picture.layer("radiance").shape, (15, 21, 3))
        for bad in ["colour", "attribute:mass", "depth,id", ""]:
            with self.assertRaises(ValueError):
                picture.layer(bad)
        # A hidden sphere keeps the others' ids.
        self.assertEqual(set(np.unique(bh.render(s, size=(21, 15), select="charge > 0").layer("id"))), {-1, 1})
        with self.assertRaisesRegex(bh.UsageError, "detached"):
            picture.detach().layer("depth")

    def test_seen_as_in_another_picture(self):
        s = bh.read("demo")
        first = bh.render(s, size=SIZE, camera="left", colour_by="b_factor")
        part = s[: len(s) // 2]
        again = bh.render(part, size=SIZE, camera=first, colour_by="b_factor")
        self.assertEqual(again.camera, first.camera)
        self.assertNotEqual(bh.render(part, size=SIZE, camera="left").camera, first.camera)

    def test_pickle_and_repr(self):
        picture = bh.render("demo", size=SIZE, bits=16)
        same = pickle.loads(pickle.dumps(picture))
        self.assertEqual((same, same.hash, same._repr_png_()), (picture, picture.hash, picture._repr_png_()))
        self.assertEqual(repr(same), "<bihive.Picture: 48 x 36, 1631 spheres of demo>")
        with self.assertRaisesRegex(bh.UsageError, "unpickled"):
            same.layer("depth")
        with self.assertRaises(bh.UsageError) as caught:
            bh.render("demo", size=SIZE, camera=same)
        self.assertTrue(str(caught.exception).startswith("camera: "))
        for thing in [bh.Orthographic("left"), bh.Perspective(fov=20), bh.Look("water", show=False), bh.Style({"name": "x"})]:
            self.assertEqual(pickle.loads(pickle.dumps(thing)), thing)
            self.assertEqual(copy.deepcopy(thing), thing)

    def test_save(self):
        picture = bh.render("demo", size=SIZE)
        with self.assertRaises(OSError) as caught:
            picture.save(self.path("no/such/folder.png"))
        self.assertIsInstance(caught.exception, bh.Error)
        with self.assertRaises(bh.UsageError):
            picture.save(self.path("a.jpg"))
        self.assertEqual(self.contents(), {})

    def test_save_exr(self):
        picture = bh.render("demo", size=SIZE)
        try:
            picture.save(self.path("a.exr"), layers="radiance,depth,normal,id")
        except bh.MissingError as error:
            self.assertIn("no OpenEXR", str(error))
            return
        channels = {name: np.array(rows) for name, rows in ExrFile(self.read("a.exr")).channels.items()}
        np.testing.assert_array_equal(np.stack([channels[c] for c in "RGB"], axis=-1), picture.layer("radiance"))
        np.testing.assert_array_equal(channels["Z"], picture.layer("depth"))
        np.testing.assert_array_equal(channels["id"] < 2**31, picture.layer("id") >= 0)
        self.succeed("render", "demo", "-o", "b.exr", "--size", "48x36", "--layers", "radiance,depth,normal,id")
        stated = {name: np.array(rows) for name, rows in ExrFile(self.read("b.exr")).channels.items()}
        self.assertEqual(channels.keys(), stated.keys())
        for name in stated:
            np.testing.assert_array_equal(channels[name], stated[name], name)
        for layers, path in [("smell", "c.exr"), ("depth", "c.png"), (3, "c.exr")]:
            with self.assertRaisesRegex(bh.UsageError, "^layers: "):
                picture.save(self.path(path), layers=layers)
        with self.assertRaises(bh.FileError):
            picture.save(self.path("no/such/folder.exr"))
        with self.assertRaisesRegex(bh.UsageError, "detached"):
            picture.detach().save(self.path("c.exr"))
        self.assertEqual(set(self.contents()), {self.path("a.exr"), self.path("b.exr")})


class Failures(ProgramTest):
    def test_errors_name_the_argument(self):
        s = bh.Spheres(np.zeros((1, 3)), radius=1)
        for options, argument in [
            ({"size": (0, 10)}, "size"),
            ({"size": "big"}, "size"),
            ({"size": (10, float("nan"))}, "size"),
            ({"samples": 0}, "samples"),
            ({"samples": True}, "samples"),
            ({"recursion": 17}, "recursion"),
            ({"view": "nice"}, "view"),
            ({"view_from": "above"}, "view_from"),
            ({"camera": "above"}, "view_from"),
            ({"camera": 3}, "camera"),
            ({"camera": bh.Perspective(fov=200)}, "fov"),
            ({"eye": (0, 1)}, "eye"),
            ({"eye": "a\0b"}, "eye"),
            ({"shadows": 1}, "shadows"),
            ({"legend": "yes"}, "legend"),
            ({"style": "nice"}, "style"),
            ({"light": "nice"}, "light"),
            ({"background": "nice"}, "background"),
            ({"ao_distance": -1}, "ao_distance"),
            ({"looks": ["chain A"]}, "looks"),
            ({"looks": bh.Look("all", opacity=2)}, "opacity"),
            ({"looks": bh.Look("mass > 2", opacity=0.5)}, "select"),
            ({"select": "x >"}, "select"),
            ({"select": 3}, "select"),
            ({"progress": 3}, "progress"),
            ({"shininess": 3}, "shininess"),
            ({"json": True}, "json"),
            ({"frame": 1.5}, "frame"),
            ({"trajectory": "a.dcd"}, "trajectory"),
            ({"replicate": (2, 2, 2)}, "replicate"),
        ]:
            with self.subTest(options=options):
                with self.assertRaises(bh.UsageError) as caught:
                    bh.render(s, **options)
                self.assertEqual(caught.exception.argument, argument, caught.exception)
                self.assertNotIn("--", str(caught.exception))

    def test_things_that_are_no_spheres(self):
        for thing in [3, None, [1, 2], np.zeros((2, 3)), object()]:
            with self.assertRaises(bh.UsageError) as caught:
                bh.render(thing)
            self.assertEqual(caught.exception.argument, "spheres")

    def test_errors_of_files_are_those_of_the_system(self):
        """Each is a FileError with the errno, and the subclass of OSError that it has."""
        s = bh.Spheres([[0, 0, 0]], radius=1)
        picture = bh.render(s, size=(8, 6), samples=1)
        os.mkdir(self.path("folder"))
        missing, folder = self.path("no/such/file"), self.path("folder")
        for call, kind, code in [
            (lambda: bh.read(missing), FileNotFoundError, errno.ENOENT),
            (lambda: bh.render(missing), FileNotFoundError, errno.ENOENT),
            (lambda: bh.verify(missing), FileNotFoundError, errno.ENOENT),
            (lambda: bh.read(folder), IsADirectoryError, errno.EISDIR),
            (lambda: bh.colour_map([1, 2], missing), FileNotFoundError, errno.ENOENT),
            (lambda: bh.render(s, style=missing + ".json"), FileNotFoundError, errno.ENOENT),
            (lambda: s.save(missing + ".csv"), FileNotFoundError, errno.ENOENT),
            (lambda: s.save(folder, format="csv"), IsADirectoryError, errno.EISDIR),
            (lambda: picture.save(missing + ".png"), FileNotFoundError, errno.ENOENT),
            (lambda: picture.save(missing + ".tif"), FileNotFoundError, errno.ENOENT),
            (lambda: picture.save(missing + ".exr"), FileNotFoundError, errno.ENOENT),
        ]:
            with self.assertRaises(kind) as caught:
                call()
            self.assertIsInstance(caught.exception, bh.FileError)
            self.assertEqual(caught.exception.errno, code)
            self.assertTrue(caught.exception.filename.startswith(self.folder), caught.exception)
            again = pickle.loads(pickle.dumps(caught.exception))
            self.assertIsInstance(again, kind)
            self.assertEqual((str(again), again.argument), (str(caught.exception), caught.exception.argument))

    def test_files(self):
        with self.assertRaises(bh.FileError) as caught:
            bh.render(self.path("absent.pdb"))
        self.assertEqual((caught.exception.errno, caught.exception.filename), (2, self.path("absent.pdb")))
        self.assertIsInstance(caught.exception, OSError)
        self.write("bad.xyz", "2\n\nC 0 0 0\nC 0 zero 0\n")
        for call in [bh.render, bh.read]:
            with self.assertRaises(bh.InputError) as caught:
                call(self.path("bad.xyz"))
            self.assertEqual((caught.exception.file, caught.exception.line), (self.path("bad.xyz"), 4))
            self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaisesRegex(bh.UsageError, "zoom: there is no such option"):
            bh.read("demo", zoom=2)

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            bh.render("demo", size=SIZE, looks=bh.Look("index 99999", colour="red"))
        self.assertEqual([w.category for w in caught], [bh.InputWarning])
        self.assertRegex(str(caught[0].message), "selects no sphere")
        self.assertEqual(caught[0].filename, __file__)

    def test_the_rays_of_the_camera(self):
        s = bh.read("demo")
        tree = bh.Tree(s)
        for options in ({}, {"camera": bh.Orthographic("iso", zoom=1.3)}, {"crop": (5, 7, 30, 20)}, {"fit": "resname 478"}):
            picture = bh.render(s, size=SIZE, samples=1, **options)
            origins, directions = picture.rays()
            width, height = picture.size
            self.assertEqual(origins.shape, (height, width, 3))
            hits = tree.closest(origins, directions)
            np.testing.assert_array_equal(hits.id, picture.layer("id"))
            # Points of the surface are where the picture has them, at its depth.
            seen = hits.id >= 0
            where = picture.project(hits.positions()[seen])
            rows, columns = np.nonzero(seen)
            np.testing.assert_allclose(where[:, 0], columns + 0.5, atol=1e-3)
            np.testing.assert_allclose(where[:, 1], rows + 0.5, atol=1e-3)
            depth = picture.layer("depth")
            np.testing.assert_allclose(where[:, 2], depth[seen], rtol=1e-5)
            back = picture.unproject(columns + 0.5, rows + 0.5, depth[seen])
            np.testing.assert_allclose(back, hits.positions()[seen], atol=1e-3)
        picture = bh.render(s, size=SIZE, samples=1)
        self.assertEqual(picture.rays(1.5, [2, 3])[0].shape, (2, 3))
        eye = np.array(picture.camera["eye"])
        behind = picture.project(2 * eye - s.xyz.mean(axis=0))
        self.assertTrue(np.isnan(behind[:2]).all() and behind[2] < 0)
        # Far from 0 as well.
        far = bh.Spheres(s.xyz + [5e5, 5.4e6, 0], radius=s.radius)
        seen = bh.render(far, size=SIZE, samples=1)
        np.testing.assert_array_equal(bh.Tree(far).closest(*seen.rays()).id, seen.layer("id"))
        for call, argument in [
            (lambda: picture.rays(1), "y"),
            (lambda: picture.rays([1, 2], [1, 2, 3]), "y"),
            (lambda: picture.project([1, 2]), "points"),
            (lambda: picture.unproject([1, 2], 3, [1, 2, 3]), "depth"),
            (lambda: bh.render(s, size=SIZE, samples=1, stereo="side").rays(), "rays"),
            (lambda: pickle.loads(pickle.dumps(picture)).rays(), "rays"),
        ]:
            with self.assertRaisesRegex(bh.UsageError, argument + ": "):
                call()

    def test_masks_and_positions_as_selections(self):
        s = bh.read("demo")
        water = bh.select(s, "water")
        expected = bh.render(s, size=SIZE, samples=1, select="not water", looks=bh.Look("chain A", colour="red"))
        chain = bh.select(s, "chain A")
        for select, look in ((~water, chain), (np.flatnonzero(~water), np.flatnonzero(chain).tolist())):
            found = bh.render(s, size=SIZE, samples=1, select=select, looks=bh.Look(select=look, colour="red"))
            np.testing.assert_array_equal(np.asarray(found), np.asarray(expected))
        self.assertEqual(bh.Look([1, 2, 3], colour="red"), bh.Look(np.array([3, 2, 1]), colour="red"))
        for thing, select in ((s, water[1:]), (s, [len(s)]), (s, [-1]), (s, 0.5), ("demo", water)):
            with self.assertRaisesRegex(bh.UsageError, "select: "):
                bh.render(thing, size=SIZE, select=select)
        with self.assertRaisesRegex(bh.UsageError, "select: expected a mask of shape"):
            bh.render(s, size=SIZE, looks=bh.Look(water[1:], colour="red"))

    def test_an_unknown_instruction_set(self):
        done = subprocess.run(
            [sys.executable, "-c", "import bihive as bh\nbh.render('demo')"],
            env={**os.environ, "BIHIVE_TARGET": "no_such"}, capture_output=True, text=True, timeout=PATIENCE_S,
        )
        self.assertIn("InputError", done.stderr.splitlines()[-1])
        self.assertIn("no_such", done.stderr.splitlines()[-1])


LONG = "import bihive as bh, sys\nprint('ready', flush=True)\n"
LONG += "bh.render('scenario3', size=(4000, 4000), samples=64, shadows=True)\n"


class Interrupts(ProgramTest):
    def end_soon(self, process, worked_s):
        """What the process says when it has ended, which took little of the processors: a busy machine takes no more of
        them, and the rest of the work would take minutes."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        _, err = process.communicate(timeout=PATIENCE_S)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime - worked_s, 30)
        return err

    def test_control_c_ends_a_render(self):
        for begin_s in [0.3, 1.5]:
            process = subprocess.Popen(
                [sys.executable, "-c", LONG], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            )
            self.assertEqual(process.stdout.readline(), "ready\n")
            self.let_work(process, begin_s)
            self.assertIsNone(process.poll(), "the picture was drawn too early for this test")
            process.send_signal(signal.SIGINT)
            err = self.end_soon(process, begin_s)
            self.assertEqual(err.splitlines()[-1], "KeyboardInterrupt")
            self.assertEqual(process.returncode, -signal.SIGINT)

    def test_an_exception_of_a_handler_and_of_the_progress(self):
        class Enough(Exception):
            pass

        def enough(done):
            raise Enough(done)

        with self.assertRaises(Enough):
            bh.render("scenario3", size=(4000, 4000), samples=64, progress=enough)

        def handler(number, frame):
            raise Enough

        before = signal.signal(signal.SIGALRM, handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaises(Enough):
            bh.render("scenario3", size=(4000, 4000), samples=64)
        # The module works on.
        bh.render("demo", size=SIZE)

    def test_readings_and_buildings_report_and_end(self):
        rng = np.random.default_rng(2)
        xyz = rng.random((1_500_000, 3))
        with open(self.path("long.xyz"), "w") as file:
            file.write(f"{len(xyz)}\n\n")
            np.savetxt(file, xyz, fmt="C %.5f %.5f %.5f")
        path, s = self.path("long.xyz"), bh.Spheres(xyz, radius=0.001)
        tree = bh.Tree(s, threads=1)
        before = tree.nearest([0.5, 0.5, 0.5])

        class Enough(Exception):
            pass

        def enough(done):
            raise Enough(done)

        for work in [
            lambda progress: bh.read(path, progress=progress),
            lambda progress: bh.Tree(s, threads=1, progress=progress),
            lambda progress: bh.Tree(s, engine="reference", progress=progress),
            lambda progress: bh.measure(s, progress=progress),
            lambda progress: tree.update(xyz + 0.1, progress=progress),
        ]:
            with self.assertRaises(Enough):
                work(enough)
            self.assertEqual(tree.nearest([0.5, 0.5, 0.5]), before)
            shares = []
            work(shares.append)
            self.assertEqual((shares[-1], shares), (1, sorted(shares)))
            self.assertGreater(len(shares), 1)
        self.assertNotEqual(tree.nearest([0.5, 0.5, 0.5]), before)

        def handler(number, frame):
            raise Enough

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, handler))
        for work in (lambda: bh.read(path), lambda: bh.Tree(s, engine="reference"), lambda: bh.render(path, size=SIZE)):
            with self.assertRaises(Enough):
                signal.setitimer(signal.ITIMER_REAL, 0.01)  # each takes at least ten times as long
                work()

    def test_control_c_ends_rays(self):
        code = "import bihive as bh, numpy as np\nt = bh.Tree(bh.read('scenario1', count=4096), engine='brute')\n"
        code += "o = np.zeros((20_000_000, 3), np.float32)\nprint('ready', flush=True)\nt.closest(o, [0, 0, -1])\n"
        process = subprocess.Popen(
            [sys.executable, "-c", code], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.assertEqual(process.stdout.readline(), "ready\n")
        self.let_work(process, 1)
        process.send_signal(signal.SIGINT)
        err = self.end_soon(process, 1)
        self.assertEqual((err.splitlines()[-1], process.returncode), ("KeyboardInterrupt", -signal.SIGINT))

    def test_other_threads_run_meanwhile(self):
        counted = []
        over = threading.Event()

        def count():
            while not over.is_set():
                counted.append(time.monotonic())
                time.sleep(0.005)

        thread = threading.Thread(target=count)
        thread.start()
        begin = time.monotonic()
        bh.render("demo", size=(640, 480), samples=16, threads=1)
        end = time.monotonic()
        over.set()
        thread.join()
        during = [moment for moment in counted if begin < moment < end]
        # It would be none or two if the lock were kept.
        self.assertGreater(len(during), 5)

    def test_pictures_on_several_threads_at_once(self):
        expected = bh.render("demo", size=SIZE)
        made = []
        threads = [threading.Thread(target=lambda: made.append(bh.render("demo", size=SIZE))) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(made, [expected] * 6)

    def test_progress(self):
        shares = []
        bh.render("demo", size=(640, 480), samples=16, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(all(0 <= share <= 1 for share in shares))
        self.assertEqual(shares[-1], 1)
        for size in ((8, 6), (300, 200)):  # done before anybody looks, and in between
            shares = []
            bh.render("demo", size=size, samples=1, progress=shares.append)
            self.assertEqual((shares, shares[-1]), (sorted(shares), 1))
        with self.assertRaises(ZeroDivisionError):
            bh.render("demo", size=(8, 6), samples=1, progress=lambda share: 1 / 0)


if __name__ == "__main__":
    main()
