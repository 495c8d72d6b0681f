// The structures behind the opaque pointers bihive_tree and bihive_lists.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bihive.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/periodic_images.h"
#include "bihive/wide/wide_builder.h"

struct bihive_tree {
  std::unique_ptr<bihive::WideBuilder> builder;  // from the first update on, as it keeps working memory
  std::shared_ptr<const bihive::WideTree> tree;
  bihive::SphereSet spheres;
  std::string warning;
  std::optional<bihive::PeriodicImages> images;
};

struct bihive_lists {
  std::vector<std::int64_t> begin, spheres;
  std::vector<double> distances;
  std::vector<std::uint8_t> kinds{};  // of bodies
  std::vector<double> along{};        // of bodies
};
