// Quantities of the frame rates in section F of the text, at given costs of the steps of a ray.
#include <fmt/format.h>

#include <algorithm>

#include "figure_4_4.h"

namespace bihive::thesis {
namespace {

// A tree, or with MAX_PRIMS 0 brute force, in a configuration.
struct Contestant {
  double cost;
  std::int64_t max_prims;
  Configuration configuration;
  double gain_percent = 0;  // over brute force

  std::string words() const { return fmt::format("{}, {} primitives", tree_name(max_prims), configuration.second); }
};
bool cheaper(const Contestant& a, const Contestant& b) {
  return a.cost < b.cost;
}

// The shape of the curve over MAX_PRIMS: the rate is the reciprocal of the cost.
std::string shape_of(const std::vector<Contestant>& trees) {
  const auto peak = std::min_element(trees.begin(), trees.end(), cheaper);
  const bool rises = std::is_sorted(std::make_reverse_iterator(peak + 1), trees.rend(), cheaper);
  if (!rises || !std::is_sorted(peak, trees.end(), cheaper)) return "up and down";
  if (peak + 1 == trees.end()) return "only rises";
  return peak == trees.begin() ? "only falls" : "rises, peaks, falls";
}

// The gains of the best trees of a scenario.
Json gains_of(const std::vector<Contestant>& best) {
  const auto [least, most] = std::minmax_element(
      best.begin(), best.end(), [](const auto& a, const auto& b) { return a.gain_percent < b.gain_percent; });
  double sum = 0;
  for (const Contestant& tree : best) sum += tree.gain_percent;
  return {{"most", most->gain_percent},
          {"most_which", most->words()},
          {"least", least->gain_percent},
          {"least_which", least->words()},
          {"mean", sum / static_cast<double>(best.size())}};
}

}  // namespace

Json quantities_at(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs, const Values& values) {
  Json found = Json::object();
  std::vector<Contestant> best, all,
      bars;  // per configuration; all except trees of one leaf; those in the text's charts
  std::vector<double> one_leaf_over_brute;
  std::map<std::int64_t, std::vector<Contestant>> best_of_scenario;
  for (const auto& [configuration, trees] : work) {
    const std::int64_t spheres = configuration.second;
    const Contestant brute{costs.of({0, 0, static_cast<double>(spheres)}), 0, configuration};
    all.push_back(brute);
    std::vector<Contestant> named, any;  // those that the text names; all
    for (const auto& [prims, one] : trees) {
      const Contestant& tree = any.emplace_back(Contestant{costs.of(one), prims, configuration});
      const auto is_this = [&](std::int64_t of_text) { return std::min(of_text, spheres) == tree.max_prims; };
      if (std::any_of(pattern.among.begin(), pattern.among.end(), is_this)) named.push_back(tree);
      if (prims == spheres)
        one_leaf_over_brute.push_back(tree.cost / brute.cost);
      else
        all.push_back(tree);
    }
    bars.insert(bars.end(), named.begin(), named.end());
    const std::string name = fmt::format("scenario{}_spheres{}", configuration.first, spheres);
    Contestant& winner = best.emplace_back(*std::min_element(named.begin(), named.end(), cheaper));
    winner.gain_percent = 100 * (brute.cost / winner.cost - 1);
    best_of_scenario[configuration.first].push_back(winner);
    found["curve"][name] = shape_of(named);
    found["winner"][name] = winner.max_prims;
    found["sweet_spot"][name] = std::min_element(any.begin(), any.end(), cheaper)->max_prims;
  }
  found["wins"] = wins_of(work, pattern, costs);
  const Contestant& fastest = *std::min_element(best.begin(), best.end(), cheaper);
  found["best"] = fmt::format("{}, Scenario {}", fastest.words(), fastest.configuration.first);
  const Contestant worst = *std::max_element(all.begin(), all.end(), cheaper);
  found["worst_by_brute_force"] = worst.max_prims == 0 ? worst.configuration.second : 0;
  const auto [least, most] = std::minmax_element(one_leaf_over_brute.begin(), one_leaf_over_brute.end());
  found["one_leaf_over_brute_force"] = {*least, *most};

  const auto cost_of = [&](const std::string& name) {
    const auto trees = work.find({values.integer(name + ".scenario"), values.integer(name + ".spheres")});
    if (trees == work.end()) return 0.0;
    const auto tree = trees->second.find(values.integer(name + ".max_prims"));
    return tree == trees->second.end() ? 0.0 : costs.of(tree->second);
  };
  if (const double stated = cost_of("best"); stated > 0)
    found["above_the_best"] =
        std::count_if(bars.begin(), bars.end(), [stated](const Contestant& bar) { return bar.cost < stated; });
  if (cost_of("supposed_best") > 0) found["beyond_the_display"] = cost_of("best") / cost_of("supposed_best");
  std::map<std::int64_t, Json> gains;
  for (const auto& [scenario, trees] : best_of_scenario) {
    found["gain"][fmt::format("scenario{}", scenario)] = gains[scenario] = gains_of(trees);
    found["mean_gain"][std::to_string(scenario)] = gains[scenario]["mean"];
  }
  const std::vector<std::int64_t> pair = values.integers("mean_exceeds_best.scenarios");
  if (gains.count(pair.front()) > 0 && gains.count(pair.back()) > 0)
    found["mean_ahead_of_most"] = gains[pair.front()]["mean"].get<double>() - gains[pair.back()]["most"].get<double>();
  return found;
}

}  // namespace bihive::thesis
