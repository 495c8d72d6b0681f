# A molecule as it comes
# `demo` is the molecule that comes with the program, the HIV-1 protease with a drug in it (PDB 1HPV). Replace it by the
# name of a file.
bihive render demo -o 01-a-molecule.png --size 480x360
