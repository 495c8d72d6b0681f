"""Trees for queries about rays and points."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _bihive
from ._adapt import spheres_of
from ._arrays import in_a_row, numbers, one_each, vectors, whole_numbers
from ._checks import boolean, one_of
from ._errors import Error, InputError, bad_argument, found
from ._hits import ClosestHits, Hits, Near, Pairs, RayQuery
from ._options import words_of
from ._progress import Bar, Progress
from ._select import chosen
from ._spheres import Spheres

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._types import Booleans, Floats, Ids

__all__ = ["Tree"]

Array = np.ndarray[Any, Any]
Shape = tuple[int, ...]
# Origins, directions, t_min, t_max.
Segments = tuple[Array, Array, Optional[Array], Optional[Array]]
# The same, leaves, inside.
Rays = tuple[Array, Array, Optional[Array], Optional[Array], Optional[Array], Optional[Array]]
_ENDS = ("surface", "centre")  # of a distance
_FLOAT64 = np.dtype(np.float64)  # this machine's byte order: one object
_PLENTY = 2**28  # bytes: smaller answers fit into every machine


class Tree:
    """Answers which spheres rays meet. Exact: float64 decides, without an epsilon, and the answers are those of testing every
    sphere, bit for bit.

    spheres: Spheres, or what render() takes besides paths. select: only these spheres count (an expression, a mask of shape
        (n,), or positions); ids stay positions in all.
    periodic: queries about points consider all periodic images of the spheres, where these have a cell. An image is
        returned as the position of its sphere, which may thus occur several times, and the distance to the image. Rays meet
        the spheres alone, as in pictures, unless the query has periodic=True. False: no images.
    engine: "auto" (wide), "wide", "reference", "brute" or "wide-brute". max_prims, max_depth: limits of the tree.
    tune: searches those that suit these spheres and rays anywhere, in about ten seconds, as `bihive tune --rays random` does.
    threads: of building and queries; 0: as many as the machine runs at once.
    progress: of building, as of render(). Ctrl-C ends it.

    >>> import numpy as np
    >>> tree = Tree(Spheres(np.array([[0.0, 0, 0], [5, 0, 0]]), radius=1))
    >>> t, i = tree.closest([[-10, 0, 0], [0, 9, 0]], [1, 0, 0])
    >>> t.tolist(), i.tolist()
    ([9.0, inf], [0, -1])
    >>> tree.closest([-10, 0.6, 0], [1, 0, 0]).normals().round(2).tolist()
    [-0.8, 0.6, 0.0]
    >>> tree.pairs(3).distance.tolist()  # between the surfaces
    [3.0]
    >>> tree.all_hits([-10, 0, 0], [1, 0, 0]).t.tolist()
    [9.0, 14.0]
    >>> box = Tree(Spheres([[0.5, 0, 0], [9.5, 0, 0]], radius=0.1, cell=[10, 10, 10]))
    >>> box.within([0.5, 0, 0], 1.5, to="centre").id.tolist()
    [0, 1]
    >>> int(box.closest([5, 0, 0], [1, 0, 0], t_min=5, periodic=True).id)  # the first sphere again, at 10.5
    0
    """

    def __init__(
        self,
        spheres: Any,
        *,
        select: Union[str, npt.ArrayLike, None] = None,
        periodic: bool = True,
        engine: str = "auto",
        max_prims: Union[int, str, None] = None,
        max_depth: Union[int, str, None] = None,
        tune: bool = False,
        threads: int = 0,
        progress: Progress = None,
    ) -> None:
        _bihive.check_environment()
        self._spheres: Spheres = spheres_of(spheres)
        self._ids: Optional[Array] = None
        images = boolean("periodic", periodic)
        if select is not None:
            self._ids = np.flatnonzero(chosen("select", select, self._spheres._core, images))
        self._options = words_of({"engine": engine, "max_prims": max_prims, "max_depth": max_depth, "tune": tune, "threads": threads})
        self._sees_images = images
        self._masked: Optional[tuple[bytes, Tree]] = None
        self._core = self._built(self._spheres, progress)

    def _built(self, spheres: Spheres, progress: Progress) -> _bihive.Tree:
        part = None if self._ids is None else self._ids.tolist()
        with Bar(progress, "building") as bar:
            return _bihive.build_tree(spheres._core, part, self._sees_images, self._options, bar)

    def _counting(self, mask: Any) -> Tree:
        """The tree of the spheres of this one that count, which is kept for the next query with the same mask."""
        counting = chosen("mask", mask, self._spheres._core, self._sees_images)
        if self._ids is not None:
            counting[np.setdiff1d(np.arange(len(counting)), self._ids)] = False
        key, kept = np.packbits(counting).tobytes(), self._masked
        if kept is None or kept[0] != key:
            tree = object.__new__(Tree)
            tree.__dict__.update(self.__dict__)
            tree._ids, tree._masked = np.flatnonzero(counting), None
            tree._options = [word for word in self._options if word != "--tune"]  # this query should not wait for a search
            tree._core = tree._built(self._spheres, False)
            self._masked = kept = key, tree
        return kept[1]

    def update(self, xyz: npt.ArrayLike, radius: Optional[npt.ArrayLike] = None, *, progress: Progress = None) -> None:
        """Moves the spheres, whose attributes stay, and builds the tree anew. Queries that run meanwhile keep the old one, and so
        does everybody if Ctrl-C ends the building.

        xyz: shape (n, 3), of all spheres; radius: one number, or shape (n,); left out: as before. With `select` the same
        positions count as before. progress: as of render().

        >>> tree = Tree(Spheres([[0.0, 0, 0]], radius=1))
        >>> tree.update([[4.0, 0, 0]])
        >>> float(tree.closest([0, 0, 0], [1, 0, 0]).t)
        3.0
        """
        spheres = self._spheres.moved(xyz, radius)
        self._core, self._spheres, self._masked = self._built(spheres, progress), spheres, None

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
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        t_min: Optional[npt.ArrayLike] = None,
        t_max: Optional[npt.ArrayLike] = None,
        leaves: Optional[npt.ArrayLike] = None,
        inside: Optional[npt.ArrayLike] = None,
        periodic: bool = False,
        mask: Union[str, npt.ArrayLike, None] = None,
        exclude: Optional[npt.ArrayLike] = None,
        order: str = "any",
    ) -> ClosestHits:
        """The nearest hit of each ray: t, float64, inf for none; and the sphere's position, int64, -1 for none. Of (n, 3) rays
        arrays (n,), of a single ray two numbers. The answer also knows positions(), normals(), exits() and derivatives().

        origins, directions: shape (..., 3), as (n, 3), or (3,) for one that all rays share; they broadcast. Directions may have
            any length above 0, and t counts in lengths of them: the hit is at origin + t direction. Rays are kept in
            float32: float64 is rounded once, relative to the spheres' origin if they are far from 0. A ray with NaN, an
            infinity (or beyond 3.4e38), or a direction of 0 hits nothing.
        t_min, t_max: the part of the ray that counts, both ends with it: one number, or one for each ray; 0 and inf.
        leaves: the sphere on which a ray starts, int64, one or one for each ray; -1: none. It is not met again, or with
            inside=True (one, or one for each ray) at its far side alone. Of its images, the one whose surface is nearest to
            the origin.
        periodic: rays meet the images of the spheres too, as positions of their spheres.
        mask: only these spheres count: an expression, a mask of shape (n,), or positions. The first query with a mask builds a
            tree of them, which is kept until another mask comes, so that rays are as fast as those of Tree(..., select=mask).
        exclude: a sphere that does not count, one or one for each ray; -1: none. Of its images, the one whose surface is
            nearest to the origin. Rays that would hit it are traced twice.
        order: "blocks" if each 64 neighbours are close to each other, as 8 x 8 pixels are: faster. The answers do not change.

        Other Python threads run meanwhile, and Ctrl-C ends it. Error: UsageError for a periodic ray that passes 16,384
        cells without a hit or a t_max.
        """
        if mask is not None:
            return self._counting(mask).closest(
                origins, directions, t_min=t_min, t_max=t_max, leaves=leaves, inside=inside, periodic=periodic, exclude=exclude, order=order
            )
        rays, shape = self._rays(origins, directions, t_min, t_max, leaves, inside)
        images, in_blocks = self._images(periodic), in_blocks_of(order)
        own = self._own_of_rays(exclude, shape)
        core = self._core
        try:
            t, ids = core.closest(rays, own if images else None, images, in_blocks)
            if own is not None and not images:
                _pass_over(core, rays, own, t, ids)
        except InputError as error:
            raise _of_t_max(error) from None
        hits = ClosestHits(t.reshape(shape)[()], self._positions(ids).reshape(shape)[()])
        hits._query = RayQuery(core, self._in_part, rays[:2], images)
        return hits

    def occluded(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        t_min: Optional[npt.ArrayLike] = None,
        t_max: Optional[npt.ArrayLike] = None,
        leaves: Optional[npt.ArrayLike] = None,
        inside: Optional[npt.ArrayLike] = None,
        periodic: bool = False,
        mask: Union[str, npt.ArrayLike, None] = None,
        exclude: Optional[npt.ArrayLike] = None,
        order: str = "any",
    ) -> Booleans:
        """Whether each ray hits anything: bool, with the shape of the rays. Arguments as those of closest(); faster than that."""
        if mask is not None:
            return self._counting(mask).occluded(
                origins, directions, t_min=t_min, t_max=t_max, leaves=leaves, inside=inside, periodic=periodic, exclude=exclude, order=order
            )
        images, in_blocks = self._images(periodic), in_blocks_of(order)
        if exclude is not None and not images:
            hits = self.closest(origins, directions, t_min=t_min, t_max=t_max, leaves=leaves, inside=inside, exclude=exclude, order=order)
            return np.asarray(hits.id >= 0)[()]
        rays, shape = self._rays(origins, directions, t_min, t_max, leaves, inside)
        own = self._own_of_rays(exclude, shape)
        try:
            hidden = self._core.occluded(rays, own, images, in_blocks)
        except InputError as error:
            raise _of_t_max(error) from None
        made: Booleans = hidden.reshape(shape)[()]
        return made

    def all_hits(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        t_min: Optional[npt.ArrayLike] = None,
        t_max: Optional[npt.ArrayLike] = None,
        leaves: Optional[npt.ArrayLike] = None,
        inside: Optional[npt.ArrayLike] = None,
        periodic: bool = False,
        mask: Union[str, npt.ArrayLike, None] = None,
        exclude: Optional[npt.ArrayLike] = None,
        k: Optional[int] = None,
    ) -> Hits:
        """Every sphere that each ray meets, where it enters. Arguments as those of closest(); periodic rays need t_max.

        k: of each ray the first k hits alone. The answer also knows positions(), normals(), exits() and derivatives().
        """
        if mask is not None:
            return self._counting(mask).all_hits(
                origins, directions, t_min=t_min, t_max=t_max, leaves=leaves, inside=inside, periodic=periodic, exclude=exclude, k=k
            )
        rays, shape = self._rays(origins, directions, t_min, t_max, leaves, inside)
        images = self._images(periodic)
        own = self._own_of_rays(exclude, shape)
        most = None if k is None else _count_of(k)
        core = self._core
        try:
            ray, t, ids, begin = core.all_hits(rays, own if images else None, images)
        except InputError as error:
            raise _of_t_max(error) from None
        if own is not None and not images:
            others = ids != own[ray]
            ray, t, ids = ray[others], t[others], ids[others]
            begin = np.searchsorted(ray, np.arange(rays[0].shape[0] + 1))
        if most is not None:
            first = np.arange(len(ray)) - begin[ray] < most
            ray, t, ids = ray[first], t[first], ids[first]
            begin = np.concatenate([[0], np.cumsum(np.minimum(np.diff(begin), most))])
        hits = Hits(ray, t, self._positions(ids), begin)
        hits._query = RayQuery(core, self._in_part, rays[:2], images)
        return hits

    def nearest(
        self,
        points: npt.ArrayLike,
        k: int = 1,
        *,
        within: Optional[float] = None,
        to: str = "surface",
        mask: Union[str, npt.ArrayLike, None] = None,
        exclude: Optional[npt.ArrayLike] = None,
    ) -> tuple[Floats, Ids]:
        """The k nearest spheres of each point: distances, float64, inf where there are fewer; and positions, int64, -1 there.

        points: shape (..., 3), as (n, 3), or (3,) for one; float64 decides. Finite, and at most 3.4e38 in size.
        k: at least 1. For k = 1 both answers have the shape of the points, (n,), and are numbers for a single point; else one
            axis more, (n, k), ordered by distance, then position.
        within: only spheres at a distance of at most this; None: any.
        to: "surface" (below 0 inside a sphere), or "centre".
        mask: only these spheres count: an expression, a mask of shape (n,), or positions.
        exclude: a sphere that does not count, one for each point: the point's own; -1: none. Of its images, the nearest.

        Other Python threads run meanwhile, and Ctrl-C ends it. Error: InputError for a point that is not finite.

        >>> tree = Tree(Spheres([[0.0, 0, 0], [5, 0, 0]], radius=1))
        >>> distance, i = tree.nearest([[2, 0, 0], [5, 0, 0.5]])
        >>> distance.tolist(), i.tolist()
        ([1.0, -0.5], [0, 1])
        >>> tree.nearest(tree.spheres.xyz, to="centre", exclude=[0, 1])[1].tolist()  # the neighbour of each sphere
        [1, 0]
        """
        wanted = _count_of(k)
        where, shape = _points(points)
        if 16 * where.shape[0] * wanted > _PLENTY and 16 * where.shape[0] * wanted > _memory():
            raise bad_argument("k", f"the answers for {where.shape[0]} points are larger than the memory, found {found(k)}")
        most = np.inf if within is None else float(one_each("within", within, 1)[0])
        if np.isnan(most):
            raise bad_argument("within", "expected a number, found NaN")
        own = self._own(exclude, shape)
        try:
            distance, ids = self._core.nearest(where, wanted, most, self._mask(mask), own, _to_centre(to))
        except InputError:
            _check_points(where)
            raise
        ids = self._positions(ids)
        if wanted == 1:
            return distance.reshape(shape)[()], ids.reshape(shape)[()]
        return distance.reshape(*shape, wanted), ids.reshape(*shape, wanted)

    def within(self, points: npt.ArrayLike, limits: npt.ArrayLike, *, to: str = "surface", mask: Union[str, npt.ArrayLike, None] = None, exclude: Optional[npt.ArrayLike] = None) -> Near:
        """Every sphere at a distance of at most `limits` from each point: one number, or one for each point.

        points, to, mask, exclude: as those of nearest(). To the surface, a limit of 0 gives the spheres that contain the point,
        and r those that share a point with the ball of radius r around it.
        """
        where, shape = _points(points)
        return self._within("limits", where, _limits(limits, shape), to, mask, self._own(exclude, shape))

    def count_within(self, points: npt.ArrayLike, limits: npt.ArrayLike, *, to: str = "surface", mask: Union[str, npt.ArrayLike, None] = None, exclude: Optional[npt.ArrayLike] = None) -> Ids:
        """The number of these spheres: int64, with the shape of the points. Arguments as those of within(), whose lists it does
        not keep.

        >>> tree = Tree(Spheres([[0.0, 0, 0], [5, 0, 0]], radius=1))
        >>> tree.count_within([[0, 0, 0], [2.5, 0, 0]], 1.5).tolist()
        [1, 2]
        """
        where, shape = _points(points)
        most, own = _limits(limits, shape), self._own(exclude, shape)
        try:
            counts = self._core.count_within(where, most, self._mask(mask), own, _to_centre(to))
        except InputError as error:
            raise self._of_points("limits", where, error) from None
        made: Ids = counts.reshape(shape)[()]
        return made

    def contains(self, points: npt.ArrayLike, *, mask: Union[str, npt.ArrayLike, None] = None, exclude: Optional[npt.ArrayLike] = None) -> Near:
        """Every sphere that contains each point, its surface included. Arguments as those of nearest().

        >>> tree = Tree(Spheres([[0.0, 0, 0], [1, 0, 0]], radius=1))
        >>> tree.contains([[0.5, 0, 0], [2, 0, 0], [3, 0, 0]]).counts.tolist()
        [2, 1, 0]
        """
        return self.within(points, 0.0, mask=mask, exclude=exclude)

    def overlaps(self, points: npt.ArrayLike, radii: npt.ArrayLike, *, mask: Union[str, npt.ArrayLike, None] = None, exclude: Optional[npt.ArrayLike] = None) -> Near:
        """Every sphere that shares a point with the ball of radius `radii` (one number, or one for each point) around each point.

        points, mask, exclude: as those of nearest().
        """
        where, shape = _points(points)
        sizes = in_a_row("radii", numbers("radii", radii), shape)
        if sizes.size > 0 and not (np.isfinite(sizes).all() and (sizes >= 0).all()):
            raise bad_argument("radii", "expected finite numbers of at least 0")
        return self._within("radii", where, np.ascontiguousarray(sizes, dtype=np.float64), "surface", mask, self._own(exclude, shape))

    def pairs(self, reach: float, *, to: str = "surface", mask: Union[str, npt.ArrayLike, None] = None) -> Pairs:
        """Every pair of spheres at a distance of at most `reach`, once: between their surfaces (0: those that touch or overlap),
        or with to="centre" between their centres.

        mask: only these spheres count: an expression, a mask of shape (n,), or positions. With a
        periodic tree, images count: those of other spheres and of the sphere itself.

        >>> tree = Tree(Spheres([[0.0, 0, 0], [1.5, 0, 0], [9, 0, 0]], radius=1))
        >>> pairs = tree.pairs(0)
        >>> pairs.first.tolist(), pairs.second.tolist(), pairs.distance.tolist()
        ([0], [1], [-0.5])
        >>> tree.pairs(7.5, to="centre").second.tolist()
        [1, 2]
        """
        most = float(one_each("reach", reach, 1)[0])
        if np.isnan(most):
            raise bad_argument("reach", "expected a number, found NaN")
        try:
            first, second, distance = self._core.pairs(most, self._mask(mask), _to_centre(to))
        except InputError as error:
            raise bad_argument("reach", str(error)) from None
        return Pairs(self._positions(first), self._positions(second), distance)

    def _within(self, name: str, where: Array, most: Array, to: str, mask: Any, own: Optional[Array]) -> Near:
        try:
            begin, ids, distance = self._core.within(where, most, self._mask(mask), own, _to_centre(to))
        except InputError as error:
            raise self._of_points(name, where, error) from None
        return Near(begin, self._positions(ids), distance)

    def _of_points(self, name: str, where: Array, error: InputError) -> Error:
        _check_points(where)
        # Each image of a sphere is found, and there may be too many.
        return bad_argument(name, str(error)) if self.periodic and "images" in str(error) else error

    def _mask(self, mask: Any) -> Optional[Array]:
        """A byte for each sphere of the tree; None: all count."""
        if mask is None:
            return None
        counting = chosen("mask", mask, self._spheres._core, self._sees_images)
        return np.ascontiguousarray(counting if self._ids is None else counting[self._ids]).view(np.uint8)

    def _own(self, exclude: Any, shape: Shape) -> Optional[Array]:
        """The sphere of the tree that does not count for each point; None: all count."""
        if exclude is None:
            return None
        given = whole_numbers("exclude", exclude, None, -1, max(len(self._spheres) - 1, 0))
        return np.ascontiguousarray(self._in_part(in_a_row("exclude", given, shape).astype(np.int64)))

    def _own_of_rays(self, exclude: Any, shape: Shape) -> Optional[Array]:
        own = self._own(exclude, shape)
        # A sphere outside of the tree is hit by no ray, and neither is this number.
        return None if own is None else np.where(own >= 0, own, -2)

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
    ) -> tuple[Rays, Shape]:
        """The rays one after the other, and their shape."""
        rays, shape = segments_of(origins, directions, t_min, t_max)
        left = None
        if leaves is not None:
            given = whole_numbers("leaves", leaves, None, -2, max(len(self._spheres) - 1, 0))
            left = np.ascontiguousarray(self._in_part(in_a_row("leaves", given, shape).astype(np.int64)), dtype=np.int64)
        into = None
        if inside is not None:
            into = np.ascontiguousarray(in_a_row("inside", numbers("inside", inside), shape) != 0).view(np.uint8)
        return (*rays, left, into), shape


def segments_of(origins: Any, directions: Any, t_min: Any, t_max: Any) -> tuple[Segments, Shape]:
    """Rays that leave nothing, one after the other, and their shape."""
    origin = vectors("origins", origins)
    direction = vectors("directions", directions)
    shape = origin.shape[:-1]
    if direction.shape != origin.shape:  # it takes longer than a ray
        try:
            shape = np.broadcast_shapes(shape, direction.shape[:-1])
        except ValueError:
            raise bad_argument(
                "directions", f"expected as many as origins, found shapes {origin.shape} and {direction.shape}"
            ) from None
        origin, direction = (np.broadcast_to(one, (*shape, 3)) for one in (origin, direction))
    segments = (
        origin.reshape(-1, 3),
        direction.reshape(-1, 3),
        None if t_min is None else in_a_row("t_min", numbers("t_min", t_min), shape),
        None if t_max is None else in_a_row("t_max", numbers("t_max", t_max), shape),
    )
    return segments, shape


def _of_t_max(error: InputError) -> Error:
    """Names the argument when a ray of a periodic tree has no end."""
    return bad_argument("t_max", str(error)) if "without an end" in str(error) else error


def _memory() -> int:
    """Of this machine, in bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _count_of(k: Any) -> int:
    if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
        raise bad_argument("k", f"expected a whole number of at least 1, found {found(k)}")
    return int(k)


def _limits(limits: Any, shape: Shape) -> Array:
    """float64, for each point."""
    if shape == () and type(limits) is float and limits == limits:
        return np.array((limits,))
    given = numbers("limits", limits)
    most = in_a_row("limits", given, shape)
    if given != given if given.ndim == 0 else np.isnan(given).any():
        raise bad_argument("limits", "expected numbers, found NaN")
    return np.ascontiguousarray(most, dtype=np.float64)


def _pass_over(core: _bihive.Tree, rays: Rays, own: Array, t: Array, ids: Array) -> None:
    """Replaces hits of the sphere that does not count by the next ones."""
    again = np.flatnonzero(ids == own)
    if again.size == 0:
        return
    t_min, t_max, leaves, inside = (None if one is None else np.ascontiguousarray(one[again]) for one in rays[2:])
    ray, t_of_all, id_of_all, _ = core.all_hits((rays[0][again], rays[1][again], t_min, t_max, leaves, inside), None, False)
    others = id_of_all != own[again][ray]
    hit, first = np.unique(ray[others], return_index=True)
    t[again], ids[again] = np.inf, -1
    t[again[hit]], ids[again[hit]] = t_of_all[others][first], id_of_all[others][first]


def _points(points: Any) -> tuple[Array, Shape]:
    """float64 (n, 3), row by row, and the points' shape. The compiled part refuses numbers that are none; _check_points() then
    says which."""
    # Checks dominate the time of a single query, so an array that is already float64 in C order skips them.
    if type(points) is np.ndarray and points.dtype is _FLOAT64 and points.shape[-1:] == (3,) and points.flags.c_contiguous:
        return points.reshape(-1, 3), points.shape[:-1]
    array = vectors("points", points)
    return np.ascontiguousarray(array.reshape(-1, 3), dtype=np.float64), array.shape[:-1]


def _check_points(points: Array) -> None:
    bad = ~(np.abs(points) <= np.finfo(np.float32).max).all(axis=1)
    if bad.any():
        first = int(bad.argmax())
        message = f"points: point {first} must be finite and at most 3.4e38 in size, found {points[first].tolist()}"
        raise InputError(message, argument="points") from None


def _to_centre(to: str) -> bool:
    return to != "surface" if isinstance(to, str) and to in _ENDS else one_of("to", to, _ENDS) == "centre"


def in_blocks_of(order: str) -> bool:
    return one_of("order", order, ("any", "blocks")) == "blocks"


