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

TEST(Escaped, WritesOutWhatIsNoUtf8) {
  EXPECT_EQ(escaped("a\x9b"
                    "1m"),
            "a\\x9b1m");
  EXPECT_EQ(escaped("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(escaped("cut \xe2\x82"), "cut \\xe2\\x82");
  EXPECT_EQ(escaped("\xc0\x9b"), "\\xc0\\x9b") << "too long a form";
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
}

TEST(Escaped, IsWhatErrorsAre) {
  const Error error{"wrong\n", "two\nlines\x1b[2J.pdb", 3, 0, "hint\u0085"};
  EXPECT_EQ(error.to_string(), "two\\nlines\\x1b[2J.pdb:3: wrong\\n; hint\\u0085");
}

}  // namespace
}  // namespace bihive
