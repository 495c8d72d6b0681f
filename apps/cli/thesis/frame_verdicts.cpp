#include "thesis/frame_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "bihive/thesis/frame_rates_report.h"

namespace bihive::cli::thesis {
namespace {

// A speed-up (1 + gain / 100) agrees within this factor, because processor and code are others.
constexpr double kSpeedUpFactor = 2;
// A step of a curve over MAX_PRIMS of less than this counts as none: nobody sees it in a chart.
constexpr double kLeastStep = 0.01;

const char* const kGains = "Gains over brute force";
const char* const kWinners = "Which MAX_PRIMS wins where";
const char* const kCurves = "The curve over MAX_PRIMS";
const char* const kExtremes = "The best and the worst";

using Rounds = std::vector<double>;

std::size_t common_size(const Rounds& a, const Rounds& b) {
  return std::min(a.size(), b.size());
}

// Percent by which the tree is faster than brute force, round by round.
Rounds gains_of(const Rounds& tree, const Rounds& brute) {
  Rounds gains;
  for (std::size_t i = 0; i < common_size(tree, brute); ++i) gains.push_back(100 * (brute[i] / tree[i] - 1));
  return gains;
}

Rounds difference(const Rounds& a, const Rounds& b) {
  Rounds differences;
  for (std::size_t i = 0; i < common_size(a, b); ++i) differences.push_back(a[i] - b[i]);
  return differences;
}

std::string percent_text(const Quartiles& gain) {
  return fmt::format("{:+.0f} % ({:+.0f} to {:+.0f})", gain.median, gain.lower, gain.upper);
}

// Agrees if what is stated is the only possible answer; differs if it is none of them.
template <class T>
Verdict verdict_among(const std::set<T>& possible, const std::set<T>& stated) {
  const bool any = std::any_of(possible.begin(), possible.end(), [&](const T& one) { return stated.count(one) > 0; });
  const bool only = std::all_of(possible.begin(), possible.end(), [&](const T& one) { return stated.count(one) > 0; });
  return !any ? Verdict::differs : only ? Verdict::agrees : Verdict::undecided;
}

class Judge {
 public:
  Judge(const EngineTimes& times, const Values& values)
      : times_(times),
        values_(values),
        scenarios_(values.integers("scenarios")),
        counts_(values.integers("spheres_list")),
        max_prims_(values.integers("max_prims_list")) {}

  std::vector<Judgement> all() {
    gains();
    winners();
    curves();
    extremes();
    return std::move(rows_);
  }

 private:
  using Key = std::pair<std::int64_t, std::int64_t>;

  bool complete() const { return times_.size() == scenarios_.size() * counts_.size(); }

  void add(const char* table, const std::string& name, const std::string& statement, const Expected& expected,
           const std::string& ours, Verdict verdict) {
    rows_.push_back({table, name, statement, expected, ours, verdict});
  }

  // The fastest of these trees, and all that may be as fast: their quartiles do not lie below its own.
  struct Best {
    std::int64_t max_prims = 0;
    std::set<std::int64_t> possible;
  };
  static Best best_of(const ConfigurationTimes& times, const std::function<bool(std::int64_t)>& counts) {
    Best best{fastest_tree(times, counts), {}};
    for (const auto& [prims, ms] : times.trees)
      if (counts(prims) && (prims == best.max_prims || times_as_fast(times.trees.at(best.max_prims), ms).lower <= 1))
        best.possible.insert(prims);
    return best;
  }
  // Among the thesis's values of MAX_PRIMS.
  Best best_of(const ConfigurationTimes& times) const {
    return best_of(times, [this](std::int64_t prims) {
      return std::find(max_prims_.begin(), max_prims_.end(), prims) != max_prims_.end();
    });
  }
  Rounds best_gains(const Key& key) const {
    const ConfigurationTimes& times = times_.at(key);
    return gains_of(times.trees.at(best_of(times).max_prims), times.brute);
  }

  static std::string names_of(const std::set<std::int64_t>& possible) {
    std::vector<std::string> names;
    names.reserve(possible.size());
    for (const std::int64_t prims : possible) names.push_back(tree_name(prims));
    return fmt::format("{}", fmt::join(names, " or "));
  }

  void gains() {
    std::map<std::int64_t, Rounds> means;
    std::map<std::int64_t, Rounds> best_of_scenario;
    for (const std::int64_t scenario : scenarios_) {
      // The gains of all numbers of spheres, and their mean, round by round.
      std::map<std::int64_t, Rounds> by_count;
      for (const std::int64_t count : counts_)
        if (times_.count({scenario, count}) > 0) by_count[count] = best_gains({scenario, count});
      if (by_count.size() != counts_.size()) continue;
      Rounds& mean = means[scenario];
      for (const auto& [count, rounds] : by_count) {
        if (mean.empty()) mean.assign(rounds.size(), 0);
        mean.resize(common_size(mean, rounds));
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += rounds[i] / static_cast<double>(counts_.size());
      }

      const std::string prefix = fmt::format("scenario{}.gain_percent", scenario);
      best_of_scenario[scenario] = extreme_gain(scenario, by_count, prefix + ".best", "most", true);
      extreme_gain(scenario, by_count, prefix + ".least", "least", false);
      if (values_.has(prefix + ".mean"))
        stated_gain(prefix + ".mean", fmt::format("Scenario {}, mean", scenario), quartiles_of(mean));
    }
    if (means.size() != scenarios_.size()) return;
    most_advantageous(means);

    const std::vector<double> pair = values_.numbers("mean_exceeds_best.scenarios");
    const auto above = static_cast<std::int64_t>(pair.front()), below = static_cast<std::int64_t>(pair.back());
    if (means.count(above) == 0 || best_of_scenario.count(below) == 0) return;
    const Rounds ahead = difference(means[above], best_of_scenario[below]);
    add(kGains, "mean_exceeds_best",
        fmt::format("The mean of Scenario {} is higher than the most of Scenario {}", above, below), "higher",
        fmt::format("{:+.0f} % and {:+.0f} %, round by round {} points ahead", quartiles_of(means[above]).median,
                    quartiles_of(best_of_scenario[below]).median, quartiles_text(quartiles_of(ahead), 0)),
        verdict_above(quartiles_of(ahead), 0));
  }

  // A stated gain beside ours.
  void stated_gain(const std::string& name, const std::string& statement, const Quartiles& gain) {
    const double stated = 1 + values_.number(name) / 100;
    const Quartiles speed_up{1 + gain.lower / 100, 1 + gain.median / 100, 1 + gain.upper / 100};
    // The percentage is the text's, how near is near enough is not.
    const std::string expected = fmt::format("{}, within a factor of {}", values_.printed(name), kSpeedUpFactor);
    add(kGains, name, statement, {expected, ValueKind::inferred}, percent_text(gain),
        verdict_between(speed_up, stated / kSpeedUpFactor, stated * kSpeedUpFactor));
  }

  // The largest or smallest gain of a scenario, and which configuration has it. Returns its rounds.
  Rounds extreme_gain(std::int64_t scenario, const std::map<std::int64_t, Rounds>& by_count, const std::string& name,
                      const std::string& what, bool most) {
    auto found = by_count.begin();
    for (auto each = by_count.begin(); each != by_count.end(); ++each)
      if (most ? median(each->second) > median(found->second) : median(each->second) < median(found->second))
        found = each;
    const std::string statement = fmt::format("Scenario {}, {}", scenario, what);
    if (values_.has(name)) stated_gain(name, statement, quartiles_of(found->second));
    if (values_.has(name + ".max_prims")) {
      // Every number of spheres whose quartiles reach those of the extreme one, with every tree that may be the best.
      std::set<Key> possible;
      const Quartiles extreme = quartiles_of(found->second);
      for (const auto& [count, rounds] : by_count) {
        const Quartiles other = quartiles_of(rounds);
        if (most ? other.upper < extreme.lower : other.lower > extreme.upper) continue;
        for (const std::int64_t prims : best_of(times_.at({scenario, count})).possible) possible.insert({prims, count});
      }
      const auto text = [](const Key& key) { return fmt::format("{}, {} spheres", tree_name(key.first), key.second); };
      std::vector<std::string> ours;
      ours.reserve(possible.size());
      for (const Key& key : possible) ours.push_back(text(key));
      const Key stated{values_.integer(name + ".max_prims"), values_.integer(name + ".spheres")};
      add(kGains, name + ".which", statement + ": which", text(stated), fmt::format("{}", fmt::join(ours, "; or ")),
          verdict_among(possible, {stated}));
    }
    return found->second;
  }

  void most_advantageous(const std::map<std::int64_t, Rounds>& means) {
    const std::int64_t stated = values_.integer("most_advantageous.scenario");
    std::set<std::int64_t> possible;
    std::vector<std::string> ours;
    for (const auto& [scenario, rounds] : means) {
      // Possible, unless another scenario is surely ahead.
      const bool behind = std::any_of(means.begin(), means.end(), [&, &mine = rounds](const auto& other) {
        return quartiles_of(difference(other.second, mine)).lower > 0;
      });
      if (!behind) possible.insert(scenario);
      ours.push_back(fmt::format("Scenario {} {:+.0f} %", scenario, quartiles_of(rounds).median));
    }
    add(kGains, "most_advantageous", "The scenario with the highest mean gain", fmt::format("Scenario {}", stated),
        fmt::format("{}", fmt::join(ours, ", ")), verdict_among(possible, {stated}));
  }

  void winners() {
    if (!complete()) return;
    const std::int64_t winner = values_.integer("winner.max_prims"), stated = values_.integer("winner.wins");
    std::int64_t sure = 0, possible = 0;
    for (const auto& [key, times] : times_) {
      const Best best = best_of(times);
      if (best.possible.count(winner) == 0) continue;
      ++possible;
      if (best.possible.size() == 1) ++sure;
    }
    const auto all = static_cast<std::int64_t>(times_.size());
    const bool same_number = all == values_.integer("winner.configurations");
    Verdict verdict = Verdict::undecided;
    if (!same_number || stated < sure || stated > possible) verdict = Verdict::differs;
    if (same_number && stated == sure && stated == possible) verdict = Verdict::agrees;
    add(kWinners, "winner", fmt::format("{} is the best", tree_name(winner)),
        fmt::format("in {} of {}", stated, values_.integer("winner.configurations")),
        sure == possible ? fmt::format("in {} of {}", sure, all)
                         : fmt::format("surely in {}, perhaps in {} of {}", sure, possible, all),
        verdict);
  }

  // The shapes of a curve over MAX_PRIMS. A step counts where its quartiles lie beyond kLeastStep.
  enum class Shape { rises, peaks, falls };
  static std::set<Shape> shapes_of(const std::vector<const Rounds*>& curve) {
    std::set<Shape> possible;
    const auto rises = [&](std::size_t a, std::size_t b) {
      return times_as_fast(*curve[b], *curve[a]).lower > 1 + kLeastStep;
    };
    const auto falls = [&](std::size_t a, std::size_t b) {
      return times_as_fast(*curve[b], *curve[a]).upper < 1 / (1 + kLeastStep);
    };
    const std::size_t last = curve.size() - 1;
    for (std::size_t peak = 0; peak <= last; ++peak) {
      // Nothing falls before the peak, and nothing rises behind it.
      bool fits = true;
      for (std::size_t i = 0; i < last; ++i) fits = fits && !(i < peak ? falls(i, i + 1) : rises(i, i + 1));
      if (falls(0, peak) || rises(peak, last)) fits = false;
      if (fits) possible.insert(peak == 0 ? Shape::falls : peak == last ? Shape::rises : Shape::peaks);
    }
    return possible;
  }
  static const char* text_of(Shape shape) {
    return shape == Shape::rises ? "only rises" : shape == Shape::falls ? "only falls" : "rises, peaks, falls";
  }

  void curves() {
    for (const auto& [key, times] : times_) {
      const bool only_rises = key == Key{values_.integer("only_rises.scenario"), values_.integer("only_rises.spheres")};
      std::vector<const Rounds*> curve;
      std::string rates;
      for (const std::int64_t prims : max_prims_) {
        curve.push_back(&times.trees.at(prims));
        rates += (rates.empty() ? "" : " ") + fmt::format("{:.1f}", fps_quartiles(*curve.back()).median);
      }
      const std::set<Shape> shapes = shapes_of(curve);
      const Shape stated = only_rises ? Shape::rises : Shape::peaks;
      std::vector<std::string> names;
      names.reserve(shapes.size());
      for (const Shape shape : shapes) names.emplace_back(text_of(shape));
      const std::string ours = names.empty() ? "up and down" : fmt::format("{}", fmt::join(names, " or "));
      add(kCurves, fmt::format("curve.scenario{}.spheres{}", key.first, key.second),
          fmt::format("Scenario {}, {} spheres", key.first, key.second), text_of(stated),
          fmt::format("{} ({} fps)", ours, rates), verdict_among(shapes, {stated}));
      if (only_rises) sweet_spot(times);
    }
    convergence();
    worse_than_none();
  }

  // "great possibility exists that BIH 16 actually represents the sweet spot": among all values up to n.
  void sweet_spot(const ConfigurationTimes& times) {
    if (times.trees.size() <= max_prims_.size()) return;
    const Best best = best_of(times, [](std::int64_t) { return true; });
    const std::int64_t stated = values_.integer("sweet_spot.max_prims");
    add(kCurves, "sweet_spot", "There, of all values up to the number of spheres, the best is",
        "perhaps " + tree_name(stated), names_of(best.possible), verdict_among(best.possible, {stated}));
  }

  // "finally decays and converges to the performance of BF approach": the tree of one leaf beside brute force.
  void convergence() {
    const std::vector<double> range = values_.numbers("converges.ratio");
    Verdict verdict = Verdict::agrees;
    double low = 1e300, high = 0;
    for (const auto& [key, times] : times_) {
      const auto leaf = times.trees.find(key.second);
      if (leaf == times.trees.end() || range.size() != 2) return;
      const Quartiles ratio = times_as_fast(leaf->second, times.brute);
      low = std::min(low, ratio.median);
      high = std::max(high, ratio.median);
      const Verdict one = verdict_between(ratio, range[0], range[1]);
      if (one == Verdict::differs || verdict == Verdict::agrees) verdict = one;
    }
    if (high > 0)
      add(kCurves, "converges", "With MAX_PRIMS = n, one leaf, the tree is as fast as brute force",
          {fmt::format("{} to {} times", range[0], range[1]), ValueKind::inferred},
          fmt::format("{:.2f} to {:.2f} times in the configurations", low, high), verdict);
  }

  // "one might even experience performance that is worse than if compared to not using the data structure": the slowest
  // tree of any MAX_PRIMS beside brute force.
  void worse_than_none() {
    if (!complete()) return;
    std::optional<Quartiles> slowest;
    std::string which;
    bool undecided = false, worse = false;
    for (const auto& [key, times] : times_)
      for (const auto& [prims, ms] : times.trees) {
        const Quartiles ratio = times_as_fast(ms, times.brute);
        worse = worse || ratio.upper < 1;
        undecided = undecided || ratio.lower <= 1;
        if (slowest && ratio.median >= slowest->median) continue;
        slowest = ratio;
        which = fmt::format("{}, {} spheres, Scenario {}", tree_name(prims), key.second, key.first);
      }
    if (!slowest) return;
    add(kCurves, "worse_than_none", "With some MAX_PRIMS a tree is slower than brute force",
        {"slower, somewhere", ValueKind::inferred},
        fmt::format("at least {} times as fast: {}", quartiles_text(*slowest, 2), which),
        worse       ? Verdict::agrees
        : undecided ? Verdict::undecided
                    : Verdict::differs);
  }

  void extremes() {
    if (!complete()) return;
    using Contestant = std::pair<std::int64_t, Key>;  // MAX_PRIMS, or 0: brute force
    std::map<Contestant, Quartiles> all;
    for (const auto& [key, times] : times_) {
      all[{0, key}] = fps_quartiles(times.brute);
      for (const std::int64_t prims : max_prims_) all[{prims, key}] = fps_quartiles(times.trees.at(prims));
    }
    const auto slower = [](const auto& a, const auto& b) { return a.second.median < b.second.median; };
    const auto text = [](const Contestant& of) {
      return fmt::format("{}, {} spheres, Scenario {}", of.first == 0 ? "BF" : tree_name(of.first), of.second.second,
                         of.second.first);
    };
    const auto list = [&](const std::set<Contestant>& possible) {
      std::vector<std::string> names;
      names.reserve(possible.size());
      for (const Contestant& one : possible) names.push_back(text(one));
      return names.size() > 3 ? fmt::format("one of {} whose quartiles overlap", names.size())
                              : fmt::format("{}", fmt::join(names, "; or "));
    };

    // The best: what the text says, or what it supposes to be really better without the display's limit.
    const auto best = std::max_element(all.begin(), all.end(), slower);
    std::set<Contestant> possible, stated;
    for (const auto& [contestant, fps] : all)
      if (fps.upper >= best->second.lower) possible.insert(contestant);
    for (const std::string name : {"best", "supposed_best"})
      stated.insert({values_.integer(name + ".max_prims"),
                     {values_.integer(name + ".scenario"), values_.integer(name + ".spheres")}});
    std::vector<std::string> names;
    names.reserve(stated.size());
    for (const Contestant& one : stated) names.push_back(text(one));
    add(kExtremes, "best", "The best of all", fmt::format("{}", fmt::join(names, ", or without the display's limit ")),
        list(possible), verdict_among(possible, stated));

    // Without a display: is the one faster that the text supposes to be?
    const auto rates_of = [&](const std::string& name) {
      return all.find({values_.integer(name + ".max_prims"),
                       {values_.integer(name + ".scenario"), values_.integer(name + ".spheres")}});
    };
    const auto shown = rates_of("best"), supposed = rates_of("supposed_best");
    if (shown != all.end() && supposed != all.end())
      add(kExtremes, "beyond_the_display", text(supposed->first) + " is faster than " + text(shown->first),
          {"perhaps", ValueKind::inferred},
          fmt::format("{} and {} fps", quartiles_text(supposed->second, 1), quartiles_text(shown->second, 1)),
          supposed->second.lower > shown->second.upper   ? Verdict::agrees
          : supposed->second.upper < shown->second.lower ? Verdict::differs
                                                         : Verdict::undecided);

    const auto worst = std::min_element(all.begin(), all.end(), slower);
    possible.clear();
    stated.clear();
    for (const auto& [contestant, fps] : all)
      if (fps.lower <= worst->second.upper) possible.insert(contestant);
    for (const std::int64_t scenario : scenarios_) stated.insert({0, {scenario, values_.integer("worst.spheres")}});
    add(kExtremes, "worst", "The worst of all", fmt::format("BF, {} spheres", values_.integer("worst.spheres")),
        list(possible), verdict_among(possible, stated));
  }

  const EngineTimes& times_;
  const Values& values_;
  std::vector<std::int64_t> scenarios_, counts_, max_prims_;
  std::vector<Judgement> rows_;
};

}  // namespace

std::int64_t fastest_tree(const ConfigurationTimes& times, const std::function<bool(std::int64_t)>& takes_part) {
  std::int64_t fastest = 0;
  for (const auto& [prims, ms] : times.trees) {
    if (takes_part != nullptr && !takes_part(prims)) continue;
    if (fastest == 0 || median(ms) < median(times.trees.at(fastest))) fastest = prims;
  }
  return fastest;
}

EngineTimes capped(EngineTimes times, double fps) {
  const auto cap = [fps](Rounds& rounds) {
    for (double& ms : rounds) ms = std::max(ms, 1000 / fps);
  };
  for (auto& [key, of_configuration] : times) {
    cap(of_configuration.brute);
    for (auto& [prims, rounds] : of_configuration.trees) cap(rounds);
  }
  return times;
}

Quartiles fps_quartiles(const std::vector<double>& frame_ms) {
  const Quartiles ms = quartiles_of(frame_ms);
  return {1000 / ms.upper, 1000 / ms.median, 1000 / ms.lower};
}

Quartiles times_as_fast(const std::vector<double>& one, const std::vector<double>& other) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < common_size(one, other); ++i) ratios.push_back(other[i] / one[i]);
  return quartiles_of(ratios);
}

std::vector<Judgement> judge_frame_rates(const EngineTimes& times, const Values& values) {
  return Judge(times, values).all();
}

std::vector<std::pair<std::string, std::string>> judgement_tables() {
  return {
      {kGains, fmt::format("The gain is the frame rate of the best tree with one of the thesis's MAX_PRIMS over brute "
                           "force's, less 1: the median over the rounds, and the quartiles. The percentages are the "
                           "text's. That the speed-up (1 + gain / 100) should lie within a factor of {} of them on "
                           "another processor with another program is our inference. \"Which\" agrees if no other "
                           "configuration's quartiles reach as far.",
                           kSpeedUpFactor)},
      {kWinners,
       "A tree wins where no other tree's quartiles of the ratio to it reach 1. Agrees only if the number of wins is "
       "the same; undecided if it may be."},
      {kCurves,
       fmt::format(
           "From the smallest MAX_PRIMS to the largest. A step counts as up or down where both quartiles of its "
           "ratio lie beyond {:.0f} %, a limit that is ours; a shape is possible where no step contradicts it, "
           "and agrees where no other shape is.",
           100 * kLeastStep)},
      {kExtremes, "Undecided where the quartiles of others overlap those of what the text names."}};
}

}  // namespace bihive::cli::thesis
