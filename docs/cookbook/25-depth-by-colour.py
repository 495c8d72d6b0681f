# The numbers behind a picture
# `layer` gives depth, normals, ids and attributes as arrays. Here the atoms that are seen, and how many pixels each fills, decide what is bright.
import numpy as np
import bihive as bh

s = bh.read("demo")
s = s[bh.select(s, "not water")]
ids = bh.render(s, size=(960, 720), samples=1, ao=False).layer("id")
pixels = np.bincount(ids[ids >= 0].astype(int).ravel(), minlength=len(s))
seen = bh.Spheres(s.xyz, radius=s.radius, columns={"pixels": pixels})
looks = [bh.Look("all", colour_by="pixels:viridis")]
bh.render(seen, size=(480, 360), looks=looks, legend=True, turn=(60, 0)).save("25-depth-by-colour.png")
