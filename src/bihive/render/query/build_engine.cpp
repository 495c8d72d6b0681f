#include "bihive/render/query/build_engine.h"

#include <new>
#include <string>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/base/watch.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/render/query/brute_engine.h"
#include "bihive/render/query/cut_engine.h"
#include "bihive/render/query/image_engine.h"
#include "bihive/render/query/reference_engine.h"
#include "bihive/render/query/subset_engine.h"
#include "bihive/render/query/wide_engine.h"
#include "bihive/render/tree_memory.h"

namespace bihive {

using Built = Result<std::shared_ptr<const RayEngine>>;

Built build_engine(const SphereSet& spheres, const EngineParameters& parameters) {
  if (spheres.has_images()) return ImageEngine::build(spheres, {}, parameters);
  if (parameters.engine == Engine::brute) return Built(std::make_shared<BruteEngine<false>>(spheres));
  if (parameters.engine == Engine::wide_brute) return Built(std::make_shared<BruteEngine<true>>(spheres));
  if (parameters.engine == Engine::reference) {
    if (Status status = check_tree_memory(spheres, parameters.engine, parameters.tree); !status) return status.error();
    WatchedWork work;
    try {
      auto tree = std::make_shared<const Tree>(build_reference_tree(spheres, parameters.tree.for_reference()));
      work.report(1);
      return Built(std::make_shared<ReferenceEngine>(spheres, std::move(tree)));
    } catch (const Cancelled&) {
      return cancelled_error();
    } catch (const std::bad_alloc&) {
      return no_memory_for("the reference tree of " + std::to_string(spheres.size()) + " spheres");
    }
  }
  Result<std::shared_ptr<const WideTree>> tree =
      WideBuilder().build(spheres, parameters.tree.for_wide(spheres.size()), parameters.threads);
  if (!tree) return tree.error();
  return Built(std::make_shared<WideEngine>(std::move(*tree)));
}

Built build_engine(const SphereSet& whole, std::vector<std::int64_t> ids, std::shared_ptr<const CutSet> cuts,
                   const EngineParameters& parameters) {
  if (whole.has_images()) {
    if (cuts != nullptr) return Error{"clips cannot cut the copies of a replicated set", "", 0, 0, ""};
    return ImageEngine::build(whole, &ids, parameters);
  }
  try {
    std::vector<std::int64_t> uncut, cut;
    for (const std::int64_t id : ids) {
      const Remainder remainder = cuts == nullptr ? Remainder::whole : cuts->remainder(id);
      if (remainder == Remainder::whole) uncut.push_back(id);
      if (remainder == Remainder::cut) cut.push_back(id);
    }
    auto subset = std::make_shared<const Subset>(whole, std::move(uncut));
    Built of_subset = build_engine(subset->spheres(), parameters);
    if (!of_subset) return of_subset;
    auto engine = std::make_shared<const SubsetEngine>(std::move(subset), std::move(*of_subset), cuts);
    if (cut.empty()) return Built(std::move(engine));
    return CutEngine::build(whole, cut, std::move(cuts), std::move(engine), parameters);
  } catch (const std::bad_alloc&) {
    return no_memory_for("the parts of the set");
  }
}

}  // namespace bihive
