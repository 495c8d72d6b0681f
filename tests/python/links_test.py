"""Links between pairs of spheres: of a file, and of arrays."""

import shutil

import bihive as bh
import numpy as np
from program import ProgramTest, main

OPTIONS = {"size": (64, 48), "samples": 1, "threads": 1}
XYZ = np.array([[0, 0, 0], [1.5, 0, 0], [3.2, 1, 0], [5, 0, 0]], dtype=np.float64)
PAIRS = np.array([[0, 1], [1, 2], [0, 3]])
FORCE = np.array([1, 3, 0.5])


class Links(ProgramTest):
    def setUp(self):
        super().setUp()
        self.spheres = bh.Spheres(XYZ, radius=[1, 1, 1.2, 1])
        self.write("l.csv", "first,second,force\n0,1,1\n1,2,3\n0,3,0.5\n")

    def drawn(self, links, spheres=None, **options):
        return bh.render(self.spheres if spheres is None else spheres, links=links, looks=bh.Look(radius_scale=0.4), **options, **OPTIONS).hash

    def test_of_arrays_are_those_of_a_file(self):
        file, columns = self.path("l.csv"), {"first": PAIRS[:, 0], "second": PAIRS[:, 1], "force": FORCE}
        for options in ({}, {"link_radius": 0.2}, {"link_radius": "force:0.1", "link_colour": "force:magma"}):
            self.assertEqual(self.drawn(columns, **options), self.drawn(file, **options), options)
            self.assertNotEqual(self.drawn(file, **options), self.drawn(None))
        for pairs in (PAIRS, PAIRS.tolist(), PAIRS.astype(np.int32), np.asfortranarray(PAIRS)):
            self.assertEqual(self.drawn(pairs), self.drawn(file))
        self.spheres.save(self.path("s.csv"))
        self.assertEqual(self.drawn(PAIRS, self.path("s.csv")), self.drawn(file, self.path("s.csv")))

    def test_of_contacts_and_pairs(self):
        near = bh.contacts(self.spheres)
        self.assertEqual(self.drawn(near), self.drawn({"first": near.first, "second": near.second}))
        self.assertNotEqual(self.drawn(near, link_radius="area:0.05"), self.drawn(near))
        pairs = bh.Tree(self.spheres).pairs(0.5)
        self.assertEqual(self.drawn(pairs), self.drawn(np.stack([pairs.first, pairs.second], axis=1)))
        cell = bh.Spheres(XYZ, radius=1, cell=np.eye(3) * 6)
        across = bh.contacts(cell, periodic=True)
        self.assertTrue(across.image.any())
        self.assertEqual(self.drawn(across, cell), self.drawn({"first": across.first, "second": across.second}, cell))

    def test_what_is_refused(self):
        for links in (PAIRS.astype(float) + 0.5, PAIRS[:, :1], PAIRS[0], -PAIRS, {"first": [0]}, {"first": [0], "second": [1, 2]}, {"first": [0], "second": [1], "a,b": [1]},
                      {"first": [0], "second": [1], "image": [0, 0, 0]}, 7, {0: 1}):
            with self.subTest(links), self.assertRaisesRegex(bh.UsageError, "links"):
                self.drawn(links)
        with self.assertRaisesRegex(bh.UsageError, "links: row 0 names sphere 9"):
            self.drawn([[0, 9]])
        with self.assertRaisesRegex(bh.UsageError, "links"):
            bh.save_page(self.spheres, self.path("a.html"), links=PAIRS)
        with self.assertRaisesRegex(FileNotFoundError, "none.csv"):
            self.drawn(self.path("none.csv"))

    def test_films_of_frames_in_memory(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("needs ffmpeg")
        frames = [self.spheres, self.spheres.moved(XYZ + 0.1)]
        self.assertEqual(bh.film(frames, self.path("a.mp4"), links=PAIRS, **OPTIONS), 2)


if __name__ == "__main__":
    main()
