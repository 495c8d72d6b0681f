#include <gtest/gtest.h>

#include "bihive/io/packed/unpack.h"
#include "support/gzip.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::gzip;

std::string long_text() {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += std::to_string(i * 7919) + " ";
  return text;
}

TEST(Unpack, GivesBackWhatWasPacked) {
  for (const std::string& text : {std::string(), std::string("x"), long_text()}) {
    const Result<std::string> back = unpack_bytes(gzip(text), "a.gz");
    ASSERT_TRUE(back.ok()) << back.error().to_string();
    EXPECT_EQ(*back, text);
  }
  EXPECT_EQ(*unpack_bytes(gzip(long_text(), 0), "a.gz"), long_text());
}

TEST(Unpack, GoesOnWithFurtherMembersAndPadding) {
  const std::string text = long_text();
  EXPECT_EQ(*unpack_bytes(gzip("one ") + gzip("") + gzip(text), "a.gz"), "one " + text);
  EXPECT_EQ(*unpack_bytes(gzip("one ") + gzip("two") + std::string(512, '\0'), "a.gz"), "one two");
}

// 64 MB of zeros take 64 kB. The limit counts, and is named, before the memory is taken.
TEST(Unpack, RefusesMoreThanTheMemoryHolds) {
  const std::string packed = gzip(std::string(std::size_t{1} << 26, '0'));
  ASSERT_EQ(setenv("BIHIVE_MEMORY", "20000000", 1), 0);
  const Result<std::string> unpacked = unpack_bytes(packed, "bomb.gz");
  ASSERT_EQ(unsetenv("BIHIVE_MEMORY"), 0);
  ASSERT_FALSE(unpacked.ok());
  EXPECT_NE(unpacked.error().to_string().find("BIHIVE_MEMORY allows 20 MB"), std::string::npos)
      << unpacked.error().to_string();
  EXPECT_TRUE(unpack_bytes(packed, "bomb.gz").ok());
}

TEST(Unpack, RefusesCutData) {
  const std::string packed = gzip("some text that is packed") + gzip("and more of it");
  const std::size_t first = gzip("some text that is packed").size();
  for (std::size_t size = 2; size < packed.size(); ++size) {
    if (size == first) continue;
    const Result<std::string> back = unpack_bytes(packed.substr(0, size), "a.gz");
    ASSERT_FALSE(back.ok()) << "cut at " << size;
    if (size < first + 2) continue;  // its second member is not gzip yet
    EXPECT_EQ(back.error().to_string(), "a.gz: the gzip data is cut: it ends before its end mark");
  }
}

TEST(Unpack, RefusesDamagedData) {
  const std::string packed = gzip("some text that is packed, some text that is packed");
  std::string damaged = packed;
  damaged[packed.size() - 6] = static_cast<char>(damaged[packed.size() - 6] ^ 1);
  EXPECT_EQ(unpack_bytes(damaged, "a.gz").error().to_string(), "a.gz: the gzip data is damaged: incorrect data check");
  EXPECT_FALSE(unpack_bytes(std::string("\x1f\x8b") + std::string(50, 'x'), "a.gz").ok());
  EXPECT_EQ(unpack_bytes(packed + "more", "a.gz").error().to_string(),
            "a.gz: the gzip data is damaged: something else follows its end mark");
}

// "1 2 3 0.5\n4 5 6 0.25\n", packed by the programs of these names.
const std::string kXz(
    "\xfd\x37\x7a\x58\x5a\x00\x00\x04\xe6\xd6\xb4\x46\x02\x00\x21\x01\x16\x00\x00\x00\x74\x2f\xe5\xa3"
    "\x01\x00\x14\x31\x20\x32\x20\x33\x20\x30\x2e\x35\x0a\x34\x20\x35\x20\x36\x20\x30\x2e\x32\x35\x0a"
    "\x00\x00\x00\x00\xe3\x6f\x32\xd5\x7c\x75\x28\xf2\x00\x01\x2d\x15\x2f\x0b\x71\x6d\x1f\xb6\xf3\x7d"
    "\x01\x00\x00\x00\x00\x04\x59\x5a",
    80);
const std::string kBzip2(
    "\x42\x5a\x68\x39\x31\x41\x59\x26\x53\x59\x00\xb5\x3f\x37\x00\x00\x06\x58\x00\x00\x10\x40\x01\x7f"
    "\x00\x20\x00\x21\xa1\xa9\xa3\xf4\xa1\x00\x30\x14\x3c\x4d\x88\x45\xcb\xce\xb6\xbe\x2e\xe4\x8a\x70"
    "\xa1\x20\x01\x6a\x7e\x6e",
    54);

TEST(Unpack, TakesXzAndBzip2) {
  const std::pair<std::string, std::string> packings[] = {{"xz", kXz}, {"bzip2", kBzip2}};
  for (const auto& [name, packed] : packings) {
    const std::string text = "1 2 3 0.5\n4 5 6 0.25\n";
    const Result<std::string> back = unpack_bytes(packed, "a");
    if (!back && back.error().message.find("cannot undo " + name) != std::string::npos) continue;  // another build
    ASSERT_TRUE(back.ok()) << back.error().to_string();
    EXPECT_EQ(*back, text);
    EXPECT_EQ(*unpack_bytes(packed + packed, "a"), text + text) << "several in a row";
    EXPECT_EQ(test::read_text(packed, "a.txt." + name).spheres.size(), 2);
    for (std::size_t size = kPackingMarkBytes; size < packed.size(); ++size)
      EXPECT_EQ(unpack_bytes(packed.substr(0, size), "a").error().to_string(),
                "a: the " + name + " data is cut: it ends before its end mark")
          << size;
    std::string damaged = packed;
    damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x20);
    EXPECT_NE(unpack_bytes(damaged, "a").error().to_string().find("the " + name + " data is damaged"),
              std::string::npos);
    EXPECT_FALSE(unpack_bytes(packed + "more", "a").ok());
  }
  EXPECT_EQ(packing_of("BZh9 is no mark"), Packing::none);
}

TEST(Unpack, UnpacksEveryFormat) {
  EXPECT_EQ(test::read_text(gzip("1 2 3 4\n"), "a.txt.gz").format, "CSV");
  EXPECT_EQ(test::read_text(gzip("1\n\nC 1 2 3\n"), "misleading.npy").format, "XYZ");
  EXPECT_EQ(test::read_text(gzip(std::string("x,y,z\n1,2,3\n")), "a.csv.gz").spheres.size(), 1);
  EXPECT_EQ(test::error_of(gzip(""), "a.pdb.gz"), "a.pdb.gz: the file is empty");
  EXPECT_EQ(test::error_of(gzip("1 2 3\n4 5 x\n"), "a.gz"), "a.gz:2:5: expected a number for z but found 'x'");
  EXPECT_EQ(test::error_of(gzip("1 2 3\n").substr(0, 12), "a.pdb.gz"),
            "a.pdb.gz: the gzip data is cut: it ends before its end mark");
}

}  // namespace
}  // namespace bihive
