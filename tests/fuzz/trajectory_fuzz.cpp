// DCD, XTC, TRR and AMBER's NetCDF from any bytes: a trajectory whose frames agree with it, or an error in one line.
// The bytes are a whole file, so that real trajectories are seeds.
#include <algorithm>
#include <memory>

#include "read_and_check.h"

namespace {

using namespace bihive;
using fuzz::check_error;
using fuzz::require;

// Frames that are read from the front; the last one is read as well.
constexpr std::int64_t kFrames = 6;

void check_frame(const Trajectory& trajectory, std::int64_t number) {
  const Result<TrajectoryFrame> frame = trajectory.read(number);
  if (!frame) return check_error(frame.error());
  const auto atoms = static_cast<std::size_t>(trajectory.sphere_count());
  for (const auto* axis : {&frame->x, &frame->y, &frame->z}) {
    require(axis->size() == atoms);
    for (const double value : *axis) require(std::isfinite(value));
  }
  for (const NamedNumbers& column : frame->numbers) require(column.values.size() == atoms);
  for (const std::string& warning : frame->warnings) require(printable(warning) == warning);
  // The same again: nothing is kept from one frame to the next.
  const Result<TrajectoryFrame> again = trajectory.read(number);
  require(again.ok() && again->x == frame->x && again->y == frame->y && again->z == frame->z);
}

void check(const Result<std::shared_ptr<const Trajectory>>& opened) {
  if (!opened) return check_error(opened.error());
  const Trajectory& trajectory = **opened;
  const std::int64_t count = trajectory.frame_count();
  require(count >= 0 && trajectory.sphere_count() >= 0);
  for (const std::string& warning : trajectory.warnings()) require(printable(warning) == warning);
  for (std::int64_t frame = 0; frame < std::min(count, kFrames); ++frame) check_frame(trajectory, frame);
  if (count > kFrames) check_frame(trajectory, count - 1);
  require(!trajectory.read(count).ok() && !trajectory.read(-1).ok());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto open = [bytes](const TrajectoryFormat& format) {
    check(format.open(RandomFile::of_bytes(bytes, "fuzz"), ""));
  };
  // Faults of libhdf5 are not looked for here. Bytes that no format claims go to DCD: each format takes any bytes.
  for (const TrajectoryFormat* format : trajectory_formats()) {
    const bool is_any = format->name == "DCD" || (format->name == "XTC" && size % 2 == 0);
    const bool is_claimed = std::any_of(trajectory_formats().begin(), trajectory_formats().end(), [&](const auto* one) {
      return one->name != "H5MD" && one->name != "DCD" && one->recognise(bytes);
    });
    if (format->name != "H5MD" && (is_claimed ? format->recognise(bytes) : is_any)) open(*format);
  }
  return 0;
}
