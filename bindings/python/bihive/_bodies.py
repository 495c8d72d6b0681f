"""Ray queries on spheres and sticks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np

from . import _bihive
from ._adapt import spheres_of
from ._arrays import numbers, vectors, whole_numbers
from ._errors import bad_argument, found
from ._options import words_of
from ._progress import Bar, Progress
from ._spheres import Spheres
from ._tree import in_blocks_of, segments_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._types import Booleans, Floats, Ids

__all__ = ["AllBodyHits", "BodyHits", "BodyTree", "Sticks"]

Array = np.ndarray[Any, Any]
_KINDS = np.array(["nothing", "sphere", "stick"])


class Sticks:
    """Capsules and round cones: all balls between two ends, whose centres and radii change evenly from one to the other.

    a, b: shape (m, 3), the centres of the ends; or of Spheres (`between`) shape (m,) positions of spheres. radius: one number,
        (m,), or (m, 2) of both ends. Lengths as those of the spheres beside them. A radius may be 0 at one end.

    >>> sticks = Sticks([[0, 0, 0]], [[4, 0, 0]], radius=0.5)
    >>> len(sticks)
    1
    """

    def __init__(self, a: npt.ArrayLike, b: npt.ArrayLike, radius: npt.ArrayLike, *, between: Optional[Spheres] = None) -> None:
        if between is not None:
            if not isinstance(between, Spheres):
                raise bad_argument("between", f"expected Spheres, found {found(between)}")
            centres = np.asarray(between.xyz, dtype=np.float64)
            ends = [centres[whole_numbers(name, one, None, 0, len(centres) - 1)] for name, one in (("a", a), ("b", b))]
        else:
            ends = [np.asarray(vectors(name, one), dtype=np.float64) for name, one in (("a", a), ("b", b))]
        self.a, self.b = (np.ascontiguousarray(np.atleast_2d(end)) for end in ends)
        if self.a.shape != self.b.shape or self.a.ndim != 2:
            raise bad_argument("b", f"expected shape {self.a.shape}, found {self.b.shape}")
        given = np.asarray(numbers("radius", radius), dtype=np.float64)
        if given.ndim == 1 and given.shape == (len(self.a),):
            given = given[:, None]
        try:
            self.radius: Array = np.ascontiguousarray(np.broadcast_to(given, (len(self.a), 2)))
        except ValueError:
            raise bad_argument("radius", f"expected one number, shape ({len(self.a)},) or ({len(self.a)}, 2), found {given.shape}") from None

    def __len__(self) -> int:
        return len(self.a)

    def __repr__(self) -> str:
        return f"<bihive.Sticks: {len(self)}>"


class BodyHits(NamedTuple):
    """The nearest hit of each ray. t: float64, inf for none. kind: "sphere", "stick" or "nothing". id: int64, the position of
    the sphere or of the stick, -1 for none. along: float64, of a stick the position along its axis, 0 at the end a and 1 at b;
    NaN else."""

    t: Floats
    kind: Any
    id: Ids
    along: Floats


class AllBodyHits(NamedTuple):
    """Every hit of many rays: by ray, then by t; of equal ones spheres come first, then the smaller position. Arrays of one length.

    ray: int64, the ray's position (of rays of several axes: in C order). t, kind, id, along: as those of BodyHits. begin: int64
    (rays + 1): the hits of ray i are those from begin[i] to before begin[i + 1].
    """

    ray: Ids
    t: Floats
    kind: Any
    id: Ids
    along: Floats
    begin: Ids


class BodyTree:
    """Answers which spheres and sticks rays meet: as exact as Tree, for rays alone.

    spheres, engine, max_prims, max_depth, tune, threads, progress: as those of Tree. sticks: Sticks. Of equal distances the sphere counts, then
        the stick that comes first.

    >>> tree = BodyTree(Spheres([[0.0, 0, 0], [4, 0, 0]], radius=1), Sticks([[0, 0, 0]], [[4, 0, 0]], 0.25))
    >>> hits = tree.closest([[1, 9, 0], [0, 9, 0], [3, 9, 3]], [0, -1, 0])
    >>> hits.kind.tolist(), hits.id.tolist(), hits.along[0].tolist()
    (['stick', 'sphere', 'nothing'], [0, 0, -1], 0.25)
    """

    def __init__(
        self,
        spheres: Any,
        sticks: Sticks,
        *,
        engine: str = "auto",
        max_prims: Union[int, str, None] = None,
        max_depth: Union[int, str, None] = None,
        tune: bool = False,
        threads: int = 0,
        progress: Progress = None,
    ) -> None:
        _bihive.check_environment()
        if not isinstance(sticks, Sticks):
            raise bad_argument("sticks", f"expected Sticks, found {found(sticks)}")
        self._spheres: Spheres = spheres_of(spheres)
        self._sticks = sticks
        options = words_of({"engine": engine, "max_prims": max_prims, "max_depth": max_depth, "tune": tune, "threads": threads})
        with Bar(progress, "building") as bar:
            self._core = _bihive.build_body_tree(self._spheres._core, sticks.a, sticks.b, sticks.radius, options, bar)

    def __repr__(self) -> str:
        return f"<bihive.BodyTree of {len(self._spheres)} spheres and {len(self._sticks)} sticks>"

    def __reduce__(self) -> Any:
        raise TypeError("a tree cannot be pickled: pickle its spheres, and build it again")

    def closest(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        t_min: Optional[npt.ArrayLike] = None,
        t_max: Optional[npt.ArrayLike] = None,
        order: str = "any",
    ) -> BodyHits:
        """The nearest hit of each ray. Arguments as those of Tree.closest()."""
        rays, shape = segments_of(origins, directions, t_min, t_max)
        t, ids = self._core.closest((*rays, None, None), None, False, in_blocks_of(order))
        kind, number, along = self._core.bodies(rays[0], rays[1], t, ids, None)
        along[kind != 2] = np.nan
        return BodyHits(t.reshape(shape)[()], _KINDS[kind].reshape(shape)[()], number.reshape(shape)[()], along.reshape(shape)[()])

    def occluded(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        t_min: Optional[npt.ArrayLike] = None,
        t_max: Optional[npt.ArrayLike] = None,
        order: str = "any",
    ) -> Booleans:
        """Whether each ray hits anything: bool, with the shape of the rays. Arguments as those of closest()."""
        rays, shape = segments_of(origins, directions, t_min, t_max)
        made: Booleans = self._core.occluded((*rays, None, None), None, False, in_blocks_of(order)).reshape(shape)[()]
        return made

    def all_hits(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        *,
        t_min: Optional[npt.ArrayLike] = None,
        t_max: Optional[npt.ArrayLike] = None,
    ) -> AllBodyHits:
        """Every sphere and stick that each ray meets, once, where it enters (where it exits, if it starts inside). Arguments as those
        of closest().

        >>> tree = BodyTree(Spheres([[0.0, 0, 0]], radius=1), Sticks([[0, 0, 0]], [[4, 0, 0]], 0.25))
        >>> hits = tree.all_hits([[0, 9, 0], [3, 9, 0]], [0, -1, 0])
        >>> hits.kind.tolist(), hits.t.tolist(), hits.begin.tolist()
        (['sphere', 'stick', 'stick'], [8.0, 8.75, 8.75], [0, 2, 3])
        """
        rays, _ = segments_of(origins, directions, t_min, t_max)
        ray, t, ids, begin = self._core.all_hits((*rays, None, None), None, False)
        kind, number, along = self._core.bodies(rays[0], rays[1], t, ids, ray)
        along[kind != 2] = np.nan
        return AllBodyHits(ray, t, _KINDS[kind], number, along, begin)
