#include <gtest/gtest.h>

#include "bihive/io/formats/foreign.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using namespace std::string_literals;

TEST(Foreign, NamesTheFormatByItsContent) {
  const std::pair<std::string, const char*> cases[] = {
      {"{\"1\": {\n \"ctime\": 1, \"numbers\": [1]}}", "a database of ASE in JSON"},
      {"<!DOCTYPE html>\n<html>", "a web page (HTML)"},
      {"%VERSION  VERSION_STAMP = V0001.000\n", "a topology of Amber (PRMTOP), without coordinates"},
      {"title\n    2\n  1.0  2.0  3.0  4.0  5.0  6.0\n", "a file of coordinates of Amber"},
      {"* TITLE\n*\n    2  EXT\n", "a structure of CHARMM (CRD)"},
      {"a\nb\n 1 0 0 0\n 2 1 0 0\n 2 0 1 0\n 2 0 0 1\n", "a cube of Gaussian"},
      {"CRYSTAL\nPRIMVEC\n1 0 0\n", "a structure of XCrySDen (XSF)"},
      {" 2 water\n 1 O 0.0 0.0 0.0 1 2\n 2 H 1 0 0 2 1\n", "a structure of Tinker"},
      {"\x89PNG\r\n\x1a\n"s, "a picture"},
  };
  for (const auto& [text, name] : cases)
    for (const char* file : {"a", "a.dat"}) {
      const std::string error = error_of(text, file);
      EXPECT_EQ(error.rfind(file + ": this is "s + name + ", which bihive does not read", 0), 0u) << error;
      EXPECT_NE(error.find("; "), std::string::npos) << error;
    }
}

TEST(Foreign, SaysThatATrajectoryIsReadWithItsAtoms) {
  const std::string advice =
      ", which is read only together with a file of its atoms; give that file first, as in 'bihive render ATOMS.gro "
      "FILE'";
  const std::pair<std::string, const char*> cases[] = {
      {"\x54\0\0\0CORD"s + std::string(80, '\0'), "a DCD trajectory of CHARMM, NAMD or LAMMPS"},
      {"\0\0\x07\xcb"s + std::string(80, '\0'), "an XTC trajectory of GROMACS"},
      {"\0\0\x07\xc9"s + std::string(80, '\0'), "a TRR trajectory of GROMACS"},
  };
  for (const auto& [text, name] : cases) EXPECT_EQ(error_of(text, "a"), "a: this is "s + name + advice);
  EXPECT_EQ(error_of("what is this?\n", "a.xtc"), "a.xtc: this is an XTC trajectory of GROMACS" + advice);
}

TEST(Foreign, GoesByTheNameWhereContentSaysNothing) {
  EXPECT_EQ(error_of("what is this?\n", "b/a.TPR.gz"),
            "b/a.TPR.gz: this is a run input file of GROMACS (TPR), which bihive does not read; convert it with 'gmx "
            "editconf "
            "-f FILE.tpr -o OUT.pdb'");
  EXPECT_EQ(foreign_by_name("tpr"), nullptr);
  EXPECT_EQ(foreign_by_name("a.tpr/b"), nullptr);
  EXPECT_EQ(foreign_by_name("a."), nullptr);
}

TEST(Foreign, TakesNothingOfBihivesOwn) {
  for (const char* text :
       {"2\nx\nC 1 2 3\nC 2 3 4\n", "1 2 3\n", "ITEM: TIMESTEP\n0\n", "data_x\n", "ply\nformat ascii 1.0\n",
        "# .PCD v0.7\nVERSION 0.7\n", "# vtk DataFile Version 3.0\npoints\nASCII\n",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n", "@<TRIPOS>MOLECULE\nbenzene\n",
        "benzene\n  program\n\n  6  6  0  0  0  0  0  0  0  0999 V2000\n",
        "diamond\n3.7\n0.5 0.5 0.0\n0.0 0.5 0.5\n0.5 0.0 0.5\nC\n2\nDirect\n0 0 0\n",
        "LAMMPS data file\n\n4 atoms\n1 atom types\n",
        "Water\n1\n    1SOL     OW    1   0.230   0.628   0.113\n   1 1 1\n", "x,y,z\n1,2,3\n",
        "ATOM      1  N   ALA A   1      11.104   6.134  -6.504\n", "{\"bihive_scene\": 2}", "\n\n\n", " \n", ""})
    EXPECT_EQ(foreign_by_content(text), nullptr) << text;
}

TEST(Foreign, NamesTextsThatNoReaderTakes) {
  const std::string table = "x,y,z\n1,2,3\n4,5,6\n";
  std::string cr = table, little = "\xff\xfe", big;
  for (char& c : cr)
    if (c == '\n') c = '\r';
  for (const char c : table) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const char* file : {"a", "a.csv"}) {
    EXPECT_EQ(error_of(cr, file),
              file +
                  ": this is a text whose lines end in CR (carriage return) alone, which bihive does not read; convert "
                  "it with 'tr \"\\r\" \"\\n\" < FILE > OUT'"s);
    for (const std::string& text : {little, little.substr(2), big, "\xfe\xff"s + big})
      EXPECT_EQ(error_of(text, file).rfind(file + ": this is a text in UTF-16, which bihive does not read"s, 0), 0u);
  }
}

TEST(Foreign, NamesStructuresOfOtherPrograms) {
  const std::pair<std::string, const char*> cases[] = {
      {"   5.0   5.0   5.0\n  90.0  90.0  90.0   SPGR =  1 P 1\n   1   0\n 0 x\n   1 C  0 0 0\n",
       "a crystal structure in CSSR"},
      {"water\n 0 2\n 10 0 0\n 0 10 0\n 0 0 10\nOW 1\n 1.0 2.0 3.0\n",
       "a structure or trajectory of DL_POLY (CONFIG, HISTORY)"},
      {"water\n 0 1 3\ntimestep 1 3 0 1 0.001\n", "a structure or trajectory of DL_POLY (CONFIG, HISTORY)"},
      {"\xde\x00\x05\xabmmtfVersion\xa5"
       "1.0.0"s,
       "an MMTF file"},
  };
  for (const auto& [text, name] : cases)
    EXPECT_EQ(error_of(text, "a").rfind("a: this is "s + name + ", which bihive does not read; ", 0), 0u)
        << error_of(text, "a");
  EXPECT_NE(error_of("?\n", "run/HISTORY").find("DL_POLY"), std::string::npos);
}

}  // namespace
}  // namespace bihive
