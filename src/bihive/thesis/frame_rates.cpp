#include "bihive/thesis/frame_rates.h"

#include <optional>
#include <string>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/base/watch.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

constexpr int kQuickDivisor = 4;
constexpr std::int64_t kLargestNumber = 65536;  // pixels along a side, and recursions
// Time between two checks of the cancel token. Without a token a frame is drawn without a break.
constexpr double kSliceMs = 100, kWholeFrameMs = 1e9;

Error bad_value(const char* name, const char* expected) {
  return {std::string("expected ") + expected + " of \"" + name + "\" in Figure 4.4's values", "", 0, 0, ""};
}

// An estimate of the time of a frame, in units of its own. Brute force: in proportion to the number of spheres. A tree:
// a smaller share of that, and a constant.
double frame_cost(std::int64_t spheres, bool tree) {
  return tree ? 20 + static_cast<double>(spheres) / 8 : 10 + static_cast<double>(spheres);
}

// A round of all contestants with this number of spheres, and of all configurations.
double cost_of_round(const FrameRatePlan& plan, std::int64_t spheres) {
  return frame_cost(spheres, false) + frame_cost(spheres, true) * static_cast<double>(plan.max_prims.size());
}
double cost_of_round(const FrameRatePlan& plan) {
  double sum = 0;
  for (const std::int64_t spheres : plan.spheres) sum += cost_of_round(plan, spheres);
  return sum * static_cast<double>(plan.scenarios.size());
}

}  // namespace

Result<FrameRatePlan> FrameRatePlan::from_values(const StatedValues& values) {
  FrameRatePlan plan;
  const auto at_least_one = [](std::int64_t value) { return value >= 1; };
  for (const auto& [name, list] : {std::pair{"scenarios", &plan.scenarios},
                                   {"spheres_list", &plan.spheres},
                                   {"max_prims_list", &plan.max_prims}}) {
    Result<std::vector<std::int64_t>> counts = values.integers(name);
    if (!counts || !std::all_of(counts->begin(), counts->end(), at_least_one))
      return bad_value(name, "a list of counts");
    *list = std::move(*counts);
  }
  for (const auto& [name, number] :
       {std::pair{"width_px", &plan.width_px}, {"height_px", &plan.height_px}, {"recursion", &plan.recursion}}) {
    const Result<std::int64_t> value = values.integer(name);
    if (!value || *value < 1 || *value > kLargestNumber) return bad_value(name, "a whole number from 1 to 65536");
    *number = static_cast<int>(*value);
  }
  const Result<double> radius = values.number("radius");
  if (!radius) return radius.error();
  plan.radius = *radius;
  return plan;
}

FrameRatePlan FrameRatePlan::smaller(int divisor) const {
  FrameRatePlan plan = *this;
  plan.width_px = std::max(1, width_px / divisor);
  plan.height_px = std::max(1, height_px / divisor);
  return plan;
}

FrameRatePlan FrameRatePlan::quickly() const {
  FrameRatePlan plan = smaller(kQuickDivisor);
  plan.rounds = 1;
  plan.quick = true;
  plan.least_ms = 4;
  return plan;
}

Result<FrameRatePlan> FrameRatePlan::within(double seconds, GlRenderer* gl) const {
  // The time of a small frame by brute force on the most spheres, after one that warms up.
  constexpr int kSmallest = 8;
  FrameRatePlan pilot = smaller(kSmallest);
  const std::int64_t most = *std::max_element(spheres.begin(), spheres.end());
  pilot.scenarios = {scenarios.front()};
  pilot.spheres = {most};
  pilot.max_prims.clear();
  pilot.rounds = 1;
  pilot.least_ms = 0;
  FrameRateRun run(pilot, gl);
  while (!run.finished())
    if (Status status = run.step(); !status) return status.error();
  const double pixels = static_cast<double>(pilot.width_px) * pilot.height_px;
  const double ms_of_a_unit = run.rates().front().frame_ms.front() / pixels / frame_cost(most, false);

  // All frames of the run. With a graphics processor each round draws one more, for the scene's upload.
  const int frames = (rounds + 1) * (gl != nullptr ? 2 : 1);
  for (int divisor = 1; divisor < kSmallest; ++divisor) {
    const FrameRatePlan plan = smaller(divisor);
    const double area = static_cast<double>(plan.width_px) * plan.height_px;
    const double ms = frames * (cost_of_round(*this) * ms_of_a_unit * area + configurations() * least_ms);
    if (ms <= 1000 * seconds) return plan;
  }
  return smaller(kSmallest);
}

Result<Scene> FrameRatePlan::scene(std::int64_t scenario, std::int64_t count) const {
  if (scenario < 1 || scenario > 3) return Error{"there are the scenarios 1, 2 and 3", "", 0, 0, ""};
  Result<Scene> made = scenario_scene(static_cast<Scenario>(scenario),
                                      {count, static_cast<float>(radius), seed, static_cast<float>(corner_side)});
  if (!made) return made.error();
  made->camera.fov_deg = fov_deg;
  return made;
}

RenderSettings FrameRatePlan::settings(const Scene& scene) const {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = width_px;
  settings.height_px = height_px;
  settings.recursion = recursion;
  settings.threads = threads;
  return settings;
}

int FrameRatePlan::configurations() const {
  return static_cast<int>(scenarios.size() * spheres.size() * (1 + max_prims.size()));
}

EngineTimes times_of(const std::vector<MeasuredRate>& rates) {
  EngineTimes times;
  for (const MeasuredRate& rate : rates) {
    ConfigurationTimes& one = times[{rate.scenario, rate.spheres}];
    (rate.max_prims ? one.trees[*rate.max_prims] : one.brute) = rate.frame_ms;
  }
  return times;
}

FrameRateRun::FrameRateRun(FrameRatePlan plan, GlRenderer* gl)
    : plan_(std::move(plan)), gl_(gl), all_cost_(cost_of_round(plan_) * (plan_.rounds + 1)) {}

double FrameRateRun::seconds_left() const {
  const double measured = done_cost_ - resumed_cost_;
  return measured > 0 ? spent_ms_ / 1000 * (all_cost_ - done_cost_) / measured : 0;
}

// The contestants of the current configuration, without times.
std::vector<MeasuredRate> FrameRateRun::new_group() const {
  std::vector<MeasuredRate> group{{scenario(), spheres()}};
  for (const std::int64_t max_prims : plan_.max_prims) group.push_back({scenario(), spheres(), max_prims});
  return group;
}

Status FrameRateRun::build_trees() {
  Result<Scene> scene = plan_.scene(scenario(), spheres());
  if (!scene) return scene.error();
  scene_ = std::make_shared<const Scene>(std::move(*scene));
  group_ = new_group();
  for (const MeasuredRate& rate : group_) {
    Result<Tracer> tracer =
        rate.max_prims ? Tracer::build(scene_->spheres, Engine::reference, BuildParameters{*rate.max_prims, kUnlimited})
                       : Tracer::build(scene_->spheres, Engine::brute);
    if (!tracer) return tracer.error();
    tracers_.push_back(std::move(*tracer));
  }
  return Done{};
}

Status FrameRateRun::draw_frame(const RenderSettings& settings, const CancelToken* cancel) {
  if (gl_ == nullptr) {
    Result<Rendered> rendered = render(*scene_, tracers_[contestant_], settings, {}, cancel, std::move(film_));
    if (!rendered) return rendered.error();
    film_ = std::move(rendered->film);
    return Done{};
  }
  if (Status status = gl_->begin(scene_->camera, settings); !status) return status;
  while (!gl_->finished()) {
    if (cancel != nullptr && cancel->cancelled()) return cancelled_error();
    if (Status status = gl_->advance(cancel != nullptr ? kSliceMs : kWholeFrameMs); !status) return status;
  }
  return Done{};
}

// Milliseconds of a frame. Draws as many frames as the least time of a round needs.
Result<double> FrameRateRun::frame_ms(const CancelToken* cancel) {
  const RenderSettings settings = plan_.settings(*scene_);
  if (gl_ != nullptr) {
    if (Status status = gl_->set_scene(*scene_, tracers_[contestant_].tree()); !status) return status.error();
    // The first frame with a scene waits for its upload; that wait does not count.
    if (Status status = draw_frame(settings, cancel); !status) return status.error();
  }
  double all_ms = 0;
  int frames = 0;
  for (; frames == 0 || all_ms < plan_.least_ms; ++frames) {
    const Timer timer;
    if (Status status = draw_frame(settings, cancel); !status) return status.error();
    all_ms += timer.elapsed_ms();
  }
  return all_ms / frames;
}

Status FrameRateRun::measure(const CancelToken* cancel) {
  if (tracers_.empty())
    if (Status status = build_trees(); !status) return status;
  const Result<double> ms = frame_ms(cancel);
  if (!ms) return ms.error();
  MeasuredRate& rate = group_[contestant_];
  if (round_ > 0) rate.frame_ms.push_back(*ms);
  done_cost_ += frame_cost(rate.spheres, rate.max_prims.has_value());
  return Done{};
}

Status FrameRateRun::step(const CancelToken* cancel) {
  if (finished_) return Done{};
  const Timer timer;
  if (Status status = measure(cancel); !status) {
    finished_ = true;
    return status;
  }
  spent_ms_ += timer.elapsed_ms();
  if (++contestant_ < group_.size()) return Done{};
  contestant_ = 0;
  if (++round_ <= plan_.rounds) return Done{};
  round_ = 0;
  rates_.insert(rates_.end(), group_.begin(), group_.end());
  tracers_.clear();
  go_on();
  return Done{};
}

void FrameRateRun::put_after(const FrameRateRun& earlier) {
  for (std::size_t i = 0; i < rates_.size(); ++i)
    rates_[i].frame_ms.insert(rates_[i].frame_ms.begin(), earlier.rates_[i].frame_ms.begin(),
                              earlier.rates_[i].frame_ms.end());
  plan_.rounds += earlier.plan_.rounds;
}

// To the next number of spheres, and the next scenario.
void FrameRateRun::go_on() {
  if (++count_ < plan_.spheres.size()) return;
  count_ = 0;
  finished_ = ++scenario_ == plan_.scenarios.size();
}

void FrameRateRun::resume(const std::vector<MeasuredRate>& rates) {
  const std::size_t size = 1 + plan_.max_prims.size();
  for (auto first = rates.begin(); !finished_ && rates.end() - first >= static_cast<std::ptrdiff_t>(size);) {
    for (const MeasuredRate& expected : new_group()) {
      const MeasuredRate& rate = *first++;
      if (rate.scenario != expected.scenario || rate.spheres != expected.spheres ||
          rate.max_prims != expected.max_prims || static_cast<int>(rate.frame_ms.size()) != plan_.rounds)
        return;
    }
    resumed_cost_ = done_cost_ += cost_of_round(plan_, spheres()) * (plan_.rounds + 1);
    rates_.insert(rates_.end(), first - static_cast<std::ptrdiff_t>(size), first);
    go_on();
  }
}

}  // namespace bihive
