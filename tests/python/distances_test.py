"""distance(), angle() and dihedral(): beside NumPy, through a periodic cell, and what they refuse."""

import math
import unittest

import bihive as bh
import numpy as np


class Distances(unittest.TestCase):
    def setUp(self):
        self.xyz = np.random.default_rng(1).uniform(0, 10, (50, 3))
        self.s = bh.Spheres(self.xyz, radius=0.5)

    def test_many_and_one(self):
        pairs = np.random.default_rng(2).integers(0, 50, (30, 2))
        expected = np.linalg.norm(self.xyz[pairs[:, 0]] - self.xyz[pairs[:, 1]], axis=1)
        np.testing.assert_allclose(bh.distance(self.s, pairs), expected, atol=1e-5)
        self.assertEqual(bh.distance(self.s, pairs[3]), bh.distance(self.s, pairs)[3])
        self.assertIsInstance(bh.distance(self.s, (0, 1)), float)
        self.assertEqual(bh.distance(self.s, np.empty((0, 2), int)).shape, (0,))

    def test_angles(self):
        s = bh.Spheres([(1, 0, 0), (0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 0)], radius=1)
        self.assertAlmostEqual(bh.angle(s, (0, 1, 2)), 90)
        self.assertAlmostEqual(abs(bh.dihedral(s, (0, 1, 2, 3))), 90)
        self.assertAlmostEqual(bh.dihedral(s, (0, 1, 2, 3)), -bh.dihedral(bh.Spheres(s.xyz * (1, 1, -1), radius=1), (0, 1, 2, 3)))
        self.assertTrue(math.isnan(bh.angle(s, (1, 4, 2))))

    def test_images(self):
        s = bh.Spheres([(0.5, 5, 5), (9.5, 5, 5), (0.5, 5, 9.8)], radius=0.1, cell=np.diag([10.0, 10, 10]))
        self.assertAlmostEqual(bh.distance(s, (0, 1)), 1, places=5)
        self.assertAlmostEqual(bh.distance(s, (0, 1), periodic=False), 9, places=5)
        self.assertAlmostEqual(bh.angle(s, (1, 0, 2)), 90, places=4)

    def test_what_is_refused(self):
        for rows in [(0, 50), (-1, 2), (0, 1, 2), [[0, 1], [2, 60]], (0.5, 1), [True, False], 3]:
            with self.assertRaises(bh.UsageError):
                bh.distance(self.s, rows)
        with self.assertRaisesRegex(bh.UsageError, "spheres"):
            bh.distance(self.xyz, (0, 1))


if __name__ == "__main__":
    unittest.main()
