// ctest: asan-long
#include "bihive/base/readable.h"

#include <gtest/gtest.h>

#include "bihive/base/result.h"

namespace bihive {
namespace {

TEST(Escaped, LeavesLettersAlone) {
  for (const char* const text : {"", "plain", "back\\slash", "\u00e4\u00f6\u00fc \u00c5", "\u65e5\u672c", "\U0001f600"})
    EXPECT_EQ(escaped(text), text);
}

TEST(Escaped, WritesOutWhatATerminalObeys) {
  EXPECT_EQ(escaped("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(escaped("a\nb\rc\td"), "a\\nb\\x0dc\\x09d");
  EXPECT_EQ(escaped("\u009b1m"), "\\u009b1m") << "CSI as one character of C1";
  EXPECT_EQ(escaped("\x7f"), "\\x7f");
  EXPECT_EQ(escaped("\u202egnp.a"), "\\u202egnp.a") << "writing from right to left";
  EXPECT_EQ(escaped("\u2028"), "\\u2028");
  EXPECT_EQ(escaped(std::string_view("\0", 1)), "\\x00");
}

// Each character of Unicode: Cc, Zl, Zp and Cf are written out, but for the joiners and signs that are seen.
TEST(Escaped, WritesOutWhatNobodySees) {
  for (const char* const text :
       {"\u00ad", "\u061c", "\u180e", "\u200b", "\u200e", "\u200f", "\u2029", "\u202a", "\u202d", "\u2060", "\u2064",
        "\u2066", "\u2069", "\u206f", "\ufeff", "\ufff9", "\U000e0041"}) {
    const std::string line = escaped(text);
    EXPECT_EQ(line.front(), '\\') << line;
    EXPECT_EQ(escaped_lines(text), line);
    EXPECT_EQ(masked(text), "?") << line;
  }
  EXPECT_EQ(escaped("\U000e0041"), "\\U000e0041");
  for (const char* const seen : {"\u200c", "\u200d", "\u0600", "\u06dd", "\u00a0", "\ufe0f", "\ufffd"})
    EXPECT_EQ(escaped(seen), seen);
}

TEST(Escaped, LeavesLinesOfATextAlone) {
  EXPECT_EQ(escaped_lines("a\tb\nc\x1b[2J\r\n"), "a\tb\nc\\x1b[2J\\x0d\n");
  EXPECT_EQ(escaped_lines(escaped("\u009b\n")), "\\u009b\\n") << "what is written out stays so";
  EXPECT_EQ(masked("a\nb\xff"), "a?b?");
}

TEST(Escaped, WritesOutWhatIsNoUtf8) {
  EXPECT_EQ(escaped("a\x9b"
                    "1m"),
            "a\\x9b1m");
  EXPECT_EQ(escaped("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(escaped("cut \xe2\x82"), "cut \\xe2\\x82");
  EXPECT_EQ(escaped("\xc0\x9b"), "\\xc0\\x9b") << "too long a form";
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
}

TEST(RangeText, TellsTheEndsOfANarrowRangeApart) {
  EXPECT_EQ(range_text(1.5, 20), "1.5 to 20");
  EXPECT_EQ(range_text(0.00402472, 1), "0.00402472 to 1");
  EXPECT_EQ(range_text(5399988, 5400012), "5399988 to 5400012");
  EXPECT_EQ(range_text(5399987.75, 5400012.5), "5399987.75 to 5400012.5");
  EXPECT_EQ(range_text(-1, 1e30), "-1 to 1e+30");
}

TEST(Escaped, IsWhatErrorsAre) {
  const Error error{"wrong\n", "two\nlines\x1b[2J.pdb", 3, 0, "hint\u0085"};
  EXPECT_EQ(error.to_string(), "two\\nlines\\x1b[2J.pdb:3: wrong\\n; hint\\u0085");
}

}  // namespace
}  // namespace bihive
