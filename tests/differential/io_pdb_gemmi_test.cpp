// The PDB reader against gemmi's own, on the bundled molecule and on a made file with special cases: the same atoms at
// the same places with the same elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <gemmi/pdb.hpp>
#include <string>
#include <vector>

#include "bihive/io/formats/formats.h"

namespace bihive {
namespace {

struct Atom {
  int serial;
  double x, y, z;
  int element;
  float occupancy, b_factor;
};

// The atoms of gemmi's first model, sorted by serial number, which restores file order.
std::vector<Atom> atoms_of_gemmi(const std::string& text) {
  std::vector<Atom> atoms;
  const gemmi::Structure structure = gemmi::read_pdb_string(text, "test");
  for (const gemmi::Chain& chain : structure.models.at(0).chains)
    for (const gemmi::Residue& residue : chain.residues)
      for (const gemmi::Atom& atom : residue.atoms)
        atoms.push_back(
            {atom.serial, atom.pos.x, atom.pos.y, atom.pos.z, atom.element.atomic_number(), atom.occ, atom.b_iso});
  std::sort(atoms.begin(), atoms.end(), [](const Atom& a, const Atom& b) { return a.serial < b.serial; });
  return atoms;
}

void expect_the_same(const std::string& text) {
  const std::vector<Atom> theirs = atoms_of_gemmi(text);
  const Result<RawSpheres> ours = read_bytes(format_named("PDB"), text, "test", 0);
  ASSERT_TRUE(ours.ok()) << ours.error().to_string();
  ASSERT_EQ(ours->size(), theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    SCOPED_TRACE("serial " + std::to_string(theirs[i].serial));
    EXPECT_EQ(ours->x[i], theirs[i].x);
    EXPECT_EQ(ours->y[i], theirs[i].y);
    EXPECT_EQ(ours->z[i], theirs[i].z);
    if (theirs[i].element != 0) {
      EXPECT_EQ(int(ours->attributes.element[i]), theirs[i].element);
    }
    EXPECT_EQ(static_cast<float>(ours->attributes.numbers[0].values[i]), theirs[i].occupancy);
    EXPECT_EQ(static_cast<float>(ours->attributes.numbers[1].values[i]), theirs[i].b_factor);
  }
}

TEST(PdbReaderAndGemmi, AgreeOnTheBundledMolecule) {
  // The file follows the older format, with line numbers from column 73 on: gemmi takes them for charges and stops.
  std::ifstream file(std::string(BIHIVE_SOURCE_DIR) + "/data/1hpv.pdb");
  std::string text;
  for (std::string line; std::getline(file, line);) text += line.substr(0, 72) + "\n";
  expect_the_same(text);
}

TEST(PdbReaderAndGemmi, AgreeOnElementsFromEveryNameAndColumn) {
  // Names with letters that are elements and letters that are not; with the element's columns and without. The residue
  // is none that bihive knows; names of four characters are left out, as gemmi takes the first two for the symbol (CA1B
  // is calcium there); and each name stands beside one that keeps to its column, as gemmi does not ask whether the file
  // does.
  const std::string letters = " CAHGNOFESZ12'";
  std::string text;
  int serial = 0;
  for (const char a : letters)
    for (const char b : letters)
      for (const char c : {' ', 'A', '1'})
        for (const char d : {' ', 'B'})
          for (const char* element : {"", " C", "FE", "C ", "1+", " X"}) {
            if (d != ' ' && std::isalpha(static_cast<unsigned char>(a))) continue;
            ++serial;
            char line[128];
            std::snprintf(line, sizeof line, "ATOM  %5d  C1  LIG A%4d    %8.3f%8.3f%8.3f  1.00 20.00\n", serial,
                          serial % 9000 + 1, 0.001 * serial, 0.5, 2.0);
            text += line;
            ++serial;
            std::snprintf(line, sizeof line, "ATOM  %5d %c%c%c%c LIG A%4d    %8.3f%8.3f%8.3f%6.2f%6.2f%s%s\n", serial,
                          a, b, c, d, serial % 9000 + 1, 0.001 * serial, -0.5, 2.0, 0.75, 12.5,
                          element[0] ? "          " : "", element);
            text += line;
          }
  expect_the_same(text);
}

}  // namespace
}  // namespace bihive
