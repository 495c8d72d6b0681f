"""Exact area and volume, and porosity from points, beside the closed forms of two overlapping spheres and Shrake and Rupley's points."""

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


def sampled_area(spheres, probe, count):
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

    def test_two_spheres(self):
        for probe in (0.0, 0.5):
            r, q = self.r + probe, self.q + probe
            exact = [4 * math.pi * r * r - 2 * math.pi * r * cap_height(r, q, self.d), 4 * math.pi * q * q - 2 * math.pi * q * cap_height(q, r, self.d)]
            m = bh.measure(self.spheres, probe=probe)
            np.testing.assert_allclose(m.sphere_area, exact, rtol=1e-14)
            self.assertAlmostEqual(m.area, union_area(r, q, self.d), delta=m.area_error)
            self.assertAlmostEqual(m.volume, union_volume(r, q, self.d), delta=m.volume_error)
            self.assertLess(max(m.area_error / m.area, m.volume_error / m.volume), 1e-11)
            np.testing.assert_array_equal(bh.sasa(self.spheres, probe), m.sphere_area)
            self.assertEqual(bh.volume(self.spheres, probe), m.volume)

    def test_apart_and_inside(self):
        apart = bh.Spheres([[0, 0, 0], [5, 0, 0]], radius=[1, 2])
        np.testing.assert_allclose(bh.sasa(apart, 0.25), 4 * math.pi * np.array([1.25, 2.25]) ** 2, rtol=1e-14)
        inside = bh.Spheres([[0, 0, 0], [0.5, 0, 0]], radius=[2, 1])
        self.assertEqual(bh.sasa(inside, 0.25)[1], 0)
        self.assertEqual(bh.measure(inside, select=[1]).area, bh.measure(inside[[1]]).area)

    def test_a_molecule_beside_points(self):
        s = bh.read("demo")[:400]
        exact, sampled = bh.sasa(s), sampled_area(s, 1.4, 400)
        whole = 4 * math.pi * (s.radius + 1.4) ** 2
        self.assertLess(np.abs(exact - sampled).max(), 0.05 * whole.max())
        self.assertAlmostEqual(exact.sum(), sampled.sum(), delta=0.005 * exact.sum())
        one, two = bh.measure(s, probe=1.4, threads=1), bh.measure(s, probe=1.4, threads=2)
        self.assertEqual((one.area, one.volume), (two.area, two.volume))

    def test_cavities(self):
        cube = bh.measure(bh.Spheres(2.0 * np.indices((2, 2, 2)).reshape(3, -1).T, radius=1.5))
        self.assertEqual((cube.components, len(cube.cavity_volume)), (1, 1))
        np.testing.assert_array_equal(cube.cavity_spheres[0], np.arange(8))
        self.assertGreater(cube.area, cube.cavity_area[0])
        self.assertEqual(len(bh.measure(self.spheres).cavity_spheres), 0)

    def test_porosity_of_a_cell(self):
        lattice = bh.Spheres([[0.5, 0, 0]], radius=1.25, cell=[2, 2, 2])
        exact = 4 * math.pi / 3 * 1.25**3 - 6 * math.pi / 3 * 0.25**2 * 3.5
        self.assertAlmostEqual(bh.porosity(lattice), 1 - exact / 8, places=14)
        m = bh.measure(lattice, periodic=True)
        self.assertAlmostEqual(m.volume, exact, delta=m.volume_error)
        self.assertEqual((m.cell_volume, len(m.channel_area)), (8, 1))
        np.testing.assert_array_equal(m.channel_translations[0], np.eye(3))
        np.testing.assert_array_equal(bh.contacts(lattice, periodic=True).image, [[0, 0, 1], [0, 1, 0], [1, 0, 0]])
        # Random spheres in a skewed cell, beside points.
        cell = np.array([[4, 0, 0], [1, 3, 0], [-1, 1, 5.0]])
        rng = np.random.default_rng(3)
        s = bh.Spheres(rng.random((30, 3)) @ cell, radius=rng.uniform(0.3, 0.8, 30), cell=cell)
        points = rng.random((100_000, 3)) @ cell
        sampled = float((bh.Tree(s).contains(points).counts == 0).mean())
        self.assertAlmostEqual(bh.porosity(s), sampled, delta=0.007)
        self.assertTrue(math.isnan(bh.measure(s).porosity))
        with self.assertRaisesRegex(bh.Error, "no periodic cell"):
            bh.porosity(self.spheres)

    def test_contacts_and_volumes(self):
        d = self.d
        h = (d * d + self.r**2 - self.q**2) / (2 * d)
        contacts = bh.contacts(self.spheres)
        self.assertEqual((contacts.first.tolist(), contacts.second.tolist()), ([0], [1]))
        self.assertAlmostEqual(contacts.area[0], math.pi * (self.r**2 - h * h), places=14)
        s = bh.read("demo")
        m = bh.measure(s, probe=1.4)
        self.assertAlmostEqual(m.sphere_volume.sum(), m.volume, delta=m.volume_error)
        self.assertTrue((m.sphere_volume >= 0).all())
        near = bh.contacts(s, 1.4)
        self.assertTrue((near.first < near.second).all() and (near.area > 0).all())

    def test_buried_area(self):
        matrix = bh.buried_area(self.spheres, [[0], [1]], 0)
        exact = 2 * math.pi * (self.r * cap_height(self.r, self.q, self.d) + self.q * cap_height(self.q, self.r, self.d))
        self.assertAlmostEqual(matrix[0, 1], exact, places=13)
        self.assertAlmostEqual(matrix[1, 1], 4 * math.pi * self.q**2, places=13)
        s = bh.read("demo")
        areas = [bh.sasa(s, select=one).sum() for one in ("chain A", "chain B", "chain A B")]
        self.assertAlmostEqual(bh.buried_area(s, ["chain A", "chain B"])[0, 1], areas[0] + areas[1] - areas[2], places=7)
        with self.assertRaisesRegex(bh.UsageError, "common spheres"):
            bh.buried_area(s, ["all", "chain A"])

    def test_derivatives(self):
        m = bh.measure(bh.Spheres([[0, 0, 0], [1.25, 0, 0]], radius=1), derivatives=True)
        np.testing.assert_allclose(m.area_by_centre, [[-2 * math.pi, 0, 0], [2 * math.pi, 0, 0]], atol=1e-13)
        np.testing.assert_allclose(m.area_by_radius, 4 * math.pi + 1.25 * math.pi, rtol=1e-14)
        np.testing.assert_allclose(m.volume_by_radius, bh.measure(bh.Spheres([[0, 0, 0], [1.25, 0, 0]], radius=1)).sphere_area)
        self.assertEqual(m.volume_by_centre.shape, (2, 3))
        self.assertIsNone(bh.measure(self.spheres).area_by_centre)

    def test_what_is_refused(self):
        for probe in (-1, math.nan, math.inf, "wide", [1, 2, 3]):
            with self.assertRaisesRegex(bh.UsageError, "probe"):
                bh.measure(self.spheres, probe=probe)
        with self.assertRaisesRegex(bh.UsageError, "spheres"):
            bh.sasa(self.spheres.xyz)
        with self.assertRaisesRegex(bh.UsageError, "select"):
            bh.volume(self.spheres, select="elephant C")
        with self.assertRaisesRegex(bh.Error, "extent"):
            bh.measure(self.spheres, probe=1e30)


if __name__ == "__main__":
    unittest.main()
