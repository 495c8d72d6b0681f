#!/usr/bin/python3
"""Exact areas and volumes beside FreeSASA and Voronota-LT: processor time of one thread, and differences.

usage: PYTHONPATH=build-release/python bench/python_measures.py [--made] [--voronota-lt PROGRAM] FILE...

Each FILE is a molecule, with a probe of 1.4. The peers get the same numbers, coordinates with three decimals and radii with two; their
time is that of the whole process, reading included, and bihive's that of bh.volume() (which computes the area too), bh.measure() (cavities and
volumes of spheres too) and bh.contacts(), so the rates favour bihive. A peer that is not
there is left out. --made: a million spheres, lattices in contact, and 50 copies of the
bundled molecule with the probe. The median of five turns, or of three for a million spheres.
"""

import argparse
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import tempfile
import time

import bihive as bh
import numpy as np

PROBE = 1.4


def taken(call, turns=5):
    """The answer, and the median processor time."""
    seconds = []
    for _ in range(turns):
        begin = time.process_time()
        answer = call()
        seconds.append(time.process_time() - begin)
    return answer, statistics.median(seconds)


def taken_by(command, turns=5):
    seconds = []
    for _ in range(turns):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
    return done.stdout, statistics.median(seconds)


def of_freesasa(xyz, radius, folder, words):
    """The area. FreeSASA takes radii from the column of occupancies."""
    file = folder / "in.pdb"
    with open(file, "w") as out:
        for i, ((x, y, z), r) in enumerate(zip(xyz, radius)):
            out.write(f"ATOM  {i % 99999 + 1:5d}  CA  ALA A{i % 9999 + 1:4d}    {x:8.3f}{y:8.3f}{z:8.3f}{r:6.2f}  0.00           C\n")
    words = ["freesasa", *words, "--n-threads=1", "--radius-from-occupancy", f"--probe-radius={PROBE}", "--no-warnings", file]
    text, seconds = taken_by(words)
    return float(re.search(r"Total\s*:\s*([\d.]+)", text)[1]), seconds


def of_voronota(program, xyz, radius, folder):
    """Area and volume, summed over its table of cells; the time without the table."""
    file = folder / "in.xyzr"
    file.write_text("".join(f"{x:.3f} {y:.3f} {z:.3f} {r:.2f}\n" for (x, y, z), r in zip(xyz, radius)))
    words = [program, "-i", file, "--probe", str(PROBE), "--processors", "1"]
    _, seconds = taken_by(words)
    lines = taken_by([*words, "--print-cells"], 1)[0].splitlines()
    heads = lines[0].split("\t")
    area = next(i for i, head in enumerate(heads) if "sas" in head and "area" in head)
    volume = next(i for i, head in enumerate(heads) if "volume" in head)
    rows = [line.split("\t") for line in lines[1:] if line]
    return sum(float(row[area]) for row in rows), sum(float(row[volume]) for row in rows), seconds


def compare(file, voronota, folder):
    spheres = bh.read(file)
    numbers = np.unique(np.column_stack([spheres.xyz.round(3), spheres.radius.round(2)]), axis=0)
    xyz, radius = numbers[:, :3], numbers[:, 3]
    balls = bh.Spheres(xyz, radius=radius)
    m, seconds_of_all = taken(lambda: bh.measure(balls, probe=PROBE, threads=1))
    _, seconds = taken(lambda: bh.volume(balls, probe=PROBE))
    _, seconds_of_contacts = taken(lambda: bh.contacts(balls, probe=PROBE, threads=1))
    print(f"{file.name}: {len(radius)} spheres, area {m.area:.6f}, volume {m.volume:.6f}, bounds {m.area_error / m.area:.0e} {m.volume_error / m.volume:.0e}")
    rates = [len(radius) / one for one in (seconds, seconds_of_all, seconds_of_contacts)]
    print("  bihive, area and volume {:,.0f}, all {:,.0f}, contacts {:,.0f} per second".format(*rates))
    if voronota:
        area, volume, seconds = of_voronota(voronota, xyz, radius, folder)
        print(f"  Voronota-LT {len(radius) / seconds:,.0f} per second, off by {abs(area / m.area - 1):.1e} and {abs(volume / m.volume - 1):.1e}")
    if shutil.which("freesasa"):
        for name, words in [("Lee-Richards 20", ["--lee-richards", "--resolution=20"]), ("Shrake-Rupley 100", ["--shrake-rupley", "--resolution=100"])]:
            area, seconds = of_freesasa(xyz, radius, folder, words)
            print(f"  FreeSASA {name} {len(radius) / seconds:,.0f} per second, off by {abs(area / m.area - 1):.1e}", flush=True)


def made_sets():
    rng = np.random.default_rng(41)
    count = 1_000_000
    side = 1.4 * count ** (1 / 3)
    yield "a million of one radius", rng.random((count, 3)) * side, 0.8, 3
    yield "a million with radii of 1:100", rng.random((count, 3)) * 2 * side, (1 - rng.random(count) * (1 - 1e-6)) ** (-1 / 3), 3
    # In the second, four spheres at the corners of a face of 6 x 8 meet in its centre, exactly.
    for n, cell, r, name in [(50, (2, 2, 2), 1.0, "a cubic lattice in contact"), (20, (6, 8, 8), 5.0, "a lattice whose spheres meet by fours")]:
        grid = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        yield name, grid * np.array(cell, dtype=np.float64), r, 5


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--made", action="store_true", help="sets of a million spheres, and lattices")
    parser.add_argument("--voronota-lt", default=shutil.which("voronota-lt"), help="the program (default: from PATH)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for file in options.files:
            compare(file, options.voronota_lt, pathlib.Path(folder))
    for name, xyz, radius, turns in made_sets() if options.made else []:
        spheres = bh.Spheres(xyz, radius=radius)
        _, seconds = taken(lambda: bh.volume(spheres), turns)
        print(f"{name}: area and volume of {len(xyz)} spheres in {seconds:.2f} s, {len(xyz) / seconds:,.0f} per second", flush=True)
    if options.made:
        one = bh.read("demo")
        copies = bh.Spheres(np.concatenate([one.xyz + [200 * i, 0, 0] for i in range(50)]), radius=np.tile(one.radius, 50))
        for name, call in (("area", bh.sasa), ("area and volume", bh.volume)):
            _, seconds = taken(lambda: call(copies, probe=PROBE))
            print(f"50 copies of the bundled molecule, probe {PROBE}: {name} of {len(copies):,} atoms, {len(copies) / seconds:,.0f} per second", flush=True)
