# One picture of a film
# A drop that falls apart, as frames of one file. `bihive film drop.xyz -o drop.mp4` makes the film; `--frame` draws one picture of it.
import numpy as np
import bihive as bh

rng = np.random.default_rng(2)
start = rng.normal(size=(600, 3))
start *= (rng.uniform(0, 1, (600, 1)) ** (1 / 3) * 4) / np.linalg.norm(start, axis=1, keepdims=True)
with open("drop.xyz", "w") as file:
    for time in range(20):
        place = start + time * 0.25 * start * np.array([1, 0.3, 1]) - np.array([0, 0.02, 0]) * time**2
        file.write('600\nProperties=species:S:1:pos:R:3 Time=%d\n' % time)
        file.writelines("O %.4f %.4f %.4f\n" % tuple(p) for p in place)
bh.render("drop.xyz", frame=12, radius=0.45, size=(480, 360), colour="#4080c0", style="glossy").save("26-one-picture-of-a-film.png")
