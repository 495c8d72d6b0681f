"""Figures: PNG, TIFF and OpenEXR files that say how they were drawn, drawn again and compared."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

from . import _bihive
from ._camera import Look, Style
from ._checks import path_of
from ._errors import bad_argument, found
from ._picture import Picture
from ._progress import Bar, Progress
from ._render import Camera, looks_of, picture_of, picture_words
from ._spheres import check_readable

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    from ._option_types import RenderOptions

__all__ = ["Verdict", "again", "verify"]

Path = Union[str, os.PathLike[str]]


@dataclass(frozen=True)
class Verdict:
    """The answer of verify(): how a figure compares with the same picture, drawn now. True where the bits are the same."""

    figure: str
    verified: bool
    #: The same in a sentence, or the reasons.
    sentence: str = field(repr=False)
    #: Why it could not be drawn, or None.
    error: Optional[str] = None
    #: The version and the commit that drew it.
    drawn_by: str = ""
    #: The options whose files have other bytes now; "input" for the input.
    changed_files: tuple[str, ...] = ()
    #: Whether size, channels and bits are the same.
    same_form: bool = True
    pixels_differ: int = 0
    #: The largest difference of a channel, in its own steps; of OpenEXR as numbers.
    largest_difference: float = 0
    #: Column and row of the first pixel that differs.
    first_difference: Optional[tuple[int, int]] = None
    #: Whether the pixels of the file are not those that it says it has.
    edited: bool = False

    def __bool__(self) -> bool:
        return self.verified


def _checked(figure: Any, source: Any) -> tuple[bytes, bytes]:
    path = os.fsencode(check_readable(figure, "figure"))
    return path, b"" if source is None else os.fsencode(check_readable(source, "input"))


def verify(figure: Path, input: Optional[Path] = None, *, difference: Optional[Path] = None, progress: Progress = None) -> Verdict:
    """Draws a figure again and compares every bit, as ``bihive verify`` does.

    figure: the path of a PNG, TIFF or OpenEXR file of bihive's, which says how it was drawn.
    input: in place of the figure's own, which is searched by name beside the figure and in the current folder.
    difference: the path of a PNG that shows where they differ; None: none.
    progress: as of render().

    Returns a Verdict, which is True if all bits are the same and the files have the same bytes. If the figure could not be
    drawn, its `error` says why. Raises FileError if the figure is not there.

    >>> import os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "figure.png")
    ...     render("demo", size=(64, 48), samples=1).save(path)
    ...     bool(verify(path))
    True
    """
    path, source = _checked(figure, input)
    to = "" if difference is None else path_of("difference", difference)
    if to and os.path.splitext(to)[1].lower() != ".png":
        raise bad_argument("difference", f"is written as PNG, found {found(to)}", "let it end in .png")
    for other in (path, source):
        if to and other and os.path.exists(to) and os.path.exists(other) and os.path.samefile(os.fsencode(to), other):
            raise bad_argument("difference", "is the figure or its input", "give it another name")
    with Bar(progress, "verifying") as bar:
        sentence, facts = _bihive.verify(path, source, os.fsencode(to), bar)
    values: dict[str, Any] = json.loads(facts)
    values["changed_files"] = tuple(values.get("changed_files", ()))
    first = values.get("first_difference")
    values["first_difference"] = None if first is None else (first[0], first[1])
    return Verdict(sentence=sentence, **values)


def again(
    figure: Path,
    input: Optional[Path] = None,
    *,
    camera: Camera = None,
    style: Union[Path, Style, dict[str, Any], None] = None,
    size: Optional[tuple[int, int]] = None,
    select: Union[str, npt.ArrayLike, None] = None,
    looks: Union[Look, Sequence[Look], None] = None,
    progress: Progress = None,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draws a figure again, of the same or of another input, with changes, as ``bihive again`` does.

    figure, input: as of verify().
    All else: as of render(). A keyword takes the place of what the figure says of the same setting; `select` and `looks`
    act after the figure's own selections. The style is a name or a file.

    >>> import os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "figure.png")
    ...     render("demo", size=(64, 48), samples=1, view_from="left").save(path)
    ...     again(path, size=(128, 96)).size
    (128, 96)
    """
    path, source = _checked(figure, input)
    if isinstance(style, (Style, dict)):
        raise bad_argument("style", "expected the name or the path of a style", "write it into a file")
    if isinstance(camera, Picture):
        raise bad_argument("camera", "expected Orthographic, Perspective or a side", "again() keeps the figure's camera")
    _bihive.check_environment()
    of_picture: dict[str, Any] = {"size": size, **options}
    words = picture_words(select, camera, style, looks_of(looks, of_picture), of_picture)
    with Bar(progress, "rendering") as bar:
        return picture_of(_bihive.again(path, source, [*words, "--", "spheres"], bar))
