#!/usr/bin/env python3
"""Writes the .npy and .npz files beside this script with NumPy: one array in every layout of NumPy, and archives."""

import pathlib

import numpy

ROWS = numpy.array([[1, 2, 3, 0.5], [-4, 5.25, 6, 0.25], [7, 8, -9.5, 0]])
FOLDER = pathlib.Path(__file__).parent


def write(name, array, version=None):
    with open(FOLDER / name, "wb") as file:
        numpy.lib.format.write_array(file, array, version=version)


for dtype in ["<f4", "<f8", ">f4", ">f8"]:
    end = "little" if dtype[0] == "<" else "big"
    for order in "CF":
        write(f"{end}_{dtype[1:]}_{order}.npy", numpy.array(ROWS, dtype=dtype, order=order))
for major in [1, 2, 3]:
    write(f"version_{major}.npy", ROWS.astype("<f4"), version=(major, 0))

# Archives of arrays: columns, one of another length and a text; the same packed; one array of places.
columns = {
    "x": numpy.array([1.0, -4.0]),
    "y": numpy.array([2, 5], dtype="int16"),
    "z": numpy.array([3.0, 6.0], dtype=">f4"),
    "r": numpy.array([0.5, 0.25]),
    "v": numpy.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]),
    "box": numpy.array([9.0, 9.0, 9.0]),
    "name": numpy.array(["a", "b"]),
}
numpy.savez(FOLDER / "columns.npz", **columns)
numpy.savez_compressed(FOLDER / "columns_packed.npz", **columns)
numpy.savez(FOLDER / "places.npz", positions=numpy.array([[1, 2, 3], [4, 5, 6]], dtype="f4"), charge=numpy.array([1.0, -1.0]))
