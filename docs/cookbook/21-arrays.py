# Arrays in, picture out
# An array of centres is enough; radius and colour may be arrays too.
import numpy as np
import bihive as bh

t = np.linspace(0, 12 * np.pi, 1500)
xyz = np.column_stack([(8 + 2.5 * np.cos(t)) * np.cos(t / 6), 2.5 * np.sin(t), (8 + 2.5 * np.cos(t)) * np.sin(t / 6)])
s = bh.Spheres(xyz, radius=0.25 + 0.15 * np.sin(3 * t), colour=bh.colour_map(t, "viridis"))
bh.render(s, size=(480, 360), turn=(0, 35), style="studio").save("21-arrays.png")
