"""Spheres: arrays in, a set for pictures and trees out."""

from __future__ import annotations

import difflib
import os
import re
import warnings
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np

from . import _bihive
from ._arrays import as_array, numbers, one_each, texts, whole_numbers
from ._checks import boolean, mapping, one_of, path_of, several, text_of, whole_text
from ._colours import Linear, light_of
from ._errors import FileError, InputError, InputWarning, UsageError, bad_argument, found, shortened, writing
from ._options import words_of
from ._progress import Bar, Progress
from ._select import chosen

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    from ._option_types import ReadOptions
    from ._types import Booleans, Floats

__all__ = ["Spheres", "read", "convert", "select", "stats", "colour_map"]

Array = np.ndarray[Any, Any]
_BUILT_IN = ["demo", "scenario1", "scenario2", "scenario3", "four-spheres"]
_WRITTEN = {".xyz": "xyz", ".extxyz": "extxyz", ".csv": "csv", ".npy": "npy", ".ply": "ply", ".sdf": "sdf", ".mol": "sdf", ".mol2": "mol2"}
_MAPS = [name + tail for name in _bihive.colour_maps() for tail in ("", "_r") if name != "okabe-ito" or not tail]
_OF_SETS = ["x", "y", "z", "r", "radius", "index", "element", "type", "opacity", "colour"]
_TYPES = (-(2**31), 2**31 - 1)
_MOST_SHOWN = 200000  # spheres that show themselves as a picture in a notebook
_OF_FRAMES = ("title", "entry_id", "frames", "time_ps", "step", "rules")
_READING = [*_bihive.reading_settings(), "count", "seed"]


def _warn_of(core: _bihive.Spheres) -> None:
    """Tells of the reader's doubts, at the line that called the library's function."""
    for warning in core.warnings:
        warnings.warn(warning, InputWarning, stacklevel=3)


def _opacities(value: Any, count: int) -> Array:
    array = one_each("opacity", value, count)
    if count > 0 and not bool(((array >= 0) & (array <= 1)).all()):
        raise bad_argument("opacity", "expected numbers from 0 (clear) to 1")
    return array


def _elements(value: Any, count: int) -> Array:
    """uint8: atomic numbers, 0 for unknown ones."""
    array = as_array("element", value)
    if array.ndim == 0 and array.dtype.kind in "US":
        array = np.broadcast_to(array, (count,))
    if array.dtype.kind in "USO":
        symbols = texts("element", array, count)
        known = {symbol: _bihive.atomic_number(symbol.strip()) for symbol in set(symbols)}
        return np.array([known[symbol] for symbol in symbols], dtype=np.uint8)
    return whole_numbers("element", array, count, 0, 118).astype(np.uint8)


def _radii_of(elements: Array) -> Array:
    table = np.array([_bihive.van_der_waals_radius(number) for number in range(119)])
    radii: Array = table[elements]
    unknown = np.flatnonzero(radii == 0)
    if len(unknown) > 0:
        raise bad_argument("radius", f"sphere {unknown[0]} has no known element, and so no radius", "give radius")
    return radii


def _cell(value: Any) -> Array:
    """(4, 3): three vectors, then the origin."""
    array = numbers("cell", value)
    if array.shape == (3,):
        array = np.diag(array)
    if array.shape == (3, 3):
        array = np.vstack([array, np.zeros((1, 3))])
    if array.shape != (4, 3) or not bool(np.isfinite(array).all()):
        raise bad_argument("cell", "expected 3 lengths, 3 vectors (3, 3), or 3 vectors and a corner (4, 3), all finite")
    return array


def _periodic(value: Any) -> tuple[bool, bool, bool]:
    """For each vector of the cell."""
    flags = as_array("periodic", value)
    if flags.dtype.kind not in "bui" or flags.shape not in ((), (3,)) or not bool(np.isin(flags, (0, 1)).all()):
        raise bad_argument("periodic", f"expected True, False or three of them, found {found(value)}")
    a, b, c = np.broadcast_to(flags, 3)
    return bool(a), bool(b), bool(c)


# Other spellings of arguments, which mean the same; a diameter is halved.
_ALIASES = {
    "color": "colour",
    **dict.fromkeys(("center", "centers", "centre", "centres"), "xyz"),
    **dict.fromkeys(("radii", "diameter"), "radius"),
}
# Names that other programs have for arguments.
_OTHER_NAMES = {
    **dict.fromkeys(("colors", "colours", "rgb", "c"), "colour"),
    **dict.fromkeys(("positions", "points", "coordinates", "pos"), "xyz"),
    **dict.fromkeys(("radiuses", "size", "sizes", "diameters"), "radius"),
    **dict.fromkeys(("elements", "symbols", "species"), "element"),
    **dict.fromkeys(("types",), "type"),
    **dict.fromkeys(("alpha", "opacities", "transparency"), "opacity"),
    **dict.fromkeys(("box", "lattice"), "cell"),
    **dict.fromkeys(("pbc",), "periodic"),
}
_ARGUMENTS = ["xyz", "radius", "colour", "opacity", "element", "type", "cell", "periodic", "name", "columns", "bonds"]


def _unknown_argument(name: str) -> UsageError:
    near = difflib.get_close_matches(name, [*_ARGUMENTS, *_ALIASES], 1)
    meant = _OTHER_NAMES.get(name.lower()) or (near[0] if near else "")
    hint = (f"did you mean {meant}; " if meant else "") + "attributes of your own go into columns={...}"
    return bad_argument(shortened(name, 60), "is no argument", hint)


def _by_their_own_names(given: dict[str, Any], others: dict[str, Any]) -> tuple[dict[str, Any], dict[str, str]]:
    """The arguments with the other spellings among them; and for each of these the spelling."""
    spelled: dict[str, str] = {}
    for other, value in others.items():
        own = _ALIASES.get(other)
        if own is None:
            raise _unknown_argument(other)
        if value is None:
            continue
        if given[own] is not None:
            raise bad_argument(other, f"is another name of {own}, which is given as {spelled.get(own, own)}", "leave one of them out")
        given[own] = value
        spelled[own] = other
    return given, spelled


def _exact_numbers(name: str, value: Any, count: int) -> Array:
    """float64, for each sphere. Integers that float64 does not hold are refused, and not rounded."""
    array = as_array(name, value)
    made = np.asarray(one_each(name, array, count), dtype=np.float64)
    if array.dtype.kind in "iu" and array.dtype.itemsize == 8 and array.size > 0:
        whole = np.broadcast_to(array, (count,))
        for position in np.flatnonzero(np.abs(made) >= 2.0**53):
            if int(made[position]) == int(whole[position]):
                continue
            raise bad_argument(
                name, f"sphere {position}: {whole[position]} is beyond 2^53, where float64 does not hold every integer", "give texts"
            )
    return made


def _columns(columns: Any, count: int) -> tuple[dict[str, Array], dict[str, list[str]]]:
    """Attributes of spheres by name: numbers, and texts."""
    numbers_of: dict[str, Array] = {}
    texts_of: dict[str, list[str]] = {}
    for column, values in mapping("columns", columns).items():
        if not isinstance(column, str) or not column or column in _OF_SETS:
            raise bad_argument("columns", f"{found(column)} cannot be the name of a column")
        whole_text("columns", column)
        array = as_array(column, values)
        if array.dtype.kind in "USO":
            texts_of[column] = texts(column, array, count)
        else:
            numbers_of[column] = _exact_numbers(column, array, count)
    return numbers_of, texts_of


def _bonds(value: Any, count: int) -> Array:
    """int32 (k, 3): two spheres and an order."""
    array = as_array("bonds", value)
    if array.shape == (0,):
        array = np.zeros((0, 2), dtype=np.int32)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise bad_argument("bonds", f"expected shape (n, 2) or (n, 3), found shape {array.shape}")
    ends = whole_numbers("bonds", array[:, :2].reshape(-1), array.shape[0] * 2, 0, count - 1).reshape(-1, 2)
    orders = whole_numbers("bonds", array[:, 2], array.shape[0], 0, 4) if array.shape[1] == 3 else np.zeros(len(array))
    same = np.flatnonzero(ends[:, 0] == ends[:, 1])
    if len(same) > 0:
        raise bad_argument("bonds", f"bond {same[0]} joins sphere {ends[same[0], 0]} and itself")
    return np.ascontiguousarray(np.column_stack([ends, orders]), dtype=np.int32)


def _positions(key: Any, count: int) -> Array:
    """int64 (n,), each from 0 to before `count`: of a slice, a mask, one position or several. Takes time by what is chosen."""
    if isinstance(key, slice):
        return np.arange(*key.indices(count), dtype=np.int64)
    array = np.asarray(key)
    if array.size == 0 and array.ndim == 1 and array.dtype.kind == "f":  # []
        return np.zeros(0, dtype=np.int64)
    if array.dtype.kind not in "biu":
        raise TypeError(f"expected positions or a mask, found dtype {array.dtype}")
    if array.ndim > 1:
        raise IndexError(f"expected one axis of positions, found shape {array.shape}")
    if array.dtype.kind == "b":
        if array.shape != (count,):
            raise IndexError(f"expected a mask of shape ({count},), found shape {array.shape}")
        return np.flatnonzero(array)
    array = np.atleast_1d(array)
    bad = (array < -count) | (array >= count) if array.dtype.kind == "i" else array >= count
    if bad.any():
        raise IndexError(f"expected positions from {-count} to {count - 1}, found {array[bad.argmax()]}")
    chosen: Array = array.astype(np.int64)
    chosen[chosen < 0] += count
    return chosen


class Spheres:
    """Spheres with their attributes: an immutable set.

    xyz: float32 or float64, shape (n, 3): centres, in world units of any size; or (n, 4): and radii. Read where it lies,
        with any strides, and rounded once to binary32 in a scale of the set's own; other real types are copied first. Also
        as center, centers, centre, centres.
    radius: one number, or shape (n,); at least 0. Left out: the fourth column, else van der Waals radii by element. Also as
        radii, or as diameter, of which it is half.
    colour: one colour, or shape (n, 3): as a screen shows it, floats from 0 to 1 (as matplotlib and colour_map() make them) or
        uint8, or linear(light); or n names or "#rrggbb". Left out: by element or type, else the style's. Also as color.
    opacity: one number, or shape (n,): 0 (clear) to 1.
    element: atomic numbers (0: unknown) or symbols, shape (n,), or one.
    type: whole numbers, shape (n,), or one.
    cell: the periodic cell: three lengths, vectors (3, 3), or vectors and corner (4, 3).
    periodic: whether distances (selections, Tree) see the images along the cell; or three of them, one for each vector.
    columns: attributes of your own by name, each of shape (n,) or one number: numbers or texts. Selections and colour_by know
        them. Integers that float64 does not hold (above 2**53) are refused: give them as texts.
    bonds: pairs of positions, shape (k, 2), or with an order, (k, 3): 0 (unknown), 1, 2, 3 or 4 (aromatic). What
        render(..., bonds="file") draws as sticks, between spheres of any kind.

    Raises UsageError (a ValueError) that names the argument, InputError for a coordinate or radius that is NaN, infinite,
    beyond 3.4e38 or negative; its message has the sphere's position.

    >>> import numpy as np
    >>> s = Spheres(np.zeros((2, 3)), radius=[1, 2], columns={"charge": [-1, 1]})
    >>> s
    <bihive.Spheres: 2 spheres, charge>
    >>> s["charge"].tolist(), s[s["charge"] > 0].radius.tolist()
    ([-1.0, 1.0], [2.0])
    """

    def __init__(
        self,
        xyz: Optional[npt.ArrayLike] = None,
        radius: Optional[npt.ArrayLike] = None,
        colour: Union[npt.ArrayLike, Linear, None] = None,
        opacity: Optional[npt.ArrayLike] = None,
        *,
        element: Optional[npt.ArrayLike] = None,
        type: Optional[npt.ArrayLike] = None,
        cell: Optional[npt.ArrayLike] = None,
        periodic: npt.ArrayLike = True,
        name: str = "spheres",
        columns: Optional[Mapping[str, npt.ArrayLike]] = None,
        bonds: Optional[npt.ArrayLike] = None,
        **other_names: Any,
    ) -> None:
        given, spelled = _by_their_own_names({"xyz": xyz, "radius": radius, "colour": colour}, other_names)
        colour, of_radius = given["colour"], spelled.get("radius", "radius")
        if given["xyz"] is None:
            raise bad_argument("xyz", "is missing", "give the centres, shape (n, 3)")
        places = numbers(spelled.get("xyz", "xyz"), given["xyz"])
        if places.shape == (0,):
            places = places.reshape(0, 3)
        if places.ndim != 2 or places.shape[1] not in (3, 4):
            raise bad_argument(spelled.get("xyz", "xyz"), f"expected shape (n, 3) or (n, 4), found shape {places.shape}")
        count = places.shape[0]
        elements = None if element is None else _elements(element, count)
        if places.shape[1] == 4:
            if given["radius"] is not None:
                raise bad_argument(of_radius, "the fourth column of xyz holds the radii", "leave one of them out")
            radii = places[:, 3]
        elif given["radius"] is not None:
            radii = one_each(of_radius, given["radius"], count)
            if of_radius == "diameter":
                radii = radii / 2
        elif elements is not None:
            radii = _radii_of(elements)
        elif count == 0:
            radii = np.zeros(0)
        else:
            raise bad_argument("radius", "is missing", "give one number, an array, or element")
        numbers_of, texts_of = _columns({} if columns is None else columns, count)
        self._core = _bihive.spheres_from_arrays(
            places,
            radii,
            elements,
            None if type is None else whole_numbers("type", type, count, *_TYPES).astype(np.int32),
            None if colour is None else np.asarray(light_of(spelled.get("colour", "colour"), colour, count), dtype=np.float32),
            None if opacity is None else np.asarray(_opacities(opacity, count), dtype=np.float32),
            list(numbers_of.items()),
            list(texts_of.items()),
            None if cell is None else np.asarray(_cell(cell), dtype=np.float64),
            _periodic(periodic),
            "array",
            text_of("name", name),
            1,
            None,
            None,
            [],
            "",
            "",
        )
        if bonds is not None:
            self._core = self._core.with_bonds(_bonds(bonds, count), True)
        _warn_of(self._core)

    @classmethod
    def _of(cls, core: _bihive.Spheres) -> Spheres:
        made = cls.__new__(cls)
        made._core = core
        return made

    @property
    def xyz(self) -> Floats:
        """float64 (n, 3): centres as they are kept, in world units; a new array."""
        return self._core.xyz

    @property
    def radius(self) -> Floats:
        """float64 (n,): radii as they are kept, in world units; a new array."""
        return self._core.radius

    @property
    def bounds(self) -> Floats:
        """float64 (2, 3): lowest and highest corner of the box around all spheres, world units."""
        return self._core.bounds

    @property
    def cell(self) -> Optional[Floats]:
        """float64 (4, 3): the three vectors of the periodic cell and its corner; None: there is none."""
        return self._core.cell

    @property
    def periodic(self) -> tuple[bool, bool, bool]:
        """Along which vectors of the cell distances see images; False without a cell."""
        a, b, c = self._core.periodic
        return a, b, c

    @property
    def bonds(self) -> Array:
        """int32 (k, 3): the bonds that the file states, or those given: two positions in ascending order, and 0 (order unknown), 1, 2,
        3 or 4 (aromatic); a new array."""
        return self._core.bonds

    @property
    def columns(self) -> list[str]:
        """The names of the attributes of spheres besides centre and radius."""
        return self._core.attributes

    @property
    def name(self) -> str:
        """The file that they come from, or the given name."""
        return self._core.name

    @property
    def title(self) -> str:
        """What the file says that it shows: TITLE of a PDB file, the name of a molecule...; "" if it says nothing."""
        return self._core.title

    @property
    def entry_id(self) -> str:
        """The entry of a database that the file states, such as "1HPV"; "" if it states none."""
        return self._core.entry_id

    @property
    def format(self) -> str:
        """The format of the file: "PDB", "XYZ"...; "array"."""
        return self._core.format

    @property
    def frames(self) -> int:
        """The number of frames in the file."""
        return self._core.frames

    @property
    def time_ps(self) -> Optional[float]:
        """The frame's time in picoseconds, if the file states it."""
        return self._core.time_ps

    @property
    def step(self) -> Optional[int]:
        """The frame's step, if the file states it."""
        return self._core.step

    @property
    def rules(self) -> list[str]:
        """The rules that the reader applied, one sentence each."""
        return self._core.rules

    @property
    def nbytes(self) -> int:
        """The memory of the set, in bytes."""
        return self._core.nbytes

    def save(self, path: Union[str, os.PathLike[str]], format: Optional[str] = None) -> list[str]:
        """Writes the spheres into a file of another format, whole or not at all, as ``bihive convert`` does.

        format: "xyz", "extxyz", "csv", "npy", "ply", "sdf" or "mol2"; left out: by the ending. Returns what the format cannot hold, a
        sentence each. Raises FileError (an OSError) if the file cannot be written.

        >>> import os, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = os.path.join(folder, "two.csv")
        ...     left_out = Spheres([[0, 0, 0], [1, 2, 3]], radius=0.5, columns={"charge": [-1, 1]}).save(path)
        ...     read(path)["charge"].tolist()
        [-1.0, 1.0]
        """
        text = path_of("path", path)
        ending = os.path.splitext(text)[1].lower()
        if format is None and ending == ".json":
            raise bad_argument("path", "the program bihive convert writes scene files", "or let it end in .csv or .extxyz")
        if format is None and ending not in _WRITTEN:
            raise bad_argument("path", f"expected an ending of {', '.join(_WRITTEN)}", "or give format")
        chosen = _WRITTEN[ending] if format is None else one_of("format", format, _WRITTEN.values())
        content, left_out = self._core.written(chosen)
        with writing(text):
            _bihive.write_file(os.fsencode(text), content)
        return left_out

    @property
    def elements(self) -> Optional[npt.NDArray[np.str_]]:
        """The symbols of the elements, str (n,), "" where none is known; None: the set has no elements. s["element"] are their
        numbers."""
        numbers_of = self._core.element
        if numbers_of is None:
            return None
        symbols = np.array([""] + [_bihive.element_symbol(number) for number in range(1, 119)])
        made: npt.NDArray[np.str_] = symbols[numbers_of]
        return made

    def with_columns(self, columns: Mapping[str, Optional[npt.ArrayLike]]) -> Spheres:
        """The same spheres with more attributes, or with others of the same names; all else stays, bit for bit.

        columns: as those of Spheres(). None as the values of a name: without it.

        >>> s = Spheres([[0.0, 0, 0], [1, 0, 0]], radius=[1, 2]).with_columns({"charge": [1, -1], "kind": ["a", "b"]})
        >>> s.with_columns({"charge": None}).columns
        ['kind']
        """
        without = [name for name, values in mapping("columns", columns).items() if values is None]
        for name in without:
            if name not in self.columns:
                raise bad_argument("columns", f"there is no column {found(name)} to leave out", f"there are {shortened(', '.join(self.columns))}")
        numbers_of, texts_of = _columns({name: values for name, values in columns.items() if values is not None}, len(self))
        return Spheres._of(self._core.with_columns(list(numbers_of.items()), list(texts_of.items()), without))

    def moved(self, xyz: npt.ArrayLike, radius: Optional[npt.ArrayLike] = None) -> Spheres:
        """The same spheres in other places: their attributes, cell and all else stay.

        xyz: shape (n, 3); radius: one number, or shape (n,); left out: they keep theirs.

        >>> Spheres([[0.0, 0, 0]], radius=2, columns={"charge": [1]}).moved([[5, 0, 0]]).bounds.tolist()
        [[3.0, -2.0, -2.0], [7.0, 2.0, 2.0]]
        """
        places = numbers("xyz", xyz)
        if places.shape != (len(self), 3):
            raise bad_argument("xyz", f"expected shape ({len(self)}, 3), found shape {places.shape}")
        radii = self.radius if radius is None else one_each("radius", radius, len(self))
        made = Spheres._of(self._core.moved(places, radii))
        _warn_of(made._core)
        return made

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, key: Any) -> Any:
        """s["charge"]: an attribute as an array. s[mask], s[ids], s[a:b]: these spheres alone, as a new set."""
        if isinstance(key, str):
            return self._attribute(key)
        count = len(self)
        try:
            chosen = _positions(key, count)
        except IndexError as error:
            raise IndexError(f"bihive.Spheres of {count}: {error}") from None
        except (TypeError, ValueError, RecursionError) as error:
            raise TypeError(f"bihive.Spheres of {count} cannot be indexed by {found(key)}: {shortened(str(error))}") from None
        return Spheres._of(self._core.part(chosen))

    def __iter__(self) -> Iterator[Any]:
        raise TypeError("Spheres are not a sequence of spheres: use s.xyz and s.radius")

    def _attribute(self, name: str) -> Array:
        if name in ("x", "y", "z"):
            return self.xyz[:, "xyz".index(name)]
        if name in ("r", "radius"):
            return self.radius
        if name in ("element", "type", "opacity", "colour"):
            value = getattr(self._core, name)
            if value is not None:
                return np.asarray(_bihive.screen_of_light(value) if name == "colour" else value)
        # A name with a lone surrogate has no encoding, and belongs to no column.
        value = self._core.column(name) if _has_encoding(name) else None
        if value is None and name == "speed":
            velocity = [self._core.column(axis) for axis in ("vx", "vy", "vz")]
            x, y, z = (axis if isinstance(axis, np.ndarray) else None for axis in velocity)
            if x is not None and y is not None and z is not None:
                return np.sqrt(x * x + y * y + z * z)
        if value is None:
            known = ", ".join(["x", "y", "z", "radius", *self.columns])
            raise KeyError(f"there is no attribute {found(name)}; there are {shortened(known)}")
        return np.array(value, dtype=object) if isinstance(value, list) else np.asarray(value)

    def __repr__(self) -> str:
        count = len(self)
        source = "" if self.format == "array" else f" from {self.name} ({self.format})"
        known = ", ".join(self.columns)
        return f"<bihive.Spheres: {count} sphere{'' if count == 1 else 's'}{source}{', ' + known if known else ''}>"

    def to_html(self, **arguments: Any) -> str:
        """The page with these spheres inside, one document of HTML of some 2 MB plus data: the text that save_page() writes, with
        the same arguments (camera, style, select, looks, and options of render()).

        Raises MissingError where the program ``bihive`` or its page (``make web``) is missing.
        """
        from ._view import page

        return page(self, **arguments).html

    def _repr_png_(self) -> Optional[bytes]:
        """A small picture in a notebook, of sets that are drawn in a moment."""
        from ._errors import Error
        from ._render import render

        if not 0 < len(self) <= _MOST_SHOWN:
            return None
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return render(self, size=(480, 270), progress=False)._repr_png_()
        except Error:
            return None

    def __getstate__(self) -> dict[str, Any]:
        core = self._core
        state: dict[str, Any] = {"format": core.format, "name": core.name, "xyz": self.xyz, "radius": self.radius}
        for name in ("element", "type", "colour", "opacity", "cell", "periodic", "columns", "bonds", "bonds_are_all", *_OF_FRAMES):
            state[name] = getattr(core, name)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        try:
            self._core = _core_of(state)
        except (AttributeError, LookupError, TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise bad_argument("state", f"is not that of spheres: {shortened(str(error))}") from None

    def __copy__(self) -> Spheres:
        return Spheres._of(self._core)

    def __deepcopy__(self, memo: Any) -> Spheres:
        return Spheres._of(self._core)  # nobody can change it

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Spheres):
            return NotImplemented
        return self._core is other._core or _same(self.__getstate__(), other.__getstate__())

    __hash__ = None  # type: ignore[assignment]


def _core_of(state: dict[str, Any]) -> _bihive.Spheres:
    """The spheres of a state as __getstate__() gives it."""
    places = numbers("xyz", state["xyz"])
    count = len(places)

    def floats(name: str, dtype: Any, columns: int = 0) -> Optional[Array]:
        if state[name] is None:
            return None
        array = numbers(name, state[name])
        return np.ascontiguousarray(array.reshape(-1, columns) if columns else array, dtype=dtype)

    def integers(name: str, dtype: Any, least: int, most: int) -> Optional[Array]:
        if state[name] is None:
            return None
        return np.ascontiguousarray(whole_numbers(name, state[name], count, least, most), dtype=dtype)

    texts_of: list[tuple[str, list[str]]] = []
    numbers_of: list[tuple[str, Array]] = []
    for column, values in mapping("columns", state["columns"]).items():
        text_of("columns", column)
        if isinstance(values, list) or as_array(column, values).dtype.kind in "USO":
            texts_of.append((column, texts(column, np.array(values, dtype=object), count)))
        else:
            numbers_of.append((column, np.ascontiguousarray(one_each(column, values, count), dtype=np.float64)))
    core = _bihive.spheres_from_arrays(
        places,
        numbers("radius", state["radius"]),
        integers("element", np.uint8, 0, 118),
        integers("type", np.int32, *_TYPES),
        floats("colour", np.float32, 3),
        floats("opacity", np.float32),
        numbers_of,
        texts_of,
        floats("cell", np.float64, 3),
        _periodic(state.get("periodic", True)),
        text_of("format", state["format"]),
        text_of("name", state["name"]),
        # States of earlier versions have none of these.
        _whole_or_none("frames", state.get("frames", 1)) or 1,
        None if state.get("time_ps") is None else float(one_each("time_ps", state["time_ps"], 1)[0]),
        _whole_or_none("step", state.get("step")),
        [text_of("rules", rule) for rule in several("rules", state.get("rules", []), "sentences")],
        text_of("title", state.get("title", "")),
        text_of("entry_id", state.get("entry_id", "")),
    )
    if state.get("bonds") is None:
        return core
    return core.with_bonds(_bonds(state["bonds"], count), boolean("bonds_are_all", state.get("bonds_are_all", False)))


def _whole_or_none(name: str, value: Any) -> Optional[int]:
    return None if value is None else int(whole_numbers(name, value, 1, -(2**63), 2**63 - 1)[0])


def _has_encoding(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return isinstance(b, dict) and a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.shape == b.shape and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    return bool(a == b)


def check_readable(path: Union[str, os.PathLike[str]], name: str = "path") -> str:
    """The path of an input as text. Raises FileError if the file cannot be opened."""
    text = path_of(name, path, "the path of a file or a built-in name")
    if text in _BUILT_IN:
        return text
    try:
        with open(text, "rb"):
            pass
    except OSError as error:
        # FILE:/NAME is a group in a file (HDF5).
        if not any(os.path.exists(text[: found_at.start()]) for found_at in re.finditer(":/", text)):
            raise FileError(error.errno or 0, error.strerror or str(error), text) from None
    return text


def read(path: Union[str, os.PathLike[str]], *, progress: Progress = None, **options: Unpack[ReadOptions]) -> Spheres:
    """The spheres of a file of any format that ``bihive render`` reads, or of a built-in name ("demo").

    options: frame (from 0; -1 is the last), radius, radius_scale, recenter, assembly, trajectory, wrap, unwrap, periodic,
    cell_vectors, cell_origin, replicate (copies along the cell's vectors as (2, 2, 1): spheres of their own, copy after copy, in a
    cell of them all), columns (a dict such as {"x": "px", "r": 5}: names or places of columns); of built-in scenarios count and seed.

    progress: as of render(); the share is an estimate. Other Python threads run meanwhile, and Ctrl-C ends it.

    Raises FileError (an OSError) if the file cannot be opened, InputError (a ValueError) with file and line if its content
    cannot be used. Warnings of the reader are given as InputWarning.

    >>> read("demo")
    <bihive.Spheres: 1631 spheres from demo (PDB), element, occupancy, b_factor, resid, serial, record, chain, resname, name>
    """
    text = check_readable(path)
    with Bar(progress, "reading") as bar:
        core = _bihive.read([*words_of(options, _READING), "--", os.fsencode(text)], bar)
    _warn_of(core)
    return Spheres._of(core)


def convert(
    source: Union[str, os.PathLike[str]],
    path: Union[str, os.PathLike[str]],
    *,
    format: Optional[str] = None,
    select: Union[str, npt.ArrayLike, None] = None,
    **options: Unpack[ReadOptions],
) -> list[str]:
    """Reads a file and writes it in another format: ``read(source, **options)``, then ``Spheres.save(path, format)``.

    select: only these spheres: an expression, a mask of shape (n,), or positions. Returns what the format cannot hold, a sentence each.
    """
    spheres = read(check_readable(source, "source"), **options)
    if select is not None:
        spheres = spheres[chosen("select", select, spheres._core)]
    return spheres.save(path, format)


def select(spheres: Spheres, expression: str, *, periodic: bool = True) -> Booleans:
    """bool (n,): which spheres a selection (docs/selections.md) takes. Raises UsageError that shows the faulty column.

    periodic: distances see the images along the spheres' cell, if they have one.

    >>> int(select(read("demo"), "name CA and chain A").sum())
    99
    """
    if not isinstance(spheres, Spheres):
        raise bad_argument("spheres", f"expected Spheres, found {found(spheres)}")
    text = text_of("expression", expression)
    found_spheres = spheres._core.select(text, "expression", boolean("periodic", periodic))
    if not found_spheres.any():
        reason = spheres._core.what_there_is(text)
        warnings.warn(f"the selection '{text}' takes no sphere{': ' if reason else ''}{reason}", InputWarning, stacklevel=2)
    return found_spheres


def stats(spheres: Spheres, *, max_prims: Union[int, str, None] = None, max_depth: Union[int, str, None] = None) -> dict[str, Any]:
    """Statistics of both trees, as ``bihive stats --json`` prints them: nodes, depths, overlap, memory in bytes.

    >>> stats(read("demo"))["spheres"]
    1631
    """
    import json

    if not isinstance(spheres, Spheres):
        raise bad_argument("spheres", f"expected Spheres, found {found(spheres)}")
    options = {"max_prims": max_prims, "max_depth": max_depth}
    made: dict[str, Any] = json.loads(spheres._core.statistics(words_of(options)))
    return made


def _map_text(map: Any) -> str:
    if isinstance(map, os.PathLike) or (isinstance(map, str) and map not in _MAPS and ("/" in map or "." in map)):
        return "-".join(_bihive.colour_map_of_file(os.fsencode(path_of("map", map))))
    if isinstance(map, str) and "-" in map and map not in _MAPS:
        map = map.split("-")
    if not isinstance(map, (list, tuple)):
        return one_of("map", map, _MAPS)
    if not 2 <= len(map) <= 1024:
        raise bad_argument("map", f"expected a name, a file or 2 to 1024 colours, found {len(map)}")
    for one in map:
        if "-" in text_of("map", one) or _bihive.linear_colour(one) is None:
            raise bad_argument("map", f"expected names of colours or '#rrggbb', found {found(one)}")
    return "-".join(map)


def colour_map(
    values: npt.ArrayLike,
    map: Union[str, os.PathLike[str], Sequence[str], None] = None,
    range: Optional[Sequence[float]] = None,
    log: bool = False,
    nan_colour: str = "grey",
) -> Floats:
    """float64 (n, 3): the colours that ``--colour-by`` gives these values, as a screen shows them.

    values: numbers or texts, shape (n,). map: "viridis", "RdBu_r" or another of ``bihive render --help-all``, a list of 2 to 1024
    colours ("#rrggbb" or names), or the path of a file with a colour on each line; left out: viridis for numbers, colours by
    category for texts. range: the two numbers at the ends of the map; left out: those of the values.
    log: the map runs along the logarithm. nan_colour: of NaN.

    >>> colour_map([0.0, 1.0, 2.0], "viridis", range=(0, 3)).shape
    (3, 3)
    """
    array = as_array("values", values)
    if array.ndim != 1:
        raise bad_argument("values", f"expected shape (n,), found shape {array.shape}")
    data: Any = texts("values", array, len(array)) if array.dtype.kind in "USO" else numbers("values", array)
    colours = "" if map is None else _map_text(map)
    log = boolean("log", log)
    if _bihive.linear_colour(text_of("nan_colour", nan_colour)) is None:
        raise bad_argument("nan_colour", f"expected a name or '#rrggbb', found {found(nan_colour)}")
    ends = ""
    if range is not None:
        pair = numbers("range", range)
        if pair.shape != (2,) or not bool(np.isfinite(pair).all()) or not pair[0] < pair[1]:
            raise bad_argument("range", f"expected two finite numbers, the first below the second, found {found(range)}")
        if log and pair[0] <= 0:
            raise bad_argument("range", f"of a logarithmic map begins above 0, found {found(range)}")
        ends = f"{float(pair[0])!r},{float(pair[1])!r}"
    how = [colours, ends, "log" if log else ""]
    while how and not how[-1]:
        how.pop()
    return _bihive.screen_of_light(_bihive.colours_of(data, "".join(":" + one for one in how), nan_colour))
