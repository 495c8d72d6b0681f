"""Every property and method of the package's objects, called from several threads on the same object at the same time."""

import inspect
import os
import pickle
import subprocess
import sys
import threading
import unittest

import bihive as bh
import numpy as np
from bihive import _bihive
from program import PATIENCE_S, ProgramTest, main

THREADS = 3
ROUNDS = 4
SMALL = {"size": (40, 30), "samples": 1, "threads": 2, "style": "plain"}
RAYS = (np.zeros((200, 3), np.float32), np.random.default_rng(2).normal(size=(200, 3)).astype(np.float32))


def spheres(count=500):
    rng = np.random.default_rng(1)
    return bh.Spheres(rng.uniform(-5, 5, (count, 3)), radius=0.3, columns={"charge": rng.normal(size=count), "part": ["a"] * count}, element=6, type=2,
                      colour="red", opacity=1, cell=[20, 20, 20])


def plain(value):
    """An answer that can be compared."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes() if value.dtype != object else value.tolist()
    if isinstance(value, (tuple, list)):
        return [plain(one) for one in value]
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    return repr(value) if isinstance(value, (bh.Spheres, bh.Tree, bh.Picture)) else value


def calls_of(thing, folder, arguments, left_out=()):
    """Name: a call without arguments, for everything that can be asked of the object and of the compiled one inside."""
    made = {}
    for owner, prefix in ((thing, ""), (thing._core, "core.")):
        for name, one in inspect.getmembers(type(owner)):
            if name.startswith("_") and name not in ("__getstate__", "__len__", "__repr__", "__getitem__", "__array__", "_repr_png_"):
                continue
            if prefix + name in left_out:
                continue
            if isinstance(one, property):
                made[prefix + name] = lambda owner=owner, name=name: getattr(owner, name)
            elif callable(one):
                given = arguments.get(prefix + name, ())
                made[prefix + name] = lambda owner=owner, name=name, given=given: getattr(owner, name)(*given)
    made["pickled"] = lambda: pickle.loads(pickle.dumps(thing)) == thing
    return made


class Threads(ProgramTest):
    def together(self, calls):
        """Each call gives on all threads what it gives on one."""
        expected = {name: plain(call()) for name, call in calls.items()}
        wrong = []

        def work(first):
            names = sorted(calls)
            for k in range(ROUNDS * len(names)):
                name = names[(first * len(names) // THREADS + k) % len(names)]
                try:
                    if plain(calls[name]()) != expected[name]:
                        wrong.append(name)
                except BaseException as error:
                    wrong.append(f"{name}: {type(error).__name__}: {error}")

        threads = [threading.Thread(target=work, args=(i,)) for i in range(THREADS)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(PATIENCE_S)
        self.assertEqual(wrong, [])

    def path_of_thread(self, ending):
        return self.path(f"{threading.get_ident()}.{ending}")

    def test_spheres(self):
        s = spheres()
        arguments = {"__getitem__": ("charge",), "core.select": ("element C and charge > 0", "select", True), "core.written": ("csv",),
                     "core.measured": (np.array([[0, 1, 2], [4, 3, 9]]), True), "core.statistics": ([],), "core.what_there_is": ("element Fe",),
                     "core.column": ("part",)}
        calls = calls_of(s, self.folder, arguments, left_out={"save", "to_html", "moved", "with_columns", "core.statistics", "core.part", "core.moved", "core.with_columns", "core.with_bonds"})
        calls["moved"] = lambda: s.moved(s.xyz + 1).xyz
        calls["with_columns"] = lambda: s.with_columns({"more": s.radius})["more"]
        calls["save"] = lambda: s.save(self.path_of_thread("csv"))
        calls["subset"] = lambda: s[np.arange(100)].xyz
        calls["select"] = lambda: bh.select(s, "within 2 of (index 0)")
        calls["render"] = lambda: np.asarray(bh.render(s, **SMALL))
        calls["tree"] = lambda: bh.Tree(s).closest(*RAYS)
        calls["stats"] = lambda: bh.stats(s)["spheres"]
        calls["with_bonds"] = lambda: s._core.with_bonds(np.array([[0, 1, 1]], dtype=np.int32), True).bonds
        calls["measure"] = lambda: bh.measure(s, probe=0.5, threads=2).sphere_volume
        calls["contacts"] = lambda: bh.contacts(s, threads=2).area
        self.together(calls)

    def test_tree(self):
        tree = bh.Tree(spheres(), threads=2)
        points, xyz = np.zeros((20, 3)), tree.spheres.xyz
        arguments = {"closest": RAYS, "occluded": RAYS, "all_hits": RAYS, "nearest": (points, 3), "within": (points, 1.0),
                     "contains": (points,), "overlaps": (points, 0.5), "count_within": (points, 0.5), "pairs": (0.1,)}
        ray = ((*RAYS, None, None, None, None), None)
        arguments |= {"core.closest": (*ray, True, False), "core.occluded": (*ray, False, True),
                      "core.all_hits": (*ray, False),
                      "core.surfaces": (*RAYS, None, np.full(len(RAYS[0]), np.inf), np.full(len(RAYS[0]), -1), False, True),
                      "core.nearest": (points, 2, 9.0, None, None, True), "core.within": (points, np.ones(20), None, None, False),
                      "core.count_within": (points, np.ones(20), None, None, True), "core.pairs": (0.1, None, False)}
        calls = calls_of(tree, self.folder, arguments, left_out={"update", "core.bodies"})
        moving = bh.Tree(spheres(), threads=2)
        calls["update"] = lambda: moving.update(xyz)  # meanwhile others ask the same tree
        calls["updated"] = lambda: moving.closest(*RAYS)
        del calls["pickled"]
        self.together(calls)

    def test_bodies(self):
        tree = bh.BodyTree(spheres(), bh.Sticks([[0, 0, 0]], [[1, 1, 1]], 0.1), threads=2)
        self.together({"closest": lambda: tree.closest(*RAYS), "occluded": lambda: tree.occluded(*RAYS), "all_hits": lambda: tree.all_hits(*RAYS)})
        nothing = np.full(len(RAYS[0]), np.inf), np.full(len(RAYS[0]), -1)
        self.assertRaises(TypeError, bh.Tree(spheres())._core.bodies, *RAYS, *nothing, None)

    def test_picture(self):
        picture = bh.render(spheres(), **SMALL)
        arguments = {"layer": ("normal",), "core.layer": ("id",), "__getitem__": (), "project": (np.eye(3),), "unproject": (1, 2, 3),
                     "core.camera_rays": (np.ones(2), np.ones(2)), "core.camera_places": (np.eye(3),)}
        calls = calls_of(picture, self.folder, arguments, left_out={"save", "to_html", "detach", "core.save", "core.save_exr", "core.save_tiff", "core.detach"})
        calls["save"] = lambda: picture.save(self.path_of_thread("png"))
        calls["save_tiff"] = lambda: picture.save(self.path_of_thread("tif"))
        calls["save_exr"] = lambda: picture.save(self.path_of_thread("exr"), layers="radiance,depth")
        calls["alike"] = lambda: np.asarray(bh.render(spheres(), camera=picture, **SMALL))
        self.together(calls)

    def test_file_of_a_film(self):
        """One of each thread in one folder, and one that all threads leave."""

        def place():
            output = self.path_of_thread("mp4")
            file = _bihive.FilmFile(output)
            with open(f"/proc/self/fd/{file.descriptor()}/part", "wb") as part:
                part.write(b"film")
            found = file.has("part")
            file.place("part")
            file.leave()
            with open(output, "rb") as whole:
                return found, whole.read()

        shared = _bihive.FilmFile(self.path("shared.mp4"))
        self.together({"place": place, "has": lambda: shared.has("none")})
        self.together({"leave": shared.leave, "descriptor": lambda: min(shared.descriptor(), 0)})
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".bihive-")])

    def test_a_picture_that_is_detached_meanwhile(self):
        # In a process of its own: memory that is read after its end ends the process.
        script = f"""
import sys, threading
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
import bihive as bh, numpy as np
from threads_test import spheres
s = spheres(20000)
for k, name in enumerate(["normal", "depth", "exr", "attribute:charge"]):
    picture = bh.render(s, size=(500, 400), samples=1, style="plain")
    whole = None if name == "exr" else picture.layer(name)
    seen = []
    def ask():
        for _ in range(3):
            try:
                seen.append(picture.save({self.path("a.exr")!r}, layers="normal") if name == "exr" else picture.layer(name))
            except bh.UsageError as error:
                assert "detached" in str(error), error
    threads = [threading.Thread(target=ask) for _ in range(2)]
    for thread in threads: thread.start()
    threading.Event().wait(0.01)
    picture.detach()
    for thread in threads: thread.join()
    assert name == "exr" or all(np.array_equal(one, whole, equal_nan=True) for one in seen)
    assert np.asarray(picture).shape == (400, 500, 3)
print("whole")
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((done.returncode, done.stdout), (0, "whole\n"), done.stderr[-2000:])

    def test_arrays_that_change_while_they_are_read(self):
        """What comes of it is theirs who write, but it is spheres or an error."""
        places = np.random.default_rng(3).uniform(-1, 1, (200000, 3))
        ended = threading.Event()

        def write():
            while not ended.is_set():
                places[::7] = 1e300
                places[::7] = np.nan
                places[::7] = 0.5

        writer = threading.Thread(target=write)
        writer.start()
        try:
            for _ in range(20):
                try:
                    stored = bh.Spheres(places, radius=0.01).xyz
                except bh.InputError:
                    continue
                self.assertTrue(np.isfinite(stored).all())
        finally:
            ended.set()
            writer.join()

    def test_every_class_of_the_module_is_tried(self):
        classes = {name for name, one in vars(_bihive).items() if inspect.isclass(one)}
        self.assertEqual(classes, {"Spheres", "Picture", "Tree", "FilmFile"})


if __name__ == "__main__":
    main()
