#include <gtest/gtest.h>

#include <algorithm>

#include "bihive/image/transfer.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::number_names;
using test::numbers_of;
using test::read_text;
using test::with;

const std::string kLegacy =
    "# vtk DataFile Version 3.0\n"
    "a title\n"
    "ASCII\n"
    "DATASET POLYDATA\n"
    "FIELD FieldData 1\n"
    "TIME 1 1 double\n"
    "0.5\n"
    "POINTS 2 float\n"
    "1 2 3 -1\n"
    "-2 -3.5\n"
    "METADATA\nINFORMATION 0\n\n"
    "VERTICES 2 4\n"
    "1 0\n1 1\n"
    "CELL_DATA 2\n"
    "SCALARS of_cells int 1\nLOOKUP_TABLE default\n7 8\n"
    "POINT_DATA 2\n"
    "SCALARS radius double\nLOOKUP_TABLE default\n"
    "0.5 0.25\n"
    "COLOR_SCALARS colours 3\n1 0 0 0 1 0\n"
    "VECTORS v float\n1 0 0 0 1 0\n"
    "FIELD more 2\n"
    "charge 1 2 float\n-1 1\n"
    "other 1 1 int\n5\n";

// The same in XML. The arrays are inserted.
std::string xml(const std::string& attributes, const std::string& format, const std::string& places,
                const std::string& radius, const std::string& rgb) {
  return "<?xml version=\"1.0\"?>\n<!-- a <comment> -->\n<VTKFile type=\"PolyData\" version=\"1.0\" " + attributes +
         ">\n<PolyData>\n<Piece NumberOfPoints=\"2\" NumberOfVerts=\"0\">\n<PointData Scalars=\"radius\">\n"
         "<DataArray type=\"Float64\" Name=\"radius\" format=\"" +
         format + "\"" + radius +
         "</DataArray>\n<DataArray type=\"UInt8\" Name=\"RGB\" NumberOfComponents=\"3\" format=\"" + format + "\"" +
         rgb +
         "</DataArray>\n</PointData>\n<CellData>\n<DataArray type=\"Int32\" Name=\"c\" "
         "format=\"ascii\"/>\n</CellData>\n"
         "<Points>\n<DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"" +
         format + "\"" + places + "</DataArray>\n</Points>\n</Piece>\n</PolyData>\n";
}

const std::string kEnd = "</VTKFile>\n";
const std::string kLittle = "byte_order=\"LittleEndian\" header_type=\"UInt32\"";
const std::string kZlib = kLittle + " compressor=\"vtkZLibDataCompressor\"";

std::string xml_text() {
  return xml(kLittle, "ascii", ">\n 1 2 3\n -1 -2 -3.5\n", ">0.5 0.25", ">1 0 0 0 255 0") + kEnd;
}
std::string xml_inline() {
  return xml(kLittle, "binary", ">\n  GAAAAAAAgD8AAABAAABAQAAAgL8AAADAAABgwA==\n",
             ">EAAAAAAAAAAAAOA/AAAAAAAA0D8=", ">BgAAAAEAAAD/AA==") +
         kEnd;
}
std::string xml_packed() {
  return xml(kZlib, "binary", ">AgAAABAAAAAIAAAAFQAAABAAAAA=eJxjYGiwZ2BgcAAiIG7YDwARAgK/eJxjYGA4wMCQcAAABUgB4Q==",
             ">AQAAABAAAAAAAAAAEgAAAA==eJxjYACBB/ZgiuGCPQAM5gIv", ">AQAAABAAAAAGAAAADgAAAA==eJxjZGBg+M8AAAIKAQE=") +
         kEnd;
}
std::string xml_appended(bool raw) {
  const std::string places = "GAAAAAAAgD8AAABAAABAQAAAgL8AAADAAABgwA==", radius = "EAAAAAAAAAAAAOA/AAAAAAAA0D8=",
                    rgb = "BgAAAAEAAAD/AA==";
  if (!raw)
    return xml(kLittle, "appended", " offset=\"0\">", " offset=\"40\">", " offset=\"68\">") +
           "<AppendedData encoding=\"base64\">\n _" + places + radius + rgb + "\n</AppendedData>\n" + kEnd;
  std::string bytes;
  const auto put = [&bytes](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(24U), put(1.0F), put(2.0F), put(3.0F), put(-1.0F), put(-2.0F), put(-3.5F);
  put(16U), put(0.5), put(0.25);
  put(6U), bytes += std::string("\1\0\0\0\xff\0", 6);
  return xml(kLittle, "appended", " offset=\"0\">", " offset=\"28\">", " offset=\"48\">") +
         "<AppendedData encoding=\"raw\">\n _" + bytes + "\n</AppendedData>\n" + kEnd;
}

void expect_two_points(const std::string& text, const std::string& name) {
  const SphereFile file = read_text(text, name);
  EXPECT_EQ(file.format, "VTK");
  ASSERT_EQ(file.spheres.size(), 2) << name;
  EXPECT_EQ(file.spheres.centre(0), (Vec3d{1, 2, 3})) << name;
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{-1, -2, -3.5})) << name;
  EXPECT_EQ(file.spheres.radius(0), 0.5) << name;
  EXPECT_EQ(file.spheres.radius(1), 0.25) << name;
  EXPECT_TRUE(file.warnings.empty());
}

TEST(VtkLegacy, TakesPointsAndTheirArrays) {
  expect_two_points(kLegacy, "a.vtk");
  const SphereFile file = read_text(kLegacy, "a.vtk");
  EXPECT_EQ(number_names(file), (std::vector<std::string>{"v_1", "v_2", "v_3", "charge"}));
  EXPECT_EQ(numbers_of(file, "charge"), (std::vector<double>{-1, 1}));
  EXPECT_EQ(file.spheres.attributes().colour[1], (Vec3f{0, 1, 0}));
}

TEST(VtkLegacy, TakesBigEndianBinary) {
  std::string text = "# vtk DataFile Version 5.1\nb\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n";
  const auto put = [&text](auto value) {
    const std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    text += std::string(bytes.rbegin(), bytes.rend());
  };
  put(1.0F), put(2.0F), put(3.0F), put(-1.0F), put(-2.0F), put(-3.5F);
  text += "\nCELLS 2 1\nOFFSETS vtktypeint64\n";
  put(std::int64_t{0}), put(std::int64_t{1});
  text += "\nCONNECTIVITY vtktypeint64\n";
  put(std::int64_t{10});  // a line end's byte inside of numbers
  text += "\nCELL_TYPES 1\n";
  put(1);
  text += "\nPOINT_DATA 2\nSCALARS radius double\nLOOKUP_TABLE default\n";
  put(0.5), put(0.25);
  text += "\nSCALARS flag unsigned_char 1\n\n\n";  // two numbers, both 10, without a table
  text += "\nVECTORS v float\n";
  for (int i = 0; i < 6; ++i) put(float(i));
  text += "\n";
  expect_two_points(text, "a.vtk");
  EXPECT_EQ(numbers_of(read_text(text, "a.vtk"), "flag"), (std::vector<double>{10, 10}));
  EXPECT_EQ(numbers_of(read_text(text, "a.vtk"), "v_3"), (std::vector<double>{2, 5}));
  for (std::size_t length = 0; length < text.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(text).substr(0, length), "a.vtk", {});
}

TEST(VtkLegacy, SaysWhereItIsWrong) {
  EXPECT_EQ(error_of(with(kLegacy, "-2 -3.5", "-2 x"), "a"), "a:10: expected a number but found 'x'");
  EXPECT_EQ(error_of(with(kLegacy, "-2 -3.5", "-2 nan"), "a"), "a: point 1 (from 0): z is not finite: nan");
  EXPECT_NE(error_of(with(kLegacy, "POINTS 2", "POINTS 200000000"), "a").find("the file ends inside of an array"),
            std::string::npos);
  EXPECT_NE(
      error_of(with(kLegacy, "POINTS 2", "POINTS 9000000000000000000"), "a").find("expected the number of points"),
      std::string::npos);
  EXPECT_NE(error_of(with(kLegacy, "POINT_DATA 2", "POINT_DATA 3"), "a").find("POINT_DATA is of 3 points"),
            std::string::npos);
  EXPECT_NE(error_of(with(kLegacy, "VERTICES 2 4\n1 0\n1 1", "POINTS 1 float\n1 0 0"), "a").find("POINTS come twice"),
            std::string::npos);
  EXPECT_NE(error_of(with(kLegacy, "POLYDATA", "STRUCTURED_POINTS"), "a").find("no points of its own"),
            std::string::npos);
  EXPECT_NE(error_of(with(kLegacy, "VECTORS", "ARROWS"), "a").find("the keyword 'ARROWS' is unknown"),
            std::string::npos);
  EXPECT_NE(error_of(with(kLegacy, "ASCII", "TEXT"), "a").find("a:3: expected ASCII or BINARY"), std::string::npos);
  EXPECT_NE(error_of(kLegacy, "a", at_frame(1)).find("there is no frame 1"), std::string::npos);
  for (std::size_t length = 0; length < kLegacy.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(kLegacy).substr(0, length), "a.vtk", {});
}

TEST(VtkXml, TakesEveryEncoding) {
  expect_two_points(xml_text(), "text.vtp");
  expect_two_points(xml_inline(), "inline.vtp");
  expect_two_points(xml_packed(), "packed.vtp");
  expect_two_points(xml_appended(false), "appended.vtp");
  expect_two_points(xml_appended(true), "raw.vtp");
  const SphereFile file = read_text(xml_text(), "a.vtp");
  EXPECT_EQ(file.spheres.attributes().colour[0].x, static_cast<float>(linear_from_srgb(1.0 / 255)));
  // The length in eight bytes, padded by itself.
  std::string text =
      with(xml(kLittle, "ascii", ">GAAAAAAAAAA=AACAPwAAAEAAAEBAAACAvwAAAMAAAGDA", ">0.5 0.25", ">0 0 0 0 0 0") + kEnd,
           "UInt32", "UInt64");
  text = with(text, "Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\"",
              "Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\"");
  expect_two_points(text, "padded.vtp");
}

TEST(VtkXml, JoinsPieces) {
  std::string text = xml_text();
  const std::size_t begin = text.find("<Piece"), end = text.find("</PolyData>");
  const std::string piece = text.substr(begin, end - begin);
  text.insert(end, piece);
  const SphereFile file = read_text(text, "a.vtp");
  ASSERT_EQ(file.spheres.size(), 4);
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{1, 2, 3}));
  EXPECT_EQ(file.spheres.radius(3), 0.25);
}

TEST(VtkXml, SaysWhereItIsWrong) {
  EXPECT_NE(error_of(with(xml_text(), "-1 -2 -3.5", "-1 -2 x"), "a").find("expected a number but found 'x'"),
            std::string::npos);
  EXPECT_NE(error_of(with(xml_text(), "-1 -2 -3.5", "-1 -2"), "a").find("expected 6 numbers but found 5"),
            std::string::npos);
  EXPECT_NE(error_of(with(xml_text(), "-1 -2 -3.5", "-1 -2 3 4"), "a").find("expected 6 numbers but found more"),
            std::string::npos);
  EXPECT_EQ(error_of(with(xml_text(), "-1 -2 -3.5", "-1 -2 inf"), "a"), "a: point 1 (from 0): z is not finite: inf");
  EXPECT_NE(error_of(with(xml_text(), "0.5 0.25", "0.5 -1"), "a").find("radius is negative: -1"), std::string::npos);
  EXPECT_NE(error_of(with(xml_inline(), "GAAAAAAA", "GQAAAAAA"), "a").find("it states 25"), std::string::npos);
  EXPECT_NE(error_of(with(xml_packed(), "eJxjYGiw", "eJxjYGix"), "a").find("packed block 0 is damaged"),
            std::string::npos);
  EXPECT_NE(error_of(with(xml_packed(), "vtkZLib", "vtkLZ4"), "a").find("packed by 'vtkLZ4DataCompressor'"),
            std::string::npos);
  EXPECT_NE(error_of(with(xml_appended(false), "offset=\"68\"", "offset=\"680\""), "a").find("offset is not in the"),
            std::string::npos);
  EXPECT_NE(
      error_of(with(xml_text(), "NumberOfPoints=\"2\"", "NumberOfPoints=\"-2\""), "a").find("expected NumberOfPoints"),
      std::string::npos);
  EXPECT_FALSE(error_of(with(xml_text(), "NumberOfPoints=\"2\"", "NumberOfPoints=\"900000000000\""), "a").empty());
  EXPECT_NE(
      error_of(with(xml_text(), "type=\"PolyData\"", "type=\"ImageData\""), "a").find("'ImageData' has no points"),
      std::string::npos);
  EXPECT_NE(error_of(xml_text(), "a", at_frame(1)).find("there is no frame 1"), std::string::npos);
  for (const std::string& text : {xml_text(), xml_inline(), xml_packed(), xml_appended(false), xml_appended(true)})
    for (std::size_t length = 0; length < text.size(); length += 3)
      (void)read_spheres_from_memory(std::string_view(text).substr(0, length), "a.vtp", {});
}

TEST(VtkLegacy, LeavesTextsOutAndTakesBits) {
  const std::string arrays =
      "FIELD more 4\nlabel 1 2 string\na%20b\n\n\nflag 1 2 bit\n1 0\n\nmixed 1 2 variant\n6 1\n13 x\nradius 1 2 "
      "float\n0.5 0.25\n";
  const SphereFile file = read_text(
      "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 3 4 5 6\n"
      "POINT_DATA 2\n" +
          arrays,
      "a.vtk");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.radius(1), 0.25);
  EXPECT_EQ(numbers_of(file, "flag"), (std::vector<double>{1, 0}));
  EXPECT_NE(
      std::find(file.rules.begin(), file.rules.end(), "arrays of another length or kind are left out: 'label' 'mixed'"),
      file.rules.end());

  // In binary a text stands behind its length, whose first two bits tell its width; eight bits are a byte.
  std::string text = "# vtk DataFile Version 5.1\nb\nBINARY\nDATASET POLYDATA\nPOINTS 9 float\n";
  const auto put = [&text](auto value) {
    const std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    text += std::string(bytes.rbegin(), bytes.rend());
  };
  for (int i = 0; i < 27; ++i) put(float(i));
  text += "\nPOINT_DATA 9\nFIELD more 3\nlabel 1 9 string\n";
  for (int i = 0; i < 7; ++i)
    text +=
        "\xc2"
        "a\n";
  put(std::uint16_t{0x8000 | 70}), text += std::string(70, 'x');
  put(std::uint32_t{0x40000000 | 3}), text += "abc";
  text += "\nflag 1 9 bit\n";
  put(std::uint8_t{0xa0}), put(std::uint8_t{0x80});
  text += "\nradius 1 9 float\n";
  for (int i = 0; i < 9; ++i) put(0.5F);
  const SphereFile binary = read_text(text, "a.vtk");
  ASSERT_EQ(binary.spheres.size(), 9);
  EXPECT_EQ(binary.spheres.radius(8), 0.5);
  EXPECT_EQ(numbers_of(binary, "flag"), (std::vector<double>{1, 0, 1, 0, 0, 0, 0, 0, 1}));
  for (std::size_t length = 0; length < text.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(text).substr(0, length), "a.vtk", {});
}

TEST(VtkLegacy, KeywordsMayBeInEitherCase) {
  const std::size_t head = kLegacy.find("ASCII");
  std::string lower = kLegacy;
  for (std::size_t i = head; i < lower.size(); ++i)
    if (lower[i] >= 'A' && lower[i] <= 'Z') lower[i] = static_cast<char>(lower[i] - 'A' + 'a');
  expect_two_points(lower, "a.vtk");
  EXPECT_EQ(number_names(read_text(lower, "a.vtk")), number_names(read_text(kLegacy, "a.vtk")));
}

TEST(VtkXml, NumbersMayHaveBlanksAroundThem) {
  std::string text = with(xml_appended(true), "offset=\"28\"", "offset=\"  28 \"");
  text = with(with(text, "NumberOfPoints=\"2\"", "NumberOfPoints=\"    2\""), "NumberOfComponents=\"3\" format",
              "NumberOfComponents=\" 3\" format");
  expect_two_points(text, "a.vtp");
}

TEST(VtkXml, WithoutAFormatArraysAreText) {
  std::string text = xml_text();
  for (std::size_t at; (at = text.find(" format=\"ascii\"")) != std::string::npos;) text.erase(at, 15);
  expect_two_points(text, "a.vtp");
}

TEST(VtkXml, PiecesMayDiffer) {
  const std::string text = xml_text();
  const std::size_t begin = text.find("<Piece"), end = text.find("</PolyData>");
  const std::string piece = text.substr(begin, end - begin);
  // A piece without points says nothing of the arrays.
  std::string empty = text;
  empty.insert(begin,
               "<Piece NumberOfPoints=\"0\"><Points><DataArray type=\"Float32\" Name=\"Points\" "
               "NumberOfComponents=\"3\" format=\"ascii\"></DataArray></Points></Piece>\n");
  expect_two_points(empty, "a.vtp");
  // In another order; an array that is not in all of them is left out.
  std::string other = piece;
  other = with(other, "Name=\"radius\"", "Name=\"mass\"");
  std::string both = text;
  both.insert(end, other);
  const SphereFile file = read_text(both, "a.vtp");
  ASSERT_EQ(file.spheres.size(), 4);
  EXPECT_TRUE(number_names(file).empty());
  EXPECT_EQ(file.spheres.attributes().colour.size(), 4u);
  EXPECT_NE(
      std::find(file.rules.begin(), file.rules.end(), "arrays of another length or kind are left out: 'radius' 'mass'"),
      file.rules.end());
}

}  // namespace
}  // namespace bihive
