#include "bihive/thesis/frame_rates.h"

#include <optional>
#include <string>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

constexpr int kQuickDivisor = 4;
constexpr std::int64_t kLargestNumber = 65536;  // of pixels along a side, and of recursions
// Time between two looks at the cancel token. Without a token a frame is drawn without a break.
constexpr double kSliceMs = 100, kWholeFrameMs = 1e9;

Error bad_value(const char* name, const char* expected) {
  return {std::string("expected ") + expected + " of \"" + name + "\" in Figure 4.4's values", "", 0, 0, ""};
}

RenderSettings frame_settings(const FrameRatePlan& plan, const Scene& scene) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = plan.width_px;
  settings.height_px = plan.height_px;
  settings.recursion = plan.recursion;
  settings.threads = plan.threads;
  return settings;
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

FrameRatePlan FrameRatePlan::quickly() const {
  FrameRatePlan plan = *this;
  plan.width_px = std::max(1, width_px / kQuickDivisor);
  plan.height_px = std::max(1, height_px / kQuickDivisor);
  plan.rounds = 1;
  plan.quick = true;
  plan.least_ms = 4;
  return plan;
}

Result<FrameRatePlan> FrameRatePlan::within(double seconds, const FrameEngine& engine) const {
  constexpr int kSmallest = 8;
  const auto smaller = [this](int divisor) {
    FrameRatePlan plan = *this;
    plan.width_px = std::max(1, width_px / divisor);
    plan.height_px = std::max(1, height_px / divisor);
    return plan;
  };

  // The time of a small frame by brute force on the most spheres, after one that warms up.
  FrameRatePlan pilot = smaller(kSmallest);
  pilot.max_prims.clear();
  pilot.rounds = 1;
  pilot.least_ms = 0;
  const std::int64_t most = *std::max_element(spheres.begin(), spheres.end());
  Result<FrameContest> contest = FrameContest::of_trees(pilot, engine, scenarios.front(), most);
  if (!contest) return contest.error();
  while (!contest->finished())
    if (Status status = contest->step(); !status) return status.error();
  const double pixels = static_cast<double>(pilot.width_px) * pilot.height_px;
  const double ms_of_a_unit = contest->rates().front().frame_ms.front() / pixels / frame_cost(most, false);

  // All frames of the run. With a graphics processor each round draws one more, for the scene's upload.
  double units = 0;
  int turns = 0;
  for (const std::int64_t count : spheres) {
    units += frame_cost(count, false) + frame_cost(count, true) * static_cast<double>(max_prims.size());
    turns += 1 + static_cast<int>(max_prims.size());
  }
  const double frames = static_cast<double>(scenarios.size()) * (rounds + 1) * (engine.gl != nullptr ? 2 : 1);
  for (int divisor = 1; divisor < kSmallest; ++divisor) {
    FrameRatePlan plan = smaller(divisor);
    const double area = static_cast<double>(plan.width_px) * plan.height_px;
    const double ms = frames * (units * ms_of_a_unit * area + turns * least_ms);
    if (ms <= 1000 * seconds) return plan;
  }
  return smaller(kSmallest);
}

Result<std::shared_ptr<const Scene>> FrameRatePlan::scene(std::int64_t scenario, std::int64_t count) const {
  if (scenario < 1 || scenario > 3) return Error{"there are the scenarios 1, 2 and 3", "", 0, 0, ""};
  Result<Scene> made = scenario_scene(static_cast<Scenario>(scenario), {count, static_cast<float>(radius), seed});
  if (!made) return made.error();
  made->camera.fov_deg = fov_deg;
  return std::make_shared<const Scene>(std::move(*made));
}

int FrameRatePlan::configurations() const {
  return static_cast<int>(scenarios.size() * spheres.size() * (1 + max_prims.size()));
}

double frame_cost(std::int64_t spheres, bool tree) {
  return tree ? 20 + static_cast<double>(spheres) / 8 : 10 + static_cast<double>(spheres);
}

EngineTimes times_of(const std::vector<MeasuredRate>& rates) {
  EngineTimes times;
  for (const MeasuredRate& rate : rates) {
    ConfigurationTimes& one = times[{rate.scenario, rate.spheres}];
    (rate.max_prims ? one.trees[*rate.max_prims] : one.brute) = rate.frame_ms;
  }
  return times;
}

Result<FrameContest> FrameContest::of_trees(const FrameRatePlan& plan, const FrameEngine& engine, std::int64_t scenario,
                                            std::int64_t spheres) {
  FrameContest contest(plan, engine);
  const Result<std::shared_ptr<const Scene>> scene = plan.scene(scenario, spheres);
  if (!scene) return scene.error();
  if (Status status = contest.add(*scene, scenario, std::nullopt); !status) return status.error();
  for (const std::int64_t max_prims : plan.max_prims)
    if (Status status = contest.add(*scene, scenario, max_prims); !status) return status.error();
  return contest;
}

Status FrameContest::add(std::shared_ptr<const Scene> scene, std::int64_t scenario,
                         std::optional<std::int64_t> max_prims) {
  BuildParameters parameters;
  if (max_prims) parameters.max_prims = *max_prims;
  Result<Tracer> tracer = Tracer::build(scene->spheres, max_prims ? engine_.tree : engine_.brute,
                                        max_prims ? TreeParameters(parameters) : engine_.brute_parameters);
  if (!tracer) return tracer.error();
  rates_.push_back({scenario, scene->spheres.size(), max_prims, {}});
  contestants_.push_back({std::move(scene), std::move(*tracer)});
  return Done{};
}

Status FrameContest::draw_frame(const Contestant& contestant, const RenderSettings& settings,
                                const CancelToken* cancel) {
  const Scene& scene = *contestant.scene;
  if (engine_.gl == nullptr) {
    Result<Rendered> rendered = render(scene, contestant.tracer, settings, {}, cancel, std::move(film_));
    if (!rendered) return rendered.error();
    film_ = std::move(rendered->film);
    return Done{};
  }
  if (Status status = engine_.gl->begin(scene.camera, settings); !status) return status;
  while (!engine_.gl->finished()) {
    if (cancel != nullptr && cancel->cancelled()) return Error{"cancelled", "", 0, 0, ""};
    if (Status status = engine_.gl->advance(cancel != nullptr ? kSliceMs : kWholeFrameMs); !status) return status;
  }
  return Done{};
}

// Milliseconds of a frame. Draws as many frames as the least time of a round needs.
Result<double> FrameContest::frame_ms(const Contestant& contestant, const CancelToken* cancel) {
  const RenderSettings settings = frame_settings(plan_, *contestant.scene);
  if (engine_.gl != nullptr) {
    if (Status status = engine_.gl->set_scene(*contestant.scene, contestant.tracer.tree()); !status)
      return status.error();
    // The first frame with a scene waits for its upload; that wait does not count.
    if (Status status = draw_frame(contestant, settings, cancel); !status) return status.error();
  }
  double all_ms = 0;
  int frames = 0;
  for (; frames == 0 || all_ms < plan_.least_ms; ++frames) {
    const Timer timer;
    if (Status status = draw_frame(contestant, settings, cancel); !status) return status.error();
    all_ms += timer.elapsed_ms();
  }
  return all_ms / frames;
}

Status FrameContest::step(const CancelToken* cancel) {
  if (finished()) return Done{};
  const Result<double> ms = frame_ms(contestants_[contestant_], cancel);
  if (!ms) {
    round_ = plan_.rounds + 1;
    return ms.error();
  }
  if (round_ > 0) rates_[contestant_].frame_ms.push_back(*ms);
  if (++contestant_ < contestants_.size()) return Done{};
  if (++round_ <= plan_.rounds) contestant_ = 0;
  return Done{};
}

FrameRateRun::FrameRateRun(FrameRatePlan plan, const FrameEngine& engine) : plan_(std::move(plan)), engine_(engine) {
  for (const std::int64_t spheres : plan_.spheres)
    all_cost_ += frame_cost(spheres, false) + frame_cost(spheres, true) * static_cast<double>(plan_.max_prims.size());
  all_cost_ *= static_cast<double>(plan_.scenarios.size()) * (plan_.rounds + 1);
}

double FrameRateRun::done() const {
  return finished_ ? 1 : done_cost_ / all_cost_;
}

double FrameRateRun::seconds_left() const {
  const double measured = done_cost_ - resumed_cost_;
  return measured > 0 ? spent_ms_ / 1000 * (all_cost_ - done_cost_) / measured : 0;
}

Status FrameRateRun::measure() {
  if (!contest_) {
    Result<FrameContest> contest = FrameContest::of_trees(plan_, engine_, scenario(), spheres());
    if (!contest) return contest.error();
    contest_ = std::move(*contest);
  }
  const MeasuredRate& rate = contest_->next();
  const double cost = frame_cost(rate.spheres, rate.max_prims.has_value());
  if (Status status = contest_->step(); !status) return status;
  done_cost_ += cost;
  return Done{};
}

Status FrameRateRun::step() {
  if (finished_) return Done{};
  const Timer timer;
  if (Status status = measure(); !status) {
    finished_ = true;
    return status;
  }
  spent_ms_ += timer.elapsed_ms();
  if (!contest_->finished()) return Done{};

  rates_.insert(rates_.end(), contest_->rates().begin(), contest_->rates().end());
  contest_.reset();
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
  const std::size_t group = 1 + plan_.max_prims.size();
  for (std::size_t first = 0; !finished_ && first + group <= rates.size(); first += group) {
    double cost = 0;
    for (std::size_t i = 0; i < group; ++i) {
      const MeasuredRate& rate = rates[first + i];
      const std::optional<std::int64_t> max_prims =
          i == 0 ? std::optional<std::int64_t>() : std::optional(plan_.max_prims[i - 1]);
      if (rate.scenario != scenario() || rate.spheres != spheres() || rate.max_prims != max_prims ||
          static_cast<int>(rate.frame_ms.size()) != plan_.rounds)
        return;
      cost += frame_cost(rate.spheres, max_prims.has_value());
    }
    done_cost_ += cost * (plan_.rounds + 1);
    resumed_cost_ = done_cost_;
    rates_.insert(rates_.end(), rates.begin() + static_cast<std::ptrdiff_t>(first),
                  rates.begin() + static_cast<std::ptrdiff_t>(first + group));
    go_on();
  }
}

}  // namespace bihive
