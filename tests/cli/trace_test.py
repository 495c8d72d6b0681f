"""bihive trace: rays in, t and id out."""

import numpy
from program import ProgramTest, main

INF = numpy.inf
NAN = numpy.nan


class Trace(ProgramTest):
    def setUp(self):
        super().setUp()
        # Sphere 0 around the origin, 1 behind it, 2 exactly at the place of 1, 3 of radius 0 in front of all.
        self.write("s.csv", "x,y,z,r\n0,0,0,1\n0,0,-10,2\n0,0,-10,2\n0,0,50,0\n")

    def trace(self, rays, *options, given="s.csv", dtype=numpy.float32, warning=None):
        numpy.save(self.path("rays.npy"), numpy.array(rays, dtype=dtype))
        done = self.run_bihive("trace", given, "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        if warning is None:
            self.assertEqual(done.stderr, "")
        else:
            self.assertRegex(done.stderr, r"\Abihive: warning: " + warning + r"[^\n]*\n\Z")
        t, ids = numpy.load(self.path("t.npy")), numpy.load(self.path("id.npy"))
        self.assertEqual((t.dtype, ids.dtype), (numpy.float64, numpy.int64))
        self.assertEqual((t.shape, ids.shape), ((len(rays),), (len(rays),)))
        return t.tolist(), ids.tolist()

    def test_hits_and_misses(self):
        rays = [[0, 0, 100, 0, 0, -1], [0, 0, -100, 0, 0, 2], [0, 5, 100, 0, 0, -1], [0, 1.5, 100, 0, 0, -1]]
        t, ids = self.trace(rays)
        self.assertEqual(ids, [0, 1, -1, 1])
        self.assertEqual(t[:3], [99, 44, INF])
        self.assertAlmostEqual(t[3], 110 - (4 - 1.5**2) ** 0.5)

    def test_segments_include_both_ends(self):
        ray = [0, 0, 100, 0, 0, -1]
        t, ids = self.trace([ray + [99, INF], ray + [99.5, INF], ray + [0, 99], ray + [0, 98.5], ray + [101.5, 108]])
        self.assertEqual(ids, [0, 0, 0, -1, 1])
        self.assertEqual(t, [99, 101, 99, INF, 108])

    def test_negative_t(self):
        t, ids = self.trace([[0, 0, 100, 0, 0, 1, -1000, 1000]])
        self.assertEqual((t, ids), ([-112], [1]))

    def test_from_inside_the_far_side_is_hit(self):
        self.assertEqual(self.trace([[0, 0, 0, 1, 0, 0]]), ([1], [0]))

    def test_far_from_0_rays_of_float64_keep_their_digits(self):
        self.write("far.csv", "x,y,z,r\n500000.03,5400000.01,100,0.05\n500000.23,5400000.01,100,0.05\n")
        rays = [[500000.03, 5400000.01, 90, 0, 0, 1], [500000.23, 5400000.01, 90, 0, 0, 1], [500000.13, 5400000.01, 90, 0, 0, 1]]
        t, ids = self.trace(rays, given="far.csv", dtype=numpy.float64)
        self.assertEqual(ids, [0, 1, -1])
        self.assertAlmostEqual(t[0], 9.95, places=6)

    def test_periodic_rays_see_images(self):
        self.write("c.xyz", '1\nLattice="4 0 0 0 4 0 0 0 4"\nX 1 1 1\n')
        rays = [[-9, 1, 1, 1, 0, 0], [100.5, 1, 1, 1, 0, 0]]
        alone = self.trace(rays, "--radius", "1", given="c.xyz")
        self.assertEqual(alone, ([9, INF], [0, -1]))  # as in pictures
        self.assertEqual(self.trace(rays, "--radius", "1", "--periodic", given="c.xyz"), ([1, 1.5], [0, 0]))
        self.assertEqual(self.trace(rays, "--radius", "1", "--periodic", "--any", given="c.xyz"), ([0, 0], [0, 0]))
        numpy.save(self.path("rays.npy"), numpy.array([[-9, 1, 1, 1, 0, 0], [0, 3, 3, 1, 0, 0]], numpy.float32))
        options = ["--rays", "rays.npy", "--t", "a.npy", "--id", "b.npy", "--periodic"]
        self.assertIn("ray 1 passes more than 16384 periodic cells", self.fail_input("trace", "c.xyz", "--radius", "1", *options))
        self.assertIn("no periodic cell", self.fail_usage("trace", "s.csv", *options))
        self.assertIn("wide engine", self.fail_usage("trace", "c.xyz", "--radius", "1", "--engine", "brute", *options))
        self.assertIn("--replicate", self.fail_usage("trace", "c.xyz", "--radius", "1", "--replicate", "2x1x1", *options))

    def test_any(self):
        rays = [[0, 0, 100, 0, 0, -1], [0, 5, 100, 0, 0, -1]]
        self.assertEqual(self.trace(rays, "--any"), ([0, INF], [0, -1]))

    def test_rays_that_are_none_hit_nothing_and_are_counted(self):
        good = [0, 0, 100, 0, 0, -1, 0, INF]
        bad = [
            [NAN, 0, 100, 0, 0, -1, 0, INF],
            [0, 0, 100, 0, NAN, -1, 0, INF],
            [0, 0, INF, 0, 0, -1, 0, INF],
            [0, 0, 100, 0, 0, -INF, 0, INF],
            [0, 0, 100, 0, 0, 0, 0, INF],
            [0, 0, 100, 0, 0, -1, NAN, INF],
            [0, 0, 100, 0, 0, -1, 0, NAN],
            [0, 0, 100, 0, 0, -1, 2, 1],
        ]
        for options in [[], ["--any"], ["--plane"], ["--any", "--plane"]]:
            t, ids = self.trace(bad + [good], *options, warning="8 of 9 rays")
            self.assertEqual(ids, [-1] * 8 + [0])
            self.assertEqual(t, [INF] * 8 + [0 if "--any" in options else 99])

    def test_the_thesis_plane_is_below(self):
        rays = [[30, 0, 0, 0, -1, 0], [0, 0, 0.5, 0, -1, 0], [30, 0, 0, 0, 1, 0]]
        self.assertEqual(self.trace(rays)[1], [-1, 0, -1])
        t, ids = self.trace(rays, "--plane")
        self.assertEqual(ids, [-2, 0, -1])
        self.assertEqual(t[0], 20)
        self.assertEqual(self.trace(rays, "--plane", "--any"), ([0, 0, INF], [0, 0, -1]))

    def test_a_scene_has_its_own_plane(self):
        plane = '"plane": {"point": [0, -3, 0], "normal": [0, 2, 0]}'
        self.write("s.json", '{"bihive_scene": 1, "spheres": [[0, 0, 0, 1], [20, -4, 0, 1]], ' + plane + "}")
        rays = [[30, 0, 0, 0, -1, 0], [20, 0, 0, 0, -1, 0]]
        t, ids = self.trace(rays, "--plane", given="s.json")
        # If plane and sphere are equally far, the sphere is hit.
        self.assertEqual((t, ids), ([3, 3], [-2, 1]))
        self.assertEqual(self.trace(rays, given="s.json"), ([INF, 3], [-1, 1]))

    def random_rays(self, count):
        random = numpy.random.default_rng(5)
        origins = random.uniform(-60, 60, (count, 3))
        targets = random.uniform(-20, 20, (count, 3))
        return numpy.hstack([origins, targets - origins]).astype(numpy.float32)

    def test_engines_threads_and_trees_give_the_same_bytes(self):
        numpy.save(self.path("rays.npy"), self.random_rays(20000))
        answers = set()
        for options in [
            [],
            ["--engine", "reference", "--threads", "1"],
            ["--engine", "brute", "--threads", "2"],
            ["--engine", "wide", "--max-prims", "100"],
            ["--engine", "reference", "--max-depth", "4"],
            ["--threads", "5", "--max-prims", "1"],
            ["--max-depth", "4"],
        ]:
            self.succeed(
                "trace", "scenario3", "--count", "500", "--plane", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy", *options
            )
            answers.add((self.read("t.npy"), self.read("id.npy")))
        self.assertEqual(len(answers), 1)
        ids = numpy.load(self.path("id.npy"))
        self.assertGreater((ids >= 0).mean(), 0.2)
        self.assertGreater((ids == -2).sum(), 0)

    def test_no_rays(self):
        for columns in [6, 8]:
            self.assertEqual(self.trace(numpy.zeros((0, columns))), ([], []))

    def test_other_layouts_of_float32_are_read(self):
        rays = self.random_rays(100)
        expected = self.trace(rays)
        numpy.save(self.path("f.npy"), numpy.asfortranarray(rays))
        numpy.save(self.path("b.npy"), rays.astype(">f4"))
        for name in ["f.npy", "b.npy"]:
            self.succeed("trace", "s.csv", "--rays", name, "--t", "t.npy", "--id", "id.npy")
            self.assertEqual(numpy.load(self.path("t.npy")).tolist(), expected[0])

    def test_the_examples_of_the_help_work(self):
        numpy.save(self.path("rays.npy"), self.random_rays(10))
        examples = self.succeed("trace", "--help").split("Examples:\n")[1].strip().splitlines()
        self.assertEqual(len(examples), 2)
        for example in examples:
            self.succeed(*example.split()[1:])

    def test_wrong_rays(self):
        def complaint(array):
            numpy.save(self.path("rays.npy"), array)
            return self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy")

        self.assertIn("<i8", complaint(numpy.zeros((3, 6), dtype=int)))
        self.assertIn("<i4", complaint(numpy.zeros((3, 6), dtype=numpy.int32)))
        self.assertIn("(3, 7)", complaint(numpy.zeros((3, 7), dtype=numpy.float32)))
        self.assertIn("(6)", complaint(numpy.zeros(6, dtype=numpy.float32)))
        complaint(numpy.zeros((1, 3, 6), dtype=numpy.float32))
        self.write("rays.npy", "no array")
        self.assertIn("rays.npy", self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy"))
        self.assertIn("nope.npy", self.fail_input("trace", "demo", "--rays", "nope.npy", "--t", "t.npy", "--id", "id.npy"))

    def test_both_files_or_none(self):
        numpy.save(self.path("rays.npy"), self.random_rays(10))
        self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "nowhere/id.npy")
        self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "/dev/full")
        self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", "/dev/full", "--id", "id.npy")


if __name__ == "__main__":
    main()
