
#include <gtest/gtest.h>

#include <vector>

#include "bihive/geometry/sphere_attributes.h"

namespace bihive {
namespace {

using List = std::vector<StatedBond>;

StatedBonds chain(std::int32_t count) {
  StatedBonds bonds;
  for (std::int32_t i = 0; i + 1 < count; ++i) bonds.add(i + 1, i, BondOrder::single);
  bonds.put_in_order();
  return bonds;
}

TEST(StatedBonds, are_in_order_and_each_stands_once) {
  StatedBonds bonds;
  bonds.add(4, 2, BondOrder::single);
  bonds.add(3, 3);
  bonds.add(0, 7);
  bonds.add(2, 4, BondOrder::aromatic);
  bonds.add(2, 3, BondOrder::double_bond);
  bonds.put_in_order();
  EXPECT_EQ(bonds.list,
            (List{{0, 7, BondOrder::unknown}, {2, 3, BondOrder::double_bond}, {2, 4, BondOrder::aromatic}}));
}

TEST(StatedBonds, of_hidden_spheres_go_and_the_others_are_counted_anew) {
  StatedBonds bonds = chain(5);
  bonds.are_all = true;
  bonds.keep_only({1, 0, 1, 1, 1});
  EXPECT_EQ(bonds.list, (List{{1, 2, BondOrder::single}, {2, 3, BondOrder::single}}));
  EXPECT_TRUE(bonds.are_all);
}

TEST(StatedBonds, of_a_part_keep_to_its_order) {
  EXPECT_EQ(chain(5).part({3, 0, 2}).list, (List{{0, 2, BondOrder::single}}));
  // The k-th naming of one end to the k-th of the other.
  EXPECT_EQ(chain(3).part({0, 1, 0, 1, 0}).list, (List{{0, 1, BondOrder::single}, {2, 3, BondOrder::single}}));
  EXPECT_TRUE(chain(5).part({}).list.empty());
}

TEST(StatedBonds, go_with_the_attributes) {
  SphereAttributes attributes;
  attributes.element = {6, 7, 8};
  attributes.bonds = chain(3);
  EXPECT_EQ(attributes.part({2, 1}).bonds.list, (List{{0, 1, BondOrder::single}}));
  const std::int64_t bytes = attributes.allocated_bytes();
  attributes.keep_only({0, 1, 1});
  EXPECT_EQ(attributes.bonds.list, (List{{0, 1, BondOrder::single}}));
  attributes.bonds = {};
  EXPECT_LT(attributes.allocated_bytes(), bytes);
}

}  // namespace
}  // namespace bihive
