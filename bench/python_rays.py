#!/usr/bin/python3
"""Rays per second from Python, and the memory of Spheres of a large array.

usage: PYTHONPATH=build-release/python bench/python_rays.py [THREADS]       all by default

Two million random rays at the bundled molecule, nine times in turn from arrays of float64 and float32 in C order, which are copied
into columns, and from columns, which the engine reads where they lie; medians. Then Spheres of 62.5 million rows of float32.
"""

import resource
import statistics
import sys
import time

import numpy as np

begin = time.perf_counter()
import bihive as bh  # noqa: E402

print(f"import: {time.perf_counter() - begin:.3f} s with NumPy loaded")

rng = np.random.default_rng(1)
count = 2_000_000
spheres = bh.read("demo")
low, high = spheres.bounds
wide = rng.uniform(low - 20, high + 20, (count, 3)), rng.uniform(low, high, (count, 3))
wide = wide[0], wide[1] - wide[0]
single = tuple(array.astype(np.float32) for array in wide)
tree = bh.Tree(spheres, threads=int(sys.argv[1]) if len(sys.argv) > 1 else 0)
orders = {"C order, float64": wide, "C order, float32": single, "columns": tuple(np.asfortranarray(array) for array in single)}
rates = {name: [] for name in orders}
for _ in range(9):
    for name, rays in orders.items():
        begin = time.perf_counter()
        tree.closest(*rays)
        rates[name].append(count / (time.perf_counter() - begin) / 1e6)
for name, of_order in rates.items():
    print(f"{name}: {statistics.median(of_order):.1f} million rays per second ({min(of_order):.1f} to {max(of_order):.1f})")


def peak_bytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


rows = np.ones((62_500_000, 4), np.float32)
rows[:, 0] = np.arange(len(rows), dtype=np.float32)
before = peak_bytes()
large = bh.Spheres(rows)
print(f"array {rows.nbytes / 1e9:.2f} GB: peak {before / 1e9:.2f} GB before, {peak_bytes() / 1e9:.2f} GB with Spheres")
