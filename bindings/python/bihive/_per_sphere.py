"""Arrays with a value for each sphere, as looks take them."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import as_array, numbers
from ._colours import Linear, are_texts, light_of, numbers_of_screen
from ._errors import bad_argument

__all__ = ["ColourBy", "PerSphere", "colour_by_of", "per_sphere"]

Array = np.ndarray[Any, Any]


class PerSphere:
    """Values of all spheres: float64 of shape (n,), or of colours (n, 3). Looks with them can be compared and pickled."""

    def __init__(self, values: Array, are_light: bool = False) -> None:
        self.values = np.array(values, dtype=np.float64, order="C")
        self.values.setflags(write=False)
        self.are_light = are_light

    def check(self, name: str, count: Optional[int]) -> None:
        """`count`: the number of spheres; None if their file has not been read."""
        if count is None:
            raise bad_argument(name, "an array needs spheres in memory", "read the file first: bihive.read(path)")
        if len(self.values) != count:
            shape = (count, *self.values.shape[1:])
            raise bad_argument(name, f"expected shape {shape}, a row for each sphere, found {self.values.shape}")

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> Array:
        return np.array(self.values, dtype=dtype)

    def __len__(self) -> int:
        return len(self.values)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, PerSphere)
            and self.are_light == other.are_light
            and np.array_equal(self.values, other.values, equal_nan=True)
        )

    def __hash__(self) -> int:
        return hash((self.values.shape, self.values.tobytes(), self.are_light))

    def __repr__(self) -> str:
        return np.array2string(self.values, separator=", ", threshold=9)


def _colours(value: Any) -> Optional[PerSphere]:
    if isinstance(value, Linear):
        return PerSphere(value.light, True) if value.light.ndim == 2 else None
    array = as_array("colour", value)
    if array.ndim == 1 and are_texts(array):
        return PerSphere(light_of("colour", array, len(array)), True)
    if array.ndim != 2:
        return None
    if array.shape[1] != 3:
        raise bad_argument("colour", f"expected a colour, or shape (n, 3), found shape {array.shape}")
    return PerSphere(numbers_of_screen("colour", array))


def per_sphere(name: str, value: Any) -> Optional[PerSphere]:
    """Colours, opacities or radii of all spheres; None: it is no such array, but one value."""
    if value is None or isinstance(value, (str, PerSphere)):
        return value if isinstance(value, PerSphere) else None
    if name == "colour":
        return _colours(value)
    if isinstance(value, (bool, int, float)) or as_array(name, value).ndim == 0:
        return None
    array = numbers(name, value)
    if array.ndim != 1:
        raise bad_argument(name, f"expected a number, or shape (n,), found shape {array.shape}")
    most = 1.0 if name == "opacity" else float(np.finfo(np.float32).max)
    if not bool(((array >= 0) & (array <= most)).all()):
        raise bad_argument(name, "expected numbers from 0 to 1" if name == "opacity" else "expected numbers from 0 to 3.4e38")
    return PerSphere(array)


class ColourBy:
    """Values of all spheres that a map turns into colours: shape (n,), numbers or texts; and the map, "" or "MAP[:MIN,MAX[:log]]"."""

    def __init__(self, array: Array, colours: str = "") -> None:
        self.array = np.array(array)
        self.array.setflags(write=False)
        self.colours = colours

    def _key(self) -> tuple[Any, ...]:
        return self.colours, self.array.dtype.kind, tuple(repr(one) for one in self.array.tolist())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ColourBy) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        array = np.array2string(self.array, separator=", ", threshold=9)
        return f"({array}, {self.colours!r})" if self.colours else array


def colour_by_of(value: Any) -> Optional[ColourBy]:
    """Values of all spheres, or a pair of them and a map; None: the name of an attribute, or nothing."""
    if value is None or isinstance(value, (str, ColourBy)):
        return value if isinstance(value, ColourBy) else None
    colours = ""
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str) and not isinstance(value[0], str):
        value, colours = value
        if not colours:
            raise bad_argument("colour_by", "expected a map beside the values, as (values, \"magma:0,1\")")
    array = as_array("colour_by", value)
    if array.ndim != 1:
        raise bad_argument("colour_by", f"expected an attribute, or shape (n,), found shape {array.shape}")
    return ColourBy(array if are_texts(array) else numbers("colour_by", array), colours)
