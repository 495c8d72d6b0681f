"""bihive.Tree: answers beside brute force in NumPy and beside the engine that tests every sphere."""

import pickle
import signal
import time
import unittest

import bihive as bh
import numpy as np

RNG = np.random.default_rng(11)


def brute_force(xyz, radius, origin, direction, t_min=0.0, t_max=np.inf):
    """For each ray and sphere the t where the ray enters the sphere, or leaves it if it begins inside; NaN: neither."""
    o, d = origin[:, None, :].astype(np.longdouble), direction[:, None, :].astype(np.longdouble)
    to_centre = xyz[None].astype(np.longdouble) - o
    a = (d * d).sum(-1)
    b = (to_centre * d).sum(-1)
    c = (to_centre * to_centre).sum(-1) - radius[None].astype(np.longdouble) ** 2
    with np.errstate(invalid="ignore"):
        root = np.sqrt(b * b - a * c)
    near, far = (b - root) / a, (b + root) / a
    limits = [np.asarray(limit)[..., None] for limit in (t_min, t_max)]
    inside = [(limits[0] <= t) & (t <= limits[1]) for t in (near, far)]
    return np.where(inside[0], near, np.where(inside[1], far, np.nan))


def rays(count):
    return RNG.normal(size=(count, 3)).astype(np.float32) * 3, RNG.normal(size=(count, 3)).astype(np.float32)


class Tuned(unittest.TestCase):
    def test_answers_keep_their_bits(self):
        spheres = bh.Spheres(RNG.normal(size=(300, 3)), radius=0.1)
        origins, directions = rays(200)
        own, tuned = bh.Tree(spheres), bh.Tree(spheres, tune=True, threads=1)
        for a, b in zip(own.closest(origins, directions), tuned.closest(origins, directions), strict=True):
            np.testing.assert_array_equal(a, b)
        mask = np.arange(300) % 2 == 0
        np.testing.assert_array_equal(own.occluded(origins, directions, mask=mask), tuned.occluded(origins, directions, mask=mask))

    def test_nothing_to_search(self):
        spheres = bh.Spheres([[0.0, 0, 0]], radius=1)
        with self.assertRaisesRegex(bh.UsageError, "tune excludes max_prims"):
            bh.Tree(spheres, tune=True, max_prims=4)
        with self.assertRaisesRegex(bh.UsageError, "tune needs a tree"):
            bh.Tree(spheres, tune=True, engine="brute")
        bh.Tree(bh.Spheres(np.zeros((0, 3)), radius=1), tune=True)


class Counting(unittest.TestCase):
    """Rays that do not see all spheres."""

    def setUp(self):
        rng = np.random.default_rng(5)
        self.xyz = rng.normal(size=(400, 3))
        self.spheres = bh.Spheres(self.xyz, radius=0.15 + 0.1 * rng.random(400), columns={"q": np.arange(400)})
        self.xyz, self.radius = self.spheres.xyz, self.spheres.radius
        self.tree = bh.Tree(self.spheres)
        self.origins = rng.normal(size=(700, 3)).astype(np.float32) * 3
        self.directions = rng.normal(size=(700, 3)).astype(np.float32)

    def all_t(self, **limits):
        return brute_force(self.xyz, self.radius, self.origins, self.directions, **limits)

    def assert_answers(self, tree, counts, t_max=np.inf, **options):
        """`counts`: bool (rays, spheres)."""
        given = {**options, **({} if t_max == np.inf else {"t_max": t_max})}
        t = np.where(counts, self.all_t(t_max=t_max), np.nan)
        expected = np.where(np.isnan(t).all(1), np.inf, np.nanmin(np.where(np.isnan(t), np.inf, t), axis=1))
        hits = tree.closest(self.origins, self.directions, **given)
        np.testing.assert_allclose(hits.t, expected.astype(float), rtol=1e-12)
        found = hits.id >= 0
        self.assertTrue(counts[np.flatnonzero(found), hits.id[found]].all())
        self.assertGreater(found.sum(), 20)
        np.testing.assert_array_equal(tree.occluded(self.origins, self.directions, **given), found)
        every = tree.all_hits(self.origins, self.directions, **given)
        np.testing.assert_array_equal(every.counts, (~np.isnan(t)).sum(1))
        first = tree.all_hits(self.origins, self.directions, k=1, **given)
        np.testing.assert_array_equal(first.t, hits.t[found])
        np.testing.assert_array_equal(first.id, hits.id[found])
        self.assertEqual(len(hits.normals()), len(self.origins))
        np.testing.assert_allclose(np.linalg.norm(hits.positions()[found] - self.xyz[hits.id[found]], axis=1), self.radius[hits.id[found]], rtol=1e-9)

    def test_a_mask(self):
        even = np.arange(400) % 2 == 0
        counts = np.broadcast_to(even, (700, 400))
        for mask in (even, np.flatnonzero(even), "index " + " ".join(map(str, range(0, 400, 2)))):
            self.assert_answers(self.tree, counts, mask=mask)
        self.assert_answers(self.tree, np.broadcast_to(np.arange(400) < 100, (700, 400)), mask="q < 100")
        self.assert_answers(self.tree, np.broadcast_to(np.arange(400) < 400, (700, 400)))

    def test_the_tree_of_a_mask_is_that_of_select_and_is_kept(self):
        mask = np.arange(400) < 90
        hits, other = self.tree.closest(self.origins, self.directions, mask=mask), bh.Tree(self.spheres, select=mask).closest(self.origins, self.directions)
        np.testing.assert_array_equal(hits.t, other.t)
        np.testing.assert_array_equal(hits.id, other.id)
        kept = self.tree._masked
        self.tree.closest(self.origins, self.directions, mask="q < 90")
        self.assertIs(self.tree._masked, kept)
        self.tree.update(self.xyz + 1)
        moved = self.tree.closest(self.origins + np.float32(1), self.directions, mask=mask)
        self.assertLess(np.mean(moved.id != hits.id), 0.01)

    def test_within_a_selection(self):
        tree = bh.Tree(self.spheres, select="q < 200")
        self.assert_answers(tree, np.broadcast_to((np.arange(400) < 200) & (np.arange(400) >= 50), (700, 400)), mask="q >= 50")
        nobody = tree.closest(self.origins, self.directions, mask="q > 300")
        self.assertEqual(set(nobody.id.tolist()), {-1})

    def test_exclude(self):
        own = self.tree.closest(self.origins, self.directions).id
        self.assertGreater((own >= 0).sum(), 50)
        counts = np.arange(400) != own[:, None]
        for t_max in (np.inf, 3.0):
            self.assert_answers(self.tree, counts, t_max=t_max, exclude=own)
        self.assert_answers(self.tree, np.broadcast_to(np.arange(400) != 7, (700, 400)), exclude=7)
        self.assert_answers(self.tree, counts & (np.arange(400) >= 100), exclude=own, mask="q >= 100")
        one = self.tree.closest(self.origins[0], self.directions[0], exclude=int(own[0]))
        self.assertEqual(np.ndim(one.t), 0)

    def test_spheres_that_are_met_at_the_same_distance(self):
        twins = bh.Tree(bh.Spheres([[0.0, 0, 0], [0, 0, 0], [4, 0, 0]], radius=1))
        hits = twins.closest([[-5.0, 0, 0]] * 4, [1, 0, 0], exclude=[-1, 0, 1, 2])
        self.assertEqual((hits.t.tolist(), hits.id.tolist()), ([4, 4, 4, 4], [0, 1, 0, 0]))
        self.assertFalse(bh.Tree(bh.Spheres([[0.0, 0, 0]], radius=1)).occluded([-5, 0, 0], [1, 0, 0], exclude=0))

    def test_periodic_rays_pass_over_the_image_nearest_to_their_origin(self):
        box = bh.Tree(bh.Spheres([[1.0, 1, 1], [1, 3, 1]], radius=0.5, cell=[4, 4, 4]))
        from_own = {"periodic": True, "exclude": [0, -1, 1], "t_max": 6}
        origins = [[1.0, 1, 1], [1, 1, 1], [-400, 1, 1]]
        hits = box.closest(origins, [1, 0, 0], **from_own)
        # The next image of the own sphere is hit; without exclude the sphere itself, from within.
        self.assertEqual((hits.t.tolist(), hits.id.tolist()), ([3.5, 0.5, 0.5], [0, 0, 0]))
        self.assertEqual(box.occluded(origins, [1, 0, 0], **{**from_own, "t_max": 3}).tolist(), [False, True, True])
        self.assertEqual(box.all_hits(origins, [1, 0, 0], **from_own).counts.tolist(), [1, 2, 2])
        self.assertEqual(box.all_hits(origins, [1, 0, 0], k=1, **from_own).t.tolist(), [3.5, 0.5, 0.5])
        np.testing.assert_array_equal(hits.positions()[0], [4.5, 1, 1])
        part = box.closest([1, 1, 1], [1, 0, 0], mask=[1], exclude=0, periodic=True, t_max=6)
        self.assertEqual(int(part.id), -1)

    def test_periodic_rays_that_exclude_agree_with_the_spheres_copied(self):
        rng = np.random.default_rng(8)
        xyz, radius, copies = rng.uniform(0, 3, (30, 3)), rng.uniform(0.1, 0.4, 30), np.stack(np.meshgrid(*[range(-3, 4)] * 3), -1).reshape(-1, 3)
        box = bh.Tree(bh.Spheres(xyz, radius=radius, cell=[3, 3, 3]))
        all_xyz = (xyz + 3 * copies[:, None]).reshape(-1, 3)
        plain = bh.Tree(bh.Spheres(all_xyz, radius=np.tile(radius, len(copies))))
        origins, directions = rng.uniform(0, 3, (400, 3)), rng.normal(size=(400, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        own = np.maximum(plain.closest(origins, directions, t_max=5).id, 0) % 30
        gaps = np.abs(np.linalg.norm(origins[:, None] - all_xyz.reshape(len(copies), 30, 3)[:, own].swapaxes(0, 1), axis=-1) - radius[own][:, None])
        image = gaps.argmin(axis=1) * 30 + own
        given, copied = {"periodic": True, "exclude": own, "t_max": 5}, {"exclude": image, "t_max": 5}
        hits, expected = box.closest(origins, directions, **given), plain.closest(origins, directions, **copied)
        self.assertGreater((plain.closest(origins, directions, t_max=5).id == image).sum(), 10)
        np.testing.assert_array_equal(hits.id, np.where(expected.id < 0, -1, expected.id % 30))
        np.testing.assert_allclose(hits.t, expected.t, rtol=1e-5)
        np.testing.assert_array_equal(box.occluded(origins, directions, **given), expected.id >= 0)
        np.testing.assert_array_equal(box.all_hits(origins, directions, **given).counts, plain.all_hits(origins, directions, **copied).counts)

    def test_what_is_refused(self):
        box = bh.Tree(bh.Spheres([[0.5, 0, 0]], radius=0.1, cell=[10, 10, 10]))
        for options, argument in [({"exclude": 5}, "exclude"), ({"mask": "x >"}, "mask"), ({"mask": [True, False]}, "mask")]:
            with self.assertRaises(bh.UsageError) as caught:
                box.closest([0, 0, 0], [1, 0, 0], **options)
            self.assertEqual(caught.exception.argument, argument)
        self.assertEqual(int(box.closest([5, 0, 0], [1, 0, 0], periodic=True, mask=[0]).id), 0)


class FarFromZero(unittest.TestCase):
    """Places on a map: answers are those of the same numbers minus the origin."""

    def setUp(self):
        k = np.arange(300)
        self.at = np.array([500000, 5400000, 100.0])
        self.xyz = np.c_[np.cos(0.2 * k), np.sin(0.2 * k), 0.02 * k] + self.at
        self.spheres = bh.Spheres(self.xyz, radius=0.1)

    def test_places_keep_their_digits(self):
        self.assertEqual(self.spheres.xyz.dtype, np.float64)
        np.testing.assert_allclose(self.spheres.xyz, self.xyz, rtol=0, atol=1.2e-7)
        self.assertEqual(int(bh.select(self.spheres, "y > 5400000.5").sum()), int((self.xyz[:, 1] > 5400000.5).sum()))

    def test_rays_and_points(self):
        near = bh.Spheres(self.xyz - self.at, radius=0.1)
        offset = np.c_[np.full(500, 5.0), np.linspace(-1.2, 1.2, 500), np.linspace(0, 6, 500)]
        t, ids = bh.Tree(self.spheres).closest(offset + self.at, [-1, 0, 0])
        expected_t, expected = bh.Tree(near).closest(offset, [-1, 0, 0])
        self.assertGreater(int((ids >= 0).sum()), 100)
        self.assertGreater(float((ids == expected).mean()), 0.99)
        hit = (ids >= 0) & (ids == expected)
        np.testing.assert_allclose(t[hit], expected_t[hit], atol=1e-4)
        distance, nearest = bh.Tree(self.spheres).nearest(self.xyz, to="centre")
        self.assertEqual(nearest.tolist(), list(range(300)))
        self.assertLess(distance.max(), 1e-6)

    def test_a_set_too_wide_for_its_radii_warns(self):
        with self.assertWarnsRegex(bh.InputWarning, "moves 1 of 2 centres by more than 1 % of the radius"):
            bh.Spheres([[-1e6, 0, 0], [1e6 + 0.03, 0, 0]], radius=1e-3)


class Queries(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.spheres = bh.Spheres(RNG.normal(size=(300, 3)), radius=RNG.random(300) * 0.2, columns={"charge": RNG.normal(size=300)})
        cls.xyz, cls.radius = cls.spheres.xyz, cls.spheres.radius
        cls.tree = bh.Tree(cls.spheres)

    def check(self, t, ids, candidates):
        nothing = np.isnan(candidates).all(axis=1)
        filled = np.where(np.isnan(candidates), np.inf, candidates)
        np.testing.assert_array_equal(ids == -1, nothing)
        np.testing.assert_array_equal(t[nothing], np.inf)
        np.testing.assert_array_equal(ids[~nothing], filled.argmin(axis=1)[~nothing])
        np.testing.assert_allclose(t[~nothing], filled.min(axis=1)[~nothing].astype(float), rtol=1e-9, atol=1e-9)

    def test_closest_beside_numpy(self):
        origin, direction = rays(5000)
        t, ids = self.tree.closest(origin, direction)
        self.assertEqual((t.dtype, ids.dtype, t.shape), (np.float64, np.int64, (5000,)))
        self.assertGreater((ids >= 0).sum(), 200)
        self.check(t, ids, brute_force(self.xyz, self.radius, origin, direction))

    def test_limits(self):
        origin, direction = rays(3000)
        t_min, t_max = RNG.random(3000) * 2, 2 + RNG.random(3000) * 2
        t, ids = self.tree.closest(origin, direction, t_min=t_min, t_max=t_max)
        self.check(t, ids, brute_force(self.xyz, self.radius, origin, direction, t_min, t_max))
        t, ids = self.tree.closest(origin, direction, t_max=np.float32(1.5))
        self.check(t, ids, brute_force(self.xyz, self.radius, origin, direction, t_max=np.full(3000, 1.5)))

    def test_the_bits_of_every_engine(self):
        origin, direction = rays(40_000)
        expected = bh.Tree(self.spheres, engine="brute").closest(origin, direction)
        for engine in ["auto", "wide", "reference", "wide-brute"]:
            for threads in [1, 2]:
                tree = bh.Tree(self.spheres, engine=engine, threads=threads, max_prims=2)
                for order in ["any", "blocks"]:
                    found = tree.closest(origin, direction, order=order)
                    for one, other in zip(found, expected):
                        np.testing.assert_array_equal(one.view(np.int64), other.view(np.int64))
                    np.testing.assert_array_equal(tree.occluded(origin, direction, order=order), expected[1] >= 0)

    def test_all_hits(self):
        origin, direction = rays(2000)
        hits = self.tree.all_hits(origin, direction)
        candidates = brute_force(self.xyz, self.radius, origin, direction)
        self.assertEqual(len(hits.ray), int((~np.isnan(candidates)).sum()))
        for ray in range(2000):
            part = slice(hits.begin[ray], hits.begin[ray + 1])
            self.assertEqual(set(hits.id[part]), set(np.flatnonzero(~np.isnan(candidates[ray]))))
            self.assertTrue((np.diff(hits.t[part]) >= 0).all())
            self.assertTrue((hits.ray[part] == ray).all())
        t, ids = self.tree.closest(origin, direction)
        first = hits.begin[:-1][ids >= 0]
        np.testing.assert_array_equal(hits.t[first], t[ids >= 0])
        np.testing.assert_array_equal(hits.id[first], ids[ids >= 0])

    def test_layouts_of_rays(self):
        origin, direction = rays(1000)
        expected = self.tree.closest(origin, direction)
        wide = np.zeros((1000, 9), dtype=np.float64)
        wide[:, 0:6:2], wide[:, 1:7:2] = origin, direction
        for o, d in [
            (origin.astype(float), direction),
            (np.asfortranarray(origin), direction[::-1][::-1]),
            (np.asfortranarray(origin), np.asfortranarray(direction)),
            (wide[:, 0:6:2], wide[:, 1:7:2]),
            (origin.astype(">f4"), direction.astype(">f8")),
            (origin.tolist(), memoryview(np.ascontiguousarray(direction))),
        ]:
            for one, other in zip(self.tree.closest(o, d), expected):
                np.testing.assert_array_equal(one, other)
        # Of rays that lie as the engine has them, each piece begins at its own place.
        many = [np.asfortranarray(np.tile(array, (70, 1))) for array in (origin, direction)]
        limits = {"t_min": np.zeros(70_000), "t_max": np.full(70_000, np.inf)}
        for one, other in zip(self.tree.closest(*many, **limits, order="blocks"), expected):
            np.testing.assert_array_equal(one, np.tile(other, 70))
        # One origin, or one direction, for all.
        one = self.tree.closest(origin[0], direction)
        many = self.tree.closest(np.tile(origin[0], (1000, 1)), direction)
        np.testing.assert_array_equal(one, many)
        self.assertEqual(self.tree.closest(origin[0], direction[0])[0].shape, ())
        self.assertEqual(self.tree.closest(np.zeros((0, 3)), direction[0])[0].shape, (0,))

    def test_rays_that_hit_nothing(self):
        origin = np.zeros((5, 3))
        direction = np.ones((5, 3))
        origin[0, 0], origin[1, 1], direction[2], direction[3, 2], origin[4, 2] = np.nan, np.inf, 0, np.nan, 1e39
        everywhere = bh.Tree(bh.Spheres(np.zeros((1, 3)), radius=1e3))
        t, ids = everywhere.closest(origin, direction)
        self.assertEqual((t.tolist(), ids.tolist()), ([np.inf] * 5, [-1] * 5))
        self.assertFalse(everywhere.occluded(origin, direction).any())
        self.assertEqual(len(everywhere.all_hits(origin, direction).t), 0)
        self.assertEqual(everywhere.closest([0, 0, 0], [1, 0, 0], t_min=3, t_max=2).id, -1)

    def test_leaves(self):
        tree = bh.Tree(bh.Spheres([[0, 0, 0], [9, 0, 0]], radius=[1, 2]))
        self.assertEqual(tree.closest([0, 1, 0], [1, 0, 0], leaves=0).id, 1)
        t, ids = tree.closest([-1, 0, 0], [1, 0, 0], leaves=[0], inside=True)
        self.assertEqual((t, ids), (2.0, 0))
        self.assertEqual(tree.closest([-1, 0, 0], [1, 0, 0], leaves=[-1]).t, 0.0)

    def test_a_part_by_attribute(self):
        origin, direction = rays(3000)
        mask = self.spheres["charge"] > 0
        tree = bh.Tree(self.spheres, select="charge > 0")
        self.assertEqual(len(tree), int(mask.sum()))
        t, ids = tree.closest(origin, direction)
        self.assertTrue(mask[ids[ids >= 0]].all())
        self.check(t, ids, np.where(mask, brute_force(self.xyz, self.radius, origin, direction), np.nan))
        np.testing.assert_array_equal(tree.occluded(origin, direction), ids >= 0)
        hit = int(np.flatnonzero(ids >= 0)[0])
        again = tree.closest(origin[hit], direction[hit], leaves=ids[hit])
        self.assertNotEqual(again.id, ids[hit])
        nobody = bh.Tree(self.spheres, select="charge > 1e9")
        self.assertFalse(nobody.occluded(origin, direction, leaves=3).any())

    def test_many_rays_in_pieces(self):
        origin, direction = rays(400_000)
        t, ids = self.tree.closest(origin, direction)
        for part in [slice(0, 1000), slice(199_500, 200_500), slice(399_000, 400_000)]:
            some = self.tree.closest(origin[part], direction[part])
            np.testing.assert_array_equal(t[part], some[0])
            np.testing.assert_array_equal(ids[part], some[1])
        hits = self.tree.all_hits(origin, direction)
        self.assertEqual(hits.begin[-1], len(hits.t))
        np.testing.assert_array_equal(np.diff(hits.begin) > 0, ids >= 0)

    def distances(self, points, to="surface"):
        """From each point to each sphere, by the sums that the engine states."""
        between = self.xyz[None].astype(np.float64) - points[:, None]
        made = np.sqrt(between[..., 0] ** 2 + between[..., 1] ** 2 + between[..., 2] ** 2)
        return made - self.radius[None] if to == "surface" else made

    def test_nearest_beside_numpy(self):
        points = RNG.normal(size=(4000, 3)) * 2
        for to in ["surface", "centre"]:
            all_distances = self.distances(points, to)
            order = np.argsort(all_distances, axis=1, kind="stable")[:, :5]
            expected = np.take_along_axis(all_distances, order, axis=1)
            distance, ids = self.tree.nearest(points, 5, to=to)
            self.assertEqual((distance.shape, ids.dtype), ((4000, 5), np.int64))
            np.testing.assert_array_equal(ids, order)
            np.testing.assert_allclose(distance, expected, rtol=1e-12, atol=1e-12)
            one, first = self.tree.nearest(points, to=to)
            np.testing.assert_array_equal(one, distance[:, 0])
            np.testing.assert_array_equal(first, ids[:, 0])
            limited, few = self.tree.nearest(points, 5, within=0.3, to=to)
            np.testing.assert_array_equal(limited, np.where(distance <= 0.3, distance, np.inf))
            np.testing.assert_array_equal(few, np.where(distance <= 0.3, ids, -1))

    def test_within_contains_overlaps(self):
        points = RNG.normal(size=(3000, 3))
        all_distances = self.distances(points)
        limits = RNG.random(3000) * 0.4
        for near, inside in [
            (self.tree.within(points, limits), all_distances <= limits[:, None]),
            (self.tree.overlaps(points, limits), all_distances <= limits[:, None]),
            (self.tree.contains(points), all_distances <= 0),
            (self.tree.within(points, 0.5, to="centre"), self.distances(points, "centre") <= 0.5),
        ]:
            rows, ids = np.nonzero(inside)
            self.assertGreater(len(ids), 100)
            np.testing.assert_array_equal(near.id, ids)
            np.testing.assert_array_equal(near.counts, inside.sum(axis=1))
            np.testing.assert_array_equal(np.repeat(np.arange(3000), near.counts), rows)
        near = self.tree.contains(points)
        rows = np.repeat(np.arange(3000), near.counts)
        np.testing.assert_allclose(near.distance, all_distances[rows, near.id], rtol=0, atol=1e-12)

    def test_points_see_the_images_of_a_cell(self):
        cube = np.array([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]])
        places = (cube + np.indices((3, 3, 3)).reshape(3, -1).T[:, None]).reshape(-1, 3)
        crystal = bh.Spheres(places, radius=0.1, cell=[3, 3, 3])
        tree = bh.Tree(crystal)
        self.assertTrue(tree.periodic)
        near = tree.within(places, 0.8, to="centre")
        self.assertEqual(set(near.counts.tolist()), {13})  # twelve neighbours, and the atom itself
        distance, _ = tree.nearest(places, 13, to="centre")
        np.testing.assert_allclose(distance[:, 1:], np.sqrt(0.5), rtol=1e-6)
        self.assertEqual(tree.contains([3.05, -0.05, 6]).id.tolist(), [0])
        self.assertEqual(tree.overlaps([3.15, 0, 0], 0.1).id.tolist(), [0])
        alone = bh.Tree(crystal, periodic=False)
        self.assertFalse(alone.periodic)
        self.assertLess(alone.within(places, 0.8, to="centre").counts.min(), 13)
        one = bh.Tree(bh.Spheres([[0, 0, 0]], radius=0.1, cell=[[0, 1, 1], [1, 0, 1], [1, 1, 0]]))
        self.assertEqual(one.within([0, 0, 0], 1.5, to="centre").id.tolist(), [0] * 13)
        slab = bh.Spheres(places, radius=0.1, cell=[3, 3, 3], periodic=(True, True, False))
        self.assertEqual(slab.periodic, (True, True, False))
        self.assertEqual(set(bh.Tree(slab).within(places[places[:, 2] == 0], 0.8, to="centre").counts.tolist()), {9})
        self.assertEqual(pickle.loads(pickle.dumps(slab)), slab)
        self.assertEqual(bh.select(crystal, "within 0.8 of index 0").sum(), 13)
        self.assertEqual(bh.select(crystal, "within 0.8 of index 0", periodic=False).sum(), 4)
        part = bh.Tree(crystal, select="within 0.8 of index 0")
        self.assertEqual(part.within([0, 0, 0], 0.8, to="centre").counts.tolist(), [13])
        with self.assertRaisesRegex(ValueError, "million images"):
            tree.within([0, 0, 0], np.inf)
        with self.assertRaisesRegex(ValueError, "periodic"):
            bh.Spheres(places, radius=0.1, cell=[3, 3, 3], periodic="yes")

    def test_rays_see_the_images_of_a_cell(self):
        rng = np.random.default_rng(4)
        places = rng.random((60, 3)) * [3, 2, 4]
        vectors = np.array([[3, 0, 0], [0.5, 2, 0], [-1, 0.25, 4]])
        crystal = bh.Spheres(places, radius=0.2, cell=vectors)
        tree = bh.Tree(crystal)
        origins, directions = rng.random((40_000, 3)) * 3, rng.normal(size=(40_000, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        t, ids = tree.closest(origins, directions, t_max=4, periodic=True)
        # All images that may be as near, as spheres of their own.
        shifts = (np.indices((9, 9, 9)).reshape(3, -1).T - 4) @ vectors
        every = bh.Spheres((places + shifts[:, None]).reshape(-1, 3), radius=0.2)
        others_t, others = bh.Tree(every).closest(origins, directions, t_max=4)
        self.assertGreater((ids >= 0).sum(), 20_000)
        np.testing.assert_array_equal(ids, np.where(others >= 0, others % 60, -1))
        np.testing.assert_allclose(t, others_t, atol=1e-4)
        np.testing.assert_array_equal(tree.occluded(origins, directions, t_max=4, periodic=True), ids >= 0)
        hits = tree.all_hits(origins[:1000], directions[:1000], t_max=4, periodic=True)
        self.assertEqual(len(hits.t), len(bh.Tree(every).all_hits(origins[:1000], directions[:1000], t_max=4).t))
        np.testing.assert_array_equal(hits.t[hits.begin[:-1]][ids[:1000] >= 0], t[:1000][ids[:1000] >= 0])
        # A ray goes on from an image that it met.
        one = bh.Tree(bh.Spheres([[1, 1, 1]], radius=1, cell=[4, 4, 4]))
        self.assertEqual(one.closest([14, 1, 1], [1, 0, 0], leaves=0, periodic=True).t, 2)
        self.assertEqual(one.closest([14, 1, 1], [1, 0, 0]).id, -1)  # as in pictures
        channel = [[1, 1, 1], [3, 3, 3]], [1, 0, 0]
        for query in (one.closest, one.occluded):
            with self.assertRaisesRegex(ValueError, "t_max: ray 1 passes more than 16384 periodic cells"):
                query(*channel, periodic=True)
        self.assertEqual(one.closest(*channel, t_max=100, periodic=True)[1].tolist(), [0, -1])
        with self.assertRaisesRegex(ValueError, "ray 0"):
            one.all_hits(*channel, periodic=True)
        self.assertEqual(one.all_hits(*channel, t_max=100, periodic=True).ray.tolist(), [0] * 26)
        with self.assertRaisesRegex(ValueError, "wide engine"):
            bh.Tree(crystal, engine="reference").closest([0, 0, 0], [1, 0, 0], periodic=True)
        for alone in (bh.Tree(crystal, periodic=False), bh.Tree(every)):
            with self.assertRaisesRegex(ValueError, "periodic: the tree has no images"):
                alone.closest([0, 0, 0], [1, 0, 0], periodic=True)
        with self.assertRaisesRegex(ValueError, "wrap"):
            bh.Tree(bh.Spheres([[0, 0, 0], [900, 900, 0]], radius=1, cell=[9, 9, 9])).closest(
                [0, 0, 0], [1, 0, 0], periodic=True
            )

    def test_points_of_a_selection_and_in_pieces(self):
        points = RNG.normal(size=(140_000, 3))  # more than are asked between two looks for Ctrl-C
        some = bh.Tree(self.spheres, select="charge > 0")
        positive = np.flatnonzero(self.spheres["charge"] > 0)
        distance, ids = some.nearest(points)
        self.assertTrue(np.isin(ids, positive).all())
        all_distances = self.distances(points[-500:])[:, positive]
        np.testing.assert_array_equal(ids[-500:], positive[all_distances.argmin(axis=1)])
        near = some.contains(points)
        self.assertEqual((len(near.begin), near.begin[-1]), (140_001, len(near.id)))
        self.assertTrue((np.diff(near.begin) >= 0).all() and np.isin(near.id, positive).all())
        np.testing.assert_array_equal(near.counts > 0, distance <= 0)

    def test_few_points_and_few_spheres(self):
        distance, ids = self.tree.nearest(np.zeros((0, 3)), 3)
        self.assertEqual((distance.shape, ids.shape), ((0, 3), (0, 3)))
        self.assertEqual(self.tree.contains(np.zeros((0, 3))).begin.tolist(), [0])
        two = bh.Tree(bh.Spheres([[0.0, 0, 0], [5, 0, 0]], radius=1))
        distance, ids = two.nearest([2, 0, 0], 3)
        self.assertEqual((distance.tolist(), ids.tolist()), ([1.0, 2.0, np.inf], [0, 1, -1]))

    def test_any_leading_shape(self):
        origin, direction = rays(60)
        flat = self.tree.closest(origin, direction, t_max=np.arange(60) * 0.2)
        grid = self.tree.closest(origin.reshape(3, 20, 3), direction.reshape(3, 20, 3), t_max=np.arange(60).reshape(3, 20) * 0.2)
        self.assertEqual((grid.t.shape, grid.id.shape), ((3, 20), (3, 20)))
        np.testing.assert_array_equal(grid.id.reshape(-1), flat.id)
        np.testing.assert_array_equal(grid.normals().reshape(-1, 3), flat.normals())
        # Every origin with every direction.
        every = self.tree.occluded(origin[:, None], direction[:7])
        self.assertEqual(every.shape, (60, 7))
        np.testing.assert_array_equal(every[5], self.tree.occluded(origin[5], direction[:7]))
        hits = self.tree.all_hits(origin.reshape(3, 20, 3), direction.reshape(3, 20, 3))
        np.testing.assert_array_equal(hits.ray, self.tree.all_hits(origin, direction).ray)
        # A single ray and a single point give numbers.
        t, i = self.tree.closest(origin[0], direction[0])
        self.assertEqual((np.ndim(t), np.ndim(i)), (0, 0))
        self.assertIsInstance(float(t), float)
        self.assertIn(bool(self.tree.occluded(origin[0], direction[0])), (True, False))
        distance, i = self.tree.nearest(origin[0])
        self.assertEqual((np.ndim(distance), np.ndim(i)), (0, 0))
        self.assertEqual(self.tree.nearest(origin[0], 4)[1].shape, (4,))
        self.assertEqual(self.tree.nearest(origin.reshape(3, 20, 3), 4)[0].shape, (3, 20, 4))
        self.assertEqual(self.tree.nearest(origin.reshape(3, 20, 3))[0].shape, (3, 20))
        self.assertEqual(self.tree.count_within(origin.reshape(3, 20, 3), 0.5).shape, (3, 20))
        self.assertEqual(self.tree.within(origin.reshape(3, 20, 3), 0.5).counts.shape, (60,))

    def test_surfaces_of_hits(self):
        origin, direction = rays(4000)
        hits = self.tree.closest(origin, direction)
        hit = hits.id >= 0
        self.assertGreater(int(hit.sum()), 100)
        where, normal = hits.positions(), hits.normals()
        self.assertTrue(np.isnan(where[~hit]).all() and np.isnan(normal[~hit]).all() and np.isnan(hits.exits()[~hit]).all())
        centre, radius = self.xyz[hits.id[hit]], self.radius[hits.id[hit]]
        # On the sphere: to the rounding of numbers of this size, whose last bits are 2**-51 apart.
        np.testing.assert_allclose(np.linalg.norm(where[hit] - centre, axis=1), radius, rtol=0, atol=4e-15)
        np.testing.assert_allclose(np.linalg.norm(normal[hit], axis=1), 1, rtol=0, atol=1e-15)
        along = origin[hit].astype(float) + hits.t[hit, None] * direction[hit].astype(float)
        np.testing.assert_allclose(where[hit], along, rtol=0, atol=1e-6)
        # The exit is where the same ray, from inside, ends.
        out = self.tree.closest(where[hit], direction[hit], leaves=hits.id[hit], inside=True)
        ends = out.id == hits.id[hit]  # others lie inside of none here
        np.testing.assert_allclose((hits.exits() - hits.t)[hit][ends], out.t[ends], rtol=0, atol=1e-5)
        # All hits know them too, and of a subset.
        every = self.tree.all_hits(origin, direction)
        first = every.begin[:-1][every.counts > 0]
        np.testing.assert_array_equal(every.positions()[first], where[hit])
        some = bh.Tree(self.spheres, select=self.spheres["charge"] > 0).closest(origin, direction)
        np.testing.assert_array_equal(some.normals()[some.id == hits.id], normal[some.id == hits.id])

    def test_surfaces_of_images_and_far_from_zero(self):
        one = bh.Tree(bh.Spheres([[1, 1, 1]], radius=1, cell=[4, 4, 4]))
        hits = one.closest([14.5, 1, 1], [1, 0, 0], periodic=True)
        self.assertEqual((hits.positions().tolist(), hits.normals().tolist()), ([16, 1, 1], [-1, 0, 0]))
        far = bh.Tree(bh.Spheres([[5e6, 6e6, 0], [5e6 + 3, 6e6, 0]], radius=0.5))
        hits = far.closest([5e6 - 2, 6e6, 0], [1, 0, 0])
        self.assertEqual(hits.positions().tolist(), [5e6 - 0.5, 6e6, 0])

    def test_rays_that_have_changed_are_refused(self):
        origin, direction = rays(300)
        hits = self.tree.closest(origin, direction)
        before = hits.positions()
        origin[:] = np.nan_to_num(before)
        with self.assertRaisesRegex(bh.UsageError, "arrays have changed"):
            hits.normals()
        with self.assertRaisesRegex(bh.UsageError, "know no rays"):
            pickle.loads(pickle.dumps(hits)).normals()
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(hits)).t, hits.t)

    def test_derivatives_are_those_of_differences(self):
        origin, direction = rays(3000)
        hits = self.tree.closest(origin, direction)
        by = hits.derivatives()
        towards = (hits.normals() * direction).sum(axis=1)
        for ray in np.flatnonzero((hits.id >= 0) & (np.abs(towards) > 0.5))[:40]:
            # Centres are kept in float32, 2**-23 apart near 1: a step of h has an error of 2**-24 / h, below 1e-4, times
            # derivatives of the normal of up to 1 / radius squared; h itself costs h times the second derivative.
            i, h = hits.id[ray], 2.0**-10
            for axis in range(3):
                step = np.eye(3)[axis] * h
                ends = [
                    bh.Tree(bh.Spheres(self.xyz[[i]] + sign * step, radius=self.radius[i])).closest(origin[ray], direction[ray])
                    for sign in (1, -1)
                ]
                self.assertAlmostEqual(float(ends[0].t - ends[1].t) / (2 * h), by.t_by_centre[ray, axis], delta=0.02)
                turn = (ends[0].normals() - ends[1].normals()) / (2 * h)
                np.testing.assert_allclose(turn, by.normal_by_centre[ray, :, axis], rtol=0.02, atol=0.2)
            np.testing.assert_allclose(by.t_by_radius[ray], 1 / towards[ray], rtol=1e-12)
        self.assertEqual(by.normal_by_radius.shape, (3000, 3))

    def test_the_first_hits(self):
        origin, direction = rays(2000)
        every, two = self.tree.all_hits(origin, direction), self.tree.all_hits(origin, direction, k=2)
        self.assertEqual(two.counts.tolist(), np.minimum(every.counts, 2).tolist())
        self.assertGreater(int((every.counts > 2).sum()), 10)
        for ray in np.flatnonzero(every.counts > 2)[:20]:
            self.assertEqual(
                two.id[two.begin[ray] : two.begin[ray + 1]].tolist(), every.id[every.begin[ray] : every.begin[ray] + 2].tolist()
            )
        self.assertEqual(two.normals().shape, (len(two.t), 3))

    def test_masks_and_own_spheres(self):
        points = self.xyz
        mask = self.spheres["charge"] > 0
        distances = self.distances(points)
        for given in (mask, np.flatnonzero(mask), "charge > 0"):
            distance, ids = self.tree.nearest(points, mask=given)
            np.testing.assert_array_equal(ids, np.where(mask, distances, np.inf).argmin(axis=1))
        near = self.tree.within(points, 0.3, mask=mask)
        np.testing.assert_array_equal(near.counts, (distances[:, mask] <= 0.3).sum(axis=1))
        np.testing.assert_array_equal(self.tree.count_within(points, 0.3, mask=mask), near.counts)
        # Each sphere's neighbours without itself.
        own = np.arange(len(points))
        others = distances.copy()
        others[own, own] = np.inf
        for k in (1, 3):
            distance, ids = self.tree.nearest(points, k, exclude=own)
            expected = others.argsort(axis=1, kind="stable")[:, :k]
            np.testing.assert_array_equal(ids.reshape(-1, k), expected)
            np.testing.assert_array_equal(distance.reshape(-1, k), np.take_along_axis(others, expected, axis=1))
        near = self.tree.within(points, 0.3, exclude=own)
        np.testing.assert_array_equal(near.counts, (others <= 0.3).sum(axis=1))
        self.assertFalse((near.id == np.repeat(own, near.counts)).any())
        np.testing.assert_array_equal(self.tree.count_within(points, 0.3, exclude=own), near.counts)
        np.testing.assert_array_equal(self.tree.nearest(points, exclude=-1)[1], distances.argmin(axis=1))
        # Fewer spheres than asked for.
        two = bh.Tree(bh.Spheres([[0.0, 0, 0], [5, 0, 0]], radius=1))
        self.assertEqual(two.nearest([[0, 0, 0], [5, 0, 0]], 2, exclude=[0, 1])[1].tolist(), [[1, -1], [0, -1]])
        # Of a periodic set an image of itself is a neighbour.
        one = bh.Tree(bh.Spheres([[0.0, 0, 0]], radius=0.1, cell=[1, 1, 1]))
        self.assertEqual(one.within([0, 0, 0], 1, to="centre", exclude=0).counts.tolist(), [6])
        self.assertEqual(one.nearest([0, 0, 0], to="centre", exclude=0), (1.0, 0))

    def test_pairs(self):
        between = np.linalg.norm(self.xyz[:, None] - self.xyz[None], axis=-1)
        gaps = between - self.radius[:, None] - self.radius[None]
        for to, all_distances in (("centre", between), ("surface", gaps)):
            for reach in (-0.05, 0.0, 0.3):
                pairs = self.tree.pairs(reach, to=to)
                first, second = np.nonzero(np.triu(all_distances <= reach, 1))
                np.testing.assert_array_equal(pairs.first, first)
                np.testing.assert_array_equal(pairs.second, second)
                np.testing.assert_allclose(pairs.distance, all_distances[first, second], rtol=0, atol=1e-12)
        self.assertGreater(len(pairs.first), 100)
        some = self.tree.pairs(0.3, mask="charge > 0")
        part = bh.Tree(self.spheres, select="charge > 0").pairs(0.3)
        np.testing.assert_array_equal(some.second, part.second)
        # A crystal: twelve neighbours for each of its atoms, each pair once.
        a, cube = 1.5, np.array([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]])
        primitive = bh.Tree(bh.Spheres([[0.0, 0, 0]], radius=0.1, cell=a * np.array([[0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]])))
        self.assertEqual(len(primitive.pairs(0.8 * a, to="centre").first), 6)
        crystal = bh.Tree(bh.Spheres(a * cube, radius=0.1, cell=[a] * 3))
        self.assertEqual(len(crystal.pairs(0.8 * a, to="centre").first), 24)

    def test_update(self):
        spheres = bh.Spheres(self.xyz, radius=self.radius, columns={"charge": self.spheres["charge"]})
        tree = bh.Tree(spheres, select="charge > 0", max_prims=2)
        origin, direction = rays(2000)
        kept = tree.closest(origin, direction)
        moved = self.xyz + RNG.normal(size=self.xyz.shape) * 0.1
        tree.update(moved)
        again = bh.Tree(bh.Spheres(moved, radius=spheres.radius), select=spheres["charge"] > 0)
        np.testing.assert_array_equal(tree.closest(origin, direction).t, again.closest(origin, direction).t)
        np.testing.assert_array_equal(tree.spheres["charge"], spheres["charge"])
        kept.positions()  # of the tree that answered
        tree.update(moved, radius=0.5)
        self.assertEqual(set(tree.spheres.radius), {0.5})

    def test_bad_points_name_the_argument(self):
        p = np.zeros((4, 3))
        for call, argument in [
            (lambda: self.tree.nearest(np.zeros((4, 2))), "points"),
            (lambda: self.tree.nearest(p, 0), "k"),
            (lambda: self.tree.nearest(p, 1.5), "k"),
            (lambda: self.tree.nearest(p, within=np.nan), "within"),
            (lambda: self.tree.nearest(p, to="edge"), "to"),
            (lambda: self.tree.within(p, [1, 2]), "limits"),
            (lambda: self.tree.within(p, np.nan), "limits"),
            (lambda: self.tree.overlaps(p, -1), "radii"),
        ]:
            with self.assertRaises(bh.UsageError) as caught:
                call()
            self.assertTrue(str(caught.exception).startswith(argument + ":"), caught.exception)
        with self.assertRaisesRegex(bh.InputError, "point 2"):
            self.tree.nearest([[0, 0, 0], [1, 0, 0], [np.nan, 0, 0]])
        with self.assertRaisesRegex(bh.UsageError, "nearest needs the wide engine"):
            bh.Tree(self.spheres, engine="reference").nearest(p)

    def test_errors_name_the_argument(self):
        o, d = np.zeros((4, 3)), np.ones((4, 3))
        for call, argument in [
            (lambda: self.tree.closest(np.zeros((4, 2)), d), "origins"),
            (lambda: self.tree.closest(o, np.ones((5, 3))), "directions"),
            (lambda: self.tree.closest(o, "abc"), "directions"),
            (lambda: self.tree.closest(o, d, t_min=[0, 1]), "t_min"),
            (lambda: self.tree.closest(o, d, t_max="far"), "t_max"),
            (lambda: self.tree.closest(o, d, leaves=300), "leaves"),
            (lambda: self.tree.closest(o, d, leaves=0.5), "leaves"),
            (lambda: self.tree.closest(o, d, inside=[True]), "inside"),
            (lambda: self.tree.closest(o[:, None], np.ones((4, 3, 3))[:, :2], t_max=np.ones(4)), "t_max"),
            (lambda: self.tree.all_hits(o, d, k=0), "k"),
            (lambda: self.tree.pairs(np.nan), "reach"),
            (lambda: self.tree.pairs([1, 2]), "reach"),
            (lambda: self.tree.nearest(o, exclude=[0, 1]), "exclude"),
            (lambda: self.tree.nearest(o, exclude=300), "exclude"),
            (lambda: self.tree.nearest(o, mask=[True]), "mask"),
            (lambda: self.tree.within(o, 1, mask=[300]), "mask"),
            (lambda: self.tree.within(o, 1, mask=[0, -1]), "mask"),
            (lambda: bh.Tree(self.spheres, select=[0, -1]), "select"),
            (lambda: self.tree.count_within(o, np.nan), "limits"),
            (lambda: self.tree.contains(o, mask="mass > 1"), "mask"),
            (lambda: self.tree.update(o), "xyz"),
            (lambda: self.tree.update(self.xyz, [1, 2]), "radius"),
            (lambda: bh.Tree(self.spheres, select=np.ones(3, bool)), "select"),
            (lambda: self.tree.closest(o, d, order="best"), "order"),
            (lambda: bh.Tree(self.spheres, engine="fast"), "engine"),
            (lambda: bh.Tree(self.spheres, max_prims=0), "max_prims"),
            (lambda: bh.Tree(self.spheres, threads=-1), "threads"),
            (lambda: bh.Tree(self.spheres, select="mass > 1"), "select"),
            (lambda: bh.Tree([1, 2]), "spheres"),
        ]:
            with self.assertRaises(bh.UsageError) as caught:
                call()
            self.assertTrue(str(caught.exception).startswith(argument + ":"), caught.exception)
        with self.assertRaisesRegex(bh.UsageError, "all_hits needs the wide engine"):
            bh.Tree(self.spheres, engine="reference").all_hits(o, d)

    def test_statistics(self):
        import json
        import os
        import subprocess

        out = subprocess.run([os.environ["BIHIVE"], "stats", "demo", "--json", "--max-prims", "3"], capture_output=True, text=True)
        stated = json.loads(out.stdout)
        found = bh.stats(bh.read("demo"), max_prims=3)
        self.assertEqual(found.keys(), stated.keys())
        for key in ["spheres", "inner_nodes", "leaves"]:
            self.assertEqual(found[key], stated[key])


class Interrupts(unittest.TestCase):
    """Ctrl-C, or any signal whose handler throws, ends a query within some hundredths of a second of work."""

    def test_every_query_ends_soon(self):
        class Enough(Exception):
            pass

        def throw(*_):
            raise Enough

        rng = np.random.default_rng(3)
        count = 1_500_000
        xyz, origins = rng.random((200_000, 3)), rng.random((count, 3)).astype(np.float32)
        spheres = bh.Spheres(xyz, radius=0.004, cell=[1, 1, 1])
        few = bh.Spheres(xyz[:4000], radius=0.01)
        directions = rng.normal(size=(count, 3)).astype(np.float32)
        tree, points = bh.Tree(spheres, threads=1), rng.random((count, 3))
        hits = tree.closest(origins, directions)
        queries = {
            "closest": lambda: tree.closest(origins, directions),
            "closest, periodic": lambda: tree.closest(origins, directions, t_max=2, periodic=True),
            "occluded": lambda: tree.occluded(origins, directions),
            "all_hits": lambda: tree.all_hits(origins, directions),
            "nearest": lambda: tree.nearest(points, 8),
            "within": lambda: tree.within(points, 0.03),
            "count_within": lambda: tree.count_within(points, 0.05),
            "pairs": lambda: tree.pairs(0.05),
            "derivatives": lambda: hits.derivatives(),
            "brute": lambda: bh.Tree(few, engine="brute", threads=1).closest(origins, directions),
            "reference": lambda: bh.Tree(few, engine="reference", threads=1).closest(origins, directions),
        }
        before = signal.signal(signal.SIGPROF, throw)
        self.addCleanup(signal.signal, signal.SIGPROF, before)
        ended = 0
        for name, query in queries.items():
            with self.subTest(name):
                begin, wait_s = time.process_time(), 0.1  # of processor time
                signal.setitimer(signal.ITIMER_PROF, wait_s)
                try:
                    query()
                except Enough:
                    self.assertLess(time.process_time() - begin - wait_s, 0.5)
                    ended += 1
                finally:
                    signal.setitimer(signal.ITIMER_PROF, 0)
        self.assertGreaterEqual(ended, 6)  # fast machines have answered others before


if __name__ == "__main__":
    unittest.main()
