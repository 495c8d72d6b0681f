"""Checks of arguments that are not arrays: texts, paths, switches and one of several names."""

from __future__ import annotations

import itertools
import os
from typing import Any, Iterable, Mapping

from ._errors import bad_argument, found

_LONGEST_PATH = 4096
_MOST = 1000000  # items in a list that is not an array


def whole_text(name: str, text: str) -> str:
    """A text that the compiled part can take: it must have an encoding, and no NUL."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise bad_argument(name, f"expected a text without lone surrogates, found {found(text)}") from None
    if "\0" in text:
        raise bad_argument(name, "a text must not hold a NUL character")
    return text


def text_of(name: str, value: Any, what: str = "a text") -> str:
    if not isinstance(value, str):
        raise bad_argument(name, f"expected {what}, found {found(value)}")
    return whole_text(name, value)


def path_of(name: str, value: Any, what: str = "a path") -> str:
    """A path as text; os.fsencode() makes it what the system takes, which need not be UTF-8."""
    text = value if isinstance(value, str) else None
    if isinstance(value, os.PathLike):
        text = os.fspath(value)
    if not isinstance(text, str) or not text or "\0" in text:
        raise bad_argument(name, f"expected {what}, found {found(value)}")
    try:
        length = len(os.fsencode(text))
    except UnicodeEncodeError:
        raise bad_argument(name, f"expected {what}, found {found(value)}") from None
    if length >= _LONGEST_PATH:
        raise bad_argument(name, f"expected {what} of less than {_LONGEST_PATH} bytes, found {found(value)}")
    return text


def one_of(name: str, value: Any, names: Iterable[str], hint: str = "") -> str:
    known = list(names)
    if not isinstance(value, str) or value not in known:
        raise bad_argument(name, f"expected one of {', '.join(known)}, found {found(value)}", hint)
    return value


def boolean(name: str, value: Any) -> bool:
    if value is True or value is False or type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    raise bad_argument(name, f"expected True or False, found {found(value)}")


def mapping(name: str, value: Any) -> Mapping[Any, Any]:
    if not isinstance(value, Mapping):
        raise bad_argument(name, f"expected a dictionary, found {found(value)}")
    return value


def several(name: str, value: Any, what: str) -> list[Any]:
    """The items of a list, a tuple or another iterable that is not a text."""
    if isinstance(value, (str, bytes, Mapping)):
        raise bad_argument(name, f"expected {what}, found {found(value)}")
    try:
        things = list(itertools.islice(value, _MOST + 1))
    except TypeError:
        raise bad_argument(name, f"expected {what}, found {found(value)}") from None
    if len(things) > _MOST:
        raise bad_argument(name, f"expected {what}, at most {_MOST}, found {found(value)}")
    return things
