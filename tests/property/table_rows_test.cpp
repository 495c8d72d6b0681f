// Rows of a table by all threads: the same rows, the same labels and the same first error as one line after the other;
// and plain numbers have the bits of the careful parser.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/text/plain_number.h"
#include "bihive/io/text/sphere_table.h"

namespace bihive {
namespace {

using RowLines = SphereTable::RowLines;

const std::vector<TableColumn> kColumns = {{"id", ColumnRole::number}, {"type", ColumnRole::type},
                                           {"x", ColumnRole::x},       {"y", ColumnRole::y},
                                           {"z", ColumnRole::z},       {"name", ColumnRole::number}};

// One row after the other: add_rows() promises the same.
Result<std::int64_t> one_by_one(SphereTable& table, TextScanner& scanner, std::int64_t most, RowLines lines) {
  std::int64_t rows = 0;
  while (rows < most) {
    bool found = false;
    if (lines == RowLines::all) {
      found = scanner.next_line();
    } else {
      while (!found && scanner.next_filled_line()) found = trim(scanner.line()).front() != '#';
    }
    if (!found) break;
    if (Status row = table.add_row(scanner); !row) return row.error();
    ++rows;
  }
  return rows;
}

// Several blocks of text, so that all seams are there.
std::string many_rows(std::int64_t rows, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-50, 50);
  std::string text;
  for (std::int64_t i = 0; i < rows; ++i) {
    char line[160];
    const char* const forms[] = {"%ld %ld %g %g %g a%ld\n", "%ld  %ld\t%.9f %.3e %g   a%ld\r\n",
                                 "%ld %ld %+.17g %a %.20f b%ld \n"};
    const bool odd = random() % 50 == 0;
    std::snprintf(line, sizeof line, forms[odd ? 1 : 0], static_cast<long>(i + 1), static_cast<long>(random() % 12),
                  place(random), place(random), place(random), static_cast<long>(random() % 3));
    text += line;
  }
  return text;
}

struct Outcome {
  std::int64_t rows = -1, line = 0;
  std::string error;
  RawSpheres spheres;
};

template <class Add>
Outcome outcome_of(TextScanner scanner, std::int64_t most, RowLines lines, bool comments, const Add& add) {
  SphereTable table(kColumns);
  if (comments) scanner.set_comment('#');
  const Result<std::int64_t> rows = add(table, scanner, most, lines);
  Outcome outcome;
  if (rows) outcome.rows = *rows;
  if (!rows) outcome.error = rows.error().to_string();
  if (rows) outcome.line = scanner.line_number();
  if (rows && *rows > 0) outcome.spheres = std::move(table).take();
  // Both stand at the same place behind it.
  if (rows && scanner.next_line()) outcome.error = "next: " + std::string(scanner.line());
  return outcome;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const Outcome& one, const Outcome& all, const std::string& what) {
  EXPECT_EQ(all.rows, one.rows) << what;
  EXPECT_EQ(all.line, one.line) << what;
  EXPECT_EQ(all.error, one.error) << what;
  EXPECT_TRUE(same_bits(all.spheres.x, one.spheres.x)) << what;
  EXPECT_TRUE(same_bits(all.spheres.y, one.spheres.y)) << what;
  EXPECT_TRUE(same_bits(all.spheres.z, one.spheres.z)) << what;
  EXPECT_TRUE(same_bits(all.spheres.attributes.type, one.spheres.attributes.type)) << what;
  ASSERT_EQ(all.spheres.attributes.numbers.size(), one.spheres.attributes.numbers.size()) << what;
  for (std::size_t i = 0; i < one.spheres.attributes.numbers.size(); ++i)
    EXPECT_TRUE(same_bits(all.spheres.attributes.numbers[i].values, one.spheres.attributes.numbers[i].values)) << what;
  ASSERT_EQ(all.spheres.attributes.texts.size(), one.spheres.attributes.texts.size()) << what;
  for (std::size_t i = 0; i < one.spheres.attributes.texts.size(); ++i) {
    EXPECT_EQ(all.spheres.attributes.texts[i].texts, one.spheres.attributes.texts[i].texts) << what;
    EXPECT_TRUE(
        same_bits(all.spheres.attributes.texts[i].text_of_sphere, one.spheres.attributes.texts[i].text_of_sphere))
        << what;
  }
}

void compare(const std::string& text, std::int64_t most, RowLines lines, bool comments, const std::string& what) {
  const Outcome one = outcome_of(TextScanner(text, "rows.txt"), most, lines, comments, one_by_one);
  const auto all = [](SphereTable& table, TextScanner& scanner, std::int64_t count, RowLines kind) {
    return table.add_rows(scanner, count, kind);
  };
  expect_same(one, outcome_of(TextScanner(text, "rows.txt"), most, lines, comments, all), what + ", in memory");

  // The same through a window.
  const RandomFile file = RandomFile::of_bytes(text, "rows.txt");
  FileText part{file, 0, static_cast<std::int64_t>(text.size()), 0, {}};
  expect_same(one, outcome_of(TextScanner(part), most, lines, comments, all), what + ", through a window");
}

TEST(TableRows, AreThoseOfOneLineAfterTheOther) {
  const std::string text = many_rows(400000, 1);
  ASSERT_GT(text.size(), std::size_t{9} << 20);
  for (const std::int64_t most : {0, 1, 15, 16, 17, 5000, 399999, 400000, 400001})
    compare(text, most, RowLines::all, false, std::to_string(most) + " rows");
  compare(text, std::int64_t{1} << 62, RowLines::data, false, "all rows");
}

TEST(TableRows, TheFirstErrorOfTheFileIsTheError) {
  const std::string text = many_rows(30000, 2);
  std::vector<std::size_t> begins{0};
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) begins.push_back(++at);
  begins.pop_back();
  std::mt19937 random(3);
  const std::string faults[] = {
      "7 1 2 3", "7 1 2 3 4 a0 9",  "7 1 2 x 4 a0",     "7 1 nan 3 4 a0",     "x 1 2 3 4 a0", "",
      "   ",     "7 1 1e39 3 4 a0", "7 1 1e400 3 4 a0", "7 1 2 3 4 \x01\xff", "# 1 2 3 4 a0", "7 1 2 3 4 a0 # said"};
  for (const std::string& fault : faults)
    for (const std::size_t row : {std::size_t{2}, std::size_t{17}, begins.size() / 2, begins.size() - 1}) {
      // A second fault behind it must not be the one that is told.
      std::string broken = text;
      const std::size_t later = begins[row + random() % (begins.size() - row)];
      if (later > begins[row]) broken.insert(later, "7 1 2 later 4 a0\n");
      broken.insert(begins[row], fault + "\n");
      for (const RowLines lines : {RowLines::all, RowLines::data})
        for (const bool comments : {false, true})
          compare(broken, std::int64_t{1} << 62, lines, comments, "'" + fault + "' before row " + std::to_string(row));
    }
}

TEST(TableRows, TheLastLineMayHaveNoEnd) {
  std::string text = many_rows(20000, 4);
  text.pop_back();
  compare(text, 20000, RowLines::all, false, "no end");
  compare(text, 20001, RowLines::all, false, "one too many");
  text.resize(text.rfind(' '));
  compare(text, 20000, RowLines::all, false, "cut");
  compare("", 5, RowLines::all, false, "empty");
  compare("\n\n\n", 5, RowLines::data, false, "blank");
}

TEST(TableRows, OneLineMayBeLongerThanAPart) {
  std::string text = many_rows(100, 5);
  text += "1 2 3 4 5 " + std::string(std::size_t{9} << 20, 'n') + "\n" + many_rows(100, 6);
  compare(text, 1000, RowLines::all, false, "a long text");
}

TEST(TableRows, PlainNumbersHaveTheBitsOfTheCarefulParser) {
  std::mt19937_64 random(7);
  std::int64_t plain = 0;
  const auto check = [&](const std::string& text) {
    const char* at = text.data();
    double value = 0;
    if (!take_plain_number(at, text.data() + text.size(), value) || at != text.data() + text.size()) return;
    ++plain;
    const auto careful = parse_double(text);
    ASSERT_TRUE(careful) << text;
    EXPECT_EQ(std::memcmp(&value, &*careful, sizeof value), 0) << text;
  };
  for (const char* const text : {"0",
                                 "-0",
                                 "0.0",
                                 "-0.0",
                                 "5.",
                                 ".5",
                                 "-.5",
                                 "9007199254740992",
                                 "9007199254740993",
                                 "0.9007199254740992",
                                 "000000000000000001",
                                 "0000000000000000001",
                                 "1e5",
                                 "1.5e-3",
                                 "+1",
                                 "--1",
                                 "",
                                 "-",
                                 ".",
                                 "-.",
                                 "nan",
                                 "inf",
                                 "0x10",
                                 "1 ",
                                 "123456789012345678",
                                 "0.000000000000000001",
                                 "99999999999999999999",
                                 "18446744073709551617"})
    check(text);
  EXPECT_EQ(plain, 10);
  // Random digits with a point anywhere.
  plain = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string text = random() % 2 != 0 ? "-" : "";
    const std::size_t digits = 1 + random() % 19, point = random() % 22;
    for (std::size_t k = 0; k < digits; ++k) {
      if (k == point) text += '.';
      text += static_cast<char>('0' + random() % 10);
    }
    check(text);
  }
  EXPECT_GE(plain, 100000);
}

}  // namespace
}  // namespace bihive
