// Trees for queries about arrays of rays and points.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>

#include "bihive/job/picture_request.h"
#include "bihive/job/waiting.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"
#include "bihive/wide/periodic_images.h"
#include "spheres.h"

namespace bihive::python {

/// A tree of the chosen engine, and its spheres.
struct RayTree {
  SharedSpheres spheres;
  std::optional<Tracer> tracer;
  std::optional<PeriodicImages> images;  ///< of a periodic set
  std::shared_ptr<const Scene> scene;    ///< of a tree with sticks; null: there are none
  int threads = 0;
};

using TreeClass = pybind11::class_<RayTree, std::shared_ptr<RayTree>>;

/// Builds a tree of the request's engine: `set` makes its spheres, `build` what it has, with limits as the request has
/// them, or searched (`tune`). With many bodies or a search it waits as wait_for() does. Fails where the engine has no
/// tree of rays, or nothing to search.
void build_tree_of(RayTree& tree, const PictureRequest& request, std::int64_t bodies, const pybind11::object& progress,
                   const std::function<const SphereSet&()>& set,
                   const std::function<void(Engine, const TreeParameters&)>& build);

/// Adds Tree to the module.
void bind_trees(pybind11::module_& module);

/// Adds trees of spheres and sticks to the module (bodies.cpp), after Tree.
void bind_bodies(pybind11::module_& module, TreeClass& tree);

/// Adds the queries about points to Tree (points.cpp).
void bind_points(TreeClass& tree);

/// The wide tree, which alone answers every query. Fails by the name of the query if there is none, or if copies along
/// a cell would be left out.
const WideTree& wide_tree_for(const RayTree& tree, const char* query);

}  // namespace bihive::python
