#!/usr/bin/python3
"""Points and pairs beside SciPy's cKDTree: processor time of one thread, in one run, each in turn.

usage: PYTHONPATH=build-release/python bench/python_points.py [POINTS...]

1,000, 100,000 and a million (or POINTS) uniform points in a box: building, all pairs within a radius that holds ten, their numbers,
the nearest one and the nearest eight of each point; and a thousand single questions. The median of five turns; SciPy's time over ours.
"""

import statistics
import sys
import time

import bihive as bh
import numpy as np
from scipy.spatial import cKDTree

for count in [int(one) for one in sys.argv[1:]] or [1000, 100_000, 1_000_000]:
    xyz = np.random.default_rng(38).random((count, 3))
    radius = (10 / count / (4 / 3 * np.pi)) ** (1 / 3)
    spheres = bh.Spheres(xyz, radius=radius / 10)
    tree, others = bh.Tree(spheres, threads=1), cKDTree(spheres.xyz)
    single = xyz[:1000]
    questions = {
        "building": (lambda: bh.Tree(spheres, threads=1), lambda: cKDTree(spheres.xyz)),
        "pairs": (
            lambda: len(tree.pairs(radius, to="centre").first),
            lambda: len(others.query_pairs(radius, output_type="ndarray")),
        ),
        "numbers within": (
            lambda: tree.count_within(spheres.xyz, radius, to="centre").sum(),
            lambda: others.query_ball_point(spheres.xyz, radius, return_length=True).sum(),
        ),
        "nearest": (lambda: tree.nearest(spheres.xyz, to="centre")[1].sum(), lambda: others.query(spheres.xyz)[1].sum()),
        "nearest eight": (lambda: tree.nearest(spheres.xyz, 8, to="centre")[1].sum(), lambda: others.query(spheres.xyz, 8)[1].sum()),
        "single nearest": (lambda: [tree.nearest(point, to="centre") for point in single], lambda: [others.query(point) for point in single]),
        "single within": (
            lambda: [tree.within(point, radius, to="centre") for point in single],
            lambda: [others.query_ball_point(point, radius) for point in single],
        ),
    }
    for name, both in questions.items():
        seconds = ([], [])
        for _ in range(5):
            for ask, taken in zip(both, seconds):
                begin = time.process_time()
                ask()
                taken.append(time.process_time() - begin)
        ours, theirs = (statistics.median(taken) * 1000 for taken in seconds)
        ratio = statistics.median(b / a for a, b in zip(*seconds))
        print(f"{count} points, {name}: {ours:.2f} ms, cKDTree {theirs:.2f} ms: {ratio:.2f} times as fast")
