#include "thesis_run.h"

#include <emscripten/bind.h>

#include <algorithm>
#include <utility>

#include "answers.h"
#include "bihive/base/json_text.h"
#include "bihive/base/parallel.h"
#include "bihive/thesis/frame_rates_report.h"
#include "bihive/thesis/stated_values.h"

namespace bihive::page {
namespace {

using nlohmann::ordered_json;

// Slower devices draw smaller pictures.
constexpr double kSeconds = 600, kQuickSeconds = 60;

Error not_begun() {
  return {"no run of the thesis has begun", "", 0, 0, ""};
}

Result<StatedValues> stated_values() {
  return StatedValues::parse(builtin_values_figure_4_4(), "thesis/figure-4.4/values.json");
}

Result<FrameRatePlan> stated_plan() {
  const Result<StatedValues> values = stated_values();
  return values ? FrameRatePlan::from_values(*values) : Result<FrameRatePlan>(values.error());
}

MeasuringDevice device_from(const std::string& text) {
  const Result<ordered_json> json = json_from_text<ordered_json>(text);
  MeasuringDevice device;
  if (!json || !json->is_object()) return device;
  for (const auto& [name, value] : json->items()) {
    if (!value.is_string()) continue;
    if (name == "device")
      device.words = value.get<std::string>();
    else
      device.facts.emplace_back(name, value.get<std::string>());
  }
  return device;
}

}  // namespace

Result<GlRenderer*> ThesisRun::renderer() {
  if (!gpu_) return static_cast<GlRenderer*>(nullptr);
  if (!renderer_) {
    Result<GlRenderer> renderer = GlRenderer::create(browser_gl_functions());
    if (!renderer) return renderer.error();
    renderer_ = std::move(*renderer);
  }
  return &*renderer_;
}

std::string ThesisRun::begin(bool quick, const std::string& saved) {
  return with_memory([&] {
    Result<FrameRatePlan> plan = stated_plan();
    if (!plan) return failure(plan.error());
    if (quick) plan = plan->quickly();
    const Result<GlRenderer*> drawn_by = renderer();
    if (!drawn_by) return failure(drawn_by.error());
    const std::optional<SavedFrameRates> earlier = saved_frame_rates(saved);
    const bool same = earlier && earlier->engine == name() && earlier->quick == quick &&
                      earlier->rounds == plan->rounds && earlier->width_px <= plan->width_px;
    if (same) {
      plan->width_px = earlier->width_px;
      plan->height_px = earlier->height_px;
    } else {
      plan = plan->within(quick ? kQuickSeconds : kSeconds, *drawn_by);
      if (!plan) return failure(plan.error());
    }
    earlier_.reset();
    run_ = std::make_shared<FrameRateRun>(*plan, *drawn_by);
    if (same) run_->resume(earlier->rates);
    return text_of({{"width_px", plan->width_px}, {"height_px", plan->height_px}, {"resumed", run_->rates().size()}});
  });
}

std::string ThesisRun::begin_pass(double seconds) {
  return with_memory([&] {
    const Result<GlRenderer*> drawn_by = renderer();
    if (!drawn_by) return failure(drawn_by.error());
    Result<FrameRatePlan> plan = stated_plan();
    if (plan && !earlier_) {
      plan->rounds = 1;
      plan = plan->within(seconds, *drawn_by);
    }
    if (!plan) return failure(plan.error());
    if (earlier_) {
      *plan = earlier_->plan();
      plan->rounds = 1;
    }
    run_ = std::make_shared<FrameRateRun>(*plan, *drawn_by);
    return text_of({{"width_px", plan->width_px}, {"height_px", plan->height_px}});
  });
}

std::string ThesisRun::step() {
  return with_memory([&] {
    if (!run_) return failure(not_begun());
    if (const Status status = run_->step(); !status) return failure(status.error());
    ordered_json json{{"finished", run_->finished()},
                      {"done", run_->done()},
                      {"seconds_left", run_->seconds_left()},
                      {"configurations_done", run_->rates().size()},
                      {"configurations", run_->plan().configurations()},
                      {"scenario", run_->scenario()},
                      {"spheres", run_->spheres()}};
    if (run_->finished()) {
      double ms = 0;
      for (const MeasuredRate& rate : run_->rates()) ms += rate.frame_ms.back();
      json["round_ms"] = ms;
      if (earlier_) run_->put_after(*earlier_);
      earlier_ = run_;
    }
    return text_of(json);
  });
}

std::string ThesisRun::so_far(const std::string& device) const {
  return with_memory([&] {
    if (!run_) return failure(not_begun());
    const Result<StatedValues> values = stated_values();
    if (!values) return failure(values.error());
    const FrameRateRun& run = earlier_ ? *earlier_ : *run_;
    std::optional<MeasuredCosts> costs;
    if (run.finished()) {
      Result<MeasuredCosts> measured = measured_costs(run, *values, gpu_ ? 1 : hardware_threads());
      if (!measured) return failure(measured.error());
      costs = std::move(*measured);
    }
    const MeasuredCosts* const known = costs ? &*costs : nullptr;
    ordered_json json;
    json["result"] = frame_rates_json(run, *values, name(), device_from(device), known);
    json["charts"] = frame_rates_charts(run, *values, "this device", known);
    return text_of(json);
  });
}

std::string ShownFramesRun::begin(double seconds) {
  return with_memory([&] {
    const Result<StatedValues> values = stated_values();
    if (!values) return failure(values.error());
    Result<ShownFramesPlan> plan = ShownFramesPlan::from_values(*values);
    if (!plan) return failure(plan.error());
    plan->seconds = seconds;
    frames_.emplace(std::move(*plan));
    return std::string("{}");
  });
}

std::string ShownFramesRun::draw() {
  return with_memory([&] {
    if (!frames_) return failure(not_begun());
    const Result<const Image*> image = frames_->draw();
    if (!image) return failure(image.error());
    pixels_ = pixels_of(**image);
    return text_of({{"width", (*image)->width}, {"height", (*image)->height}});
  });
}

emscripten::val ShownFramesRun::pixels() const {
  return emscripten::val(emscripten::typed_memory_view(pixels_.size(), pixels_.data()));
}

std::string ShownFramesRun::shown(double now_ms) {
  return with_memory([&] {
    if (!frames_) return failure(not_begun());
    frames_->shown(now_ms);
    const std::vector<ShownRate>& rates = frames_->rates();
    const ShownRate& now = rates[std::min(frames_->measured(), rates.size() - 1)];
    return text_of({{"finished", frames_->finished()},
                    {"done", static_cast<double>(frames_->measured()) / static_cast<double>(rates.size())},
                    {"scenario", now.scenario},
                    {"spheres", now.spheres},
                    {"max_prims", now.max_prims ? ordered_json(*now.max_prims) : ordered_json()},
                    {"turning", now.turning}});
  });
}

std::string ShownFramesRun::result(const std::string& device) const {
  return with_memory([&] {
    if (!frames_) return failure(not_begun());
    return text_of({{"result", frames_->json("page", device_from(device).words)}});
  });
}

}  // namespace bihive::page

EMSCRIPTEN_BINDINGS(thesis_run) {
  using bihive::page::ShownFramesRun;
  using bihive::page::ThesisRun;
  emscripten::class_<ThesisRun>("ThesisRun")
      .constructor<bool>()
      .function("begin", &ThesisRun::begin)
      .function("begin_pass", &ThesisRun::begin_pass)
      .function("step", &ThesisRun::step)
      .function("so_far", &ThesisRun::so_far);
  emscripten::class_<ShownFramesRun>("ShownFramesRun")
      .constructor<>()
      .function("begin", &ShownFramesRun::begin)
      .function("draw", &ShownFramesRun::draw)
      .function("pixels", &ShownFramesRun::pixels)
      .function("shown", &ShownFramesRun::shown)
      .function("result", &ShownFramesRun::result);
}
