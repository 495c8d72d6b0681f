#!/usr/bin/env python3
"""Writes the .npy files beside this script with NumPy: one array in every layout of NumPy."""

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
