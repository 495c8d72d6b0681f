"""Arrows, tubes and colours by values on spheres in memory: of attributes, and of arrays."""

import copy
import pickle
import shutil

import bihive as bh
import numpy as np
from program import ProgramTest, main

OPTIONS = {"size": (64, 48), "samples": 1, "threads": 1}
XYZ = np.array([[0, 0, 0], [2, 0, 0], [4, 1, 0], [6, 0, 0]], dtype=np.float64)
VECTORS = np.array([[0, 2, 0], [1, 1, 0], [2, 0, -1], [0, 0, 0]], dtype=np.float32)
RADII = np.array([0.1, 0.4, 0.2, 0.3])


class Arrows(ProgramTest):
    def setUp(self):
        super().setUp()
        columns = {"vx": VECTORS[:, 0], "vy": VECTORS[:, 1], "vz": VECTORS[:, 2], "mol": [1, 1, 1, 1], "thick": RADII}
        self.spheres = bh.Spheres(XYZ, radius=0.5, columns=columns)
        self.bare = bh.Spheres(XYZ, radius=0.5, columns={"mol": [1, 1, 1, 1]})

    def test_of_attributes_are_those_of_the_program(self):
        self.spheres.save(self.path("v.csv"))
        for options in ({"arrows": "vx,vy,vz", "arrow_colour": "vx:magma", "arrow_scale": 1.5}, {"trace": "mol", "trace_radius": "thick"}):
            words = [word for name, value in options.items() for word in ("--" + name.replace("_", "-"), str(value))]
            drawn = self.succeed_json("render", "v.csv", "-o", "a.png", "--size", "64x48", "--samples", "1", *words)["picture_hash"]
            drawn = int(drawn, 16)
            self.assertEqual(bh.render(self.spheres, **options, **OPTIONS).hash, drawn)
            self.assertEqual(bh.render(self.path("v.csv"), **options, **OPTIONS).hash, drawn)
            self.assertNotEqual(bh.render(self.spheres, **OPTIONS).hash, drawn)

    def test_of_arrays_are_those_of_attributes(self):
        drawn = bh.render(self.spheres, arrows="vx,vy,vz", **OPTIONS).hash
        for vectors in (VECTORS, VECTORS.tolist(), np.asfortranarray(VECTORS, dtype=np.float64)):
            self.assertEqual(bh.render(self.bare, arrows=vectors, **OPTIONS).hash, drawn)
        taken = self.bare.with_columns({"arrow_x": [9, 9, 9, 9]})
        self.assertEqual(bh.render(taken, arrows=VECTORS, **OPTIONS).hash, drawn)
        self.assertEqual(bh.render(self.spheres, arrows=("vx", "vy", "vz"), **OPTIONS).hash, drawn)
        tubes = bh.render(self.spheres, trace="mol", trace_radius="thick", **OPTIONS).hash
        self.assertEqual(bh.render(self.bare, trace="mol", trace_radius=RADII, **OPTIONS).hash, tubes)
        self.assertNotEqual(bh.render(self.bare, trace="mol", trace_radius=0.1, **OPTIONS).hash, tubes)
        self.assertEqual(self.bare.columns, ["mol"])

    def test_arrays_that_are_refused(self):
        for options in ({"arrows": VECTORS[:3]}, {"arrows": VECTORS[:, :2]}, {"arrows": RADII}, {"trace_radius": VECTORS, "trace": "mol"}):
            with self.subTest(options), self.assertRaisesRegex(bh.UsageError, next(iter(options)) + ".*shape"):
                bh.render(self.bare, **options, **OPTIONS)
        with self.assertRaisesRegex(bh.UsageError, "trace_radius"):
            bh.render(self.bare, trace="mol", trace_radius=-RADII, **OPTIONS)
        for draw in (lambda: bh.render("demo", arrows=VECTORS, **OPTIONS),
                     lambda: bh.film("demo", self.path("a.mp4"), turntable=90, arrows=VECTORS, **OPTIONS)):
            with self.assertRaisesRegex(bh.UsageError, "arrows.*spheres in memory"):
                draw()

    def test_colours_by_arrays_are_those_of_attributes(self):
        kinds = np.array(["a", "b", "a", "c"])
        spheres = self.bare.with_columns({"thick": RADII, "kind": kinds, "values": [7, 7, 7, 7]})
        for text, given in {
            "thick": RADII, "thick:magma": (RADII, "magma"), "thick:viridis:0.2,1:log": (RADII.tolist(), "viridis:0.2,1:log"),
            "kind": kinds, "kind:okabe-ito": (kinds, "okabe-ito")}.items():
            drawn = bh.render(spheres, colour_by=text, **OPTIONS).hash
            self.assertEqual(bh.render(self.bare, colour_by=given, **OPTIONS).hash, drawn, text)
            self.assertEqual(bh.render(spheres, colour_by=given, **OPTIONS).hash, drawn, "the name is taken")
            half = bh.render(spheres, looks=bh.Look("x > 3", colour_by=text), **OPTIONS).hash
            self.assertNotEqual(half, drawn)
            self.assertEqual(bh.render(self.bare, looks=bh.Look("x > 3", colour_by=given), **OPTIONS).hash, half, text)
        look = bh.Look([True, False, False, True], colour_by=(RADII, "magma"))
        self.assertEqual(look, pickle.loads(pickle.dumps(look)))
        self.assertEqual(hash(look), hash(copy.deepcopy(look)))
        self.assertNotEqual(look, bh.Look([True, False, False, True], colour_by=RADII))
        self.assertEqual(bh.render(self.bare, looks=look, **OPTIONS).hash, bh.render(spheres, looks=bh.Look([0, 3], colour_by="thick:magma"), **OPTIONS).hash)

    def test_colours_that_are_refused(self):
        for given in (RADII[:3], VECTORS, (RADII, ""), (VECTORS, "magma"), [1, 2, 3, "x", None]):
            with self.subTest(given), self.assertRaisesRegex(bh.UsageError, "colour_by"):
                bh.render(self.bare, colour_by=given, **OPTIONS)
            with self.subTest(given), self.assertRaisesRegex(bh.UsageError, "colour_by"):
                bh.render(self.bare, looks=bh.Look(colour_by=given), **OPTIONS)
        for draw in (lambda: bh.render("demo", colour_by=RADII, **OPTIONS), lambda: bh.render("demo", looks=bh.Look(colour_by=RADII), **OPTIONS),
                     lambda: bh.save_page(self.bare, self.path("a.html"), colour_by=RADII)):
            with self.assertRaisesRegex(bh.UsageError, "colour_by.*spheres in memory"):
                draw()
        with self.assertRaisesRegex(bh.UsageError, "colour_by"):
            bh.Look(colour_by=RADII).words(4)

    def test_films_of_frames_in_memory(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("needs ffmpeg")
        frames = [self.bare, self.bare.moved(XYZ + 0.1)]
        self.assertEqual(bh.film(frames, self.path("a.mp4"), arrows=VECTORS, **OPTIONS), 2)


if __name__ == "__main__":
    main()
