// Every combination of the parts of --columns on every format: an answer that agrees with itself, or an error.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "bihive/base/write_file.h"
#include "bihive/io/read_spheres.h"

namespace bihive {
namespace {

std::string path_of(const std::string& name) {
  return std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/" + name;
}

// Two spheres in each format with columns, or the name of a file.
struct ColumnFile {
  std::string name, bytes;
  bool is_path = false;
};

std::vector<ColumnFile> column_files() {
  std::vector<ColumnFile> files{
      {"plain.xyz", "2\n\nC 0 0.5 0.25 7\nH 1 0.5 0.25 8\n"},
      {"extended.xyz",
       "2\nProperties=species:S:1:pos:R:3:color:R:3:radius:R:1:charge:R:1 frame=1\n"
       "C 0 1 0.5 0.1 0.2 0.3 1 0.5\nXy 1 1 0.5 0.4 0.5 0.6 1 -0.5\n"},
      {"no_places.xyz", "2\nProperties=species:S:1:a:R:3:b:L:1\nC 0 1 0.5 T\nC 1 0 0.5 F\n"},
      {"a.dump",
       "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
       "ITEM: ATOMS id type x y z xs ys zs radius\n1 1 0 0 0.5 0.1 0.2 0.3 1\n2 2 1 0 0.5 0.4 0.5 0.6 1\n"},
      {"header.csv", "x,y,z,red,green,blue,opacity,name\n0,0,0.5,1,0,1,1,C\n1,0,0.5,0,1,0,0.5,N\n"},
      {"words.csv", "a,b,c,d\n0,0,0.5,C\n1,0,0.5,\n"},
      {"plain.txt", "0 0 0.5 1\n1 0 0.5 1\n"},
      {"wide.txt", "0 0 0.5 1 1 0.5\n1 0 0.5 1 0 0.25\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
       "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float radius\nend_header\n"
       "0 0 0.5 255 0 1 1\n1 0 0.5 0 255 1 1\n"},
      {"a.pcd",
       "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb q\nSIZE 4 4 4 4 4\nTYPE F F F U F\nCOUNT 1 1 1 1 2\nWIDTH 2\nHEIGHT "
       "1\n"
       "POINTS 2\nDATA ascii\n0 0 0.5 255 1 2\n1 0 0.5 65280 0 1\n"},
      {"a.vtk",
       "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0.5 1 0 0.5\nPOINT_DATA 2\n"
       "SCALARS radius float 1\nLOOKUP_TABLE default\n1 1\nCOLOR_SCALARS rgb 3\n1 0 1 0 1 0\nVECTORS v float\n1 0 1 0 "
       "1 0\n"},
      {"a.vtp",
       "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"2\"><Points><DataArray type=\"Float32\" "
       "NumberOfComponents=\"3\" format=\"ascii\">0 0 0.5 1 0 0.5</DataArray></Points><PointData><DataArray "
       "type=\"Float32\" Name=\"radius\" format=\"ascii\">1 1</DataArray><DataArray type=\"UInt8\" Name=\"rgba\" "
       "NumberOfComponents=\"4\" format=\"ascii\">1 2 3 4 5 6 7 "
       "8</DataArray></PointData></Piece></PolyData></VTKFile>"},
  };
  for (const char* const name : {"little_f8_C.npy", "big_f4_F.npy", "columns.npz", "places.npz"})
    files.push_back({name, *read_file(path_of(name))});
  for (const char* const name : {"lammps.nc", "water.h5md", "sets.h5:/table", "sets.h5:/run/xyz"})
    files.push_back({path_of(name), "", true});
  return files;
}

const std::vector<std::string>& parts() {
  static const std::vector<std::string> all = {
      "x",    "y",   "z",     "r",    "radius",  "diameter",     "element", "atomic_number",
      "type", "red", "green", "blue", "opacity", "transparency", "symbol",  "any"};
  return all;
}

// How the read ended: an answer of which each column has a value for each sphere, or an error of one line.
void expect_sound(const ColumnFile& file, const ColumnChoice& columns) {
  ReadOptions options;
  options.columns = columns;
  const Result<SphereFile> read =
      file.is_path ? read_spheres(file.name, options) : read_spheres_from_memory(file.bytes, file.name, options);
  std::string words;
  for (const auto& [part, column] : columns) words += part + "=" + column + " ";
  if (!read) {
    EXPECT_FALSE(read.error().message.empty()) << file.name << " " << words;
    EXPECT_EQ(read.error().to_string().find('\n'), std::string::npos) << file.name << " " << words;
    return;
  }
  const SphereAttributes& attributes = read->spheres.attributes();
  const auto size = static_cast<std::size_t>(read->spheres.size());
  EXPECT_GT(size, 0U) << file.name << " " << words;
  for (const std::size_t count :
       {attributes.element.size(), attributes.type.size(), attributes.colour.size(), attributes.opacity.size()})
    EXPECT_TRUE(count == 0 || count == size) << file.name << " " << words;
  for (const NamedNumbers& column : attributes.numbers)
    EXPECT_EQ(column.values.size(), size) << file.name << " " << words;
  for (const NamedTexts& column : attributes.texts)
    EXPECT_EQ(column.text_of_sphere.size(), size) << file.name << " " << words;
}

TEST(ColumnParts, SingleAndInPairs) {
  const std::vector<std::string> places = {"1", "2", "4", "radius", "0", "99"};
  for (const ColumnFile& file : column_files())
    for (std::size_t a = 0; a < parts().size(); ++a)
      for (const std::string& column_a : places) {
        expect_sound(file, {{parts()[a], column_a}});
        // What is not found alone is not found in a pair.
        if (column_a == "0" || column_a == "99") continue;
        for (std::size_t b = a + 1; b < parts().size(); ++b)
          for (const char* const column_b : {"1", "3"})
            expect_sound(file, {{parts()[a], column_a}, {parts()[b], column_b}});
      }
}

TEST(ColumnParts, ManyAtOnce) {
  std::mt19937 random(20);
  for (const ColumnFile& file : column_files())
    for (int i = 0; i < 400; ++i) {
      ColumnChoice columns;
      // Mostly columns of their own, so that many choices can be made.
      unsigned next = random() % 3;
      for (const std::string& part : parts())
        if (random() % 3 == 0) columns[part] = std::to_string(random() % 8 == 0 ? random() % 9 : ++next);
      if (!columns.empty()) expect_sound(file, columns);
    }
}

TEST(ColumnParts, AreRefusedWithoutColumns) {
  ReadOptions options;
  options.columns = {{"red", "2"}};
  const std::string pdb = "ATOM      1  CA  ALA A   1      11.104   6.134  -6.504  1.00  0.00           C  \n";
  for (const char* const name : {"a.pdb", "a.pqr", "a.gro"})
    EXPECT_FALSE(read_spheres_from_memory(pdb, name, options).ok()) << name;
}

}  // namespace
}  // namespace bihive
