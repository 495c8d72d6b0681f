"""Sets of others for the study: test files of public repositories, which are not kept here.

A folder that has them: git clone https://github.com/OWNER/NAME FOLDER/NAME, for each repository below.
"""

CHEMFILES, PCL, FREUD, MDANALYSIS = "chemfiles/tests-data", "PointCloudLibrary/data", "glotzerlab/freud", "MDAnalysis/mdanalysis"
_TESTS = "testsuite/MDAnalysisTests/data"

# name, what it is, repository, path
FOREIGN = [
    ("lysozyme", "a protein", CHEMFILES, "gro/lysozyme.gro"),
    ("haemoglobin", "4HHB: four chains, haems and water", CHEMFILES, "cif/4hhb.cif"),
    ("concanavalin", "1VLN: eight chains with hydrogen", CHEMFILES, "gro/1vln-triclinic.gro"),
    ("polymer", "a polymer", CHEMFILES, "lammps/polymer.lammpstrj"),
    ("nacl", "sodium and chloride", CHEMFILES, "lammps/nacl.lammpstrj"),
    ("terrain1", "an airborne laser scan of terrain", PCL, "terrain/CSite1_red1-utm.pcd"),
    ("terrain7", "another one", PCL, "terrain/FSite7_orig-utm.pcd"),
    ("carton", "a depth image of a table with things on it", PCL, "tutorials/correspondence_grouping/milk_cartoon_all_small_clorox.pcd"),
    ("office", "a depth image of an office", PCL, "tutorials/region_growing_rgb_tutorial.pcd"),
    ("boxes", "a depth image of stacked boxes", PCL, "segmentation/mOSD/learn/learn13.pcd"),
    ("lj", "a Lennard-Jones fluid", FREUD, "tests/integration/files/lj/lj.gsd"),
    ("hcp", "a hexagonal close packing", FREUD, "tests/validation/files/minkowski_structure_metrics/hcp.gsd"),
    ("adk", "adenylate kinase in water", MDANALYSIS, f"{_TESTS}/adk_oplsaa.pdb"),
    ("membrane", "a transporter in lipids", MDANALYSIS, f"{_TESTS}/analysis/YiiP_lipids.gro.gz"),
    ("datatest", "a box of molecules", MDANALYSIS, f"{_TESTS}/lammps/datatest.data"),
    ("chains", "24 long chains of a polymer", MDANALYSIS, f"{_TESTS}/plength.gro"),
    ("martini", "a bilayer of coarse beads", MDANALYSIS, f"{_TESTS}/martini_dppc_chol_bilayer.gro"),
    ("vesicle", "the heads of a vesicle's lipids: a hollow ball", MDANALYSIS, f"{_TESTS}/dppc_vesicle_hg.gro"),
    ("nanotube", "a carbon nanotube", MDANALYSIS, f"{_TESTS}/lammps/cnt-hexagonal-class1.data"),
    ("hoomd", "particles of HOOMD-blue", MDANALYSIS, f"{_TESTS}/example_longer.gsd"),
    ("2r9r", "a part of a potassium channel, 2R9R", MDANALYSIS, f"{_TESTS}/2r9r-1b.xyz"),
]
