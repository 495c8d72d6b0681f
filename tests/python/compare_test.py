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


if __name__ == "__main__":
    unittest.main()
