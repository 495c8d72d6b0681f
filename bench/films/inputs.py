"""Input files for the part film of scripts/bench, made once: trajectories by LAMMPS, and a cloud as an array."""

import array
import os
import pathlib
import random
import shutil
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent.parent
STEPS_A_FRAME = 10


def melt(folder, cells, frames):
    """The path, seen from the project, of a LAMMPS dump of 4 cells^3 atoms with velocities."""
    path = folder / f"melt_{4 * cells**3}_{frames}.lammpstrj"
    if not path.is_file():
        program = shutil.which("lmp")
        if program is None:
            sys.exit("scripts/bench: the part film needs LAMMPS: run scripts/setup bench")
        folder.mkdir(parents=True, exist_ok=True)
        print(f"scripts/bench: LAMMPS writes {path}", file=sys.stderr, flush=True)
        part = path.with_suffix(".part")
        steps = STEPS_A_FRAME * (frames - 1)
        values = {"cells": cells, "steps": steps, "file": part}
        words = [word for name, value in values.items() for word in ("-var", name, str(value))]
        command = [program, "-in", str(TOP / "bench/films/melt.in"), "-log", "none", "-screen", "none", *words]
        subprocess.run(command, check=True, cwd=folder, stdout=subprocess.DEVNULL)
        part.rename(path)
    return os.path.relpath(path, TOP)


def frame_of(bihive, trajectory, number):
    """The path of an extended XYZ file of one frame of a trajectory."""
    path = (TOP / trajectory).with_suffix(f".{number}.xyz")
    if not path.is_file():
        subprocess.run([bihive, "convert", trajectory, "--frame", str(number), "-o", path], check=True, cwd=TOP, stdout=subprocess.DEVNULL)
    return os.path.relpath(path, TOP)


def cloud(folder, count):
    """The path of an NPY array of `count` spheres, x y z r in binary32, uniform in a cube of which they fill a tenth."""
    path = folder / f"cloud_{count}.npy"
    if not path.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        numbers = random.Random(1)
        side = (count * 4.18879 / 0.1) ** (1 / 3)
        head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({count}, 4), }}"
        head += " " * (-(10 + len(head) + 1) % 64) + "\n"
        part = path.with_suffix(".part")
        with open(part, "wb") as file:
            file.write(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode())
            for first in range(0, count, 100_000):
                rows = min(100_000, count - first)
                values = array.array("f", (side * numbers.random() if k % 4 < 3 else 1.0 for k in range(4 * rows)))
                if sys.byteorder == "big":
                    values.byteswap()
                values.tofile(file)
        part.rename(path)
    return os.path.relpath(path, TOP)
