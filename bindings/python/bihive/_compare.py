"""Structures compared on the same spheres, and their parameters."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _bihive
from ._arrays import whole_numbers
from ._checks import one_of, several
from ._errors import bad_argument, found
from ._spheres import Spheres

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["compare", "tune"]

_MOST_COUNTS_OF_THREADS = 16


def compare(
    spheres: Spheres,
    *,
    structures: Optional[Sequence[str]] = None,
    rays: Optional[Sequence[str]] = None,
    count: int = 65536,
    threads: Union[int, Sequence[int]] = 1,
) -> dict[str, Any]:
    """Structures built on these spheres, asked the same rays: steps, times, memory, and whether all answers have the same bits.

    structures, rays: names (docs/comparison.md); None: all. count: primary and random rays, and points; the other rays start at hits of
    the primary ones, which come from the front. threads: of all queries, 0 as many as the machine runs at once; several numbers take
    turns. Clips and copies do not count.

    Returns what `bihive compare --json` prints, as docs/comparison.schema.json describes it. Other Python threads run meanwhile; Ctrl-C
    ends it within some seconds.

    >>> found = compare(read("demo"), structures=["bih", "kd-sah"], rays=["random"], count=256)
    >>> [one["name"] for one in found["structures"]], found["same_bits"]
    (['bih', 'kd-sah'], True)
    """
    _some(spheres)
    at_once = several("threads", threads, "numbers") if isinstance(threads, (list, tuple)) else [threads]
    if not 1 <= len(at_once) <= _MOST_COUNTS_OF_THREADS:
        raise bad_argument("threads", f"expected 1 to {_MOST_COUNTS_OF_THREADS} numbers, found {found(threads)}")
    made = _bihive.compare(
        spheres._core,
        _names("structures", structures, _bihive.structure_names()),
        _names("rays", rays, _bihive.query_kind_names()),
        int(whole_numbers("count", count, 1, 1, 1 << 30)[0]),
        [int(whole_numbers("threads", one, 1, 0, 4096)[0]) for one in at_once],
    )
    comparison: dict[str, Any] = json.loads(made)
    return comparison


def tune(
    spheres: Spheres,
    *,
    structure: str = "wide",
    rays: Optional[Sequence[str]] = None,
    count: int = 4096,
    threads: int = 1,
) -> dict[str, Any]:
    """The limits of the tree with which queries of these spheres are fastest on this machine, searched for about ten seconds.

    structure: of those that take ``max-prims`` (docs/comparison.md). rays, count: the queries, as in `compare`. threads: of queries and
    builds, 0 as many as the machine runs at once.

    Returns what `bihive tune --json` prints, as docs/tuning.schema.json describes it: ``best["parameters"]`` has the limits to pass to
    Tree or render as max_prims and max_depth, empty where the tree's own choice is as good; ``gain`` says how many times as fast they are.

    >>> found = tune(read("four-spheres"), rays=["random"], count=64)
    >>> found["structure"], found["gain"] >= 1
    ('wide', True)
    """
    _some(spheres)
    made = _bihive.tune(
        spheres._core,
        one_of("structure", structure, _bihive.tuned_structure_names()),
        _names("rays", rays, _bihive.query_kind_names()),
        int(whole_numbers("count", count, 1, 1, 1 << 30)[0]),
        int(whole_numbers("threads", threads, 1, 0, 4096)[0]),
    )
    tuning: dict[str, Any] = json.loads(made)
    return tuning


def _some(spheres: Spheres) -> None:
    """Refuses what is no set of spheres, or an empty one."""
    if not isinstance(spheres, Spheres):
        raise bad_argument("spheres", f"expected Spheres, found {found(spheres)}")
    if len(spheres) == 0:
        raise bad_argument("spheres", "there is no sphere")


def _names(argument: str, names: Optional[Sequence[str]], known: list[str]) -> list[str]:
    """Each of the names once; none: all."""
    if names is None:
        return []
    chosen = [one_of(argument, name, known) for name in several(argument, names, "names")]
    if not chosen:
        raise bad_argument(argument, "there is no name")
    if len(set(chosen)) < len(chosen):
        raise bad_argument(argument, f"a name stands twice in {found(names)}")
    return chosen
