// bihive trace: traces rays of a .npy file through an input, and writes two .npy files of answers.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/timer.h"
#include "bihive/geometry/plane.h"
#include "bihive/io/npy.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/tuned_tree.h"
#include "bihive/render/memory.h"
#include "bihive/scene/generators.h"
#include "bihive/simd/target.h"
#include "bihive/wide/periodic_images.h"
#include "commands/commands.h"
#include "commands/names.h"
#include "support/interrupt.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/thread_reserve.h"
#include "support/write_together.h"

namespace bihive::cli {
namespace {

// Rays per chunk. Progress is shown and Ctrl-C is checked between chunks.
constexpr std::int64_t kFewestPerChunk = 16384;
constexpr std::int64_t kMostPerChunk = 262144;
constexpr std::int64_t kChunksPerThread = 4;
constexpr std::int64_t kSpheresPerChunk = 1 << 25;  // brute force tests per chunk: well below a second

// The rays of the file: origin, direction, and with 8 columns t_min and t_max.
class RayFile {
 public:
  explicit RayFile(const std::string& path) {
    const std::string name = input_name(path);
    Result<NpyArray> array = parse_npy(read_input(path), name);
    array_ = value_or_fail(std::move(array));
    const std::string& dtype = array_.dtype;
    const std::string kind = dtype.size() < 2 ? "" : dtype.substr(dtype.size() - 2);
    if (kind != "f4" && kind != "f8")
      fail({"expected rays of dtype float32 or float64, found " + dtype, name, 0, 0,
            "convert them: rays.astype(numpy.float32)"});
    if (array_.shape.size() != 2 || (array_.shape[1] != 6 && array_.shape[1] != 8)) {
      std::string shape;
      for (const std::int64_t side : array_.shape) shape += (shape.empty() ? "" : ", ") + std::to_string(side);
      fail({"expected rays of shape (n, 6): origin, direction; or (n, 8): and t_min, t_max; found (" + shape + ")",
            name, 0, 0, ""});
    }
  }

  std::int64_t size() const { return array_.shape[0]; }

  /// Relative to this origin.
  Ray ray(std::int64_t i, Vec3d origin) const {
    const std::int64_t columns = array_.shape[1];
    const double* row = array_.values.data() + i * columns;
    Ray ray;
    ray.origin = to_float(Vec3d{row[0], row[1], row[2]} - origin);
    ray.direction = to_float({row[3], row[4], row[5]});
    if (columns == 8) {
      ray.t_min = row[6];
      ray.t_max = row[7];
    }
    return ray;
  }

 private:
  NpyArray array_;
};

struct Answers {
  std::vector<double> t;
  std::vector<std::int64_t> id;
  std::int64_t bad_rays = 0;
  std::int64_t hits = 0;
};

// The answers to rays first to first + count - 1, in the form of the files. Returns the number of invalid rays.
std::int64_t answer(const Tracer& tracer, const PeriodicImages* images, FirstWithoutEnd& without_end,
                    const Plane* plane, bool any, const RayFile& file, std::int64_t first, std::int64_t count,
                    const HitSpan& hits) {
  RayBatch rays;
  for (std::int64_t i = 0; i < count; ++i) rays.push_back(file.ray(first + i, tracer.spheres().origin()));
  if (any) {
    std::vector<std::uint8_t> hidden(static_cast<std::size_t>(count));
    if (images == nullptr)
      tracer.occluded(rays.span(), RayOrder::any, hidden.data());
    else
      without_end.take(first, images->occluded(*tracer.wide_tree(), rays.span(), hidden.data()));
    for (std::int64_t i = 0; i < count; ++i)
      if (hidden[static_cast<std::size_t>(i)] != 0) hits.t[i] = 0, hits.sphere_id[i] = 0;
  } else if (images == nullptr) {
    tracer.closest_hits(rays.span(), RayOrder::any, hits);
  } else {
    without_end.take(first, images->closest_hits(*tracer.wide_tree(), rays.span(), hits));
  }

  // The plane is hit if it is nearer; at the same t the sphere is hit.
  std::int64_t bad_rays = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const Ray ray = rays.span().at(i);
    if (!is_valid(ray)) {
      ++bad_rays;
      continue;
    }
    if (plane == nullptr) continue;
    const double plane_t = plane_hit(ray, *plane);
    if (!(plane_t < hits.t[i])) continue;
    hits.t[i] = any ? 0 : plane_t;
    hits.sphere_id[i] = any ? 0 : kPlane;
  }
  return bad_rays;
}

// The wide engine answers faster in one call; the other engines are slow and need breaks.
std::int64_t rays_per_chunk(const Tracer& tracer, std::int64_t rays, std::int64_t threads) {
  const std::int64_t spheres = std::max<std::int64_t>(1, tracer.spheres().size());
  if (tracer.engine() == Engine::brute) return std::clamp<std::int64_t>(kSpheresPerChunk / spheres, 1, kFewestPerChunk);
  if (tracer.engine() != Engine::wide) return kFewestPerChunk;
  const std::int64_t workers = threads > 0 ? threads : hardware_threads();
  return std::clamp(rays / (workers * kChunksPerThread), kFewestPerChunk, kMostPerChunk);
}

// The images that rays meet. Without --periodic they meet none, as in pictures.
std::optional<PeriodicImages> images_for(const SphereSet& spheres, const Tracer& tracer, const TraceOptions& options) {
  if (!options.input.reading.has("periodic")) return std::nullopt;
  if (spheres.has_images())
    fail_setting("periodic",
                 ": rays see all images, and the copies of " + setting_name("replicate") + " would be met twice",
                 "leave one of them out");
  if (tracer.engine() != Engine::wide)
    fail_setting("periodic", ": rays see images with the wide engine alone", "leave out " + setting_name("engine"));
  std::optional<PeriodicImages> images = value_or_fail(PeriodicImages::of(spheres, static_cast<int>(options.threads)));
  if (!images)
    fail_setting("periodic", ": there is no periodic cell along which the spheres repeat",
                 "give one with " + setting_name("cell_vectors"));
  value_or_fail(images->check_rays());
  return images;
}

Answers trace(const RayFile& rays, const Tracer& tracer, const PeriodicImages* images, const Plane* plane,
              const TraceOptions& options) {
  const CancellableSection section;
  Progress progress("tracing");
  Answers answers;
  answers.t.resize(static_cast<std::size_t>(rays.size()), std::numeric_limits<double>::infinity());
  answers.id.resize(static_cast<std::size_t>(rays.size()), kNothing);

  // Each chunk writes its own rays and its own count. The thread that has a chunk reports its progress.
  const std::int64_t most = rays_per_chunk(tracer, rays.size(), options.threads);
  const std::int64_t chunks = (rays.size() + most - 1) / most;
  std::vector<std::int64_t> bad_rays(static_cast<std::size_t>(chunks), 0);
  FirstWithoutEnd without_end;
  std::atomic<std::int64_t> chunks_done{0};
  std::atomic_flag reporting = ATOMIC_FLAG_INIT;
  parallel_for(static_cast<int>(options.threads), chunks, [&](std::int64_t chunk) {
    if (CancellableSection::token().cancelled()) return;
    const std::int64_t first = chunk * most;
    const std::int64_t count = std::min(rays.size() - first, most);
    if (without_end.is_before(first)) return;
    bad_rays[static_cast<std::size_t>(chunk)] = answer(tracer, images, without_end, plane, options.any, rays, first,
                                                       count, HitSpan{answers.t.data(), answers.id.data()}.part(first));
    const std::int64_t done = ++chunks_done;
    if (reporting.test_and_set()) return;
    progress.update(static_cast<double>(done) / static_cast<double>(chunks));
    reporting.clear();
  });
  CancellableSection::leave_if_cancelled();
  value_or_fail(without_end.status());
  for (const std::int64_t count : bad_rays) answers.bad_rays += count;
  answers.hits = std::count_if(answers.id.begin(), answers.id.end(), [](std::int64_t id) { return id != kNothing; });
  return answers;
}

// What --tune finds, which it says.
TreeParameters tuned(const SphereSet& spheres, const TraceOptions& options) {
  check_tuning(options.tree, name_of(kEngines, options.engine), !is_brute(options.engine));
  Progress progress("tuning");
  const TunedTree found = tuned_tree_for_rays(spheres, options.engine, static_cast<int>(options.threads),
                                              [&](double done) { progress.update(done); });
  say_lines("bihive: " + found.text() + "\n");
  return found.tree;
}

}  // namespace

void run_trace(const TraceOptions& options) {
  if (options.t == options.id) fail_usage("--t and --id name the same file");
  if (options.rays == kStandardStream && options.input.input == kStandardStream)
    fail_usage("INPUT and --rays cannot both be the standard input");
  const std::vector<std::string> outputs = outputs_of(options);
  check_outputs(outputs, inputs_of(options));

  const RayFile rays(options.rays);
  const Input input = load_input(options.input);
  check_outputs(outputs, input.files);
  const TreeParameters limits = options.tune ? tuned(input.scene.spheres, options) : options.tree;
  value_or_fail(check_tree_memory(input.scene.spheres, options.engine, limits));
  const Tracer tracer =
      value_or_fail(Tracer::build(input.scene, options.engine, limits, static_cast<int>(options.threads)));
  Plane plane = input.scene.plane ? input.scene.plane->plane : thesis_plane().plane;
  plane.point = input.scene.spheres.to_local(plane.point);

  renew_group_limit_for_threads(options.threads);
  const Timer timer;
  const std::optional<PeriodicImages> images = images_for(input.scene.spheres, tracer, options);
  Answers answers = trace(rays, tracer, images ? &*images : nullptr, options.plane ? &plane : nullptr, options);
  const double trace_ms = timer.elapsed_ms();
  if (answers.bad_rays > 0)
    warn(
        fmt::format("{} of {} rays hit nothing because they are no rays (NaN, infinite origin or direction, zero "
                    "direction, or t_min above t_max)",
                    grouped(answers.bad_rays), grouped(rays.size())));

  if (!input.scene.id_in_input.empty())
    for (std::int64_t& id : answers.id) id = options.any ? id : input_id(input.scene, id);

  const std::string t_bytes = npy_bytes(answers.t, {rays.size()});
  const std::string id_bytes = npy_bytes(answers.id, {rays.size()});
  write_together({{output_path(options.t), t_bytes}, {output_path(options.id), id_bytes}});
  const std::string target = tracer.engine() == Engine::wide ? " on " + active_target() : "";
  print_report(
      fmt::format("{}, {}: {} rays, {} hit something; engine {}{}, tree {}, rays {}\n", escaped(options.t),
                  escaped(options.id), grouped(rays.size()), grouped(answers.hits), name_of(kEngines, tracer.engine()),
                  target, readable_ms(tracer.build_ms()), readable_ms(trace_ms)),
      outputs);
}

}  // namespace bihive::cli
