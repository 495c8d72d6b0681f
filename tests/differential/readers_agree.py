#!/usr/bin/env python3
"""Files as bihive reads them beside independent readers: ASE, MDAnalysis, Biopython, gsd, NumPy, netCDF4, h5py, PCL, VTK.

usage: readers_agree.py BIHIVE FOLDER... [--json FILE] [--format NAME...]

Looks at every file in the folders whose ending names a format that both can read: the first frame and the last. Prints
a table with a line for each format: files, atoms, the largest difference of a coordinate, and a line for each file
where something differs or only one of both reads it. Exit code 1 if a coordinate or a number of atoms differs.
Debian: python3-ase, python3-mdanalysis, python3-biopython, python3-gsd, python3-netcdf4, python3-h5py, python3-pcl, python3-vtk9.
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
    """

    def __init__(self, xyz, optional=None, cell=None):
        self.xyz = np.asarray(xyz, dtype=float).reshape(-1, 3)
        self.cell = cell
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
    return Places(atoms.positions, cell=np.array(atoms.cell) if options.get("format") == "cif" else None)


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


def by_trajectory_reader(module, name):
    """Places alone, as MDAnalysis reads them: bihive needs a file of as many atoms beside it."""

    def read(path, frame):
        import importlib

        with getattr(importlib.import_module(f"MDAnalysis.coordinates.{module}"), name)(str(path)) as reader:
            return Places(reader[frame].positions.copy())

    return read


def by_netcdf(path, frame):
    import netCDF4

    with netCDF4.Dataset(path) as file:
        if "coordinates" not in file.variables:
            raise OtherReads("no coordinates")
        return Places(np.asarray(file["coordinates"][frame]))


def by_h5md(path, frame):
    import h5py

    with h5py.File(path, "r") as file:
        if "particles" not in file:
            raise OtherReads("no particles")
        values = next(iter(file["particles"].values()))["position/value"]
        nanometres = values.attrs.get("unit") in ("nm", b"nm")
        return Places(values[frame] * (10 if nanometres else 1))


def by_lammps_data(path, frame):
    """ASE wants the style of the atoms, which LAMMPS writes behind "Atoms" or nowhere."""
    import ase.io

    styles = ["full", "molecular", "atomic", "charge", "sphere", "bond", "angle"]
    with open(path, errors="replace") as file:
        stated = [line.split("#", 1)[1].split() for line in file if line.startswith("Atoms") and "#" in line]
    if stated and stated[0]:
        styles = stated[0][:1]
    error = None
    for style in styles:
        try:
            atoms = ase.io.read(str(path), format="lammps-data", style=style, sort_by_id=True)
            return Places(atoms.positions)
        except Exception as found:
            error = found
    raise error


def by_pcl(path, frame):
    import pcl

    xyz = pcl.load(str(path)).to_array()
    return Places(xyz[np.isfinite(xyz).all(axis=1)])  # places that the camera did not see are NaN; bihive leaves them out


# VTK ends the program that it is in on some broken files, so it reads in one of its own.
VTK_READER = """
import sys
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonDataModel import vtkPointSet
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLStructuredGridReader, vtkXMLUnstructuredGridReader

vtkObject.GlobalWarningDisplayOff()
path, kind, out = sys.argv[1:]
reader = {"ply": vtkPLYReader, "vtk": vtkGenericDataObjectReader, "vtp": vtkXMLPolyDataReader,
          "vtu": vtkXMLUnstructuredGridReader, "vts": vtkXMLStructuredGridReader}[kind]()
reader.SetFileName(path)
reader.Update()
data = reader.GetOutputDataObject(0)
if not isinstance(data, vtkPointSet) or data.GetNumberOfPoints() == 0:
    sys.exit("no points")
numpy.save(out, vtk_to_numpy(data.GetPoints().GetData()))
"""


def by_vtk(path, frame):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "points.npy")
        done = subprocess.run([sys.executable, "-c", VTK_READER, str(path), path.suffix[1:].lower(), out], capture_output=True, text=True)
        if done.returncode != 0:
            raise OtherReads(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"VTK ended with {done.returncode}")
        return Places(np.load(out))


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
    ".lmp": ("LAMMPS data", by_lammps_data),
    ".data": ("LAMMPS data", by_lammps_data),
    ".data2": ("LAMMPS data", by_lammps_data),
    "data": ("LAMMPS data", by_lammps_data),
    ".ply": ("PLY", by_vtk),
    ".vtk": ("VTK", by_vtk),
    ".vtp": ("VTK", by_vtk),
    ".vtu": ("VTK", by_vtk),
    ".vts": ("VTK", by_vtk),
    ".pcd": ("PCD", by_pcl),
    ".dcd": ("DCD", by_trajectory_reader("DCD", "DCDReader")),
    ".xtc": ("XTC", by_trajectory_reader("XTC", "XTCReader")),
    ".trr": ("TRR", by_trajectory_reader("TRR", "TRRReader")),
    ".nc": ("NetCDF", by_netcdf),
    ".ncdf": ("NetCDF", by_netcdf),
    ".h5md": ("H5MD", by_h5md),
    "POSCAR": ("POSCAR", ase_format("vasp")),
    "CONTCAR": ("POSCAR", ase_format("vasp")),
    "XDATCAR": ("XDATCAR", ase_format("vasp-xdatcar")),
}


# Formats of places alone.
BESIDE_ATOMS = ("DCD", "XTC", "TRR", "NetCDF")


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

    def inputs(self, path, count):
        """The file, and in front of it one of `count` atoms if it holds places alone."""
        if count is None:
            return [str(path)]
        atoms = os.path.join(self.folder, "atoms.xyz")
        with open(atoms, "w") as file:
            file.write(f"{count}\n\n" + "Ar 0 0 0\n" * count)
        return [atoms, str(path)]

    def frames(self, inputs):
        done = self.run("info", *inputs, "--json")
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}"
        return json.loads(done.stdout)["frames"], ""

    def places(self, inputs, frame):
        out = os.path.join(self.folder, "out.npy")
        done = self.run("convert", *inputs, "-o", out, "--frame", str(frame))
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1]
        return np.load(out)[:, :3].astype(float), ""


def farthest(ours, theirs):
    """How far the farthest place of either crystal is from its nearest in the other, modulo the cell."""
    from scipy.spatial import cKDTree

    inverse = np.linalg.inv(theirs.cell)
    both = [(xyz @ inverse) % 1.0 @ theirs.cell for xyz in (ours, theirs.xyz)]
    shifts = np.array([[a, b, c] for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]) @ theirs.cell
    images = [(xyz[:, None, :] + shifts[None]).reshape(-1, 3) for xyz in both]
    return max(float(cKDTree(images[1 - i]).query(both[i])[0].max()) for i in (0, 1))


# The same places in the same order, if both leave out what is optional; those of crystals in any order.
def difference(ours, theirs):
    """The largest difference of a coordinate, and how many atoms the other reader has more (alternates). None: no match."""
    if theirs.cell is not None:
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
    parser.add_argument("--format", nargs="+", help="of these formats only, as the table names them")
    parser.add_argument("--tolerance", type=float, default=2e-4,
                        help="of coordinates, relative to the largest one: readers keep binary32 (%(default)s)")
    parser.add_argument("--special", type=float, default=0.02, help="of atoms in crystals, in Angstrom (%(default)s)")
    arguments = parser.parse_args()

    tally = collections.defaultdict(lambda: collections.Counter())
    largest = collections.defaultdict(float)
    remarks, wrong = [], 0
    candidates = [(path, found) for path in files_in(arguments.folders) if (found := reader_of(path))]
    candidates = [one for one in candidates if not arguments.format or one[1][0] in arguments.format]
    begin = time.time()
    with tempfile.TemporaryDirectory() as folder:
        bihive = Bihive(arguments.bihive, folder)
        for number, (path, (name, reader)) in enumerate(candidates):
            if sys.stderr.isatty():
                left = (time.time() - begin) / max(number, 1) * (len(candidates) - number)
                print(f"\r{number}/{len(candidates)} files, {left:.0f} s left   ", end="", file=sys.stderr)
            tally[name]["files"] += 1
            try:
                theirs = reader(path, 0)
            except Exception as error:  # each reader has its own
                theirs, other = None, f"{type(error).__name__}: {error}".splitlines()[0][:120]
            alone = name in BESIDE_ATOMS and theirs is not None
            inputs = bihive.inputs(path, len(theirs.xyz) if alone else None)
            frames, why = bihive.frames(inputs)
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
                ours, why = bihive.places(inputs, frame)
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
