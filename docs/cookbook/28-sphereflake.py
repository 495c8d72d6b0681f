# A sphereflake
# Nine balls on each ball (Haines, 1987), five levels: 66,430 balls that touch.
import numpy as np
import bihive as bh

around = np.array([[np.cos(t), 0, np.sin(t)] for t in np.arange(6) * np.pi / 3]
                  + [[np.cos(t) * 0.58, 0.816, np.sin(t) * 0.58] for t in np.pi / 6 + np.arange(3) * 2 * np.pi / 3])


def turned(axis):
    """A matrix whose second row is the axis."""
    other = np.array([1.0, 0, 0]) if abs(axis[0]) < 0.9 else np.array([0, 0, 1.0])
    u = np.cross(axis, other)
    u /= np.linalg.norm(u)
    return np.array([u, axis, np.cross(u, axis)])


level = [(np.zeros(3), 1.0, np.array([0, 1.0, 0]))]
rows = []
for depth in range(6):
    rows += [(*c, r, depth) for c, r, _ in level]
    if depth < 5:
        level = [(c + d * r * 4 / 3, r / 3, d) for c, r, axis in level for d in around @ turned(axis)]
rows = np.array(rows)
s = bh.Spheres(rows[:, :3], radius=rows[:, 3], columns={"level": rows[:, 4]})
bh.render(s, size=(480, 360), colour_by="level:viridis", turn=(25, 25), light="studio", background="#202428").save("28-sphereflake.png")
