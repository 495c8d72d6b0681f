// Biological assemblies of PDB and mmCIF files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bihive/io/assemble/assemblies.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using test::numbers_of;
using test::read_text;
using test::texts_of;
using testing::ElementsAre;
using testing::HasSubstr;

ReadOptions with_assembly(const std::string& id) {
  ReadOptions options;
  options.assembly = id;
  return options;
}

std::vector<Vec3d> centres(const SphereFile& file) {
  std::vector<Vec3d> all;
  for (std::int64_t id = 0; id < file.spheres.size(); ++id) all.push_back(file.spheres.centre(id));
  return all;
}

// Chains A, B and a water. 1: A twice, by the identity and a half turn about z with a shift; B as it is. 2: B shifted.
const std::string kPdb =
    "REMARK 350 BIOMOLECULE: 1\n"
    "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n"
    "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000        0.00000\n"
    "REMARK 350   BIOMT1   2 -1.000000  0.000000  0.000000       10.00000\n"
    "REMARK 350   BIOMT2   2  0.000000 -1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   2  0.000000  0.000000  1.000000       -2.50000\n"
    "REMARK 350 APPLY THE FOLLOWING TO CHAINS: C,\n"
    "REMARK 350                    AND CHAINS: B\n"
    "REMARK 350   BIOMT1   3  1.000000  0.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT2   3  0.000000  1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   3  0.000000  0.000000  1.000000        0.00000\n"
    "REMARK 350\n"
    "REMARK 350 BIOMOLECULE: 2\n"
    "REMARK 350 APPLY THE FOLLOWING TO CHAINS: B\n"
    "REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT2   1  0.000000  1.000000  0.000000        0.00000\n"
    "REMARK 350   BIOMT3   1  0.000000  0.000000  1.000000      100.00000\n"
    "ATOM      1  N   ALA A   1       1.000   2.000   3.000  1.00 20.25           N\n"
    "ATOM      2  C   ALA A   1       2.000   2.000   3.000  1.00 21.25           C\n"
    "ATOM      3  O   ALA B   1       0.000   0.000   7.000  1.00 22.25           O\n"
    "HETATM    4  O   HOH W   1       9.000   9.000   9.000  1.00 30.00           O\n";

TEST(Assemblies, a_pdb_file_s_chains_are_copied) {
  const SphereFile file = read_text(kPdb, "a.pdb", with_assembly("1"));
  EXPECT_THAT(file.assemblies, ElementsAre("1", "2"));
  EXPECT_EQ(centres(file), (std::vector<Vec3d>{{1, 2, 3}, {2, 2, 3}, {9, -2, 0.5}, {8, -2, 0.5}, {0, 0, 7}}));
  EXPECT_EQ(numbers_of(file, "copy"), (std::vector<double>{1, 1, 2, 2, 3}));
  EXPECT_EQ(numbers_of(file, "b_factor"), (std::vector<double>{20.25, 21.25, 20.25, 21.25, 22.25}));
  EXPECT_THAT(texts_of(file, "chain"), ElementsAre("A", "A", "A", "A", "B"));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{7, 6, 7, 6, 8}));
  EXPECT_THAT(file.rules, testing::Contains(HasSubstr("assembly 1: 3 copies")));
  EXPECT_EQ(centres(read_text(kPdb, "a.pdb", with_assembly("2"))), (std::vector<Vec3d>{{0, 0, 107}}));
}

TEST(Assemblies, without_the_option_nothing_changes) {
  const SphereFile file = read_text(kPdb, "a.pdb");
  EXPECT_EQ(file.spheres.size(), 4);
  EXPECT_THAT(file.assemblies, ElementsAre("1", "2"));
  EXPECT_EQ(file.spheres.attributes().find_numbers("copy"), nullptr);
}

// Label chains A and B are both chain X of the authors. 1: a product of two groups on A; Z: the identity on B.
std::string mmcif(const std::string& generators) {
  std::string text =
      "data_T\nloop_\n_pdbx_struct_assembly_gen.assembly_id\n_pdbx_struct_assembly_gen.oper_expression\n"
      "_pdbx_struct_assembly_gen.asym_id_list\n" +
      generators + "loop_\n_pdbx_struct_oper_list.id\n";
  for (const char* const row : {"1", "2", "3"}) {
    for (const char* const column : {"1", "2", "3"})
      text += std::string("_pdbx_struct_oper_list.matrix[") + row + "][" + column + "]\n";
    text += std::string("_pdbx_struct_oper_list.vector[") + row + "]\n";
  }
  return text +
         "1 1 0 0 0 0 1 0 0 0 0 1 0\n"
         "2 1 0 0 5 0 1 0 0 0 0 1 0\n"
         "P 0 -1 0 0 1 0 0 0 0 0 1 1\n"
         "bad 1 0 0 ? 0 1 0 0 0 0 1 0\n"
         "loop_\n_atom_site.type_symbol\n_atom_site.label_asym_id\n_atom_site.auth_asym_id\n"
         "_atom_site.label_alt_id\n_atom_site.label_atom_id\n_atom_site.auth_seq_id\n_atom_site.occupancy\n"
         "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
         "C A X a CA 1 0.2 50 50 50\nC A X b CA 1 0.8 1 0 0\nO B X . O 2 1 0 3 0\n";
}

TEST(Assemblies, mmcif_uses_label_chains_and_products_of_operators) {
  const std::string text = mmcif("1 '(P)(1-2)' 'A'\nZ 1\n;B,\nQ\n;\n");
  const SphereFile file = read_text(text, "a.cif", with_assembly("1"));
  EXPECT_THAT(file.assemblies, ElementsAre("1", "Z"));
  // First 1 or 2, then a quarter turn about z and a step along z. The likelier alternate alone is copied.
  EXPECT_EQ(centres(file), (std::vector<Vec3d>{{0, 1, 1}, {0, 6, 1}}));
  EXPECT_THAT(texts_of(file, "chain"), ElementsAre("X", "X"));
  EXPECT_TRUE(texts_of(file, "label_chain").empty());
  EXPECT_EQ(centres(read_text(text, "a.cif", with_assembly("Z"))), (std::vector<Vec3d>{{0, 3, 0}}));
  EXPECT_EQ(read_text(text, "a.cif").spheres.size(), 2);
}

TEST(Assemblies, single_items_and_lists_of_operators) {
  const std::string items =
      "data_T\n_pdbx_struct_assembly_gen.assembly_id 1\n"
      "_pdbx_struct_assembly_gen.oper_expression 1,2\n_pdbx_struct_assembly_gen.asym_id_list A,B\n";
  const std::string text = items + mmcif("9 1 A\n").substr(std::string("data_T\n").size());
  EXPECT_EQ(read_text(text, "a.cif", with_assembly("1")).spheres.size(), 4);
  EXPECT_EQ(read_text(text, "a.cif", with_assembly("9")).spheres.size(), 1);
}

TEST(Assemblies, faults_are_named) {
  const auto error = [](const std::string& text, const std::string& name, const std::string& id) {
    return error_of(text, name, with_assembly(id));
  };
  EXPECT_THAT(error(kPdb, "a.pdb", "7"),
              testing::AllOf(HasSubstr("a.pdb"), HasSubstr("'7'"), HasSubstr("there are 1, 2")));
  EXPECT_THAT(error("1\n\nC 0 0 0\n", "a.xyz", "1"), HasSubstr("no assemblies"));
  EXPECT_THAT(error(mmcif("1 4 A\n"), "a.cif", "1"), HasSubstr("operator '4'"));
  EXPECT_THAT(error(mmcif("1 bad A\n"), "a.cif", "1"), HasSubstr("lacks a number"));
  EXPECT_THAT(error(mmcif("1 '(1' A\n"), "a.cif", "1"), HasSubstr("cannot be read"));
  EXPECT_THAT(error(mmcif("1 1-99999999999 A\n"), "a.cif", "1"), HasSubstr("too many"));
  EXPECT_THAT(error(mmcif("1 2-1 A\n"), "a.cif", "1"), HasSubstr("operators"));
  EXPECT_THAT(error(mmcif("1 1 C\n"), "a.cif", "1"), HasSubstr("no atom"));
  EXPECT_EQ(read_text(mmcif("1 bad A\n"), "a.cif").spheres.size(), 2) << "asked for or not makes the difference";
}

}  // namespace
}  // namespace bihive
