// What the lost bars of Figure 4.4 must have been, by arithmetic on the text's own numbers; and what its display's
// limit of frames a second would do to our rows.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "thesis/figure_4_4.h"
#include "thesis/frame_verdicts.h"

namespace bihive::cli::thesis {
namespace {

std::string two(double value) {
  return fmt::format("{:.2f}", value);
}

// One line of arithmetic.
class Arithmetic {
 public:
  explicit Arithmetic(Section& part) : part_(part) {
    table_.title = "The arithmetic";
    table_.columns = {"What", "From", "Result"};
  }
  void add(const std::string& what, const std::string& from, const std::string& result) {
    table_.rows.push_back({{what}, {from}, {result}});
    data_.push_back({{"what", what}, {"from", from}, {"result", result}});
  }
  Json finish(const std::string& note) {
    table_.note = note;
    part_.tables.push_back(std::move(table_));
    return std::move(data_);
  }

 private:
  Section& part_;
  Table table_;
  Json data_ = Json::array();
};

void add_arithmetic(const Values& values, Section& section, Section& part) {
  const double most = values.number("scenario2.gain_percent.best"),
               least = values.number("scenario2.gain_percent.least");
  const double mean = values.number("scenario2.gain_percent.mean"), cap = values.number("display.fps");
  const double most3 = values.number("scenario3.gain_percent.best"),
               least3 = values.number("scenario3.gain_percent.least");
  const double bf128 = values.number("brute.fps.spheres128"), bf256 = values.number("brute.fps.spheres256");
  const auto times = [](double percent) { return 1 + percent / 100; };
  const double third = 3 * mean - most - least, bf64 = cap / times(least);

  Arithmetic rows(part);
  rows.add("Scenario 2, 256 spheres: the gain that is not stated",
           fmt::format("3 x {:.0f} - {:.0f} - {:.0f}, if the mean is that of the three numbers of spheres; each is "
                       "rounded, so by 2.5 more or less",
                       mean, most, least),
           fmt::format("{:.0f} %", third));
  rows.add("Scenario 2, 128 spheres, BIH 16", fmt::format("{} fps x {}", two(bf128), two(times(most))),
           fmt::format("{:.1f} fps", bf128 * times(most)));
  rows.add("Scenario 2, 256 spheres, the best tree", fmt::format("{} fps x {}", two(bf256), two(times(third))),
           fmt::format("{:.1f} fps", bf256 * times(third)));
  rows.add(
      "BF, 64 spheres",
      fmt::format("{:.0f} / {}: the bar of BIH 8 with 64 spheres in Scenario 2 stands at most at the display's {:.0f}",
                  cap, two(times(least)), cap),
      fmt::format("at most {} fps", two(bf64)));
  const double most64 = bf64 * times(most3);
  const bool shown64 = most64 <= cap;
  const std::string others =
      fmt::format("128 ({:.1f} fps) or 256 ({:.1f} fps)", bf128 * times(most3), bf256 * times(most3));
  rows.add("Scenario 3: which number of spheres has the most",
           fmt::format("{} fps x {} = {:.1f} {}", two(bf64), two(times(most3)), most64,
                       shown64 ? "is not more than the display shows, so it may be 64 too"
                               : "would be more than the display shows, so it is not 64 if BF has that rate"),
           shown64 ? fmt::format("64 ({:.1f} fps), {}", most64, others) : others);
  rows.add("Scenario 3: the least", fmt::format("BF x {}, for 64, 128 or 256 spheres", two(times(least3))),
           fmt::format("at most {:.1f}, {:.1f} or {:.1f} fps", bf64 * times(least3), bf128 * times(least3),
                       bf256 * times(least3)));
  rows.add("BF falls from 64 to 128 spheres", fmt::format("{} / {}", two(bf64), two(bf128)),
           fmt::format("to 1/{}", two(bf64 / bf128)));
  rows.add("BF falls from 128 to 256 spheres", fmt::format("{} / {}", two(bf128), two(bf256)),
           fmt::format("to 1/{}", two(bf128 / bf256)));

  rows.add("BF with 128 and 256 spheres, as whole numbers",
           fmt::format("{} and {} fps, rounded as the text says", two(bf128), two(bf256)),
           fmt::format("{:.0f} and {:.0f}{}", bf128, bf256,
                       std::round(bf128) == std::round(bf256) ? ": equal, as in the text's figure"
                                                              : ": not equal, against the text"));

  // A frame that costs a constant and so much a sphere, through both stated rates.
  const double slope = (1000 / bf256 - 1000 / bf128) / 128, constant = 1000 / bf128 - 128 * slope;
  const double line64 = 1000 / (constant + 64 * slope);
  rows.add(
      "BF, 64 spheres, if a frame costs a constant and so much a sphere",
      fmt::format("through {} and {} fps: {:.0f} ms and {:.3f} ms a sphere", two(bf128), two(bf256), constant, slope),
      fmt::format("{} fps", two(line64)));
  rows.add("Then Scenario 2, 64 spheres, BIH 8 shows", fmt::format("{} x {}", two(line64), two(times(least))),
           fmt::format("{:.1f} fps", line64 * times(least)));
  section.data["lost_bars"] = rows.finish(
      "Inferred by us from numbers of the text; none of these results is stated. \"At most\" becomes \"equal\" where "
      "the "
      "bar stood at the limit, as the text supposes.");
  part.paragraphs.push_back(
      fmt::format("The picture of Figure 4.4 is lost to us, but the text's numbers fix some of its bars. Brute force "
                  "tests twice as many "
                  "spheres from 64 to 128 and again from 128 to 256. Its rate falls to 1/{} the first time, if the bar "
                  "of Scenario 2 "
                  "with 64 spheres stood at the display's limit, and to 1/{} the second. A loop over all spheres "
                  "cannot do both: it "
                  "falls by at most 2 each time, and by more the second time than the first, as its constant part "
                  "weighs less. Either "
                  "that bar stood far below the limit, against what the text says of it, or one of the numbers holds "
                  "something else "
                  "than tests of spheres.",
                  two(bf64 / bf128), two(bf128 / bf256)));
  part.paragraphs.push_back(
      fmt::format("What the limit hides: rates of the text end at {:.0f}. The gain of {:.0f} % may be a lower bound, "
                  "and so may the mean "
                  "of {:.0f} %. The {:.0f} % is none: its bar is at {:.1f} fps. \"BIH 8 in 7 of 9\" is not safe either "
                  "where several "
                  "bars reach the limit: there they are equal.",
                  cap, least, mean, most, bf128 * times(most)));
}

std::string short_name(Verdict verdict, ValueKind kind) {
  return verdict == Verdict::none ? "nothing" : words_of(verdict, kind);
}

// Rows that change their verdict where a display stops at `fps`, in the words that the rows themselves have.
std::vector<std::string> changed_by(const EngineTimes& times, double fps, const Values& values, bool of_text) {
  const std::vector<Judgement> before = judge_frame_rates(times, values);
  const std::vector<Judgement> after = judge_frame_rates(capped(times, fps), values);
  std::vector<std::string> changed;
  for (const Judgement& row : before)
    for (const Judgement& other : after)
      if (row.name == other.name && row.verdict != other.verdict) {
        const ValueKind kind = of_text ? row.expected.kind : ValueKind::inferred;
        changed.push_back(fmt::format("{}: {}: \"{}\" becomes \"{}\"", row.table, row.statement,
                                      short_name(row.verdict, kind), short_name(other.verdict, kind)));
      }
  return changed;
}

void add_sensitivity(const SectionContext& context, Section& section, Section& part) {
  const Values& values = context.values;
  Table table{
      "Which of our rows a limit would change", {"Engine", "Limit", "Frames a second", "Rows", "Which"}, {}, ""};
  Json data = Json::array();
  const std::pair<std::int64_t, std::int64_t> place{values.integer("supposed_best.scenario"),
                                                    values.integer("supposed_best.spheres")};
  for (const ComparedEngine& engine : compared_engines()) {
    const EngineTimes times = engine_times(context, engine);
    const auto found = times.find(place);
    if (found == times.end()) continue;
    const double brute = fps_quartiles(found->second.brute).median;
    const std::pair<const char*, double> limits[] = {
        {"the display's", values.number("display.fps")},
        {"as far above our BF with 64 spheres", brute * (1 + values.number("scenario2.gain_percent.least") / 100)}};
    for (const auto& [words, fps] : limits) {
      const std::vector<std::string> changed = changed_by(times, fps, values, is_of_text(engine));
      table.rows.push_back({{engine.name},
                            {words},
                            {fmt::format("{:.1f}", fps)},
                            {std::to_string(changed.size())},
                            {changed.empty() ? "none" : fmt::format("{}", fmt::join(changed, "; "))}});
      data.push_back({{"engine", engine.name}, {"limit", words}, {"fps", fps}, {"changed", changed}});
    }
  }
  if (table.rows.empty()) return;
  table.note = fmt::format(
      "Our frames were drawn without a display. Each row above was judged again as if one stopped at so many frames a "
      "second: at {:.0f}, and where the text's limit stands in relation to its brute force (by the arithmetic above).",
      values.number("display.fps"));
  section.data["cap"] = std::move(data);
  part.tables.push_back(std::move(table));
}

}  // namespace

void add_lost_bars(const SectionContext& context, Section& section) {
  const Values& values = context.values;
  for (const char* const name :
       {"scenario2.gain_percent.best", "scenario2.gain_percent.least", "scenario2.gain_percent.mean",
        "scenario3.gain_percent.best", "scenario3.gain_percent.least", "brute.fps.spheres128", "brute.fps.spheres256"})
    if (!values.has(name)) return;
  Section part;
  part.title = "What the lost bars must have been";
  add_arithmetic(values, section, part);
  add_sensitivity(context, section, part);
  section.parts.push_back(std::move(part));
}

}  // namespace bihive::cli::thesis
