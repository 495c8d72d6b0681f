"""Rays that meet spheres and sticks: Sticks and BodyTree."""

import pickle
import unittest

import numpy as np

import bihive as bh


def entered(origin, direction, centres, radii):
    """The least t at which a ray enters one of some balls, inf: none."""
    to = centres - origin
    along = to @ direction
    root = radii**2 - np.einsum("ij,ij->i", to, to) + along**2
    t = along - np.sqrt(np.where(root >= 0, root, np.nan))
    t[~(t >= 0)] = np.inf
    return t.min()


class Bodies(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(4)
        self.centres = random.uniform(-4, 4, (40, 3)).astype(np.float32)
        self.spheres = bh.Spheres(self.centres, radius=0.4)
        self.a, self.b = random.uniform(-4, 4, (2, 30, 3)).astype(np.float32)
        self.radii = random.uniform(0.05, 0.3, (30, 2)).astype(np.float32)
        self.sticks = bh.Sticks(self.a, self.b, self.radii)
        self.origins = random.uniform(-9, 9, (300, 3)).astype(np.float32)
        self.origins /= np.linalg.norm(self.origins, axis=1)[:, None] / 12
        self.directions = random.uniform(-4, 4, (300, 3)).astype(np.float32) - self.origins

    def test_hits_are_those_of_all_balls(self):
        hits = bh.BodyTree(self.spheres, self.sticks).closest(self.origins, self.directions)
        steps = np.linspace(0, 1, 2001)[:, None]
        seen = set()
        for i in range(300):
            origin, direction = self.origins[i].astype(float), self.directions[i].astype(float)
            unit = direction / np.linalg.norm(direction)
            of_spheres = entered(origin, unit, self.centres.astype(float), np.full(40, np.float32(0.4)))
            of_sticks = [entered(origin, unit, a + steps * (b - a), r[0] + steps[:, 0] * (r[1] - r[0]))
                         for a, b, r in zip(self.a.astype(float), self.b.astype(float), self.radii.astype(float))]
            expected = min(of_spheres, *of_sticks) / np.linalg.norm(direction)
            if np.isinf(expected) or np.isinf(hits.t[i]):
                self.assertLessEqual(np.isinf(expected), np.isinf(hits.t[i]) or hits.kind[i] == "stick")  # a graze between two balls
                continue
            self.assertAlmostEqual(hits.t[i], expected, delta=1e-3)
            if hits.kind[i] == "stick":
                k, s = hits.id[i], hits.along[i]
                axis = self.b[k].astype(float) - self.a[k]
                surface = origin + hits.t[i] * direction
                self.assertAlmostEqual(np.linalg.norm(surface - self.a[k] - s * axis), self.radii[k, 0] + s * (self.radii[k, 1] - self.radii[k, 0]), places=5)
            else:
                self.assertAlmostEqual(np.linalg.norm(origin + hits.t[i] * direction - self.centres[hits.id[i]]), 0.4, places=5)
            seen.add(hits.kind[i])
        self.assertEqual(seen, {"sphere", "stick"})

    def test_a_tuned_tree_keeps_the_bits(self):
        shares = []
        own = bh.BodyTree(self.spheres, self.sticks).closest(self.origins, self.directions)
        tuned = bh.BodyTree(self.spheres, self.sticks, tune=True, threads=1, progress=shares.append)
        for a, b in zip(own, tuned.closest(self.origins, self.directions), strict=True):
            np.testing.assert_array_equal(a, b)
        self.assertEqual(shares[-1], 1)
        with self.assertRaisesRegex(bh.UsageError, "tune excludes max_depth"):
            bh.BodyTree(self.spheres, self.sticks, tune=True, max_depth=4)

    def test_every_engine_gives_the_same_bits(self):
        trees = [bh.BodyTree(self.spheres, self.sticks, engine=engine, threads=1) for engine in ("wide", "reference", "brute", "wide-brute")]
        first = trees[0].closest(self.origins, self.directions)
        for tree in trees:
            hits = tree.closest(self.origins, self.directions)
            for one, other in zip(first, hits):
                np.testing.assert_array_equal(one, other)
            np.testing.assert_array_equal(tree.occluded(self.origins, self.directions), hits.kind != "nothing")
        # Without sticks in the way they are those of Tree.
        t, i = bh.Tree(self.spheres).closest(self.origins, self.directions)
        beside = first.kind != "stick"
        np.testing.assert_array_equal(first.t[beside], t[beside])
        np.testing.assert_array_equal(first.id[beside], i[beside])

    def test_all_hits_are_those_of_each_body_alone(self):
        far = bh.Spheres([[500.0, 0, 0], [-500.0, 0, 0]], radius=0.001)  # around 0: one alone has an origin of its own there
        tree = bh.BodyTree(self.spheres, self.sticks)
        hits = tree.all_hits(self.origins, self.directions)
        self.assertIsInstance(hits, bh.AllBodyHits)
        expected = set()
        for k in range(40):
            t, _ = bh.Tree(self.spheres[[k]]).closest(self.origins, self.directions)
            expected |= {(i, "sphere", k) for i in np.nonzero(np.isfinite(t))[0]}
        along = {}
        for k in range(30):
            alone = bh.BodyTree(far, bh.Sticks(self.a[k], self.b[k], self.radii[k])).closest(self.origins, self.directions)
            expected |= {(i, "stick", k) for i in np.nonzero(alone.kind == "stick")[0]}
            along.update({(i, k): alone.along[i] for i in np.nonzero(alone.kind == "stick")[0]})
        self.assertEqual(set(zip(hits.ray.tolist(), hits.kind.tolist(), hits.id.tolist())), expected)
        self.assertEqual(len(hits.t), len(expected))
        self.assertGreater(len(along), 50)
        for i, kind, k, s in zip(hits.ray, hits.kind, hits.id, hits.along):
            self.assertEqual(np.isnan(s), kind == "sphere")
            if kind == "stick":
                self.assertAlmostEqual(s, along[i, k], places=4)
        # The first of each ray is the closest, and those of a ray ascend.
        closest = tree.closest(self.origins, self.directions)
        found = np.diff(hits.begin) > 0
        np.testing.assert_array_equal(found, closest.kind != "nothing")
        np.testing.assert_array_equal(hits.t[hits.begin[:-1][found]], closest.t[found])
        np.testing.assert_array_equal(hits.id[hits.begin[:-1][found]], closest.id[found])
        self.assertTrue(np.all((np.diff(hits.t) >= 0) | (np.diff(hits.ray) > 0)))
        for engine in ("reference", "brute", "wide-brute"):
            for one, other in zip(hits, bh.BodyTree(self.spheres, self.sticks, engine=engine).all_hits(self.origins, self.directions)):
                np.testing.assert_array_equal(one, other)
        # A segment inside a stick meets where it exits.
        inside = bh.BodyTree(far, bh.Sticks([0.0, 0, 0], [4, 0, 0], 0.5)).all_hits([[[1, 0, 0], [1, 9, 0]]], [0, -1, 0], t_max=0.75)
        self.assertEqual((inside.t.tolist(), inside.begin.tolist()), ([0.5], [0, 1, 1]))

    def test_a_segment_and_shapes(self):
        tree = bh.BodyTree(bh.Spheres([[9.0, 9, 9]], radius=1), bh.Sticks([0.0, 0, 0], [4, 0, 0], 0.5))
        hit = tree.closest([1, 9, 0], [0, -1, 0])
        self.assertEqual((hit.t, hit.kind, hit.id, hit.along), (8.5, "stick", 0, 0.25))
        self.assertTrue(tree.occluded([1, 9, 0], [0, -1, 0]))
        self.assertFalse(tree.occluded([1, 9, 0], [0, -1, 0], t_max=8))
        self.assertEqual(tree.closest([1, 9, 0], [0, -1, 0], t_min=9).t, 9.5)
        missed = tree.closest(np.zeros((2, 5, 3)), [0, 0, 1], t_min=2)
        self.assertEqual(missed.t.shape, (2, 5))
        self.assertTrue(np.isnan(missed.along).all())
        self.assertEqual(set(missed.id.ravel().tolist()), {-1})

    def test_sticks_between_spheres(self):
        sticks = bh.Sticks([0, 1], [1, 2], [0.1, 0.2], between=self.spheres)
        np.testing.assert_array_equal(sticks.a, self.centres[:2].astype(float))
        np.testing.assert_array_equal(sticks.radius, [[0.1, 0.1], [0.2, 0.2]])
        self.assertEqual(len(sticks), 2)

    def test_what_is_refused(self):
        for make in (
            lambda: bh.Sticks([[0, 0, 0]], [[1, 0, 0], [2, 0, 0]], 1),
            lambda: bh.Sticks([[0, 0]], [[1, 0]], 1),
            lambda: bh.Sticks([[0, 0, 0]], [[1, 0, 0]], [1, 2, 3]),
            lambda: bh.Sticks([99], [0], 1, between=self.spheres),
            lambda: bh.BodyTree(self.spheres, bh.Sticks([[0, 0, 0]], [[1, 0, 0]], -1)),
            lambda: bh.BodyTree(self.spheres, bh.Sticks([[0, 0, np.nan]], [[1, 0, 0]], 1)),
            lambda: bh.BodyTree(self.spheres, [[0, 0, 0]]),
        ):
            with self.assertRaises(bh.Error):
                make()
        with self.assertRaises(TypeError):
            pickle.dumps(bh.BodyTree(self.spheres, self.sticks))


if __name__ == "__main__":
    unittest.main()
