// A list of places gives back what was put in, by number and in order, whatever the numbers are.
#include "bihive/io/frames/place_list.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace bihive {
namespace {

bool same(const TextPlace& a, const TextPlace& b) {
  return a.begin == b.begin && a.end == b.end && a.lines_before == b.lines_before;
}

void expect_same(const PlaceList& list, const std::vector<TextPlace>& expected) {
  ASSERT_EQ(list.size(), expected.size());
  EXPECT_EQ(list.empty(), expected.empty());
  std::size_t at = 0;
  for (const TextPlace& place : list) {
    ASSERT_LT(at, expected.size());
    ASSERT_TRUE(same(place, expected[at])) << at;
    ++at;
  }
  EXPECT_EQ(at, expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_TRUE(same(list[i], expected[i])) << i;
  if (!expected.empty()) {
    EXPECT_TRUE(same(list.back(), expected.back()));
  }
}

TEST(PlaceList, EveryLengthAroundItsSpacing) {
  PlaceList list;
  std::vector<TextPlace> expected;
  expect_same(list, expected);
  std::int64_t begin = 0, lines = 0;
  for (int i = 0; i < 200; ++i) {
    expected.push_back({begin, begin + 30 + i % 7, lines});
    list.push_back(expected.back());
    begin = expected.back().end;
    lines += 5;
    expect_same(list, expected);
  }
}

TEST(PlaceList, AnyNumbers) {
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  PlaceList list;
  std::vector<TextPlace> expected{{0, kMost, kLeast}, {kLeast, kMost, kMost}, {kMost, kLeast, 0}, {-1, 0, 1}};
  std::mt19937_64 random(7);
  const auto any = [&] { return static_cast<std::int64_t>(random() >> random() % 64); };
  while (expected.size() < 500) expected.push_back({any(), -any(), any()});
  for (const TextPlace& place : expected) list.push_back(place);
  expect_same(list, expected);
}

TEST(PlaceList, TheLastOneGrows) {
  PlaceList list;
  list.push_back({10, 20, 1});
  list.set_last_end(30);
  list.push_back({50, 60, 4});
  list.set_last_end(70);
  expect_same(list, {{10, 30, 1}, {50, 70, 4}});
}

}  // namespace
}  // namespace bihive
