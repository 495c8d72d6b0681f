"""How many atoms of PDB files change their element when columns 77-78 are blanked:

    pdb_elements.py BIHIVE FILE...

A file without these columns counts nothing. Only first models are compared, and alternate locations all stay."""

import collections
import json
import os
import subprocess
import sys
import tempfile


def blanked(lines):
    """The lines without elements and alternate locations, and the elements that stood in the first model."""
    result, stated = [], []
    models, in_model = 0, False
    for line in lines:
        if line.startswith(("ATOM", "HETATM")):
            models += not in_model
            in_model = True
            line = line.ljust(80)
            if models == 1:
                stated.append((line[76:78].strip(), line[12:16], line[17:21]))
            line = line[:16] + " " + line[17:76] + "  " + line[78:]
        elif line[:6].strip() in ("ENDMDL", "MODEL", "END"):
            in_model = False
        result.append(line)
    return result, stated


def selected(program, path, element):
    done = subprocess.run(
        [program, "select", path, "element " + element, "--json"], capture_output=True, text=True, check=True
    )
    return set(json.loads(done.stdout)["ids"])


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    files = atoms = 0
    different = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "blanked.pdb")
        for name in sys.argv[2:]:
            with open(name, errors="replace") as file:
                lines, stated = blanked(file.read().split("\n"))
            elements = {element for element, _, _ in stated if element.isalpha() and element != "X"}
            if not elements:
                continue
            files += 1
            with open(path, "w") as file:
                file.write("\n".join(lines) + "\n")
            for element in elements:
                ids = selected(sys.argv[1], path, "H" if element == "D" else element)
                for i, (one, atom, residue) in enumerate(stated):
                    atoms += one == element
                    if one == element and i not in ids:
                        different[(os.path.basename(name), atom, residue, one)] += 1
    print(f"{files} files, {atoms} atoms with an element, {sum(different.values())} differ")
    for what, count in different.most_common():
        print(count, *map(repr, what))


main()
