#!/usr/bin/env python3
"""Bonds as bihive finds them beside those of Open Babel.

usage: bonds_agree.py BIHIVE FOLDER... [--json FILE] [--format NAME...] [--most-atoms N] [--all]

Reads the first molecule of every PDB, mmCIF, SDF, MOL, MOL2, XYZ and GRO file in the folders with both: `bihive convert` writes the
bonds of `--bonds auto`, and Open Babel states its own. Atoms are the same where element and coordinates are. Prints a table with a line
for each format, and for the bonds that one of both lacks how many there are of each kind; --all prints a line for each file that
differs. Ctrl-C ends it with the table of the files before. Debian: python3-openbabel.
"""

import argparse
import collections
import json
import pathlib
import signal
import subprocess
import tempfile

FORMATS = {".pdb": "pdb", ".ent": "pdb", ".cif": "mmcif", ".mmcif": "mmcif", ".sdf": "sdf", ".mol": "mol", ".mol2": "mol2",
           ".xyz": "xyz", ".gro": "gro"}
NEAR = 0.005  # Angstrom: the same atom
NONMETALS = {1, 2, 5, 6, 7, 8, 9, 10, 14, 15, 16, 17, 18, 32, 33, 34, 35, 36, 51, 52, 53, 54, 84, 85, 86}


class Molecule:
    """elements and xyz of atoms, residues or "", and bonds: {(i, j): order}, i < j, where 4 is aromatic and 0 unknown."""

    def __init__(self):
        self.elements, self.xyz, self.residues, self.bonds = [], [], [], {}


def by_open_babel(path, name):
    from openbabel import openbabel

    openbabel.obErrorLog.SetOutputLevel(-1)
    conversion = openbabel.OBConversion()
    conversion.SetInFormat(name)
    mol = openbabel.OBMol()
    if not conversion.ReadFile(mol, str(path)) or mol.NumAtoms() == 0:
        return None
    made = Molecule()
    for atom in openbabel.OBMolAtomIter(mol):
        made.elements.append(atom.GetAtomicNum())
        made.xyz.append((atom.GetX(), atom.GetY(), atom.GetZ()))
        residue = atom.GetResidue()
        made.residues.append(residue.GetName().strip() if residue else "")
    for bond in openbabel.OBMolBondIter(mol):
        ends = tuple(sorted((bond.GetBeginAtomIdx() - 1, bond.GetEndAtomIdx() - 1)))
        made.bonds[ends] = 4 if bond.IsAromatic() else bond.GetBondOrder()
    return made


def by_bihive(program, path, folder, symbols):
    output = pathlib.Path(folder) / "a.mol2"
    done = subprocess.run([program, "convert", str(path), "-o", str(output), "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        return None
    made, section = Molecule(), ""
    for line in output.read_text().splitlines():
        if line.startswith("@"):
            section = line
            continue
        fields = line.split()
        if section == "@<TRIPOS>ATOM":
            made.elements.append(symbols.get(fields[5].split(".")[0], 0))
            made.xyz.append(tuple(float(one) for one in fields[2:5]))
            made.residues.append(fields[7])
        elif section == "@<TRIPOS>BOND":
            order = {"un": 0, "am": 1, "ar": 4}.get(fields[3])
            made.bonds[int(fields[1]) - 1, int(fields[2]) - 1] = int(fields[3]) if order is None else order
    return made


def matched(one, other):
    """Positions in `other` of the atoms of `one`: those of equal element and place, each once."""
    cells = collections.defaultdict(list)
    for j, at in enumerate(other.xyz):
        cells[tuple(round(x / NEAR) for x in at)].append(j)
    used, found = set(), {}
    for i, at in enumerate(one.xyz):
        cell = [round(x / NEAR) for x in at]
        near = [j for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1) for j in cells.get((cell[0] + dx, cell[1] + dy, cell[2] + dz), ())
                if j not in used and other.elements[j] == one.elements[i] and max(abs(a - b) for a, b in zip(at, other.xyz[j])) <= NEAR]
        if near:
            found[i] = min(near)
            used.add(found[i])
    return found


def kind_of(molecule, pair, radii):
    """Why programs may differ about a bond: by its atoms, and by its length in sums of covalent radii."""
    elements = [molecule.elements[i] for i in pair]
    length = sum((a - b) ** 2 for a, b in zip(*(molecule.xyz[i] for i in pair))) ** 0.5
    share = length / max(sum(radii(e) for e in elements), 1e-9)
    if any(e and e not in NONMETALS for e in elements):
        return "with a metal"
    if 0 in elements:
        return "of unknown element"
    if share > 2:
        return "through a side of the cell"
    if length < 0.4:
        return "nearer than 0.4 Å"
    waters = [molecule.residues[i] in ("HOH", "WAT", "SOL", "H2O", "DOD", "TIP3") for i in pair]
    what = "with water" if any(waters) else "of hydrogen" if 1 in elements else "of other atoms"
    return what + (", shorter than 0.75" if share < 0.75 else ", longer than 1.2" if share > 1.2 else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bihive")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--json")
    parser.add_argument("--format", nargs="+")
    parser.add_argument("--most-atoms", type=int, default=20000)
    parser.add_argument("--all", action="store_true", help="a line for each file that differs")
    options = parser.parse_args()
    from openbabel import openbabel

    symbols = {openbabel.GetSymbol(number): number for number in range(1, 119)}
    rows, kinds, of_files = {}, collections.defaultdict(collections.Counter), []

    def compare(path, name, folder):
        ours = by_bihive(options.bihive, path, folder, symbols)
        if ours is None or len(ours.xyz) > options.most_atoms:
            return
        theirs = by_open_babel(path, name)
        row = rows.setdefault(name, collections.Counter())
        if theirs is None:
            row["only bihive reads"] += 1
            return
        place = matched(theirs, ours)
        if len(place) < 0.5 * len(ours.xyz):
            row["other atoms"] += 1
            return
        back = {j: i for i, j in place.items()}
        their_bonds, without = {}, 0
        for (i, j), order in theirs.bonds.items():
            if i in place and j in place:
                their_bonds[tuple(sorted((place[i], place[j])))] = order
            else:
                without += 1
        our_bonds = {pair: order for pair, order in ours.bonds.items() if pair[0] in back and pair[1] in back}
        both = our_bonds.keys() & their_bonds.keys()
        only_ours, only_theirs = our_bonds.keys() - both, their_bonds.keys() - both
        stated = [pair for pair in both if our_bonds[pair] in (1, 2, 3)]
        row.update({"files": 1, "files equal": not only_ours and not only_theirs, "atoms": len(place), "both": len(both),
                    "only bihive": len(only_ours), "only Open Babel": len(only_theirs), "atoms left out": without,
                    "orders": len(stated),
                    "orders differ": sum(their_bonds[pair] not in (our_bonds[pair], 4) for pair in stated)})
        for side, pairs in (("only bihive", only_ours), ("only Open Babel", only_theirs)):
            for pair in pairs:
                kinds[name, side][kind_of(ours, pair, openbabel.GetCovalentRad)] += 1
        if only_ours or only_theirs:
            of_files.append({"file": str(path), "only_bihive": sorted(map(list, only_ours)), "only_open_babel": sorted(map(list, only_theirs))})
            if options.all:
                print(f"{path}: only bihive {sorted(only_ours)[:5]} of {len(only_ours)}, only Open Babel {sorted(only_theirs)[:5]} of {len(only_theirs)}")

    # Also where a shell has its background jobs ignore Ctrl-C.
    for one in (signal.SIGINT, signal.SIGTERM):
        signal.signal(one, signal.default_int_handler)
    with tempfile.TemporaryDirectory() as folder:
        try:
            for path in sorted(p for where in options.folders for p in pathlib.Path(where).rglob("*") if p.suffix.lower() in FORMATS):
                name = FORMATS[path.suffix.lower()]
                if path.is_file() and (not options.format or name in options.format):
                    compare(path, name, folder)
        except KeyboardInterrupt:
            print("interrupted: the table is of the files before", path)
    columns = ["files", "files equal", "atoms", "both", "only bihive", "only Open Babel", "atoms left out", "orders", "orders differ"]
    print("| format | " + " | ".join(columns) + " |\n|" + "---|" * (len(columns) + 1))
    for name, row in sorted(rows.items()):
        print(f"| {name} | " + " | ".join(f"{row[column]:,}" for column in columns) + " |")
        for what in ("only bihive reads", "other atoms"):
            if row[what]:
                print(f"  {name}: {what}: {row[what]} files")
    for (name, side), counts in sorted(kinds.items()):
        print(f"{name}, {side}: " + ", ".join(f"{count:,} {kind}" for kind, count in counts.most_common()))
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(of_files, indent=1))


if __name__ == "__main__":
    main()
