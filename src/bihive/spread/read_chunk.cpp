#include "bihive/spread/read_chunk.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/setting_name.h"
#include "bihive/io/assemble/finish.h"
#include "bihive/io/assemble/unknown_radii.h"
#include "bihive/io/chunk_of_file.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/framing_cell.h"

namespace bihive {
namespace {

struct Counts {
  std::int64_t before = 0, all = 0;
};
Counts sum_over_ranks(std::int64_t count, Communicator& ranks) {
  Counts sum;
  int rank = 0;
  for (const std::int64_t one : ranks.all_gather_value(count)) {
    if (rank++ < ranks.rank()) sum.before += one;
    sum.all += one;
  }
  return sum;
}

// Whether all ranks have the same numbers.
bool are_alike(const std::vector<double>& numbers, Communicator& ranks) {
  const std::vector<std::vector<double>> all = ranks.all_gather_list(numbers);
  return std::all_of(all.begin(), all.end(), [&](const std::vector<double>& one) { return one == all.front(); });
}

// The rows of this rank as stored in the file, which must be the same for all.
Result<RawSpheres> read_rows(const std::string& path, Communicator& ranks) {
  const Result<FileChunk> chunk = open_chunk(path, {ranks.rank(), ranks.size()});
  if (!chunk) return chunk.error();
  if (!are_alike(chunk->facts, ranks))
    return Error{"the ranks see different files of this name", path, 0, 0, "let all ranks see the same folder"};
  const Counts rows = sum_over_ranks(chunk->rows, ranks);
  Result<RawSpheres> spheres = chunk->read(rows.before, rows.all);
  if (!spheres || !chunk->columns_may_differ) return spheres;
  if (!ids_increase(ranks.all_gather_list(ids_of(*spheres))))
    return Error{"chunks of this file can be read only if its rows are in the order of their ids", path, 0, 0,
                 "leave out " + setting_name("distribute") + ", or sort the rows (LAMMPS: dump_modify ID sort id)"};
  const std::optional<double> columns = columns_of(*spheres);
  if (are_alike({columns.value_or(-1)}, ranks) && columns) return spheres;
  return Error{"chunks of this file can be read only if all columns are numbers, and types whole ones", path, 0, 0,
               "leave out " + setting_name("distribute") + ", or convert the file: bihive convert FILE -o set.npy"};
}

// Radii for a set without any: half the lower median of the distances from neighbour to neighbour, on whatever ranks
// they are.
UnknownRadii unknown_radii_of_whole(const RawSpheres& chunk, const std::optional<Cell>& cell, const Counts& spheres,
                                    Communicator& ranks) {
  UnknownRadii whole;
  whole.all = spheres.all;
  whole.unknown = sum_over_ranks(count_unknown_radii(chunk), ranks).all;
  if (whole.unknown == 0) return whole;
  std::vector<Vec3d> origins;
  for (const std::vector<Vec3d>& one : ranks.all_gather_list(search_origins(chunk, spheres.before, spheres.all)))
    origins.insert(origins.end(), one.begin(), one.end());
  std::vector<double> distances = nearest_distances(chunk, cell, origins);
  for (double& distance : distances) distance = -distance;
  ranks.all_reduce_max(distances);
  for (double& distance : distances) distance = -distance;
  whole.radius = radius_from_distances(std::move(distances));
  return whole;
}

// The worst error of all ranks, the first of equal ones.
RoundingLoss loss_of_whole(const RoundingLoss& own, Communicator& ranks) {
  RoundingLoss whole;
  for (const RoundingLoss& one : ranks.all_gather_value(own)) {
    whole.moved += one.moved;
    whole.vanishing += one.vanishing;
    if (one.moved == 0 || !(one.worst_share > whole.worst_share)) continue;
    whole.worst_share = one.worst_share;
    whole.worst_id = one.worst_id;
  }
  return whole;
}

WorldEnds ends_of_whole(const WorldEnds& own, Communicator& ranks) {
  std::vector<double> greatest(own.below.begin(), own.below.end());
  greatest.insert(greatest.end(), own.above.begin(), own.above.end());
  ranks.all_reduce_max(greatest);
  return {{greatest[0], greatest[1], greatest[2]}, {greatest[3], greatest[4], greatest[5]}};
}

SphereSet::Bounds bounds_of_whole(const SphereSet& chunk, Communicator& ranks) {
  const SphereSet::Bounds own = chunk.bounds();
  std::vector<double> ends{-own.lo.x, -own.lo.y, -own.lo.z, own.hi.x, own.hi.y, own.hi.z};
  ranks.all_reduce_max(ends);
  return {{-ends[0], -ends[1], -ends[2]}, {ends[3], ends[4], ends[5]}};
}

}  // namespace

bool can_read_chunks_of(const std::string& path) {
  return can_read_chunks(path);
}

Result<ReadChunk> read_chunk(const std::string& path, const ReadOptions& options, Communicator& ranks) {
  Result<RawSpheres> rows = read_rows(path, ranks);
  if (!rows) return rows.error();
  SphereFinisher steps(std::move(*rows), path, options);
  const Counts spheres = sum_over_ranks(static_cast<std::int64_t>(steps.raw().size()), ranks);
  if (Status status = steps.begin(spheres.before, spheres.all); !status) return status.error();

  // Radii, and the centre.
  if (ranks.all_reduce_max(steps.has_radii() ? 1 : 0) == 0)
    steps.fill_radii(unknown_radii_of_whole(steps.raw(), steps.cell(), spheres, ranks));
  if (Status status = steps.apply_options(); !status) return status.error();
  if (options.recenter) {
    std::array<double, 6> ends = steps.centre_ends();
    std::vector<double> greatest(ends.begin(), ends.end());
    ranks.all_reduce_max(greatest);
    std::copy(greatest.begin(), greatest.end(), ends.begin());
    steps.recenter(ends);
  }

  // Round once, in the units of the whole set and relative to its origin.
  const Result<WorldEnds> own = steps.ends();
  if (!own) return own.error();
  const WorldEnds ends = ends_of_whole(*own, ranks);
  const bool coarse = ranks.all_reduce_max(steps.is_coarse_about_zero(ends) ? 1 : 0) > 0;
  const Result<RoundingLoss> loss = steps.round(ends, coarse ? ends.origin() : Vec3d{});
  if (!loss) return loss.error();
  ReadChunk chunk;
  chunk.file = steps.finish(loss_of_whole(*loss, ranks));
  chunk.whole_count = spheres.all;
  chunk.whole_bounds = bounds_of_whole(chunk.file.spheres, ranks);
  return chunk;
}

void take_whole_range(const SphereSet& chunk, ColourBy& how, Communicator& ranks) {
  if (how.range) return;
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const std::optional<std::pair<double, double>> own = number_range(chunk, how);
  std::vector<double> ends = own ? std::vector<double>{-own->first, own->second} : std::vector<double>{kNone, kNone};
  ranks.all_reduce_max(ends);
  // If the ends are equal, they are so on each rank too, and a stated range needs an extent.
  if (-ends[0] < ends[1]) how.range.emplace(-ends[0], ends[1]);
}

Camera frame_whole_picture(const Scene& chunk, const SphereSet::Bounds& whole, const Side& side, const Lens& lens,
                           const RenderSettings& settings, Communicator& ranks) {
  const std::vector<Vec3d> corners = settings.cell_lines ? cell_corners(chunk.spheres) : std::vector<Vec3d>();
  const auto framed = [&](const Insets& insets) {
    const Framing framing{side, lens, settings.width_px, settings.height_px, insets, middle_of(whole)};
    ViewReach reach = reach_in_view(chunk.spheres, corners, framing);
    std::vector<double> greatest{reach.across_low, reach.across_high, reach.along_low, reach.along_high, reach.left,
                                 reach.right,      reach.below,       reach.above,     reach.front};
    ranks.all_reduce_max(greatest);
    reach = {greatest[0], greatest[1], greatest[2], greatest[3], greatest[4],
             greatest[5], greatest[6], greatest[7], greatest[8]};
    return camera_for(framing, reach);
  };
  const auto covers = [&](const Camera& camera, const CanvasArea& area) {
    return ranks.all_reduce_max(covers_spheres(chunk.spheres, camera, settings, area) ? 1 : 0) > 0;
  };
  return frame_beside_labels(chunk, settings, framed, covers);
}

}  // namespace bihive
