// bihive trace: rays of a .npy file against an input, answers into two .npy files.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/base/write_file.h"
#include "bihive/geometry/plane.h"
#include "bihive/io/npy.h"
#include "bihive/scene/generators.h"
#include "commands.h"
#include "failure.h"
#include "interrupt.h"
#include "messages.h"
#include "write_together.h"

namespace bihive::cli {
namespace {

constexpr std::int64_t kRaysPerChunk = 4096;

// Rays as the file has them: origin, direction, and if there are 8 columns t_min and t_max.
class RayFile {
 public:
  explicit RayFile(const std::string& path) {
    Result<NpyArray> array = parse_npy(value_or_fail(read_file(path)), path);
    array_ = value_or_fail(std::move(array));
    const std::string& dtype = array_.dtype;
    if (dtype.size() < 2 || dtype.substr(dtype.size() - 2) != "f4")
      fail({"expected rays of dtype float32, found " + dtype, path, 0, 0, "convert them: rays.astype(numpy.float32)"});
    if (array_.shape.size() != 2 || (array_.shape[1] != 6 && array_.shape[1] != 8)) {
      std::string shape;
      for (const std::int64_t side : array_.shape) shape += (shape.empty() ? "" : ", ") + std::to_string(side);
      fail({"expected rays of shape (n, 6): origin, direction; or (n, 8): and t_min, t_max; found (" + shape + ")",
            path, 0, 0, ""});
    }
  }

  std::int64_t size() const { return array_.shape[0]; }

  Ray ray(std::int64_t i) const {
    const std::int64_t columns = array_.shape[1];
    const double* row = array_.values.data() + i * columns;
    Ray ray;
    ray.origin = to_float({row[0], row[1], row[2]});
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

// One ray's answer: t and id as the files hold them.
Hit answer(const Tracer& tracer, const Plane* plane, bool any, const Ray& ray) {
  const double plane_t = plane != nullptr ? plane_hit(ray, *plane) : std::numeric_limits<double>::infinity();
  const bool on_plane = plane_t < std::numeric_limits<double>::infinity();
  if (any) {
    if (on_plane || tracer.occluded(ray)) return {0, 0};
    return {};
  }
  // A sphere at the same t goes first.
  const Hit hit = tracer.closest_hit(ray);
  return on_plane && plane_t < hit.t ? Hit{plane_t, kPlane} : hit;
}

Answers trace(const RayFile& rays, const Tracer& tracer, const Plane* plane, const TraceOptions& options) {
  const CancellableSection section;
  Progress progress("tracing");
  Answers answers;
  answers.t.resize(static_cast<std::size_t>(rays.size()), std::numeric_limits<double>::infinity());
  answers.id.resize(static_cast<std::size_t>(rays.size()), kNothing);

  // Each chunk writes its own rays and its own count. Progress is said by the thread that has the chunk before it.
  const std::int64_t chunks = (rays.size() + kRaysPerChunk - 1) / kRaysPerChunk;
  std::vector<std::int64_t> bad_rays(static_cast<std::size_t>(chunks), 0);
  std::atomic<std::int64_t> chunks_done{0};
  std::atomic_flag reporting = ATOMIC_FLAG_INIT;
  parallel_for(static_cast<int>(options.threads), chunks, [&](std::int64_t chunk) {
    if (CancellableSection::token().cancelled()) return;
    const std::int64_t end = std::min(rays.size(), (chunk + 1) * kRaysPerChunk);
    for (std::int64_t i = chunk * kRaysPerChunk; i < end; ++i) {
      const Ray ray = rays.ray(i);
      if (!is_valid(ray)) {
        ++bad_rays[static_cast<std::size_t>(chunk)];
        continue;
      }
      const Hit hit = answer(tracer, plane, options.any, ray);
      answers.t[static_cast<std::size_t>(i)] = hit.t;
      answers.id[static_cast<std::size_t>(i)] = hit.sphere_id;
    }
    const std::int64_t done = ++chunks_done;
    if (reporting.test_and_set()) return;
    progress.update(static_cast<double>(done) / static_cast<double>(chunks));
    reporting.clear();
  });
  CancellableSection::leave_if_cancelled();
  for (const std::int64_t count : bad_rays) answers.bad_rays += count;
  answers.hits = std::count_if(answers.id.begin(), answers.id.end(), [](std::int64_t id) { return id != kNothing; });
  return answers;
}

}  // namespace

void run_trace(const TraceOptions& options) {
  if (options.t == options.id) fail_usage("--t and --id name the same file");
  for (const std::string& path : {options.t, options.id})
    if (const Status status = check_writable(path); !status) fail(status.error());

  const RayFile rays(options.rays);
  const Input input = load_input(options.input);
  if (options.engine != Engine::brute) check_tree_memory(input.scene.spheres, options.tree);
  const Tracer tracer(input.scene.spheres, options.engine, options.tree);
  const Plane plane = input.scene.plane ? input.scene.plane->plane : thesis_plane().plane;

  const Timer timer;
  const Answers answers = trace(rays, tracer, options.plane ? &plane : nullptr, options);
  const double trace_ms = timer.elapsed_ms();
  if (answers.bad_rays > 0)
    warn(
        fmt::format("{} of {} rays hit nothing because they are no rays (NaN, infinite origin or direction, zero "
                    "direction, or t_min above t_max)",
                    grouped(answers.bad_rays), grouped(rays.size())));

  const std::string t_bytes = npy_bytes(answers.t, {rays.size()});
  const std::string id_bytes = npy_bytes(answers.id, {rays.size()});
  write_together({{options.t, t_bytes}, {options.id, id_bytes}});
  print(fmt::format("{}, {}: {} rays, {} hit something; tree {}, rays {}\n", options.t, options.id,
                    grouped(rays.size()), grouped(answers.hits), readable_ms(tracer.build_ms()),
                    readable_ms(trace_ms)));
}

}  // namespace bihive::cli
