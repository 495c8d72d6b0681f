"""Atoms of other packages as Spheres, recognised by their attributes: none of these packages is imported."""

from __future__ import annotations

import os
import warnings
from typing import Any, Optional

import numpy as np

from . import _bihive
from ._errors import InputWarning, bad_argument, found
from ._spheres import Spheres, check_readable, read

__all__ = ["spheres_of"]

# Attributes of an AtomGroup of MDAnalysis, and the names that selections have for them.
_OF_MDANALYSIS = {
    "names": "name",
    "resnames": "resname",
    "resids": "resid",
    "chainIDs": "chain",
    "tempfactors": "b_factor",
    "occupancies": "occupancy",
    "charges": "charge",
    "masses": "mass",
}


def is_universe(thing: Any) -> bool:
    """Whether it has atoms and a trajectory, as a Universe of MDAnalysis."""
    return hasattr(thing, "trajectory") and hasattr(thing, "atoms") and not hasattr(thing, "positions")


def is_atom_group(thing: Any) -> bool:
    return hasattr(thing, "positions") and hasattr(thing, "universe")


def is_ase(thing: Any) -> bool:
    return callable(getattr(thing, "get_positions", None)) and callable(getattr(thing, "get_atomic_numbers", None))


def spheres_of(thing: Any, name: str = "spheres") -> Spheres:
    """Spheres as they are; those of a path, of ASE's Atoms, of MDAnalysis' Universe or AtomGroup."""
    if isinstance(thing, Spheres):
        return thing
    if isinstance(thing, (str, os.PathLike)):
        return read(check_readable(thing, name))
    if is_universe(thing):
        thing = thing.atoms
    if is_atom_group(thing):
        return _of_atom_group(thing)
    if is_ase(thing):
        return _of_ase(thing)
    kind = f"{type(thing).__module__}.{type(thing).__qualname__}"
    raise bad_argument(
        name,
        f"expected Spheres, atoms of ASE or MDAnalysis, or a path, found {found(thing) if kind.startswith('builtins') else kind}",
        "make Spheres(xyz, radius=...) of arrays",
    )


def _cell_of(vectors: Any) -> Optional[np.ndarray[Any, Any]]:
    array = np.asarray(vectors, dtype=np.float64)
    return array if array.shape == (3, 3) and bool(np.isfinite(array).all()) and bool(array.any()) else None


def _of_ase(atoms: Any) -> Spheres:
    columns: dict[str, Any] = {}
    for name, values in getattr(atoms, "arrays", {}).items():
        if name not in ("numbers", "positions") and np.ndim(values) == 1:
            columns["charge" if name == "initial_charges" else name] = values
    return Spheres(
        atoms.get_positions(),
        element=atoms.get_atomic_numbers(),
        cell=_cell_of(atoms.get_cell()) if hasattr(atoms, "get_cell") else None,
        periodic=[bool(one) for one in atoms.get_pbc()] if hasattr(atoms, "get_pbc") else True,
        name="atoms",
        columns=columns,
    )


def _attribute(group: Any, name: str) -> Any:
    """An attribute that a topology may lack; MDAnalysis then raises its own exceptions."""
    try:
        return getattr(group, name)
    except (AttributeError, ValueError, TypeError):
        return None
    except Exception as error:
        if type(error).__name__ == "NoDataError":
            return None
        raise


def _elements_of(group: Any) -> Optional[list[str]]:
    """Symbols, as the topology states them, else its types if all of them are symbols."""
    for name in ("elements", "types"):
        values = _attribute(group, name)
        if values is None:
            continue
        symbols = [str(value) for value in values]
        if all(_bihive.atomic_number(symbol) > 0 for symbol in set(symbols)):
            return symbols
    return None


# Standard atomic weights, rounded, of the elements in molecular simulations; no two are nearer than twice the
# tolerance.
_WEIGHTS = {
    "H": 1.008, "He": 4.0026, "Li": 6.94, "B": 10.81, "C": 12.011, "N": 14.007, "O": 15.999, "F": 18.998,
    "Ne": 20.180, "Na": 22.990, "Mg": 24.305, "Al": 26.982, "Si": 28.085, "P": 30.974, "S": 32.06, "Cl": 35.45,
    "K": 39.098, "Ca": 40.078, "Mn": 54.938, "Fe": 55.845, "Co": 58.933, "Ni": 58.693, "Cu": 63.546, "Zn": 65.38,
    "Se": 78.971, "Br": 79.904, "I": 126.90,
}  # fmt: skip
_TOLERANCE = 0.1


def _elements_by_mass(group: Any) -> Optional[list[str]]:
    """Symbols by the masses, where each is that of one element: files of CHARMM and AMBER state masses alone."""
    masses = _attribute(group, "masses")
    if masses is None or len(masses) == 0:
        return None
    symbols: dict[float, str] = {}
    for mass in set(np.asarray(masses, dtype=float).tolist()):
        near = [symbol for symbol, weight in _WEIGHTS.items() if abs(mass - weight) <= _TOLERANCE]
        if len(near) != 1:
            return None
        symbols[mass] = near[0]
    warnings.warn(InputWarning("the atoms state no elements; these are by their masses"), stacklevel=2)
    return [symbols[mass] for mass in np.asarray(masses, dtype=float).tolist()]


def _of_atom_group(group: Any) -> Spheres:
    columns: dict[str, Any] = {}
    for name, own in _OF_MDANALYSIS.items():
        values = _attribute(group, name)
        if values is not None and len(values) == len(group.positions):
            columns[own] = [str(one) for one in values] if np.asarray(values).dtype.kind in "USO" else values
    for name, axes in (("velocities", "vx vy vz"), ("forces", "fx fy fz")):
        vectors = _attribute(group, name)
        if vectors is not None and np.shape(vectors) == (len(group.positions), 3):
            columns.update(zip(axes.split(), np.asarray(vectors, dtype=np.float64).T))
    elements = _elements_of(group)
    radii = _attribute(group, "radii")
    if elements is None and radii is None:
        elements = _elements_by_mass(group)
    if elements is None and radii is None:
        raise bad_argument(
            "spheres",
            "the atoms have neither elements nor radii",
            "add them to the topology, or make Spheres(atoms.positions, radius=...)",
        )
    vectors = _attribute(_attribute(group, "ts") or group.universe.trajectory.ts, "triclinic_dimensions")
    return Spheres(
        group.positions,
        radii,
        element=elements,
        cell=None if vectors is None else _cell_of(vectors),
        name="atoms",
        columns=columns,
    )
