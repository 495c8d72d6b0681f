// The bonds that files of molecules state.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bihive/geometry/sphere_attributes.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::read_text;

using List = std::vector<StatedBond>;
constexpr BondOrder kUnknown = BondOrder::unknown, kSingle = BondOrder::single, kDouble = BondOrder::double_bond,
                    kTriple = BondOrder::triple, kAromatic = BondOrder::aromatic;

StatedBonds bonds_of(const std::string& text, const std::string& name, const ReadOptions& options = {}) {
  return read_text(text, name, options).spheres.attributes().bonds;
}

const std::string kAtomLines =
    "    0.0000    0.0000    0.0000 C   0  0\n    1.5000    0.0000    0.0000 C   0  0\n"
    "    3.0000    0.0000    0.0000 N   0  0\n    4.5000    0.0000    0.0000 O   0  0\n";

TEST(BondsOfFiles, sdf_states_all_with_their_orders) {
  const std::string head = "one\n\n\n  4  5  0  0  0  0            999 V2000\n" + kAtomLines;
  const std::string text = head +
                           "  2  1  1  0\n  2  3  2  0\n  3  4  3  0\n  1  4  4  0\n  1  3 10  0\nM  END\n$$$$\n"
                           "two\n\n\n  4  0  0  0  0  0            999 V2000\n" +
                           kAtomLines + "M  END\n$$$$\n";
  const StatedBonds bonds = bonds_of(text, "a.sdf");
  EXPECT_EQ(bonds.list, (List{{0, 1, kSingle}, {0, 3, kAromatic}, {1, 2, kDouble}, {2, 3, kTriple}}));
  EXPECT_TRUE(bonds.are_all);
  // A molecule without any states nothing.
  EXPECT_FALSE(bonds_of(text, "a.sdf", at_frame(1)).are_all);
}

TEST(BondsOfFiles, sdf_of_version_3000) {
  const std::string text =
      "one\n\n\n  0  0  0     0  0            999 V3000\nM  V30 BEGIN CTAB\nM  V30 COUNTS 3 2 0 0 0\nM  V30 BEGIN "
      "ATOM\n"
      "M  V30 1 C 0 0 0 0\nM  V30 2 C 1.5 0 0 0\nM  V30 3 O 3 0 0 0\nM  V30 END ATOM\nM  V30 BEGIN BOND\n"
      "M  V30 1 1 1 2\nM  V30 2 2 3 2\nM  V30 END BOND\nM  V30 END CTAB\nM  END\n";
  EXPECT_EQ(bonds_of(text, "a.mol").list, (List{{0, 1, kSingle}, {1, 2, kDouble}}));
}

TEST(BondsOfFiles, mol2) {
  const StatedBonds bonds = bonds_of(
      "@<TRIPOS>MOLECULE\nm\n4 5\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n1 C1 9 5 5 C.3 1 A\n2 C2 7 5 5 C.3 1 A\n"
      "3 C3 2 5 5 C.3 1 A\n4 C4 0.5 5 5 C.3 1 A\n@<TRIPOS>BOND\n1 1 2 ar\n2 2 3 am\n3 3 4 2\n4 1 4 nc\n5 1 3 un\n6 9 1 "
      "1\n",
      "a.mol2");
  EXPECT_EQ(bonds.list, (List{{0, 1, kAromatic}, {0, 2, kUnknown}, {1, 2, kSingle}, {2, 3, kDouble}}));
  EXPECT_TRUE(bonds.are_all);
}

std::string pdb_atom(int serial, char alternate, const std::string& name, int residue, double x, double occupancy) {
  char line[100];
  std::snprintf(line, sizeof line, "ATOM  %5d %4s%cLIG A%4d    %8.3f%8.3f%8.3f%6.2f  0.00           C\n", serial,
                name.c_str(), alternate, residue, x, 0.0, 0.0, occupancy);
  return line;
}

TEST(BondsOfFiles, conect_of_pdb_is_some_of_them) {
  const std::string atoms = pdb_atom(10, ' ', "C1", 1, 0, 1) + pdb_atom(11, 'A', "C2", 1, 1.5, 0.4) +
                            pdb_atom(12, 'B', "C2", 1, 1.6, 0.6) + pdb_atom(13, ' ', "C3", 1, 3, 1);
  // Bonds of the alternate location that is left out go; two records are a double bond.
  const StatedBonds bonds = bonds_of(
      atoms + "CONECT   10   11   12   12\nCONECT   11   10   13\nCONECT   12   10   10   13\nCONECT   13   12\n",
      "a.pdb");
  EXPECT_EQ(bonds.list, (List{{0, 1, kDouble}, {1, 2, kUnknown}}));
  EXPECT_FALSE(bonds.are_all);
}

TEST(BondsOfFiles, go_with_each_copy_of_an_assembly) {
  const std::string remark =
      "REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"
      "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000\n"
      "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000\n"
      "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000\n"
      "REMARK 350   BIOMT1   2  1.000000  0.000000  0.000000       50.00000\n"
      "REMARK 350   BIOMT2   2  0.000000  1.000000  0.000000        0.00000\n"
      "REMARK 350   BIOMT3   2  0.000000  0.000000  1.000000        0.00000\n";
  ReadOptions options;
  options.assembly = "1";
  const std::string atoms = pdb_atom(1, ' ', "C1", 1, 0, 1) + pdb_atom(2, ' ', "C2", 1, 1.5, 1);
  EXPECT_EQ(bonds_of(remark + atoms + "CONECT    1    2\n", "a.pdb", options).list,
            (List{{0, 1, kUnknown}, {2, 3, kUnknown}}));
}

const std::string kCifAtoms =
    "data_T\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n"
    "_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.pdbx_PDB_ins_code\n"
    "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.auth_seq_id\n"
    "_atom_site.auth_asym_id\n"
    "1 S SG A CYS A 3 ? 0 0 0 0.7 103 X\n2 S SG B CYS A 3 ? 0.1 0 0 0.3 103 X\n3 S SG . CYS B 9 ? 2 0 0 1 9 Y\n"
    "4 S SG . CYS B 9 A 9 0 0 1 9 Y\n5 ZN ZN . ZN C . ? 4 0 0 1 201 X\n6 O O . HOH D . ? 6 0 0 1 301 X\n"
    "7 O O . HOH D . ? 6 3 0 1 302 X\n";
const std::string kConnections =
    "loop_\n_struct_conn.id\n_struct_conn.conn_type_id\n_struct_conn.ptnr1_label_asym_id\n"
    "_struct_conn.ptnr1_label_comp_id\n_struct_conn.ptnr1_label_seq_id\n_struct_conn.ptnr1_label_atom_id\n"
    "_struct_conn.pdbx_ptnr1_label_alt_id\n_struct_conn.pdbx_ptnr1_PDB_ins_code\n_struct_conn.ptnr1_symmetry\n"
    "_struct_conn.ptnr2_label_asym_id\n_struct_conn.ptnr2_label_comp_id\n_struct_conn.ptnr2_label_seq_id\n"
    "_struct_conn.ptnr2_label_atom_id\n_struct_conn.pdbx_ptnr2_label_alt_id\n_struct_conn.pdbx_ptnr2_PDB_ins_code\n"
    "_struct_conn.ptnr2_symmetry\n_struct_conn.ptnr1_auth_asym_id\n_struct_conn.ptnr1_auth_comp_id\n"
    "_struct_conn.ptnr1_auth_seq_id\n_struct_conn.ptnr2_auth_asym_id\n_struct_conn.ptnr2_auth_comp_id\n"
    "_struct_conn.ptnr2_auth_seq_id\n_struct_conn.pdbx_value_order\n";

TEST(BondsOfFiles, struct_conn_of_mmcif) {
  const std::string disulfide = "d1 disulf A CYS 3 SG A ? 1_555 B CYS 9 SG ? ? 1_555 X CYS 103 Y CYS 9 sing\n";
  const std::string of_other_mark = "d2 disulf A CYS 3 SG B ? 1_555 B CYS 9 SG ? A 1_555 X CYS 103 Y CYS 9 ?\n";
  const std::string of_metal = "m1 metalc C ZN . ZN ? ? 1_555 D HOH . O ? ? 1_555 X ZN 201 X HOH 302 ?\n";
  const std::string to_mate = "m2 metalc C ZN . ZN ? ? 1_555 D HOH . O ? ? 2_655 X ZN 201 X HOH 301 ?\n";
  const std::string hydrogen = "h1 hydrog C ZN . ZN ? ? 1_555 D HOH . O ? ? 1_555 X ZN 201 X HOH 301 ?\n";
  const std::string nowhere = "c1 covale C ZN . ZN ? ? 1_555 D HOH . O ? ? 1_555 X ZN 201 X HOH 999 ?\n";
  const StatedBonds bonds =
      bonds_of(kCifAtoms + kConnections + disulfide + of_other_mark + of_metal + to_mate + hydrogen + nowhere, "a.cif");
  // Spheres: SG A, SG 9, SG 9 A, ZN, two waters.
  EXPECT_EQ(bonds.list, (List{{0, 1, kSingle}, {3, 5, kUnknown}}));
  EXPECT_FALSE(bonds.are_all);
  EXPECT_TRUE(bonds_of(kCifAtoms, "a.cif").empty());
}

TEST(BondsOfFiles, components_of_mmcif_within_their_residues) {
  const std::string head =
      "data_T\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n"
      "_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.Cartn_x\n"
      "_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.auth_seq_id\n"
      "_atom_site.auth_asym_id\n";
  const std::string atoms =
      "1 C C1 . LIG A 1 0 0 0 1 1 X\n2 O O1 A LIG A 1 1.2 0 0 0.3 1 X\n3 O O1 B LIG A 1 1.3 0 0 0.7 1 X\n"
      "4 N N1 B LIG A 1 0 1.4 0 0.7 1 X\n5 N N1 A LIG A 1 0 1.5 0 0.3 1 X\n6 C C1 . LIG A 2 5 0 0 1 2 X\n"
      "7 O O1 . LIG A 2 6.2 0 0 1 2 X\n8 C C1 . ABC A 3 9 0 0 1 3 X\n9 O O1 . ABC A 3 9 2 0 1 3 X\n";
  const std::string table =
      "loop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n"
      "_chem_comp_bond.value_order\n_chem_comp_bond.pdbx_aromatic_flag\nLIG C1 O1 doub N\nLIG N1 O1 sing Y\n"
      "LIG C1 H1 sing N\nXYZ C1 O1 sing N\n";
  const StatedBonds bonds = bonds_of(head + atoms + table, "a.cif");
  // Of the alternates those of location B stay, and so do their bonds: spheres C1, O1 B, N1 B, C1, O1, C1, O1.
  EXPECT_EQ(bonds.list, (List{{0, 1, kDouble}, {1, 2, kAromatic}, {3, 4, kDouble}}));
  EXPECT_FALSE(bonds.are_all);
  // The table may come before the atoms.
  EXPECT_EQ(bonds_of("data_T\n" + table + head.substr(7) + atoms, "a.cif").list, bonds.list);
}

TEST(BondsOfFiles, chemical_components) {
  const StatedBonds bonds = bonds_of(
      "data_X\nloop_\n_chem_comp_atom.comp_id\n_chem_comp_atom.atom_id\n_chem_comp_atom.type_symbol\n"
      "_chem_comp_atom.x\n_chem_comp_atom.y\n_chem_comp_atom.z\nX C1 C 0 0 0\nX 'O1*' O 1.2 0 0\nX N1 N -1.3 0 0\n"
      "loop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n_chem_comp_bond.value_"
      "order\n"
      "_chem_comp_bond.pdbx_aromatic_flag\nX 'O1*' C1 DOUB N\nX C1 N1 SING Y\nX C1 Q9 SING N\n",
      "x.cif");
  EXPECT_EQ(bonds.list, (List{{0, 1, kDouble}, {0, 2, kAromatic}}));
  EXPECT_TRUE(bonds.are_all);
}

bool warns(const SphereFile& file, const std::string& of) {
  for (const std::string& warning : file.warnings)
    if (warning.find(of) != std::string::npos) return true;
  return false;
}

TEST(BondsOfFiles, lammps_data_by_ids) {
  const auto file_with = [](const std::string& atoms, const std::string& bonds) {
    return "title\n\n3 atoms\n1 atom types\n2 bonds\n\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\n" + bonds +
           "Atoms # atomic\n\n" + atoms + "\n";
  };
  const std::string atoms = "20 1 2 0 0\n10 1 1 0 0\n30 1 3 0 0\n";
  const std::string bonds = "Bonds\n\n1 1 10 20 # a comment\n2 c-c 30 20\n\n";
  const StatedBonds read = bonds_of(file_with(atoms, bonds), "a.data");
  EXPECT_EQ(read.list, (List{{0, 1, kUnknown}, {1, 2, kUnknown}}));
  EXPECT_TRUE(read.are_all);
  const SphereFile lacking = read_text(file_with(atoms, "Bonds\n\n1 1 10 99\n2 1 10 20\n\n"), "a.data");
  EXPECT_EQ(lacking.spheres.attributes().bonds.list, (List{{0, 1, kUnknown}}));
  EXPECT_TRUE(warns(lacking, "bonds name atoms that are not there, 1 time;"));
  const SphereFile twice = read_text(file_with("20 1 2 0 0\n10 1 1 0 0\n10 1 3 0 0\n", bonds), "a.data");
  EXPECT_TRUE(twice.spheres.attributes().bonds.empty());
  EXPECT_TRUE(warns(twice, "its bonds are left out"));
  const std::string cut = test::error_of(file_with(atoms, "Bonds\n\n1 1 10\n\n"), "a.data");
  EXPECT_NE(cut.find("the id of a bonded atom"), std::string::npos) << cut;
}

}  // namespace
}  // namespace bihive
