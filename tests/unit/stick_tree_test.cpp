// The tree of sticks.
#include "bihive/render/query/stick_tree.h"

#include <gtest/gtest.h>

#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/base/watch.h"

namespace bihive {
namespace {

std::vector<Aabb> boxes_in_a_row(int count) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i) {
    const float x = static_cast<float>(i) / static_cast<float>(count);
    boxes.push_back({{x, 0, 0}, {x + 0x1p-10F, 0x1p-10F, 0x1p-10F}});
  }
  return boxes;
}

TEST(StickTree, its_build_ends_when_it_is_cancelled) {
  const std::vector<Aabb> boxes = boxes_in_a_row(4096);
  EXPECT_GT(StickTree(boxes).nodes().size(), 256u);
  CancelToken stop;
  const Watch watch({}, &stop);
  WatchedWork work;
  EXPECT_NO_THROW(StickTree{boxes});
  stop.cancel();
  EXPECT_THROW(StickTree{boxes}, Cancelled);
}

}  // namespace
}  // namespace bihive
