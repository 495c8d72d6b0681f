"""bihive.compare: the dictionary of the schema, the same counts on any number of threads, and what it refuses."""

import json
import os
import unittest

import bihive as bh
import numpy as np

SOURCE = os.environ.get("BIHIVE_SOURCE", os.path.join(os.path.dirname(__file__), "../.."))


def some_spheres(count=300):
    return bh.Spheres(np.random.default_rng(3).normal(size=(count, 3)), radius=0.1)


class Compare(unittest.TestCase):
    def test_it_has_the_schema(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("jsonschema is not installed")
        with open(os.path.join(SOURCE, "docs/comparison.schema.json")) as file:
            schema = json.load(file)
        found = bh.compare(some_spheres(), count=256, threads=[1, 2])
        jsonschema.Draft7Validator(schema).validate(found)
        self.assertTrue(found["same_bits"])
        self.assertEqual(found["threads"], [1, 2])
        self.assertEqual(len(found["structures"]), 10)

    def test_counts_do_not_depend_on_threads(self):
        def counts(threads):
            found = bh.compare(some_spheres(), structures=["kd-sah", "octree"], rays=("random", "points"), count=200, threads=threads)
            return [(one["name"], one["kinds"]) for one in found["structures"]]

        self.assertEqual(counts(1), counts(2))
        self.assertEqual([name for name, _ in counts(1)], ["kd-sah", "octree"])

    def test_refusals(self):
        spheres = some_spheres(3)
        for arguments, part in (
            ({"structures": ["tree"]}, "structures: expected one of wide, bih"),
            ({"structures": "bih"}, "structures: expected names"),
            ({"structures": ["bih", "bih"]}, "twice"),
            ({"rays": []}, "rays: there is no name"),
            ({"rays": ["x"]}, "rays: expected one of primary"),
            ({"count": 0}, "count"),
            ({"threads": -1}, "threads"),
            ({"threads": []}, "threads: expected 1 to 16 numbers"),
        ):
            with self.assertRaises(bh.UsageError) as raised:
                bh.compare(spheres, **arguments)
            self.assertIn(part, str(raised.exception))
        with self.assertRaises(bh.UsageError):
            bh.compare(np.zeros((2, 3)))


class Tune(unittest.TestCase):
    def test_it_has_the_schema(self):
        try:
            import jsonschema
        except ImportError:
            self.skipTest("jsonschema is not installed")
        with open(os.path.join(SOURCE, "docs/tuning.schema.json")) as file:
            schema = json.load(file)
        found = bh.tune(some_spheres(), structure="kd-sah", rays=["random", "points"], count=64)
        jsonschema.Draft7Validator(schema).validate(found)
        self.assertEqual(found["structure"], "kd-sah")
        self.assertEqual(list(found["queries"]), ["random", "points"])
        self.assertGreaterEqual(found["gain"], 1)

    def test_its_limits_are_those_of_a_tree(self):
        found = bh.tune(some_spheres(), rays=["random"], count=64)
        limits = {name.replace("-", "_"): value for name, value in found["best"]["parameters"].items()}
        tree = bh.Tree(some_spheres(), **limits)
        self.assertEqual(tree.closest([[-9.0, 0, 0]], [1, 0, 0]).id.shape, (1,))

    def test_refusals(self):
        for arguments, part in (
            ({"structure": "grid"}, "structure: expected one of wide, bih"),
            ({"rays": ["x"]}, "rays: expected one of primary"),
            ({"count": 0}, "count"),
            ({"threads": [1, 2]}, "threads"),
        ):
            with self.assertRaises(bh.UsageError) as raised:
                bh.tune(some_spheres(3), **arguments)
            self.assertIn(part, str(raised.exception))
        with self.assertRaises(bh.UsageError):
            bh.tune(bh.Spheres(np.zeros((0, 3)), radius=1))


if __name__ == "__main__":
    unittest.main()
