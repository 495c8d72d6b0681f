"""Sets of spheres for the part cliffs of scripts/bench: hostile ones, and such as people have."""

import os
import pathlib

import numpy as np

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
COUNT = 100_000


def uniform(rng, count, radius=None):
    """Centres in the cube [-20, 20], and radii that fill a tenth of it, unless they are given."""
    side = 40.0
    radius = (0.1 * side**3 / count / (4.18879)) ** (1 / 3) if radius is None else radius
    return rows(rng.uniform(-side / 2, side / 2, (count, 3)), radius)


def rows(centres, radius):
    centres = np.asarray(centres, float)
    return np.column_stack([centres, np.broadcast_to(radius, len(centres))])


def on_sphere(rng, count):
    directions = rng.normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def duplicated(rng, count, share):
    """A share of the spheres are copies of others."""
    spheres = uniform(rng, count)
    copies = rng.choice(count, int(share * count), replace=False)
    spheres[copies] = spheres[rng.choice(count, len(copies))]
    return spheres


def lattice(count, radius, basis=((0, 0, 0),)):
    side = round((count / len(basis)) ** (1 / 3))
    cells = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), -1).reshape(-1, 1, 3)
    return rows((cells + np.array(basis)).reshape(-1, 3), radius)


def clusters(rng, count, number, width, radius):
    """Clusters that are exponentially dense in their middles, as haloes of galaxies are."""
    middles = rng.uniform(-20, 20, (number, 3))
    distances = rng.exponential(width, (count, 1))
    return rows(middles[rng.integers(number, size=count)] + distances * on_sphere(rng, count), radius)


def shells(rng, count, jitter, smallest=0.0):
    """Spheres around one centre, which may be moved a little."""
    return rows(rng.normal(0, 1, (count, 3)) * jitter, np.linspace(smallest, 1, count + 1)[1:])


def onions(rng, count, number):
    """Many clusters of spheres around one centre each."""
    of = np.arange(count) % number
    return rows(rng.uniform(-20, 20, (number, 3))[of], (1 + np.arange(count) // number) / (count / number))


def scan(rng, count):
    """Points of a scanner: rings of a turning laser on a floor, walls and a few objects."""
    angle, tilt = rng.uniform(0, 2 * np.pi, count), np.deg2rad(rng.integers(-24, 8, count))
    direction = np.column_stack([np.cos(tilt) * np.cos(angle), np.cos(tilt) * np.sin(angle), np.sin(tilt)])
    to_wall = 12 / np.maximum(np.abs(direction[:, 0]), np.abs(direction[:, 1]))
    to_floor = np.where(direction[:, 2] < 0, 1.8 / np.maximum(-direction[:, 2], 1e-9), np.inf)
    distance = np.minimum(to_wall, to_floor) + rng.normal(0, 0.01, count)
    return rows(direction * distance[:, None], 0.02)


def polymer(rng, count, chains):
    """Random walks with bonds of length 1."""
    steps = on_sphere(rng, count).reshape(chains, -1, 3)
    return rows((rng.uniform(-30, 30, (chains, 1, 3)) + np.cumsum(steps, axis=1)).reshape(-1, 3), 0.6)


def log_radii(rng, low, high):
    return lambda count: 10 ** rng.uniform(np.log10(low), np.log10(high), count)


# Name: spheres of a random generator and a number, x y z r.
SETS = {
    "uniform": uniform,
    "uniform, 1,000": lambda rng, n: uniform(rng, n // 100),
    "one sphere twice": lambda rng, n: duplicated(rng, n, 1 / n),
    "one in a hundred twice": lambda rng, n: duplicated(rng, n, 0.01),
    "half of them twice": lambda rng, n: duplicated(rng, n, 0.5),
    "all equal": lambda rng, n: rows(np.zeros((n, 3)), 1),
    "1,000 piles of equal spheres": lambda rng, n: uniform(rng, 1000)[np.arange(n) % 1000],
    "deep overlap": lambda rng, n: uniform(rng, n, 8.0),
    "deep overlap, many radii": lambda rng, n: uniform(rng, n, rng.uniform(0.8, 8, n)),
    "touching much": lambda rng, n: uniform(rng, n, 1.5),
    "shells": lambda rng, n: shells(rng, n, 0),
    "shells, moved": lambda rng, n: shells(rng, n, 1e-3),
    "shells, thin": lambda rng, n: shells(rng, n, 0, 0.99),
    "a thousand onions": lambda rng, n: onions(rng, n, 1000),
    "ten onions": lambda rng, n: onions(rng, n, 10),
    "one huge around all": lambda rng, n: np.vstack([uniform(rng, n), [[0, 0, 0, 60]]]),
    "one huge among all": lambda rng, n: np.vstack([uniform(rng, n), [[0, 0, 0, 10]]]),
    "one huge far away": lambda rng, n: np.vstack([uniform(rng, n), [[0, -1e6, 0, 999_970]]]),
    "radii 1e3 to 1": lambda rng, n: uniform(rng, n, log_radii(rng, 1e-3, 1)(n)),
    "radii 1e6 to 1": lambda rng, n: uniform(rng, n, log_radii(rng, 4e-6, 4)(n)),
    "tiny": lambda rng, n: uniform(rng, n, 1e-5),
    "a plane": lambda rng, n: uniform(rng, n, 0.1) * [1, 1, 0, 1],
    "a thin layer": lambda rng, n: uniform(rng, n, 0.1) * [1, 1, 0.01, 1],
    "a tilted plane": lambda rng, n: uniform(rng, n, 0.1) @ np.array([[1, 0, 1, 0], [0, 1, 1, 0], [0, 0, 0, 0], [0, 0, 0, 1]]),
    "a line": lambda rng, n: uniform(rng, n, 0.01) * [1, 0, 0, 1],
    "a diagonal": lambda rng, n: rows(np.outer(np.linspace(-20, 20, n), [1, 1, 1]), 0.01),
    "a grid, radius 0.5": lambda rng, n: lattice(n, 0.5),
    "a grid, radius 0.1": lambda rng, n: lattice(n, 0.1),
    "a grid, radius 1": lambda rng, n: lattice(n, 1.0),
    "face-centred": lambda rng, n: lattice(n, 0.35, ((0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5))),
    "rock salt": lambda rng, n: lattice(n, 0.25, ((0, 0, 0), (0.5, 0.5, 0.5))),
    "a surface of a ball": lambda rng, n: rows(20 * on_sphere(rng, n), 0.1),
    "ten surfaces": lambda rng, n: rows((2 + 2 * rng.integers(10, size=(n, 1))) * on_sphere(rng, n), 0.1),
    "a helix": lambda rng, n: rows([(np.cos(t), np.sin(t), t / 100) for t in np.linspace(0, 2000, n)], 0.05),
    "a normal cloud": lambda rng, n: rows(rng.normal(0, 5, (n, 3)), 0.1),
    "haloes": lambda rng, n: clusters(rng, n, 50, 0.3, 0.01),
    "haloes, many radii": lambda rng, n: clusters(rng, n, 50, 0.3, log_radii(rng, 1e-3, 0.3)(n)),
    "exponentially nested centres": lambda rng, n: rows(on_sphere(rng, n) * np.exp2(-rng.uniform(0, 60, (n, 1))) * 20, 1e-3),
    "a scan": scan,
    "polymers": lambda rng, n: polymer(rng, n, 100),
    "one long polymer": lambda rng, n: polymer(rng, n, 1),
    "two clouds far apart": lambda rng, n: uniform(rng, n) + np.outer(np.arange(n) % 2, [1e5, 0, 0, 0]),
    "far from 0": lambda rng, n: uniform(rng, n) + [1e5, -2e5, 3e5, 0],
    "long in one direction": lambda rng, n: uniform(rng, n, 0.2) * [100, 1, 1, 1],
    "needles": lambda rng, n: uniform(rng, n, 0.05) * [1, 0.01, 0.01, 1],
    "sorted along x": lambda rng, n: (lambda spheres: spheres[np.argsort(spheres[:, 0])])(uniform(rng, n)),
    "rounded to tenths": lambda rng, n: np.round(uniform(rng, n), 1) * [1, 1, 1, 0] + [0, 0, 0, 0.25],
    "two radii": lambda rng, n: uniform(rng, n, np.where(np.arange(n) % 100 == 0, 2.0, 0.1)),
}


def write(folder, quick):
    """Writes the sets, and gives their names and paths, seen from the project."""
    folder.mkdir(parents=True, exist_ok=True)
    count = 1000 if quick else COUNT
    for number, (name, make) in enumerate(SETS.items()):
        path = folder / f"{number:02}_{count}.npy"
        np.save(path, make(np.random.default_rng(number), count).astype(np.float32))
        yield name, os.path.relpath(path, TOP)
