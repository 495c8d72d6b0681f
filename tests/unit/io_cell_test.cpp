// Periodic cells: what files state, and where centres go by them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using test::read_text;

const std::string kAtom = "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N\n";

Cell cell_of(const SphereFile& file) {
  EXPECT_TRUE(file.spheres.cell().has_value());
  return file.spheres.cell().value_or(Cell{});
}

void expect_near(Vec3d a, Vec3d b) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-12);
}

TEST(Cell, OfPdbHasItsFirstVectorAlongX) {
  const Cell hexagonal =
      cell_of(read_text("CRYST1   60.000   40.000   80.000  90.00  90.00 120.00 P 61         12\n" + kAtom, "a.pdb"));
  expect_near(hexagonal.vectors[0], {60, 0, 0});
  expect_near(hexagonal.vectors[1], {-20, 20 * std::sqrt(3.0), 0});
  expect_near(hexagonal.vectors[2], {0, 0, 80});
  const Cell tilted =
      cell_of(read_text("CRYST1   10.000   10.000   10.000  60.00  60.00  60.00 P 1\n" + kAtom, "a.pdb"));
  for (const Vec3d& vector : tilted.vectors) EXPECT_NEAR(length(vector), 10, 1e-12);
  EXPECT_NEAR(dot(tilted.vectors[0], tilted.vectors[2]), 50, 1e-12);
  EXPECT_NEAR(dot(tilted.vectors[1], tilted.vectors[2]), 50, 1e-12);
}

TEST(Cell, OfPdbWithoutACrystalIsNone) {
  for (const char* record : {"CRYST1    1.000    1.000    1.000  90.00  90.00  90.00 P 1\n",
                             "CRYST1    0.000    0.000    0.000  90.00  90.00  90.00 P 1\n", "CRYST1\n",
                             "CRYST1   10.000   10.000   10.000  10.00  20.00 120.00 P 1\n", ""})
    EXPECT_FALSE(read_text(record + kAtom, "a.pdb").spheres.cell().has_value()) << record;
}

TEST(Cell, OfMmcifIsThatOfItsBlock) {
  const std::string atoms =
      "loop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.type_symbol\n1 2 3 C\n";
  const std::string cell =
      "_cell.length_a 10(1)\n_cell.length_b 20.5\n_cell.length_c 30\n_cell.angle_alpha 90\n_cell.angle_beta 90\n"
      "_cell.angle_gamma 90\n";
  const Cell found = cell_of(read_text("data_a\n" + cell + atoms, "a.cif"));
  expect_near(found.vectors[0], {10, 0, 0});
  expect_near(found.vectors[1], {0, 20.5, 0});
  expect_near(found.vectors[2], {0, 0, 30});
  EXPECT_EQ(cell_of(read_text("data_a\n" + atoms + cell, "a.cif")).vectors, found.vectors);
  const std::string loop =
      "loop_\n_cell.entry_id\n_cell.length_a\n_cell.length_b\n_cell.length_c\n_cell.angle_alpha\n"
      "_cell.angle_beta\n_cell.angle_gamma\n_cell.Z_PDB\n9 10 20.5 30 90 90 90 4\n9 1 1 1 1 1 1 4\n";
  EXPECT_EQ(cell_of(read_text("data_a\n" + loop + atoms, "a.cif")).vectors, found.vectors);
  EXPECT_FALSE(read_text("data_a\n" + cell + "data_b\n" + atoms, "a.cif").spheres.cell().has_value());
}

TEST(Cell, OfExtendedXyzIsTheLatticeOfItsFrame) {
  const std::string frames =
      "1\nLattice=\"1 2 3 4 5 6 7 8 10\" Properties=species:S:1:pos:R:3\nC 0 0 0\n"
      "1\nProperties=species:S:1:pos:R:3 Lattice='2 0 0 0 2 0 0 0 2' Origin=\"-1 -2 -3\"\nC 0 0 0\n1\n\nC 0 0 0\n";
  EXPECT_EQ(cell_of(read_text(frames, "a.xyz")), (Cell{{}, {Vec3d{1, 2, 3}, Vec3d{4, 5, 6}, Vec3d{7, 8, 10}}}));
  EXPECT_EQ(cell_of(read_text(frames, "a.xyz", test::at_frame(1))),
            (Cell{{-1, -2, -3}, {Vec3d{2, 0, 0}, Vec3d{0, 2, 0}, Vec3d{0, 0, 2}}}));
  EXPECT_FALSE(read_text(frames, "a.xyz", test::at_frame(2)).spheres.cell().has_value());
  EXPECT_NE(error_of("1\nLattice=\"1 2 3\"\nC 0 0 0\n", "a.xyz").find("a.xyz:2: expected nine finite numbers"),
            std::string::npos);
  EXPECT_NE(error_of("1\nLattice=\"1 0 0 0 1 0 0 0 nan\"\nC 0 0 0\n", "a.xyz").find("nine finite"), std::string::npos);
}

std::string dump(const std::string& box, const std::string& atoms = "1 0 0 0\n",
                 const std::string& columns = "id x y z") {
  return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(std::count(atoms.begin(), atoms.end(), '\n')) +
         "\nITEM: BOX BOUNDS " + box + "ITEM: ATOMS " + columns + "\n" + atoms;
}

TEST(Cell, OfLammpsIsItsBox) {
  EXPECT_EQ(cell_of(read_text(dump("pp pp pp\n-1 1\n0 4\n10 20\n"), "a.dump")),
            (Cell{{-1, 0, 10}, {Vec3d{2, 0, 0}, Vec3d{0, 4, 0}, Vec3d{0, 0, 10}}}));
  EXPECT_EQ(cell_of(read_text(dump("xy xz yz pp pp pp\n0 3 1\n0 2 0\n0 5 0\n"), "a.dump")),
            (Cell{{}, {Vec3d{2, 0, 0}, Vec3d{1, 2, 0}, Vec3d{0, 0, 5}}}));
}

ReadOptions with(Wrapping wrapping) {
  ReadOptions options;
  options.wrapping = wrapping;
  return options;
}

TEST(Wrap, BringsEveryCentreIntoTheCell) {
  const std::string box = "xy xz yz pp pp pp\n-1 3.5 1.5\n0 2 0\n0 5 0\n";
  std::string atoms;
  for (int i = -20; i <= 20; ++i)
    atoms += std::to_string(i) + " " + std::to_string(0.71 * i) + " " + std::to_string(-1.3 * i) + " " +
             std::to_string(i * i * 0.37 - 40) + "\n";
  const SphereFile before = read_text(dump(box, atoms), "a.dump");
  const SphereFile after = read_text(dump(box, atoms), "a.dump", with(Wrapping::wrap));
  const Cell cell = cell_of(after);
  for (std::int64_t id = 0; id < after.spheres.size(); ++id) {
    // The cell's vectors are (3, 0, 0), (1.5, 2, 0), (0, 0, 5).
    const Vec3d at = after.spheres.centre(id) - cell.origin;
    const double b = at.y / 2, c = at.z / 5, a = (at.x - 1.5 * b) / 3;
    for (const double share : {a, b, c}) {
      EXPECT_GE(share, -1e-6);
      EXPECT_LT(share, 1 + 1e-6);
    }
    const Vec3d by = before.spheres.centre(id) - after.spheres.centre(id);
    const double nb = by.y / 2, nc = by.z / 5, na = (by.x - 1.5 * nb) / 3;
    for (const double n : {na, nb, nc}) EXPECT_NEAR(n, std::round(n), 1e-5);
  }
}

TEST(Wrap, PutsTheFarBorderOnTheNearOne) {
  const SphereFile file =
      read_text(dump("pp pp pp\n0 1\n0 1\n0 1\n", "1 1 0 -1\n2 -1e-30 0.5 7.25\n"), "a.dump", with(Wrapping::wrap));
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{0, 0, 0}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{0, 0.5, 0.25}));
}

TEST(Unwrap, GoesByImageFlagsBeforeMolecules) {
  const SphereFile file =
      read_text(dump("pp pp pp\n0 10\n0 10\n0 10\n", "7 9 0 0 0 0 0\n7 1 0 0 1 0 -2\n", "mol x y z ix iy iz"), "a.dump",
                with(Wrapping::unwrap));
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{9, 0, 0}));
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{11, 0, -20}));
  EXPECT_NE(error_of(dump("pp pp pp\n0 10\n0 10\n0 10\n", "9 0 0 0.5 0 0\n", "x y z ix iy iz"), "a.dump",
                     with(Wrapping::unwrap))
                .find("whole numbers"),
            std::string::npos);
}

TEST(Unwrap, KeepsMoleculesTogether) {
  // A chain of molecule 7 that leaves the cell twice, and a single atom of another one in between.
  const SphereFile file = read_text(
      dump("pp pp pp\n0 10\n0 10\n0 10\n", "7 8 5 5\n3 1 1 1\n7 1 5 5\n7 4 5 9\n7 7 5 2\n7 0.5 5 2\n", "mol x y z"),
      "a.dump", with(Wrapping::unwrap));
  const std::array<Vec3d, 6> expected{Vec3d{8, 5, 5},  Vec3d{1, 1, 1},   Vec3d{11, 5, 5},
                                      Vec3d{14, 5, 9}, Vec3d{17, 5, 12}, Vec3d{20.5, 5, 12}};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(file.spheres.centre(static_cast<std::int64_t>(i)), expected[i]) << i;
}

const std::string kTwoWaters =
    "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1           1\n"
    "HETATM    1  O   HOH A   1       9.800   5.000   5.000  1.00  0.00           O\n"
    "HETATM    2  H1  HOH A   1       0.400   5.500   5.000  1.00  0.00           H\n"
    "HETATM    3  H2  HOH A   1       0.500   5.900   5.000  1.00  0.00           H\n"
    "HETATM    4  O   HOH A   2       0.200   5.000   5.000  1.00  0.00           O\n"
    "HETATM    5  H1  HOH A   2       9.600   5.500   5.000  1.00  0.00           H\n";

std::vector<double> all_x(const SphereFile& file) {
  std::vector<double> x;
  for (std::int64_t id = 0; id < file.spheres.size(); ++id)
    x.push_back(std::round(file.spheres.centre(id).x * 1000) / 1000);
  return x;
}

TEST(Unwrap, MakesResiduesWhole) {
  const SphereFile file = read_text(kTwoWaters, "a.pdb", with(Wrapping::unwrap));
  EXPECT_EQ(all_x(file), (std::vector<double>{9.8, 10.4, 10.5, 0.2, -0.4}));
  EXPECT_NE(std::find(file.rules.begin(), file.rules.end(),
                      "unwrapped: the spheres of a residue (chain, number and name) each next to the one before"),
            file.rules.end());
  const SphereFile gro = read_text(
      "two\n 2\n    1SOL     OW    1   0.950   1.000   1.000\n"
      "    1SOL    HW1    2   0.050   1.000   1.000\n   1.0 1.0 1.0\n",
      "a.gro", with(Wrapping::unwrap));
  EXPECT_EQ(all_x(gro)[1], 10.5);
}

TEST(Unwrap, GoesAlongBondsInWhateverOrder) {
  const std::string head = "@<TRIPOS>MOLECULE\nchain\n4 3\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n";
  const std::string atoms = "1 C1 9 5 5 C.3 1 A\n2 C2 7 5 5 C.3 1 A\n3 C3 2 5 5 C.3 1 A\n4 C4 0.5 5 5 C.3 1 A\n";
  const std::string bonds = "@<TRIPOS>BOND\n1 1 4 1\n2 4 3 1\n3 99 2 1\n";
  const std::string cell = "@<TRIPOS>CRYSIN\n10 10 10 90 90 90 1 1\n";
  const SphereFile file = read_text(head + atoms + bonds + cell, "a.mol2", with(Wrapping::unwrap));
  EXPECT_EQ(all_x(file), (std::vector<double>{9, 7, 12, 10.5}));
  EXPECT_EQ(file.rules.back(), "unwrapped: along the bonds that the file states");
  ReadOptions options = with(Wrapping::unwrap);
  options.cell_vectors = {Vec3d{10, 0, 0}, Vec3d{0, 10, 0}, Vec3d{0, 0, 10}};
  const std::string sdf =
      "two\n\n\n  2  1  0  0  0  0            999 V2000\n"
      "    9.0000    0.0000    0.0000 C   0  0\n    0.5000    0.0000    0.0000 O   0  0\n  1  2  1  0\nM  END\n";
  EXPECT_EQ(all_x(read_text(sdf, "a.sdf", options)), (std::vector<double>{9, 10.5}));
}

// Two residues of a chain on either side of the cell's border, a water, and an atom whose number two atoms have.
const std::string kLinkedResidues =
    "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1           1\n"
    "ATOM      7  CA  ALA A   1       9.000   5.000   5.000  1.00  0.00           C\n"
    "ATOM      8  C   ALA A   1       9.900   5.000   5.000  1.00  0.00           C\n"
    "ATOM      9  N   GLY A   2       0.800   5.000   5.000  1.00  0.00           N\n"
    "ATOM     10  CA  GLY A   2       1.700   5.000   5.000  1.00  0.00           C\n"
    "HETATM   11  O   HOH A   3       0.500   1.000   1.000  1.00  0.00           O\n"
    "HETATM   12 NA    NA A   4       1.000   1.000   1.000  1.00  0.00          NA\n"
    "HETATM   12 CL    CL A   5       9.500   1.000   1.000  1.00  0.00          CL\n";

TEST(Unwrap, JoinsResiduesAlongConect) {
  const std::vector<double> apart{9, 9.9, 0.8, 1.7, 0.5, 1, 9.5}, together{9, 9.9, 10.8, 11.7, 0.5, 1, 9.5};
  const auto x_with = [](const std::string& records) {
    return all_x(read_text(kLinkedResidues + records, "a.pdb", with(Wrapping::unwrap)));
  };
  EXPECT_EQ(x_with(""), apart);
  EXPECT_EQ(x_with("CONECT    8    7    9\nCONECT    9    8\n"), together);
  EXPECT_EQ(x_with("CONECT    9    8\r\n"), together);
  EXPECT_EQ(x_with("CONECT 9 8\n"), together);
  // Numbers that no atom has, or two atoms, and what is no number.
  EXPECT_EQ(x_with("CONECT   11   12\nCONECT    8   99\nCONECT\nCONECT    x    9\nCONECT    8\n"), apart);
  const SphereFile file = read_text(kLinkedResidues + "CONECT    8    9\n", "a.pdb", with(Wrapping::unwrap));
  EXPECT_EQ(file.rules.back(),
            "unwrapped: along the bonds that the file states, and the spheres of a residue (chain, number and name) "
            "each next to the one before");
}

TEST(Unwrap, KnowsConectOfWideNumbersAndOfAlternates) {
  const std::string cell = "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1           1\n";
  const std::string wide =
      "HETATM100000  C   LIG A   1       9.500   5.000   5.000  1.00  0.00           C\n"
      "HETATM100001  O   LIG A   2       0.500   5.000   5.000  1.00  0.00           O\n";
  EXPECT_EQ(all_x(read_text(cell + wide + "CONECT100000 100001\n", "a.pdb", with(Wrapping::unwrap))),
            (std::vector<double>{9.5, 10.5}));
  const std::string alternates =
      "HETATM    1  C  ALIG A   1       5.000   5.000   5.000  0.40  0.00           C\n"
      "HETATM    2  C  BLIG A   1       9.500   5.000   5.000  0.60  0.00           C\n"
      "HETATM    3  O   HOH A   2       0.500   5.000   5.000  1.00  0.00           O\n";
  EXPECT_EQ(all_x(read_text(cell + alternates + "CONECT    2    3\n", "a.pdb", with(Wrapping::unwrap))),
            (std::vector<double>{9.5, 10.5}));
}

TEST(Wrap, MovesWholeMoleculesByTheirMiddle) {
  const SphereFile file = read_text(kTwoWaters, "a.pdb", with(Wrapping::wrap_molecules));
  EXPECT_EQ(all_x(file), (std::vector<double>{-0.2, 0.4, 0.5, 10.2, 9.6}));
  EXPECT_EQ(file.rules.back(), "wrapped: every molecule as a whole, its middle into the cell");
  EXPECT_NE(error_of(dump("pp pp pp\n0 10\n0 10\n0 10\n", "1 9 0 0\n"), "a.dump", with(Wrapping::wrap_molecules))
                .find("nothing says which spheres belong together"),
            std::string::npos);
}

TEST(Cell, PbcOfExtendedXyzCountsForDistances) {
  const auto periodic = [](const std::string& flags) {
    return cell_of(read_text("1\nLattice=\"2 0 0 0 2 0 0 0 2\"" + flags + "\nO 0 0 0\n", "a.xyz")).periodic;
  };
  EXPECT_EQ(periodic(""), (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(periodic(" pbc=\"T T F\""), (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(periodic(" pbc=[true, False, 1]"), (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(periodic(" pbc=maybe"), (std::array<bool, 3>{true, true, true}));
}

TEST(Cell, DefaultRadiiSeeImages) {
  const std::string text = dump("pp pp pp\n0 10\n0 10\n0 10\n", "1 0.5 5 5\n2 9.5 5 5\n");
  EXPECT_EQ(read_text(text, "a.dump").spheres.radius(0), 0.5);
  ReadOptions options;
  options.periodic = false;
  const SphereFile alone = read_text(text, "a.dump", options);
  EXPECT_EQ(alone.spheres.radius(0), 4.5);
  EXPECT_EQ(cell_of(alone).periodic, (std::array<bool, 3>{}));
  EXPECT_EQ(read_text(dump("pp pp pp\n0 6\n0 10\n0 10\n", "1 1 1 1\n"), "a.dump").spheres.radius(0), 3)
      << "its own image is the nearest";
  // The same place on two borders of the cell.
  EXPECT_EQ(read_text(dump("pp pp pp\n0 8\n0 9\n0 9\n", "1 0 5 5\n2 8 5 5\n3 2 5 5\n"), "a.dump").spheres.radius(0), 1);
}

TEST(Cell, OfEachPdbModelIsItsOwn) {
  const auto cell = [](const std::string& length) {
    return "CRYST1   " + length + "   40.000   80.000  90.00  90.00  90.00 P 1           1\n";
  };
  const std::string model = "MODEL        1\n" + kAtom + "ENDMDL\n";
  const auto length_in = [](const std::string& text, std::int64_t frame) {
    return cell_of(read_text(text, "a.pdb", test::at_frame(frame))).vectors[0].x;
  };
  const std::string each = cell("50.000") + model + cell("60.000") + model + model + cell("70.000") + model;
  EXPECT_EQ(length_in(each, 0), 50);
  EXPECT_EQ(length_in(each, 1), 60);
  EXPECT_EQ(length_in(each, 2), 60);
  EXPECT_EQ(length_in(each, 3), 70);
  // Where none stands before the model's end, the first behind it counts.
  EXPECT_EQ(length_in(model + cell("50.000") + model + cell("60.000"), 0), 50);
  EXPECT_EQ(length_in(kAtom + cell("50.000") + kAtom, 0), 50);
}

TEST(Replicate, CountsTheMiddleOfAllCopies) {
  ReadOptions options;
  options.replicate = {3, 1, 1};
  options.recenter = true;
  const SphereFile file = read_text(dump("pp pp pp\n0 2\n0 2\n0 2\n", "1 0 0 0\n2 1 1 1\n"), "a.dump", options);
  EXPECT_EQ(file.recentred_by, (Vec3d{2.5, 0.5, 0.5}));
  EXPECT_EQ(cell_of(file).origin, (Vec3d{-2.5, -0.5, -0.5}));
  EXPECT_EQ(file.spheres.total_size(), 6);
  EXPECT_EQ(file.spheres.centre(5), (Vec3d{2.5, 0.5, 0.5}));
}

TEST(Cell, ThatCannotBeReadIsTold) {
  const auto warnings = [](const std::string& text, const std::string& name) {
    std::string all;
    for (const std::string& one : read_text(text, name).warnings) all += one + "\n";
    return all;
  };
  // PDB: the columns, else six fields; a record that is none of both.
  const std::string fields = "CRYST1 63.15 83.59 53.80 90.00 90.00 90.00 P 1 21 1\n" + kAtom;
  expect_near(cell_of(read_text(fields, "a.pdb")).vectors[1], {0, 83.59, 0});
  EXPECT_EQ(warnings(fields, "a.pdb"),
            "a.pdb: CRYST1 does not keep to its columns; its first six fields are taken as the cell\n");
  for (const char* record : {"CRYST1   10.000   10.000   10.000  10.00  20.00 120.00 P 1\n", "CRYST1 none\n"})
    EXPECT_EQ(warnings(record + kAtom, "a.pdb"), "a.pdb: CRYST1 states no cell that can be read, so there is none\n");
  for (const char* record : {"CRYST1    1.000    1.000    1.000  90.00  90.00  90.00 P 1\n", "CRYST1 1 1 1 90 90 90\n",
                             "CRYST1    0.000    0.000    0.000  90.00  90.00  90.00 P 1\n", "CRYST1\n"})
    EXPECT_EQ(warnings(record + kAtom, "a.pdb"), "") << record;

  // Both formats write 1 x 1 x 1 where there is no crystal.
  const std::string atoms =
      "loop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.type_symbol\n1 2 3 C\n";
  const auto cell = [](const std::string& a) {
    return "data_a\n_cell.length_a " + a + "\n_cell.length_b 1\n_cell.length_c 1\n_cell.angle_alpha 90\n" +
           "_cell.angle_beta 90\n_cell.angle_gamma 90\n";
  };
  EXPECT_EQ(warnings(cell("1") + atoms, "a.cif"), "");
  EXPECT_FALSE(read_text(cell("1") + atoms, "a.cif").spheres.cell().has_value());
  EXPECT_EQ(warnings(cell("wide") + atoms, "a.cif"),
            "a.cif: the lengths and angles of _cell make no cell, so there is none\n");

  // MOL2 has none.
  const std::string mol2 = "@<TRIPOS>MOLECULE\nx\n 1\n@<TRIPOS>ATOM\n1 C1 0 0 0 C.3\n@<TRIPOS>CRYSIN\n";
  EXPECT_TRUE(read_text(mol2 + "1 1 1 90 90 90 1 1\n", "a.mol2").spheres.cell().has_value());
  EXPECT_EQ(warnings(mol2 + "1 1 1 90 90 190 1 1\n", "a.mol2"),
            "a.mol2:7: the numbers of CRYSIN make no cell, so there is none\n");
}

}  // namespace
}  // namespace bihive
