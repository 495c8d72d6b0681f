#include "bihive/viewer/frame_rates.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"

namespace bihive {
namespace {

using nlohmann::json;

constexpr int kQuickDivisor = 4;
constexpr double kWholeFrameMs = 1e9;

// Reads values.json: {"values": {name: {"value": ...}}}. Null if the name is missing.
json value_of(const json& document, const char* name) {
  const auto values = document.find("values");
  if (values == document.end() || !values->is_object()) return {};
  const auto entry = values->find(name);
  if (entry == values->end() || !entry->is_object() || !entry->contains("value")) return {};
  return (*entry)["value"];
}

bool is_list_of_counts(const json& value) {
  return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), [](const json& each) {
           return each.is_number_integer() && each.get<std::int64_t>() >= 1;
         });
}

// An estimate of the time of a frame. Brute force: in proportion to the number of spheres. A tree: a smaller share of
// that, and a constant.
double weight_of(std::int64_t spheres, bool tree) {
  return tree ? 20 + static_cast<double>(spheres) / 8 : 10 + static_cast<double>(spheres);
}

}  // namespace

Result<FrameRatePlan> FrameRatePlan::from_values(std::string_view values_json) {
  const json document = json::parse(values_json, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object()) return Error{"the stated values of Figure 4.4 are not JSON", "", 0, 0, ""};
  FrameRatePlan plan;
  for (const auto& [name, list] : {std::pair{"scenarios", &plan.scenarios},
                                   {"spheres_list", &plan.spheres},
                                   {"max_prims_list", &plan.max_prims}}) {
    const json value = value_of(document, name);
    if (!is_list_of_counts(value))
      return Error{std::string("expected a list of counts of \"") + name + "\" in Figure 4.4's values", "", 0, 0, ""};
    *list = value.get<std::vector<std::int64_t>>();
  }
  for (const auto& [name, number] :
       {std::pair{"width_px", &plan.width_px}, {"height_px", &plan.height_px}, {"recursion", &plan.recursion}}) {
    const json value = value_of(document, name);
    if (!value.is_number_integer() || value.get<int>() < 1)
      return Error{std::string("expected a number of \"") + name + "\" in Figure 4.4's values", "", 0, 0, ""};
    *number = value.get<int>();
  }
  if (const json radius = value_of(document, "radius"); radius.is_number()) plan.radius = radius.get<double>();
  return plan;
}

FrameRatePlan FrameRatePlan::quickly() const {
  FrameRatePlan plan = *this;
  plan.width_px = std::max(1, width_px / kQuickDivisor);
  plan.height_px = std::max(1, height_px / kQuickDivisor);
  plan.rounds = 1;
  plan.least_ms = 4;
  plan.quick = true;
  return plan;
}

int FrameRatePlan::configurations() const {
  return static_cast<int>(scenarios.size() * spheres.size() * (1 + max_prims.size()));
}

double MeasuredRate::fps() const {
  std::vector<double> sorted = frame_ms;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return 1000 / *middle;
}

FrameRateRun::FrameRateRun(FrameRatePlan plan, GlRenderer* gl) : plan_(std::move(plan)), gl_(gl) {
  for (const std::int64_t spheres : plan_.spheres)
    all_weight_ += weight_of(spheres, false) + weight_of(spheres, true) * static_cast<double>(plan_.max_prims.size());
  all_weight_ *= static_cast<double>(plan_.scenarios.size()) * (plan_.rounds + 1);
}

bool FrameRateRun::finished() const {
  return finished_;
}

double FrameRateRun::done() const {
  return finished_ ? 1 : done_weight_ / all_weight_;
}

double FrameRateRun::seconds_left() const {
  return done_weight_ > 0 ? spent_ms_ / 1000 * (all_weight_ - done_weight_) / done_weight_ : 0;
}

Status FrameRateRun::begin_group() {
  ScenarioParameters parameters;
  parameters.count = plan_.spheres[count_];
  parameters.radius = static_cast<float>(plan_.radius);
  const std::int64_t scenario = plan_.scenarios[scenario_];
  if (scenario < 1 || scenario > 3) return Error{"there are the scenarios 1, 2 and 3", "", 0, 0, ""};
  group_.clear();
  Result<Scene> scene = scenario_scene(static_cast<Scenario>(scenario), parameters);
  if (!scene) return scene.error();
  scene_ = std::move(*scene);
  settings_ = settings_from(scene_.picture);
  settings_.width_px = plan_.width_px;
  settings_.height_px = plan_.height_px;
  settings_.recursion = plan_.recursion;

  // Brute force, then a tree of each MAX_PRIMS.
  for (std::size_t i = 0; i <= plan_.max_prims.size(); ++i) {
    Contestant contestant;
    contestant.rate.scenario = scenario;
    contestant.rate.spheres = parameters.count;
    BuildParameters tree;
    if (i > 0) contestant.rate.max_prims = tree.max_prims = plan_.max_prims[i - 1];
    if (!gl_) {
      Result<Tracer> tracer = Tracer::build(scene_.spheres, i > 0 ? Engine::reference : Engine::brute, tree);
      if (!tracer) return tracer.error();
      contestant.tracer = std::move(*tracer);
    } else if (i > 0) {
      contestant.tree = build_reference_tree(scene_.spheres, tree);
    }
    group_.push_back(std::move(contestant));
  }
  contestant_ = 0;
  round_ = 0;
  return Done{};
}

Status FrameRateRun::draw_frame(Film& film) {
  if (!gl_) {
    Result<Rendered> rendered = render(scene_, *group_[contestant_].tracer, settings_, {}, nullptr, std::move(film));
    if (!rendered) return rendered.error();
    film = std::move(rendered->film);
    return Done{};
  }
  if (Status status = gl_->begin(scene_.camera, settings_); !status) return status;
  while (!gl_->finished())
    if (Status status = gl_->advance(kWholeFrameMs); !status) return status;
  return Done{};
}

// Milliseconds of a frame. Draws as many frames as the least time of a round needs.
Result<double> FrameRateRun::frame_ms() {
  if (gl_) {
    const std::optional<Tree>& tree = group_[contestant_].tree;
    if (Status status = gl_->set_scene(scene_, tree ? &*tree : nullptr); !status) return status.error();
    // The first frame with a scene waits for its upload; that wait does not count.
    if (Status status = draw_frame(film_); !status) return status.error();
  }
  double all_ms = 0;
  int frames = 0;
  for (; frames == 0 || all_ms < plan_.least_ms; ++frames) {
    const Timer timer;
    if (Status status = draw_frame(film_); !status) return status.error();
    all_ms += timer.elapsed_ms();
  }
  return all_ms / frames;
}

Status FrameRateRun::step() {
  if (finished_) return Done{};
  const Timer timer;
  if (contestant_ == 0 && round_ == 0)
    if (Status status = begin_group(); !status) {
      finished_ = true;
      return status;
    }
  const Result<double> ms = frame_ms();
  if (!ms) {
    finished_ = true;
    return ms.error();
  }
  MeasuredRate& rate = group_[contestant_].rate;
  if (round_ > 0) rate.frame_ms.push_back(*ms);
  done_weight_ += weight_of(rate.spheres, rate.max_prims.has_value());
  spent_ms_ += timer.elapsed_ms();

  // Go on to the next contestant, round, number of spheres, scenario.
  if (contestant_ + 1 < group_.size()) {
    ++contestant_;
    return Done{};
  }
  if (round_ < plan_.rounds) {
    contestant_ = 0;
    ++round_;
    return Done{};
  }
  for (const Contestant& each : group_) rates_.push_back(each.rate);
  contestant_ = 0;
  round_ = 0;
  if (++count_ == plan_.spheres.size()) {
    count_ = 0;
    finished_ = ++scenario_ == plan_.scenarios.size();
  }
  return Done{};
}

}  // namespace bihive
