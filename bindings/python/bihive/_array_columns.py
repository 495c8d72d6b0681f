"""Arrays among the options of pictures that become attributes of the spheres: colours by values, arrows and tubes."""

from __future__ import annotations

import copy
from typing import Any, Sequence

import numpy as np

from ._arrays import as_array, numbers, texts
from ._camera import Look
from ._colours import are_texts
from ._errors import bad_argument
from ._links import is_table
from ._per_sphere import ColourBy, colour_by_of
from ._spheres import Spheres

__all__ = ["arrays_as_columns", "refuse_arrays"]

# Option: the shape of a sphere's row, and the attributes of its numbers.
_OPTIONS = {"arrows": ((3,), ("arrow_x", "arrow_y", "arrow_z")), "trace_radius": ((), ("tube_radius",))}
_OF_COLOURS = "values"


def _is_one_value(option: str, value: Any) -> bool:
    if value is None or isinstance(value, (str, bool, int, float)):
        return True
    array = as_array(option, value)
    return array.ndim == 0 or are_texts(array)


def refuse_arrays(options: dict[str, Any], looks: Sequence[Look]) -> None:
    """Raises an error if there is such an array."""
    for option in _OPTIONS:
        if not _is_one_value(option, options.get(option)):
            raise _needs_memory(option)
    if is_table(options.get("links")):
        raise _needs_memory("links")
    if any(isinstance(look.colour_by, ColourBy) for look in looks) or colour_by_of(options.get("colour_by")) is not None:
        raise _needs_memory("colour_by")


def _needs_memory(option: str) -> Exception:
    return bad_argument(option, "an array needs spheres in memory, in render() or a film", "read the file first: bihive.read(path)")


def arrays_as_columns(spheres: Spheres, options: dict[str, Any], looks: Sequence[Look]) -> tuple[Spheres, list[Look]]:
    """The spheres with attributes for these arrays, which the options and the returned looks name then."""
    for option, (row, names) in _OPTIONS.items():
        value = options.get(option)
        if _is_one_value(option, value):
            continue
        array, shape = numbers(option, value), (len(spheres), *row)
        if array.shape != shape:
            raise bad_argument(option, f"expected shape {shape}, a row for each sphere, found {array.shape}")
        free = [_free_name(name, spheres) for name in names]
        rows = np.asarray(array, dtype=np.float64).reshape(len(spheres), -1)
        spheres = spheres.with_columns(dict(zip(free, rows.T)))
        options[option] = ",".join(free)
    of_all = colour_by_of(options.get("colour_by"))
    if of_all is not None:
        spheres, options["colour_by"] = _coloured(spheres, of_all)
    named = []
    for look in looks:
        by = look.colour_by
        if isinstance(by, ColourBy):
            look = copy.copy(look)
            spheres, text = _coloured(spheres, by)
            object.__setattr__(look, "colour_by", text)
        named.append(look)
    return spheres, named


def _coloured(spheres: Spheres, by: ColourBy) -> tuple[Spheres, str]:
    """The spheres with an attribute of these values, and the option."""
    array = by.array
    if array.shape != (len(spheres),):
        raise bad_argument("colour_by", f"expected shape ({len(spheres)},), a value for each sphere, found {array.shape}")
    name = _free_name(_OF_COLOURS, spheres)
    values: Any = texts("colour_by", array, len(spheres)) if are_texts(array) else np.asarray(array, dtype=np.float64)
    return spheres.with_columns({name: values}), name + (f":{by.colours}" if by.colours else "")


def _free_name(name: str, spheres: Spheres) -> str:
    while name in spheres.columns:
        name += "_"
    return name
