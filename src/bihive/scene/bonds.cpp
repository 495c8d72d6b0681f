#include "bihive/scene/bonds.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/io/bonds.h"
#include "bihive/scene/bond_orders.h"
#include "bihive/scene/looks.h"

namespace bihive {

static_assert(Sticks().reach == kUsualBondReach);

Status scale_balls(Scene& scene, const Sticks& sticks) {
  const bool needs_elements = sticks.bonds == Bonds::distance ||
                              (sticks.bonds == Bonds::automatic && !scene.spheres.attributes().bonds.are_all);
  if (needs_elements)
    if (Status status = check_bond_elements(scene.spheres); !status) return status;
  if (sticks.ball_scale == 1) return Done{};
  LookAction action = ScaleRadius{sticks.ball_scale};
  if (sticks.ball_scale == 0)
    action = SetRadii{std::vector<double>(static_cast<std::size_t>(scene.spheres.size()), sticks.radius)};
  const Result<std::vector<std::int64_t>> scaled = apply_looks(scene, {Look{"all", {std::move(action)}}});
  return scaled ? Status(Done{}) : Status(scaled.error());
}

namespace {

// Of bonds in ascending order those that the file states have an order.
std::vector<BondOrder> orders_of(const SphereSet& spheres, const std::vector<ImagePair>& bonds) {
  const std::vector<StatedBond>& list = spheres.attributes().bonds.list;
  std::vector<BondOrder> orders(bonds.size(), BondOrder::unknown);
  if (std::none_of(list.begin(), list.end(), [](const StatedBond& one) { return has_parallel_sticks(one.order); }))
    return orders;
  const std::vector<ImagePair> stated = bonds_of_file(spheres);
  std::size_t k = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    while (k < stated.size() && stated[k] < bonds[i]) ++k;
    if (k < stated.size() && stated[k] == bonds[i]) orders[i] = list[k].order;
  }
  return orders;
}

}  // namespace

Status find_bonds(Scene& scene, const Sticks& sticks, int threads) {
  Result<std::vector<ImagePair>> bonds = sticks.bonds == Bonds::file ? bonds_of_file(scene.spheres)
                                         : sticks.bonds == Bonds::automatic
                                             ? automatic_bonds(scene.spheres, sticks.reach, threads)
                                             : bonds_by_distance(scene.spheres, sticks.reach, threads);
  if (!bonds) return bonds.error();
  if (sticks.bonds == Bonds::file && bonds->empty())
    return Error{"the file states no bonds between these spheres", "", 0, 0,
                 setting_name("bonds") + " distance finds them"};
  std::function<bool(const SpherePair&)> is_parted;
  if (lets_light_through(scene))
    is_parted = [&scene](const SpherePair& pair) { return !are_equally_clear(scene, pair[0], pair[1]); };
  std::vector<OwnStick> parallel;
  if (sticks.orders && sticks.bonds != Bonds::distance) {
    const std::vector<BondOrder> orders = orders_of(scene.spheres, *bonds);
    parallel = parallel_sticks(scene.spheres, *bonds, orders, sticks.radius, is_parted);
    std::size_t to = 0;
    for (std::size_t k = 0; k < bonds->size(); ++k)
      if (!has_parallel_sticks(orders[k])) (*bonds)[to++] = (*bonds)[k];
    bonds->resize(to);
  }
  Result<StickSet> made = StickSet::between(scene.spheres, *bonds, sticks.radius, is_parted);
  if (!made) return made.error();
  if (Status status = made->add(scene.spheres, parallel); !status) return status;
  scene.sticks = std::move(*made);
  return check_sticks(scene);
}

}  // namespace bihive
