"""The made sets of spheres of the study. All come from a fixed seed."""

import math
import random


def _uniform(rng, count):
    return [[rng.uniform(-1, 1) for _ in range(3)] for _ in range(count)]


def _direction(rng):
    while True:
        vector = [rng.gauss(0, 1) for _ in range(3)]
        length = math.hypot(*vector)
        if length > 1e-3:
            return [c / length for c in vector]


def _with_radius(centres, radius):
    return [[*centre, radius] for centre in centres]


def uniform(rng, count):
    return _with_radius(_uniform(rng, count), 0.5 * count ** (-1 / 3))


def dust(rng, count):
    return _with_radius(_uniform(rng, count), 0.02 * count ** (-1 / 3))


def packed(rng, count):
    side = round(count ** (1 / 3))
    lattice = [(i % side, i // side % side, i // side**2) for i in range(side**3)]
    return _with_radius([[c + rng.uniform(-0.05, 0.05) for c in centre] for centre in lattice], 0.5)


def radii(rng, count):
    return [[*centre, 0.3 * 10 ** rng.uniform(-3, 0) * count ** (-1 / 4)] for centre in _uniform(rng, count)]


def giant(rng, count):
    return [[0, 0, -101, 100], *uniform(rng, count - 1)]


def needles(rng, count):
    rods = [(start, _direction(rng)) for start in _uniform(rng, 40)]
    centres = []
    for _ in range(count):
        start, along = rng.choice(rods)
        t = rng.uniform(-1, 1)
        centres.append([s + t * a for s, a in zip(start, along)])
    return _with_radius(centres, 0.004)


def shell(rng, count):
    return _with_radius([_direction(rng) for _ in range(count)], 2 * count**-0.5)


def clusters(rng, count):
    middles = [[10 * c for c in middle] for middle in _uniform(rng, 30)]
    return _with_radius([[c + rng.gauss(0, 0.2) for c in rng.choice(middles)] for _ in range(count)], 0.02)


def duplicates(rng, count):
    return uniform(rng, count // 8) * 8


def made_sets(count):
    """Name, sentence, and rows of x, y, z, radius; `count` spheres each, or nearly."""
    made = [
        ("spheres of one radius, anywhere, that hardly overlap", uniform),
        ("the same with radii 25 times smaller: most rays hit nothing", dust),
        ("a cubic lattice, a little shaken: spheres touch", packed),
        ("radii from 1 to 1000, log-uniform", radii),
        ("uniform spheres above one that is far larger than all of them", giant),
        ("thin straight rods of spheres in all directions", needles),
        ("spheres on the surface of a ball: empty inside", shell),
        ("thirty dense clusters, far apart", clusters),
        ("each sphere eight times in one position", duplicates),
    ]
    rng = random.Random(42)
    return [(make.__name__, sentence, make(rng, count)) for sentence, make in made]


def csv_of(rows):
    return "x,y,z,r\n" + "".join(",".join(f"{number:.9g}" for number in row) + "\n" for row in rows)
