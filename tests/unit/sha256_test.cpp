// The examples of FIPS 180-4, and parts of any size.
#include "bihive/base/sha256.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace bihive {
namespace {

std::string sha256_of(std::string_view bytes) {
  Sha256 sha;
  sha.add(bytes);
  return sha.digits();
}

TEST(Sha256, has_the_digits_of_the_standard) {
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, does_not_depend_on_the_parts) {
  std::string bytes;
  for (int i = 0; i < 300; ++i) bytes.push_back(static_cast<char>(7 * i));
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    Sha256 in_parts;
    const std::string_view some = std::string_view(bytes).substr(0, length);
    for (std::size_t begin = 0, part = 1; begin < length; begin += part, part = part % 70 + 1)
      in_parts.add(some.substr(begin, part));
    ASSERT_EQ(in_parts.digits(), sha256_of(some)) << length;
  }
}

TEST(Sha256, reads_files) {
  const std::string path = testing::TempDir() + "sha256_test_file";
  std::ofstream(path) << std::string(1 << 20, 'x');  // one whole part
  EXPECT_EQ(*sha256_of_file(path), sha256_of(std::string(1 << 20, 'x')));
  std::remove(path.c_str());
  EXPECT_FALSE(sha256_of_file(path).ok());
}

}  // namespace
}  // namespace bihive
