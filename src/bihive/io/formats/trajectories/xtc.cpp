// XTC: frames of GROMACS in XDR's big-endian words [XTC]; places packed (io/formats/trajectories/packed_places.h).
// Lengths in nanometres.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bihive/io/formats/format.h"
#include "bihive/io/formats/trajectories/frame_checks.h"
#include "bihive/io/formats/trajectories/packed_places.h"
#include "bihive/io/packed/byte_reader.h"

namespace bihive {
namespace {

constexpr double kAngstromOfNm = 10;
constexpr std::int32_t kXtcMagic = 1995;
constexpr std::int32_t kXtcMagicOfLarge = 2023;  // the packed bytes are counted in 64 bits
// Magic, atoms, step, time, nine numbers of the cell, atoms again.
constexpr std::int64_t kXtcHeadBytes = 56;
// Precision, lowest, highest, small size; then the number of packed bytes.
constexpr std::int64_t kPackedHeadBytes = 32;

struct FrameHead {
  std::int32_t magic = 0, atoms = 0, step = 0;
  float time = 0;
  double cell[9] = {};

  // The number of atoms stands there twice; false if the two differ, or there are too few bytes.
  bool take(ByteReader& reader) {
    std::int32_t again = 0;
    bool all = reader.take(magic) && reader.take(atoms) && reader.take(step) && reader.take(time);
    for (double& number : cell) {
      float stored = 0;
      all = all && reader.take(stored);
      number = double(stored);
    }
    return all && reader.take(again) && again == atoms && atoms >= 0;
  }
  bool is_packed() const { return atoms > kUnpacked; }
  std::int64_t count_bytes() const { return magic == kXtcMagicOfLarge ? 8 : 4; }
};

class XtcTrajectory : public Trajectory {
 public:
  explicit XtcTrajectory(RandomFile file) : file_(std::move(file)) {}

  std::string format() const override { return "XTC"; }
  std::int64_t frame_count() const override { return static_cast<std::int64_t>(places_.size()) - 1; }
  std::int64_t sphere_count() const override { return atoms_; }

  Status find_frames();
  Result<TrajectoryFrame> read(std::int64_t frame) const override;

 private:
  Error damaged(std::int64_t frame, const std::string& what) const {
    return {"frame " + std::to_string(frame) + " of the XTC file is damaged: " + what, file_.path(), 0, 0, ""};
  }

  RandomFile file_;
  std::int64_t atoms_ = 0;
  std::vector<std::int64_t> places_;  // of each frame, and the end of the last
};

Status XtcTrajectory::find_frames() {
  std::int64_t place = 0;
  for (std::int64_t frame = 0; place < file_.size(); ++frame) {
    places_.push_back(place);
    const auto cut = [&] { warn(cut_tail(frame)); };
    const auto damage = [&](const std::string& what) -> Status {
      if (frame == 0) return damaged(frame, what);
      return warn(damaged_tail(frame, place, file_.size())), Done{};
    };
    const std::int64_t left = file_.size() - place;
    if (left < kXtcHeadBytes) return cut(), Done{};
    const Result<std::string> bytes = file_.read(place, std::min(left, kXtcHeadBytes + kPackedHeadBytes + 8));
    if (!bytes) return bytes.error();
    ByteReader reader(*bytes, ByteOrder::big);
    FrameHead head;
    const bool whole = head.take(reader);
    if (!whole || (head.magic != kXtcMagic && head.magic != kXtcMagicOfLarge))
      return damage("it does not begin as a frame");
    if (frame == 0) atoms_ = head.atoms;
    if (head.atoms != atoms_)
      return damaged(frame,
                     "it has " + std::to_string(head.atoms) + " atoms, and the first has " + std::to_string(atoms_));
    std::int64_t length = kXtcHeadBytes + 12 * std::int64_t{head.atoms};
    if (head.is_packed()) {
      std::int64_t packed = 0;
      std::int32_t short_count = 0;
      if (!reader.skip(kPackedHeadBytes)) return cut(), Done{};
      const bool known = head.count_bytes() == 8 ? reader.take(packed) : reader.take(short_count);
      if (!known) return cut(), Done{};
      if (head.count_bytes() == 4) packed = short_count;
      if (packed < 0 || packed > file_.size()) return damage("its length is no number of bytes");
      length = kXtcHeadBytes + kPackedHeadBytes + head.count_bytes() + (packed + 3) / 4 * 4;
    }
    if (length > left) return cut(), Done{};
    place += length;
  }
  places_.push_back(place);
  return Done{};
}

Result<TrajectoryFrame> XtcTrajectory::read(std::int64_t frame) const {
  if (frame < 0 || frame >= frame_count()) return no_such_trajectory_frame(*this, file_.path(), frame);
  const std::int64_t place = places_[static_cast<std::size_t>(frame)];
  const Result<std::string> bytes = file_.read(place, places_[static_cast<std::size_t>(frame) + 1] - place);
  if (!bytes) return bytes.error();
  ByteReader reader(*bytes, ByteOrder::big);
  FrameHead head;
  if (!head.take(reader) || head.atoms != atoms_) return damaged(frame, "it changed while it was read");

  const auto numbers = static_cast<std::size_t>(3 * atoms_);
  std::vector<float> places;
  if (!head.is_packed()) {
    places.resize(numbers);
    for (float& number : places)
      if (!reader.take(number)) return damaged(frame, "it is too short");
  } else {
    PackedHead packed{};
    packed.count = atoms_;
    reader.take(packed.precision);
    for (std::int32_t& number : packed.lowest) reader.take(number);
    for (std::int32_t& number : packed.highest) reader.take(number);
    reader.take(packed.small_size);
    reader.skip(static_cast<std::size_t>(head.count_bytes()));
    std::string_view bits;
    reader.take(reader.left(), bits);
    // A place takes at least a bit, so no damaged number of atoms asks for much memory.
    if (std::uint64_t(atoms_) <= 8 * std::uint64_t{bits.size()}) places = unpack_places(packed, bits);
    if (places.size() != numbers) return damaged(frame, "its packed places cannot be unpacked");
  }

  TrajectoryFrame made;
  for (std::size_t i = 0; i < numbers; i += 3) {
    made.x.push_back(kAngstromOfNm * double(places[i]));
    made.y.push_back(kAngstromOfNm * double(places[i + 1]));
    made.z.push_back(kAngstromOfNm * double(places[i + 2]));
  }
  if (Status status = check_places(made, file_.path(), frame); !status) return status.error();
  take_cell(cell_of_nine(head.cell, kAngstromOfNm), head.cell, frame, made);
  made.time_ps = double(head.time);
  made.step = head.step;
  return made;
}

bool looks_like_xtc(std::string_view first_bytes) {
  ByteReader reader(first_bytes, ByteOrder::big);
  FrameHead head;
  return head.take(reader) && (head.magic == kXtcMagic || head.magic == kXtcMagicOfLarge);
}

Result<std::shared_ptr<const Trajectory>> open_xtc(RandomFile file, const std::string&) {
  auto trajectory = std::make_shared<XtcTrajectory>(std::move(file));
  if (Status status = trajectory->find_frames(); !status) return status.error();
  return std::shared_ptr<const Trajectory>(std::move(trajectory));
}

}  // namespace

extern constexpr TrajectoryFormat kXtc = {.name = "XTC",
                                          .files = ".xtc",
                                          .alone = "an XTC trajectory of GROMACS",
                                          .mark = std::string_view("\0\0\x07\xcb", 4),
                                          .recognise = looks_like_xtc,
                                          .open = open_xtc};

}  // namespace bihive
