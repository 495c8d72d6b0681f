# Who has how many neighbours
# `Tree.within` counts the centres near each centre. The number becomes a column and the column a colour: grains of a crystal, and the disorder between them.
import numpy as np
import bihive as bh

rng = np.random.default_rng(5)
fcc = np.stack(np.meshgrid(*[np.arange(-9, 9)] * 3), axis=-1).reshape(-1, 3)
fcc = fcc[fcc.sum(axis=1) % 2 == 0] / np.sqrt(2)
tilt = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
left, right = fcc[fcc[:, 0] < -0.2], (fcc @ tilt)[(fcc @ tilt)[:, 0] > 0.2]
xyz = np.concatenate([left, right])
xyz = xyz[np.abs(xyz).max(axis=1) < 5.5] + 0.0
tree = bh.Tree(bh.Spheres(xyz, radius=0.5))
neighbours = tree.within(xyz, 1.2, to="centre").counts - 1
s = bh.Spheres(xyz, radius=0.5, columns={"neighbours": neighbours})
bh.render(s, size=(480, 360), colour_by="neighbours:magma:3,12", legend=True, turn=(20, 25)).save("22-coordination.png")
