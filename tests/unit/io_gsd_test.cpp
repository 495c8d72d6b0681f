// GSD files that python3-gsd wrote (tests/data/io/trajectories/make_water), and damaged ones.
#include <gtest/gtest.h>

#include "bihive/base/write_file.h"
#include "support/read_text.h"

namespace bihive {
namespace {

using test::at_frame;
using test::error_of;
using test::numbers_of;
using test::read_text;

std::string particles() {
  return *read_file(std::string(BIHIVE_SOURCE_DIR) + "/tests/data/io/trajectories/water.gsd");
}

TEST(Gsd, TakesParticlesOfHoomd) {
  const SphereFile file = read_text(particles(), "p.gsd");
  EXPECT_EQ(file.format, "GSD");
  EXPECT_EQ(file.frames, 2);
  ASSERT_EQ(file.spheres.size(), 4);
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{0, 1, 0}));
  EXPECT_EQ(file.spheres.radius(0), 1);
  EXPECT_EQ(file.spheres.radius(1), 0.5);
  EXPECT_EQ(file.spheres.attributes().type, (std::vector<std::int32_t>{0, 1, 1, 0}));
  EXPECT_EQ(file.spheres.attributes().find_texts("type")->of(1), "small");
  EXPECT_EQ(numbers_of(file, "q"), (std::vector<double>{1, -1, 0, 0}));
  ASSERT_TRUE(file.spheres.cell().has_value());
  EXPECT_EQ(file.spheres.cell()->vectors[1], (Vec3d{6, 12, 0}));
  EXPECT_EQ(file.step, std::optional<std::int64_t>(0));
}

TEST(Gsd, LaterFramesTakeFromTheFirstWhatTheyDoNotSay) {
  const SphereFile file = read_text(particles(), "p.gsd", at_frame(1));
  EXPECT_EQ(file.spheres.centre(2), (Vec3d{0, 2, 0}));
  EXPECT_EQ(file.spheres.radius(0), 1);
  EXPECT_EQ(file.step, std::optional<std::int64_t>(10));
  EXPECT_NE(error_of(particles(), "p.gsd", at_frame(2)).find("frame 2"), std::string::npos);
}

TEST(Gsd, CutAndDamagedFilesAreRefusedOrRead) {
  const std::string whole = particles();
  for (std::size_t length = 1; length < whole.size(); length += 37)
    (void)read_spheres_from_memory(whole.substr(0, length), "p.gsd", {});
  for (std::size_t place = 8; place < whole.size(); place += 5)
    for (const unsigned char value : {0x00, 0x7f, 0xff}) {
      std::string bytes = whole;
      bytes[place] = static_cast<char>(value);
      const Result<SphereFile> file = read_spheres_from_memory(bytes, "p.gsd", {});
      if (file.ok()) {
        EXPECT_LE(file->spheres.size(), 4);
      }
    }
  EXPECT_NE(error_of(whole.substr(0, 100), "p.gsd").find("p.gsd"), std::string::npos);
}

TEST(Gsd, NamesInMessagesAreReadable) {
  // The first name begins with an escape character, and the first array lies outside of the file.
  std::string bytes = particles();
  const auto place_at = [&](std::size_t at) {
    return std::size_t{static_cast<unsigned char>(bytes[at])} +
           256 * std::size_t{static_cast<unsigned char>(bytes[at + 1])};
  };
  bytes[place_at(24)] = '\x1b';
  bytes[place_at(8) + 13] = 1;
  const std::string message = error_of(bytes, "p.gsd");
  EXPECT_NE(message.find("the array ?"), std::string::npos) << message;
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
  EXPECT_NE(message.find("lies outside of it"), std::string::npos) << message;
}

}  // namespace
}  // namespace bihive
