#include "claims_at_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bihive/thesis/frame_rates_report.h"

namespace bihive::thesis {
namespace {

class Quantities {
 public:
  Quantities(const FigureWork& work, const StepCosts& costs, const Values& values)
      : work_(work),
        costs_(costs),
        values_(values),
        scenarios_(values.integers("scenarios")),
        counts_(values.integers("spheres_list")),
        max_prims_(values.integers("max_prims_list")) {}

  Json all() {
    for (const auto& [configuration, trees] : work_) {
      add_configuration(configuration, trees);
      add_extremes(configuration, trees);
    }
    found_["wins"] = wins_of(work_, values_.integer("winner.max_prims"), max_prims_, costs_.inner, costs_.leaf);
    found_["best"] = which(best_);
    found_["worst_by_brute_force"] = worst_is_brute_ ? worst_.configuration.second : 0;
    found_["one_leaf_over_brute_force"] = {least_one_leaf_, most_one_leaf_};
    found_["slowest_tree_over_brute_force"] = most_over_brute_;
    const auto cost_of = [this](const std::string& name) {
      const auto trees = work_.find({values_.integer(name + ".scenario"), values_.integer(name + ".spheres")});
      if (trees == work_.end()) return 0.0;
      const auto tree = trees->second.find(values_.integer(name + ".max_prims"));
      return tree == trees->second.end() ? 0.0 : costs_.of(tree->second);
    };
    if (cost_of("supposed_best") > 0) found_["beyond_the_display"] = cost_of("best") / cost_of("supposed_best");
    add_gains();
    return std::move(found_);
  }

 private:
  struct Contestant {
    double cost;
    std::int64_t max_prims;
    Configuration configuration;
  };

  static std::string which(const Contestant& tree) {
    return fmt::format("{}, {} primitives", tree_name(tree.max_prims), tree.configuration.second);
  }

  double brute(const Configuration& configuration) const {
    return costs_.of({0, 0, static_cast<double>(configuration.second)});
  }

  // The cheapest tree; `named`: among the text's values of MAX_PRIMS.
  Contestant cheapest(const Configuration& configuration, const WorkByTree& trees, bool named) const {
    Contestant best{std::numeric_limits<double>::infinity(), 0, configuration};
    for (const auto& [prims, work] : trees) {
      if (named && std::find(max_prims_.begin(), max_prims_.end(), prims) == max_prims_.end()) continue;
      if (costs_.of(work) < best.cost) best = {costs_.of(work), prims, configuration};
    }
    return best;
  }

  static std::string name_of(const Configuration& configuration) {
    return fmt::format("scenario{}_spheres{}", configuration.first, configuration.second);
  }

  // Which tree wins, and the shape of the curve over MAX_PRIMS: the rate is the reciprocal of the cost.
  void add_configuration(const Configuration& configuration, const WorkByTree& trees) {
    std::vector<double> rates;
    for (const std::int64_t prims : max_prims_)
      if (trees.count(prims) > 0) rates.push_back(1 / costs_.of(trees.at(prims)));
    const auto peak = std::max_element(rates.begin(), rates.end());
    const bool one_peak =
        std::is_sorted(rates.begin(), peak + 1) && std::is_sorted(rates.rbegin(), std::make_reverse_iterator(peak));
    found_["curve"][name_of(configuration)] = !one_peak                 ? "up and down"
                                              : peak + 1 == rates.end() ? "only rises"
                                              : peak == rates.begin()   ? "only falls"
                                                                        : "rises, peaks, falls";
    found_["winner"][name_of(configuration)] = cheapest(configuration, trees, true).max_prims;
    found_["sweet_spot"][name_of(configuration)] = cheapest(configuration, trees, false).max_prims;
  }

  void add_extremes(const Configuration& configuration, const WorkByTree& trees) {
    const Contestant best = cheapest(configuration, trees, true);
    if (best_.max_prims == 0 || best.cost < best_.cost) best_ = best;
    const auto consider = [&](double cost, std::int64_t prims) {
      if (cost <= worst_.cost) return;
      worst_ = {cost, prims, configuration};
      worst_is_brute_ = prims == 0;
    };
    const double by_brute_force = brute(configuration);
    consider(by_brute_force, 0);
    for (const auto& [prims, work] : trees) {
      const double over_brute = costs_.of(work) / by_brute_force;
      most_over_brute_ = std::max(most_over_brute_, over_brute);
      if (prims != configuration.second) {
        consider(costs_.of(work), prims);
        continue;
      }
      least_one_leaf_ = std::min(least_one_leaf_, over_brute);
      most_one_leaf_ = std::max(most_one_leaf_, over_brute);
    }
  }

  // The gains of the best tree over brute force, in percent.
  void add_gains() {
    std::map<std::int64_t, double> most_of, mean_of;
    for (const std::int64_t scenario : scenarios_) {
      Json gains = Json::object();
      double sum = 0;
      for (const std::int64_t count : counts_) {
        const auto found = work_.find({scenario, count});
        if (found == work_.end()) return;
        const Contestant best = cheapest(found->first, found->second, true);
        const double gain = 100 * (brute(found->first) / best.cost - 1);
        sum += gain;
        const auto keep = [&](const char* name, bool better) {
          if (gains.contains(name) && !better) return;
          gains[name] = gain;
          gains[std::string(name) + "_which"] = which(best);
        };
        keep("most", gain > gains.value("most", 0.0));
        keep("least", gain < gains.value("least", 0.0));
      }
      gains["mean"] = mean_of[scenario] = sum / static_cast<double>(counts_.size());
      most_of[scenario] = gains["most"].get<double>();
      found_["gain"][fmt::format("scenario{}", scenario)] = std::move(gains);
      found_["mean_gain"][std::to_string(scenario)] = mean_of[scenario];
    }
    const std::vector<std::int64_t> pair = values_.integers("mean_exceeds_best.scenarios");
    if (mean_of.count(pair.front()) > 0 && most_of.count(pair.back()) > 0)
      found_["mean_ahead_of_most"] = mean_of[pair.front()] - most_of[pair.back()];
  }

  const FigureWork& work_;
  const StepCosts costs_;
  const Values& values_;
  const std::vector<std::int64_t> scenarios_, counts_, max_prims_;
  Json found_ = Json::object();
  Contestant best_{0, 0, {}}, worst_{0, 0, {}};
  bool worst_is_brute_ = false;
  double least_one_leaf_ = std::numeric_limits<double>::infinity(), most_one_leaf_ = 0, most_over_brute_ = 0;
};

}  // namespace

Json quantities_at(const FigureWork& work, const StepCosts& costs, const Values& values) {
  return Quantities(work, costs, values).all();
}

}  // namespace bihive::thesis
