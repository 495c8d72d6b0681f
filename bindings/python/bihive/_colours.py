"""Colours: numbers as a screen shows them, as matplotlib has them, or linear light."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _bihive
from ._arrays import as_array, numbers, texts
from ._checks import whole_text
from ._errors import bad_argument, found

__all__ = ["linear"]

Array = np.ndarray[Any, Any]


class Linear:
    """Numbers that linear() marked."""

    def __init__(self, light: Array) -> None:
        self.light = light

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Linear) and np.array_equal(self.light, other.light)

    def __hash__(self) -> int:
        return hash((self.light.shape, self.light.tobytes()))

    def __repr__(self) -> str:
        return f"bihive.linear({np.array2string(self.light, separator=', ', threshold=9)})"


def linear(light: Any) -> Linear:
    """Marks colours as linear light, wherever colours are taken. Without it numbers are what a screen shows.

    light: floats from 0 to 1, shape (3,) or (n, 3), as in scene files and in layers of OpenEXR.

    >>> import numpy as np
    >>> from bihive import Spheres
    >>> half = Spheres(np.zeros((1, 3)), radius=1, colour=linear((0.5, 0.5, 0.5)))
    >>> half["colour"].round(3).tolist()
    [[0.735, 0.735, 0.735]]
    """
    return Linear(_in_range("light", numbers("light", light)))


def light_of_text(text: str, name: str = "colour") -> Array:
    light = _bihive.linear_colour(whole_text(name, text))
    if light is None:
        raise bad_argument(name, f"expected a name, '#rrggbb', or numbers, found {found(text)}")
    return np.array(light, dtype=np.float64)


def light_of_numbers(name: str, value: Any) -> Array:
    """float64 of linear light: of floats from 0 to 1 and of bytes (uint8), as a screen shows them, or of Linear."""
    if isinstance(value, Linear):
        return value.light
    array = as_array(name, value)
    if array.dtype == np.uint8:
        light: Array = _bihive.light_of_screen(np.arange(256) / 255)[array]
        return light
    return _bihive.light_of_screen(_in_range(name, numbers(name, array)))


def are_texts(array: Array) -> bool:
    """Whether these are names of colours rather than numbers."""
    return array.dtype.kind in "US" or (array.dtype.kind == "O" and array.ndim == 1 and array.size > 0)


def numbers_of_screen(name: str, array: Array) -> Array:
    """float64 from 0 to 1 as a screen shows them: of such floats, or of bytes (uint8)."""
    return array / 255 if array.dtype == np.uint8 else _in_range(name, numbers(name, array))


def colour_word(name: str, value: Any) -> str:
    """The numbers of one colour as the command line takes them: of what a screen shows under the picture's transfer
    curve, or of linear light."""
    if isinstance(value, Linear):
        colour = value.light
    else:
        colour = numbers_of_screen(name, as_array(name, value))
    if colour.shape != (3,):
        raise bad_argument(name, f"expected a name, '#rrggbb', or three numbers, found shape {colour.shape}")
    words = ",".join(repr(float(one)) for one in colour)
    return words if isinstance(value, Linear) else f"srgb({words})"


def light_of(name: str, value: Any, count: int) -> Array:
    """(n, 3) of linear light: of one colour for all, n texts, or numbers. `name`: the argument's."""
    if isinstance(value, str):
        return np.broadcast_to(light_of_text(value, name), (count, 3))
    if not isinstance(value, Linear):
        array = as_array(name, value)
        if are_texts(array):
            values = texts(name, array, count)
            known = {one: light_of_text(one, name) for one in set(values)}
            return np.array([known[one] for one in values], dtype=np.float64).reshape(count, 3)
        value = array
    light = light_of_numbers(name, value)
    if light.shape == (3,):
        light = np.broadcast_to(light, (count, 3))
    if light.shape != (count, 3):
        raise bad_argument(name, f"expected a colour, or shape ({count}, 3), found shape {light.shape}")
    return light


def _in_range(name: str, array: Array) -> Array:
    light = np.asarray(array, dtype=np.float64)
    if not bool(((light >= 0) & (light <= 1)).all()):
        raise bad_argument(name, "expected colours from 0 to 1", "colours of bytes must have dtype uint8")
    return light
