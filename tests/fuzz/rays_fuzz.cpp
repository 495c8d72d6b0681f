// Rays of an NPY file as `bihive trace` takes them: float32, (n, 6) or (n, 8), any bits. Every engine gives the same
// bits.
#include <string_view>

#include "bihive/io/npy.h"
#include "bihive/scene/generators.h"
#include "engines.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  static const Scene scene = *scenario_scene(static_cast<Scenario>(2), [] {
    ScenarioParameters parameters;
    parameters.count = 200;
    return parameters;
  }());
  static const Tracer tracers[] = {*Tracer::build(scene.spheres, Engine::brute, {}, 1),
                                   *Tracer::build(scene.spheres, Engine::reference, {}, 1),
                                   *Tracer::build(scene.spheres, Engine::wide, {}, 1)};

  // Rays that trace refuses are refused here.
  const Result<NpyArray> array = parse_npy({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!array) {
    fuzz::demand(!array.error().message.empty());
    return 0;
  }
  const std::string& dtype = array->dtype;
  if (dtype.size() < 2 || dtype.substr(dtype.size() - 2) != "f4") return 0;
  if (array->shape.size() != 2 || (array->shape[1] != 6 && array->shape[1] != 8)) return 0;
  const std::int64_t columns = array->shape[1];
  fuzz::demand(array->shape[0] >= 0 && array->values.size() == static_cast<std::size_t>(array->shape[0] * columns));
  RayBatch rays;
  for (std::int64_t i = 0; i < array->shape[0]; ++i) {
    const double* const row = array->values.data() + i * columns;
    Ray ray;
    ray.origin = to_float({row[0], row[1], row[2]});
    ray.direction = to_float({row[3], row[4], row[5]});
    if (columns == 8) {
      ray.t_min = row[6];
      ray.t_max = row[7];
    }
    rays.push_back(ray);
  }
  const fuzz::Answers expected = fuzz::answers_of(tracers[0], rays, RayOrder::any);
  for (const Tracer& tracer : tracers)
    for (const RayOrder order : {RayOrder::any, RayOrder::blocks})
      fuzz::demand(fuzz::answers_of(tracer, rays, order) == expected);

  // The output of trace is read again.
  const auto count = static_cast<std::int64_t>(expected.t.size());
  const Result<NpyArray> t = parse_npy(npy_bytes(expected.t, {count}), "fuzz");
  fuzz::demand(t.ok() && t->dtype == "<f8" && fuzz::same_bytes(t->values, expected.t));
  const Result<NpyArray> id = parse_npy(npy_bytes(expected.id, {count}), "fuzz");
  fuzz::demand(id.ok() && id->dtype == "<i8" &&
               std::equal(id->values.begin(), id->values.end(), expected.id.begin(), expected.id.end(),
                          [](double a, std::int64_t b) { return a == static_cast<double>(b); }));
  return 0;
}
