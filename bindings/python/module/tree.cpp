#include "tree.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bihive/base/parallel.h"
#include "bihive/base/watch.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/render/memory.h"
#include "bihive/wide/surface_of_hit.h"
#include "errors.h"
#include "waiting.h"

namespace py = pybind11;

namespace bihive::python {
namespace {

// Rays in a piece of work. Neighbours in blocks take little time each, so that each thread may have several pieces.
// Scattered rays are sorted within a piece: the more the better; of all hits fewer, which are sorted at its end.
constexpr std::int64_t kFewestRays = 16384;
constexpr std::int64_t kMostRaysInBlocks = 131072;
constexpr std::int64_t kMostScatteredRays = 524288;
constexpr std::int64_t kMostRaysOfHits = 131072;
// Rays per piece for the scalar reference: a few hundredths of a second of work.
constexpr std::int64_t kMostRaysOfReference = 8192;
constexpr std::int64_t kPiecesPerThread = 4;
// Brute force tests in a piece: a few hundredths of a second.
constexpr std::int64_t kMostTests = std::int64_t{1} << 23;

// The calling thread builds a tree of so few spheres, in a millisecond or two: another thread takes as long to start as
// a tree of a thousand.
constexpr std::int64_t kFewBodies = 16384;

// Columns of Python's arrays, each of `count` numbers. `leaves` and `inside` are null or contiguous.
struct RayArrays {
  std::int64_t count = 0;
  std::array<NumbersView, 3> origin, direction;
  std::optional<NumbersView> t_min, t_max;
  const std::int64_t* leaves = nullptr;
  const std::uint8_t* inside = nullptr;
};

// The numbers minus `origin`, in binary64.
template <class From, class To>
void copy_as(const NumbersView& view, std::int64_t first, std::int64_t count, double origin, To* to) {
  const char* from = static_cast<const char*>(view.first) + first * view.step_bytes;
  for (std::int64_t i = 0; i < count; ++i, from += view.step_bytes) {
    From value;
    std::memcpy(&value, from, sizeof(value));
    to[i] = static_cast<To>(static_cast<double>(value) - origin);
  }
}

// Rounded to nearest where the numbers are wider. A number beyond binary32's range becomes infinite.
template <class To>
void copy_part(const NumbersView& view, std::int64_t first, std::int64_t count, double origin, To* to) {
  if (view.precision == NumbersView::Precision::binary32)
    copy_as<float>(view, first, count, origin, to);
  else
    copy_as<double>(view, first, count, origin, to);
}

// Whether these are the columns of rows of three numbers, one row after the other.
bool are_rows(const std::array<NumbersView, 3>& columns) {
  const bool is_wide = columns[0].precision == NumbersView::Precision::binary64;
  const std::ptrdiff_t size = is_wide ? sizeof(double) : sizeof(float);
  const auto* const first = static_cast<const char*>(columns[0].first);
  return columns[0].step_bytes == 3 * size && columns[1].first == first + size &&
         columns[2].first == first + 2 * size && columns[1].step_bytes == 3 * size && columns[2].step_bytes == 3 * size;
}

// copy_as() of the three columns of such rows, which are read once.
template <class From>
void copy_rows(const std::array<NumbersView, 3>& columns, std::int64_t first, std::int64_t count, Vec3d origin,
               std::vector<float> (&to)[3]) {
  const char* from = static_cast<const char*>(columns[0].first) + first * columns[0].step_bytes;
  float *const x = to[0].data(), *const y = to[1].data(), *const z = to[2].data();
  for (std::int64_t i = 0; i < count; ++i, from += 3 * sizeof(From)) {
    From row[3];
    std::memcpy(row, from, sizeof(row));
    x[i] = static_cast<float>(static_cast<double>(row[0]) - origin.x);
    y[i] = static_cast<float>(static_cast<double>(row[1]) - origin.y);
    z[i] = static_cast<float>(static_cast<double>(row[2]) - origin.z);
  }
}

// The numbers in place, if they are laid out as a vector of T; else null.
template <class T>
const T* as_vector(const NumbersView& view, std::int64_t first) {
  constexpr auto kPrecision =
      sizeof(T) == sizeof(float) ? NumbersView::Precision::binary32 : NumbersView::Precision::binary64;
  const bool aligned = reinterpret_cast<std::uintptr_t>(view.first) % alignof(T) == 0;
  if (view.precision != kPrecision || view.step_bytes != sizeof(T) || !aligned) return nullptr;
  return static_cast<const T*>(view.first) + first;
}

// The rays of a piece as the engine reads them. Its memory is reused for the next piece.
class RayPiece {
 public:
  /// Local rays (geometry/sphere_set.h).
  RaySpan take(const RayArrays& rays, Vec3d origin, std::int64_t first, std::int64_t count) {
    const auto size = static_cast<std::size_t>(count);
    RaySpan span;
    span.count = count;
    const auto take_column = [&](const NumbersView& view, auto& kept, double from = 0) {
      using T = typename std::decay_t<decltype(kept)>::value_type;
      const T* const there = as_vector<T>(view, first);
      if (there != nullptr && from == 0) return there;
      kept.resize(size);
      copy_part(view, first, count, from, kept.data());
      return static_cast<const T*>(kept.data());
    };
    const auto take_vectors = [&](const std::array<NumbersView, 3>& columns, std::vector<float>(&kept)[3], Vec3d from,
                                  const float*(&taken)[3]) {
      const bool in_rows = are_rows(columns);
      if (in_rows) {
        for (auto& column : kept) column.resize(size);
        if (columns[0].precision == NumbersView::Precision::binary64)
          copy_rows<double>(columns, first, count, from, kept);
        else
          copy_rows<float>(columns, first, count, from, kept);
      }
      for (int axis = 0; axis < 3; ++axis)
        taken[axis] =
            in_rows ? kept[axis].data() : take_column(columns[static_cast<std::size_t>(axis)], kept[axis], from[axis]);
    };
    take_vectors(rays.origin, batch_.origin, origin, span.origin);
    take_vectors(rays.direction, batch_.direction, {}, span.direction);
    if (rays.t_min) span.t_min = take_column(*rays.t_min, batch_.t_min);
    if (rays.t_max) span.t_max = take_column(*rays.t_max, batch_.t_max);
    if (rays.leaves != nullptr) span.leaves = rays.leaves + first;
    if (rays.inside != nullptr) span.inside = rays.inside + first;
    return span;
  }

 private:
  RayBatch batch_;
};

RayPiece& piece_of_thread() {
  thread_local RayPiece piece;
  return piece;
}

std::int64_t rays_per_piece(const RayTree& tree, std::int64_t rays, RayOrder order) {
  const std::int64_t spheres = std::max<std::int64_t>(1, tree.spheres->file.spheres.size());
  if (is_brute(tree.tracer->engine())) return std::clamp<std::int64_t>(kMostTests / spheres, 1, kFewestRays);
  if (tree.tracer->engine() == Engine::reference) return kMostRaysOfReference;
  const std::int64_t workers = tree.threads > 0 ? tree.threads : hardware_threads();
  if (order == RayOrder::any) return std::clamp((rays + workers - 1) / workers, kFewestRays, kMostScatteredRays);
  return std::clamp(rays / (workers * kPiecesPerThread), kFewestRays, kMostRaysInBlocks);
}

// Calls trace(span, first ray, piece) for all pieces of `most` rays. Python's lock is held before and after, not
// meanwhile.
template <class Trace>
void trace_in_pieces(const RayTree& tree, const RayArrays& rays, std::int64_t most, const Trace& trace) {
  const std::int64_t pieces = (rays.count + most - 1) / most;
  do_query([&] {
    watched_for(tree.threads, pieces, [&](std::int64_t piece) {
      const std::int64_t first = piece * most;
      trace(
          piece_of_thread().take(rays, tree.spheres->file.spheres.origin(), first, std::min(most, rays.count - first)),
          first, piece);
    });
  });
}

// The tree of rays that see images. Null: they do not. bihive/_tree.py has checked that there are images.
const WideTree* tree_of_images(const RayTree& tree, bool periodic) {
  if (!periodic) return nullptr;
  const WideTree* const wide = tree.tracer->wide_tree();
  if (wide == nullptr) fail_usage("periodic rays need the wide engine", "leave out engine");
  value_of(tree.images->check_rays());
  return wide;
}

// bihive/_tree.py has checked shapes and types: origin and direction (n, 3), t_min, t_max, leaves, inside.
using GivenRays = std::tuple<py::array, py::array, std::optional<py::array>, std::optional<py::array>,
                             std::optional<py::array_t<std::int64_t>>, std::optional<py::array_t<std::uint8_t>>>;
// For each ray the sphere that does not count. Only rays that see images leave it to the library.
using GivenSpheres = std::optional<py::array_t<std::int64_t>>;

RayArrays rays_from(const GivenRays& given) {
  const auto& [origin, direction, t_min, t_max, leaves, inside] = given;
  RayArrays rays;
  rays.count = origin.shape(0);
  for (py::ssize_t axis = 0; axis < 3; ++axis) {
    rays.origin[static_cast<std::size_t>(axis)] = column_of(origin, axis);
    rays.direction[static_cast<std::size_t>(axis)] = column_of(direction, axis);
  }
  if (t_min) rays.t_min = view_of(*t_min);
  if (t_max) rays.t_max = view_of(*t_max);
  if (leaves) rays.leaves = leaves->data();
  if (inside) rays.inside = inside->data();
  return rays;
}

// Calls plain(span, first ray, piece), or for rays that see images seeing(tree, span, excluded, first ray, piece), for
// all pieces of `most` rays.
template <class Plain, class Seeing>
void trace_all(const RayTree& tree, const RayArrays& rays, std::int64_t most, bool see_images,
               const GivenSpheres& exclude, const Plain& plain, const Seeing& seeing) {
  const WideTree* const periodic = tree_of_images(tree, see_images);
  const std::int64_t* const excluded = exclude ? exclude->data() : nullptr;
  FirstWithoutEnd without_end;
  trace_in_pieces(tree, rays, most, [&](const RaySpan& span, std::int64_t first, std::int64_t piece) {
    if (periodic == nullptr)
      plain(span, first, piece);
    else if (!without_end.is_before(first))
      without_end.take(first, seeing(*periodic, span, excluded != nullptr ? excluded + first : nullptr, first, piece));
  });
  value_of(without_end.status());
}

RayOrder order_of(bool in_blocks) {
  return in_blocks ? RayOrder::blocks : RayOrder::any;
}

py::tuple closest(const RayTree& tree, const GivenRays& given, const GivenSpheres& exclude, bool see_images,
                  bool in_blocks) {
  const RayArrays rays = rays_from(given);
  py::array_t<double> t(rays.count);
  py::array_t<std::int64_t> id(rays.count);
  const HitSpan hits{t.mutable_data(), id.mutable_data()};
  const RayOrder order = order_of(in_blocks);
  trace_all(
      tree, rays, rays_per_piece(tree, rays.count, order), see_images, exclude,
      [&](const RaySpan& span, auto first, auto) { tree.tracer->closest_hits(span, order, hits.part(first)); },
      [&](const WideTree& wide, const RaySpan& span, auto excluded, auto first, auto) {
        return tree.images->closest_hits(wide, span, hits.part(first), excluded);
      });
  return py::make_tuple(t, id);
}

py::array_t<bool> occluded(const RayTree& tree, const GivenRays& given, const GivenSpheres& exclude, bool see_images,
                           bool in_blocks) {
  const RayArrays rays = rays_from(given);
  py::array_t<bool> hidden(rays.count);
  static_assert(sizeof(bool) == sizeof(std::uint8_t));
  auto* const to = reinterpret_cast<std::uint8_t*>(hidden.mutable_data());
  const RayOrder order = order_of(in_blocks);
  trace_all(
      tree, rays, rays_per_piece(tree, rays.count, order), see_images, exclude,
      [&](const RaySpan& span, auto first, auto) { tree.tracer->occluded(span, order, to + first); },
      [&](const WideTree& wide, const RaySpan& span, auto excluded, auto first, auto) {
        return tree.images->occluded(wide, span, to + first, excluded);
      });
  return hidden;
}

// Three arrays with an entry for each hit: ray, t, id; and the first entry of each ray, and their number.
py::tuple every_hit(const RayTree& tree, const GivenRays& given, const GivenSpheres& exclude, bool see_images) {
  const WideTree* const wide = tree.scene ? nullptr : &wide_tree_for(tree, "all_hits");
  const RayArrays rays = rays_from(given);
  const std::int64_t most = std::min(rays_per_piece(tree, rays.count, RayOrder::any), kMostRaysOfHits);
  std::vector<std::vector<RayHit>> hits(static_cast<std::size_t>((rays.count + most - 1) / most));
  trace_all(
      tree, rays, most, see_images, exclude,
      [&](const RaySpan& span, auto, auto piece) {
        std::vector<RayHit>& found = hits[static_cast<std::size_t>(piece)];
        if (wide == nullptr)
          tree.tracer->all_hits(span, RayOrder::any, found);
        else
          all_hits(*wide, span, found);
      },
      [&](const WideTree&, const RaySpan& span, auto excluded, auto, auto piece) {
        return tree.images->all_hits(*wide, span, hits[static_cast<std::size_t>(piece)], excluded);
      });
  std::size_t count = 0;
  for (const std::vector<RayHit>& some : hits) count += some.size();
  const auto size = static_cast<py::ssize_t>(count);
  py::array_t<std::int64_t> ray(size), id(size);
  py::array_t<double> t(size);
  std::int64_t *to_ray = ray.mutable_data(), *to_id = id.mutable_data();
  double* to_t = t.mutable_data();
  py::array_t<std::int64_t> begin(static_cast<py::ssize_t>(rays.count + 1));
  std::int64_t* const to_begin = begin.mutable_data();
  std::int64_t next_ray = 0, next_hit = 0, first = 0;
  for (std::vector<RayHit>& some : hits) {
    for (const RayHit& hit : some) {
      while (next_ray <= first + hit.ray) to_begin[next_ray++] = next_hit;
      *to_ray++ = first + hit.ray, *to_t++ = hit.t, *to_id++ = hit.sphere_id;
      ++next_hit;
    }
    some = {};
    first += most;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  while (next_ray <= rays.count) to_begin[next_ray++] = next_hit;
  return py::make_tuple(ray, t, id, begin);
}

// Arrays of the surface at each hit: position, normal, t_exit, and with `with_derivatives` those of HitDerivatives.
// `ray`: of each hit; null: hit i is that of ray i. NaN where nothing was hit. Fails where a hit is not that of its
// ray: the arrays have changed since the query.
py::tuple surfaces(const RayTree& tree, const py::array& origin, const py::array& direction,
                   const std::optional<py::array_t<std::int64_t, py::array::c_style>>& ray,
                   const py::array_t<double, py::array::c_style>& t,
                   const py::array_t<std::int64_t, py::array::c_style>& id, bool see_images, bool with_derivatives) {
  const SphereSet& set = tree.spheres->file.spheres;
  const RayArrays rays = rays_from({origin, direction, {}, {}, {}, {}});
  const std::int64_t hits = t.size();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto rows = [&](std::vector<py::ssize_t> shape) {
    shape.insert(shape.begin(), static_cast<py::ssize_t>(hits));
    return py::array_t<double>(shape);
  };
  py::array_t<double> position = rows({3}), normal = rows({3}), exit = rows({});
  py::array_t<double> t_by_centre, t_by_radius, normal_by_centre, normal_by_radius;
  if (with_derivatives) {
    t_by_centre = rows({3});
    t_by_radius = rows({});
    normal_by_centre = rows({3, 3});
    normal_by_radius = rows({3});
  }
  const auto put = [](Vec3d vector, double* to) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = vector[axis];
  };
  double *to_position = position.mutable_data(), *to_normal = normal.mutable_data(), *to_exit = exit.mutable_data();
  double *to_t_centre = nullptr, *to_t_radius = nullptr, *to_n_centre = nullptr, *to_n_radius = nullptr;
  if (with_derivatives) {
    to_t_centre = t_by_centre.mutable_data(), to_t_radius = t_by_radius.mutable_data();
    to_n_centre = normal_by_centre.mutable_data(), to_n_radius = normal_by_radius.mutable_data();
  }
  std::atomic<bool> have_changed{false};
  const PeriodicImages* const images = see_images ? &*tree.images : nullptr;
  const double* const all_t = t.data();
  const std::int64_t *const all_ids = id.data(), *const all_rays = ray ? ray->data() : nullptr;
  {
    const std::int64_t chunks = (hits + kFewestRays - 1) / kFewestRays;
    const auto find = [&](std::int64_t chunk) {
      const std::int64_t begin = chunk * kFewestRays, count = std::min(kFewestRays, hits - begin);
      for (const auto& [to, width] :
           {std::pair(to_position, 3), std::pair(to_normal, 3), std::pair(to_exit, 1), std::pair(to_t_centre, 3),
            std::pair(to_t_radius, 1), std::pair(to_n_centre, 9), std::pair(to_n_radius, 3)})
        if (to != nullptr) std::fill_n(to + width * begin, width * count, nan);
      for (std::int64_t i = begin; i < begin + count; ++i) {
        if (all_ids[i] < 0) continue;
        const std::int64_t of = all_rays != nullptr ? all_rays[i] : i;
        if (of < 0 || of >= rays.count) {
          have_changed = true;
          return;
        }
        // The ray as the query rounded it.
        const auto at = static_cast<std::size_t>(of);
        Ray local;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int a = static_cast<int>(axis);
          local.origin[a] = static_cast<float>(rays.origin[axis].at(at) - set.origin()[a]);
          local.direction[a] = static_cast<float>(rays.direction[axis].at(at));
        }
        const std::optional<HitSurface> found = surface_of_hit(set, images, local, all_t[i], all_ids[i]);
        if (!found) {
          have_changed = true;
          return;
        }
        put(found->position, to_position + 3 * i);
        put(found->normal, to_normal + 3 * i);
        to_exit[i] = found->t_exit;
        if (!with_derivatives) continue;
        const HitDerivatives by = hit_derivatives(to_double(local.direction), found->normal, set.radius(all_ids[i]));
        put(by.t_by_centre, to_t_centre + 3 * i);
        to_t_radius[i] = by.t_by_radius;
        for (int row = 0; row < 3; ++row) put(by.normal_by_centre[row], to_n_centre + 9 * i + 3 * row);
        put(by.normal_by_radius, to_n_radius + 3 * i);
      }
    };
    do_query([&] { watched_for(tree.threads, chunks, find); });
  }
  if (have_changed)
    fail_usage("the rays are not those of the query any more: their arrays have changed",
               "ask for positions and normals first, or copy the arrays");
  if (!with_derivatives) return py::make_tuple(position, normal, exit);
  return py::make_tuple(t_by_centre, t_by_radius, normal_by_centre, normal_by_radius);
}

// `part`: ids of a subset of the spheres; their positions in it are the answers' ids. `words`: options of `bihive
// trace` about tree, engine and threads. `periodic`: queries see the images along the set's cell.
std::shared_ptr<RayTree> build_tree(const SharedSpheres& spheres, const std::optional<std::vector<std::int64_t>>& part,
                                    bool periodic, const std::vector<std::string>& words, const py::object& progress) {
  auto tree = std::make_shared<RayTree>();
  const auto set = [&]() -> const SphereSet& {
    tree->spheres = spheres;
    if (part) {
      auto some = std::make_shared<Spheres>();
      some->file.spheres = spheres->file.spheres.part(*part);
      tree->spheres = std::move(some);
    }
    return tree->spheres->file.spheres;
  };
  build_tree_of(*tree, request_of(words), spheres->file.spheres.size(), progress, set,
                [&](Engine engine, const TreeParameters& limits) {
                  const SphereSet& of_tree = tree->spheres->file.spheres;
                  value_of(check_tree_memory(of_tree, engine, limits));
                  tree->tracer = value_of(Tracer::build(of_tree, engine, limits, tree->threads));
                  if (periodic && !of_tree.has_images())
                    tree->images = value_of(PeriodicImages::of(of_tree, tree->threads));
                });
  return tree;
}

}  // namespace

void build_tree_of(RayTree& tree, const PictureRequest& request, std::int64_t bodies, const py::object& progress,
                   const std::function<const SphereSet&()>& set,
                   const std::function<void(Engine, const TreeParameters&)>& build) {
  if (is_gpu(request.engine)) fail_setting("engine", ": a graphics processor answers no rays", "leave it out");
  const Engine engine = structure_of(request.engine);
  if (request.tune) check_tuning(request.tree, name_of(kRenderEngines, request.engine), !is_brute(engine));
  tree.threads = static_cast<int>(request.threads);
  const auto all = [&](Work& work) {
    const SphereSet& spheres = set();
    TreeParameters limits = request.tree;
    const auto end_if_cancelled = [&](double) {
      if (work.cancel.cancelled()) throw Cancelled{};
    };
    if (request.tune) limits = tuned_tree_for_rays(spheres, engine, tree.threads, end_if_cancelled).tree;
    const Watch watch(work.between(0, 1), &work.cancel);
    build(engine, limits);
  };
  if (bodies > kFewBodies || request.tune) return wait_for(all, progress);
  {
    const py::gil_scoped_release unlocked;
    Work work;
    all(work);
  }
  if (!progress.is_none()) progress(1.0);
}

const WideTree& wide_tree_for(const RayTree& tree, const char* query) {
  const WideTree* const wide = tree.tracer->wide_tree();
  if (wide == nullptr || tree.tracer->has_images())
    fail_usage(std::string(query) + " needs the wide engine, and spheres without copies", "leave out engine");
  return *wide;
}

void bind_trees(py::module_& module) {
  TreeClass tree_class(module, "Tree");
  tree_class.def("__len__", [](const RayTree& tree) { return tree.spheres->file.spheres.size(); })
      .def_property_readonly("build_ms", [](const RayTree& tree) { return tree.tracer->build_ms(); })
      .def_property_readonly("periodic", [](const RayTree& tree) { return tree.images.has_value(); })
      .def("closest", closest)
      .def("occluded", occluded)
      .def("all_hits", every_hit)
      .def("surfaces", surfaces);
  bind_points(tree_class);
  bind_bodies(module, tree_class);
  module.def("build_tree",
             [](const std::shared_ptr<Spheres>& spheres, const std::optional<std::vector<std::int64_t>>& part,
                bool periodic, const std::vector<std::string>& words,
                const py::object& progress) { return build_tree(spheres, part, periodic, words, progress); });
}

}  // namespace bihive::python
