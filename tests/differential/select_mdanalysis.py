#!/usr/bin/env python3
"""Selections of bihive against those of MDAnalysis (Debian: python3-mdanalysis) on the same files: the same ids.

usage: select_mdanalysis.py BIHIVE MOLECULE.pdb FOLDER
Writes files into FOLDER. Says which selections differ, and fails if one does.
"""

import json
import pathlib
import random
import subprocess
import sys
import warnings

warnings.filterwarnings("ignore")
import MDAnalysis  # noqa: E402

# bihive's selection, and the one that means the same to MDAnalysis.
OF_A_MOLECULE = [
    ("all", "all"),
    ("element C and z > 3", "element C and prop z > 3"),
    ("element C O", "element C O"),
    ("chain A and not water", "chainID A and not resname HOH"),
    ("chain A B", "chainID A B"),
    ("not chain A", "not chainID A"),
    ("resname 478", "resname 478"),
    ("resname HOH or resname 478", "resname HOH 478"),
    ("protein", "protein"),
    ("protein and chain B", "protein and chainID B"),
    ("name CA CB", "name CA CB"),
    ("name C*", "name C*"),
    ("name N and (resname GLY or resname ALA)", "name N and (resname GLY or resname ALA)"),
    ("resid 10..20", "resid 10:20"),
    ("resid 1 3 5..7", "resid 1 3 5:7"),
    ("index 0..999", "index 0:999"),
    ("index 0..9 20..22", "index 0:9 20:22"),
    ("x > 0 and y < 20", "prop x > 0 and prop y < 20"),
    ("-5 < z < 5", "prop abs z < 5"),
    ("b_factor > 30", "prop tempfactor > 30"),
    ("occupancy = 1", "prop occupancy == 1"),
    ("within 5 of resname 478", "resname 478 or around 5 resname 478"),
    ("within 5 of resname 478 and protein", "(resname 478 or around 5 resname 478) and protein"),
    ("within 3.5 of (chain A and name CA)", "(chainID A and name CA) or around 3.5 (chainID A and name CA)"),
    ("not within 8 of resname 478", "not (resname 478 or around 8 resname 478)"),
]
OF_POINTS = [
    ("x > 8", "prop x > 8"),
    ("x > 8 and (y < 7 or z >= 14)", "prop x > 8 and (prop y < 7 or prop z >= 14)"),
    ("type 2", "type 2"),
    ("type 1 3", "type 1 3"),
    ("index 100..199 and type 1", "index 100:199 and type 1"),
    ("within 2 of type 3", "type 3 or around 2 type 3"),
]


def clean_molecule(path, to):
    """The molecule with its elements in their columns: the bundled file is older than these, and MDAnalysis takes what
    stands there for charges."""
    lines = []
    for line in pathlib.Path(path).read_text().splitlines():
        if line.startswith(("ATOM", "HETATM")):
            element = "".join(letter for letter in line[12:14] if letter.isalpha())
            lines.append(f"{line[:72]:<76}{element:>2}")
        elif line.startswith(("TER", "END")):
            lines.append(line)
    to.write_text("\n".join(lines) + "\n")


def write_points(to):
    # MDAnalysis subtracts the box's lower corner, so it is 0.
    rng = random.Random(1)
    rows = [f"{i + 1} {rng.randint(1, 3)} " + " ".join(f"{rng.uniform(0, 20):.6f}" for _ in range(3)) for i in range(2000)]
    box = "\n".join(["0 20"] * 3)
    to.write_text(
        f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n{box}\nITEM: ATOMS id type x y z\n"
        + "\n".join(rows)
        + "\n"
    )


def ids_of(bihive, path, expression):
    done = subprocess.run([bihive, "select", path, expression, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        return done.stderr.strip()
    return json.loads(done.stdout)["ids"]


def differences(bihive, path, universe, selections):
    found = 0
    for ours, theirs in selections:
        mine = ids_of(bihive, path, ours)
        other = [int(i) for i in universe.select_atoms(theirs, periodic=False).ix]
        if mine == other and other:
            continue
        found += 1
        if isinstance(mine, str):
            print(f"{path}: {ours!r}: {mine}")
        else:
            print(f"{path}: {ours!r} has {len(mine)}, MDAnalysis' {theirs!r} {len(other)}; "
                  f"one alone has {sorted(set(mine) ^ set(other))[:10]}")
    return found


def main():
    bihive, molecule, folder = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    pdb, dump = folder / "molecule.pdb", folder / "points.dump"
    clean_molecule(molecule, pdb)
    write_points(dump)
    count = differences(bihive, str(pdb), MDAnalysis.Universe(str(pdb)), OF_A_MOLECULE)
    points = MDAnalysis.Universe(str(dump), format="LAMMPSDUMP", atom_style="id type x y z")
    count += differences(bihive, str(dump), points, OF_POINTS)
    print(f"{len(OF_A_MOLECULE) + len(OF_POINTS)} selections, MDAnalysis {MDAnalysis.__version__}, {count} differ")
    sys.exit(1 if count else 0)


main()
