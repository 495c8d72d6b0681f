#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

TEST(ParseDouble, ReadsWhatANumberMayLookLike) {
  EXPECT_EQ(parse_double("0"), 0.0);
  EXPECT_EQ(parse_double("-2.5"), -2.5);
  EXPECT_EQ(parse_double("+1e-3"), 1e-3);
  EXPECT_EQ(parse_double(".5"), 0.5);
  EXPECT_EQ(parse_double("5."), 5.0);
  EXPECT_EQ(parse_double("1E5"), 1e5);
  EXPECT_EQ(parse_double("0.1"), 0.1);
  EXPECT_EQ(parse_double("9007199254740993"), 9007199254740992.0) << "ties go to even";
  EXPECT_EQ(parse_double("2.2250738585072011e-308"), 2.2250738585072011e-308);
  EXPECT_TRUE(std::signbit(*parse_double("-0")));
  EXPECT_TRUE(std::isnan(*parse_double("nan")));
  EXPECT_EQ(parse_double("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse_double("1e400"), std::numeric_limits<double>::infinity());
}

TEST(ParseDouble, ReadsExponentsOfFortran) {
  EXPECT_EQ(parse_double("1.0D+03"), 1000.0);
  EXPECT_EQ(parse_double("-2.5d-1"), -0.25);
  EXPECT_EQ(parse_double("+.5D0"), 0.5);
  EXPECT_EQ(parse_double("2.d0"), 2.0);
  EXPECT_EQ(parse_double("1D+2"), 100.0);
  // Names, such as those of entries of the PDB.
  for (const char* text :
       {"4D12", "1d0", "D1.0", "1.0D", "1.0D+", "1.0DD1", "1.0D1.0", "1.0D1E1", "1.0E1D1", ".D1", "1.0 D1"})
    EXPECT_FALSE(parse_double(text).has_value()) << "'" << text << "'";
}

TEST(ParseDouble, RefusesEverythingElse) {
  for (const char* text :
       {"", "+", "-", ".", "1x", "1 ", " 1", "1,5", "1.2.3", "--1", "+-1", "++1", "e5", "1e", "0x10", "1.#QNAN", "abc"})
    EXPECT_FALSE(parse_double(text).has_value()) << "'" << text << "'";
}

TEST(ParseDouble, DoesNotCareForTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, locale)) break;
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_FALSE(parse_double("1,5").has_value());
  std::setlocale(LC_ALL, before.c_str());
}

TEST(ParseInt, ReadsWholeNumbersThatFit) {
  EXPECT_EQ(parse_int("0"), 0);
  EXPECT_EQ(parse_int("-17"), -17);
  EXPECT_EQ(parse_int("+4"), 4);
  EXPECT_EQ(parse_int("100000000000"), 100000000000);
  EXPECT_EQ(parse_int("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  for (const char* text : {"", "9223372036854775808", "1.0", "1e3", "0x1", "1 ", "+-1"})
    EXPECT_FALSE(parse_int(text).has_value()) << "'" << text << "'";
}

std::vector<std::string> fields_of(TextScanner& scanner) {
  std::vector<std::string> fields;
  for (std::string_view field; scanner.next_field(field);) fields.emplace_back(field);
  return fields;
}
using Fields = std::vector<std::string>;

TEST(TextScanner, GoesThroughLinesWithAnyEnd) {
  TextScanner scanner("a b\r\n\n  c\td  \nlast", "file");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "a b");
  EXPECT_EQ(scanner.lines_left(), 3);
  EXPECT_EQ(fields_of(scanner), (Fields{"a", "b"}));
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line_number(), 3);
  EXPECT_EQ(scanner.count_fields(), 2);
  EXPECT_EQ(fields_of(scanner), (Fields{"c", "d"}));
  EXPECT_FALSE(scanner.at_end());
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "last");
  EXPECT_TRUE(scanner.at_end());
  EXPECT_FALSE(scanner.ends_in_newline());
  EXPECT_EQ(scanner.lines_left(), 0);
  EXPECT_FALSE(scanner.next_line());
  EXPECT_EQ(scanner.line_number(), 4);
}

TEST(TextScanner, SkipsAByteOrderMark) {
  TextScanner scanner("\xEF\xBB\xBFx", "file");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), "x");
}

TEST(TextScanner, SaysWhereAFieldBegins) {
  TextScanner scanner("ok\n  one   two", "file");
  for (int line = 0; line < 2; ++line) ASSERT_TRUE(scanner.next_line());
  std::string_view field;
  ASSERT_TRUE(scanner.next_field(field));
  ASSERT_TRUE(scanner.next_field(field));
  EXPECT_EQ(scanner.field_error("bad").to_string(), "file:2:9: bad");
  EXPECT_EQ(scanner.line_error("bad", "do this").to_string(), "file:2: bad; do this");
  EXPECT_EQ(scanner.column_error(31, "bad").to_string(), "file:2:31: bad");
}

TEST(TextScanner, SplitsAtSeparatorsWithQuotes) {
  TextScanner scanner("1, \"a,b\" ,\"say \"\"hi\"\"\",, last ,\n,\n\"open, 2\n\"x\"y,3\n", "file");
  scanner.set_separator(',');
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.count_fields(), 6);
  EXPECT_EQ(fields_of(scanner), (Fields{"1", "a,b", "say \"hi\"", "", "last", ""}));
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(fields_of(scanner), (Fields{"", ""}));
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(fields_of(scanner), (Fields{"\"open, 2"})) << "an open quote takes the rest of the line, quote and all";
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(fields_of(scanner), (Fields{"\"x\"y", "3"})) << "text behind a closing quote makes the quotes plain";
}

TEST(TextScanner, CutsCommentsAndBeginsALineAgain) {
  TextScanner scanner("# all\n1 2 # rest\n#\n", "file");
  scanner.set_comment('#');
  ASSERT_TRUE(scanner.next_filled_line());
  EXPECT_EQ(scanner.line_number(), 2);
  EXPECT_EQ(fields_of(scanner), (Fields{"1", "2"}));
  scanner.restart_line();
  EXPECT_EQ(fields_of(scanner), (Fields{"1", "2"}));
  scanner.set_comment(0);
  EXPECT_EQ(fields_of(scanner), (Fields{"1", "2", "#", "rest"}));
  scanner.set_comment('#');
  EXPECT_FALSE(scanner.next_filled_line());
}

TEST(Printable, KeepsUtf8AndNothingElse) {
  for (const char* good : {"", "plain ~", "Gr\u00f6\u00dfe", "\u0394\u221e", "\U0001F600", "\uFFFD"})
    EXPECT_EQ(printable(good), good);
  EXPECT_EQ(printable("a\nb\x1b[31m\x7f"), "a?b?[31m?");
  EXPECT_EQ(printable("Gr\xf6\xdf"
                      "e"),
            "Gr??e")
      << "Latin-1";
  EXPECT_EQ(printable("\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xe0\x80\x80"),
            "?? ??? ?"
            "?"
            "?"
            "? ??"
            "?")
      << "overlong forms, surrogates, beyond the last code point";
  EXPECT_EQ(printable(std::string("\0x", 2)), "?x");
}

TEST(Quote, KeepsMessagesReadable) {
  EXPECT_EQ(quote("abc"), "'abc'");
  EXPECT_EQ(quote("a\tb\x01"), "'a?b?'");
  EXPECT_EQ(quote("\xff"), "'?'");
  EXPECT_EQ(quote(std::string(39, 'x') + "\u00e9"), "'" + std::string(39, 'x') + "?...'") << "never half a letter";
  EXPECT_EQ(quote(std::string(100, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace bihive
