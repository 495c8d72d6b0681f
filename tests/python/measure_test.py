"""Porosity and solvent-accessible surface from queries about points, beside the closed forms of two overlapping spheres."""

import math
import unittest

import bihive as bh
import numpy as np


def ball_points(count):
    """Points of equal area on the unit sphere (Fibonacci's lattice)."""
    k = np.arange(count) + 0.5
    z = 1 - 2 * k / count
    turn = math.pi * (1 + math.sqrt(5)) * k
    flat = np.sqrt(1 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)


def grid(low, high, count):
    """The centres of count^3 equal cells of a box."""
    axes = [a + (b - a) * (np.arange(count) + 0.5) / count for a, b in zip(low, high)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def cap_height(r, other, d):
    """How deep the sphere of radius r reaches beyond the plane in which it meets the other, at the distance d."""
    return r - (d * d + r * r - other * other) / (2 * d)


def union_volume(r, q, d):
    caps = sum(math.pi * h * h * (3 * a - h) / 3 for a, h in ((r, cap_height(r, q, d)), (q, cap_height(q, r, d))))
    return 4 / 3 * math.pi * (r**3 + q**3) - caps


def union_area(r, q, d):
    return sum(4 * math.pi * a * a - 2 * math.pi * a * h for a, h in ((r, cap_height(r, q, d)), (q, cap_height(q, r, d))))


def porosity(spheres, low, high, count):
    """The part of a box that no sphere fills."""
    return float((bh.Tree(spheres).contains(grid(low, high, count)).counts == 0).mean())


def accessible_area(spheres, probe, count):
    """The area that the centre of a ball of radius probe reaches (Shrake and Rupley, 1973), of each sphere."""
    grown = spheres.radius.astype(float) + probe
    tree = bh.Tree(bh.Spheres(spheres.xyz, radius=grown))
    area = np.empty(len(spheres))
    for i, (centre, radius) in enumerate(zip(spheres.xyz, grown)):
        near = tree.contains(centre + radius * ball_points(count))
        point = np.repeat(np.arange(count), near.counts)
        hidden = np.unique(point[near.id != i])          # a sphere does not hide its own surface
        area[i] = 4 * math.pi * radius * radius * (1 - len(hidden) / count)
    return area


class Measures(unittest.TestCase):
    def setUp(self):
        self.r, self.q, self.d = 1.0, 0.75, 1.25
        self.spheres = bh.Spheres([[0, 0, 0], [self.d, 0, 0]], radius=[self.r, self.q])

    def test_porosity(self):
        low, high = (-1.5, -1.25, -1.25), (2.5, 1.25, 1.25)
        exact = 1 - union_volume(self.r, self.q, self.d) / (4.0 * 2.5 * 2.5)
        self.assertAlmostEqual(porosity(self.spheres, low, high, 64), exact, delta=0.002)
        alone = bh.Spheres([[0, 0, 0]], radius=1)
        self.assertAlmostEqual(porosity(alone, (-1, -1, -1), (1, 1, 1), 64), 1 - math.pi / 6, delta=0.002)

    def test_accessible_surface(self):
        for probe in (0.0, 0.5):
            r, q = self.r + probe, self.q + probe
            exact = [4 * math.pi * r * r - 2 * math.pi * r * cap_height(r, q, self.d), 4 * math.pi * q * q - 2 * math.pi * q * cap_height(q, r, self.d)]
            found = accessible_area(self.spheres, probe, 20000)
            np.testing.assert_allclose(found, exact, rtol=0.002)
            self.assertAlmostEqual(found.sum(), union_area(r, q, self.d), delta=0.002 * union_area(r, q, self.d))

    def test_apart_and_inside(self):
        apart = bh.Spheres([[0, 0, 0], [5, 0, 0]], radius=[1, 2])
        np.testing.assert_allclose(accessible_area(apart, 0.25, 500), 4 * math.pi * np.array([1.25, 2.25]) ** 2)
        inside = bh.Spheres([[0, 0, 0], [0.5, 0, 0]], radius=[2, 1])
        self.assertEqual(accessible_area(inside, 0.25, 500)[1], 0)


if __name__ == "__main__":
    unittest.main()
