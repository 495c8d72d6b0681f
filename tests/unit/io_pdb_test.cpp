#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;
using test::texts_of;

// One ATOM line in the format's columns. `name` has its four columns, `element` its two.
struct AtomLine {
  double x = 0;
  std::string name = " CA ", alternate = " ", chain = " A", residue = "   1", insertion = " ", element = " C";
  double occupancy = 1;
  std::string record = "ATOM  ", serial = "    1", component = "ALA";

  std::string line() const {
    char text[128];
    std::snprintf(text, sizeof text, "%s%s %s%s%s%s%s%s   %8.3f%8.3f%8.3f%6.2f%6.2f          %s  \n", record.c_str(),
                  serial.c_str(), name.c_str(), alternate.c_str(), component.c_str(), chain.c_str(), residue.c_str(),
                  insertion.c_str(), x, 0.0, 0.0, occupancy, 20.0, element.c_str());
    return text;
  }
};

std::vector<double> xs_in(const SphereFile& file) {
  std::vector<double> x;
  for (std::int64_t id = 0; id < file.spheres.size(); ++id) x.push_back(file.spheres.centre(id).x);
  return x;
}
using Xs = std::vector<double>;

TEST(Pdb, TakesPlaceElementOccupancyAndBFactor) {
  const SphereFile file = read_text(
      "HEADER    TEST\n"
      "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N  \n"
      "HETATM    2 FE   HEM A   2    -100.125   0.000   3.000  0.50 -1.00          FE  \n"
      "TER\nEND\n",
      "a.pdb");
  EXPECT_EQ(file.format, "PDB");
  EXPECT_EQ(file.frames, 1);
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_NEAR(file.spheres.centre(0).x, 11.104, 1e-6);
  EXPECT_NEAR(file.spheres.centre(0).y, 6.134, 1e-6);
  EXPECT_NEAR(file.spheres.centre(0).z, -6.504, 1e-6);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{-100.125, 0, 3}));
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{7, 26}));
  EXPECT_FLOAT_EQ(static_cast<float>(file.spheres.radius(0)), 1.55f);
  EXPECT_EQ(numbers_of(file, "occupancy"), (std::vector<double>{1, 0.5}));
  EXPECT_EQ(numbers_of(file, "b_factor"), (std::vector<double>{20.25, -1}));
  EXPECT_TRUE(file.warnings.empty());

  // What selections ask for.
  const SphereAttributes& attributes = file.spheres.attributes();
  EXPECT_EQ(numbers_of(file, "resid"), (std::vector<double>{1, 2}));
  const auto texts = [&](const char* name) {
    const NamedTexts* const column = attributes.find_texts(name);
    return column ? std::vector<std::string>{column->of(0), column->of(1)} : std::vector<std::string>();
  };
  EXPECT_EQ(texts("chain"), (std::vector<std::string>{"A", "A"}));
  EXPECT_EQ(texts("resname"), (std::vector<std::string>{"ALA", "HEM"}));
  EXPECT_EQ(texts("name"), (std::vector<std::string>{"N", "FE"}));
  EXPECT_EQ(texts("record"), (std::vector<std::string>{"ATOM", "HETATM"}));
  EXPECT_EQ(attributes.find_texts("insertion"), nullptr) << "no atom has one";
}

TEST(Pdb, NamesStayInStepWithAlternateLocations) {
  AtomLine lost, kept, other;
  lost.alternate = "A";
  lost.occupancy = 0.25;
  kept.alternate = "B";
  kept.occupancy = 0.75;
  other.name = " CB ";
  other.chain = " Q";
  other.residue = "****";
  other.insertion = "C";
  const SphereFile file = read_text(lost.line() + kept.line() + other.line(), "a.pdb");
  ASSERT_EQ(file.spheres.size(), 2);
  const SphereAttributes& attributes = file.spheres.attributes();
  EXPECT_EQ(numbers_of(file, "occupancy"), (std::vector<double>{0.75, 1}));
  for (const NamedTexts& column : attributes.texts) ASSERT_EQ(column.text_of_sphere.size(), 2u) << column.name;
  EXPECT_EQ(attributes.find_texts("name")->of(0), "CA");
  EXPECT_EQ(attributes.find_texts("name")->of(1), "CB");
  EXPECT_EQ(attributes.find_texts("chain")->of(1), "Q");
  EXPECT_EQ(attributes.find_texts("insertion")->of(0), "");
  EXPECT_EQ(attributes.find_texts("insertion")->of(1), "C");
  EXPECT_TRUE(std::isnan(numbers_of(file, "resid")[1])) << "no whole number";
}

TEST(Pdb, KeepsFileOrderThoughChainsAndResiduesAreInterleaved) {
  std::string text;
  for (int i = 0; i < 9; ++i) {
    AtomLine atom;
    atom.x = i;
    atom.chain = i % 3 == 0 ? " A" : i % 3 == 1 ? " B" : "  ";
    atom.residue = i % 2 ? "   7" : "   3";
    atom.record = i % 4 == 3 ? "HETATM" : "ATOM  ";
    text += atom.line();
    if (i == 4) text += "TER\n";
  }
  EXPECT_EQ(xs_in(read_text(text, "a.pdb")), (Xs{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Pdb, TakesTheLikeliestOfAlternateLocationsAndOfEqualOnesTheFirst) {
  std::string text;
  const auto add = [&text](double x, const char* name, const char* mark, double occupancy, const char* residue = "   1",
                           const char* insertion = " ", const char* chain = " A") {
    AtomLine atom;
    atom.x = x;
    atom.name = name;
    atom.alternate = mark;
    atom.occupancy = occupancy;
    atom.residue = residue;
    atom.insertion = insertion;
    atom.chain = chain;
    text += atom.line();
  };
  add(0, " N  ", " ", 1);
  add(1, " CA ", "A", 0.4);                     // goes: 0.6 follows
  add(2, " CB ", "A", 0.5);                     // stays: the first of two
  add(3, " CA ", "B", 0.6);                     // stays
  add(4, " CB ", "B", 0.5);                     // goes
  add(5, " CA ", "C", 0.6);                     // goes: equal, but later
  add(6, " CA ", "A", 0.1, "   2");             // stays: another residue
  add(7, " CA ", "B", 0.1, "   1", "X");        // stays: another insertion code
  add(8, " CA ", "B", 0.1, "   1", " ", " B");  // stays: another chain
  add(9, " N  ", " ", 1);                       // stays: no mark, with any name
  const SphereFile file = read_text(text, "a.pdb");
  EXPECT_EQ(xs_in(file), (Xs{0, 2, 3, 6, 7, 8, 9}));
  EXPECT_EQ(numbers_of(file, "occupancy"), (std::vector<double>{1, 0.5, 0.6, 0.1, 0.1, 0.1, 1}));
  EXPECT_EQ(file.spheres.attributes().element.size(), 7u);
  EXPECT_EQ(file.rules[1], "alternate locations: the highest occupancy, of equal ones the first; 3 atoms left out");
}

TEST(Pdb, TakesARepeatedMarkForAnotherSite) {
  // A simulation uses residue numbers again and again, so the same names come again.
  std::string text;
  for (int i = 0; i < 4; ++i) {
    AtomLine atom;
    atom.x = i;
    atom.alternate = i % 2 ? "B" : "A";
    atom.occupancy = i == 1 ? 0.9 : 0.5;
    text += atom.line();
  }
  EXPECT_EQ(xs_in(read_text(text, "a.pdb")), (Xs{1, 2}));
}

TEST(Pdb, TakesHybrid36Numbers) {
  std::string text;
  for (const auto& [serial, residue] :
       {std::pair{"99999", "9999"}, {"A0000", "A000"}, {"zzzzz", "zzzz"}, {"*****", "****"}}) {
    AtomLine atom;
    atom.x = static_cast<double>(text.size());
    atom.serial = serial;
    atom.residue = residue;
    atom.alternate = "A";
    text += atom.line();
  }
  EXPECT_EQ(read_text(text, "a.pdb").spheres.size(), 4);
}

TEST(Pdb, GuessesTheElementFromTheNameWhereColumnsAreShort) {
  const std::pair<const char*, int> cases[] = {{" CA ", 6}, {"CA  ", 20}, {" N  ", 7}, {"FE  ", 26}, {"HG11", 1},
                                               {"1HB ", 1}, {"HG  ", 80}, {" OXT", 8}, {"ZN  ", 30}, {"C210", 6},
                                               {"1C4A", 6}, {" Q  ", 0},  {" DT ", 1}, {"O5' ", 8},  {"HB1 ", 1},
                                               {"OD1 ", 8}, {"QQ  ", 0},  {"    ", 0}, {"  Ag", 47}, {"NA1B", 7}};
  for (const auto& [name, number] : cases) {
    AtomLine atom;
    atom.name = name;
    atom.component = "LIG";
    const SphereFile file = read_text(atom.line().substr(0, 66) + "\n", "a.pdb");
    const auto& element = file.spheres.attributes().element;
    EXPECT_EQ(element.empty() ? 0 : int(element[0]), number) << "'" << name << "'";
    EXPECT_EQ(file.warnings.size(), number == 0 ? 1u : 0u) << "'" << name << "'";
  }
}

// Names without element columns: "name residue element".
std::vector<int> elements_of(const std::vector<std::array<std::string, 2>>& atoms) {
  std::string text;
  int number = 0;
  for (const auto& [name, component] : atoms) {
    AtomLine atom;
    atom.x = ++number;
    atom.name = name;
    atom.component = component;
    text += atom.line().substr(0, 66) + "\n";
  }
  const SphereFile file = read_text(text, "a.pdb");
  std::vector<int> elements(file.spheres.attributes().element.begin(), file.spheres.attributes().element.end());
  return elements;
}
using Elements = std::vector<int>;

TEST(Pdb, KnowsTheElementsOfStandardResidues) {
  // CHARMM writes all names from column 13 on.
  EXPECT_EQ(elements_of({{"N   ", "MET"},
                         {"HT1 ", "MET"},
                         {"CA  ", "MET"},
                         {"HG1 ", "MET"},
                         {"SD  ", "MET"},
                         {"CE  ", "MET"},
                         {"CD  ", "LYS"},
                         {"NE2 ", "HSD"},
                         {"OT1 ", "LEU"},
                         {"P   ", "ADE"},
                         {"HO2'", "URA"},
                         {"SE  ", "MSE"}}),
            (Elements{7, 1, 6, 1, 16, 6, 6, 7, 8, 15, 1, 34}));
  // Water, with places that are no atoms.
  EXPECT_EQ(elements_of({{" OH2", "TIP"}, {" H1 ", "TIP"}, {" MW ", "SOL"}, {"HW1 ", "SOL"}, {" OW ", "SOL"}}),
            (Elements{8, 1, 0, 1, 8}));
}

TEST(Pdb, KnowsIonsByName) {
  EXPECT_EQ(elements_of({{"SOD ", "SOD"},
                         {"POT ", "POT"},
                         {" CLA", "CLA"},
                         {"CES ", "CES"},
                         {"CAL ", "CAL"},
                         {" NA ", "NA+"},
                         {" CL ", "CL-"},
                         {" CA ", " CA"},
                         {"CA  ", " CA"},
                         {"FE  ", "FE2"},
                         {" NA ", "ION"},
                         {"K   ", " K "},
                         {" ZN ", " ZN"},
                         {" CHA", "CLA"}}),
            (Elements{11, 19, 17, 55, 20, 11, 17, 20, 20, 26, 11, 19, 30, 6}));
}

TEST(Pdb, SeesThatNamesDoNotKeepToTheirColumns) {
  // C1 and O2 from column 13 on: here CA, NB and CD are no calcium, niobium and cadmium. FE and CL1 are what they say,
  // and an atom alone in its residue may be a metal.
  std::string text;
  const auto add = [&text](const char* name, const char* component, const char* residue) {
    AtomLine atom;
    atom.x = static_cast<double>(text.size());
    atom.name = name;
    atom.component = component;
    atom.residue = residue;
    text += atom.line().substr(0, 66) + "\n";
  };
  for (const char* name : {"C1  ", "O2  ", "CA  ", "NB  ", "CD  ", "FE  ", "CL1 ", "HG  "}) add(name, "LIG", "   1");
  add("CD  ", "XYZ", "   2");
  const SphereFile file = read_text(text, "a.pdb");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 8, 6, 7, 6, 26, 17, 1, 48}));
  EXPECT_NE(file.rules[1].find("names begin in column 13 whatever their element"), std::string::npos) << file.rules[1];
  EXPECT_TRUE(file.warnings.empty());
}

TEST(Pdb, WarnsWhereColumnsAndNamesContradict) {
  std::string text;
  for (const char* element : {" C", "CA", "CA"}) {
    AtomLine atom;
    atom.x = static_cast<double>(text.size());
    atom.element = element;
    text += atom.line();
  }
  const SphereFile file = read_text(text, "a.pdb");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 20, 20})) << "the columns count";
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0],
            "a.pdb:2: 2 atoms have an element in columns 77-78 that contradicts the atom's name ('CA' of 'ALA' is "
            "stated as "
            "'CA'); the columns count");
}

TEST(Pdb, ALineCutInItsCoordinatesIsAnErrorAndOneWithoutEndAWarning) {
  AtomLine atom;
  atom.x = 12.75;
  const std::string line = atom.line().substr(0, 80), whole = line + "\n";
  for (std::size_t length = 0; length < 54; ++length) {
    const Result<SphereFile> cut = read_spheres_from_memory(whole + line.substr(0, length), "a.pdb", {});
    if (length < 4) continue;
    ASSERT_FALSE(cut.ok()) << length;
    EXPECT_EQ(cut.error().line, 2);
  }
  EXPECT_EQ(error_of(whole + line.substr(0, 52), "a.pdb"),
            "a.pdb:2:47: expected z in columns 47 to 54, but the line ends in column 52; the file is cut on this line");
  EXPECT_EQ(error_of(line.substr(0, 53) + "\n" + whole, "a.pdb"),
            "a.pdb:1:47: expected z in columns 47 to 54, but the line ends in column 53");
  for (std::size_t length = 54; length <= 80; ++length) {
    const SphereFile file = read_text(whole + line.substr(0, length), "a.pdb");
    ASSERT_EQ(file.warnings.size(), 1u) << length;
    EXPECT_EQ(file.warnings[0], "the last line of a.pdb has no end: the file may be cut");
  }
}

TEST(Pdb, KeepsOneOfSeveralResiduesAtOnePlaceAsAWhole) {
  // Marks A and B are serine, C is threonine: the likeliest is C, though its CB is the least likely of the CBs.
  std::string text;
  const auto add = [&text](double x, const char* name, const char* component, const char* mark, double occupancy) {
    AtomLine atom;
    atom.x = x;
    atom.name = name;
    atom.component = component;
    atom.alternate = mark;
    atom.occupancy = occupancy;
    text += atom.line();
  };
  add(0, " N  ", "SER", "A", 0.3);
  add(1, " N  ", "SER", "B", 0.3);
  add(2, " N  ", "THR", "C", 0.4);
  add(3, " CB ", "SER", "A", 0.35);
  add(4, " CB ", "SER", "B", 0.35);
  add(5, " CB ", "THR", "C", 0.34);
  add(6, " OG ", "SER", "A", 0.3);
  add(7, " OG1", "THR", "C", 0.4);
  const SphereFile file = read_text(text, "a.pdb");
  EXPECT_EQ(xs_in(file), (Xs{2, 5, 7}));
  EXPECT_EQ(file.rules[2], "residues of several names at one place: the likeliest as a whole; 1 residue");

  // Two names with one mark are no alternatives: a number was used again.
  text.clear();
  add(0, " N  ", "SER", "A", 0.3);
  add(1, " CA ", "THR", "A", 0.4);
  add(2, " CB ", "THR", "B", 0.4);
  EXPECT_EQ(xs_in(read_text(text, "a.pdb")), (Xs{0, 1, 2}));
}

TEST(Pdb, TakesElementsInAnyCaseAndGuessesTheRadiusOfUnknownOnes) {
  AtomLine calcium, unknown, deuterium;
  calcium.element = "Ca";
  unknown.element = " X";
  deuterium.element = " D";
  calcium.component = deuterium.component = "LIG";
  const SphereFile file = read_text(calcium.line() + unknown.line() + deuterium.line(), "a.pdb");
  EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{20, 0, 1}));
  EXPECT_EQ(file.spheres.radius(1), 0.5);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0],
            "1 sphere has neither element nor radius; each gets radius 0.5, as all centres are at one place; radius "
            "sets another");
}

TEST(Pdb, TakesTheModelAskedFor) {
  const auto atom = [](double x) {
    AtomLine a;
    a.x = x;
    return a.line();
  };
  const std::string models = "MODEL        1\n" + atom(1) + atom(2) + "ENDMDL\nMODEL        2\n" + atom(3) +
                             "ENDMDL\nMODEL        1\n" + atom(4) + "ENDMDL\nEND\n";
  EXPECT_EQ(read_text(models, "a.pdb").frames, 3);
  EXPECT_EQ(xs_in(read_text(models, "a.pdb")), (Xs{1, 2}));
  EXPECT_EQ(xs_in(read_text(models, "a.pdb", at_frame(1))), (Xs{3}));
  EXPECT_EQ(xs_in(read_text(models, "a.pdb", at_frame(2))), (Xs{4}));
  EXPECT_EQ(error_of(models, "a.pdb", at_frame(3)),
            "a.pdb: there is no frame 3: the file has 3 (0 to 2); choose one with frame, counting from 0");
  const std::string ends = atom(1) + "END\n" + atom(2) + "ENDMDL\n" + atom(3) + "ENDMDL\n";
  EXPECT_EQ(xs_in(read_text(ends, "a.pdb", at_frame(2))), (Xs{3}));
}

TEST(Pdb, NamesLineAndColumnsOfAFault) {
  const auto with = [](std::size_t column, const std::string& text) {
    std::string line = AtomLine{}.line();
    return "REMARK\n" + line.replace(column - 1, text.size(), text);
  };
  EXPECT_EQ(error_of(with(31, "     nan"), "a.pdb"), "a.pdb:2:31: x is not finite: 'nan'");
  EXPECT_EQ(error_of(with(39, "     inf"), "a.pdb"), "a.pdb:2:39: y is not finite: 'inf'");
  EXPECT_EQ(error_of(with(47, "********"), "a.pdb"),
            "a.pdb:2:47: expected a number for z in columns 47 to 54 but found '********'");
  EXPECT_EQ(error_of(with(31, "        "), "a.pdb"),
            "a.pdb:2:31: expected a number for x in columns 31 to 38 but found ''");
  EXPECT_EQ(error_of(with(31, " 1.0 2.0"), "a.pdb"),
            "a.pdb:2:31: expected a number for x in columns 31 to 38 but found '1.0 2.0'");
  EXPECT_EQ(error_of("ATOM      1  CA  ALA A   1       1.000\n", "a.pdb"),
            "a.pdb:1:39: expected a number for y in columns 39 to 46 but found ''");
  EXPECT_EQ(error_of("ATOM\n", "a.pdb"), "a.pdb:1:31: expected a number for x in columns 31 to 38 but found ''");
  EXPECT_EQ(error_of("HEADER    NOTHING\nEND\n", "a.pdb"), "a.pdb: there is no ATOM or HETATM record in it");
}

TEST(Pdb, WarnsOfAnUnreadableOccupancyOrBFactor) {
  std::string line = AtomLine{}.line();
  line.replace(60, 6, "******");
  const SphereFile file = read_text("REMARK\n" + line, "a.pdb");
  EXPECT_TRUE(std::isnan(numbers_of(file, "b_factor")[0]));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0], "a.pdb:2: 1 occupancies or B factors are no numbers and are taken as unknown");
  const SphereFile bare = read_text(AtomLine{}.line().substr(0, 54) + "\n", "a.pdb");
  EXPECT_EQ(numbers_of(bare, "occupancy"), (std::vector<double>{1}));
}

using Texts = std::vector<std::string>;

TEST(Pdb, ResidueNamesMayHaveFourLetters) {
  const auto atom = [](const std::string& columns_18_to_22) {
    AtomLine made;
    made.component = columns_18_to_22.substr(0, 3);
    made.chain = columns_18_to_22.substr(3);
    return made.line();
  };
  // Lipids and water of simulations, with a chain and without; ends of chains as Amber names them.
  const SphereFile file = read_text(
      atom("POPC ") + atom("POPCM") + atom("TIP3W") + atom("TIP3 ") + atom("NALA ") + atom("ALA A") + atom("NA   "),
      "a.pdb");
  EXPECT_EQ(texts_of(file, "resname"), (Texts{"POPC", "POPC", "TIP3", "TIP3", "NALA", "ALA", "NA"}));
  EXPECT_EQ(texts_of(file, "chain"), (Texts{"", "M", "W", "", "", "A", ""}));

  // Chains of two letters: a residue of three letters that is known shows them, also for unknown ones after it.
  const SphereFile two = read_text(atom("ALAAB") + atom("LIGAB") + atom("HOHAC"), "a.pdb");
  EXPECT_EQ(texts_of(two, "resname"), (Texts{"ALA", "LIG", "HOH"}));
  EXPECT_EQ(texts_of(two, "chain"), (Texts{"AB", "AB", "AC"}));
}

TEST(Pdb, LargeNumbersShiftTheColumns) {
  // As programs write them that give a number all of its digits.
  const auto line = [](const char* serial, const char* residue) {
    char text[128];
    std::snprintf(text, sizeof text, "ATOM  %s  OW  SOL A%s    %8.3f%8.3f%8.3f  0.50 20.00           O\n", serial,
                  residue, 10.5, -200.125, 1000.25);
    return std::string(text);
  };
  const SphereFile file = read_text(
      line("99999", "9999") + line("99999", "10000") + line("100000", "9999") + line("1000000", "123456"), "a.pdb");
  ASSERT_EQ(file.spheres.size(), 4);
  for (std::int64_t id = 0; id < 4; ++id) EXPECT_EQ(file.spheres.centre(id), (Vec3d{10.5, -200.125, 1000.25})) << id;
  EXPECT_EQ(numbers_of(file, "resid"), (std::vector<double>{9999, 10000, 9999, 123456}));
  EXPECT_EQ(numbers_of(file, "serial"), (std::vector<double>{99999, 99999, 100000, 1000000}));
  EXPECT_EQ(numbers_of(file, "occupancy"), std::vector<double>(4, 0.5));
  EXPECT_EQ(texts_of(file, "chain"), Texts(4, "A"));
  EXPECT_EQ(file.spheres.attributes().element, std::vector<std::uint8_t>(4, 8));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings[0].rfind("a.pdb:2: 3 atoms have a number with more digits than its columns hold", 0), 0u)
      << file.warnings[0];
  // The same under a name that says nothing is no PQR.
  EXPECT_EQ(read_text(line("99999", "10000"), "a").format, "PDB");
  // A digit as insertion code shifts nothing.
  EXPECT_EQ(numbers_of(read_text(AtomLine{1, " CA ", " ", " A", "  10", "1"}.line(), "a.pdb"), "resid"),
            (std::vector<double>{10}));
}

}  // namespace
}  // namespace bihive
