#!/usr/bin/python3
"""The cost of periodic images for points and rays: processor time with them over that without, in one run.

usage: PYTHONPATH=build-release/python bench/python_periodic.py [POINTS]

A million (or POINTS) uniform points in a box, each asked for all centres within a radius that holds ten, and for the nearest eight,
by one thread, five times in turn with the box's images and without; and a tenth as many rays of a fifth of the box. Then the
same as a selection: within that radius of a tenth.
"""

import statistics
import sys
import time

import bihive as bh
import numpy as np

count = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
rng = np.random.default_rng(36)
places = rng.random((count, 3))
radius = (10 / count / (4 / 3 * np.pi)) ** (1 / 3)
spheres = bh.Spheres(places, radius=radius / 10, cell=[1, 1, 1], columns={"tenth": np.arange(count) % 10})
directions = rng.normal(size=(count // 10, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
trees = {periodic: bh.Tree(spheres, periodic=periodic, threads=1) for periodic in (False, True)}
questions = {
    "within": lambda periodic: trees[periodic].within(places, radius, to="centre").counts.mean(),
    "nearest eight": lambda periodic: trees[periodic].nearest(places, 8, to="centre")[0][:, -1].mean(),
    # The ends of rays inside of the box, so that both hit about as much.
    "a tenth of rays": lambda periodic: np.isfinite(
        trees[periodic].closest(places[: count // 10], directions, t_max=0.2, periodic=periodic)[0]
    ).mean(),
    "selection": lambda periodic: bh.select(spheres, f"within {radius} of tenth = 0", periodic=periodic).sum(),
}
for name, ask in questions.items():
    seconds = {False: [], True: []}
    answers = {}
    for _ in range(5):
        for periodic, taken in seconds.items():
            begin = time.process_time()
            answers[periodic] = ask(periodic)
            taken.append(time.process_time() - begin)
    ratio = statistics.median(b / a for a, b in zip(seconds[False], seconds[True]))
    alone, images = (statistics.median(seconds[periodic]) for periodic in (False, True))
    print(f"{name}: {alone:.3f} s without images ({answers[False]:.6g}), {images:.3f} s with ({answers[True]:.6g}): {ratio:.2f} times")
