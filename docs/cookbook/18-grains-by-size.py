# Grains by size
# Balls of many sizes fall into a box, one on top of the others: each new one takes the lowest of some free positions.
# `Tree.overlaps` finds what is in the way.
import numpy as np
import bihive as bh

rng = np.random.default_rng(3)
centres, radii = [], []
for r in np.sort(rng.pareto(2.5, 260) * 0.35 + 0.3)[::-1].clip(max=1.6):
    tries = np.column_stack([rng.uniform(r, 8 - r, 400), rng.uniform(r, 8, 400), rng.uniform(r, 8 - r, 400)])
    if centres:
        free = bh.Tree(bh.Spheres(np.array(centres), radius=np.array(radii))).overlaps(tries, r).counts == 0
        tries = tries[free]
    if len(tries):
        centres.append(tries[np.argmin(tries[:, 1])])
        radii.append(r)
s = bh.Spheres(np.array(centres), radius=np.array(radii), columns={"size": np.array(radii)})
bh.render(s, size=(480, 360), colour_by="size:cividis:0.3,1.6:log", legend=True, turn=(30, 20), ao=True).save("18-grains-by-size.png")
