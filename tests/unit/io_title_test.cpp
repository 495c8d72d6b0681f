// What files say that they show: title and entry.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "bihive/base/readable.h"
#include "bihive/base/write_file.h"
#include "bihive/io/frames.h"
#include "bihive/io/write_spheres.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::read_text;

const std::string kAtom = "ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N  \n";

std::string title_of_pdb(const std::string& head) {
  return read_text(head + kAtom + "TITLE     BEHIND THE ATOMS\nEND\n", "a.pdb").title;
}

TEST(Title, PdbJoinsContinuationLines) {
  EXPECT_EQ(title_of_pdb("TITLE     CRYSTAL STRUCTURE OF N-\nTITLE    2 ACETYL-X IN COMPLEX   \n"
                         "TITLE    3  WITH A LIGAND - AND WATER -\nTITLE    4 MORE\n"),
            "CRYSTAL STRUCTURE OF N-ACETYL-X IN COMPLEX WITH A LIGAND - AND WATER - MORE");
  EXPECT_EQ(title_of_pdb("TITLE\n"), "");
  EXPECT_EQ(title_of_pdb(""), "");
}

TEST(Title, OldPdbFilesNameTheCompound) {
  const std::string header = "HEADER    HYDROLASE                               18-NOV-94   1HPV      1HPV   2\n";
  const std::string compound = "COMPND    HIV-1 PROTEASE COMPLEXED WITH VX-478                          1HPV   3\n";
  EXPECT_EQ(title_of_pdb(header + compound), "HIV-1 PROTEASE COMPLEXED WITH VX-478");
  EXPECT_EQ(title_of_pdb(header + "TITLE     THE TITLE\n" + compound), "THE TITLE");
  EXPECT_EQ(title_of_pdb("COMPND    MOL_ID: 1;\nCOMPND   2 MOLECULE: PROTEASE;\n"), "") << "a list";
  EXPECT_EQ(title_of_pdb("COMPND    UNNAMED\n"), "");
}

TEST(Title, PdbStatesItsEntry) {
  const auto entry = [](const std::string& id) {
    return read_text("HEADER    HYDROLASE                               18-NOV-94   " + id + "\n" + kAtom, "a.pdb")
        .entry_id;
  };
  EXPECT_EQ(entry("1HPV"), "1HPV");
  EXPECT_EQ(entry("9abc"), "9abc");
  for (const char* const none : {"", "XXXX", "1H", "1H V", "1H\x01V"}) EXPECT_EQ(entry(none), "") << none;
}

TEST(Title, EveryModelHasThatOfThePdbFile) {
  std::string text = "HEADER    HYDROLASE                               18-NOV-94   1HPV\nTITLE     MANY MODELS\n";
  for (int model = 0; model < 4; ++model) text += "MODEL\n" + kAtom + "ENDMDL\nTITLE     NOT THIS\n";
  const std::string path = ::testing::TempDir() + "bihive_title." + std::to_string(getpid());
  ASSERT_TRUE(write_file(path, text).ok());
  const Result<std::shared_ptr<const Frames>> frames = open_frames(path, {});
  ASSERT_TRUE(frames.ok());
  for (const std::int64_t frame : {3, 0, 2}) {
    const Result<SphereFile> read = (*frames)->read(frame);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->title, "MANY MODELS") << frame;
    EXPECT_EQ(read->entry_id, "1HPV") << frame;
    EXPECT_EQ(read_text(text, "a.pdb", at_frame(frame)).title, "MANY MODELS") << frame;
  }
  std::remove(path.c_str());
}

TEST(Title, MmcifInPairsAndLoops) {
  const std::string atoms =
      "loop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\nC 1 2 3\n";
  SphereFile file = read_text("data_X\n_entry.id 7ABC\n_struct.title 'A \"title\"'\n" + atoms, "a.cif");
  EXPECT_EQ(file.title, "A \"title\"");
  EXPECT_EQ(file.entry_id, "7ABC");
  file = read_text("data_X\n_entry.id ?\n_struct.title\n;Two lines\nof text\n;\n" + atoms, "a.cif");
  EXPECT_EQ(file.title, "Two lines of text");
  EXPECT_EQ(file.entry_id, "");
  file = read_text("data_X\nloop_\n_struct.entry_id\n_struct.title\nX Looped\n" + atoms, "a.cif");
  EXPECT_EQ(file.title, "Looped");
  // Of the block with the atoms.
  file = read_text("data_Y\n_struct.title other\ndata_X\n" + atoms + "data_Z\n_struct.title another\n", "a.cif");
  EXPECT_EQ(file.title, "");
}

TEST(Title, CrystalsHaveTheNameOfTheSubstance) {
  const auto title = [](const std::string& names) {
    return read_text("data_X\n_cell_length_a 4\n_cell_length_b 4\n_cell_length_c 4\n" + names +
                         "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
                         "C1 0.1 0.2 0.3\n",
                     "a.cif")
        .title;
  };
  EXPECT_EQ(title(""), "");
  EXPECT_EQ(title("_publ_section_title\n;\n The structure\n of quartz\n;\n"), "The structure of quartz");
  EXPECT_EQ(title("_publ_section_title 'A study'\n_chemical_name_mineral Quartz\n"), "Quartz");
  EXPECT_EQ(title("_chemical_name_common ?\n_chemical_name_systematic 'silicon dioxide'\n"), "silicon dioxide");
  EXPECT_EQ(title("_chemical.name_common 'rock crystal'\n"), "rock crystal") << "as newer dictionaries write it";
}

TEST(Title, VaspBeginsWithIt) {
  const auto poscar = [](const std::string& first, const std::string& names) {
    return read_text(first + "\n1.0\n4 0 0\n0 4 0\n0 0 4\n" + names + "1 1\nDirect\n0 0 0\n.5 .5 .5\n", "POSCAR").title;
  };
  EXPECT_EQ(poscar("Rock salt, relaxed ! PBE", "Na Cl\n"), "Rock salt, relaxed ! PBE");
  EXPECT_EQ(poscar("Na Cl", "Na Cl\n"), "") << "elements alone";
  EXPECT_EQ(poscar("Na_pv Cl", ""), "") << "they name the spheres";
  EXPECT_EQ(poscar("", "Na Cl\n"), "");
  // Each frame of XDATCAR has the head before it.
  const auto head = [](const std::string& first) { return first + "\n1.0\n4 0 0\n0 4 0\n0 0 4\nNa\n1\n"; };
  const std::string frame = "Direct configuration= 1\n0 0 0\n";
  const std::string text = head("before") + frame + frame + head("after") + frame;
  for (const auto& [at, title] : {std::pair(0, "before"), std::pair(1, "before"), std::pair(2, "after")})
    EXPECT_EQ(read_text(text, "XDATCAR", at_frame(at)).title, title) << at;
}

TEST(Title, GroLeavesTimeAndStepOut) {
  const auto title = [](const std::string& line) {
    return read_text(line + "\n1\n    1WATER  OW1    1   0.126   1.624   1.679\n 1 1 1\n", "a.gro").title;
  };
  EXPECT_EQ(title("Protein in water t=   1.50000 step= 300"), "Protein in water");
  EXPECT_EQ(title("Water, t= 2.0"), "Water");
  EXPECT_EQ(title("at= 3 atoms"), "at= 3 atoms");
  EXPECT_EQ(title("t= 2.0"), "");
  EXPECT_EQ(title("t= unknown"), "t= unknown");
}

TEST(Title, SdfAndMol2NameTheirMolecules) {
  const auto record = [](const std::string& name) {
    return name +
           "\n\n\n  1  0  0  0  0  0  0  0  0  0999 V2000\n    1.0000    2.0000    3.0000 C   0  0\nM  END\n$$$$\n";
  };
  const std::string sdf = record("caffeine") + record("");
  EXPECT_EQ(read_text(sdf, "a.sdf").title, "caffeine");
  EXPECT_EQ(read_text(sdf, "a.sdf", at_frame(1)).title, "");
  const auto mol2 = [](const std::string& name) {
    return read_text("@<TRIPOS>MOLECULE\n" + name + "\n1 0\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n1 C1 1 2 3 C.3\n",
                     "a.mol2")
        .title;
  };
  EXPECT_EQ(mol2("aspirin"), "aspirin");
  EXPECT_EQ(mol2("*****"), "") << "for want of a name";
}

TEST(Title, XyzCommentsOfPlainText) {
  const auto title = [](const std::string& comment) {
    return read_text("1\n" + comment + "\nC 1 2 3\n", "a.xyz").title;
  };
  EXPECT_EQ(title("water, optimised"), "water, optimised");
  EXPECT_EQ(title("benzene: the ring"), "benzene: the ring");
  for (const char* const none : {"", "-76.4 0.01", "12", "energy=-76.4", "frame = 3", "Atoms. Timestep: 0", "---"})
    EXPECT_EQ(title(none), "") << none;
  EXPECT_EQ(title("energy=-7 title=\"two words\""), "two words");
}

TEST(Title, IsOneShortLineWithoutControls) {
  EXPECT_EQ(read_text("1\n \x1b[31mred\x07\ttext \xc2\x9b\xe2\x80\xaeright \xff\xfe \nC 1 2 3\n", "a.xyz").title,
            "[31mred text right");
  // 299 bytes, then a character of three, which is not cut.
  const std::string longest(299, 'a');
  EXPECT_EQ(read_text("1\n" + longest + "\nC 1 2 3\n", "a.xyz").title, longest);
  const std::string cut = read_text("1\n" + std::string(296, 'a') + "\u20ac\u20ac\nC 1 2 3\n", "a.xyz").title;
  EXPECT_EQ(cut, std::string(296, 'a') + "\u2026");
  EXPECT_EQ(one_line("a\u20ac\u20ac\u20ac", 8), "a\u20ac\u2026");
  EXPECT_EQ(one_line("12345678", 8), "12345678");
  EXPECT_EQ(one_line("1234 6789", 8), "1234\u2026");
  EXPECT_EQ(one_line(" \n\t ", 8), "");
}

TEST(Title, ExtendedXyzKeepsIt) {
  SphereFile file = read_text("1\ntitle=\"a \\\"quoted\\\" back\\\\slash\"\nC 1 2 3\n", "a.xyz");
  EXPECT_EQ(file.title, "a \"quoted\" back\\slash");
  const std::string written = write_spheres(file.spheres, SphereFileFormat::extended_xyz, file.title).bytes;
  EXPECT_EQ(read_text(written, "b.extxyz").title, file.title);
}

}  // namespace
}  // namespace bihive
