// What the readers of trajectories share: the checks of a frame, and its cell.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/trajectory.h"

namespace bihive {

/// The error for a frame that the trajectory does not have.
Error no_such_trajectory_frame(const Trajectory& trajectory, const std::string& path, std::int64_t frame);

/// Why these numbers cannot be places: one is not finite. Nothing: they can.
Status check_places(const TrajectoryFrame& frame, const std::string& path, std::int64_t number);

/// Remarks on what follows the whole frames: one that is cut, and bytes from `place` on that begin no frame.
std::string cut_tail(std::int64_t frame);
std::string damaged_tail(std::int64_t frame, std::int64_t place, std::int64_t file_bytes);

/// Gives the frame the cell that it states. Where its numbers make none, a warning says it, unless all `lengths` are 0,
/// as they are where there is no cell.
void take_cell(std::optional<Cell> cell, std::span<const double> lengths, std::int64_t number, TrajectoryFrame& frame);

/// A cell from nine numbers of three vectors, times `unit`; nothing if all are 0 or one is not finite.
std::optional<Cell> cell_of_nine(const double (&v)[9], double unit);

}  // namespace bihive
