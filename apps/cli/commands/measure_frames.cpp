// bihive measure --frames: a row for each frame.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/job/failure.h"
#include "bihive/job/input.h"
#include "bihive/job/messages.h"
#include "bihive/measure/union_measures.h"
#include "bihive/select/selection.h"
#include "commands/commands.h"
#include "commands/each_frame.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

struct FrameMeasures {
  std::int64_t frame = 0;
  std::optional<double> time_ps;
  std::optional<std::int64_t> step;
  std::int64_t spheres = 0;
  UnionMeasures measures;
  double cavity_volume = 0;
  std::optional<Error> fault;  // why there are none
};

FrameMeasures row_of(std::int64_t frame, const SphereSet& spheres, const MeasureCommandOptions& options, int threads) {
  FrameMeasures row;
  row.frame = frame;
  row.spheres = spheres.size();
  MeasureOptions measure;
  std::vector<std::uint8_t> mask;
  if (!options.select.empty()) {
    Result<std::vector<std::uint8_t>> selected = select_spheres(spheres, options.select);
    if (!selected) {
      row.fault = selected.error();
      return row;
    }
    mask = std::move(*selected);
    row.spheres = std::count(mask.begin(), mask.end(), std::uint8_t{1});
    measure.mask = mask.data();
  }
  measure.probe = options.probe;
  measure.periodic = options.input.reading.has("periodic");
  measure.cavities = true;
  measure.threads = threads;
  Result<UnionMeasures> measures = measure_union(spheres, measure);
  if (!measures) {
    row.fault = measures.error();
    return row;
  }
  for (const Cavity& cavity : measures->cavities) row.cavity_volume += cavity.volume;
  row.measures = std::move(*measures);
  row.measures.sphere_area = {};  // the row has sums alone
  return row;
}

// Calls take() for each frame, in their order.
template <class Take>
void each_row(const MeasureCommandOptions& options, const Take& take) {
  const std::string path = file_of(options.input);
  if (path.empty() || must_be_read_whole(path)) {
    const Input input = load_input(options.input);
    FrameMeasures row = row_of(0, input.scene.spheres, options, static_cast<int>(options.threads));
    row.time_ps = input.time_ps;
    row.step = input.step;
    return take(std::move(row));
  }
  check_input_options(options.input);
  const Result<std::shared_ptr<const Frames>> frames =
      open_frames(options.input.input, options.input.reading.options(), {});
  if (!frames) value_or_fail(Status(frames.error()));
  warn((*frames)->warnings());
  each_frame<FrameMeasures>(
      **frames, "measuring",
      [&](std::int64_t frame, const SphereFile& file) {
        FrameMeasures row = row_of(frame, file.spheres, options, 1);  // each thread has a frame
        row.time_ps = file.time_ps;
        row.step = file.step;
        return row;
      },
      take);
}

ordered_json numbers_of(const FrameMeasures& row, bool periodic) {
  ordered_json numbers{{"spheres", row.spheres},
                       {"area", row.measures.area},
                       {"volume", row.measures.volume},
                       {"components", row.measures.components},
                       {"cavities", row.measures.cavities.size()},
                       {"cavity_volume", row.cavity_volume}};
  if (periodic) {
    numbers["porosity"] = std::isnan(row.measures.porosity) ? ordered_json() : ordered_json(row.measures.porosity);
    numbers["channels"] = row.measures.channels.size();
  }
  return numbers;
}

}  // namespace

void run_measure_frames(const MeasureCommandOptions& options) {
  const bool periodic = options.input.reading.has("periodic");
  std::string csv;
  ordered_json json{{"name", options.input.input},
                    {"probe", options.probe},
                    {"periodic", periodic},
                    {"frames", ordered_json::array()}};
  std::int64_t undecided = 0;
  each_row(options, [&](const FrameMeasures& row) {
    if (row.fault) {
      Error fault = *row.fault;
      fault.message += fmt::format(" (frame {})", row.frame);
      fail(fault);
    }
    undecided += row.measures.undecided_spheres;
    ordered_json numbers{{"frame", row.frame}};
    numbers["time_ps"] = row.time_ps ? ordered_json(*row.time_ps) : ordered_json();
    numbers["step"] = row.step ? ordered_json(*row.step) : ordered_json();
    numbers.update(numbers_of(row, periodic));
    if (options.json) {
      json["frames"].push_back(std::move(numbers));
      return;
    }
    std::string names, values;
    for (const auto& [name, value] : numbers.items()) {
      const char* const comma = names.empty() ? "" : ",";
      names += comma + name;
      values += comma;
      if (value.is_number_float())
        values += fmt::format("{}", value.template get<double>());
      else if (!value.is_null())
        values += value.dump();
    }
    if (csv.empty()) csv = names + "\n";
    csv += values + "\n";
  });
  if (undecided > 0)
    warn("the pieces of " + grouped(undecided) +
         " spheres could not be told apart: cavities and connected parts may be wrong");
  print(options.json ? json.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n" : csv);
}

}  // namespace bihive::cli
