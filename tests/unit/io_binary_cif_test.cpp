// BinaryCIF: every step of its columns, values that CIF must quote, and damaged files.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/io/packed/message_pack.h"
#include "bihive/io/packed/unpack.h"
#include "support/gzip.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using nlohmann::json;
using test::read_text;

template <class T>
json bytes_of(const std::vector<T>& numbers) {
  std::vector<std::uint8_t> bytes(numbers.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return json::binary(std::move(bytes));
}

template <class T>
json array_of(int type, const std::vector<T>& numbers, std::vector<json> steps = {}) {
  steps.push_back({{"kind", "ByteArray"}, {"type", type}});
  return {{"encoding", steps}, {"data", bytes_of(numbers)}};
}

json integers(const std::vector<std::int32_t>& numbers, std::vector<json> steps = {}) {
  return array_of(3, numbers, std::move(steps));
}

json texts(const std::string& all, const std::vector<std::int32_t>& offsets, const std::vector<std::int8_t>& which) {
  return {{"encoding",
           {{{"kind", "StringArray"},
             {"dataEncoding", {{{"kind", "ByteArray"}, {"type", 1}}}},
             {"stringData", all},
             {"offsetEncoding", {{{"kind", "ByteArray"}, {"type", 3}}}},
             {"offsets", bytes_of(offsets)}}}},
          {"data", bytes_of(which)}};
}

json column(const std::string& name, const json& data, const json& mask = nullptr) {
  return {{"name", name}, {"data", data}, {"mask", mask}};
}

json category(const std::string& name, int rows, const std::vector<json>& columns) {
  return {{"name", name}, {"rowCount", rows}, {"columns", columns}};
}

std::string packed(const std::vector<json>& categories) {
  const json file{
      {"version", "0.3.0"}, {"encoder", "test"}, {"dataBlocks", {{{"header", "1abc x"}, {"categories", categories}}}}};
  const std::vector<std::uint8_t> bytes = json::to_msgpack(file);
  return {bytes.begin(), bytes.end()};
}

std::string text_of(const std::string& bytes) {
  const Result<std::string> text = unpack_bytes(bytes, "a.bcif");
  return text ? *text : text.error().to_string();
}

std::string text_of(const json& one_column, int rows) {
  return text_of(packed({category("_c", rows, {one_column})}));
}

TEST(BinaryCif, EveryStepIsUndone) {
  const std::string head = "data_1abc_x\nloop_\n_c.x\n";
  EXPECT_EQ(text_of(column("x", array_of<std::int8_t>(1, {-128, 127})), 2), head + "-128 \n127 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<std::int16_t>(2, {-32768, 0})), 2), head + "-32768 \n0 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<std::uint8_t>(4, {255})), 1), "data_1abc_x\n_c.x 255\n#\n");
  EXPECT_EQ(text_of(column("x", array_of<std::uint16_t>(5, {65535, 1})), 2), head + "65535 \n1 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<std::uint32_t>(6, {4294967295U, 1})), 2), head + "4294967295 \n1 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<float>(32, {0.1F, -2})), 2), head + "0.1 \n-2 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<double>(33, {0.1, 2})), 2), head + "0.1 \n2 \n#\n");
  const json fixed{{"kind", "FixedPoint"}, {"factor", 1000}, {"srcType", 32}};
  const json delta{{"kind", "Delta"}, {"origin", 12340}, {"srcType", 3}};
  EXPECT_EQ(text_of(column("x", integers({5, 1, -20000}, {fixed, delta})), 3), head + "12.345 \n12.346 \n-7.654 \n#\n");
  const json steps{{"kind", "IntervalQuantization"}, {"min", -1.0}, {"max", 1.0}, {"numSteps", 5}, {"srcType", 33}};
  EXPECT_EQ(text_of(column("x", integers({0, 3}, {steps})), 2), head + "-1 \n0.5 \n#\n");
  const json runs{{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", 5}};
  EXPECT_EQ(text_of(column("x", integers({7, 2, -1, 3}, {runs})), 5), head + "7 \n7 \n-1 \n-1 \n-1 \n#\n");
  const auto packing = [](int bytes, bool is_unsigned) {
    return json{{"kind", "IntegerPacking"}, {"byteCount", bytes}, {"isUnsigned", is_unsigned}, {"srcSize", 4}};
  };
  EXPECT_EQ(text_of(column("x", array_of<std::int8_t>(1, {127, 127, 2, -128, -3, 5, 127, 0}, {packing(1, false)})), 4),
            head + "256 \n-131 \n5 \n127 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<std::uint8_t>(4, {255, 0, 254, 255, 255, 1, 9}, {packing(1, true)})), 4),
            head + "255 \n254 \n511 \n9 \n#\n");
  EXPECT_EQ(text_of(column("x", array_of<std::int16_t>(2, {32767, 1, 0, -32768, -1, 6}, {packing(2, false)})), 4),
            head + "32768 \n0 \n-32769 \n6 \n#\n");
}

TEST(BinaryCif, TextsAreQuotedAsCifNeedsIt) {
  const json data = texts("C A'O5' it'sloop_two\nlines;a.", {0, 1, 3, 6, 12, 17, 26, 28, 29}, {0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(
      text_of(column("x", data), 8),
      "data_1abc_x\nloop_\n_c.x\nC \n' A' \n''O5' \n\"' it's\" \n'loop_' \n\n;two\nlines\n;\n \n';a' \n'.' \n#\n");
  // Offsets count units of UTF-16.
  EXPECT_EQ(text_of(column("x", texts("\xc3\xa4\xf0\x9f\x98\x80z", {0, 1, 3, 4}, {2, 1, 0})), 3),
            "data_1abc_x\nloop_\n_c.x\nz \n\xf0\x9f\x98\x80 \n\xc3\xa4 \n#\n");
}

TEST(BinaryCif, MaskedValuesAreThoseOfCif) {
  EXPECT_EQ(text_of(column("x", integers({1, 2, 3}), array_of<std::uint8_t>(4, {0, 1, 2})), 3),
            "data_1abc_x\nloop_\n_c.x\n1 \n. \n? \n#\n");
  EXPECT_EQ(text_of(column("x", texts("A", {0, 1}, {-1, 0})), 2), "data_1abc_x\nloop_\n_c.x\n. \nA \n#\n");
}

std::string two_atoms() {
  const json fixed{{"kind", "FixedPoint"}, {"factor", 1000}, {"srcType", 33}};
  return packed(
      {category("_cell", 1,
                {column("length_a", array_of<double>(33, {10})), column("length_b", array_of<double>(33, {20})),
                 column("length_c", array_of<double>(33, {30})), column("angle_alpha", array_of<double>(33, {90})),
                 column("angle_beta", array_of<double>(33, {90})), column("angle_gamma", array_of<double>(33, {90}))}),
       category("_atom_site", 2,
                {column("group_PDB", texts("ATOMHETATM", {0, 4, 10}, {0, 1})),
                 column("type_symbol", texts("COZN", {0, 1, 2, 4}, {0, 2})), column("auth_seq_id", integers({7, 8})),
                 column("Cartn_x", integers({1000, -2500}, {fixed})), column("Cartn_y", integers({0, 125}, {fixed})),
                 column("Cartn_z", integers({1, 2}, {fixed}))})});
}

TEST(BinaryCif, IsReadAsMmcif) {
  for (const std::string& bytes : {two_atoms(), test::gzip(two_atoms())}) {
    const SphereFile file = read_text(bytes, "1abc.bcif.gz");
    EXPECT_EQ(file.format, "mmCIF");
    ASSERT_EQ(file.spheres.size(), 2);
    EXPECT_EQ(file.spheres.centre(1), (Vec3d{-2.5, 0.125, double(0.002F)}));
    EXPECT_EQ(file.spheres.attributes().element, (std::vector<std::uint8_t>{6, 30}));
    EXPECT_EQ(file.spheres.cell()->vectors[1].y, 20);
  }
}

TEST(BinaryCif, DamageIsNamed) {
  const auto error = [](const json& one_column, int rows) { return text_of(one_column, rows); };
  const std::string damaged = "a.bcif: the BinaryCIF data is damaged: column 'x'";
  EXPECT_EQ(error(column("x", integers({1, 2})), 3), damaged + " has not the 3 rows of its category");
  EXPECT_EQ(error(column("x", array_of<std::uint8_t>(2, {1, 2, 3})), 1), damaged + ": a column has half a number");
  EXPECT_EQ(error(column("x", integers({1}, {{{"kind", "Zip"}}})), 1), damaged + ": the step 'Zip' is unknown");
  EXPECT_EQ(error(column("x", texts("AB", {0, 1, 9}, {0})), 1),
            damaged + ": 'StringArray' has an offset beyond its texts");
  EXPECT_EQ(error(column("x", texts("AB", {0, 1}, {1})), 1),
            damaged + ": 'StringArray' names a text that is not there");
  const json runs{{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", 2}};
  EXPECT_EQ(error(column("x", integers({1, 3}, {runs})), 2), damaged + ": 'RunLength' has too long runs");
  EXPECT_EQ(error(column("x", integers({1, -3}, {runs})), 2), damaged + ": 'RunLength' has too long runs");
  // A number of the file reserves no memory.
  const json many{{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", std::int64_t{1} << 50}};
  EXPECT_NE(error(column("x", integers({1, 3}, {many})), 3).find("memory"), std::string::npos);
  EXPECT_NE(text_of(packed({category("_c d", 1, {column("x", integers({1}))})})).find("has blanks"), std::string::npos);
}

TEST(BinaryCif, NoCutOrChangedByteDoesHarm) {
  const std::string whole = two_atoms();
  for (std::size_t size = 10; size < whole.size(); ++size)
    EXPECT_FALSE(unpack_bytes(whole.substr(0, size), "a").ok()) << size;
  for (std::size_t i = 10; i < whole.size(); ++i)
    for (const int change : {1, 0x80, 0xff}) {
      std::string changed = whole;
      changed[i] = static_cast<char>(changed[i] ^ change);
      (void)unpack_bytes(changed, "a").ok();
    }
}

TEST(MessagePack, NestingEndsAndCountsReserveNothing) {
  EXPECT_EQ(parse_message_pack(std::string(100000, '\x91')).error().message, "it is nested too deep");
  EXPECT_EQ(parse_message_pack("\xdd\xff\xff\xff\xff").error().message, "it ends early");
  EXPECT_EQ(parse_message_pack("\xc6\xff\xff\xff\xff").error().message, "it ends early");
  EXPECT_EQ(parse_message_pack("\xc7").error().message, "it has a type of an extension");
}

TEST(MessagePack, HasTheValuesOfJson) {
  const json all{{"a", {1, -1, 200, 70000, -40000, std::int64_t{1} << 40, -(std::int64_t{1} << 40)}},
                 {"b", {0.5, true, nullptr, std::string(300, 'x')}},
                 {"c", std::vector<int>(20, 3)}};
  const std::vector<std::uint8_t> bytes = json::to_msgpack(all);
  const std::string text(bytes.begin(), bytes.end());  // values are views of it
  const MessagePackValue value = parse_message_pack(text).value();
  const MessagePackValue& a = *value.find("a");
  for (std::size_t i = 0; i < all["a"].size(); ++i) EXPECT_EQ(a.items[i].integer, all["a"][i].get<std::int64_t>());
  const MessagePackValue& b = *value.find("b");
  EXPECT_EQ(b.items[0].number, 0.5);
  EXPECT_EQ(b.items[1].integer, 1);
  EXPECT_EQ(b.items[2].kind, MessagePackValue::Kind::nil);
  EXPECT_EQ(b.items[3].text, std::string(300, 'x'));
  EXPECT_EQ(value.find("c")->items.size(), 20U);
  EXPECT_EQ(value.find("d"), nullptr);
}

}  // namespace
}  // namespace bihive
