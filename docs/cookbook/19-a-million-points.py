# A million points
# A strange attractor (Clifford's, with a third coordinate) as a set of a million small balls.
import numpy as np
import bihive as bh

a, b, c, d = -1.4, 1.6, 1.0, 0.7
rng = np.random.default_rng(1)
x, y = rng.uniform(-1, 1, (2, 10000))
points = []
for step in range(110):
    x, y = np.sin(a * y) + c * np.cos(a * x), np.sin(b * x) + d * np.cos(b * y)
    if step >= 10:
        points.append(np.column_stack([x, y, np.sin(x * y)]))
s = bh.Spheres(np.concatenate(points), radius=0.004)
bh.render(s, size=(480, 360), turn=(-25, 20), background="#0b1020", fog=0).save("19-a-million-points.png")
