"""Every public function and method with every argument replaced by things that it does not take: each call ends well, or in one
short sentence that names the argument."""

import inspect
import itertools
import os
import re
import unittest
import warnings

import bihive as bh
import numpy as np
from bihive import _options, _spheres
from program import ProgramTest, main

LONGEST_MESSAGE = 500


class Hostile:
    """Fails at whatever is asked of it."""

    def fail(self, *_):
        raise ValueError("hostile")

    __array__ = __iter__ = __len__ = __index__ = __float__ = __fspath__ = __bool__ = __eq__ = __repr__ = __str__ = fail
    __hash__ = object.__hash__


class BytesPath:
    def __fspath__(self):
        return b"bytes"


def inside_itself():
    made = []
    made.append(made)
    return made


def deep():
    made = 1.0
    for _ in range(2000):
        made = [made]
    return made


# Name: value. A name, because some of them have no text.
HOSTILE = {
    "None": None,
    "True": True,
    "-1": -1,
    "3": 3,
    "2**40": 2**40,
    "2**70": 2**70,
    "10**5000": 10**5000,
    "1.5": 1.5,
    "1e300": 1e300,
    "nan": float("nan"),
    "inf": float("inf"),
    "complex": 1j,
    "empty text": "",
    "text": "no such thing",
    "NUL": "a\0b",
    "surrogate": "a\udc80\ud800",
    "controls": "\x1b[2J\u202e\n",
    "long text": "x" * 100000,
    "bytes": b"\xff\0",
    "empty list": [],
    "numbers": [1, 2, 3],
    "texts": ["a", "b", "c", "d"],
    "broken texts": ["a\ud800", "b", "c", "d"],
    "ragged": [[1, 2], [3]],
    "inside itself": inside_itself(),
    "deep": deep(),
    "mixed": [1, "a", None, object()],
    "dict": {"a": 1},
    "dict of objects": {object(): object()},
    "set": {1, 2},
    "object": object(),
    "function": lambda: 1,
    "class": list,
    "module": os,
    "generator": (i for i in range(3)),
    "endless": itertools.repeat(1),
    "hostile": Hostile(),
    "bytes path": BytesPath(),
    "hostile list": [Hostile()] * 4,
    "slice": slice("a", "b"),
    "no numbers": np.zeros(0),
    "zeros": np.zeros((4, 3)),
    "of a set": np.ones((4, 4), dtype=np.float16),
    "nans": np.full((4, 3), np.nan),
    "infinities": np.full(4, np.inf),
    "negatives": np.full(4, -1),
    "three axes": np.zeros((2, 2, 2), dtype=np.int64),
    "no axis": np.array(7),
    "huge": np.broadcast_to(np.float32(1), (1 << 40, 3)),
    "long numbers": np.full(4, 2**63, dtype=np.uint64),
    "long double": np.full((4, 3), np.longdouble("1e4000")),
    "complex array": np.zeros((4, 3), complex),
    "dates": np.zeros(4, "M8[s]"),
    "fields": np.zeros(4, [("a", int)]),
    "objects": np.array([object()] * 4),
    "None array": np.array([None] * 4),
    "texts array": np.array(["a", "b", "c", "d"]),
    "bytes array": np.array([b"a", b"\xff", b"c", b"d"]),
    "bools": np.ones(4, bool),
    "masked": np.ma.masked_array([1.0, 2, 3, 4], mask=[0, 1, 0, 0]),
    "matrix": np.asmatrix(np.zeros((4, 3))),
}
# What options of pictures get: text is checked where the command line is read.
FOR_OPTIONS = ["True", "-1", "2**70", "10**5000", "nan", "text", "NUL", "surrogate", "long text", "bytes", "empty list", "texts",
               "inside itself", "deep", "dict of objects", "object", "class", "hostile", "bytes path", "zeros", "objects", "controls"]
# Arguments whose errors name something else: an option of their own, the sphere, the attribute.
SAID_OF = {"camera": "view_from", "xyz": "sphere", "state": "sphere", "colour_by": "attribute", "crease": "attribute"}
SMALL = {"size": (8, 6), "samples": 1, "threads": 1, "style": "plain"}
# Enough memory or time for nobody, or as many as there are.
EXCEPT = {("render", "threads"), ("film", "threads")}


def spheres():
    return bh.Spheres(np.arange(12.0).reshape(4, 3), radius=1, columns={"charge": [1, 2, 3, 4]}, cell=[20, 20, 20])


class Arguments(ProgramTest):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")
        self.addCleanup(warnings.resetwarnings)
        # Neither a film is encoded nor a browser opened.
        before = dict(os.environ)
        self.addCleanup(os.environ.update, before)
        os.environ["PATH"] = self.folder
        for name in ("DISPLAY", "WAYLAND_DISPLAY"):
            os.environ.pop(name, None)
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        self.spheres = spheres()
        self.wrong = []

    def tearDown(self):
        self.assertEqual(self.wrong, [], "\n".join(["", *self.wrong]))

    def judge(self, call, arguments, name, label):
        """`name`: that of the argument. Calls, and looks at the exception."""
        what = f"{getattr(call, '__qualname__', call)}({name}={label})"
        try:
            call(**arguments)
        except (TypeError, ValueError, IndexError, KeyError, MemoryError, bh.Error) as error:
            text = str(error)
            if name == "progress" and type(error) is TypeError and label in ("function", "class"):
                return  # the function's own: it takes no share
            if text == "hostile" or (isinstance(error, bh.MissingError) and "ffmpeg" in text):
                return  # the argument's own; no film is encoded here
            wrong = []
            if len(text) >= LONGEST_MESSAGE:
                wrong.append(f"{len(text)} characters")
            if "incompatible" in text or "ambiguous" in text:
                wrong.append("of another library")
            if re.search(r"[\x00-\x09\x0b-\x1f\x7f\u202e]", text):
                wrong.append("control characters")
            names = {name, SAID_OF.get(name, name)}
            named = any(one in text or getattr(error, "argument", "") == one for one in names) or getattr(error, "file", "")
            if not named and not isinstance(error, MemoryError):
                wrong.append("does not name the argument")
            if wrong:
                self.wrong.append(f"{what}: {', '.join(wrong)}: {type(error).__name__}: {text[:300]!r}")
        except BaseException as error:
            self.wrong.append(f"{what}: {type(error).__name__}: {str(error)[:300]!r}")

    def try_all(self, call, valid, others=(), options=()):
        """Each argument of the call in turn. `others`: names of keywords that the signature does not state."""
        self.assertIsNot(call(**valid), NotImplemented)
        parameters = [one for one in inspect.signature(call).parameters.values() if one.kind != one.VAR_KEYWORD]
        names = [one.name for one in parameters] + list(others)
        self.assertTrue(set(valid) <= {*names, *options})
        for name in names:
            for label, value in HOSTILE.items():
                self.judge(call, {**valid, name: value}, name, label)
        for name in options:
            for label in FOR_OPTIONS if (call.__name__, name) not in EXCEPT else []:
                self.judge(call, {**valid, name: HOSTILE[label]}, name, label)

    def test_sticks_and_their_tree(self):
        ends = {"a": [[0.0, 0, 0]], "b": [[9.0, 9, 9]], "radius": 0.5}
        self.try_all(bh.Sticks, ends)
        between = {"a": [0], "b": [3], "radius": 0.5, "between": self.spheres}
        for name in between:
            for label, value in HOSTILE.items():
                if (name, label) != ("between", "None"):  # then positions are no ends
                    self.judge(bh.Sticks, {**between, name: value}, name, label)
        sticks = bh.Sticks(**ends)
        self.try_all(bh.BodyTree, {"spheres": self.spheres, "sticks": sticks})
        tree = bh.BodyTree(self.spheres, sticks)
        rays = {"origins": [[-5.0, 1, 2]], "directions": [[1.0, 0, 0]]}
        self.try_all(tree.closest, rays)
        self.try_all(tree.occluded, rays)

    def test_every_public_name_is_tried(self):
        tried = {"AllBodyHits", "BodyHits", "BodyTree", "Spheres", "Sticks", "Tree", "Picture", "Verdict", "View", "Page", "Orthographic", "Perspective", "Look", "Style", "ClosestHits", "HitDerivatives", "Hits", "Near", "Pairs", "Measures", "Contacts",
                 "again", "angle", "buried_area", "colour_map", "compare", "contacts", "convert", "dihedral", "distance", "film", "linear", "measure", "page", "porosity", "read", "render", "sasa", "save_page", "select", "stats",
                 "tune", "verify", "view", "volume", "widget"}
        errors = {name for name in bh.__all__ if inspect.isclass(getattr(bh, name)) and issubclass(getattr(bh, name), (Exception, Warning))}
        self.assertEqual(set(bh.__all__), tried | errors | {"__version__"})
        methods = {name for name, one in vars(bh.Spheres).items() if callable(one) and not name.startswith("_")}
        self.assertEqual(methods, {"save", "moved", "to_html", "with_columns"})
        methods = {name for name, one in vars(bh.Picture).items() if callable(one) and not name.startswith("_")}
        self.assertEqual(methods, {"layer", "save", "detach", "rays", "project", "to_html", "unproject"})
        methods = {name for name, one in vars(bh.Tree).items() if callable(one) and not name.startswith("_")}
        self.assertEqual(methods, {"closest", "occluded", "all_hits", "nearest", "within", "contains", "overlaps", "count_within", "pairs", "update"})

    def test_spheres(self):
        self.try_all(bh.Spheres, {"xyz": np.zeros((4, 3)), "radius": 1}, others=["radii", "color", "center", "diameter"])
        self.try_all(self.spheres.save, {"path": self.path("a.csv")})
        self.try_all(self.spheres.moved, {"xyz": np.zeros((4, 3))})
        self.try_all(self.spheres.with_columns, {"columns": {"more": [1, 2, 3, 4]}})
        for label, value in HOSTILE.items():
            self.judge(self.spheres.__getitem__, {"key": value}, "", label) if label != "hostile" else None
            self.judge(self.spheres.__setstate__, {"state": value}, "state", label)
        whole = self.spheres.__getstate__()
        for key in whole:
            for label, value in HOSTILE.items():
                self.judge(bh.Spheres.__new__(bh.Spheres).__setstate__, {"state": {**whole, key: value}}, "state", label)
        self.assertEqual(len(self.spheres[np.array([1, 2])]), 2)

    def test_functions_of_spheres(self):
        self.try_all(bh.select, {"spheres": self.spheres, "expression": "all"})
        self.try_all(bh.stats, {"spheres": self.spheres})
        self.try_all(bh.distance, {"spheres": self.spheres, "pairs": [[0, 1], [2, 3]]})
        for call in (bh.measure, bh.sasa, bh.volume, bh.contacts):
            self.try_all(call, {"spheres": self.spheres})
        self.try_all(bh.compare, {"spheres": self.spheres, "structures": ["bih"], "rays": ["random"], "count": 4})
        self.try_all(bh.tune, {"spheres": self.spheres, "structure": "bih", "rays": ["random"], "count": 4})
        self.try_all(bh.porosity, {"spheres": bh.Spheres(np.zeros((1, 3)), radius=1, cell=[2, 2, 2])})
        self.try_all(bh.buried_area, {"spheres": self.spheres, "groups": [[0], [1, 2]]})
        self.try_all(bh.angle, {"spheres": self.spheres, "triples": [0, 1, 2]})
        self.try_all(bh.dihedral, {"spheres": self.spheres, "quadruples": [0, 1, 2, 3]})
        self.try_all(bh.colour_map, {"values": [1.0, 2, 3, 4]})
        self.try_all(bh.linear, {"light": (0.5, 0.25, 0)})
        self.try_all(bh.read, {"path": "demo"}, options=_spheres._READING)
        figure = self.path("figure.png")
        bh.render("demo", **SMALL).save(figure)
        self.try_all(bh.verify, {"figure": figure})
        self.try_all(bh.again, {"figure": figure, "size": (8, 8)})
        self.try_all(bh.convert, {"source": "demo", "path": self.path("a.csv")}, options=_spheres._READING)

    def test_trees(self):
        self.try_all(bh.Tree, {"spheres": self.spheres})
        tree = bh.Tree(self.spheres)
        rays = {"origins": np.zeros((4, 3)), "directions": [1, 0, 0]}
        for call in (tree.closest, tree.occluded, tree.all_hits):
            self.try_all(call, rays)
        points = {"points": np.zeros((4, 3))}
        self.try_all(tree.nearest, points)
        self.try_all(tree.within, {**points, "limits": 1.0})
        self.try_all(tree.contains, points)
        self.try_all(tree.overlaps, {**points, "radii": 1.0})
        self.try_all(tree.count_within, {**points, "limits": 1.0})
        self.try_all(tree.pairs, {"reach": 1.0})
        self.try_all(tree.update, {"xyz": np.zeros((4, 3))})

    def test_pictures(self):
        picture = bh.render(self.spheres, **SMALL)
        self.try_all(picture.layer, {"name": "depth"})
        self.try_all(picture.rays, {"x": 1.0, "y": 2.0})
        self.try_all(picture.project, {"points": np.zeros((4, 3))})
        self.try_all(picture.unproject, {"x": 1.0, "y": 2.0, "depth": 3.0})
        self.try_all(picture.save, {"path": self.path("a.png")})
        self.try_all(picture.save, {"path": self.path("a.exr")})
        for label, value in HOSTILE.items():
            self.judge(bh.Picture, {"core": value}, "Picture", label)
            self.judge(bh.View, {"server": value, "url": "", "folder": "", "descriptors": []}, "View", label)

    def test_render(self):
        words = [*_options.ONE_VALUE, *_options.FLAGS, *_options.SWITCHES, *_options.SIZES, *_options.ACTIONS, "light", "no_such_option"]
        self.try_all(bh.render, {"spheres": self.spheres, **SMALL}, options=dict.fromkeys(words))

    def test_film(self):
        def film(source=(self.spheres,), path=self.path("a.mp4"), **options):
            try:
                return bh.film(source, path, **options)
            except bh.MissingError:
                return 0

        film.__signature__ = inspect.signature(bh.film)
        self.try_all(film, {"source": [self.spheres], "path": self.path("a.mp4"), **SMALL}, options=["samples", "threads", "turntable"])

    def test_view(self):
        for name in ("source", "port", "browser"):
            for label, value in HOSTILE.items():
                self.judge(bh.view, {"source": self.path("missing.xyz"), name: value}, name if name != "source" else "", label)

    def test_save_page(self):
        os.environ["BIHIVE_PAGE"] = self.path("nowhere")
        self.addCleanup(os.environ.pop, "BIHIVE_PAGE")

        def save_page(source=self.spheres, path=self.path("a.html"), **options):
            try:
                return bh.save_page(source, path, **options)
            except bh.MissingError:
                return None

        save_page.__signature__ = inspect.signature(bh.save_page)
        self.try_all(save_page, {"source": self.spheres, "path": self.path("a.html")}, options=["samples", "floor"])

    def test_page(self):
        os.environ["BIHIVE_PAGE"] = self.path("nowhere")
        self.addCleanup(os.environ.pop, "BIHIVE_PAGE")

        def page(source=self.spheres, **options):
            try:
                return bh.page(source, **options)
            except bh.MissingError:
                return None

        page.__signature__ = inspect.signature(bh.page)
        self.try_all(page, {"source": self.spheres}, options=["samples", "floor"])

        def widget(source=self.spheres, **options):
            try:
                return bh.widget(source, **options)
            except bh.MissingError:
                return None

        widget.__signature__ = inspect.signature(bh.widget)
        self.try_all(widget, {"source": self.spheres}, options=["samples", "floor"])
        for name in ("html", "name"):
            for label, value in HOSTILE.items():
                self.judge(bh.Page, {"html": "", "name": "", name: value}, "Page", label)

    def test_cameras_and_looks(self):
        for kind, key in ((bh.Orthographic, "camera"), (bh.Perspective, "camera"), (bh.Look, "looks"), (bh.Style, "style")):
            for name in inspect.signature(kind).parameters:
                for label in FOR_OPTIONS:

                    def draw(**fields):
                        return bh.render(self.spheres, **{**SMALL, key: kind(**fields)})

                    self.judge(draw, {name: HOSTILE[label]}, "style" if key == "style" else name, f"{kind.__name__} {label}")


if __name__ == "__main__":
    main()
