#include "bihive/select/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bihive/io/bundled.h"
#include "bihive/math/rng.h"
#include "bihive/select/residue_words.h"
#include "support/periodic_cells.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using Ids = std::vector<int>;

const SphereSet& protease() {
  static const SphereFile file = test::read_text(bundled_molecule(), "1hpv.pdb");
  return file.spheres;
}

// Six spheres on the x axis.
const SphereSet& atoms_table() {
  static const SphereFile file = test::read_text(
      "x,y,z,r,type,charge,phase,element,odd name\n"
      "0,0,0,1,1,-1,solid,C,5\n"
      "1,0,0,1,2,,solid,h,6\n"
      "2,0,0,2,2,2,liquid,O,7\n"
      "3,0,0,2,3,-0.5,Solid,C,8\n"
      "4,0,0,0.5,3,0,\"10\",Fe,9\n"
      "5,0,0,0.5,7,1,C5',Fe,10\n",
      "a.csv");
  return file.spheres;
}

Ids ids_in(const SphereSet& spheres, const std::string& expression) {
  const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, expression);
  EXPECT_TRUE(mask.ok()) << expression << ": " << mask.error().to_string();
  Ids ids;
  for (std::size_t i = 0; mask.ok() && i < mask->size(); ++i)
    if ((*mask)[i] != 0) ids.push_back(static_cast<int>(i));
  return ids;
}

Ids ids(const std::string& expression) {
  return ids_in(atoms_table(), expression);
}

std::size_t count_in_protease(const std::string& expression) {
  return ids_in(protease(), expression).size();
}

Error error_in(const SphereSet& spheres, const std::string& expression) {
  const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, expression);
  EXPECT_FALSE(mask.ok()) << expression;
  return mask.ok() ? Error{} : mask.error();
}

// The numbers were counted with awk on the columns of data/1hpv.pdb.
TEST(Selection, CountsAtomsOfAMolecule) {
  EXPECT_EQ(count_in_protease("all"), 1631u);
  EXPECT_EQ(count_in_protease("none"), 0u);
  EXPECT_EQ(count_in_protease("chain A"), 758u);
  EXPECT_EQ(count_in_protease("protein"), 1516u);
  EXPECT_EQ(count_in_protease("water"), 80u);
  EXPECT_EQ(count_in_protease("hetero"), 115u);
  EXPECT_EQ(count_in_protease("backbone"), 792u);
  EXPECT_EQ(count_in_protease("nucleic"), 0u);
  EXPECT_EQ(count_in_protease("resname 478"), 35u);
  EXPECT_EQ(count_in_protease("within 5 of resname 478"), 138u);
  EXPECT_EQ(count_in_protease("chain A and resid 10..20"), 81u);
}

// Names that force fields give to residues; the reader of PDB files knows the same ones.
TEST(Selection, ResiduesOfSimulations) {
  for (const char* name : {"ALA", "MSE", "ASX", "HIE", "NALA", "CALA", "CYS2", "ACE"})
    EXPECT_TRUE(is_protein_residue(name)) << name;
  for (const char* name : {"DA", "PSU", "DA5", "RA3", "DAN", "URA"}) EXPECT_TRUE(is_nucleic_residue(name)) << name;
  for (const char* name : {"HOH", "WAT", "TIP5", "OPC", "T5P", "SOLV", "OH2"})
    EXPECT_TRUE(is_water_residue(name)) << name;
  for (const char* name : {"478", "NA", "CHOL", "POPC", "GOL"}) {
    EXPECT_FALSE(is_protein_residue(name)) << name;
    EXPECT_FALSE(is_nucleic_residue(name)) << name;
    EXPECT_FALSE(is_water_residue(name)) << name;
  }
}

TEST(Selection, ComparesNumbers) {
  EXPECT_EQ(ids("x > 3"), (Ids{4, 5}));
  EXPECT_EQ(ids("x >= 3"), (Ids{3, 4, 5}));
  EXPECT_EQ(ids("x < 1"), (Ids{0}));
  EXPECT_EQ(ids("x <= 1"), (Ids{0, 1}));
  EXPECT_EQ(ids("r = 2"), (Ids{2, 3}));
  EXPECT_EQ(ids("radius == 2"), (Ids{2, 3}));
  EXPECT_EQ(ids("index != 0"), (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(ids("1 < x < 4"), (Ids{2, 3}));
  EXPECT_EQ(ids("\"odd name\" > 8"), (Ids{4, 5}));
  EXPECT_EQ(ids("CHARGE < 0"), (Ids{0, 3})) << "names of columns without regard to case";
}

TEST(Selection, AnUnknownNumberIsNeitherEqualNorUnequalNorInAnyRange) {
  EXPECT_EQ(ids("charge = 2"), (Ids{2}));
  EXPECT_EQ(ids("charge != 2"), (Ids{0, 3, 4, 5}));
  EXPECT_EQ(ids("charge -9..9"), (Ids{0, 2, 3, 4, 5}));
  EXPECT_EQ(ids("not charge -9..9"), (Ids{1}));
}

TEST(Selection, CalculatesWithTheUsualPrecedence) {
  EXPECT_EQ(ids("x = 1 + 2 * 2"), (Ids{5}));
  EXPECT_EQ(ids("x = (1 + 1) * 2"), (Ids{4}));
  EXPECT_EQ(ids("x = 8 / 2 / 2"), (Ids{2}));
  EXPECT_EQ(ids("x = 5 - 3 - 1"), (Ids{1}));
  EXPECT_EQ(ids("-x < -4"), (Ids{5}));
  EXPECT_EQ(ids("(x) > 4"), (Ids{5}));
  EXPECT_EQ(ids("x*x>=16"), (Ids{4, 5}));
  EXPECT_EQ(ids("x-1=3"), (Ids{4}));
}

TEST(Selection, TakesValuesAndRanges) {
  EXPECT_EQ(ids("index 0..1 4"), (Ids{0, 1, 4}));
  EXPECT_EQ(ids("index 0:1, 4"), (Ids{0, 1, 4}));
  EXPECT_EQ(ids("index 0 to 1 4-5"), (Ids{0, 1, 4, 5}));
  EXPECT_EQ(ids("index 4..5 0..2 1 2..3 9..12"), ids("all")) << "ranges that overlap";
  EXPECT_EQ(ids("index 5 0 3..3 7"), (Ids{0, 3, 5}));
  EXPECT_EQ(ids("type 2 or charge < 0"), (Ids{0, 1, 2, 3}));
  EXPECT_EQ(ids("phase solid"), (Ids{0, 1}));
  EXPECT_EQ(ids("phase Solid liquid"), (Ids{2, 3})) << "texts as they are written";
  EXPECT_EQ(ids("phase 10"), (Ids{4})) << "a text that looks like a number";
  EXPECT_EQ(ids("phase C5'"), (Ids{5}));
  EXPECT_EQ(ids("phase *o*id"), (Ids{0, 1, 3}));
  EXPECT_EQ(ids("phase \"*o*id\""), Ids{}) << "a star in quotes is a star";
  EXPECT_EQ(ids("phase = solid"), (Ids{0, 1}));
  EXPECT_EQ(ids("phase != 'solid'"), (Ids{2, 3, 4, 5}));
  EXPECT_EQ(ids("element c FE"), (Ids{0, 3, 4, 5})) << "elements in any case";
  EXPECT_EQ(ids("element 26"), (Ids{4, 5}));
  EXPECT_EQ(ids("element = C"), (Ids{0, 3}));
  EXPECT_EQ(ids("element > 6"), (Ids{2, 4, 5}));
  EXPECT_EQ(ids("hydrogen"), (Ids{1}));
}

TEST(Selection, TakesRangesWithBlanksAndListsWithPlus) {
  EXPECT_EQ(ids("index 1 - 3"), (Ids{1, 2, 3}));
  EXPECT_EQ(ids("index 1- 3"), (Ids{1, 2, 3}));
  EXPECT_EQ(ids("charge -1- -0.5"), (Ids{0, 3}));
  EXPECT_EQ(ids("charge -1 - -0.5"), (Ids{0, 3}));
  EXPECT_EQ(ids("charge -1 --0.5"), (Ids{0, 3}));
  EXPECT_EQ(ids("charge 2 -1"), (Ids{0, 2})) << "two values";
  EXPECT_EQ(ids("index 0+2+4-5"), (Ids{0, 2, 4, 5}));
  EXPECT_EQ(ids("index 0,2,4-5"), (Ids{0, 2, 4, 5}));
  EXPECT_EQ(ids("element C+O"), (Ids{0, 2, 3}));
  EXPECT_EQ(ids("phase solid+liquid"), (Ids{0, 1, 2}));
  const SphereFile ions = test::read_text("x,y,z,r,resname\n0,0,0,1,A+B\n1,0,0,1,A\n2,0,0,1,Na+\n", "a.csv");
  EXPECT_EQ(ids_in(ions.spheres, "resname A+B"), (Ids{0})) << "a text that is there is itself";
  EXPECT_EQ(ids_in(ions.spheres, "resname Na+"), (Ids{2}));
}

TEST(Selection, CalculatesRootsPowersAndMagnitudes) {
  EXPECT_EQ(ids("x^2 > 9"), (Ids{4, 5}));
  EXPECT_EQ(ids("-x^2 < -9"), (Ids{4, 5})) << "a power binds tighter than a sign";
  EXPECT_EQ(ids("2^-x <= 0.125"), (Ids{3, 4, 5}));
  EXPECT_EQ(ids("sqrt(x) = 2"), (Ids{4}));
  EXPECT_EQ(ids("SQRT (x * x) = 2"), (Ids{2}));
  EXPECT_EQ(ids("abs(charge) = 1"), (Ids{0, 5}));
  EXPECT_EQ(ids("(charge)^2 = 1"), (Ids{0, 5}));
  EXPECT_EQ(ids("charge^0.5 >= 0"), (Ids{2, 4, 5})) << "there is no root of a negative number";
  EXPECT_EQ(ids("x^0 = 1"), ids("all"));
  EXPECT_FALSE(select_spheres(atoms_table(), "2^x^2 > 1").ok()) << "which way is ambiguous";
  const SphereFile moving = test::read_text("x,y,z,r,vx,vy,vz\n0,0,0,1,3,0,4\n1,0,0,1,1,2,2\n", "a.csv");
  EXPECT_EQ(ids_in(moving.spheres, "speed = 5"), (Ids{0}));
  EXPECT_EQ(ids_in(moving.spheres, "speed 3"), (Ids{1}));
  EXPECT_THAT(error_in(atoms_table(), "speed > 1").message, testing::HasSubstr("there is no attribute 'speed'"));
}

TEST(Selection, TakesAllThatAreTheSameAsSome) {
  EXPECT_EQ(ids("same phase as index 0"), (Ids{0, 1}));
  EXPECT_EQ(ids("same r as x = 3"), (Ids{2, 3}));
  EXPECT_EQ(ids("not same element as index 0"), (Ids{1, 2, 4, 5}));
  EXPECT_EQ(ids("same charge as index 1"), Ids{}) << "an unknown number is the same as none";
  EXPECT_EQ(count_in_protease("same residue as name CA and resid 25"), count_in_protease("resid 25"));
  EXPECT_EQ(count_in_protease("byres index 0"), count_in_protease("chain A and resid 1"));
  EXPECT_EQ(count_in_protease("same chain as index 0"), count_in_protease("chain A"));
  EXPECT_GT(count_in_protease("byres within 5 of resname 478"), count_in_protease("within 5 of resname 478"));
  EXPECT_THAT(error_in(atoms_table(), "byres x > 1").message, testing::HasSubstr("has no 'resid'"));
  EXPECT_THAT(error_in(atoms_table(), "same phse as x > 1").to_string(), testing::HasSubstr("did you mean 'phase'"));
}

TEST(Selection, KindsOfResiduesDivideAMolecule) {
  EXPECT_EQ(count_in_protease("ligand"), 35u);
  EXPECT_EQ(count_in_protease("polymer"), 1516u);
  EXPECT_EQ(count_in_protease("solvent"), 80u);
  EXPECT_EQ(count_in_protease("ion"), 0u);
  EXPECT_EQ(count_in_protease("sidechain"), 1516u - 792u) << "its file has no hydrogens";
  EXPECT_EQ(count_in_protease("ligand or polymer or water or ion"), 1631u);
}

TEST(Selection, WordsOfOtherProgramsAreRefusedWithAdvice) {
  const struct {
    const char *expression, *column, *message;
  } cases[] = {
      {"resname 478 around 5", "13", "'around' is a word of another program, where a value of 'resname' is expected"},
      {"around 5 resname 478", "1", "'around' is a word of another program; write 'within 5 of resname LIG'"},
      {"name CA expand 3", "9", "write 'within 5 of"},
      {"bychain", "1", "write 'same chain as'"},
      {"organic", "1", "write ligand"},
  };
  for (const auto& one : cases) {
    const Error error = error_in(protease(), one.expression);
    EXPECT_THAT(error.to_string(), testing::HasSubstr(one.message)) << one.expression;
    EXPECT_EQ(std::to_string(error.column), one.column) << one.expression << ": " << error.to_string();
  }
  EXPECT_EQ(count_in_protease("name 'around'"), 0u);
}

TEST(Selection, ASelectionThatFindsNothingSaysWhatThereIs) {
  EXPECT_EQ(what_there_is(protease(), "chain a"), "no sphere has chain a; there are A, B, ''");
  EXPECT_EQ(what_there_is(protease(), "chain A and resid 500 600"),
            "no sphere has resid 500 600; there are numbers from 1 to 280");
  EXPECT_EQ(what_there_is(protease(), "element Fe"), "no sphere has element Fe; there are C, N, O, S");
  EXPECT_EQ(what_there_is(protease(), "chain A and x > 1000"), "") << "no test of values";
  EXPECT_EQ(what_there_is(protease(), "chain A and"), "");
  const std::string phases = "no sphere has phase gas; there are solid, liquid, Solid, 10, C5'";
  EXPECT_EQ(what_there_is(atoms_table(), "phase gas"), phases);
  SphereSet frame = atoms_table();
  for (NamedTexts& column : frame.attributes().texts) column.texts.emplace_back("of another frame");
  EXPECT_EQ(what_there_is(frame, "phase gas"), phases);
}

ReadOptions with_radius_one() {
  ReadOptions options;
  options.radius = 1;
  return options;
}

// Five carbon atoms in a row, which bonds by distance join, one far away, and a point without an element.
TEST(Selection, BondsJoinSpheres) {
  const std::string chain = "C 0 0 0\nC 1.5 0 0\nC 3 0 0\nC 4.5 0 0\nC 6 0 0\nC 20 0 0\nX 7 0 0\n";
  const SphereSet spheres = test::read_text("7\n\n" + chain, "chain.xyz", with_radius_one()).spheres;
  EXPECT_EQ(ids_in(spheres, "bonded to index 2"), (Ids{1, 3}));
  EXPECT_EQ(ids_in(spheres, "bonded to index 2 3"), (Ids{1, 2, 3, 4}));
  EXPECT_EQ(ids_in(spheres, "bonded to index 5 6"), Ids{});
  EXPECT_EQ(ids_in(spheres, "within 0 bonds of index 2 5"), (Ids{2, 5}));
  EXPECT_EQ(ids_in(spheres, "within 1 bond of index 2"), (Ids{1, 2, 3}));
  EXPECT_EQ(ids_in(spheres, "WITHIN 2 BONDS OF index 0"), (Ids{0, 1, 2}));
  EXPECT_EQ(ids_in(spheres, "within 1e300 bonds of index 4"), (Ids{0, 1, 2, 3, 4}));
  EXPECT_EQ(ids_in(spheres, "not bonded to bonded to index 0 and x < 10"), (Ids{1, 3, 4, 6}));
  EXPECT_EQ(ids_in(spheres, "within 3 of index 6 and not within 1 bonds of index 4"), Ids({6}));
}

TEST(Selection, BondsOfAFileCountAndBondsCrossACell) {
  const std::string in_cell =
      "2\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3\nC 0.5 5 5\nC 9.2 5 5\n";
  const SphereSet spheres = test::read_text(in_cell, "cell.xyz", with_radius_one()).spheres;
  EXPECT_EQ(ids_in(spheres, "bonded to index 0"), (Ids{1}));
  EXPECT_TRUE(sees_images(spheres, "bonded to index 0"));
  EXPECT_TRUE(sees_images(spheres, "within 2 bonds of index 0"));
  SphereSet stated = atoms_table();
  stated.attributes().bonds.add(0, 4);
  stated.attributes().bonds.put_in_order();
  stated.attributes().bonds.are_all = true;
  EXPECT_EQ(ids_in(stated, "bonded to index 4"), (Ids{0}));
  const SphereSet points = test::read_text("0 0 0 1\n1 0 0 1\n", "points.csv").spheres;
  EXPECT_THAT(error_in(points, "x > 0 and bonded to index 0").to_string(), testing::HasSubstr("have none"));
  EXPECT_EQ(error_in(points, "x > 0 and bonded to index 0").column, 11);
}

TEST(Selection, AndBindsTighterThanOrAndNotTighterThanBoth) {
  EXPECT_EQ(ids("x = 0 or x = 1 and r = 2"), (Ids{0}));
  EXPECT_EQ(ids("(x = 0 or x = 1) and r = 1"), (Ids{0, 1}));
  EXPECT_EQ(ids("not x = 0 and r = 1"), (Ids{1}));
  EXPECT_EQ(ids("not (x = 0 and r = 1)"), (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(ids("!x=0&&r=1||index 5"), (Ids{1, 5}));
  EXPECT_EQ(ids("NOT x = 0 AND r = 1 | index 5"), (Ids{1, 5}));
  EXPECT_EQ(ids("not not all"), ids("all"));
  EXPECT_EQ(ids("within 1 of x = 0 and r = 1"), (Ids{0, 1}));
  EXPECT_EQ(ids("not within 1 of x = 0"), (Ids{2, 3, 4, 5}));
}

TEST(Selection, TypesThatAreLabelsAreNumbersAndTexts) {
  const SphereFile file = test::read_text("x,y,z,r,type\n0,0,0,1,Cu\n1,0,0,1,Zn\n2,0,0,1,Cu\n", "a.csv");
  EXPECT_EQ(ids_in(file.spheres, "type Cu"), (Ids{0, 2}));
  EXPECT_EQ(ids_in(file.spheres, "type 2"), (Ids{1}));
}

TEST(Selection, WithinAgreesWithComparingAll) {
  SplitMix64 rng(7);
  for (const double distance : {0.0, 0.01, 0.2, 0.5, 3.0}) {
    std::vector<double> x, y, z, r;
    for (int i = 0; i < 2000; ++i) {
      // Many places occur twice, so that distance 0 finds something.
      const double cells = i % 2 == 0 ? 8 : 1e6;
      for (auto* axis : {&x, &y, &z}) axis->push_back(std::floor(rng.next_double() * cells) / cells);
      r.push_back(0.01);
    }
    const Result<SphereSet> set = SphereSet::from_world(x, y, z, r);
    ASSERT_TRUE(set.ok());
    Ids expected;
    for (int i = 0; i < 2000; ++i) {
      bool near = false;
      for (int j = 0; j < 40 && !near; ++j) {
        const Vec3d d = set->stored_centre(i) - set->stored_centre(j);
        const double limit = distance * set->scale();
        near = d.x * d.x + d.y * d.y + d.z * d.z <= limit * limit;
      }
      if (near) expected.push_back(i);
    }
    EXPECT_EQ(ids_in(*set, "within " + std::to_string(distance) + " of index < 40"), expected) << distance;
    EXPECT_GE(expected.size(), 40u);
  }
}

TEST(Selection, WithinIncludesItsLimitAndItsOwnSpheres) {
  EXPECT_EQ(ids("within 1 of index 2"), (Ids{1, 2, 3}));
  EXPECT_EQ(ids("within 0.999 of index 2"), (Ids{2}));
  EXPECT_EQ(ids("within 1 of none"), Ids{});
  EXPECT_EQ(ids("within 1e300 of index 2"), ids("all"));
}

// Whether an image of `b`, moved by -reach to reach along each vector, is at most `distance` from `a`.
bool image_is_within(const SphereSet& spheres, std::int64_t a, std::int64_t b, double distance, int reach) {
  const double limit = distance * spheres.scale();
  bool is_within = false;
  test::for_each_shift(spheres, reach, [&](Vec3d shift) {
    const Vec3d between = (spheres.stored_centre(b) - spheres.stored_centre(a)) + shift;
    is_within |= dot(between, between) <= limit * limit;
  });
  return is_within;
}

TEST(Selection, WithinSeesTheImagesOfEveryCell) {
  const std::vector<Cell>& cells = test::periodic_cells();
  SplitMix64 random(36);
  for (const Cell& cell : cells)
    for (const double distance : {0.0, 0.4, 1.0, 2.5, 7.0}) {
      // Some lie in the cell, others have left it.
      std::vector<double> x, y, z;
      for (int i = 0; i < 40; ++i) {
        Vec3d at = test::point_in(cell, random);
        if (i % 4 == 0) at = at + double(random.next_below(3)) * cell.vectors[0] - 2.0 * cell.vectors[1];
        if (i == 7) at = {x[2] + cell.vectors[0].x, y[2] + cell.vectors[0].y, z[2] + cell.vectors[0].z};
        x.push_back(at.x), y.push_back(at.y), z.push_back(at.z);
      }
      SphereSet spheres = SphereSet::from_world(x, y, z, std::vector<double>(40, 0.1)).value();
      spheres.cell() = cell;
      Ids expected;
      for (int i = 0; i < 40; ++i)
        for (const int of : {0, 2, 9})
          if (image_is_within(spheres, i, of, distance, 9)) {
            expected.push_back(i);
            break;
          }
      EXPECT_EQ(ids_in(spheres, "within " + std::to_string(distance) + " of index 0 2 9"), expected)
          << "cell " << &cell - cells.data() << ", distance " << distance;
      EXPECT_TRUE(sees_images(spheres, "x > 0 or not within 1 of index 0"));
      spheres.cell()->periodic = {false, false, false};
      EXPECT_FALSE(sees_images(spheres, "within 1 of index 0"));
    }
}

TEST(Selection, ACellThatIsNoneChangesNothing) {
  SphereSet spheres = atoms_table();
  for (const Cell& cell :
       {Cell{{}, {Vec3d{}, Vec3d{}, Vec3d{}}}, Cell{{}, {Vec3d{5, 0, 0}, Vec3d{10, 0, 0}, Vec3d{}}}}) {
    spheres.cell() = cell;
    EXPECT_EQ(ids_in(spheres, "within 1 of index 0"), (Ids{0, 1}));
    EXPECT_FALSE(sees_images(spheres, "within 1 of index 0"));
  }
  spheres.cell() = Cell{{}, {Vec3d{6, 0, 0}, Vec3d{}, Vec3d{}}};
  EXPECT_EQ(ids_in(spheres, "within 1 of index 0"), (Ids{0, 1, 5}));
  EXPECT_FALSE(sees_images(spheres, "x > 0"));
  // One outlier, a million cells away, is as near as any other.
  spheres = SphereSet::from_world(std::vector<double>{0, 6e6 + 1, 3}, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}).value();
  spheres.cell() = Cell{{}, {Vec3d{6, 0, 0}, Vec3d{0, 6, 0}, Vec3d{0, 0, 6}}};
  EXPECT_EQ(ids_in(spheres, "within 1.5 of index 0"), (Ids{0, 1}));
  EXPECT_EQ(ids_in(spheres, "within 1e300 of index 2"), (Ids{0, 1, 2}));
}

TEST(Selection, ErrorsNameThePlaceAndTheRemedy) {
  const struct {
    const char *expression, *column, *message;
  } cases[] = {
      {"chrage < 0", "1",
       "there is no attribute 'chrage'; did you mean 'charge'? there are x, y, z, r, index, element, type"},
      {"x > 3 and wahter", "11", "there is no word or attribute 'wahter'; did you mean 'water'?"},
      {"x >", "4", "expected a number or the name of a number, found the end"},
      {"x > 3 and", "10", "expected a selection such as 'chain A', 'x > 3' or 'all', found the end"},
      {"", "1", "expected a selection such as 'chain A', 'x > 3' or 'all', found the end"},
      {"(x > 3", "7", "')'"},
      {"x > 3)", "6", "found ')'"},
      {"within of all", "8", "expected a distance"},
      {"within 5 all", "10", "expected 'of'"},
      {"within 5 bonds all", "16", "expected 'of'"},
      {"within 1.5 bonds of all", "1", "must be a whole number"},
      {"within -1 bonds of all", "1", "must be a whole number"},
      {"bonded all", "1", "'bonded' is a word of another program; write 'bonded to"},
      {"within -1 of all", "1", "at least 0"},
      {"index 5..2", "7", "the range '5..2' is empty"},
      {"element 8..6", "9", "the range '8..6' is empty"},
      {"index solid", "7", "expected a number for 'index', found 'solid'"},
      {"phase 1..2", "7", "'phase' holds texts, and a range needs numbers"},
      {"phase > 2", "1", "'phase' holds texts, and this comparison needs numbers"},
      {"phase", "1", "'phase' needs values after it"},
      {"phase solid charge 2", "13", "'charge' stands where a value of 'phase' is expected; put 'and' or 'or'"},
      {"water 3", "7", "'water' takes no values"},
      {"water", "1", "'water' needs the names of residues, and the input has no 'resname'"},
      {"element Qq", "9", "'Qq' is no element"},
      {"phase \"solid", "7", "a quote that does not close"},
  };
  for (const auto& one : cases) {
    const Error error = error_in(atoms_table(), one.expression);
    EXPECT_THAT(error.to_string(), testing::HasSubstr(one.message)) << one.expression;
    EXPECT_EQ(std::to_string(error.column), one.column) << one.expression << ": " << error.to_string();
    EXPECT_EQ(error.line, 1) << one.expression;
  }
}

TEST(Selection, TheCaretStandsBelowThePlaceInCharacters) {
  const std::string expression = "x > 3 and\n'\xC3\xA4' > 1 and q7 = 2";
  const Error error = error_in(atoms_table(), expression);
  EXPECT_EQ(error.line, 2);
  EXPECT_EQ(caret_lines(expression, error), "  '\xC3\xA4' > 1 and q7 = 2\n  ^\n");
  EXPECT_EQ(caret_lines("\xC3\xA4 |", error_in(atoms_table(), "\xC3\xA4 |")), "  \xC3\xA4 |\n     ^\n");
}

TEST(Selection, DeepAndLongTextsAreErrors) {
  EXPECT_EQ(ids(std::string(100, '(') + "all" + std::string(100, ')')), ids("all"));
  EXPECT_THAT(error_in(atoms_table(), std::string(101, '(') + "all" + std::string(101, ')')).message,
              testing::HasSubstr("at most 100 deep"));
  EXPECT_EQ(error_in(atoms_table(), std::string(101, '(') + "all" + std::string(101, ')')).column, 101);
  EXPECT_EQ(ids(std::string(100, '(') + "x" + std::string(100, ')') + " > 1"), ids("x > 1"));
  EXPECT_EQ(error_in(atoms_table(), "all or " + std::string(101, '(') + "x" + std::string(101, ')') + " > 1").column,
            108);
  // Parentheses in quotes are none, whichever way they open.
  EXPECT_EQ(ids("phase \"" + std::string(101, '(') + "\" or x > 1"), ids("x > 1"));
  const Error deep =
      error_in(atoms_table(), "phase \"" + std::string(30000, ')') + "\" or " + std::string(30000, '(') + "all");
  EXPECT_THAT(deep.message, testing::HasSubstr("at most 100 deep"));
  EXPECT_EQ(deep.column, 7 + 30000 + 5 + 101);
  EXPECT_THAT(error_in(atoms_table(), std::string(70000, ' ') + "all").message,
              testing::HasSubstr("at most 65536 bytes"));
  EXPECT_EQ(ids(std::string(60000, '!') + "x > 1"), ids("x > 1"));
  EXPECT_EQ(ids(std::string(60001, '!') + "x > 1"), ids("not x > 1"));
  EXPECT_EQ(ids(std::string(60001, '-') + "x < -1"), ids("x > 1"));
  std::string sum = "x";
  for (int i = 0; i < 15000; ++i) sum += "+x-x";
  EXPECT_EQ(ids(sum + " > 1"), ids("x > 1"));
  std::string within = "not not within 0 of not within 0 of not x > 1";
  EXPECT_EQ(ids(within), ids("x > 1"));
  for (int i = 0; i < 98; ++i) within = "within 0 of " + within;
  EXPECT_EQ(ids(within), ids("x > 1"));
  EXPECT_THAT(error_in(atoms_table(), "within 0 of " + within).message,
              testing::HasSubstr("at most 100 times 'within', 'bonded', 'same' or 'byres'"));
  std::string many = "x > 1";
  for (int i = 0; i < 3000; ++i) many += " or x > 1";
  EXPECT_EQ(ids(many), (Ids{2, 3, 4, 5}));
}

}  // namespace
}  // namespace bihive
