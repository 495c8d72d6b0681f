# How much sky each sphere sees
# Rays from every atom's surface into 100 directions: the share that leaves is how exposed the atom is.
import numpy as np
import bihive as bh

s = bh.read("demo")
s = s[bh.select(s, "not water")]
k = np.arange(100) + 0.5
z, turn = 1 - 2 * k / 100, np.pi * (1 + 5**0.5) * k
ball = np.column_stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z])
origins = (s.xyz[:, None] + 1.001 * s.radius[:, None, None] * ball).reshape(-1, 3)
hidden = bh.Tree(s).occluded(origins, np.tile(ball, (len(s), 1))).reshape(-1, 100)
seen = bh.Spheres(s.xyz, radius=s.radius, columns={"sky": 1 - hidden.mean(axis=1)})
bh.render(seen, size=(480, 360), colour_by="sky:magma", legend=True, view_from="iso").save("23-the-sky-above.png")
