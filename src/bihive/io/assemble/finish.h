// The part that all readers share: from a file's numbers to a sphere set.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/geometry/rounding_loss.h"
#include "bihive/io/assemble/unknown_radii.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Gives radii to spheres without radii (io/assemble/unknown_radii.h), applies the options, and rounds once. `name` is
/// the file's, for messages. Errors: no spheres, unless the set may be empty; a number that is not finite, out of
/// range, or a negative radius. `origin_of_first_frame`: of another frame of the file, called if this one needs an
/// origin.
Result<SphereFile> finish_spheres(RawSpheres raw, const std::string& name, const ReadOptions& options,
                                  bool may_be_empty = false, const std::function<Vec3d()>& origin_of_first_frame = {});

/// The steps of finish_spheres(), in this order, for a chunk of a set that several processes read: what a step must
/// know of the whole set is handed in. `first`, `all`: the spheres of the chunks before, and of all.
class SphereFinisher {
 public:
  SphereFinisher(RawSpheres raw, std::string name, const ReadOptions& options);

  /// The cell as the options want it.
  std::optional<Cell> cell() const;
  /// Gone after finish().
  const RawSpheres& raw() const { return raw_; }
  /// Error: the whole set has no spheres.
  Status begin(std::int64_t first, std::int64_t all);
  /// Else fill_radii() must find them. A chunk without spheres cannot tell.
  bool has_radii() const { return options_.radius.has_value() || !raw_.r.empty(); }
  void fill_radii(const UnknownRadii& whole) { bihive::fill_radii(raw_, whole); }
  /// The options of radii and of the cell.
  Status apply_options();
  /// The negative of the smallest, and the greatest coordinate of centres, axis by axis; -inf without spheres.
  std::array<double, 6> centre_ends() const;
  void recenter(const std::array<double, 6>& ends_of_whole);
  Result<WorldEnds> ends() const;
  bool is_coarse_about_zero(const WorldEnds& ends_of_whole) const;
  /// `ends_of_whole`: the maximum of ends() of all chunks. `origin`: theirs if some chunk is coarse about 0, else 0.
  /// Returns the chunk's loss.
  Result<RoundingLoss> round(const WorldEnds& ends_of_whole, Vec3d origin);
  /// At most once.
  SphereFile finish(const RoundingLoss& of_whole);

 private:
  Error named(Error error) const;

  RawSpheres raw_;
  std::string name_;
  const ReadOptions& options_;
  std::int64_t first_ = 0, all_ = 0;
  Images images_;
  Vec3d recentred_by_;
  SphereSet set_;
};

}  // namespace bihive
