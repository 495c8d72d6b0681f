#!/usr/bin/env python3
"""Files as bihive reads them beside independent readers: ASE, MDAnalysis, Biopython, the package gsd, NumPy.

usage: readers_agree.py BIHIVE FOLDER... [--json FILE] [--list]

Looks at every file in the folders whose ending names a format that both can read: the first frame and the last. Prints
a table with a line for each format: files, atoms, the largest difference of a coordinate, and a line for each file
where something differs or only one of both reads it. Exit code 1 if a coordinate or a number of atoms differs.
Debian: python3-ase, python3-mdanalysis, python3-biopython, python3-gsd.
"""

import argparse
import collections
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import warnings

warnings.filterwarnings("ignore")
import numpy as np  # noqa: E402


class OtherReads(Exception):
    """The independent reader refuses the file."""


class Places:
    """What a reader found: an n x 3 array, and which of its rows bihive may leave out (alternate conformers).

    cell: of a crystal, where atoms may come in another order, in another copy of the cell, and several at one place.
    any_order: the reader sorts its atoms.
    """

    def __init__(self, xyz, optional=None, cell=None, any_order=False):
        self.xyz = np.asarray(xyz, dtype=float).reshape(-1, 3)
        self.cell, self.any_order = cell, any_order
        self.optional = np.zeros(len(self.xyz), bool) if optional is None else np.asarray(optional, bool)


def by_mdanalysis(path, frame, **options):
    import MDAnalysis

    universe = MDAnalysis.Universe(str(path), **options)
    universe.trajectory[frame]
    atoms = universe.atoms
    optional = [bool(each.strip()) for each in atoms.altLocs] if hasattr(atoms, "altLocs") else None
    return Places(atoms.positions, optional)


def by_ase(path, frame, **options):
    import ase.io

    atoms = ase.io.read(str(path), index=frame, **options)
    kind = options.get("format")
    return Places(atoms.positions, cell=np.array(atoms.cell) if kind == "cif" else None, any_order=kind == "lammps-dump-text")


def by_lines_of_pdb(path, frame):
    """MDAnalysis keeps the numbers in binary32; a PDB file's columns are read here as they stand."""
    models, rows, optional = [], [], []
    with open(path, errors="replace") as file:
        for line in file:
            if line.split()[:1] in (["MODEL"], ["ENDMDL"]) and rows:
                models.append((rows, optional))
                rows, optional = [], []
            if line.startswith(("ATOM  ", "HETATM")):
                rows.append([float(line[30:38]), float(line[38:46]), float(line[46:54])])
                optional.append(line[16] != " ")
    if rows:
        models.append((rows, optional))
    if not models:
        raise OtherReads("no atoms")
    rows, optional = models[frame]
    return Places(rows, optional)


def by_biopython_cif(path, frame):
    from Bio.PDB.MMCIF2Dict import MMCIF2Dict

    table = MMCIF2Dict(str(path))
    if "_atom_site.Cartn_x" not in table:
        raise OtherReads("no _atom_site.Cartn_x")
    xyz = np.array([table[f"_atom_site.Cartn_{axis}"] for axis in "xyz"], dtype=float).T
    models = table.get("_atom_site.pdbx_PDB_model_num", ["1"] * len(xyz))
    alternates = np.array([each not in (".", "?") for each in table.get("_atom_site.label_alt_id", ["."] * len(xyz))])
    names = list(dict.fromkeys(models))
    wanted = np.array(models) == names[frame]
    return Places(xyz[wanted], alternates[wanted])


def by_gsd(path, frame):
    import gsd.hoomd

    with gsd.hoomd.open(str(path), "rb") as trajectory:
        return Places(trajectory[frame].particles.position)


def by_numpy(path, frame):
    array = np.load(path)
    if array.ndim != 2 or array.shape[1] not in (3, 4) or array.dtype.kind not in "fiu":
        raise OtherReads("not n x 3 or n x 4 numbers")
    return Places(array[:, :3])


def ase_format(name):
    return lambda path, frame: by_ase(path, frame, format=name)


# By ending or whole name: the format, and the reader.
READERS = {
    ".pdb": ("PDB", by_lines_of_pdb),
    ".ent": ("PDB", by_lines_of_pdb),
    ".cif": ("CIF", None),  # by what is in it
    ".mmcif": ("mmCIF", by_biopython_cif),
    ".xyz": ("XYZ", by_ase),
    ".extxyz": ("extXYZ", ase_format("extxyz")),
    ".gro": ("GRO", by_mdanalysis),
    ".pqr": ("PQR", by_mdanalysis),
    ".mol2": ("MOL2", by_mdanalysis),
    ".sdf": ("SDF", ase_format("sdf")),
    ".mol": ("MOL", ase_format("sdf")),
    ".gsd": ("GSD", by_gsd),
    ".npy": ("NPY", by_numpy),
    ".lammpstrj": ("LAMMPS dump", lambda path, frame: by_ase(path, frame, format="lammps-dump-text")),
    ".dump": ("LAMMPS dump", lambda path, frame: by_ase(path, frame, format="lammps-dump-text")),
    "POSCAR": ("POSCAR", ase_format("vasp")),
    "CONTCAR": ("POSCAR", ase_format("vasp")),
    "XDATCAR": ("XDATCAR", ase_format("vasp-xdatcar")),
}


def reader_of(path):
    for key, (name, reader) in READERS.items():
        stem = path.name[:-3] if path.name.endswith(".gz") else path.name
        if (key.startswith(".") and stem.lower().endswith(key)) or stem.split(".")[0] == key or stem.endswith("." + key):
            if path.name.endswith(".gz"):
                return None
            if name == "CIF":
                with open(path, errors="replace") as file:
                    large = "_atom_site.Cartn_x" in file.read()
                return ("mmCIF", by_biopython_cif) if large else ("CIF of crystals", ase_format("cif"))
            return name, reader
    return None


class Bihive:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def run(self, *arguments):
        return subprocess.run([self.program, *arguments], capture_output=True, text=True, timeout=300)

    def frames(self, path):
        done = self.run("info", str(path), "--json")
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}"
        return json.loads(done.stdout)["frames"], ""

    def places(self, path, frame):
        out = os.path.join(self.folder, "out.npy")
        done = self.run("convert", str(path), "-o", out, "--frame", str(frame))
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1]
        return np.load(out)[:, :3].astype(float), ""


def farthest(ours, theirs):
    """How far the farthest place of either set is from its nearest in the other; in a crystal modulo the cell."""
    from scipy.spatial import cKDTree

    if theirs.cell is None and len(ours) != len(theirs.xyz):
        return None
    if theirs.cell is None:
        both = [ours, theirs.xyz]
        images = both
    else:
        inverse = np.linalg.inv(theirs.cell)
        both = [(xyz @ inverse) % 1.0 @ theirs.cell for xyz in (ours, theirs.xyz)]
        shifts = np.array([[a, b, c] for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]) @ theirs.cell
        images = [(xyz[:, None, :] + shifts[None]).reshape(-1, 3) for xyz in both]
    return max(float(cKDTree(images[1 - i]).query(both[i])[0].max()) for i in (0, 1))


# The same places in the same order, if both leave out what is optional; else as sets.
def difference(ours, theirs):
    """The largest difference of a coordinate, and how many atoms the other reader has more (alternates). None: no match."""
    if theirs.cell is not None or theirs.any_order:
        return farthest(ours, theirs), 0
    if len(ours) == len(theirs.xyz):
        return (float(np.abs(ours - theirs.xyz).max()) if len(ours) else 0.0), 0
    left_out = len(theirs.xyz) - len(ours)
    if left_out < 0 or left_out > theirs.optional.sum():
        return None, left_out
    # Walk through both: rows that are optional may be missing from ours.
    largest, at = 0.0, 0
    for row, optional in zip(theirs.xyz, theirs.optional):
        if at < len(ours) and np.abs(ours[at] - row).max() <= 1e-3:
            largest = max(largest, float(np.abs(ours[at] - row).max()))
            at += 1
        elif not optional:
            return None, left_out
    return (largest, left_out) if at == len(ours) else (None, left_out)


def files_in(folders):
    for folder in folders:
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if path.is_file() and not path.is_symlink() and path.stat().st_size > 0:
                yield path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bihive")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--json", help="the results in this file")
    parser.add_argument("--tolerance", type=float, default=2e-4,
                        help="of coordinates, relative to the largest one: readers keep binary32 (%(default)s)")
    parser.add_argument("--special", type=float, default=0.02, help="of atoms in crystals, in Angstrom (%(default)s)")
    arguments = parser.parse_args()

    tally = collections.defaultdict(lambda: collections.Counter())
    largest = collections.defaultdict(float)
    remarks, wrong = [], 0
    candidates = [(path, found) for path in files_in(arguments.folders) if (found := reader_of(path))]
    begin = time.time()
    with tempfile.TemporaryDirectory() as folder:
        bihive = Bihive(arguments.bihive, folder)
        for number, (path, (name, reader)) in enumerate(candidates):
            if sys.stderr.isatty():
                left = (time.time() - begin) / max(number, 1) * (len(candidates) - number)
                print(f"\r{number}/{len(candidates)} files, {left:.0f} s left   ", end="", file=sys.stderr)
            tally[name]["files"] += 1
            frames, why = bihive.frames(path)
            try:
                theirs = reader(path, 0)
            except Exception as error:  # each reader has its own
                theirs, other = None, f"{type(error).__name__}: {error}".splitlines()[0][:120]
            if frames is None and theirs is None:
                tally[name]["neither"] += 1
                continue
            if frames is None:
                tally[name]["only the other"] += 1
                remarks.append((name, str(path), "only the other reads it", why))
                continue
            if theirs is None:
                tally[name]["only bihive"] += 1
                remarks.append((name, str(path), "only bihive reads it", other))
                continue
            for frame in {0, frames - 1}:
                ours, why = bihive.places(path, frame)
                if frame != 0:
                    try:
                        theirs = reader(path, frame)
                    except Exception as error:
                        remarks.append((name, str(path), f"frame {frame}: only bihive reads it", str(error)[:120]))
                        continue
                if ours is None:
                    remarks.append((name, str(path), f"frame {frame}: only the other reads it", why))
                    continue
                found, left_out = difference(ours, theirs)
                scale = max(1.0, float(np.abs(theirs.xyz).max()) if len(theirs.xyz) else 1.0)
                # Images of a site on a special position with few digits: each program keeps another one of them.
                allowed = arguments.special if theirs.cell is not None else arguments.tolerance * scale
                if found is None or found > allowed:
                    wrong += 1
                    tally[name]["differ"] += 1
                    remarks.append((name, str(path), f"frame {frame} differs",
                                    f"bihive {len(ours)} atoms, the other {len(theirs.xyz)}, "
                                    + ("no match" if found is None else f"{found:g} apart")))
                    continue
                tally[name]["frames"] += 1
                tally[name]["atoms"] += len(ours)
                tally[name]["alternates left out"] += max(left_out, 0)
                largest[name] = max(largest[name], found / scale)
    if sys.stderr.isatty():
        print("\r" + " " * 60 + "\r", end="", file=sys.stderr)

    columns = ["files", "frames", "atoms", "alternates left out", "only bihive", "only the other", "neither", "differ"]
    print("| format | " + " | ".join(columns) + " | largest difference |")
    print("|---" * (len(columns) + 2) + "|")
    for name in sorted(tally):
        print(f"| {name} | " + " | ".join(str(tally[name][column]) for column in columns) + f" | {largest[name]:.1e} |")
    for name, path, what, why in remarks:
        print(f"{name}: {path}: {what}: {why}")
    if arguments.json:
        with open(arguments.json, "w") as file:
            json.dump({"tally": tally, "largest": largest, "remarks": remarks}, file, indent=1)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
