"""Renders spheres or a file."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

from . import _bihive
from ._adapt import spheres_of
from ._array_columns import arrays_as_columns, refuse_arrays
from ._camera import Look, Orthographic, Perspective, Style
from ._checks import several
from ._errors import InputWarning, bad_argument, found
from ._links import LinkTable
from ._options import ACTIONS, option, words_of
from ._per_sphere import per_sphere
from ._picture import Picture
from ._progress import Bar, Progress
from ._select import NOBODY, selected
from ._spheres import Spheres, check_readable

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    from ._option_types import RenderOptions

__all__ = ["render"]

Camera = Union[Orthographic, Perspective, Picture, str, None]


def looks_of(looks: Any, options: dict[str, Any]) -> list[Look]:
    """The looks as a list, after one for the arrays among the options, which are taken out."""
    colour, opacity = (per_sphere(name, options.get(name)) for name in ("colour", "opacity"))
    for name, values in (("colour", colour), ("opacity", opacity)):
        if values is not None:
            del options[name]
    given = [] if looks is None else [looks] if isinstance(looks, Look) else several("looks", looks, "a Look or several")
    for look in given:
        if not isinstance(look, Look):
            raise bad_argument("looks", f"expected Look(...), found {found(look)}")
    return given if colour is None and opacity is None else [Look(colour=colour, opacity=opacity), *given]


Arrays = list[tuple[int, str, Any, bool]]


def arrays_of(looks: Sequence[Look]) -> Arrays:
    """Number of the look, action, values, and whether colours are light."""
    return [(i, name, array.values, array.are_light) for i, look in enumerate(looks) for name, array in look.arrays()]


def picture_words(
    select: Any, camera: Camera, style: Any, looks: Sequence[Look], options: dict[str, Any], count: Optional[int] = None
) -> list[str]:
    """The arguments of `bihive render` for these keywords, without the input. `count`: of spheres in memory."""
    refuse_arrays(options, looks)
    if isinstance(camera, str):
        options = {"view_from": camera, **options}
    elif camera is not None and not isinstance(camera, (Orthographic, Perspective, Picture)):
        raise bad_argument("camera", f"expected Orthographic, Perspective, a picture or a side, found {found(camera)}")
    before = {name: value for name, value in options.items() if name in ACTIONS}
    words = words_of({name: value for name, value in options.items() if name not in before})
    words += words_of(before)
    if isinstance(camera, (Orthographic, Perspective)):
        words += camera.words()
    if isinstance(style, (str, os.PathLike)):
        words.append(option("style", style))
    elif style is not None and not isinstance(style, (Style, dict)):
        raise bad_argument("style", f"expected a name, a path, a Style or a dictionary, found {found(style)}")
    for look in looks:
        words += look.words(count)
    if select is not None:
        if not isinstance(select, str) and selected("select", select).text == NOBODY:
            raise bad_argument("select", "takes no sphere", "every sphere would be hidden")
        words += [option("select", f"not ({selected('select', select).of('select', count)})"), "--hide"]
    return words


def style_text(style: Any) -> str:
    """A style that is neither a name nor a file, as text."""
    if isinstance(style, dict):
        style = Style(style)
    return style.text() if isinstance(style, Style) else ""


def picture_of(core: _bihive.Picture, level: int = 3) -> Picture:
    """The picture; tells its warnings."""
    for warning in core.warnings:
        warnings.warn(warning, InputWarning, stacklevel=level)
    return Picture(core)


def draw(
    spheres: Optional[Spheres],
    words: Sequence[Union[str, bytes]],
    looks: Sequence[Look],
    text: str,
    like: Optional[Picture],
    progress: Progress,
) -> Picture:
    """The picture, and its warnings."""
    with Bar(progress, "rendering") as bar:
        core = _bihive.render(
            None if spheres is None else spheres._core, words, arrays_of(looks), text, None if like is None else like._core, bar
        )
    return picture_of(core, 4)


def render(
    spheres: Any,
    *,
    camera: Camera = None,
    style: Union[str, os.PathLike[str], Style, dict[str, Any], None] = None,
    size: Optional[tuple[int, int]] = None,
    select: Union[str, npt.ArrayLike, None] = None,
    looks: Union[Look, Sequence[Look], None] = None,
    progress: Progress = None,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draws spheres.

    spheres: Spheres, atoms of ASE, an AtomGroup or Universe of MDAnalysis, or the path of a file (a scene file too) or a
        built-in name: "demo", "scenario1", "scenario2", "scenario3", "four-spheres".
    camera: Orthographic(...), Perspective(...), a side such as "left", or a Picture: seen as in that one, with its ranges of
        colours.
    style: a name ("illustrative"; `bihive styles` lists them), the path of a style file, or a Style or dictionary.
    size: width and height in pixels (1280, 720).
    select: an expression, or for spheres in memory a mask of shape (n,) or positions; all other spheres are hidden.
    looks: a Look, or several, done one after the other.
    progress: None: a bar if it takes over a second on a terminal or in a notebook, by tqdm if that is there; False: none;
        or a function, which is called with the finished share, 0 to 1, and in the end with 1.
    options: every other option of `bihive render` under its name with underscores: samples=16, shadows=False,
        background="black", ao=True, outline=2, fog=0.3, light="studio", legend=True, view="normal", crop=(0, 0, 64, 64),
        transfer="none", bits=16, threads=2, engine="reference", replicate=(2, 2, 2)... For spheres in memory colour,
        opacity and colour_by may be arrays, as those of a Look, arrows an array of vectors, shape (n, 3), and trace_radius one
        of radii, shape (n,). links may be pairs of positions, shape (m, 2), or columns of them and of numbers: a dictionary,
        or what contacts() and Tree.pairs() return. Else a tuple stands for numbers between commas.

    Returns a Picture: the same bits as ``bihive render``, on any number of threads. Other Python threads run meanwhile, and
    Ctrl-C ends it, the reading of a file and the building of a tree included.

    Raises UsageError and InputError (both ValueErrors), which name the argument; FileError (an OSError); MissingError, a
    RuntimeError, if the machine lacks something.

    >>> render("demo", size=(64, 48), samples=1, select="chain A")
    <bihive.Picture: 64 x 48, 758 spheres of demo>
    """
    _bihive.check_environment()
    path: Optional[str] = None
    made: Optional[Spheres] = None
    if isinstance(spheres, (str, os.PathLike)):
        path = check_readable(spheres, "spheres")
    else:
        made = spheres_of(spheres)
    of_picture: dict[str, Any] = {"size": size, **options}
    given = looks_of(looks, of_picture)
    if made is not None:
        made, given = arrays_as_columns(made, of_picture, given)
    with LinkTable(of_picture):
        words = picture_words(select, camera, style, given, of_picture, None if made is None else len(made))
        all_words: list[Union[str, bytes]] = [*words, "--", os.fsencode(path) if path is not None else "spheres"]
        picture = draw(made, all_words, given, style_text(style), camera if isinstance(camera, Picture) else None, progress)
    # A picture would keep the one before it, and that the one before.
    if not isinstance(camera, Picture):
        picture._asked = (path if made is None else made, camera, style, select, looks, dict(options))
    return picture
