#include "bihive/thesis/shown_frames.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bihive/base/parallel.h"
#include "bihive/math/elementary.h"
#include "bihive/render/renderer.h"

namespace bihive {
namespace {

// Before a measurement, and never longer than that; these frames do not count.
constexpr double kWarmUpSeconds = 0.3;

// The camera, turned around the vertical axis through its look-at point.
Camera turned(const Camera& camera, double turns) {
  const auto [s, c] = sine_cosine_deg(360 * turns);
  const Vec3d from = camera.eye - camera.look_at;
  Camera around = camera;
  around.eye = camera.look_at + Vec3d{c * from.x + s * from.z, from.y, c * from.z - s * from.x};
  return around;
}

}  // namespace

Result<ShownFramesPlan> ShownFramesPlan::from_values(const StatedValues& values) {
  const Result<FrameRatePlan> figure = FrameRatePlan::from_values(values);
  if (!figure) return figure.error();
  const Result<std::int64_t> best = values.integer("winner.max_prims");
  if (!best) return best.error();
  ShownFramesPlan plan{*figure};
  plan.max_prims = {*best};
  return plan;
}

ShownFrames::ShownFrames(ShownFramesPlan plan) : plan_(std::move(plan)) {
  for (const std::int64_t scenario : plan_.scenarios)
    for (const std::int64_t spheres : plan_.spheres)
      for (const std::optional<std::int64_t>& max_prims :
           {std::optional<std::int64_t>(), std::optional(plan_.max_prims.front())})
        for (const bool turning : {false, true}) rates_.push_back({scenario, spheres, max_prims, turning, 0, 0});
}

// Makes scene and tree of the current measurement, unless they exist.
Status ShownFrames::prepare() {
  if (prepared_ == next_) return Done{};
  const ShownRate& rate = rates_[next_];
  Result<Scene> scene = plan_.scene(rate.scenario, rate.spheres);
  if (!scene) return scene.error();
  // The tracer refers to the spheres of the stored scene.
  tracer_.reset();
  scene_ = std::move(*scene);
  Result<Tracer> tracer =
      rate.max_prims ? Tracer::build(scene_->spheres, Engine::reference, BuildParameters{*rate.max_prims, kUnlimited})
                     : Tracer::build(scene_->spheres, Engine::automatic);
  if (!tracer) return tracer.error();
  tracer_ = std::move(*tracer);
  prepared_ = next_;
  warm_since_ms_.reset();
  since_ms_.reset();
  turned_ = 0;
  return Done{};
}

Result<const Image*> ShownFrames::draw() {
  failed_ = true;  // unless everything below succeeds
  if (Status status = prepare(); !status) return status.error();
  Scene& scene = *scene_;
  const RenderSettings settings = plan_.settings(scene);
  const Camera at_rest = scene.camera;
  if (rates_[next_].turning) scene.camera = turned(at_rest, turned_);
  Result<Rendered> rendered = render(scene, *tracer_, settings, {}, nullptr, std::move(film_));
  scene.camera = at_rest;
  if (!rendered) return rendered.error();
  failed_ = false;
  film_ = std::move(rendered->film);
  image_ = image_from_film(film_, settings.view, scene.picture.transfer, settings.threads);
  return &image_;
}

void ShownFrames::shown(double now_ms) {
  if (finished()) return;
  if (!warm_since_ms_) warm_since_ms_ = now_ms;
  if (!since_ms_) {
    // The last warm-up frame starts the clock, and does not count.
    if (now_ms - *warm_since_ms_ >= 1000 * std::min(kWarmUpSeconds, plan_.seconds)) since_ms_ = now_ms;
    return;
  }
  ShownRate& rate = rates_[next_];
  ++rate.frames;
  rate.seconds = (now_ms - *since_ms_) / 1000;
  turned_ = std::min(1.0, rate.seconds / plan_.seconds);
  if (rate.seconds >= plan_.seconds) ++next_;
}

std::string ShownFrames::json(const std::string& by, const std::string& device) const {
  using nlohmann::ordered_json;
  ordered_json json{{"experiment", "shown-frames"},
                    {"by", by},
                    {"device", device},
                    {"width_px", plan_.width_px},
                    {"height_px", plan_.height_px},
                    {"seconds", plan_.seconds},
                    {"threads", plan_.threads > 0 ? plan_.threads : hardware_threads()},
                    {"complete", next_ == rates_.size()},
                    {"configurations", ordered_json::array()}};
  for (std::size_t i = 0; i < next_; ++i) {
    const ShownRate& rate = rates_[i];
    json["configurations"].push_back({{"scenario", rate.scenario},
                                      {"spheres", rate.spheres},
                                      {"max_prims", rate.max_prims ? ordered_json(*rate.max_prims) : ordered_json()},
                                      {"turning", rate.turning},
                                      {"frames", rate.frames},
                                      {"seconds", rate.seconds},
                                      {"fps", rate.fps()}});
  }
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace bihive
