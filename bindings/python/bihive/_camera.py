"""Cameras, looks and styles: what determines a picture besides its spheres. All can be compared, copied and pickled."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

from ._checks import boolean, mapping
from ._colours import Linear
from ._errors import UsageError, bad_argument, found, shortened
from ._options import ACTIONS, action_words, option
from ._per_sphere import ColourBy, PerSphere, colour_by_of, per_sphere
from ._select import Selected, selected

if TYPE_CHECKING:
    import numpy.typing as npt

__all__ = ["Orthographic", "Perspective", "Look", "Style"]

Vector = Sequence[float]


def _words(camera: Any, projection: str) -> list[str]:
    words = [option("projection", projection)]
    for one in fields(camera):
        value = getattr(camera, one.name)
        if value is not None:
            words.append(option(one.name, value))
    return words


@dataclass(frozen=True)
class Orthographic:
    """Parallel rays: equal spheres look equally large at any distance.

    view_from: "front", "back", "left", "right", "top", "bottom" or "iso": the whole set from this side; "principal": its longest
    axis along the picture's longer side; "best:EXPR": the direction that shows most of a selection.
    eye, look_at, up: three numbers each, in world units; instead of view_from. look_at may be a selection.
    turn: (azimuth, elevation) or (azimuth, elevation, roll) in degrees. zoom: a factor above 0.
    fit: a selection that fills the picture, seen from near. zoom_to: one that is magnified until it does.

    >>> Orthographic("left", zoom=1.5)
    Orthographic(view_from='left', eye=None, look_at=None, up=None, turn=None, zoom=1.5, fit=None, zoom_to=None)
    """

    view_from: Optional[str] = None
    eye: Optional[Vector] = None
    look_at: Union[Vector, str, None] = None
    up: Optional[Vector] = None
    turn: Optional[Vector] = None
    zoom: Optional[float] = None
    fit: Optional[str] = None
    zoom_to: Optional[str] = None

    def words(self) -> list[str]:
        return _words(self, "orthographic")


@dataclass(frozen=True)
class Perspective:
    """Rays from one eye. The arguments of Orthographic, and:

    fov: the angle along the picture's shorter side, in degrees (30).
    aperture: the radius of the lens in world units (0: all is sharp). focus: the distance that is sharp, in world units,
    "auto", or a selection.

    >>> Perspective(eye=(0, 0, 50), look_at=(0, 0, 0)).fov is None
    True
    """

    view_from: Optional[str] = None
    eye: Optional[Vector] = None
    look_at: Union[Vector, str, None] = None
    up: Optional[Vector] = None
    turn: Optional[Vector] = None
    zoom: Optional[float] = None
    fov: Optional[float] = None
    aperture: Optional[float] = None
    focus: Union[float, str, None] = None
    fit: Optional[str] = None
    zoom_to: Optional[str] = None

    def words(self) -> list[str]:
        return _words(self, "perspective")


# The actions that take arrays, and the words that stand where an array acts, until the array replaces it.
_OF_ARRAYS = {"radius": "--radius-scale=1", "colour": "--colour=black", "opacity": "--opacity=1"}


@dataclass(frozen=True)
class Look:
    """Actions on the spheres of a selection: the options of the command line after ``--select``.

    select: an expression (docs/selections.md), or for spheres in memory a mask of shape (n,) or positions. show: False hides them. colour: a name, "#rrggbb", or three numbers as a
    screen shows them (linear light: linear()). colour_by: "ATTR[:MAP[:MIN,MAX[:log]]]". opacity: 0 (clear) to 1. material: a name. radius_scale: a factor.
    For spheres in memory arrays with a row for each of all n spheres, of which the selected ones take theirs: colour of shape
    (n, 3) or n names, opacity (n,), radius (n,) in world units, and colour_by (n,) of numbers or texts, or a pair of it and
    "MAP[:MIN,MAX[:log]]".
    outline: pixels. crease: an attribute. legend_name: a text. clip: a text such as "plane:1,0,0,2.5", or several.

    >>> Look("element C", colour="orange", opacity=0.5).words()
    ['--select=element C', '--colour=orange', '--opacity=0.5']
    >>> Look([3, 4, 5, 9], show=False).words(count=10)
    ['--select=index 3..5 9', '--hide']
    >>> Look("element C", opacity=[0.5, 1, 0.25])
    Look(select='element C', show=None, colour=None, colour_by=None, opacity=[0.5 , 1.  , 0.25], material=None, radius_scale=None, radius=None, outline=None, crease=None, legend_name=None, clip=None)
    """

    select: Any = "all"
    show: Optional[bool] = None
    colour: Union[str, npt.ArrayLike, Linear, PerSphere, None] = None
    colour_by: Union[str, npt.ArrayLike, tuple[npt.ArrayLike, str], ColourBy, None] = None
    opacity: Union[float, npt.ArrayLike, PerSphere, None] = None
    material: Optional[str] = None
    radius_scale: Optional[float] = None
    radius: Union[npt.ArrayLike, PerSphere, None] = None
    outline: Optional[float] = None
    crease: Optional[str] = None
    legend_name: Optional[str] = None
    clip: Union[str, Sequence[str], None] = None
    _needs: Optional[Selected] = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        # Masks and positions are kept as text, so that looks stay small, and can be compared and pickled.
        if not isinstance(self.select, str):
            needs = selected("select", self.select)
            object.__setattr__(self, "select", needs.text)
            object.__setattr__(self, "_needs", needs)
        for name in _OF_ARRAYS:
            values = per_sphere(name, getattr(self, name))
            if values is not None:
                object.__setattr__(self, name, values)
        if (by := colour_by_of(self.colour_by)) is not None:
            object.__setattr__(self, "colour_by", by)
        if self.radius is not None and not isinstance(self.radius, PerSphere):
            raise bad_argument("radius", f"expected an array of shape (n,), found {found(self.radius)}", "radius_scale takes a factor")

    def words(self, count: Optional[int] = None) -> list[str]:
        """The options of the command line; `count`: the number of spheres, for masks and positions."""
        words = [option("select", self.select if self._needs is None else self._needs.of("select", count))]
        if self.show is not None:
            words.append("--show" if boolean("show", self.show) else "--hide")
        for name in ["radius", *ACTIONS]:
            value = getattr(self, name)
            if isinstance(value, PerSphere):
                value.check(name, count)
                words.append(_OF_ARRAYS[name])
            elif isinstance(value, ColourBy):
                raise bad_argument(name, "an array has no words", "render() takes it")
            elif value is not None:
                words += action_words(name, value)
        return words

    def arrays(self) -> list[tuple[str, PerSphere]]:
        """The actions whose words stand for arrays."""
        values = [(name, getattr(self, name)) for name in _OF_ARRAYS]
        return [(name, value) for name, value in values if isinstance(value, PerSphere)]


@dataclass(frozen=True)
class Style:
    """A custom style: the keys of a style file (docs/styles.md) as a dictionary.

    >>> Style({"material": {"diffuse": 0.9}, "background": "black"}).text()
    '{"bihive_style": 1, "material": {"diffuse": 0.9}, "background": "black"}'
    """

    keys: dict[str, Any] = field(default_factory=dict)

    def text(self) -> str:
        """The style file."""
        try:
            return json.dumps({"bihive_style": 1, **mapping("style", self.keys)})
        except (TypeError, ValueError, RecursionError) as error:
            if isinstance(error, UsageError):
                raise
            raise bad_argument("style", f"cannot be written as JSON: {shortened(str(error))}") from None
