"""Trees for queries about rays and points."""

from __future__ import annotations

import os
from typing import Any, NamedTuple, Optional

import numpy as np

from . import _bihive
from ._adapt import spheres_of
from ._arrays import one_each, vectors, whole_numbers
from ._checks import boolean, one_of, text_of
from ._errors import Error, InputError, bad_argument, found
from ._options import words_of
from ._spheres import Spheres

__all__ = ["Tree", "Hits", "Near"]

Array = np.ndarray[Any, Any]
_ENDS = ("surface", "centre")  # of a distance
_PLENTY = 2**28  # bytes: smaller answers fit into every machine


class Hits(NamedTuple):
    """Every hit of many rays: by ray, then by t, then by id. Arrays of one length.

    ray: int64, the ray's position. t: float64. id: int64, the sphere's position. begin: int64 (rays + 1): the hits of ray i
    are those from begin[i] to before begin[i + 1].
    """

    ray: Array
    t: Array
    id: Array
    begin: Array


class Near(NamedTuple):
    """The spheres near many points: by point, then by position.

    begin: int64 (points + 1): the spheres of point i are those from begin[i] to before begin[i + 1]. id: int64, the sphere's
    position; of a periodic tree, once for each of its images. distance: float64, below 0 inside a sphere.
    """

    begin: Array
    id: Array
    distance: Array

    @property
    def counts(self) -> Array:
        """The number of spheres of each point: int64 (points,)."""
        made: Array = np.diff(self.begin)
        return made


class Tree:
    """Answers which spheres rays meet. Exact: float64 decides, without an epsilon, and the answers are those of testing every
    sphere, bit for bit.

    spheres: Spheres, or what render() takes besides paths. select: only these spheres count; ids stay positions in all.
    periodic: queries about points consider all periodic images of the spheres, where these have a cell. An image is
        returned as the position of its sphere, which may thus occur several times, and the distance to the image. Rays meet
        the spheres alone, as in pictures, unless the query has periodic=True. False: no images.
    engine: "auto" (wide), "wide", "reference", "brute" or "wide-brute". max_prims, max_depth: limits of the tree.
    threads: of building and queries; 0: as many as the machine runs at once.

    >>> import numpy as np
    >>> tree = Tree(Spheres(np.array([[0.0, 0, 0], [5, 0, 0]]), radius=1))
    >>> t, i = tree.closest([[-10, 0, 0], [0, 9, 0]], [1, 0, 0])
    >>> t.tolist(), i.tolist()
    ([9.0, inf], [0, -1])
    >>> tree.all_hits([-10, 0, 0], [1, 0, 0]).t.tolist()
    [9.0, 14.0]
    >>> box = Tree(Spheres([[0.5, 0, 0], [9.5, 0, 0]], radius=0.1, cell=[10, 10, 10]))
    >>> box.within([0.5, 0, 0], 1.5, to="centre").id.tolist()
    [0, 1]
    >>> box.closest([5, 0, 0], [1, 0, 0], t_min=5, periodic=True)[1].tolist()  # the first sphere again, at 10.5
    [0]
    """

    def __init__(
        self,
        spheres: Any,
        *,
        select: Optional[str] = None,
        periodic: bool = True,
        engine: str = "auto",
        max_prims: Any = None,
        max_depth: Any = None,
        threads: int = 0,
    ) -> None:
        _bihive.check_environment()
        self._spheres: Spheres = spheres_of(spheres)
        self._ids: Optional[Array] = None
        images = boolean("periodic", periodic)
        if select is not None:
            expression = text_of("select", select, "a selection as text")
            self._ids = np.flatnonzero(self._spheres._core.select(expression, "select", images))
        options = {"engine": engine, "max_prims": max_prims, "max_depth": max_depth, "threads": threads}
        part = None if self._ids is None else self._ids.tolist()
        self._core = _bihive.build_tree(self._spheres._core, part, images, words_of(options))

    @property
    def spheres(self) -> Spheres:
        """Its spheres."""
        return self._spheres

    @property
    def periodic(self) -> bool:
        """Whether there are images along the spheres' cell, for points and for rays with periodic=True."""
        return self._core.periodic

    @property
    def build_ms(self) -> float:
        """The time of its construction, in milliseconds."""
        return self._core.build_ms

    def __len__(self) -> int:
        return len(self._core)

    def __repr__(self) -> str:
        return f"<bihive.Tree of {len(self)} spheres>"

    def __reduce__(self) -> Any:
        raise TypeError("a tree cannot be pickled: pickle its spheres, and build it again")

    def closest(
        self,
        origins: Any,
        directions: Any,
        *,
        t_min: Any = None,
        t_max: Any = None,
        leaves: Any = None,
        inside: Any = None,
        periodic: bool = False,
        order: str = "any",
    ) -> tuple[Array, Array]:
        """The nearest hit of each ray: t, float64 (n,), inf for none; and the sphere's position, int64 (n,), -1 for none.

        origins, directions: shape (n, 3), or (3,) for one that all rays share. Directions may have any length above 0, and t
            counts in lengths of them: the hit is at origin + t direction. Rays are kept in float32: float64 is rounded once,
            relative to the spheres' origin if they are far from 0. A ray with NaN, an infinity (or beyond 3.4e38), or a
            direction of 0 hits nothing.
        t_min, t_max: the part of the ray that counts, both ends with it: one number, or shape (n,); 0 and inf.
        leaves: the sphere on which a ray starts, int64, one or (n,); -1: none. It is not met again, or with inside=True (one,
            or bool (n,)) at its far side alone. Of its images, the one whose surface is nearest to the origin.
        periodic: rays meet the images of the spheres too, as positions of their spheres.
        order: "blocks" if each 64 neighbours are close to each other, as 8 x 8 pixels are: faster. The answers do not change.

        Other Python threads run meanwhile, and Ctrl-C ends it. Error: UsageError for a periodic ray that passes 16,384
        cells without a hit or a t_max.
        """
        rays = self._rays(origins, directions, t_min, t_max, leaves, inside)
        images, in_blocks = self._images(periodic), _in_blocks(order)
        try:
            t, ids = self._core.closest(*rays, images, in_blocks)
        except InputError as error:
            raise _of_t_max(error) from None
        return t, self._positions(ids)

    def occluded(
        self,
        origins: Any,
        directions: Any,
        *,
        t_min: Any = None,
        t_max: Any = None,
        leaves: Any = None,
        inside: Any = None,
        periodic: bool = False,
        order: str = "any",
    ) -> Array:
        """Whether each ray hits anything: bool (n,). Arguments as those of closest(); faster than that."""
        rays = self._rays(origins, directions, t_min, t_max, leaves, inside)
        images, in_blocks = self._images(periodic), _in_blocks(order)
        try:
            return self._core.occluded(*rays, images, in_blocks)
        except InputError as error:
            raise _of_t_max(error) from None

    def all_hits(
        self,
        origins: Any,
        directions: Any,
        *,
        t_min: Any = None,
        t_max: Any = None,
        leaves: Any = None,
        inside: Any = None,
        periodic: bool = False,
    ) -> Hits:
        """Every sphere that each ray meets, where it enters. Arguments as those of closest(); periodic rays need t_max."""
        rays = self._rays(origins, directions, t_min, t_max, leaves, inside)
        images = self._images(periodic)
        try:
            ray, t, ids = self._core.all_hits(*rays, images)
        except InputError as error:
            raise _of_t_max(error) from None
        begin = np.searchsorted(ray, np.arange(rays[0].shape[0] + 1))
        return Hits(ray, t, self._positions(ids), begin)

    def nearest(
        self, points: Any, k: int = 1, *, within: Optional[float] = None, to: str = "surface"
    ) -> tuple[Array, Array]:
        """The k nearest spheres of each point: distances, float64, inf where there are fewer; and positions, int64, -1 there.

        points: shape (n, 3), or (3,) for one; float64 decides. Finite, and at most 3.4e38 in size.
        k: at least 1. Both answers have shape (n,) for k = 1, else (n, k), ordered by distance, then position.
        within: only spheres at a distance of at most this; None: any.
        to: "surface" (below 0 inside a sphere), or "centre".

        Other Python threads run meanwhile, and Ctrl-C ends it. Error: InputError for a point that is not finite.

        >>> tree = Tree(Spheres([[0.0, 0, 0], [5, 0, 0]], radius=1))
        >>> distance, i = tree.nearest([[2, 0, 0], [5, 0, 0.5]])
        >>> distance.tolist(), i.tolist()
        ([1.0, -0.5], [0, 1])
        """
        if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
            raise bad_argument("k", f"expected a whole number of at least 1, found {found(k)}")
        where = _points(points)
        if 16 * where.shape[0] * int(k) > _PLENTY and 16 * where.shape[0] * int(k) > _memory():
            raise bad_argument("k", f"the answers for {where.shape[0]} points are larger than the memory, found {found(k)}")
        most = np.inf if within is None else float(one_each("within", within, 1)[0])
        if np.isnan(most):
            raise bad_argument("within", "expected a number, found NaN")
        try:
            distance, ids = self._core.nearest(where, int(k), most, _to_centre(to))
        except InputError:
            _check_points(where)
            raise
        ids = self._positions(ids)
        return (distance[:, 0], ids[:, 0]) if k == 1 else (distance, ids)

    def within(self, points: Any, limits: Any, *, to: str = "surface") -> Near:
        """Every sphere at a distance of at most `limits` from each point: one number, or shape (n,).

        points, to: as those of nearest(). To the surface, a limit of 0 gives the spheres that contain the point, and r those
            that share a point with the ball of radius r around it.
        """
        where = _points(points)
        if isinstance(limits, float):
            most = np.full(where.shape[0], limits)
        else:
            most = one_each("limits", limits, where.shape[0]).astype(np.float64)
        if np.isnan(most).any():
            raise bad_argument("limits", "expected numbers, found NaN")
        return self._within("limits", where, most, to)

    def _within(self, name: str, where: Array, most: Array, to: str) -> Near:
        try:
            begin, ids, distance = self._core.within(where, np.ascontiguousarray(most), _to_centre(to))
        except InputError as error:
            _check_points(where)
            # Each image of a sphere is found, and there may be too many.
            if self.periodic and "images" in str(error):
                raise bad_argument(name, str(error)) from None
            raise
        return Near(begin, self._positions(ids), distance)

    def contains(self, points: Any) -> Near:
        """Every sphere that contains each point, its surface included. points: as those of nearest().

        >>> tree = Tree(Spheres([[0.0, 0, 0], [1, 0, 0]], radius=1))
        >>> tree.contains([[0.5, 0, 0], [2, 0, 0], [3, 0, 0]]).counts.tolist()
        [2, 1, 0]
        """
        return self.within(points, 0.0)

    def overlaps(self, points: Any, radii: Any) -> Near:
        """Every sphere that shares a point with the ball of radius `radii` (one number, or shape (n,)) around each point."""
        where = _points(points)
        sizes = one_each("radii", radii, where.shape[0])
        if sizes.size > 0 and not (np.isfinite(sizes).all() and (sizes >= 0).all()):
            raise bad_argument("radii", "expected finite numbers of at least 0")
        return self._within("radii", where, sizes.astype(np.float64), "surface")

    def _images(self, periodic: Any) -> bool:
        if boolean("periodic", periodic) and not self.periodic:
            raise bad_argument("periodic", "the tree has no images: its spheres have no periodic cell, or it was made without")
        return bool(periodic)

    def _positions(self, ids: Array) -> Array:
        """Positions among all spheres, of positions in the subset."""
        if self._ids is None or len(self._ids) == 0:
            return ids
        made: Array = np.where(ids >= 0, self._ids[np.maximum(ids, 0)], ids)
        return made

    def _in_part(self, leaves: Array) -> Array:
        """The inverse; a sphere outside the subset becomes none."""
        if self._ids is None:
            return leaves
        if len(self._ids) == 0:
            return np.full_like(leaves, -1)
        place = np.minimum(np.searchsorted(self._ids, leaves), len(self._ids) - 1)
        made: Array = np.where(self._ids[place] == leaves, place, -1)
        return made

    def _rays(
        self, origins: Any, directions: Any, t_min: Any, t_max: Any, leaves: Any, inside: Any
    ) -> tuple[Array, Array, Optional[Array], Optional[Array], Optional[Array], Optional[Array]]:
        origin = vectors("origins", origins)
        direction = vectors("directions", directions)
        if origin.ndim == direction.ndim == 2 and origin.shape != direction.shape:
            raise bad_argument(
                "directions", f"expected as many as origins, found shapes {origin.shape} and {direction.shape}"
            )
        count = (origin if origin.ndim == 2 else direction).shape[0] if origin.ndim + direction.ndim > 2 else 1
        left = None
        if leaves is not None:
            most = max(len(self._spheres) - 1, 0)
            given = whole_numbers("leaves", leaves, count, -2, most)
            left = np.ascontiguousarray(self._in_part(given.astype(np.int64)), dtype=np.int64)
        into = None
        if inside is not None:
            into = np.ascontiguousarray(one_each("inside", inside, count) != 0).view(np.uint8)
        return (
            _spread(origin, count),
            _spread(direction, count),
            None if t_min is None else one_each("t_min", t_min, count),
            None if t_max is None else one_each("t_max", t_max, count),
            left,
            into,
        )


def _of_t_max(error: InputError) -> Error:
    """Names the argument when a ray of a periodic tree has no end."""
    return bad_argument("t_max", str(error)) if "without an end" in str(error) else error


def _memory() -> int:
    """Of this machine, in bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _points(points: Any) -> Array:
    """float64 (n, 3), row by row. The compiled part refuses numbers that are none; _check_points() then says which."""
    array = vectors("points", points)
    if array.ndim == 1:
        array = array.reshape(1, 3)
    if array.dtype == np.float64 and array.flags.c_contiguous:
        return array
    return np.ascontiguousarray(array, dtype=np.float64)


def _check_points(points: Array) -> None:
    bad = ~(np.abs(points) <= np.finfo(np.float32).max).all(axis=1)
    if bad.any():
        first = int(bad.argmax())
        message = f"points: point {first} must be finite and at most 3.4e38 in size, found {points[first].tolist()}"
        raise InputError(message, argument="points") from None


def _spread(array: Array, count: int) -> Array:
    """Shape (count, 3), of vectors or of one that all share."""
    if array.ndim == 2:
        return array
    return array.reshape(1, 3) if count == 1 else np.broadcast_to(array, (count, 3))


def _to_centre(to: str) -> bool:
    return to != "surface" if isinstance(to, str) and to in _ENDS else one_of("to", to, _ENDS) == "centre"


def _in_blocks(order: str) -> bool:
    return one_of("order", order, ("any", "blocks")) == "blocks"


