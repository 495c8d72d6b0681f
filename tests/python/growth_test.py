"""No public function or method makes the process grow with every call, while other processes keep the machine busy."""

import inspect
import os
import subprocess
import sys
import tempfile
import unittest
import warnings

import bihive as bh
import numpy as np

WARM_UP, CALLS, ROUNDS = 8, 24, 8
MOST_KB = 1.5  # per call; an arena of oneTBB per call was 7 kB

# Names that are not called, and why.
LEFT_OUT = {
    "save_page": "it starts a program for each call",
    "page": "it starts a program for each call",
    "Page": "made by page()",
    "widget": "it starts a program for each call",
    "Spheres.to_html": "it starts a program for each call",
    "Picture.to_html": "it starts a program for each call",
    "view": "it starts a server",
    "View": "a server",
    "View.close": "it ends a server",
    "View.is_open": "it asks for a server",
    "film": "it starts a program for each call; tests/cli/film_memory_test.py looks at that one",
    "Error": "an exception", "FileError": "an exception", "InputError": "an exception", "MissingError": "an exception",
    "UsageError": "an exception", "InputWarning": "a warning",
    "__version__": "a text",
}


def resident_kb():
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS:"))


def public_names():
    """Functions, classes, and their methods and properties: "render", "Tree", "Tree.closest"."""
    for name in bh.__all__:
        thing = getattr(bh, name)
        yield name
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            for own, value in vars(thing).items():
                if not own.startswith("_") and (callable(value) or isinstance(value, property)):
                    yield f"{name}.{own}"


def cases(folder):
    generator = np.random.default_rng(1)
    xyz, points = generator.normal(size=(2000, 3)), generator.normal(size=(600, 3))
    rays = generator.normal(size=(600, 3))
    s = bh.Spheres(xyz, radius=0.05, columns={"charge": xyz[:, 0]})
    few = s[:100]
    crystal = bh.Spheres([[0, 0, 0]], radius=1, cell=[2, 2, 2])
    tree = bh.Tree(s, threads=2)
    options = {"size": (64, 48), "threads": 2, "samples": 1}
    picture = bh.render(s, **options)
    ends = ("xyz", "extxyz", "csv", "npy", "ply", "sdf", "mol2")
    for end in ends:
        s.save(f"{folder}/read.{end}")
    bh.render(f"{folder}/read.xyz", **options).save(f"{folder}/figure.png")
    found = tree.contains(points)
    moving = bh.Tree(s, threads=2)
    sticks = bh.Sticks(xyz[:-1], xyz[1:], 0.01)
    bodies = bh.BodyTree(s, sticks, threads=2)
    box = bh.Tree(bh.Spheres(xyz % 4, radius=0.05, cell=[4, 4, 4], columns={"charge": xyz[:, 0]}), threads=2)
    own = np.arange(600)
    choices = [{}, {"mask": "charge > 0"}, {"exclude": own}, {"mask": xyz[:, 1] > 0, "exclude": 7}]
    of_images = {"periodic": True, "t_max": 4, "exclude": own}

    def fields(thing):
        return lambda: [getattr(thing, name) for name in type(thing)._fields]

    made = {
        "Spheres": lambda: bh.Spheres(xyz, radius=0.05, columns={"charge": xyz[:, 0]}),
        "Spheres.save": lambda: [s.save(f"{folder}/saved.{end}") for end in ends],
        "Tree": lambda: bh.Tree(s, threads=2),
        "Tree.closest": lambda: [tree.closest(rays, rays, **some) for some in choices] + [box.closest(rays, rays, **of_images)],
        "Tree.occluded": lambda: [tree.occluded(rays, rays, **some) for some in choices] + [box.occluded(rays, rays, **of_images)],
        "Tree.all_hits": lambda: [tree.all_hits(rays, rays, **some) for some in choices] + [box.all_hits(rays, rays, **of_images)],
        "Tree.nearest": lambda: [one.nearest(points, **some) for one in (tree, box) for some in choices],
        "Tree.within": lambda: [one.within(points, 0.1, **some) for one in (tree, box) for some in choices],
        "Tree.contains": lambda: [tree.contains(points, **some) for some in choices],
        "Tree.overlaps": lambda: [tree.overlaps(points, 0.1, **some) for some in choices],
        "Tree.count_within": lambda: [one.count_within(points, 0.1, **some) for one in (tree, box) for some in choices],
        "Tree.pairs": lambda: tree.pairs(0.1),
        "Tree.update": lambda: moving.update(xyz),
        "Sticks": lambda: bh.Sticks(xyz[:-1], xyz[1:], 0.01),
        "BodyTree": lambda: bh.BodyTree(s, sticks, threads=2),
        "BodyTree.closest": lambda: bodies.closest(rays, rays),
        "BodyTree.occluded": lambda: bodies.occluded(rays, rays),
        "BodyTree.all_hits": lambda: bodies.all_hits(rays, rays),
        "BodyHits": fields(bodies.closest(rays, rays)),
        "AllBodyHits": fields(bodies.all_hits(rays, rays)),
        "Spheres.bonds": lambda: bh.Spheres(xyz, radius=0.05, bonds=np.arange(2000).reshape(-1, 2)).bonds,
        "Spheres.moved": lambda: s.moved(xyz),
        "Spheres.with_columns": lambda: s.with_columns({"more": xyz[:, 1]}),
        "Picture": lambda: np.asarray(bh.render(s, **options)).sum(),
        "Picture.rays": lambda: picture.rays(),
        "Picture.project": lambda: picture.project(points),
        "Picture.unproject": lambda: picture.unproject(1, 2, 3),
        "Picture.layer": lambda: picture.layer("depth"),
        "Picture.save": lambda: [picture.save(f"{folder}/saved.{end}") for end in ("png", "exr")],
        "Picture.detach": lambda: bh.render(s, **options).detach(),
        "Hits": fields(tree.all_hits(rays, rays)),
        "Hits.counts": lambda: tree.all_hits(rays, rays).counts,
        "ClosestHits": lambda: [tree.closest(rays, rays).normals(), tree.all_hits(rays, rays).exits()],
        "HitDerivatives": fields(tree.closest(rays, rays).derivatives()),
        "Pairs": fields(tree.pairs(0.1)),
        "Near": fields(found),
        "Near.counts": lambda: found.counts,
        "Orthographic": lambda: bh.render(s, camera=bh.Orthographic("left"), **options),
        "Orthographic.words": lambda: bh.Orthographic("left").words(),
        "Perspective": lambda: bh.render(s, camera=bh.Perspective("top"), **options),
        "Perspective.words": lambda: bh.Perspective("top").words(),
        "Look": lambda: bh.render(s, looks=[bh.Look("charge > 0", colour="red")], **options),
        "Look.words": lambda: bh.Look("charge > 0", colour="red").words(),
        "Look.arrays": lambda: bh.render(s, looks=[bh.Look(colour=np.full((len(s), 3), 0.5))], **options),
        "Style": lambda: bh.render(s, style="illustrative", **options),
        "Style.text": lambda: bh.Style({}).text(),
        "colour_map": lambda: bh.colour_map(xyz[:, 0]),
        "linear": lambda: bh.linear((0.5, 0, 0)),
        "convert": lambda: bh.convert(f"{folder}/read.xyz", f"{folder}/converted.csv"),
        "read": lambda: [bh.read(f"{folder}/read.{end}") for end in ends],
        "render": lambda: bh.render(s, **options),
        "select": lambda: bh.select(s, "charge > 0"),
        "distance": lambda: bh.distance(s, [[0, 1], [5, 9]]),
        "measure": lambda: bh.measure(few, probe=0.1, select="charge > 0", threads=2),
        "compare": lambda: bh.compare(few, structures=["kd-sah"], rays=["points"], count=8),
        "tune": lambda: bh.tune(few, structure="bvh-lbvh", rays=["points"], count=4),
        "sasa": lambda: bh.sasa(few),
        "volume": lambda: bh.volume(few),
        "Measures": fields(bh.measure(few, derivatives=True)),
        "Contacts": fields(bh.contacts(few)),
        "contacts": lambda: bh.contacts(few),
        "porosity": lambda: bh.porosity(crystal),
        "buried_area": lambda: bh.buried_area(few, [[0], [1, 2]]),
        "angle": lambda: bh.angle(s, [[0, 1, 2], [5, 9, 7]]),
        "dihedral": lambda: bh.dihedral(s, [0, 1, 2, 3]),
        "stats": lambda: bh.stats(s),
        "Verdict": lambda: bool(bh.verify(f"{folder}/figure.png")),
        "verify": lambda: bh.verify(f"{folder}/figure.png"),
        "again": lambda: bh.again(f"{folder}/figure.png", samples=1),
    }
    for thing, name in ((s, "Spheres"), (tree, "Tree"), (picture, "Picture")):
        for own, value in vars(type(thing)).items():
            if isinstance(value, property) and not own.startswith("_"):
                made[f"{name}.{own}"] = lambda thing=thing, own=own: getattr(thing, own)
    return made


def sample_files():
    """A small file of each kind that the tests keep, among them arrays, trajectories and molecules."""
    top = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
    for folder in ("data/io", "data/io/trajectories", "../data"):
        for name in sorted(os.listdir(os.path.join(top, folder))):
            path = os.path.join(top, folder, name)
            if os.path.isfile(path) and os.path.getsize(path) < 300_000 and not name.endswith((".py", ".md")):
                yield path


class Growth(unittest.TestCase):
    def setUp(self):
        if "asan" in os.environ.get("LD_PRELOAD", "") or "tsan" in os.environ.get("LD_PRELOAD", ""):
            self.skipTest("a sanitizer keeps freed memory")
        warnings.simplefilter("ignore", bh.InputWarning)
        for _ in range(2):
            busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
            self.addCleanup(busy.wait)
            self.addCleanup(busy.kill)

    def growth_kb(self, call):
        """kB per call, of the round that grows least: what grows with every call grows in all."""
        for _ in range(WARM_UP):
            call()
        least = float("inf")
        for _ in range(ROUNDS):
            before = resident_kb()
            for _ in range(CALLS):
                call()
            least = min(least, (resident_kb() - before) / CALLS)
            if least <= MOST_KB:
                break
        return least

    def test_every_public_function(self):
        with tempfile.TemporaryDirectory() as folder:
            made = cases(folder)
            names = set(public_names())
            self.assertEqual(names - set(made) - set(LEFT_OUT), set(), "no case for these")
            self.assertEqual((set(made) | set(LEFT_OUT)) - names, set(), "cases of what is not there")
            for name, call in made.items():
                with self.subTest(name):
                    self.assertLessEqual(self.growth_kb(call), MOST_KB)

    def test_readers(self):
        found = 0
        for path in sample_files():
            def call(path=path):
                try:
                    bh.read(path)
                except bh.Error:  # a trajectory alone, or a library that is not installed
                    pass

            found += 1
            with self.subTest(os.path.basename(path)):
                self.assertLessEqual(self.growth_kb(call), MOST_KB)
        self.assertGreater(found, 10)


if __name__ == "__main__":
    unittest.main()
