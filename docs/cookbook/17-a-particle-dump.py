# A LAMMPS dump, coloured by speed
# The dump is written here so that the recipe runs anywhere; `bihive render run.dump` reads yours in the same way. Expressions such as `sqrt(vx^2 + vy^2)` are for selections; a colour wants a column, so the speed is one.
import numpy as np
import bihive as bh

rng = np.random.default_rng(7)
place = np.stack(np.meshgrid(*[np.arange(14)] * 3), axis=-1).reshape(-1, 3) + rng.normal(0, 0.12, (14**3, 3))
v = rng.normal(0, 1, (14**3, 3)) + np.array([0, 3, 0]) * np.exp(-((place[:, :1] - 6.5) ** 2) / 8)
with open("run.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n%d\n" % len(place))
    file.write("ITEM: BOX BOUNDS pp pp pp\n0 14\n0 14\n0 14\nITEM: ATOMS id type x y z vx vy vz\n")
    for i, row in enumerate(np.hstack([place, v])):
        file.write("%d 1 %.5f %.5f %.5f %.4f %.4f %.4f\n" % (i + 1, *row))

s = bh.read("run.dump", radius=0.5)
speed = np.sqrt(s["vx"] ** 2 + s["vy"] ** 2 + s["vz"] ** 2)
s = bh.Spheres(s.xyz, radius=s.radius, cell=s.cell, columns={"speed": speed})
bh.render(s, size=(480, 360), colour_by="speed:coolwarm", legend=True, view_from="iso", cell=True).save("17-a-particle-dump.png")
