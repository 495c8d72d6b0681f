"""Distances and angles between centres of spheres."""

from __future__ import annotations

from typing import Any, Union

import numpy as np

from ._arrays import as_array
from ._checks import boolean
from ._errors import bad_argument, found
from ._spheres import Array, Spheres


def distance(spheres: Spheres, pairs: Any, *, periodic: bool = True) -> Union[float, Array]:
    """float64 (n,): the distance between the centres of each pair of spheres, positions (n, 2); a float of one pair (2,).

    periodic: by the shortest way through the spheres' cell, if they have one.

    >>> round(distance(read("demo"), (0, 5)), 3)
    2.317
    """
    return _measured(spheres, "pairs", pairs, 2, periodic)


def angle(spheres: Spheres, triples: Any, *, periodic: bool = True) -> Union[float, Array]:
    """float64 (n,): degrees, 0 to 180, at the second sphere of each triple of positions (n, 3); NaN where an arm has length 0.

    Otherwise as `distance`.
    """
    return _measured(spheres, "triples", triples, 3, periodic)


def dihedral(spheres: Spheres, quadruples: Any, *, periodic: bool = True) -> Union[float, Array]:
    """float64 (n,): degrees, above -180 to 180, between the planes of the first and the last three spheres of each row (n, 4): seen along the
    two in the middle, clockwise positive. NaN where three spheres in turn lie on a line.

    Otherwise as `distance`.
    """
    return _measured(spheres, "quadruples", quadruples, 4, periodic)


def _measured(spheres: Spheres, name: str, rows: Any, each: int, periodic: bool) -> Union[float, Array]:
    if not isinstance(spheres, Spheres):
        raise bad_argument("spheres", f"expected Spheres, found {found(spheres)}")
    asked = as_array(name, rows)
    if asked.ndim not in (1, 2) or asked.shape[-1] != each or asked.dtype.kind not in "iu":
        raise bad_argument(name, f"expected whole numbers of shape ({each},) or (n, {each}), found {asked.dtype} of shape {asked.shape}")
    if asked.size and not (0 <= asked.min() and asked.max() < len(spheres)):
        raise bad_argument(name, f"expected positions from 0 to {len(spheres) - 1}, found {asked.min()} to {asked.max()}")
    values: Array = spheres._core.measured(np.ascontiguousarray(np.atleast_2d(asked), np.int64), boolean("periodic", periodic))
    return float(values[0]) if asked.ndim == 1 else values
