#include <gtest/gtest.h>

#include <cmath>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;

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
    "Fe1A 0.125 0.25 -0.25\nCA2 0.001 0 0.5\nOw 0.5 0.5 0.125\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

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
  EXPECT_EQ(error_of(with(kSalt, "0.75 ?\n", "\n"), "a").rfind("a:", 0), 0u) << "a row is too short";
  for (std::size_t length = 0; length < kSalt.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(kSalt).substr(0, length), "a.cif", {});
}

}  // namespace
}  // namespace bihive
