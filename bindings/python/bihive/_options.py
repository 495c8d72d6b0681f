"""Converts keyword arguments to command line arguments, which have one description and one check per option.

``view_from="left"`` becomes ``--view-from=left``. So every option of ``bihive render`` is here, under its own name.
"""

from __future__ import annotations

import difflib
import os
from typing import Any, Iterable, Mapping

from . import _bihive
from ._checks import boolean, path_of, several, whole_text
from ._colours import colour_word
from ._errors import bad_argument, found

# Options whose form differs from that of the command line.
_ELSEWHERE = {"select", "hide", "show", "light"}
# The options of a picture: their names, and the names of their values.
_OPTIONS = {name: value for name, value in _bihive.options() if name not in _ELSEWHERE}


# Actions on spheres: of a Look, and of all spheres.
ACTIONS = [name for name in (action.replace("-", "_") for action in _bihive.actions()) if name not in _ELSEWHERE]
# True and False are --name and --no-name.
SWITCHES = [name for name in _OPTIONS if "no_" + name in _OPTIONS]
# Given as True; False is the same as leaving it out.
FLAGS = [
    name
    for name, value in _OPTIONS.items()
    if not value and name not in SWITCHES and name.removeprefix("no_") not in SWITCHES
]
# Two or three numbers with an x between them.
SIZES = [name for name, value in _OPTIONS.items() if value in ("WxH", "AxBxC")]
# One value each. A tuple means numbers separated by commas.
ONE_VALUE = [name for name, value in _OPTIONS.items() if value and name not in SIZES + ACTIONS]
_DEEPEST = 8  # of lists in lists


def number_word(name: str, value: Any) -> str:
    """A number as the command line reads it: the shortest text with the same bits."""
    if isinstance(value, bool):
        raise bad_argument(name, f"expected a number, found {value}")
    try:
        return str(value.__index__())
    except (AttributeError, TypeError, ValueError):
        pass
    try:
        return repr(float(value))
    except (TypeError, ValueError, OverflowError):
        raise bad_argument(name, f"expected a number, found {found(value)}") from None


def flat(name: str, value: Any, depth: int = 1) -> Iterable[Any]:
    if depth > _DEEPEST:
        raise bad_argument(name, "expected numbers, found lists in lists")
    for one in several(name, value, "numbers"):
        if isinstance(one, str) or not hasattr(one, "__iter__") or getattr(one, "ndim", 1) == 0:
            yield one
        else:
            yield from flat(name, one, depth + 1)


def value_word(name: str, value: Any, between: str = ",") -> str:
    """One value as text: texts and paths as they are, numbers, several numbers, or parts and their values."""
    if isinstance(value, str):
        return value
    if isinstance(value, Mapping):
        return between.join(f"{part}={value_word(name, one)}" for part, one in value.items())
    if isinstance(value, os.PathLike):
        return path_of(name, value)
    if hasattr(value, "__iter__") and getattr(value, "ndim", 1) > 0:
        return between.join(one if isinstance(one, str) else number_word(name, one) for one in flat(name, value))
    return number_word(name, value)


def option(name: str, value: Any, between: str = ",") -> str:
    if not isinstance(value, str) and _OPTIONS.get(name, "").startswith("COLOUR"):
        value = colour_word(name, value)
    text = value_word(name, value, between)
    if not text:
        raise bad_argument(name, "must not be empty", "leave it out")
    return f"--{name.replace('_', '-')}={whole_text(name, text)}"


def light_words(value: Any) -> list[str]:
    lights = [value] if isinstance(value, str) else several("light", value, "a light or several")
    return [option("light", light) for light in lights]


def action_words(name: str, value: Any) -> list[str]:
    """An action; several clips may come as a list."""
    if name == "clip" and not isinstance(value, str):
        clips = [option(name, clip) for clip in several(name, value, "a clip or several")]
        if not clips:
            raise bad_argument(name, "must not be empty", "leave it out")
        return clips
    return [option(name, value)]


def words_of(options: Mapping[str, Any], allowed: Iterable[str] | None = None) -> list[str]:
    """The arguments for these options. ``None`` leaves an option out.

    Raises UsageError for a name that is not ``allowed`` (None: any option of a picture).
    """
    known = set(ONE_VALUE + FLAGS + SWITCHES + SIZES + ACTIONS + ["light"] if allowed is None else allowed)
    words: list[str] = []
    for name, value in options.items():
        if name == "wrap" and isinstance(value, str) and value == "molecules":
            name, value = "wrap_molecules", True
        if name not in known:
            near = difflib.get_close_matches(name, sorted(known), 5) or sorted(known)[:5]
            raise bad_argument(name, "there is no such option", f"there are {', '.join(near)} and others")
        if value is None or (name == "title" and isinstance(value, str) and not value):
            continue
        if name in FLAGS:
            words += ["--" + name.replace("_", "-")] if boolean(name, value) else []
        elif name in SWITCHES:
            words.append(("--" if boolean(name, value) else "--no-") + name.replace("_", "-"))
        elif name in SIZES:
            words.append(option(name, value, "x"))
        elif name == "light":
            words += light_words(value)
        elif name in ACTIONS:
            words += action_words(name, value)
        else:
            words.append(option(name, value))
    return words
