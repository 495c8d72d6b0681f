"""The sets of spheres of the study: (name, sentence, rows x, y, z, r as float32). All come from fixed seeds."""

import numpy as np


def _rows(centres, radii):
    centres = np.asarray(centres, dtype=np.float64)
    return np.column_stack([centres, np.broadcast_to(radii, len(centres))]).astype(np.float32)


def uniform(rng, count):
    return _rows(rng.uniform(-1, 1, (count, 3)), 0.5 * count ** (-1 / 3))


def dust(rng, count):
    return _rows(rng.uniform(-1, 1, (count, 3)), 0.02 * count ** (-1 / 3))


def packed(rng, count):
    side = round(count ** (1 / 3))
    lattice = np.stack(np.meshgrid(*[np.arange(side)] * 3), axis=-1).reshape(-1, 3)
    return _rows(lattice + rng.uniform(-0.05, 0.05, lattice.shape), 0.5)


def radii_1000(rng, count):
    return _rows(rng.uniform(-1, 1, (count, 3)), 0.3 * 10 ** rng.uniform(-3, 0, count) * count ** (-1 / 4))


def one_giant(rng, count):
    rows = uniform(rng, count)
    rows[0] = (0, 0, -101, 100)
    return rows


def needles(rng, count):
    needle = rng.integers(0, 40, count)
    start, along = rng.uniform(-1, 1, (40, 3)), rng.normal(size=(40, 3))
    along /= np.linalg.norm(along, axis=1)[:, None]
    return _rows(start[needle] + along[needle] * rng.uniform(-1, 1, (count, 1)), 0.004)


def shell(rng, count):
    directions = rng.normal(size=(count, 3))
    return _rows(directions / np.linalg.norm(directions, axis=1)[:, None], 2 * count**-0.5)


def clusters(rng, count):
    middle = rng.uniform(-10, 10, (30, 3))
    return _rows(middle[rng.integers(0, 30, count)] + rng.normal(scale=0.2, size=(count, 3)), 0.02)


def duplicates(rng, count):
    return np.repeat(uniform(rng, count // 8), 8, axis=0)


def sets(count):
    """Name, sentence, and what makes the rows; None: a built-in scene."""
    rng = np.random.default_rng(42)
    made = [
        ("uniform", "uniform, spheres of one radius that hardly overlap", uniform),
        ("dust", "the same centres with radii 25 times smaller: most rays hit nothing", dust),
        ("packed", "a cubic lattice, a little shaken: spheres touch", packed),
        ("radii", "radii from 1 to 1000, log-uniform", radii_1000),
        ("giant", "uniform spheres above one that is far larger than all of them", one_giant),
        ("needles", "thin straight rods of spheres in all directions", needles),
        ("shell", "spheres on the surface of a ball: empty inside", shell),
        ("clusters", "thirty dense clusters, far apart", clusters),
        ("duplicates", "each sphere eight times in one position", duplicates),
    ]
    return [(name, sentence, make(rng, count)) for name, sentence, make in made]
