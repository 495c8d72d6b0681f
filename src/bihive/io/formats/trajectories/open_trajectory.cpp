#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/data_path.h"
#include "bihive/io/formats/formats.h"
#include "bihive/io/formats/trajectories/frame_checks.h"
#include "bihive/io/known_formats.h"
#include "bihive/io/packed/unpacked_file.h"
#include "bihive/io/trajectory.h"

namespace bihive {

Result<std::shared_ptr<const Trajectory>> open_trajectory(const std::string& path) {
  constexpr std::int64_t kLook = 128;
  const DataPath named = data_path(path);
  Result<RandomFile> file = open_unpacked(named.file);
  if (!file) return file.error();
  const Result<std::string> first = file->read(0, std::min(kLook, file->size()));
  if (!first) return first.error();
  for (const TrajectoryFormat* format : trajectory_formats())
    if (format->recognise(*first)) return format->open(std::move(*file), named.inside);
  return Error{"this is no trajectory in a known format", path, 0, 0,
               "known are " + names_of_formats(FormatsThat::are_trajectories)};
}

Error no_such_trajectory_frame(const Trajectory& trajectory, const std::string& path, std::int64_t frame) {
  const std::int64_t frames = trajectory.frame_count();
  return {"there is no frame " + std::to_string(frame) + ": the trajectory has " + std::to_string(frames) +
              (frames == 1 ? " frame" : " frames"),
          path, 0, 0, frames > 0 ? "frames count from 0 to " + std::to_string(frames - 1) : ""};
}

Status check_places(const TrajectoryFrame& frame, const std::string& path, std::int64_t number) {
  for (std::size_t i = 0; i < frame.x.size(); ++i)
    if (!std::isfinite(frame.x[i]) || !std::isfinite(frame.y[i]) || !std::isfinite(frame.z[i]))
      return Error{"frame " + std::to_string(number) + ": the place of atom " + std::to_string(i) + " is not finite",
                   path, 0, 0, ""};
  return Done{};
}

std::string cut_tail(std::int64_t frame) {
  return "the file ends inside frame " + std::to_string(frame) + ", which is left out: it may be cut";
}

std::string damaged_tail(std::int64_t frame, std::int64_t place, std::int64_t file_bytes) {
  return "frame " + std::to_string(frame) + " does not begin as a frame at byte " + std::to_string(place) +
         ": the last " + std::to_string(file_bytes - place) + " bytes are left out; the file may be damaged";
}

void take_cell(std::optional<Cell> cell, std::span<const double> lengths, std::int64_t number, TrajectoryFrame& frame) {
  frame.cell = std::move(cell);
  if (frame.cell || std::all_of(lengths.begin(), lengths.end(), [](double n) { return n == 0; })) return;
  frame.warnings.push_back(unreadable_cell(number));
}

std::optional<Cell> cell_of_nine(const double (&v)[9], double unit) {
  if (!std::all_of(std::begin(v), std::end(v), [](double n) { return std::isfinite(n); })) return std::nullopt;
  if (std::all_of(std::begin(v), std::end(v), [](double n) { return n == 0; })) return std::nullopt;
  Cell cell;
  for (int k = 0; k < 3; ++k)
    cell.vectors[static_cast<std::size_t>(k)] = unit * Vec3d{v[3 * k], v[3 * k + 1], v[3 * k + 2]};
  return cell;
}

}  // namespace bihive
