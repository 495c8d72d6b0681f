#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>

#include "bihive/io/npy.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::error_of;
using test::read_text;

// A file with that header text and those bytes behind it.
std::string npy_file(const std::string& dictionary, const std::string& data, int version = 1) {
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  for (std::size_t i = 0; i < length_bytes; ++i) bytes += static_cast<char>(dictionary.size() >> (8 * i) & 0xff);
  return bytes + dictionary + data;
}

std::string header(const std::string& dtype, const std::string& shape, const char* fortran = "False") {
  return "{'descr': '" + dtype + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }\n";
}

// The bytes of numbers in that type, either end first.
template <class T>
std::string data_of(const std::vector<double>& values, bool big_endian) {
  std::string bytes;
  for (const double value : values) {
    const T typed = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &typed, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += raw[big_endian ? sizeof(T) - 1 - i : i];
  }
  return bytes;
}

const std::vector<double> kRows{1, 2, 3, 0.5, -4, 5.25, 6, 0.25};
const std::vector<double> kColumns{1, -4, 2, 5.25, 3, 6, 0.5, 0.25};

void expect_rows(const std::string& bytes, const std::string& what) {
  const Result<NpyArray> array = parse_npy(bytes, "a.npy");
  ASSERT_TRUE(array.ok()) << what << ": " << array.error().to_string();
  EXPECT_EQ(array->shape, (std::vector<std::int64_t>{2, 4})) << what;
  EXPECT_EQ(array->values, kRows) << what;
}

// No numbers, and a side that would take days to count up to.
TEST(Npy, AnEmptyArrayIsReadAtOnce) {
  for (const char* const order : {"True", "False"})
    for (const char* const shape : {"(0, 1099511627776)", "(1099511627776, 0)", "(0, 9223372036854775807)", "(0,)"}) {
      const Result<NpyArray> array = parse_npy(npy_file(header("<f4", shape, order), ""), "a.npy");
      ASSERT_TRUE(array.ok()) << shape << ": " << array.error().to_string();
      EXPECT_TRUE(array->values.empty());
    }
}

TEST(Npy, ReadsFloatsOfBothSizesOrdersAndEnds) {
  for (const bool big : {false, true}) {
    const std::string end = big ? ">" : "<";
    expect_rows(npy_file(header(end + "f4", "(2, 4)"), data_of<float>(kRows, big)), end + "f4 C");
    expect_rows(npy_file(header(end + "f8", "(2, 4)"), data_of<double>(kRows, big)), end + "f8 C");
    expect_rows(npy_file(header(end + "f4", "(2, 4)", "True"), data_of<float>(kColumns, big)), end + "f4 Fortran");
    expect_rows(npy_file(header(end + "f8", "(2, 4)", "True"), data_of<double>(kColumns, big)), end + "f8 Fortran");
  }
}

TEST(Npy, ReadsWhatNumPyWrote) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BIHIVE_SOURCE_DIR "/tests/data/io")) {
    if (entry.path().extension() != ".npy") continue;
    ++files;
    const Result<SphereFile> file = read_spheres(entry.path().string(), {});
    ASSERT_TRUE(file.ok()) << file.error().to_string();
    ASSERT_EQ(file->spheres.size(), 3) << entry.path();
    EXPECT_EQ(file->spheres.centre(0), (Vec3d{1, 2, 3})) << entry.path();
    EXPECT_EQ(file->spheres.centre(1), (Vec3d{-4, 5.25, 6})) << entry.path();
    EXPECT_EQ(file->spheres.centre(2), (Vec3d{7, 8, -9.5})) << entry.path();
    EXPECT_EQ(file->spheres.radius(0), 0.5) << entry.path();
    EXPECT_EQ(file->spheres.radius(2), 0.0) << entry.path();
  }
  EXPECT_EQ(files, 11);
}

TEST(Npy, ReadsEveryWholeNumber) {
  const std::vector<double> small{0, 1, -1, 127, -128, 5};
  for (const bool big : {false, true}) {
    const std::string end = big ? ">" : "<";
    const std::pair<std::string, std::string> types[] = {{"|i1", data_of<std::int8_t>(small, big)},
                                                         {end + "i2", data_of<std::int16_t>(small, big)},
                                                         {end + "i4", data_of<std::int32_t>(small, big)},
                                                         {end + "i8", data_of<std::int64_t>(small, big)}};
    for (const auto& [dtype, data] : types) {
      const Result<NpyArray> array = parse_npy(npy_file(header(dtype, "(6,)"), data), "a.npy");
      ASSERT_TRUE(array.ok()) << array.error().to_string();
      EXPECT_EQ(array->values, small) << dtype;
      EXPECT_EQ(array->dtype, dtype);
    }
  }
  const std::string ones(8, '\xff');
  EXPECT_EQ(parse_npy(npy_file(header("|u1", "(8,)"), ones), "a")->values, std::vector<double>(8, 255));
  EXPECT_EQ(parse_npy(npy_file(header("<u2", "(4,)"), ones), "a")->values, std::vector<double>(4, 65535));
  EXPECT_EQ(parse_npy(npy_file(header("<u4", "(2,)"), ones), "a")->values, std::vector<double>(2, 4294967295.0));
  EXPECT_EQ(parse_npy(npy_file(header("<u8", "(1,)"), ones), "a")->values, std::vector<double>(1, 0x1p64));
}

TEST(Npy, ReadsEveryHeaderVersionAndSpelling) {
  const std::string data = data_of<float>({1, 2, 3}, false);
  for (const int version : {1, 2, 3})
    EXPECT_EQ(parse_npy(npy_file(header("<f4", "(1, 3)"), data, version), "a")->values, (std::vector<double>{1, 2, 3}));
  for (const char* dictionary : {"{\"shape\":(1,3),\"fortran_order\":False,\"descr\":\"<f4\"}",
                                 "{ 'shape' : (1, 3,) , 'descr' : '=f4', 'fortran_order' : True }   \n"})
    EXPECT_EQ(parse_npy(npy_file(dictionary, data), "a")->values, (std::vector<double>{1, 2, 3})) << dictionary;
}

TEST(Npy, ReadsItsOwnBytes) {
  const std::vector<float> floats{1.5f, -2.25f, std::numeric_limits<float>::infinity(), 4, 5, 6};
  const std::string bytes = npy_bytes(floats, {2, 3});
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ((bytes.size() - 4 * floats.size()) % 64, 0u) << "numbers begin at a multiple of 64 bytes";
  EXPECT_EQ(parse_npy(bytes, "a")->values, std::vector<double>(floats.begin(), floats.end()));
  EXPECT_EQ(parse_npy(bytes, "a")->dtype, "<f4");

  const std::vector<double> doubles{0.1, std::numeric_limits<double>::denorm_min()};
  EXPECT_EQ(parse_npy(npy_bytes(doubles, {2}), "a")->values, doubles);
  EXPECT_EQ(parse_npy(npy_bytes(doubles, {2}), "a")->shape, (std::vector<std::int64_t>{2}));

  const std::vector<std::int64_t> whole{-1, -2, 1LL << 40};
  EXPECT_EQ(parse_npy(npy_bytes(whole, {3, 1}), "a")->values, (std::vector<double>{-1, -2, 0x1p40}));
  EXPECT_TRUE(parse_npy(npy_bytes(std::vector<float>{}, {0, 3}), "a")->values.empty());
}

TEST(Npy, RefusesWhatIsCutOrDisagrees) {
  const std::string data = data_of<float>({1, 2, 3}, false);
  const std::string whole = npy_file(header("<f4", "(1, 3)"), data);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(parse_npy(whole.substr(0, size), "a.npy").ok()) << "cut at " << size;
  EXPECT_FALSE(parse_npy(whole + "x", "a.npy").ok());
  const auto message = [&](const std::string& dictionary) {
    return parse_npy(npy_file(dictionary, data), "a.npy").error().to_string();
  };
  EXPECT_EQ(message(header("<f4", "(2, 3)")),
            "a.npy: the NPY array's shape (2, 3) of <f4 does not agree with the 12 bytes of numbers in the file");
  EXPECT_EQ(message(header("<f4", "(3, 1, 1)")),
            "a.npy: the NPY array's shape is (3, 1, 1); expected one or two dimensions");
  EXPECT_EQ(message(header("<f4", "()")), "a.npy: the NPY array's shape is (); expected one or two dimensions");
  EXPECT_EQ(message(header("<c8", "(1, 3)")),
            "a.npy: the NPY array's type '<c8' is none of f4, f8, i1 to i8, u1 to u8");
  for (const char* dictionary :
       {"", "{}", "{'descr': '<f4'}", "{'descr': '<f4', 'fortran_order': Maybe, 'shape': (1, 3)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, -3)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3), 'more': 1}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3)} x"})
    EXPECT_NE(message(dictionary).find("the NPY header is not what NumPy writes"), std::string::npos) << dictionary;
  EXPECT_NE(parse_npy(npy_file(header("<f4", "(1, 3)"), data, 4), "a").error().message.find("version 4"),
            std::string::npos);
}

TEST(Npy, NeverBelievesAHugeShape) {
  for (const char* shape :
       {"(100000000000, 3)", "(4611686018427387904, 4)", "(9223372036854775807, 9223372036854775807)",
        "(0, 9223372036854775807)", "(99999999999999999999, 3)"}) {
    const Result<NpyArray> array = parse_npy(npy_file(header("<f4", shape), "12345678"), "a.npy");
    EXPECT_FALSE(array.ok()) << shape;
  }
}

TEST(NpySpheres, TakeThreeOrFourColumns) {
  const SphereFile four = read_text(npy_bytes(std::vector<float>{1, 2, 3, 0.5f, 4, 5, 6, 0}, {2, 4}), "a.npy");
  EXPECT_EQ(four.format, "NPY");
  ASSERT_EQ(four.spheres.size(), 2);
  EXPECT_EQ(four.spheres.centre(1), (Vec3d{4, 5, 6}));
  EXPECT_EQ(four.spheres.radius(0), 0.5);
  EXPECT_EQ(four.spheres.radius(1), 0.0);
  EXPECT_TRUE(four.warnings.empty());

  const SphereFile three = read_text(npy_bytes(std::vector<double>{1, 2, 3, 1, 2, 5}, {2, 3}), "named_anything");
  EXPECT_EQ(three.spheres.radius(0), 1);
  ASSERT_EQ(three.warnings.size(), 1u);
  EXPECT_NE(three.warnings[0].find("radius sets another"), std::string::npos);
}

TEST(NpySpheres, NameAWrongShapeAndAWrongNumber) {
  EXPECT_EQ(error_of(npy_bytes(std::vector<float>(10), {2, 5}), "a.npy"),
            "a.npy: the NPY array's shape is (2, 5); expected (n, 3) for x, y, z or (n, 4) for x, y, z, radius; say "
            "which columns these are: columns x=1,y=2,z=3");
  EXPECT_EQ(error_of(npy_bytes(std::vector<float>(4), {4}), "a.npy"),
            "a.npy: the NPY array's shape is (4,); expected (n, 3) for x, y, z or (n, 4) for x, y, z, radius");
  EXPECT_EQ(error_of(npy_bytes(std::vector<float>{}, {0, 3}), "a.npy"),
            "a.npy: there are no spheres in it (read as NPY)");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(error_of(npy_bytes(std::vector<float>{0, 0, 0, 0, nan, 0}, {2, 3}), "a.npy"),
            "a.npy: row 1 (from 0): y is not finite: nan");
  EXPECT_EQ(error_of(npy_bytes(std::vector<float>{0, 0, 0, -1}, {1, 4}), "a.npy"),
            "a.npy: row 0 (from 0): the radius is negative: -1.000000");
  EXPECT_EQ(error_of(npy_bytes(std::vector<float>(3), {1, 3}), "a.npy", test::at_frame(1)),
            "a.npy: there is no frame 1: the file has one only (0); choose one with frame, counting from 0");
}

TEST(Npy, ReadsTheLongNumbersOfPython2) {
  expect_rows(npy_file(header("<f8", "(2L, 4L)"), data_of<double>(kRows, false)), "Python 2");
}

std::string structured(const std::string& fields, const std::string& data, const std::string& shape = "(2,)") {
  return npy_file("{'descr': " + fields + ", 'fortran_order': False, 'shape': " + shape + ", }\n", data);
}

TEST(NpySpheres, TakeTheFieldsOfStructuredArrays) {
  const std::string four = "[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('radius', '<f4')]";
  const SphereFile file = read_text(structured(four, data_of<float>(kRows, false)), "a.npy");
  EXPECT_EQ(file.format, "NPY");
  ASSERT_EQ(file.spheres.size(), 2);
  EXPECT_EQ(file.spheres.centre(1), (Vec3d{-4, 5.25, 6}));
  EXPECT_EQ(file.spheres.radius(1), 0.25);
  EXPECT_EQ(read_text(structured(four, data_of<float>(kRows, false), "(1, 2)"), "a.npy").spheres.size(), 2);

  // Types side by side, arrays in fields, titles, padding, texts, inner structures.
  const std::string mixed =
      "[('id', '>i2'), ('pos', '<f8', (3,)), (('a title', 'ok'), '|b1'), ('', '|V3'), ('name', '<U2'), ('in', [('q', "
      "'<f4')])]";
  std::string rows;
  for (int i = 0; i < 2; ++i)
    rows += data_of<std::int16_t>({7.0 + i}, true) + data_of<double>({1.0 + i, 2, 3}, false) +
            std::string(1, static_cast<char>(i)) + "pad" + std::string(8, 'n') + data_of<float>({0.5}, false);
  const SphereFile of_fields = read_text(structured(mixed, rows), "a.npy");
  ASSERT_EQ(of_fields.spheres.size(), 2);
  EXPECT_EQ(of_fields.spheres.centre(1), (Vec3d{2, 2, 3}));
  const auto numbers = [&](const std::string& name) {
    for (const NamedNumbers& column : of_fields.spheres.attributes().numbers)
      if (column.name == name) return column.values;
    return std::vector<double>();
  };
  EXPECT_EQ(numbers("id"), (std::vector<double>{7, 8}));
  EXPECT_EQ(numbers("ok"), (std::vector<double>{0, 1}));
  EXPECT_EQ(numbers("in.q"), (std::vector<double>{0.5, 0.5}));

  EXPECT_EQ(error_of(structured("[('px', '<f4')]", data_of<float>({1, 2}, false)), "a.npy")
                .rfind("a.npy: no array of the NPY file holds the places: it has px; name the fields x", 0),
            0u);
  EXPECT_NE(error_of(structured(four, "short"), "a.npy").find("does not agree with the 5 bytes"), std::string::npos);
  EXPECT_NE(error_of(structured("[('x', '|O')]", "12345678"), "a.npy").find("whose length is unknown"),
            std::string::npos);
  EXPECT_NE(error_of(structured("[('x', '<f4', (99999999999999999,))]", "1234"), "a.npy").find("length is unknown"),
            std::string::npos);
  const std::string whole = structured(mixed, rows);
  for (std::size_t length = 0; length < whole.size(); ++length)
    (void)read_spheres_from_memory(std::string_view(whole).substr(0, length), "a.npy", {});
}

}  // namespace
}  // namespace bihive
