// What the readers of trajectories share: the checks of a frame, and its cell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/trajectory.h"

namespace bihive {

/// The error for a frame that the trajectory does not have.
Error no_such_trajectory_frame(const Trajectory& trajectory, const std::string& path, std::int64_t frame);

/// Why these numbers cannot be places: one is not finite. Nothing: they can.
Status check_places(const TrajectoryFrame& frame, const std::string& path, std::int64_t number);

/// A cell from nine numbers of three vectors, times `unit`; nothing if all are 0 or one is not finite.
std::optional<Cell> cell_of_nine(const double (&v)[9], double unit);

}  // namespace bihive
