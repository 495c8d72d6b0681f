// brute: no structure. Every sphere, one after the other: the definition of all answers.

#include <algorithm>

#include "bihive/compare/by_ray.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

class Brute final : public ByRay<Brute> {
 public:
  using ByRay::ByRay;

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.expected_nodes = 0;
    facts.expected_spheres = facts.expected_test_steps = static_cast<double>(spheres().size());
    return facts;
  }
  std::int64_t rays_per_call() const override {
    constexpr std::int64_t kTests = 1 << 22;  // some hundredths of a second
    return std::clamp<std::int64_t>(kTests / std::max<std::int64_t>(1, spheres().size()), 1, 1024);
  }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    for (std::int64_t id = 0; id < spheres().size(); ++id)
      if (test(ray, id, answer, counter)) return;
  }
  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    for (std::int64_t id = 0; id < spheres().size(); ++id) test(point, id, nearest, counter);
  }
};

}  // namespace

Result<StructurePointer> build_brute(const SphereSet& spheres, const StructureParameters&, int) {
  return StructurePointer(std::make_unique<Brute>(spheres));
}

}  // namespace bihive::workbench
