#!/usr/bin/python3
"""All hits of scattered rays beside their closest hits: processor time of one thread, in turn.

usage: PYTHONPATH=build-release/python bench/python_hits.py [SPHERES...]

Rays from random points of a box in random directions, among 1,000, 100,000 and a million (or SPHERES) uniform spheres that fill a
tenth of it; 32,768 and 500,000 rays in a call. The median of five turns.
"""

import statistics
import sys
import time

import bihive as bh
import numpy as np

rng = np.random.default_rng(38)
for count in [int(one) for one in sys.argv[1:]] or [1000, 100_000, 1_000_000]:
    spheres = bh.Spheres(rng.random((count, 3)), radius=(0.1 / count / (4 / 3 * np.pi)) ** (1 / 3))
    tree = bh.Tree(spheres, threads=1)
    for rays in [32768, 500_000]:
        origins, directions = rng.random((rays, 3)).astype(np.float32), rng.normal(size=(rays, 3)).astype(np.float32)
        seconds = ([], [])
        for _ in range(5):
            for ask, taken in zip((tree.closest, tree.all_hits), seconds):
                begin = time.process_time()
                answer = ask(origins, directions)
                taken.append(time.process_time() - begin)
        one, all_of_them = (statistics.median(taken) / rays * 1e9 for taken in seconds)
        ratio = statistics.median(b / a for a, b in zip(*seconds))
        hits = len(answer.t) / rays
        print(f"{count} spheres, {rays} rays: closest {one:.0f} ns, all hits {all_of_them:.0f} ns ({hits:.1f} per ray): {ratio:.1f} times")
