"""Answers of trees: the spheres that rays meet, and those near points."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional

import numpy as np

from . import _bihive
from ._errors import UsageError

if TYPE_CHECKING:
    from ._types import Floats, Ids

__all__ = ["ClosestHits", "Hits", "HitDerivatives", "Near", "Pairs"]

Array = np.ndarray[Any, Any]


class HitDerivatives(NamedTuple):
    """How hits change with their spheres, the rays being fixed. float64, NaN where nothing was hit, and infinite or NaN where a
    ray touches the silhouette; lengths in world units.

    t_by_centre: (..., 3). t_by_radius: (...). normal_by_centre: (..., 3, 3): row i is that of component i of the normal.
    normal_by_radius: (..., 3). With the outward normal n and the direction d: dt = (n . dc + dr) / (n . d).
    """

    t_by_centre: Floats
    t_by_radius: Floats
    normal_by_centre: Floats
    normal_by_radius: Floats


class RayQuery:
    """The rays of a query, for the surfaces at its hits."""

    def __init__(self, tree: _bihive.Tree, ids_in_tree: Any, rays: tuple[Array, Array], images: bool) -> None:
        self.tree, self.ids_in_tree, self.rays, self.images = tree, ids_in_tree, rays, images

    def surfaces(self, ray: Optional[Array], t: Any, ids: Any, derivatives: bool) -> tuple[Floats, ...]:
        """Arrays of the surface at each hit, with the shape of `t` in front of their own."""
        t, ids = np.asarray(t), np.asarray(ids)
        flat = self.ids_in_tree(np.ascontiguousarray(ids.reshape(-1)))
        made = self.tree.surfaces(*self.rays, ray, np.ascontiguousarray(t.reshape(-1)), flat, self.images, derivatives)
        return tuple(one.reshape(t.shape + one.shape[1:])[()] for one in made)


class _Surfaces:
    """What hits know besides t and id."""

    _query: Optional[RayQuery] = None

    def _hits(self) -> tuple[Optional[Array], Any, Any]:
        """The ray of each hit (None: hit i is that of ray i), t and id."""
        raise NotImplementedError

    def _surfaces(self, derivatives: bool = False) -> tuple[Floats, ...]:
        if self._query is None:
            raise UsageError("hits that were pickled, copied or made by hand know no rays: ask a Tree")
        return self._query.surfaces(*self._hits(), derivatives)

    def __getstate__(self) -> None:
        return None  # the rays and the tree stay where they are

    def positions(self) -> Floats:
        """float64 (..., 3): the hit points, on the surface of their spheres; world units, NaN for none.

        Computed now, of the rays' own arrays: UsageError if these have changed since, so that they are other rays.
        """
        return self._surfaces()[0]

    def normals(self) -> Floats:
        """float64 (..., 3): the outward normals of the spheres at the hit points, length 1; NaN for none. As positions()."""
        return self._surfaces()[1]

    def exits(self) -> Floats:
        """float64 (...): the t at which each ray leaves the sphere that it hit, if nothing else stops it: t itself for a hit
        from inside; NaN for none. As positions()."""
        return self._surfaces()[2]

    def derivatives(self) -> HitDerivatives:
        """How t and the normals change with the centres and radii of the spheres. As positions()."""
        return HitDerivatives(*self._surfaces(True))


class _ClosestHits(NamedTuple):
    t: Floats
    id: Ids


class ClosestHits(_Surfaces, _ClosestHits):
    """The nearest hit of each ray, with the shape of the rays: of a single ray two numbers.

    t: float64, inf for none. id: int64, the sphere's position, -1 for none. ``t, i = tree.closest(...)`` unpacks it.

    >>> from bihive import Spheres, Tree
    >>> hits = Tree(Spheres([[0.0, 0, 0]], radius=1)).closest([[-5, 0, 0], [-5, 3, 0]], [1, 0, 0])
    >>> hits.positions().tolist(), hits.exits().tolist()
    ([[-1.0, 0.0, 0.0], [nan, nan, nan]], [6.0, nan])
    """

    def _hits(self) -> tuple[Optional[Array], Any, Any]:
        return None, self.t, self.id


class _Hits(NamedTuple):
    ray: Ids
    t: Floats
    id: Ids
    begin: Ids


class Hits(_Surfaces, _Hits):
    """Every hit of many rays: by ray, then by t, then by id. Arrays of one length.

    ray: int64, the ray's position (of rays of several axes: in C order). t: float64. id: int64, the sphere's position. begin:
    int64 (rays + 1): the hits of ray i are those from begin[i] to before begin[i + 1].
    """

    def _hits(self) -> tuple[Optional[Array], Any, Any]:
        return self.ray, self.t, self.id

    @property
    def counts(self) -> Ids:
        """The number of hits of each ray: int64 (rays,)."""
        made: Ids = np.diff(self.begin)
        return made


class Near(NamedTuple):
    """The spheres near many points: by point, then by position.

    begin: int64 (points + 1): the spheres of point i (of points of several axes: in C order) are those from begin[i] to before
    begin[i + 1]. id: int64, the sphere's position; of a periodic tree, once for each of its images. distance: float64, below
    0 inside a sphere.
    """

    begin: Ids
    id: Ids
    distance: Floats

    @property
    def counts(self) -> Ids:
        """The number of spheres of each point: int64 (points,)."""
        made: Ids = np.diff(self.begin)
        return made


class Pairs(NamedTuple):
    """Pairs of spheres, each once: by first, then by second. Arrays of one length.

    first, second: int64, positions, first < second; equal for a sphere and an image of itself. distance: float64.
    """

    first: Ids
    second: Ids
    distance: Floats
