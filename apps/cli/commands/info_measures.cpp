// bihive info --distance, --angle, --dihedral: measures of spheres in all frames.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/parse_number.h"
#include "bihive/geometry/measures.h"
#include "bihive/job/messages.h"
#include "commands/commands.h"
#include "commands/each_frame.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Measure {
  std::string name;                   // "distance_0_5"
  std::array<std::int64_t, 4> ids{};  // `count` of them
  std::size_t count = 0;
};

// The measures of one frame.
struct Row {
  std::int64_t frame = 0;
  std::optional<double> time_ps;
  std::optional<std::int64_t> step;
  std::vector<double> values;
  std::string fault;  // why there are none
};

void add_measures(std::vector<Measure>& measures, const std::string& kind, std::size_t count,
                  const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    Measure made;
    made.name = kind;
    std::string rest = text + ",";
    while (!rest.empty()) {
      const std::size_t comma = rest.find(',');
      const auto id = parse_int(std::string_view(rest).substr(0, comma));
      if (!id || *id < 0 || made.count == count) {
        made.count = 0;
        break;
      }
      made.ids[made.count++] = *id;
      made.name += "_" + std::to_string(*id);
      rest = rest.substr(comma + 1);
    }
    if (made.count != count)
      fail_usage(fmt::format("--{}: expected {} positions of spheres between commas, counting from 0, found \"{}\"",
                             kind, count, escaped(text)),
                 "bihive select tells the positions: bihive select INPUT 'resid 25 and name CA'");
    measures.push_back(made);
  }
}

Row row_of(std::int64_t frame, const SphereSet& spheres, const std::vector<Measure>& measures) {
  Row row;
  row.frame = frame;
  const std::optional<Lattice> lattice = Lattice::of(spheres.cell());
  for (const Measure& measure : measures) {
    for (std::size_t i = 0; i < measure.count; ++i)
      if (measure.ids[i] >= spheres.size())
        row.fault = fmt::format("frame {} has {} sphere{}, from 0: there is no sphere {}", frame, spheres.size(),
                                spheres.size() == 1 ? "" : "s", measure.ids[i]);
    if (!row.fault.empty()) return row;
    row.values.push_back(measured(spheres, {measure.ids.data(), measure.count}, lattice));
  }
  return row;
}

std::vector<Row> rows_of(const InfoOptions& options, const std::vector<Measure>& measures) {
  std::vector<Row> rows;
  const std::string path = file_of(options.input);
  if (path.empty() || must_be_read_whole(path) || options.input.reading.has("frame")) {
    const Input input = load_input(options.input);
    const ReadOptions reading = options.input.reading.options();
    Row row = row_of(reading.frame < 0 ? reading.frame + input.frames : reading.frame, input.scene.spheres, measures);
    row.time_ps = input.time_ps;
    row.step = input.step;
    rows.push_back(std::move(row));
    return rows;
  }
  check_input_options(options.input);
  const Result<std::shared_ptr<const Frames>> frames =
      open_frames(options.input.input, options.input.reading.options(), {.keep_index = options.keep_index});
  if (!frames) value_or_fail(Status(frames.error()));
  warn((*frames)->warnings());
  each_frame<Row>(
      **frames, "measuring",
      [&measures](std::int64_t frame, const SphereFile& file) {
        Row row = row_of(frame, file.spheres, measures);
        row.time_ps = file.time_ps;
        row.step = file.step;
        return row;
      },
      [&rows](Row row) { rows.push_back(std::move(row)); });
  return rows;
}

std::string csv_of(const std::vector<Measure>& measures, const std::vector<Row>& rows) {
  std::string text = "frame,time_ps,step";
  for (const Measure& measure : measures) text += "," + measure.name;
  text += "\n";
  for (const Row& row : rows) {
    text += fmt::format("{},{},{}", row.frame, row.time_ps ? fmt::format("{}", *row.time_ps) : "",
                        row.step ? fmt::format("{}", *row.step) : "");
    for (const double value : row.values) text += std::isnan(value) ? ",nan" : fmt::format(",{:.9g}", value);
    text += "\n";
  }
  return text;
}

std::string json_of(const std::string& name, const std::vector<Measure>& measures, const std::vector<Row>& rows) {
  ordered_json json{{"name", name}, {"frames", ordered_json::array()}};
  for (const Row& row : rows) {
    ordered_json frame{{"frame", row.frame}};
    frame["time_ps"] = row.time_ps ? ordered_json(*row.time_ps) : ordered_json();
    frame["step"] = row.step ? ordered_json(*row.step) : ordered_json();
    for (std::size_t i = 0; i < measures.size(); ++i)
      frame[measures[i].name] = std::isnan(row.values[i]) ? ordered_json() : ordered_json(row.values[i]);
    json["frames"].push_back(std::move(frame));
  }
  return json.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

void run_info_of_measures(const InfoOptions& options) {
  std::vector<Measure> measures;
  add_measures(measures, "distance", 2, options.distances);
  add_measures(measures, "angle", 3, options.angles);
  add_measures(measures, "dihedral", 4, options.dihedrals);
  const std::vector<Row> rows = rows_of(options, measures);
  for (const Row& row : rows)
    if (!row.fault.empty()) fail({row.fault, options.input.input, 0, 0, ""});
  print(options.json ? json_of(options.input.input, measures, rows) : csv_of(measures, rows));
}

}  // namespace bihive::cli
