// GSD files that python3-gsd wrote (tests/data/io/trajectories/make_water), and damaged ones.
#include <gtest/gtest.h>

#include <algorithm>

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

// Arrays in the form of version 1: names of 64 bytes.
class GsdWriter {
 public:
  template <class T>
  void add(std::uint64_t frame, const std::string& name, std::uint8_t type, std::uint32_t columns,
           const std::vector<T>& values) {
    std::size_t id = 0;
    while (id < names_.size() && names_[id] != name) ++id;
    if (id == names_.size()) names_.push_back(name);
    put(index_, frame);
    put(index_, static_cast<std::uint64_t>(values.size() / columns));
    put(index_, static_cast<std::int64_t>(256 + data_.size()));
    put(index_, columns);
    put(index_, static_cast<std::uint16_t>(id));
    put(index_, type);
    put(index_, std::uint8_t{0});
    for (const T& value : values) put(data_, value);
  }
  std::string bytes() const {
    std::string head;
    put(head, std::uint64_t{0x65DF65DF65DF65DF});
    put(head, static_cast<std::uint64_t>(256 + data_.size()));
    put(head, static_cast<std::uint64_t>(index_.size() / 32));
    put(head, static_cast<std::uint64_t>(256 + data_.size() + index_.size()));
    put(head, static_cast<std::uint64_t>(names_.size()));
    put(head, std::uint32_t{0x10004});
    put(head, std::uint32_t{0x10000});
    head.resize(48 + 64);
    head += "hoomd";
    head.resize(256);
    std::string names;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      names += names_[i];
      names.resize(64 * (i + 1));
    }
    return head + data_ + index_ + names;
  }

 private:
  template <class T>
  static void put(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::vector<std::string> names_;
  std::string data_, index_;
};

// The schema: what a frame does not state is that of frame 0 only if the particles are as many, else its default.
TEST(Gsd, FrameZeroCountsForAsManyParticles) {
  constexpr std::uint8_t kWord = 3, kSingle = 9, kByte = 1;
  GsdWriter writer;
  writer.add<std::uint32_t>(0, "particles/N", kWord, 1, {3});
  writer.add<float>(0, "particles/position", kSingle, 3, {1, 0, 0, 2, 0, 0, 3, 0, 0});
  writer.add<std::uint8_t>(0, "particles/types", kByte, 2, {'A', 0, 'B', 0});
  writer.add<std::uint32_t>(0, "particles/typeid", kWord, 1, {1, 1, 0});
  writer.add<float>(0, "particles/diameter", kSingle, 1, {4, 5, 6});
  writer.add<float>(0, "particles/mass", kSingle, 1, {7, 8, 9});
  writer.add<float>(0, "particles/velocity", kSingle, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  writer.add<std::uint32_t>(1, "particles/N", kWord, 1, {2});
  writer.add<float>(1, "particles/position", kSingle, 3, {4, 0, 0, 5, 0, 0});
  writer.add<std::uint32_t>(2, "particles/N", kWord, 1, {0});
  writer.add<float>(3, "particles/position", kSingle, 3, {6, 0, 0, 7, 0, 0, 8, 0, 0});

  const SphereFile fewer = read_text(writer.bytes(), "p.gsd", at_frame(1));
  ASSERT_EQ(fewer.spheres.size(), 2);
  EXPECT_EQ(fewer.spheres.centre(1), (Vec3d{5, 0, 0}));
  EXPECT_EQ(fewer.spheres.attributes().type, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(fewer.spheres.attributes().find_texts("type")->of(1), "A");
  EXPECT_EQ(fewer.spheres.radius(1), 0.5);
  EXPECT_EQ(numbers_of(fewer, "mass"), (std::vector<double>{1, 1}));
  EXPECT_EQ(numbers_of(fewer, "vy"), (std::vector<double>{0, 0}));
  EXPECT_EQ(fewer.frames, 4);

  EXPECT_NE(error_of(writer.bytes(), "p.gsd", at_frame(2)).find("there are no spheres"), std::string::npos);

  const SphereFile as_many = read_text(writer.bytes(), "p.gsd", at_frame(3));
  EXPECT_EQ(as_many.spheres.radius(2), 3);
  EXPECT_EQ(numbers_of(as_many, "mass"), (std::vector<double>{7, 8, 9}));

  GsdWriter wrong;
  wrong.add<float>(0, "particles/N", kSingle, 1, {-1});
  EXPECT_NE(error_of(wrong.bytes(), "p.gsd").find("is no number of particles"), std::string::npos);
}

TEST(Gsd, StatesBonds) {
  constexpr std::uint8_t kWord = 3, kSingle = 9;
  GsdWriter writer;
  writer.add<std::uint32_t>(0, "particles/N", kWord, 1, {3});
  writer.add<float>(0, "particles/position", kSingle, 3, {1, 0, 0, 2, 0, 0, 3, 0, 0});
  writer.add<std::uint32_t>(0, "bonds/N", kWord, 1, {2});
  writer.add<std::uint32_t>(0, "bonds/group", kWord, 2, {2, 1, 0, 1});
  writer.add<float>(1, "particles/position", kSingle, 3, {4, 0, 0, 5, 0, 0, 6, 0, 0});
  writer.add<float>(2, "particles/position", kSingle, 3, {4, 0, 0, 5, 0, 0, 6, 0, 0});
  writer.add<std::uint32_t>(2, "bonds/N", kWord, 1, {1});
  writer.add<std::uint32_t>(2, "bonds/group", kWord, 2, {0, 9});
  writer.add<std::uint32_t>(3, "bonds/N", kWord, 1, {0});
  for (const std::int64_t frame : {0, 1}) {
    const StatedBonds bonds = read_text(writer.bytes(), "p.gsd", at_frame(frame)).spheres.attributes().bonds;
    EXPECT_TRUE(bonds.are_all);
    EXPECT_EQ(bonds.list, (std::vector<StatedBond>{{0, 1, BondOrder::unknown}, {1, 2, BondOrder::unknown}}));
  }
  const SphereFile wrong = read_text(writer.bytes(), "p.gsd", at_frame(2));
  EXPECT_TRUE(wrong.spheres.attributes().bonds.empty());
  EXPECT_TRUE(std::any_of(wrong.warnings.begin(), wrong.warnings.end(), [](const std::string& warning) {
    return warning.find("its bonds are left out") != std::string::npos;
  }));
  EXPECT_TRUE(read_text(writer.bytes(), "p.gsd", at_frame(3)).spheres.attributes().bonds.empty());
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
