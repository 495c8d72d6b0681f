// Frames and trajectories of files that hold arrays: H5MD, AMBER's NetCDF, and any data sets of HDF5.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/geometry/set_parts.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/frames/raw_frames.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/trajectory.h"

namespace bihive {

/// The frames of an HDF5 or NetCDF file. `inside`: a group or a data set of HDF5; empty: what the file has. Errors: no
/// such data set; none that could be places; places without anything else of the atoms (AMBER).
Result<std::shared_ptr<const RawFrames>> open_array_frames(RandomFile file, const std::string& inside,
                                                           const ColumnChoice& choice);

/// Whether parts of its particles can be read: H5MD, with no column that needs all rows (io/text/sphere_table.h).
/// Returns how many particles there are; nothing: they cannot.
std::optional<std::int64_t> particles_in_parts(RandomFile file);
/// The particles of this process in frame 0 of such a file.
Result<RawSpheres> part_of_arrays(RandomFile file, const SetParts& parts);

/// Its places as a trajectory: H5MD, AMBER's NetCDF.
Result<std::shared_ptr<const Trajectory>> open_array_trajectory(RandomFile file, const std::string& inside);

}  // namespace bihive
