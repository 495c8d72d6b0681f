# A molecule as it comes
# `demo` is the molecule that the program brings along, the HIV-1 protease with a drug in it (PDB 1HPV). The name of a file stands in its place.
bihive render demo -o 01-a-molecule.png --size 480x360
