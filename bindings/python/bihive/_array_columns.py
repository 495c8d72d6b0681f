"""Arrays among the options of pictures that become attributes of the spheres: those of arrows and tubes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import as_array, numbers
from ._errors import bad_argument
from ._spheres import Spheres

__all__ = ["arrays_as_columns", "refuse_arrays"]

# Option: the shape of a sphere's row, and the attributes of its numbers.
_OPTIONS = {"arrows": ((3,), ("arrow_x", "arrow_y", "arrow_z")), "trace_radius": ((), ("tube_radius",))}


def _is_one_value(option: str, value: Any) -> bool:
    if value is None or isinstance(value, (str, bool, int, float)):
        return True
    array = as_array(option, value)
    return array.ndim == 0 or array.dtype.kind in "USO"


def refuse_arrays(options: dict[str, Any]) -> None:
    """Raises an error if there is such an array."""
    for option in _OPTIONS:
        if not _is_one_value(option, options.get(option)):
            raise bad_argument(option, "an array needs spheres in memory, in render() or a film", "read the file first: bihive.read(path)")


def arrays_as_columns(spheres: Spheres, options: dict[str, Any]) -> Spheres:
    """The spheres with attributes for these arrays, which the options name then."""
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
    return spheres


def _free_name(name: str, spheres: Spheres) -> str:
    while name in spheres.columns:
        name += "_"
    return name
