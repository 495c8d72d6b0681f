# A galaxy of points
# Points as faint dots of light: the picture is bright where many are behind each other. A few far away change neither the camera nor the light.
import numpy as np
import bihive as bh

rng = np.random.default_rng(3)
n = 400_000
r = rng.exponential(3, n)
angle = 2.4 * np.log(1 + r) + np.pi * rng.integers(0, 2, n) + rng.normal(0, 0.35, n)
disc = np.column_stack([r * np.cos(angle), r * np.sin(angle), rng.normal(0, 0.15, n)])
halo = rng.normal(size=(60_000, 3)) * rng.exponential(2, (60_000, 1))
s = bh.Spheres(np.concatenate([disc, halo]), radius=0.03)
bh.render(s, size=(480, 360), style="density", turn=(0, -60)).save("35-a-galaxy-of-points.png")
