"""The page as a widget of a notebook, which tells Python what happens in it."""

from __future__ import annotations

import functools
import importlib
import os
from typing import TYPE_CHECKING, Any, Sequence, Union

from ._arrays import whole_numbers
from ._camera import Look
from ._render import Camera
from ._view import FRAME_PX, page

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    from ._option_types import RenderOptions

__all__ = ["widget"]

_TALLEST_PX = 10000


@functools.lru_cache(maxsize=None)
def _class() -> Any:
    """The class of widgets; raises ImportError where anywidget is missing."""
    anywidget: Any = importlib.import_module("anywidget")
    traitlets: Any = importlib.import_module("traitlets")
    with open(os.path.join(os.path.dirname(__file__), "_widget.js"), encoding="utf-8") as file:
        module = file.read()

    shared = {
        "page": traitlets.Bytes(),
        "name": traitlets.Unicode(),
        "height": traitlets.Int(),
        "camera": traitlets.Dict(),
        "pins": traitlets.List(traitlets.Int()),
        "picked": traitlets.Any(None, allow_none=True),
    }
    members = {
        "__doc__": "The page with spheres inside, made by widget().",
        "__module__": "bihive",
        "__repr__": lambda self: f"<bihive.Widget: {self.name}, {len(self.page) / 1e6:.1f} MB>",
        "_esm": module,
        **{name: trait.tag(sync=True) for name, trait in shared.items()},
    }
    return type("Widget", (anywidget.AnyWidget,), members)


def widget(
    source: Any,
    *,
    camera: Camera = None,
    style: Any = None,
    select: Union[str, npt.ArrayLike, None] = None,
    looks: Union[Look, Sequence[Look], None] = None,
    height: int = FRAME_PX,
    **options: Unpack[RenderOptions],
) -> Any:
    """The page with these spheres in a cell of a notebook, as a widget where the package anywidget is installed; else page().

    height: height of the frame in pixels. All other arguments are those of save_page().

    The widget's traits are shared with the page, so observe() tells of changes:

    camera: the camera of the page, a dictionary as Picture.camera; empty until the page is shown. Setting it, or some of its
        members, moves the camera.
    pins: a list of the positions of the pinned spheres. picked: the sphere pinned last, a dictionary with "sphere", "centre",
        "radius" and "attributes", or None.
    """
    pixels = int(whole_numbers("height", height, 1, 1, _TALLEST_PX)[0])
    made = page(source, camera=camera, style=style, select=select, looks=looks, **options)
    try:
        kind = _class()
    except ImportError:
        made.height = pixels
        return made
    return kind(page=made.html.encode(), name=made.name, height=pixels)
