// Columns that the user chooses: ReadOptions::columns.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "bihive/io/npy.h"
#include "bihive/io/read_spheres.h"

namespace bihive {
namespace {

using testing::HasSubstr;

Result<SphereFile> read_with(const std::string& bytes, const std::string& name, const ColumnChoice& columns) {
  ReadOptions options;
  options.columns = columns;
  return read_spheres_from_memory(bytes, name, options);
}

std::string fault_of(const std::string& bytes, const std::string& name, const ColumnChoice& columns) {
  const Result<SphereFile> file = read_with(bytes, name, columns);
  return file ? "no error" : file.error().to_string();
}

const NamedNumbers* numbers_called(const SphereFile& file, const std::string& name) {
  for (const NamedNumbers& column : file.spheres.attributes().numbers)
    if (column.name == name) return &column;
  return nullptr;
}

TEST(ChosenColumns, FromText) {
  const Result<ColumnChoice> choice = columns_from_text(" x=px, y = py,z=pz,r=5");
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(*choice, (ColumnChoice{{"x", "px"}, {"y", "py"}, {"z", "pz"}, {"r", "5"}}));
  for (const char* const bad : {"", "x", "x=", "=x", "x=1,", "x=1,x=2"})
    EXPECT_FALSE(columns_from_text(bad).ok()) << bad;
}

TEST(ChosenColumns, CsvByName) {
  const std::string csv = "px,py,pz,size,x,mass\n1,2,3,0.5,9,7\n4,5,6,0.25,8,6\n";
  const Result<SphereFile> file =
      read_with(csv, "a.csv", {{"x", "px"}, {"y", "PY"}, {"z", "pz"}, {"diameter", "size"}, {"weight", "mass"}});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file->spheres.radius(0), 0.25);
  // The column that is called x is one of any numbers now; a part that is none renames.
  ASSERT_NE(numbers_called(*file, "x"), nullptr);
  EXPECT_EQ(numbers_called(*file, "x")->values, (std::vector<double>{9, 8}));
  ASSERT_NE(numbers_called(*file, "weight"), nullptr);
  EXPECT_EQ(numbers_called(*file, "mass"), nullptr);
  // The header has no y: without the ending the columns alone say that it is a table.
  EXPECT_TRUE(read_with("px,py,pz\n1,2,3\n", "table", {{"x", "px"}, {"y", "py"}, {"z", "pz"}}).ok());
}

TEST(ChosenColumns, CsvByPlace) {
  const Result<SphereFile> plain =
      read_with("7 1 2 3 0.5 8\n7 4 5 6 0.25 9\n", "a.txt", {{"x", "2"}, {"y", "3"}, {"z", "4"}, {"r", "5"}});
  ASSERT_TRUE(plain.ok()) << plain.error().to_string();
  EXPECT_EQ(plain->spheres.centre(0), (Vec3d{1, 2, 3}));
  EXPECT_EQ(plain->spheres.radius(1), 0.25);
  ASSERT_NE(numbers_called(*plain, "column_6"), nullptr);
  // A name goes before a place.
  const Result<SphereFile> named = read_with("2,1,y,z\n10,20,3,4\n", "a.csv", {{"x", "2"}});
  EXPECT_FALSE(named.ok());  // the first line holds numbers, so it is no header
  const Result<SphereFile> swapped = read_with("x y z\n1 2 3\n", "a.txt", {{"x", "y"}, {"y", "1"}});
  ASSERT_TRUE(swapped.ok());
  EXPECT_EQ(swapped->spheres.centre(0), (Vec3d{2, 1, 3}));
}

TEST(ChosenColumns, Faults) {
  const std::string csv = "x,y,z,a,a\n1,2,3,4,5\n";
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "b"}}),
              HasSubstr("a.csv:1: there is no column 'b' for r; there are 5: x y z a a"));
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "6"}}), HasSubstr("there is no column '6'"));
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "0"}}), HasSubstr("there is no column '0'"));
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "a"}}), HasSubstr("there are 2 columns 'a'"));
  EXPECT_EQ(fault_of(csv, "a.csv", {{"r", "5"}}), "no error");
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "z"}, {"q", "3"}}), HasSubstr("is asked for as q and as r"));
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "z"}}), HasSubstr("there is no z"));
  EXPECT_THAT(fault_of(csv, "a.csv", {{"r", "4"}, {"diameter", "5"}}), HasSubstr("one column for the radius"));
  EXPECT_THAT(fault_of("px,py,pz\n1,2,3\n", "a.csv", {}), HasSubstr("columns x=NAME"));
  EXPECT_THAT(fault_of("1 2 3 4 5\n", "a.txt", {}), HasSubstr("columns x=1"));
  EXPECT_THAT(fault_of("ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 20.25           N\n", "a.pdb",
                       {{"r", "x"}}),
              HasSubstr("the columns of this format cannot be chosen"));
}

TEST(ChosenColumns, LammpsDump) {
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10\n"
      "ITEM: ATOMS id x y z xs ys zs xu yu zu c_size\n1 1 2 3 0.5 0.25 0.125 11 12 13 0.75\n";
  const auto centre = [&](const ColumnChoice& columns) {
    const Result<SphereFile> file = read_with(dump, "a.dump", columns);
    EXPECT_TRUE(file.ok()) << file.error().to_string();
    return file->spheres.centre(0);
  };
  EXPECT_EQ(centre({{"r", "c_size"}}), (Vec3d{1, 2, 3}));
  EXPECT_EQ(centre({{"x", "xu"}, {"y", "yu"}, {"z", "zu"}}), (Vec3d{11, 12, 13}));
  EXPECT_EQ(centre({{"x", "8"}, {"y", "9"}, {"z", "10"}}), (Vec3d{11, 12, 13}));
  // Scaled ones are still brought into the box.
  EXPECT_EQ(centre({{"x", "xs"}, {"y", "ys"}, {"z", "zs"}}), (Vec3d{5, 2.5, 1.25}));
  EXPECT_THAT(fault_of(dump, "a.dump", {{"r", "c_none"}}), HasSubstr("a.dump:9: there is no column 'c_none'"));
  EXPECT_EQ(read_with(dump, "a.dump", {{"r", "c_size"}})->spheres.radius(0), 0.75);
}

TEST(ChosenColumns, ExtendedXyz) {
  const std::string xyz = "1\nProperties=species:S:1:pos:R:3:forces:R:3:rad:R:1\nH 1 2 3 4 5 6 0.5\n";
  const Result<SphereFile> file =
      read_with(xyz, "a.xyz", {{"x", "forces_1"}, {"y", "forces_2"}, {"z", "forces_3"}, {"radius", "rad"}});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.centre(0), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file->spheres.radius(0), 0.5);
  EXPECT_THAT(fault_of("1\n\nH 1 2 3 0.5\n", "a.xyz", {{"r", "5"}}), HasSubstr("there is no column '5'"));
}

TEST(ChosenColumns, Npy) {
  const std::string npy = npy_bytes(std::vector<double>{9, 1, 2, 3, 0.5, 8, 4, 5, 6, 0.25}, {2, 5});
  const Result<SphereFile> file = read_with(npy, "a.npy", {{"x", "2"}, {"y", "3"}, {"z", "4"}, {"r", "5"}});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(file->spheres.radius(1), 0.25);
  EXPECT_THAT(fault_of(npy, "a.npy", {}), HasSubstr("columns x="));
  EXPECT_THAT(fault_of(npy, "a.npy", {{"x", "6"}}), HasSubstr("there is no column '6'"));
}

TEST(ChosenColumns, PlyAndPcd) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property float size\nproperty uchar hue\nend_header\n1 2 3 0.5 7\n";
  const Result<SphereFile> file = read_with(ply, "a.ply", {{"r", "size"}, {"type", "hue"}});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.radius(0), 0.5);
  EXPECT_EQ(file->spheres.attributes().type, (std::vector<std::int32_t>{7}));
  const std::string pcd =
      "VERSION .7\nFIELDS x y z s\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n"
      "1 2 3 0.5\n";
  const Result<SphereFile> cloud = read_with(pcd, "a.pcd", {{"r", "s"}});
  ASSERT_TRUE(cloud.ok()) << cloud.error().to_string();
  EXPECT_EQ(cloud->spheres.radius(0), 0.5);
}

TEST(ChosenColumns, Vtk) {
  const std::string vtk =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOINT_DATA 1\n"
      "SCALARS size float 1\nLOOKUP_TABLE default\n0.5\n";
  const Result<SphereFile> file = read_with(vtk, "a.vtk", {{"r", "size"}});
  ASSERT_TRUE(file.ok()) << file.error().to_string();
  EXPECT_EQ(file->spheres.radius(0), 0.5);
}

}  // namespace
}  // namespace bihive
