#include <gtest/gtest.h>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;

const std::string kTags =
    "loop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_alt_id\n"
    "_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.Cartn_x\n"
    "_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.B_iso_or_equiv\n"
    "_atom_site.auth_seq_id\n_atom_site.auth_asym_id\n_atom_site.pdbx_PDB_model_num\n";

std::vector<double> xs(const SphereFile& file) {
  std::vector<double> x;
  for (std::int64_t id = 0; id < file.spheres.size(); ++id) x.push_back(file.spheres.centre(id).x);
  return x;
}
using Xs = std::vector<double>;

TEST(Mmcif, TakesAtomsInFileOrder) {
  const SphereFile file = read_text("# a comment\ndata_TEST\n_entry.id TEST\n#\n" + kTags +
                                        "ATOM   N N   . A 1 ? 1.5 2.5 -3.5 1.00 20.5 1 A 1\n"
                                        "HETATM ZN 'ZN A' . B . ? 4 5 6 ? . 301 B 1\n"
                                        "ATOM   C \"C1'\" . A 2 ? 7.25(3) 8\n9 0.5 10 2 A 1\n"
                                        "#\nloop_\n_other.x\n_other.y\n1 2\n",
                                    "a.cif");
  EXPECT_EQ(file.format, "mmCIF");
  EXPECT_EQ(file.frames, 1);
  ASSERT_EQ(file.spheres.size(), 3);
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1.5, 2.5, -3.5}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{7.25, 8, 9}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{7, 30, 6}));
  EXPECT_FLOAT_EQ(static_cast<float>(file.spheres.radius(0)), 1.55f);
  EXPECT_EQ(numbers_of(file, "occupancy"), (std::vector<double>{1, 1, 0.5}));
  EXPECT_EQ(numbers_of(file, "b_factor"), (std::vector<double>{20.5, 0, 10}));
}

TEST(Mmcif, TakesTheNamesThatSelectionsAskFor) {
  const SphereFile file = read_text(
      "data_T\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
      "_atom_site.label_comp_id\n_atom_site.auth_comp_id\n_atom_site.label_asym_id\n_atom_site.label_entity_id\n"
      "_atom_site.label_seq_id\n_atom_site.auth_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
      "ATOM   C \"C1'\" DA . C 1 4 -3 0 0 0\n"
      "HETATM O O HOH WAT D 2 . 77 1 0 0\n",
      "a.cif");
  ASSERT_EQ(file.spheres.size(), 2);
  const SphereAttributes& attributes = file.spheres.attributes();
  const auto texts = [&](const char* name) {
    const NamedTexts* const column = attributes.find_texts(name);
    return column ? std::vector<std::string>{column->of(0), column->of(1)} : std::vector<std::string>();
  };
  EXPECT_EQ(texts("record"), (std::vector<std::string>{"ATOM", "HETATM"}));
  EXPECT_EQ(texts("name"), (std::vector<std::string>{"C1'", "O"}));
  EXPECT_EQ(texts("resname"), (std::vector<std::string>{"DA", "WAT"})) << "the author's, else the label's";
  EXPECT_EQ(texts("chain"), (std::vector<std::string>{"C", "D"}));
  EXPECT_EQ(texts("entity"), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(numbers_of(file, "resid"), (std::vector<double>{-3, 77}));
}

TEST(Mmcif, TakesTheLikeliestOfAlternateLocations) {
  const SphereFile file = read_text("data_T\n" + kTags +
                                        "ATOM C CA A A 1 ? 0 0 0 0.3 0 1 A 1\n"
                                        "ATOM C CB A A 1 ? 1 0 0 0.5 0 1 A 1\n"
                                        "ATOM C CA B A 1 ? 2 0 0 0.7 0 1 A 1\n"
                                        "ATOM C CB B A 1 ? 3 0 0 0.5 0 1 A 1\n"
                                        "ATOM C CA B A 1 X 4 0 0 0.1 0 1 A 1\n"
                                        "HETATM O O A W . ? 5 0 0 0.5 0 901 A 1\n"
                                        "HETATM O O B W . ? 6 0 0 0.5 0 902 A 1\n"
                                        "HETATM O O '' W . ? 7 0 0 0.5 0 902 A 1\n",
                                    "a.cif");
  EXPECT_EQ(xs(file), (Xs{1, 2, 4, 5, 6, 7}));
}

TEST(Mmcif, TakesTheModelAskedFor) {
  const std::string text = "data_T\n" + kTags +
                           "ATOM C CA . A 1 ? 1 0 0 1 0 1 A 1\nATOM C CA . A 1 ? 2 0 0 1 0 1 A 4\n"
                           "ATOM C CA . A 2 ? 3 0 0 1 0 2 A 4\nATOM C CA . A 2 ? 4 0 0 1 0 2 A 1\n";
  EXPECT_EQ(read_text(text, "a.cif").frames, 2);
  EXPECT_EQ(xs(read_text(text, "a.cif")), (Xs{1, 4}));
  EXPECT_EQ(xs(read_text(text, "a.cif", at_frame(1))), (Xs{2, 3}));
  EXPECT_EQ(error_of(text, "a.cif", at_frame(2)),
            "a.cif: there is no frame 2: the file has 2 (0 to 1); choose one with frame, counting from 0");
}

TEST(Mmcif, TakesASingleAtomOutsideALoopAndTheFirstBlockWithAtoms) {
  const std::string pairs =
      "data_EMPTY\n_entry.id E\ndata_ONE\n_atom_site.type_symbol O\n_atom_site.Cartn_x 1\n_atom_site.Cartn_y 2\n"
      "_atom_site.Cartn_z 3\n_other.x 9\n";
  EXPECT_EQ(read_text(pairs, "a.cif").spheres.centre(0), (Vec3d{1, 2, 3}));
  const SphereFile two = read_text(
      pairs + "data_TWO\nLOOP_\n_ATOM_SITE.CARTN_X\n_atom_site.cartn_y\n_atom_site.Cartn_z\n7 8 9\n", "a.cif");
  EXPECT_EQ(xs(two), (Xs{1}));
  EXPECT_EQ(two.frames, 1);
}

TEST(Mmcif, NamesLineAndColumnOfAFault) {
  const std::string head = "data_T\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n1 2 3\n";
  EXPECT_EQ(error_of(head + "4 nan 6\n", "a.cif"), "a.cif:7:3: Cartn_y is not finite: 'nan'");
  EXPECT_EQ(error_of(head + "4 5 6x\n", "a.cif"), "a.cif:7:5: expected a number for Cartn_z but found '6x'");
  EXPECT_EQ(error_of(head + "4 5\n", "a.cif"), "a.cif:7:3: the last row of this loop has 2 of its 3 values");
  EXPECT_EQ(error_of("data_T\n_cell.length_a 1\n", "a.cif"),
            "a.cif: there is no _atom_site category with Cartn_x, Cartn_y and Cartn_z in it; bihive reads the "
            "atoms of mmCIF files alone");
  EXPECT_EQ(error_of(head + "1 2 'open\n", "a.cif"), "a.cif:7:10: this is no CIF: unterminated 'string'");
  EXPECT_EQ(error_of("nothing of the kind\n", "a.cif"), "a.cif:1:1: this is no CIF: expected block header (data_)");
}

TEST(Mmcif, RefusesTwoColumnsOfOneName) {
  EXPECT_EQ(
      error_of(
          "data_T\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.CARTN_X\n1 2 3 4\n",
          "a.cif"),
      "a.cif:6:1: the item _atom_site.CARTN_X stands twice in one table");
  EXPECT_EQ(error_of("data_T\n_atom_site.Cartn_x 1\n_atom_site.Cartn_x 2\n", "a.cif"),
            "a.cif:3:1: the item _atom_site.Cartn_x stands twice in one table");
}

TEST(Mmcif, NamesTheKindOfCifWithoutAtomsOfIts) {
  const std::string none = "a.cif: there is no _atom_site category with Cartn_x, Cartn_y and Cartn_z in it";
  EXPECT_EQ(error_of("data_T\nloop_\n_chem_comp_atom.atom_id\n_chem_comp_atom.x\nC 1\n", "a.cif"),
            none +
                ": this CIF describes a monomer (_chem_comp_atom) without coordinates; take its file from the "
                "Chemical Component Dictionary");
  EXPECT_EQ(error_of("data_T\nloop_\n_refln.index_h\n1\n", "a.cif"),
            none + ": this CIF holds reflections, not atoms; take the entry's file of coordinates");
}

TEST(Mmcif, KeepsOneOfSeveralResiduesAtOnePlaceAsAWhole) {
  const std::string head =
      "data_T\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.occupancy\n"
      "_atom_site.label_alt_id\n_atom_site.auth_asym_id\n_atom_site.auth_seq_id\n_atom_site.auth_comp_id\n"
      "_atom_site.auth_atom_id\n";
  const SphereFile file = read_text(head +
                                        "0 0 0 1 . A 14 GLY CA\n"
                                        "1 0 0 0.50 A A 15 LYS CA\n2 0 0 0.50 A A 15 LYS CE\n"
                                        "3 0 0 0.25 B A 15 GLU CA\n4 0 0 0.25 B A 15 GLU OE1\n"
                                        "5 0 0 0.25 C A 15 ARG CA\n6 0 0 0.90 C A 15 ARG NE\n",
                                    "a.cif");
  EXPECT_EQ(xs(file), (Xs{0, 5, 6})) << "arginine has the highest mean";
}

TEST(Mmcif, WarnsOfALastLineWithoutEnd) {
  const SphereFile file = read_text(
      "data_T\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.type_symbol\n1 2 3 C\n1 2 "
      "3 C",
      "a.cif");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "the last line of a.cif has no end: the file may be cut");
}

TEST(Mmcif, TypeSymbolsMayHaveACharge) {
  const SphereFile file = read_text(
      "data_T\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\nN1+ 1 2 3\nO1- 2 2 3\nZN2+ 3 2 3\nFe3+ 4 2 3\nC 5 2 3\nC1 6 2 3\n",
      "a.cif");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{7, 8, 30, 26, 6, 0}));
}

TEST(Mmcif, AtomsWithoutPlaceAreLeftOut) {
  const SphereFile file = read_text(
      "data_T\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.auth_seq_id\n1 2 3 7\n? ? "
      "? "
      "8\n4 . 5 9\n6 7 8 10\n",
      "a.cif");
  EXPECT_EQ(xs(file), (Xs{1, 6}));
  EXPECT_EQ(numbers_of(file, "resid"), (std::vector<double>{7, 10}));
  ASSERT_FALSE(file.warnings.empty());
  EXPECT_NE(file.warnings[0].find("2 spheres have no place"), std::string::npos) << file.warnings[0];
}

TEST(Mmcif, TakesMonomersByTheirIdealCoordinates) {
  const std::string tags =
      "loop_\n_chem_comp_atom.comp_id\n_chem_comp_atom.atom_id\n_chem_comp_atom.type_symbol\n_chem_comp_atom.charge\n"
      "_chem_comp_atom.model_Cartn_x\n_chem_comp_atom.model_Cartn_y\n_chem_comp_atom.model_Cartn_z\n"
      "_chem_comp_atom.pdbx_model_Cartn_x_ideal\n_chem_comp_atom.pdbx_model_Cartn_y_ideal\n"
      "_chem_comp_atom.pdbx_model_Cartn_z_ideal\n";
  const std::string text =
      "data_LIG\n" + tags + "LIG \"C1'\" C 0 9 9 9 1 2 3\nLIG CL1 CL -1 9 9 9 4 5 6\nLIG H1 H 0 9 9 9 ? ? ?\n";
  const SphereFile file = read_text(text, "LIG.cif");
  ASSERT_EQ(file.spheres.size(), 3) << "more atoms have a place in the structure";
  EXPECT_EQ(xs(file), (Xs{9, 9, 9}));
  const std::string ideal = text.substr(0, text.find("LIG H1"));
  EXPECT_EQ(xs(read_text(ideal, "LIG.cif")), (Xs{1, 4}));
  EXPECT_EQ(read_text(ideal, "a").spheres.attributes().element, (std::vector<std::uint8_t>{6, 17}));
  EXPECT_EQ(read_text(ideal, "a").spheres.attributes().find_texts("name")->of(0), "C1'");
  EXPECT_EQ(numbers_of(read_text(ideal, "a"), "charge"), (std::vector<double>{0, -1}));

  // Libraries of monomers have a block for each.
  const std::string library =
      "data_comp_list\nloop_\n_chem_comp.id\nA\ndata_comp_A\nloop_\n_chem_comp_atom.atom_id\n_chem_comp_atom.type_"
      "symbol\n"
      "_chem_comp_atom.x\n_chem_comp_atom.y\n_chem_comp_atom.z\nO O 7 8 9\n" +
      ideal;
  EXPECT_EQ(read_text(library, "a").frames, 2);
  EXPECT_EQ(xs(read_text(library, "a")), (Xs{7}));
  EXPECT_EQ(xs(read_text(library, "a", at_frame(1))), (Xs{1, 4}));
  EXPECT_NE(error_of(library, "a", at_frame(2)).find("there is no frame 2"), std::string::npos);
  EXPECT_NE(error_of(ideal + "LIG X X 0 9 9 9 1 nan 3\n", "a").find("is not finite: 'nan'"), std::string::npos);
}

}  // namespace
}  // namespace bihive
