"""Selections by masks and by positions, as the text that every option takes."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np

from . import _bihive
from ._arrays import as_array
from ._checks import text_of
from ._errors import bad_argument, found

__all__ = ["NOBODY", "Selected", "selected"]

NOBODY = "not all"


class Selected(NamedTuple):
    """An expression; and of a mask or positions, how many spheres it needs: exactly, or at least."""

    text: str
    exactly: Optional[int] = None
    at_least: int = 0

    def of(self, name: str, count: Optional[int]) -> str:
        """The expression for a set of `count` spheres; None: of a file that is not read yet."""
        if self.exactly is None and self.at_least == 0:
            return self.text
        if count is None:
            raise bad_argument(name, "a mask and positions need spheres in memory", "read the file first: bihive.read(path)")
        if self.exactly is not None and self.exactly != count:
            raise bad_argument(name, f"expected a mask of shape ({count},), found shape ({self.exactly},)")
        if self.at_least > count:
            raise bad_argument(name, f"expected positions below {count}, found {self.at_least - 1}")
        return self.text


def selected(name: str, which: Any) -> Selected:
    """Of an expression, a mask of shape (n,), or positions."""
    if isinstance(which, str):
        text = text_of(name, which)
        _bihive.check_selection(text)
        return Selected(text)
    array = as_array(name, which)
    if array.ndim != 1 or (array.dtype.kind not in "bui" and array.size > 0):
        raise bad_argument(name, f"expected a selection as text, a mask or positions, found {found(which)}")
    is_mask = array.dtype.kind == "b"
    positions = np.flatnonzero(array) if is_mask else np.unique(array.astype(np.int64))
    if positions.size > 0 and positions[0] < 0:
        raise bad_argument(name, f"expected positions of at least 0, found {positions[0]}")
    # Neighbours are a range.
    ends = np.flatnonzero(np.diff(positions) != 1)
    first = positions[np.concatenate([[0], ends + 1])] if positions.size > 0 else positions
    last = positions[np.concatenate([ends, [positions.size - 1]])] if positions.size > 0 else positions
    parts = [str(a) if a == b else f"{a}..{b}" for a, b in zip(first.tolist(), last.tolist())]
    text = "index " + " ".join(parts) if parts else NOBODY
    return Selected(text, len(array) if is_mask else None, 0 if is_mask or positions.size == 0 else int(positions[-1]) + 1)
