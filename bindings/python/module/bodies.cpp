// Trees of spheres and sticks: rays alone.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bihive/render/hit_body.h"
#include "errors.h"
#include "tree.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

using Vectors = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Sticks with ends in world coordinates, (m, 3) each, and two radii each, (m, 2). bihive/_bodies.py has checked shapes.
std::shared_ptr<RayTree> build_body_tree(const SharedSpheres& spheres, const Vectors& a, const Vectors& b,
                                         const Vectors& radii, const std::vector<std::string>& words,
                                         const py::object& progress) {
  auto scene = std::make_shared<Scene>();
  auto of_tree = std::make_shared<Spheres>();
  auto tree = std::make_shared<RayTree>();
  std::vector<OwnStick> sticks(static_cast<std::size_t>(a.shape(0)));
  scene->spheres = spheres->file.spheres;
  for (std::size_t i = 0; i < sticks.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    const auto point = [&](const Vectors& of) {
      return scene->spheres.to_local({of.at(row, 0), of.at(row, 1), of.at(row, 2)});
    };
    sticks[i].a = point(a);
    sticks[i].b = point(b);
    sticks[i].radius_a = radii.at(row, 0);
    sticks[i].radius_b = radii.at(row, 1);
  }
  const auto set = [&]() -> const SphereSet& {
    value_of(scene->sticks.add(scene->spheres, sticks));
    of_tree->file.spheres = scene->spheres;
    tree->spheres = std::move(of_tree);
    return scene->spheres;
  };
  const std::int64_t bodies = scene->spheres.size() + std::ssize(sticks);
  build_tree_of(*tree, request_of(words), bodies, progress, set, [&](Engine engine, const TreeParameters& limits) {
    tree->tracer = value_of(Tracer::build(*scene, engine, limits, tree->threads));
  });
  tree->scene = std::move(scene);
  return tree;
}

// Of each hit of `closest` or, with the `ray` of each, of `all_hits`: kind (BodyKind), the number of its sphere or
// stick, and the position along the stick.
py::tuple bodies_of_hits(const RayTree& tree, const Vectors& origin, const Vectors& direction,
                         const py::array_t<double>& t, const py::array_t<std::int64_t>& id,
                         const std::optional<py::array_t<std::int64_t>>& ray_of_hit) {
  if (!tree.scene) throw py::type_error("this tree has no sticks: BodyTree has");
  const py::ssize_t count = t.shape(0);
  py::array_t<std::uint8_t> kind(count);
  py::array_t<std::int64_t> number(count);
  py::array_t<double> along(count);
  const SphereSet& spheres = tree.scene->spheres;
  for (py::ssize_t i = 0; i < count; ++i) {
    const py::ssize_t row = ray_of_hit ? static_cast<py::ssize_t>(ray_of_hit->at(i)) : i;
    Ray ray;
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = static_cast<float>(origin.at(row, axis) - spheres.origin()[axis]);
      ray.direction[axis] = static_cast<float>(direction.at(row, axis));
    }
    const HitBody body = body_of_hit(spheres, tree.scene->sticks, ray, {t.at(i), id.at(i)});
    kind.mutable_at(i) = static_cast<std::uint8_t>(body.kind);
    number.mutable_at(i) = body.id;
    along.mutable_at(i) = body.along;
  }
  return py::make_tuple(kind, number, along);
}

}  // namespace

void bind_bodies(py::module_& module, TreeClass& tree) {
  tree.def("bodies", bodies_of_hits);
  module.def("build_body_tree", build_body_tree);
}

}  // namespace bihive::python
