#!/usr/bin/env python3
"""Writes the small HDF5 and NetCDF files of the tests. Needs python3-h5py and python3-netcdf4.

Usage: make_arrays.py [FOLDER]
"""

import os
import sys

import h5py
import netCDF4
import numpy

PLACES = numpy.array([[[1, 2, 3], [4, 5, 6], [7, 8, 9]], [[1.5, 2, 3], [4, 5.5, 6], [7, 8, 9.5]]])


def h5md(path):
    with h5py.File(path, "w", libver="earliest", track_order=False) as file:
        file.create_group("h5md").attrs["version"] = [1, 1]
        group = file.create_group("particles/water")
        box = group.create_group("box")
        box.attrs["dimension"] = 3
        box.attrs["boundary"] = ["periodic", "none", "periodic"]  # texts of variable length
        edges = box.create_group("edges")
        edges.create_dataset("value", data=numpy.array([[2, 3, 4], [2, 3, 5]], "f4")).attrs["unit"] = numpy.bytes_("nm")
        edges["step"] = [0, 10]
        position = group.create_group("position")
        value = position.create_dataset("value", data=PLACES.astype("f4") / 10, chunks=(1, 3, 3), compression="gzip")
        value.attrs["unit"] = "nm"  # a text of variable length
        position["step"] = numpy.array([0, 10])
        position.create_dataset("time", data=numpy.array([0, 2.5])).attrs["unit"] = numpy.bytes_("ps")
        kinds = h5py.enum_dtype({"H": 1, "O": 8}, basetype="i1")
        group.create_dataset("species", data=numpy.array([8, 1, 1], "i1"), dtype=kinds)
        group["mass"] = [16.0, 1.0, 1.0]
        velocity = group.create_group("velocity")
        velocity["value"] = PLACES * 0.5
        velocity["step"] = [0, 10]
        steps = file.create_group("particles/steps/position")
        steps["value"] = PLACES
        box = file.create_group("particles/steps/box")
        box.attrs["boundary"] = numpy.array([b"none", b"periodic", b"periodic"])
        box["edges"] = [1.0, 2.0, 3.0]
        steps["step"] = 5
        steps["step"].attrs["offset"] = 100


def data_sets(path):
    with h5py.File(path, "w", libver="earliest") as file:
        file["run/xyz"] = PLACES[0].astype(">f4")
        file["run/film"] = PLACES
        file["run/flat"] = numpy.arange(3.0)
        table = file.create_group("table")
        for name, column in (("px", 0), ("py", 1), ("pz", 2)):
            table[name] = PLACES[0][:, column]
        table["size"] = numpy.array([1, 2, 3], "u2")
        table["words"] = numpy.array([b"a", b"b", b"c"])


def amber(path, lammps):
    kind = "NETCDF3_CLASSIC" if lammps else "NETCDF3_64BIT_OFFSET"
    with netCDF4.Dataset(path, "w", format=kind) as file:
        file.Conventions = "AMBER"
        file.ConventionVersion = "1.0"
        file.createDimension("frame", None)
        for name, length in (("atom", 3), ("spatial", 3), ("cell_spatial", 3), ("cell_angular", 3), ("label", 5)):
            file.createDimension(name, length)
        file.createVariable("spatial", "S1", ("spatial",))[:] = numpy.array([b"x", b"y", b"z"])
        time = file.createVariable("time", "f4", ("frame",))
        time.units = "femtosecond" if lammps else "picosecond"
        if lammps:
            time.scale_factor = 2.0
        coordinates = file.createVariable("coordinates", "f4", ("frame", "atom", "spatial"))
        coordinates.units = "angstrom"
        lengths = file.createVariable("cell_lengths", "f8", ("frame", "cell_spatial"))
        angles = file.createVariable("cell_angles", "f8", ("frame", "cell_angular"))
        if lammps:
            file.createVariable("cell_origin", "f8", ("frame", "cell_spatial"))
            file.createVariable("type", "i4", ("frame", "atom"))
            file.createVariable("c_stress", "f8", ("frame", "atom", "spatial"))
        file.set_auto_maskandscale(False)
        for frame in range(2):
            time[frame] = 500 * frame if lammps else frame + 0.5
            coordinates[frame] = PLACES[frame]
            lengths[frame] = [10, 11, 12 + frame]
            angles[frame] = [90, 90, 90]
            if lammps:
                file["cell_origin"][frame] = [-1, 0, 1]
                file["type"][frame] = [1, 2, 2]
                file["c_stress"][frame] = PLACES[frame] * 10


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    h5md(os.path.join(folder, "water.h5md"))
    data_sets(os.path.join(folder, "sets.h5"))
    amber(os.path.join(folder, "amber.nc"), lammps=False)
    amber(os.path.join(folder, "lammps.nc"), lammps=True)


if __name__ == "__main__":
    main()
