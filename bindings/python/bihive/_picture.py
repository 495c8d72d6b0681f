"""Pictures."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _bihive
from ._arrays import numbers, vectors
from ._checks import boolean, path_of, text_of
from ._errors import UsageError, bad_argument, found, writing

if TYPE_CHECKING:
    import numpy.typing as npt

__all__ = ["Picture"]

# The arguments of render() that made a picture: source, camera, style, select, looks, options.
Asked = tuple[Any, Any, Any, Any, Any, dict[str, Any]]


class Picture:
    """A finished picture, made by render().

    It shows itself in a notebook. numpy.asarray(picture) is uint8 (height, width, 3), of a transparent picture (height, width,
    4), and uint16 with bits=16; the same bits as in the PNG that ``bihive render`` writes.

    It keeps its scene for layer(); detach() lets that go. A pickled picture has its pixels alone.
    """

    _asked: Optional[Asked] = None

    def __init__(self, core: _bihive.Picture) -> None:
        if not isinstance(core, _bihive.Picture):
            raise TypeError(f"a Picture is made by render(), not of {found(core)}")
        self._core = core

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        height, width = self._core.pixels.shape[:2]
        return width, height

    @property
    def report(self) -> dict[str, Any]:
        """The output of ``bihive render --json``: settings, numbers of rays, build_ms, render_ms."""
        made: dict[str, Any] = json.loads(self._core.report)
        return made

    @property
    def camera(self) -> dict[str, Any]:
        """The camera of the picture: eye, look_at, up, fov_deg... in world units."""
        made: dict[str, Any] = self.report["settings"]["camera"]
        return made

    @property
    def hash(self) -> int:
        """Equal pictures have equal hashes: ``picture_hash`` of ``bihive render --json``."""
        return self._core.hash

    @property
    def methods(self) -> str:
        """A sentence for a methods section, and an entry for BibTeX: the output of ``bihive render --methods``."""
        return self._core.methods

    def layer(self, name: str) -> np.ndarray[Any, Any]:
        """Numbers of the first surface behind each pixel (height, width); a new array.

        "depth": float32, distance along the view in world units, inf for nothing. "normal": float32 (height, width, 3).
        "id": int64, the position of the sphere, -1 for nothing, -2 for the plane. "albedo": float32 (height, width, 3), the
        colour before any light. "radiance": float32 (height, width, 3 or 4), the light of the picture without the screen's
        curve. "attribute:NAME": float32, an attribute of the sphere, NaN for nothing.
        """
        return self._core.layer(text_of("name", name, "the name of a layer"))

    def rays(
        self, x: Optional[npt.ArrayLike] = None, y: Optional[npt.ArrayLike] = None
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """The camera's rays through these positions: origins and directions, float64 (..., 3), in world units.

        x, y: pixels from the left and from the top, of any shapes that broadcast; (0.5, 0.5) is the centre of the first pixel.
            Left out: the centres of all pixels, (height, width, 3). A lens is left out.

        >>> from bihive import Tree, read, render
        >>> picture = render("demo", size=(64, 48), samples=1)
        >>> bool((Tree(read("demo")).closest(*picture.rays()).id == picture.layer("id")).all())
        True
        """
        if (x is None) != (y is None):
            raise bad_argument("x" if x is None else "y", "is missing", "give both, or neither for all pixels")
        if x is None or y is None:
            width, height = self.size
            x, y = np.arange(width) + 0.5, np.arange(height)[:, None] + 0.5
        origins, directions, _ = self._rays(x, y)
        return origins, directions

    def project(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Where points of the world are in the picture: float64 (..., 3), x and y in pixels as in rays(), and the distance along
        the view. x and y are NaN for what lies behind an eye.

        points: shape (..., 3), world units.
        """
        where = vectors("points", points)
        made = self._core.camera_places(np.ascontiguousarray(where.reshape(-1, 3), dtype=np.float64))
        placed: npt.NDArray[np.float64] = made.reshape(where.shape)
        return placed

    def unproject(self, x: npt.ArrayLike, y: npt.ArrayLike, depth: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The inverse of project(): points of the world, float64 (..., 3).

        depth: distances along the view in world units, as layer("depth") has them; infinity gives no finite point.
        """
        origins, directions, forward = self._rays(x, y)
        along, away = (directions * forward).sum(axis=-1), np.asarray(numbers("depth", depth))
        try:
            t = away / along
        except ValueError:
            raise bad_argument("depth", f"has shape {away.shape}, which does not fit x and y, {along.shape}") from None
        made: npt.NDArray[np.float64] = origins + t[..., None] * directions
        return made

    def _rays(self, x: Any, y: Any) -> tuple[Any, Any, Any]:
        columns, rows_of = numbers("x", x), numbers("y", y)
        try:
            at = np.broadcast_arrays(columns, rows_of)
        except ValueError:
            raise bad_argument("y", f"has shape {rows_of.shape}, which does not fit x, {columns.shape}") from None
        rows = [np.ascontiguousarray(one.reshape(-1), dtype=np.float64) for one in at]
        origins, directions, forward = self._core.camera_rays(*rows)
        shape = (*at[0].shape, 3)
        return origins.reshape(shape), directions.reshape(shape), np.array(forward)

    def save(self, path: Union[str, os.PathLike[str]], *, layers: Optional[str] = None, metadata: bool = True) -> None:
        """Writes a PNG, or TIFF (.tif) or OpenEXR (.exr) where the path ends so, whole or not at all.

        `layers` are names of layer() between commas, for OpenEXR ("radiance"): the file holds the same numbers.
        `metadata`: the file says how it was drawn, for verify() and again() too; False: pixels alone. Raises FileError (an
        OSError) if the file cannot be written, UsageError of layers that are unknown.
        """
        text = path_of("path", path)
        if layers is not None:
            text_of("layers", layers, "names between commas")
        metadata = boolean("metadata", metadata)
        ending = os.path.splitext(text)[1].lower()
        if ending == ".exr":
            with writing(text):
                self._core.save_exr(os.fsencode(text), "radiance" if layers is None else layers, metadata)
            return
        is_tiff = ending in (".tif", ".tiff")
        if ending not in ("", ".png") and not is_tiff:
            raise bad_argument("path", f"save() writes PNG, TIFF and OpenEXR, not {ending}", "let it end in .png, .tif or .exr")
        if layers is not None:
            raise bad_argument("layers", f"a {'TIFF' if is_tiff else 'PNG'} holds no layers", "let the path end in .exr")
        with writing(text):
            if is_tiff:
                self._core.save_tiff(os.fsencode(text), metadata)
            else:
                self._core.save(os.fsencode(text), metadata)

    def to_html(self) -> str:
        """The page with what the picture shows, in which it can be turned, measured and changed: one document of HTML of some 2 MB
        plus data, which opens without a network or a server.

        The spheres, camera, style, select, looks and options of render() are those of the picture; what pictures alone have, such
        as size and samples, is left out. A style that is a Style or a dictionary, and arrays for colours are refused: the page
        takes names, and columns of the spheres.

        Raises UsageError of a picture without a scene: detached, pickled, drawn with the camera of another picture, or not made by
        render(); MissingError where the program ``bihive`` or its page (``make web``) is missing.
        """
        from ._view import page_of_picture

        if self._asked is None:
            raise UsageError("the picture keeps no scene: it was detached, pickled, drawn like another picture, or not made by render()")
        return page_of_picture(self._asked)

    def detach(self) -> Picture:
        """Releases the scene and its tree, whose memory may be large: layer() then fails. Returns the picture."""
        self._asked = None
        self._core.detach()
        return self

    def __getstate__(self) -> dict[str, Any]:
        return {"_core": self._core}

    def _repr_png_(self) -> Optional[bytes]:
        return self._core.png()

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray[Any, Any]:
        pixels = self._core.pixels
        array = pixels if pixels.dtype.isnative else pixels.astype(pixels.dtype.newbyteorder("="))
        if dtype is not None and array.dtype != dtype:
            return array.astype(dtype)
        return array.copy() if copy else array

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Picture):
            return NotImplemented
        return np.array_equal(self._core.pixels, other._core.pixels)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        width, height = self.size
        report = self.report
        return f"<bihive.Picture: {width} x {height}, {report['spheres']} spheres of {report['scene']}>"
