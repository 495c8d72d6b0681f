# The holes, not the balls
# The largest empty balls between the atoms: points of a grid, each with its distance to the nearest surface.
import numpy as np
import bihive as bh

s = bh.read("demo")
s = s[bh.select(s, "protein")]
low, high = s.bounds
grid = np.stack(np.meshgrid(*[np.arange(low[i], high[i], 1.0) for i in range(3)], indexing="ij"), axis=-1).reshape(-1, 3)
room, _ = bh.Tree(s).nearest(grid)
inside = bh.Tree(s).overlaps(grid, 6.0).counts > 70         # where atoms are all around
holes = inside & (room > 1.0)
both = bh.Spheres(
    np.concatenate([s.xyz, grid[holes]]),
    radius=np.concatenate([s.radius * 0.5, room[holes]]),
    columns={"hole": np.concatenate([np.zeros(len(s)), np.ones(holes.sum())])},
)
looks = [bh.Look("hole == 0", colour="#c8d0d8", opacity=0.35), bh.Look("hole == 1", colour="#d04020")]
bh.render(both, size=(480, 360), looks=looks).save("24-holes.png")
