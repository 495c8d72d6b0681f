// Frames and trajectories of files that hold arrays: H5MD, AMBER's NetCDF, and any data sets of HDF5.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/chunk.h"
#include "bihive/io/column_choice.h"
#include "bihive/io/frames/raw_frames.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/trajectory.h"

namespace bihive {

/// The frames of an HDF5 or NetCDF file. `inside`: a group or a data set of HDF5; empty: what the file has. Errors: no
/// such data set; none that could be places; places without anything else of the atoms (AMBER).
Result<std::shared_ptr<const RawFrames>> open_array_frames(RandomFile file, const std::string& inside,
                                                           const ColumnChoice& choice);

/// The number of particles of a file of which chunks can be read: H5MD, with no column that needs all rows
/// (io/text/sphere_table.h). Nothing: they cannot.
std::optional<std::int64_t> particles_in_chunks(RandomFile file);
/// The particles of a chunk in frame 0 of such a file.
Result<RawSpheres> chunk_of_arrays(RandomFile file, RowChunk chunk);

/// Its places as a trajectory: H5MD, AMBER's NetCDF.
Result<std::shared_ptr<const Trajectory>> open_array_trajectory(RandomFile file, const std::string& inside);

}  // namespace bihive
