"""Links of arrays: the table that the option `links` takes, without a file in any folder."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional

import numpy as np

from ._arrays import as_array, one_each, whole_numbers
from ._errors import bad_argument

__all__ = ["LinkTable", "is_table"]

Array = np.ndarray[Any, Any]
_MOST_ID = 2**31 - 1
_OF_PAIRS = ("first", "second", "image_a", "image_b", "image_c")


def is_table(value: Any) -> bool:
    """Whether the option is a table in memory: neither a path nor left out."""
    return value is not None and not isinstance(value, (str, os.PathLike))


def _columns_of(value: Any) -> dict[str, Array]:
    """The columns of pairs: whole numbers, and others float64."""
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if not isinstance(value, Mapping):
        pairs = as_array("links", value)
        if pairs.ndim != 2 or pairs.shape[1] != 2:
            raise bad_argument("links", f"expected shape (n, 2), found {pairs.shape}", "or columns: {'first': ..., 'second': ..., 'force': ...}")
        value = {"first": pairs[:, 0], "second": pairs[:, 1]}
    if "image" in value:
        image = as_array("links", value["image"])
        if image.ndim != 2 or image.shape[1] != 3:
            raise bad_argument("links", f"image: expected shape (n, 3), found {image.shape}")
        value = {**{name: column for name, column in value.items() if name != "image"}, **dict(zip(_OF_PAIRS[2:], image.T))}
    for name in _OF_PAIRS[:2]:
        if name not in value:
            raise bad_argument("links", f"there is no column {name}", "first and second are the positions of two spheres")
    count = as_array("links", value["first"]).size
    columns: dict[str, Array] = {}
    for name, column in value.items():
        if not isinstance(name, str) or not name or any(mark in name for mark in ',"\n\r#'):
            raise bad_argument("links", f"a column cannot have the name {name!r}")
        least = 0 if name in _OF_PAIRS[:2] else -_MOST_ID
        columns[name] = whole_numbers("links", column, count, least, _MOST_ID) if name in _OF_PAIRS else one_each("links", column, count)
    return columns


class LinkTable:
    """While it is entered, the options name a file in memory in place of the table of `links`, if there is one."""

    def __init__(self, options: dict[str, Any]) -> None:
        self._options, self._descriptor = options, -1
        self._text: Optional[str] = None
        if not is_table(options.get("links")):
            return
        columns = _columns_of(options["links"])
        fields = [["" if number != number else repr(number) for number in column.tolist()] for column in columns.values()]
        self._text = "\n".join([",".join(columns), *(",".join(row) for row in zip(*fields))]) + "\n"

    def __enter__(self) -> None:
        if self._text is None:
            return
        self._descriptor = os.memfd_create("links")
        with open(os.dup(self._descriptor), "w", encoding="utf-8") as file:
            file.write(self._text)
        self._options["links"] = f"/proc/self/fd/{self._descriptor}"

    def __exit__(self, *_: Any) -> None:
        if self._descriptor >= 0:
            os.close(self._descriptor)
