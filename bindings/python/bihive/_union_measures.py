"""Area and volume of the union of spheres."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np

from . import _bihive
from ._arrays import one_each, whole_numbers
from ._checks import boolean, several
from ._errors import InputWarning, bad_argument, found
from ._progress import Bar, Progress
from ._select import chosen
from ._spheres import Spheres

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from ._types import Floats, Ids

__all__ = ["Contacts", "Measures", "buried_area", "contacts", "measure", "porosity", "sasa", "volume"]


class Measures(NamedTuple):
    """Area and volume of the union of spheres, in the units of the spheres.

    area and volume are those of the union; area_error and volume_error bound their rounding errors. sphere_area: float64 (n,), each
    sphere's share of the area, 0 where it is buried or left out. sphere_volume: float64 (n,), each sphere's share of the volume, all
    points whose power distance to it is the least. components: number of connected parts of the union. cavity_volume, cavity_area:
    float64 (k,), one entry per enclosed cavity, by descending volume. cavity_spheres: k arrays of positions, the spheres that line each.

    With periodic=True all of them are those of one cell. cell_volume, porosity and porosity_error are NaN unless the cell repeats along
    three vectors. channel_area: float64 (c,), one entry per surface that goes on from cell to cell; channel_translations: c arrays of
    int64 (1 to 3, 3), a basis of the moves, in counts of the cell's vectors, that bring it to itself; channel_spheres: as cavity_spheres.

    With derivatives=True, how area and volume grow with each centre, float64 (n, 3), and each radius, float64 (n,); None otherwise.
    """

    area: float
    volume: float
    area_error: float
    volume_error: float
    sphere_area: Floats
    sphere_volume: Floats
    components: int
    cavity_volume: Floats
    cavity_area: Floats
    cavity_spheres: list[Ids]
    cell_volume: float
    porosity: float
    porosity_error: float
    channel_area: Floats
    channel_translations: list[Ids]
    channel_spheres: list[Ids]
    area_by_centre: Optional[Floats] = None
    area_by_radius: Optional[Floats] = None
    volume_by_centre: Optional[Floats] = None
    volume_by_radius: Optional[Floats] = None


class Contacts(NamedTuple):
    """Pairs of spheres that divide the union between them, each once.

    first, second: int64 (m,), positions; equal for a sphere and an image of itself. image: int64 (m, 3), that of the second, in counts
    of the cell's vectors; 0 without periodic=True. area: float64 (m,), of the part of their common plane that belongs to no third one.
    """

    first: Ids
    second: Ids
    image: Ids
    area: Floats


def measure(
    spheres: Spheres,
    *,
    probe: float = 0.0,
    select: Union[str, npt.ArrayLike, None] = None,
    periodic: bool = False,
    derivatives: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Measures:
    """Exact area and volume of the union of the spheres (docs/measures.md).

    probe: added to every radius; 1.4 makes the area of a molecule its solvent-accessible surface. select: only these spheres exist,
    an expression, a mask of shape (n,), or positions. periodic: the spheres repeat along their cell. derivatives: compute them too.
    threads: 0 as many as the machine runs at once; the answer does not depend on it.

    progress: as of render(). Other Python threads run meanwhile, and Ctrl-C ends it.

    >>> round(measure(read("demo"), probe=1.4).area)
    9732
    """
    core, radius, mask, repeats, at_once = _checked(spheres, probe, select, periodic, threads)
    with Bar(progress, "measuring") as bar:
        made = _bihive.union_measures(core, radius, mask, repeats, True, boolean("derivatives", derivatives), at_once, bar)
    undecided = made.pop("undecided")
    if undecided > 0:
        text = f"the pieces of {undecided} spheres could not be told apart: cavities and components may be wrong"
        warnings.warn(InputWarning(text), stacklevel=2)
    return Measures(**made)


def sasa(spheres: Spheres, probe: float = 1.4, *, select: Union[str, npt.ArrayLike, None] = None, periodic: bool = False) -> Floats:
    """float64 (n,): the solvent-accessible area of each atom: of its part of the surface that a probe's centre can reach.

    Otherwise as `measure`.

    >>> round(float(sasa(read("demo")).sum()))
    9732
    """
    areas: Floats = _of_union(spheres, probe, select, periodic)["sphere_area"]
    return areas


def volume(spheres: Spheres, probe: float = 0.0, *, select: Union[str, npt.ArrayLike, None] = None, periodic: bool = False) -> float:
    """The volume of the union of the spheres.

    Otherwise as `measure`.
    """
    return float(_of_union(spheres, probe, select, periodic)["volume"])


def porosity(spheres: Spheres, probe: float = 0.0, *, select: Union[str, npt.ArrayLike, None] = None) -> float:
    """The share of the spheres' periodic cell that no sphere fills: 1 - volume / volume of the cell.

    The cell must repeat along three vectors. Otherwise as `measure`.

    >>> round(porosity(Spheres([[0, 0, 0]], radius=1, cell=[2, 2, 2])), 6)  # 1 - pi / 6
    0.476401
    """
    share = float(_of_union(spheres, probe, select, True)["porosity"])
    if np.isnan(share):
        raise bad_argument("spheres", "their cell repeats along fewer than three vectors, and so it has no volume")
    return share


def contacts(
    spheres: Spheres,
    probe: float = 0.0,
    *,
    select: Union[str, npt.ArrayLike, None] = None,
    periodic: bool = False,
    threads: int = 0,
) -> Contacts:
    """The area of contact of each two spheres. Otherwise as `measure`.

    >>> contacts(Spheres([[0, 0, 0], [1, 0, 0]], radius=1)).area / np.pi
    array([0.75])
    """
    core, radius, mask, repeats, at_once = _checked(spheres, probe, select, periodic, threads)
    return Contacts(*_bihive.contacts(core, radius, mask, repeats, at_once))


def buried_area(
    spheres: Spheres,
    groups: Sequence[Union[str, npt.ArrayLike]],
    probe: float = 1.4,
    *,
    periodic: bool = False,
    threads: int = 0,
) -> Floats:
    """float64 (k, k): the area that each two of k groups bury where they meet, of both sides; on the diagonal the area of each group alone.

    groups: expressions, masks or positions, without common spheres. The area is that of one group alone, plus that of the other alone,
    less that of both together. Otherwise as `measure`.

    >>> round(float(buried_area(read("demo"), ["chain A", "chain B"])[0, 1]))
    3680
    """
    core, radius, _, repeats, at_once = _checked(spheres, probe, None, periodic, threads)
    group_of_sphere = np.full(len(spheres), -1, dtype=np.int32)
    asked = several("groups", groups, "selections")
    for number, one in enumerate(asked):
        mask = chosen("groups", one, core)
        if (group_of_sphere[mask] >= 0).any():
            raise bad_argument("groups", f"group {number} has spheres of another one", "groups must not have common spheres")
        group_of_sphere[mask] = number
    return _bihive.buried_area(core, radius, group_of_sphere, len(asked), repeats, at_once)


def _of_union(spheres: Any, probe: Any, select: Any, periodic: Any) -> dict[str, Any]:
    """Without cavities and volumes of single spheres."""
    core, radius, mask, repeats, at_once = _checked(spheres, probe, select, periodic, 0)
    return _bihive.union_measures(core, radius, mask, repeats, False, False, at_once, None)


def _checked(spheres: Any, probe: Any, select: Any, periodic: Any, threads: Any) -> tuple[_bihive.Spheres, float, Any, bool, int]:
    if not isinstance(spheres, Spheres):
        raise bad_argument("spheres", f"expected Spheres, found {found(spheres)}")
    radius = float(one_each("probe", probe, 1)[0])
    if not 0 <= radius < np.inf:
        raise bad_argument("probe", f"expected a number of at least 0, found {found(probe)}")
    at_once = int(whole_numbers("threads", threads, 1, 0, 4096)[0])
    mask = None if select is None else np.ascontiguousarray(chosen("select", select, spheres._core), dtype=np.uint8)
    return spheres._core, radius, mask, boolean("periodic", periodic), at_once
