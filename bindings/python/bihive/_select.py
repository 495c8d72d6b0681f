"""Selections: an expression, a mask or positions."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np

from . import _bihive
from ._arrays import as_array
from ._checks import text_of
from ._errors import bad_argument, found

__all__ = ["NOBODY", "Selected", "chosen", "selected"]

Array = np.ndarray[Any, Any]
NOBODY = "not all"


class _Positions(NamedTuple):
    """Ascending positions; and how many spheres there must be: exactly (of a mask), or at least."""

    at: Array
    exactly: Optional[int]
    at_least: int

    def check(self, name: str, count: int) -> None:
        if self.exactly is not None and self.exactly != count:
            raise bad_argument(name, f"expected a mask of shape ({count},), found shape ({self.exactly},)")
        if self.at_least > count:
            raise bad_argument(name, f"expected positions below {count}, found {self.at_least - 1}")


def _positions(name: str, which: Any) -> _Positions:
    """Of a mask or of positions. Negative positions are refused: -1 is the answer of a ray that hits nothing."""
    array = as_array(name, which)
    if array.ndim != 1 or (array.dtype.kind not in "bui" and array.size > 0):
        raise bad_argument(name, f"expected a selection as text, a mask or positions, found {found(which)}")
    if array.dtype.kind == "b":
        return _Positions(np.flatnonzero(array), len(array), 0)
    at = np.unique(array.astype(np.int64))
    if at.size > 0 and at[0] < 0:
        raise bad_argument(name, f"expected positions of at least 0, found {at[0]}")
    return _Positions(at, None, int(at[-1]) + 1 if at.size > 0 else 0)


def chosen(name: str, which: Any, spheres: _bihive.Spheres, periodic: bool = True) -> Array:
    """bool (n,): which spheres a selection takes."""
    if isinstance(which, str):
        return spheres.select(text_of(name, which), name, periodic)
    positions = _positions(name, which)
    positions.check(name, len(spheres))
    made: Array = np.zeros(len(spheres), dtype=bool)
    made[positions.at] = True
    return made


class Selected(NamedTuple):
    """A selection as the text that every option takes. `needs`: what a mask or positions need; None: an expression."""

    text: str
    needs: Optional[tuple[Optional[int], int]] = None

    def of(self, name: str, count: Optional[int]) -> str:
        """The expression for a set of `count` spheres; None: of a file that is not read yet."""
        if self.needs is None:
            return self.text
        if count is None:
            raise bad_argument(name, "a mask and positions need spheres in memory", "read the file first: bihive.read(path)")
        _Positions(np.zeros(0), *self.needs).check(name, count)
        return self.text


def selected(name: str, which: Any) -> Selected:
    if isinstance(which, str):
        text = text_of(name, which)
        _bihive.check_selection(text)
        return Selected(text)
    positions = _positions(name, which)
    at = positions.at
    # Neighbours are a range.
    ends = np.flatnonzero(np.diff(at) != 1)
    first, last = (at[np.concatenate([[0], ends + 1])], at[np.concatenate([ends, [at.size - 1]])]) if at.size > 0 else (at, at)
    parts = [str(a) if a == b else f"{a}..{b}" for a, b in zip(first.tolist(), last.tolist())]
    return Selected("index " + " ".join(parts) if parts else NOBODY, positions[1:])
