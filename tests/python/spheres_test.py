"""bihive.Spheres: arrays of every kind, what they hold afterwards, and errors that name the argument."""

import array
import copy
import pathlib
import pickle
import tempfile
import time
import unittest

import bihive as bh
import numpy as np

RNG = np.random.default_rng(7)


class OnlyDlpack:
    """An array of a library that knows nothing but DLPack."""

    def __init__(self, values, device=None):
        self.values = values
        self.device = device

    def __dlpack__(self, stream=None):
        return self.values.__dlpack__()

    def __dlpack_device__(self):
        return self.device or self.values.__dlpack_device__()


class OnlyInterface:
    def __init__(self, values):
        self.values = values
        self.__array_interface__ = values.__array_interface__


class Arrays(unittest.TestCase):
    def assert_same(self, value, xyz):
        """The set of `value` holds what that of a plain float64 copy holds."""
        expected = bh.Spheres(np.ascontiguousarray(xyz, dtype=np.float64), radius=0.5)
        np.testing.assert_array_equal(bh.Spheres(value, radius=0.5).xyz, expected.xyz)

    def test_types_and_layouts(self):
        single = RNG.normal(size=(50, 3)).astype(np.float32)
        double = RNG.normal(size=(50, 3)) * 1e3
        for values in [single, double]:
            wide = np.zeros((100, 7), dtype=values.dtype)
            wide[::2, 1:7:2] = values
            frozen = values.copy()
            frozen.setflags(write=False)
            raw = b"x" + values.tobytes()
            unaligned = np.frombuffer(raw, dtype=values.dtype, offset=1).reshape(50, 3)
            self.assertFalse(unaligned.flags.aligned)
            for same in [
                values,
                np.asfortranarray(values),
                wide[::2, 1:7:2],
                values[::-1][::-1],
                frozen,
                unaligned,
                values.astype(values.dtype.newbyteorder()),
                memoryview(values),
                OnlyInterface(values),
                OnlyDlpack(values),
                values.tolist(),
                values.astype(object),
                np.ma.array(values),
                values.astype(np.longdouble),
            ]:
                self.assert_same(same, values)
            self.assert_same(values[::-1], np.array(values)[::-1].copy())
        whole = RNG.integers(-100, 100, size=(20, 3))
        for kind in [np.int8, np.int64, np.float16, object]:
            self.assert_same(whole.astype(kind), whole)

    def test_fourth_column_and_radii(self):
        four = np.abs(RNG.normal(size=(30, 4))).astype(np.float32)
        np.testing.assert_array_equal(bh.Spheres(four).radius, bh.Spheres(four[:, :3], four[:, 3]).radius)
        np.testing.assert_array_equal(bh.Spheres(four[:, :3], four[::-1, 3]).radius, four[::-1, 3])
        np.testing.assert_array_equal(bh.Spheres(four[:, :3], array.array("d", [0.25] * 30)).radius, [0.25] * 30)
        np.testing.assert_array_equal(bh.Spheres(four[:, :3], np.float32(0.5)).radius, [0.5] * 30)
        np.testing.assert_array_equal(bh.Spheres(four[:, :3], 2).radius, [2] * 30)

    def test_large_and_small_worlds_keep_their_precision(self):
        for scale in [1e-20, 1e20]:
            xyz = RNG.normal(size=(40, 3)) * scale
            np.testing.assert_allclose(bh.Spheres(xyz, radius=scale).xyz, xyz, rtol=1e-7, atol=1e-7 * scale)

    def test_empty(self):
        for empty in [np.zeros((0, 3)), np.zeros((0, 4), np.float32), np.zeros((0, 3), dtype=int), []]:
            s = bh.Spheres(empty)
            self.assertEqual((len(s), s.xyz.shape, s.radius.shape), (0, (0, 3), (0,)))
        s = bh.Spheres(np.zeros((0, 3)), radius=[], colour=np.zeros((0, 3)), columns={"charge": []})
        self.assertEqual((len(s), s["charge"].tolist()), (0, []))
        with self.assertRaisesRegex(bh.InputError, "there are no spheres to draw"):
            bh.render(s, size=(8, 8))
        t, i = bh.Tree(s).closest([[0, 0, 0]], [1, 0, 0])
        self.assertEqual((t.tolist(), i.tolist()), ([np.inf], [-1]))

    def test_numbers_that_are_none(self):
        for bad, what in [(np.nan, "nan"), (np.inf, "inf"), (1e39, r"1e\+39")]:
            xyz = np.zeros((9, 3))
            xyz[6, 1] = bad
            with self.assertRaisesRegex(ValueError, f"sphere 6: y must .* is {what}"):
                bh.Spheres(xyz, radius=1)
            with self.assertRaisesRegex(bh.InputError, f"sphere 4: the radius must .* is {what}"):
                bh.Spheres(np.zeros((9, 3)), radius=np.where(np.arange(9) == 4, bad, 1))
        with self.assertRaisesRegex(ValueError, "sphere 0: the radius must not be negative"):
            bh.Spheres(np.zeros((9, 3)), radius=-1)
        # Sphere without extent, and attributes that are not known, are no errors.
        self.assertEqual(len(bh.Spheres(np.zeros((9, 3)), radius=0, columns={"charge": np.full(9, np.nan)})), 9)

    def test_errors_name_the_argument(self):
        xyz = np.zeros((4, 3))
        for call, argument in [
            (lambda: bh.Spheres(np.zeros((4, 2)), 1), "xyz"),
            (lambda: bh.Spheres(np.zeros(4), 1), "xyz"),
            (lambda: bh.Spheres(np.zeros((2, 4, 3)), 1), "xyz"),
            (lambda: bh.Spheres("abc", 1), "xyz"),
            (lambda: bh.Spheres(xyz.astype(complex), 1), "xyz"),
            (lambda: bh.Spheres([["a", "b", "c"]], 1), "xyz"),
            (lambda: bh.Spheres([[1, 2, 3], [1, 2]], 1), "xyz"),
            (lambda: bh.Spheres(np.ma.masked_equal(xyz, 0), 1), "xyz"),
            (lambda: bh.Spheres(OnlyDlpack(xyz, device=(2, 0)), 1), "xyz"),
            (lambda: bh.Spheres(xyz), "radius"),
            (lambda: bh.Spheres(xyz, radius=[1, 2]), "radius"),
            (lambda: bh.Spheres(np.zeros((4, 4)), radius=1), "radius"),
            (lambda: bh.Spheres(xyz, element=[6, 6, 0, 6]), "radius"),
            (lambda: bh.Spheres(xyz, 1, element=[6, 6, 300, 6]), "element"),
            (lambda: bh.Spheres(xyz, 1, element=[6.5] * 4), "element"),
            (lambda: bh.Spheres(xyz, 1, type=[2**40] * 4), "type"),
            (lambda: bh.Spheres(xyz, 1, colour="no colour"), "colour"),
            (lambda: bh.Spheres(xyz, 1, colour=np.full((4, 3), 1.5)), "colour"),
            (lambda: bh.Spheres(xyz, 1, colour=np.full((4, 3), np.nan)), "colour"),
            (lambda: bh.Spheres(xyz, 1, colour=np.zeros((3, 3))), "colour"),
            (lambda: bh.Spheres(xyz, 1, opacity=2), "opacity"),
            (lambda: bh.Spheres(xyz, 1, cell=np.zeros((2, 3))), "cell"),
            (lambda: bh.Spheres(xyz, 1, columns={"charge": [1, 2]}), "charge"),
            (lambda: bh.Spheres(xyz, 1, columns={"x": [1, 2, 3, 4]}), "columns"),
        ]:
            with self.assertRaises(bh.UsageError) as caught:
                call()
            self.assertEqual(caught.exception.argument, argument)
            self.assertTrue(str(caught.exception).startswith(argument + ": "), caught.exception)
            self.assertIsInstance(caught.exception, ValueError)
            self.assertIsInstance(pickle.loads(pickle.dumps(caught.exception)), bh.UsageError)


class Attributes(unittest.TestCase):
    def test_colours(self):
        xyz = np.zeros((2, 3))
        by_name = bh.Spheres(xyz, 1, colour=["red", "#804020"])
        by_byte = bh.Spheres(xyz, 1, colour=np.array([[255, 0, 0], [0x80, 0x40, 0x20]], dtype=np.uint8))
        np.testing.assert_array_equal(by_name["colour"], by_byte["colour"])
        self.assertAlmostEqual(by_byte["colour"][1, 0], 128 / 255, places=6)
        np.testing.assert_array_equal(bh.Spheres(xyz, 1, colour="blue")["colour"], [[0, 0, 1]] * 2)

    def test_floats_are_what_a_screen_shows_unless_said_otherwise(self):
        xyz = np.zeros((2, 3))
        on_screen = bh.Spheres(xyz, 1, colour=(128 / 255, 64 / 255, 0))
        self.assertEqual(on_screen, bh.Spheres(xyz, 1, colour="#804000"))
        np.testing.assert_allclose(on_screen["colour"], [[128 / 255, 64 / 255, 0]] * 2, atol=1e-6)
        light = bh.Spheres(xyz, 1, colour=bh.linear((0.5, 0.25, 0)))
        self.assertAlmostEqual(light["colour"][0, 0], 1.055 * 0.5 ** (1 / 2.4) - 0.055, places=6)
        # What a set gives it takes, to the last bit.
        colours = bh.Spheres(np.zeros((500, 3)), 1, colour=bh.linear(RNG.random((500, 3))))
        self.assertEqual(bh.Spheres(colours.xyz, 1, colour=colours["colour"]), colours)
        self.assertEqual(pickle.loads(pickle.dumps(light)), light)
        for bad in (1.5, np.nan, -0.1):
            with self.assertRaisesRegex(bh.UsageError, "light: expected colours from 0 to 1"):
                bh.linear((bad, 0, 0))

    def test_colours_of_options(self):
        self.assertEqual(bh.Look(colour="#804000").words()[1].count("#"), 1)
        look = dict(size=(24, 18), samples=1, style="plain")
        s = bh.Spheres(np.zeros((1, 3)), 1)
        for name in ("background", "outline_colour"):
            more = {**look, "outline": 1} if name == "outline_colour" else look
            named = bh.render(s, **more, **{name: "#804000"})
            for same in ((128 / 255, 64 / 255, 0), np.array([128, 64, 0], dtype=np.uint8)):
                self.assertEqual(np.asarray(bh.render(s, **more, **{name: same})).tolist(), np.asarray(named).tolist(), name)
        # A picture without a curve shows the same numbers.
        bare = {**look, "transfer": "none", "background": (128 / 255, 64 / 255, 0)}
        self.assertEqual(np.asarray(bh.render(s, **bare))[0, 0, :3].tolist(), [128, 64, 0])
        scene = bh.render("scenario1", count=2, size=(8, 8), samples=1, background=(128 / 255, 64 / 255, 0))
        self.assertEqual(np.asarray(scene)[0, 0, :3].tolist(), [128, 64, 0])
        named, numbers = (bh.Look(colour=one) for one in ("#804000", (128 / 255, 64 / 255, 0)))
        self.assertEqual(np.asarray(bh.render(s, looks=named, **look)).tolist(), np.asarray(bh.render(s, looks=numbers, **look)).tolist())
        self.assertEqual(bh.Look(colour=bh.linear((0.5, 0, 0))).words(), ["--select=all", "--colour=0.5,0.0,0.0"])
        self.assertEqual(bh.Look(colour=bh.linear((0.5, 0, 0))), bh.Look(colour=bh.linear((0.5, 0, 0))))
        with self.assertRaisesRegex(bh.UsageError, "background: expected a name, '#rrggbb', or three numbers"):
            bh.render(s, background=(1, 0), **look)

    def test_elements(self):
        xyz = np.zeros((3, 3))
        s = bh.Spheres(xyz, element=["C", "Fe", "cl"])
        self.assertEqual(s["element"].tolist(), [6, 26, 17])
        self.assertEqual(s, bh.Spheres(xyz, element=[6, 26, 17]))
        self.assertAlmostEqual(s.radius[0], 1.7, places=6)
        self.assertEqual(bh.Spheres(xyz, element="C")["element"].tolist(), [6, 6, 6])

    def test_columns_and_parts(self):
        s = bh.Spheres(np.arange(30).reshape(10, 3), radius=np.arange(10), columns={"charge": np.arange(10) - 5, "chain": list("AAAAABBBBB")})
        self.assertEqual(s.columns, ["charge", "chain"])
        part = s[bh.select(s, "chain B and charge > 1")]
        self.assertEqual(part["charge"].tolist(), [2, 3, 4])
        self.assertEqual(part["chain"].tolist(), ["B"] * 3)
        self.assertEqual(s[-2:].radius.tolist(), [8, 9])
        self.assertEqual(len(s[3]), 1)
        np.testing.assert_array_equal(s["y"], s.xyz[:, 1])
        with self.assertRaisesRegex(KeyError, "there is no attribute 'mass'; there are x, y, z, radius, charge, chain"):
            s["mass"]
        with self.assertRaises(IndexError):
            s[[12]]
        with self.assertRaises(TypeError):
            list(s)

    def test_more_columns_and_other_places(self):
        s = bh.read("demo")
        charge = np.arange(len(s)) % 3 - 1.0
        more = s.with_columns({"charge": charge, "b_factor": np.zeros(len(s)), "kind": ["a"] * len(s)})
        np.testing.assert_array_equal(more["charge"], charge)
        self.assertEqual((set(more["b_factor"]), set(more["kind"])), ({0.0}, {"a"}))
        np.testing.assert_array_equal(more.xyz.view(np.int64), s.xyz.view(np.int64))
        self.assertEqual((more.name, more.format, more.rules), (s.name, s.format, s.rules))
        self.assertNotIn("charge", s.columns)
        self.assertNotIn("kind", more.with_columns({"kind": None}).columns)
        self.assertEqual(more.with_columns({"charge": ["x"] * len(s)})["charge"][0], "x")
        moved = more.moved(s.xyz + 1)
        np.testing.assert_allclose(moved.xyz, s.xyz + 1, rtol=1e-6)
        np.testing.assert_array_equal(moved.radius, s.radius)
        self.assertEqual(int(bh.select(moved, "kind a and chain A").sum()), int(bh.select(s, "chain A").sum()))
        for call, argument in [
            (lambda: s.with_columns({"x": charge}), "columns"),
            (lambda: s.with_columns({"charge": charge[1:]}), "charge"),
            (lambda: s.with_columns({"mass": None}), "columns"),
            (lambda: s.with_columns([1]), "columns"),
            (lambda: s.moved(s.xyz[1:]), "xyz"),
            (lambda: s.moved(s.xyz, -1), "radius"),
        ]:
            with self.assertRaises(ValueError) as caught:
                call()
            self.assertIn(argument, str(caught.exception))

    def test_symbols_of_elements(self):
        self.assertEqual(bh.Spheres(np.zeros((3, 3)), 1, element=["O", "Ca", 0][:2] + ["C"]).elements.tolist(), ["O", "Ca", "C"])
        self.assertEqual(bh.Spheres(np.zeros((2, 3)), 1, element=[0, 6]).elements.tolist(), ["", "C"])
        self.assertIsNone(bh.Spheres(np.zeros((2, 3)), 1).elements)

    def test_a_bad_selection_shows_its_place(self):
        s = bh.Spheres(np.zeros((2, 3)), 1)
        with self.assertRaises(bh.UsageError) as caught:
            bh.select(s, "x > 1 and and")
        self.assertEqual(caught.exception.argument, "expression")
        self.assertRegex(str(caught.exception), r"\Aexpression: column 11: [^\n]+\n  x > 1 and and\n {12}\^\Z")

    def test_copies_and_pickles(self):
        s = bh.Spheres(
            RNG.normal(size=(20, 3)),
            radius=RNG.random(20),
            colour=RNG.random((20, 3)),
            opacity=0.5,
            element=6,
            type=np.arange(20),
            cell=(1, 2, 3),
            columns={"charge": [np.nan] + [1.0] * 19, "label": ["a b"] * 20},
        )
        for same in [copy.copy(s), copy.deepcopy(s), pickle.loads(pickle.dumps(s)), s[:], s[np.ones(20, bool)], s[range(20)]]:
            self.assertEqual(same, s)
            self.assertEqual(repr(same), "<bihive.Spheres: 20 spheres, element, type, colour, opacity, charge, label>")
        self.assertNotEqual(s, s[1:])
        self.assertEqual(s.cell.tolist(), [[1, 0, 0], [0, 2, 0], [0, 0, 3], [0, 0, 0]])

    def test_copies_keep_what_the_file_says(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "run.lammpstrj")
            frame = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id type x y z\n1 1 1 1 1\n2 2 3 3 3\n"
            path.write_text(frame.format(10) + frame.format(20))
            s, first = bh.read(path, frame=1, radius=1), bh.read(path, radius=1)
            path = pathlib.Path(folder, "run.gro")
            path.write_text("a t= 2.5\n1\n    1ALA     CA    1   0.000   0.000   0.000\n 1 1 1\n")
            timed = bh.read(path, radius=1)
        self.assertEqual((s.step, s.frames, timed.time_ps), (20, 2, 2.5))
        self.assertEqual((s.title, timed.title, bh.read("demo").entry_id), ("", "a", "1HPV"))
        self.assertNotEqual(s, first)
        for whole in (s, timed):
            for same in [copy.copy(whole), copy.deepcopy(whole), pickle.loads(pickle.dumps(whole)), whole[:]]:
                self.assertEqual(same, whole)
                facts = [(one.step, one.frames, one.time_ps, one.rules, one.format, one.name, one.title, one.entry_id) for one in (same, whole)]
                self.assertEqual(*facts)
        self.assertEqual(s[1:].step, 20)
        # A state of an earlier version has no such facts.
        state = {key: value for key, value in s.__getstate__().items() if key not in ("title", "entry_id", "frames", "time_ps", "step", "rules")}
        old = bh.Spheres.__new__(bh.Spheres)
        old.__setstate__(state)
        self.assertEqual((old.step, old.frames, old.rules, old.title), (None, 1, [], ""))

    def test_positions(self):
        s = bh.Spheres(np.arange(30).reshape(10, 3), radius=1, columns={"name": [f"n{i}" for i in range(10)]})
        for key, expected in (
            ([], []),
            (np.zeros(0, int), []),
            (np.zeros(10, bool), []),
            (slice(5, 2), []),
            (slice(None, None, -3), [9, 6, 3, 0]),
            ([-1, 0, 0], [9, 0, 0]),
            (np.array([3, 1], np.uint8), [3, 1]),
            (np.int64(4), [4]),
            (np.arange(10) > 7, [8, 9]),
        ):
            part = s[key]
            self.assertEqual(part["name"].tolist(), [f"n{i}" for i in expected])
            np.testing.assert_array_equal(part.xyz, s.xyz[np.array(expected, int)])
        for key in ([10], [-11], [True], [[1, 2]], np.array([2**63], np.uint64)):
            with self.assertRaisesRegex(IndexError, "bihive.Spheres of 10: expected "):
                s[key]
        for key in ([0.5], None, "a b".split(), slice("a", "b")):
            with self.assertRaisesRegex(TypeError, "bihive.Spheres of 10 cannot be indexed by "):
                s[key]

    def test_a_part_takes_time_by_what_is_asked_for(self):
        count = 300_000
        texts = [f"t{i}" for i in range(count)]
        s = bh.Spheres(np.zeros((count, 3)), radius=1, columns={"q": np.arange(count), "a": texts, "b": texts})

        def best(call):
            times = []
            for _ in range(5):
                begun = time.process_time()
                call()
                times.append(time.process_time() - begun)
            return min(times)

        all_texts = best(lambda: s["a"])
        for call in (lambda: s["q"], lambda: s[:10], lambda: s.columns, lambda: s[[5, 7]], lambda: repr(s)):
            self.assertLess(best(call), all_texts / 3)

    def test_integers_are_exact_or_refused(self):
        xyz = np.zeros((2, 3))
        for exact in (2**53, -(2**53), 2**60, 7):
            self.assertEqual(bh.Spheres(xyz, 1, columns={"id": [exact, 0]})["id"].tolist(), [exact, 0])
        for rounded in (2**53 + 1, -(2**53) - 1, 2**63 - 1, 2**64 - 1):
            with self.assertRaisesRegex(bh.UsageError, "^id: sphere 1: .* is beyond 2.53.*; give texts$") as caught:
                bh.Spheres(xyz, 1, columns={"id": np.array([0, rounded], np.uint64 if rounded > 2**63 else np.int64)})
            self.assertEqual(caught.exception.argument, "id")

    def test_the_arrays_are_nobody_elses(self):
        xyz = np.zeros((2, 3))
        s = bh.Spheres(xyz, 1)
        xyz[:] = 9
        s.xyz[:] = 5
        self.assertEqual(s.xyz.tolist(), [[0, 0, 0], [0, 0, 0]])

    def test_memory(self):
        s = bh.Spheres(np.zeros((100_000, 3), dtype=np.float32), radius=1)
        self.assertEqual(s.nbytes, 100_000 * 16)


class ColourMap(unittest.TestCase):
    def test_ends_and_unknown(self):
        colours = bh.colour_map([0.0, 3.0, 5.0, np.nan], "viridis", range=(0, 3), nan_colour="red")
        np.testing.assert_array_equal(colours[1], colours[2])
        np.testing.assert_array_equal(colours[3], [1, 0, 0])
        self.assertEqual(colours.dtype, np.float64)
        self.assertLess(colours[0].sum(), colours[1].sum())

    def test_own_colours(self):
        values = [0.0, 0.5, 1.0]
        colours = bh.colour_map(values, ["black", "#0000ff", "red"])
        np.testing.assert_array_equal(colours, [[0, 0, 0], [0, 0, 1], [1, 0, 0]])
        np.testing.assert_array_equal(colours, bh.colour_map(values, "black-#0000ff-red"))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "map.txt")
            path.write_text("0 0 0\n0 0 1\n1 0 0\n")
            for name in (path, str(path)):
                np.testing.assert_array_equal(bh.colour_map(values, name), colours)
            path.write_text("0 0 0\n0 0\n")
            with self.assertRaisesRegex(bh.InputError, "map.txt:2: expected a colour"):
                bh.colour_map(values, path)
        for wrong in (["red"], ["red"] * 1025, ["red", "rde"], ["red", 1], 5):
            with self.assertRaisesRegex(bh.UsageError, "map"):
                bh.colour_map(values, wrong)

    def test_names_of_other_programs_are_no_columns(self):
        for other, ours in (
            ("opacty", "opacity"),
            ("alpha", "opacity"),
            ("colr", "color"),
            ("colors", "colour"),
            ("elements", "element"),
            ("pbc", "periodic"),
            ("centres_", "centres"),
        ):
            with self.assertRaisesRegex(bh.UsageError, f"{other}: is no argument; did you mean {ours}.*columns=") as caught:
                bh.Spheres([[0, 0, 0]], radius=1, **{other: [1]})
            self.assertEqual(caught.exception.argument, other)
        with self.assertRaisesRegex(bh.UsageError, r"^charge: is no argument; attributes of your own go into columns=\{\.\.\.\}$"):
            bh.Spheres([[0, 0, 0]], radius=1, charge=[1])
        self.assertEqual(bh.Spheres([[0, 0, 0]], radius=1, columns={"radii": [3]})["radii"].tolist(), [3])

    def test_other_spellings_of_arguments(self):
        xyz = np.arange(6.0).reshape(2, 3)
        s = bh.Spheres(xyz, radius=[1, 2], colour=["red", "blue"])
        for name in ("center", "centers", "centre", "centres"):
            self.assertEqual(bh.Spheres(**{name: xyz}, radii=[1, 2], color=["red", "blue"]), s)
        self.assertEqual(bh.Spheres(xyz, diameter=[2, 4], colour=["red", "blue"]), s)
        self.assertEqual(bh.Spheres(xyz, diameter=2).radius.tolist(), [1, 1])
        for names, argument in (
            ({"radius": 1, "radii": 1}, "radii"),
            ({"radii": 1, "diameter": 1}, "diameter"),
            ({"radius": 1, "colour": "red", "color": "red"}, "color"),
            ({"radius": 1, "center": xyz}, "center"),
        ):
            with self.assertRaisesRegex(bh.UsageError, f"{argument}: is another name of .* leave one of them out") as caught:
                bh.Spheres(xyz, **names)
            self.assertEqual(caught.exception.argument, argument)
        for names, argument in (({"center": np.zeros(4), "radius": 1}, "center"), ({"xyz": xyz, "diameter": [1]}, "diameter"), ({}, "xyz")):
            with self.assertRaises(bh.UsageError) as caught:
                bh.Spheres(**names)
            self.assertEqual(caught.exception.argument, argument)

    def test_what_is_not_there_is_told(self):
        with self.assertWarnsRegex(bh.InputWarning, "'element Fe' takes no sphere: no sphere has element Fe; there are C, N, O, S"):
            bh.select(bh.read("demo"), "element Fe")
        with self.assertWarnsRegex(bh.InputWarning, "no periodic images"):
            bh.Spheres([[0, 0, 0]], radius=1, cell=[[1, 0, 0], [2, 0, 0], [0, 0, 1]])

    def test_categories(self):
        colours = bh.colour_map(["a", "b", "a"])
        np.testing.assert_array_equal(colours[0], colours[2])
        self.assertTrue((colours[0] != colours[1]).any())

    def test_the_command_lines_colours(self):
        z = RNG.normal(size=50)
        s = bh.Spheres(np.c_[np.zeros((50, 2)), z], radius=0.1)
        coloured = bh.Spheres(s.xyz, radius=0.1, colour=bh.colour_map(s.xyz[:, 2], "magma"))
        options = dict(size=(40, 30), style="plain")
        self.assertEqual(bh.render(s, colour_by="z:magma", **options), bh.render(coloured, **options))

    def test_errors(self):
        for call, argument in [
            (lambda: bh.colour_map([[1, 2]]), "values"),
            (lambda: bh.colour_map([1, 2], "rainbow"), "map"),
            (lambda: bh.colour_map([1, 2], range=(1,)), "range"),
            (lambda: bh.colour_map([1, 2], range=(2, 1)), "range"),
            (lambda: bh.colour_map([1, 2], "viridis", range=(0, 1), log=True), "range"),
            (lambda: bh.colour_map([1, 2], nan_colour="nice"), "nan_colour"),
        ]:
            with self.assertRaises(bh.UsageError) as caught:
                call()
            self.assertEqual(caught.exception.argument, argument)
        np.testing.assert_array_equal(bh.colour_map([np.nan], nan_colour="red"), [[1, 0, 0]])
        self.assertEqual(bh.colour_map([]).shape, (0, 3))


if __name__ == "__main__":
    unittest.main()
