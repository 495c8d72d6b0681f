#include <gtest/gtest.h>

#include <cmath>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;
using test::with;

const std::string kSalt =
    "# salt, with the group by name\n"
    "data_salt\n"
    "_cell_length_a 5.64(2)\n"
    "_cell_length_b 5.64\n"
    "_cell_length_c 5.64\n"
    "_cell_angle_alpha 90\n"
    "_cell_angle_beta 90\n"
    "_cell_angle_gamma 90.0\n"
    "_symmetry_space_group_name_H-M 'F m -3 m'\n"
    "loop_\n"
    "_atom_site_label\n"
    "_atom_site_type_symbol\n"
    "_atom_site_fract_x\n"
    "_atom_site_fract_y\n"
    "_atom_site_fract_z\n"
    "_atom_site_occupancy\n"
    "_atom_site_U_iso_or_equiv\n"
    "Na1 Na1+ 0 0 0 1 0.01\n"
    "Cl1 Cl1- 0.5(1) 0.5 0.5 0.75 ?\n"
    "X1 ? ? ? ? . .\n";

const std::string kListed =
    "data_listed\n"
    "_cell_length_a 10\n_cell_length_b 20\n_cell_length_c 30\n"
    "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
    "loop_\n_symmetry_equiv_pos_as_xyz\n'x, y, z'\n-x,-y,z+1/2\n"
    "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
    "Fe1A 0.125 0.25 -0.25\nCa2 0.001 0 0.5\nOw 0.5 0.5 0.125\n";

TEST(SmallCif, FillsTheCellByTheGroup) {
  const SphereFile file = read_text(kSalt, "salt.cif");
  EXPECT_EQ(file.format, "CIF");
  // 192 operations, most of which leave an atom where it is.
  ASSERT_EQ(file.spheres.size(), 8);
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{11, 11, 11, 11, 17, 17, 17, 17}));
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{0, 0, 0}));
  for (std::int64_t id = 0; id < 8; ++id)
    for (int axis = 0; axis < 3; ++axis) {
      const double share = file.spheres.centre(id)[axis] / 5.64;
      EXPECT_NEAR(share, share < 0.25 ? 0 : 0.5, 1e-6) << id;
    }
  EXPECT_EQ(numbers_of(file, "copy")[0], 1);
  EXPECT_EQ(numbers_of(file, "occupancy")[4], 0.75);
  EXPECT_NEAR(numbers_of(file, "b_factor")[0], 0.7895683520871486, 1e-15);
  EXPECT_TRUE(std::isnan(numbers_of(file, "b_factor")[4]));
  EXPECT_EQ(file.spheres.attributes().find_texts("name")->of(7), "Cl1");
  EXPECT_NEAR(file.spheres.cell()->vectors[2].z, 5.64, 1e-12);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("1 sphere has no place"), std::string::npos);
}

// Journals put the words of a whole article before the atoms.
TEST(SmallCif, IsKnownBehindALongText) {
  std::string article = "data_article\n_publ_section_abstract\n;\n";
  for (int line = 0; line < 2000; ++line) article += "words of the article that stand before the atoms\n";
  const std::string text = with(kListed, "data_listed\n", article + ";\n");
  const SphereFile file = read_text(text, "listed.cif");
  EXPECT_EQ(file.format, "CIF");
  EXPECT_EQ(file.spheres.size(), read_text(kListed, "listed.cif").spheres.size());
}

TEST(SmallCif, TakesTheListedOperations) {
  const SphereFile file = read_text(kListed, "l.cif");
  ASSERT_EQ(file.spheres.size(), 6);
  const auto near = [&](std::int64_t id, Vec3d at) { EXPECT_LT(length(file.spheres.centre(id) - at), 1e-5) << id; };
  near(0, {1.25, 5, 22.5});
  near(1, {8.75, 15, 7.5});
  near(2, {0.01, 0, 15});
  near(3, {9.99, 0, 0});
  near(4, {5, 10, 3.75});
  near(5, {5, 10, 18.75});
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{26, 26, 20, 20, 8, 8}));
  EXPECT_EQ(numbers_of(file, "copy"), (std::vector<double>{1, 2, 1, 2, 1, 2}));
}

TEST(SmallCif, TheCellTellsHexagonalFromRhombohedralAxes) {
  // Molysite, FeCl3: two formula units in the rhombohedral cell. By the operations of the hexagonal cell it has 36
  // atoms.
  const std::string molysite =
      "data_molysite\n_cell_length_a 6.69\n_cell_length_b 6.69\n_cell_length_c 6.69\n"
      "_cell_angle_alpha 52.3\n_cell_angle_beta 52.3\n_cell_angle_gamma 52.3\n"
      "_symmetry_space_group_name_H-M 'R -3'\n"
      "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
      "Fe .3333 .3333 .3333\nCl -.256 .41 .077\n";
  EXPECT_EQ(read_text(molysite, "molysite.cif").spheres.size(), 8);
  const std::string numbered =
      with(molysite, "_symmetry_space_group_name_H-M 'R -3'", "_symmetry_Int_Tables_number 148");
  EXPECT_EQ(read_text(numbered, "molysite.cif").spheres.size(), 8);
  EXPECT_EQ(read_text(with(molysite, "'R -3'", "'R -3 :H'"), "molysite.cif").spheres.size(), 36);
  // Three times as many in the hexagonal cell.
  std::string hexagonal = with(molysite, "_cell_angle_alpha 52.3", "_cell_angle_alpha 90");
  hexagonal = with(with(hexagonal, "_cell_angle_beta 52.3", "_cell_angle_beta 90"), "_cell_angle_gamma 52.3",
                   "_cell_angle_gamma 120");
  hexagonal = with(hexagonal, ".3333 .3333 .3333", "0 0 .3333");
  EXPECT_EQ(read_text(hexagonal, "molysite.cif").spheres.size(), 24);
}

TEST(SmallCif, OperationsMayHaveDecimals) {
  const std::string decimals = with(kListed, "-x,-y,z+1/2", "-x,-y,z+.5");
  EXPECT_EQ(numbers_of(read_text(decimals, "listed.cif"), "copy"),
            numbers_of(read_text(kListed, "listed.cif"), "copy"));
  for (std::int64_t id = 0; id < read_text(kListed, "listed.cif").spheres.size(); ++id)
    EXPECT_EQ(read_text(decimals, "listed.cif").spheres.centre(id),
              read_text(kListed, "listed.cif").spheres.centre(id));
  EXPECT_EQ(read_text(with(kListed, "-x,-y,z+1/2", "-x,-y,z+0.3333"), "listed.cif").spheres.size(),
            read_text(with(kListed, "-x,-y,z+1/2", "-x,-y,z+1/3"), "listed.cif").spheres.size());
  EXPECT_NE(error_of(with(kListed, "-x,-y,z+1/2", "-x,-y,z+.123"), "listed.cif").find("'-x,-y,z+.123'"),
            std::string::npos);
}

TEST(SmallCif, UnknownGroupsKeepTheAtoms) {
  const SphereFile file = read_text(with(kSalt, "F m -3 m", "Q 17"), "salt.cif");
  EXPECT_EQ(file.spheres.size(), 2);
  EXPECT_NE(file.warnings[0].find("the space group 'Q 17' is unknown"), std::string::npos);
  EXPECT_EQ(read_text(with(kSalt, "_symmetry_space_group_name_H-M 'F m -3 m'", "_space_group_IT_number 225"), "a")
                .spheres.size(),
            8);
}

TEST(SmallCif, EachBlockIsAFrame) {
  const std::string both = kSalt + "data_empty\n_cell_length_a 1\n" + kListed;
  EXPECT_EQ(read_text(both, "a").frames, 2);
  EXPECT_EQ(read_text(both, "a", at_frame(1)).spheres.size(), 6);
  EXPECT_NE(error_of(both, "a", at_frame(2)).find("there is no frame 2"), std::string::npos);
}

TEST(SmallCif, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with(kSalt, "Na1 Na1+ 0 0 0", "Na1 Na1+ 0 x 0"), "a"),
            "a:10: block 'salt': expected a number for _atom_site_fract_y of the atom 'Na1' but found 'x'");
  EXPECT_NE(error_of(with(kSalt, "Na1 Na1+ 0 0 0", "Na1 Na1+ 0 nan 0"), "a").find("is no share of a cell"),
            std::string::npos);
  EXPECT_EQ(error_of(with(kSalt, "_cell_length_b 5.64\n", ""), "a"), "a: block 'salt': there is no _cell_length_b");
  EXPECT_NE(error_of(with(kSalt, "90.0", "180"), "a").find("make no cell"), std::string::npos);
  EXPECT_NE(error_of(with(kSalt, "_atom_site_occupancy", "_atom_site_fract_x"), "a").find("comes twice"),
            std::string::npos);
  EXPECT_EQ(error_of(with(kListed, "-x,-y,z+1/2", "-x,-y,q"), "a")
                .rfind("a:8: block 'listed': expected an operation of symmetry", 0),
            0u);
  EXPECT_EQ(error_of(with(kSalt, "0.75 ?\n", "\n"), "a"),
            "a:10:1: this is no CIF: the last row of this loop has 5 of its 7 values");
  for (std::size_t length = 0; length < kSalt.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(kSalt).substr(0, length), "a.cif", {});
}

const std::string kCube =
    "data_x\n_cell_length_a 5\n_cell_length_b 5\n_cell_length_c 5\n"
    "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n";
const std::string kSites =
    "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n";
const std::string kLabels = "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n";

bool says(const std::vector<std::string>& texts, const std::string& wanted) {
  for (const std::string& text : texts)
    if (text.find(wanted) != std::string::npos) return true;
  return false;
}

TEST(SmallCif, TagsMayHaveADot) {
  const std::string group =
      kCube + "_space_group.name_H-M_alt 'F m -3 m'\n" + kSites + "Na1 Na 0 0 0\nCl1 Cl .5 .5 .5\n";
  EXPECT_EQ(read_text(group, "a.cif").spheres.size(), 8);
  EXPECT_EQ(read_text(with(group, "name_H-M_alt 'F m -3 m'", "IT_number 225"), "a.cif").spheres.size(), 8);

  // All of the file in the newer form, which mmCIF shares. Where places of mmCIF are there too, it is mmCIF.
  std::string dotted = kListed;
  for (const char* category : {"_cell", "_atom_site"})
    for (std::size_t at = 0; (at = dotted.find(category + std::string("_"), at)) != std::string::npos;)
      dotted[at + std::string(category).size()] = '.';
  dotted = with(dotted, "_symmetry_equiv_pos_as_xyz", "_space_group_symop.operation_xyz");
  const SphereFile file = read_text(dotted, "a.cif"), same = read_text(kListed, "a.cif");
  ASSERT_EQ(file.spheres.size(), same.spheres.size());
  for (std::int64_t id = 0; id < file.spheres.size(); ++id) EXPECT_EQ(file.spheres.centre(id), same.spheres.centre(id));
  EXPECT_EQ(
      read_text("data_a\nloop_\n_atom_site.fract_x\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n0 1 "
                "2 3\n",
                "a.cif")
          .format,
      "mmCIF");
}

TEST(SmallCif, TakesOperationsAndCentringsOfMagneticFiles) {
  const std::string magnetic =
      kCube +
      "_parent_space_group.name_H-M_alt 'I -1'\n"
      "loop_\n_space_group_symop_magn_operation.id\n_space_group_symop_magn_operation.xyz\n1 x,y,z,+1\n2 -x,-y,-z,-1\n"
      "loop_\n_space_group_symop_magn_centering.id\n_space_group_symop_magn_centering.xyz\n1 x,y,z,+1\n"
      "2 x+1/2,y+1/2,z+1/2,-1\n" +
      kSites + "Fe1 Fe .125 .25 .375\n";
  const SphereFile file = read_text(magnetic, "a.mcif");
  ASSERT_EQ(file.spheres.size(), 4);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{0.625, 1.25, 1.875}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4.375, 3.75, 3.125}));
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{3.125, 3.75, 4.375}));
  EXPECT_EQ(file.spheres.centre(3), (Vec3d{1.875, 1.25, 0.625}));
  std::string older = with(magnetic, "magn_operation.xyz", "magn_operation_xyz");
  older = with(older, "magn_centering.xyz", "magn_centering_xyz");
  EXPECT_EQ(read_text(older, "a.mcif").spheres.size(), 4);
}

TEST(SmallCif, SymmetryInAnUnknownFormIsTold) {
  const std::string atom = kSites + "Fe1 Fe .125 .25 .375\n";
  const SphereFile file = read_text(kCube + "_space_group_magn.name_BNS 'P -1'\n" + atom, "a.cif");
  ASSERT_EQ(file.spheres.size(), 1);
  EXPECT_TRUE(says(file.warnings, "symmetry is stated, but not in a form that is read (_space_group_magn_name_BNS)"));
  EXPECT_FALSE(says(file.rules, "the file states none"));
  EXPECT_TRUE(says(read_text(kCube + "_parent_space_group.name_H-M_alt 'I -1'\n" + atom, "a.cif").warnings,
                   "not in a form that is read (_parent_space_group_name_H-M_alt)"));
  for (const char* none :
       {"", "_symmetry_cell_setting cubic\n", "_space_group_name_H-M_alt ?\n", "_symmetry_equiv_pos_as_xyz ?\n"}) {
    const SphereFile without = read_text(kCube + none + atom, "a.cif");
    EXPECT_TRUE(says(without.rules, "the file states none")) << none;
    EXPECT_TRUE(without.warnings.empty()) << none;
  }
}

TEST(SmallCif, LabelsInCapitalsAreReadByTheFormula) {
  const auto elements = [](const std::string& head, const std::string& labels) {
    std::string rows;
    for (std::size_t at = 0, end; at < labels.size(); at = end + 1) {
      end = std::min(labels.find(' ', at), labels.size());
      rows += labels.substr(at, end - at) + " 0." + std::to_string(10 + at) + " 0 0\n";
    }
    return read_text(kCube + head + kLabels + rows, "a.cif").spheres.attributes().element;
  };
  using AtomicNumbers = std::vector<std::uint8_t>;
  EXPECT_EQ(elements("", "C1 O1 HO1 HC1 CA2 CO3 Ca4 CL5 ZN6 AL7"), (AtomicNumbers{6, 8, 1, 1, 6, 6, 20, 17, 30, 13}));
  // The formula, or the list of types, tells two readings apart.
  EXPECT_EQ(elements("_chemical_formula_sum 'C2 CO H'\n", "CO1 HO1 C1"), (AtomicNumbers{27, 1, 6}));
  EXPECT_EQ(elements("_chemical_formula_sum 'Ca0.5 O H2'\n", "CA1 HO1 O1"), (AtomicNumbers{20, 1, 8}));
  EXPECT_EQ(elements("loop_\n_atom_type_symbol\nNi2+\nO\n", "NI1 O1"), (AtomicNumbers{28, 8}));
  EXPECT_EQ(elements("_chemical_formula_sum 'C H O'\n", "Ho1 Co1"), (AtomicNumbers{1, 6}));
  EXPECT_TRUE(says(read_text(kCube + kLabels + "HO1 0 0 0\n", "a").rules, "of labels in capitals"));
}

TEST(SmallCif, AListedImageIsNotTakenTwice) {
  const std::string head = kCube + "loop_\n_symmetry_equiv_pos_as_xyz\nx,y,z\n-x,-y,-z\n";
  const SphereFile file = read_text(head + kSites + "C1 C 0.1 0.2 0.3\nC1A C -0.1001 -0.2 -0.3\nO1 O 0 0 0\n", "a.cif");
  EXPECT_EQ(file.spheres.size(), 3);
  EXPECT_TRUE(says(file.warnings, "1 listed atom is at the place of an image of another one (first 'C1A')"));
  // Another element, and disorder that shares a place, stay.
  EXPECT_EQ(read_text(head + kSites + "C1 C 0.1 0.2 0.3\nN1 N -0.1 -0.2 -0.3\n", "a.cif").spheres.size(), 4);
  const std::string half = with(kSites, "_atom_site_fract_z\n", "_atom_site_fract_z\n_atom_site_occupancy\n");
  EXPECT_EQ(read_text(head + half + "C1 C 0.1 0.2 0.3 0.5\nC1A C -0.1 -0.2 -0.3 0.5\n", "a.cif").spheres.size(), 4);
  EXPECT_EQ(read_text(head + half + "C1 C 0.1 0.2 0.3 1\nC1A C 0.1 0.2 0.3 1\n", "a.cif").spheres.size(), 4)
      << "one place twice, without symmetry";
}

TEST(SmallCif, SmallCellsAndUnknownAnglesAreCells) {
  std::string small = kCube + kSites + "C1 C 0 0 0\nO1 O 1.1 0 0\n";
  for (const char* length : {"_a 5", "_b 5", "_c 5"}) small = with(small, length, std::string(length, 3) + "1");
  EXPECT_EQ(read_text(small, "a.cif").spheres.cell()->vectors[0], (Vec3d{1, 0, 0}));
  EXPECT_EQ(read_text(with(small, "alpha 90", "alpha ?"), "a.cif").spheres.size(), 2);
  EXPECT_EQ(error_of(with(small, "_a 1", "_a ?"), "a"), "a:2: block 'x': the value of _cell_length_a is unknown");
}

}  // namespace
}  // namespace bihive
