// TRR: frames of GROMACS in XDR's big-endian words, single or double precision, not packed [TRR]. Lengths in
// nanometres.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bihive/io/formats/format.h"
#include "bihive/io/formats/trajectories/frame_checks.h"
#include "bihive/io/packed/byte_reader.h"

namespace bihive {
namespace {

constexpr double kTrrAngstromOfNm = 10;
constexpr std::int32_t kTrrMagic = 1993;
constexpr std::string_view kVersion = "GMX_trn_file";
// Magic, the length of the version with its end, the version as a string of XDR, 13 numbers, time and lambda.
constexpr std::int64_t kMostHeadBytes = 4 + 4 + 4 + 12 + 13 * 4 + 16;

// The parts of a frame, in the order in which they stand there.
struct TrrHead {
  std::int32_t bytes_of[10] = {};  // ir, e, box, vir, pres, top, sym, x, v, f
  std::int32_t atoms = 0, step = 0;
  double time = 0;
  bool is_double = false;
  std::int64_t head_bytes = 0;

  static constexpr int kBox = 2, kX = 7, kV = 8, kF = 9;

  std::int64_t bytes_before(int part) const {
    std::int64_t sum = 0;
    for (int i = 0; i < part; ++i) sum += bytes_of[i];
    return sum;
  }
  std::int64_t frame_bytes() const { return head_bytes + bytes_before(10); }
  bool has_places() const { return bytes_of[kX] > 0; }

  // False: this is no head of a frame.
  bool take(std::string_view bytes) {
    ByteReader reader(bytes, ByteOrder::big);
    std::int32_t magic = 0, with_end = 0, length = 0, nre = 0;
    std::string_view version;
    if (!reader.take(magic) || magic != kTrrMagic || !reader.take(with_end) || !reader.take(length)) return false;
    if (length != static_cast<std::int32_t>(kVersion.size()) || !reader.take(kVersion.size(), version) ||
        version != kVersion)
      return false;
    for (std::int32_t& count : bytes_of)
      if (!reader.take(count) || count < 0) return false;
    if (!reader.take(atoms) || !reader.take(step) || !reader.take(nre) || atoms < 0) return false;
    // The size of a number follows from the parts.
    std::int64_t size = 0;
    if (bytes_of[kBox] > 0)
      size = bytes_of[kBox] / 9;
    else if (atoms > 0)
      for (int part = kX; part < 10 && size == 0; ++part) size = bytes_of[part] / (3 * std::int64_t{atoms});
    if (size != 4 && size != 8) return false;
    is_double = size == 8;
    if (bytes_of[kBox] != 0 && bytes_of[kBox] != 9 * size) return false;
    for (int part = kX; part < 10; ++part)
      if (bytes_of[part] != 0 && bytes_of[part] != 3 * size * atoms) return false;
    float single = 0;
    if (is_double ? !reader.take(time) : !reader.take(single)) return false;
    if (!is_double) time = double(single);
    head_bytes = 4 + 4 + 4 + 12 + 13 * 4 + 2 * size;
    return true;
  }
};

double take_number(ByteReader& reader, bool is_double) {
  double value = 0;
  if (is_double) {
    reader.take(value);
    return value;
  }
  float single = 0;
  reader.take(single);
  return double(single);
}

class TrrTrajectory : public Trajectory {
 public:
  explicit TrrTrajectory(RandomFile file) : file_(std::move(file)) {}

  std::string format() const override { return "TRR"; }
  std::int64_t frame_count() const override { return static_cast<std::int64_t>(places_.size()); }
  std::int64_t sphere_count() const override { return atoms_; }

  Status find_frames();
  Result<TrajectoryFrame> read(std::int64_t frame) const override;

 private:
  Result<TrrHead> head_at(std::int64_t place) const {
    const Result<std::string> bytes = file_.read(place, std::min(file_.size() - place, kMostHeadBytes));
    if (!bytes) return bytes.error();
    TrrHead head;
    if (!head.take(*bytes))
      return Error{"the TRR file is damaged: no frame begins at byte " + std::to_string(place), file_.path(), 0, 0, ""};
    return head;
  }

  // The numbers of a part of the frame that begins at `place`.
  Result<std::vector<double>> part_of(std::int64_t place, const TrrHead& head, int part) const {
    const Result<std::string> bytes =
        file_.read(place + head.head_bytes + head.bytes_before(part), head.bytes_of[part]);
    if (!bytes) return bytes.error();
    std::vector<double> numbers(bytes->size() / (head.is_double ? 8 : 4));
    ByteReader reader(*bytes, ByteOrder::big);
    for (double& number : numbers) number = take_number(reader, head.is_double);
    return numbers;
  }

  RandomFile file_;
  std::int64_t atoms_ = 0;
  std::vector<std::int64_t> places_;  // of each frame that has places of atoms
};

Status TrrTrajectory::find_frames() {
  std::int64_t without = 0;
  for (std::int64_t place = 0; place < file_.size();) {
    const std::int64_t left = file_.size() - place;
    const bool cut_in_head = left < kMostHeadBytes - 8;
    const Result<TrrHead> head = head_at(place);
    if (!head && !cut_in_head) {
      if (place == 0) return head.error();
      warn(damaged_tail(frame_count(), place, file_.size()));
      break;
    }
    if (!head || head->frame_bytes() > left) {
      warn(cut_tail(frame_count()));
      break;
    }
    if (head->has_places()) {
      if (places_.empty()) atoms_ = head->atoms;
      if (head->atoms != atoms_)
        return Error{"the TRR file has " + std::to_string(head->atoms) + " atoms in frame " +
                         std::to_string(places_.size()) + ", and " + std::to_string(atoms_) + " in the first",
                     file_.path(), 0, 0, ""};
      places_.push_back(place);
    } else {
      ++without;
    }
    place += head->frame_bytes();
  }
  if (without > 0)
    warn(std::to_string(without) + (without == 1 ? " frame has" : " frames have") +
         " velocities or forces and no places; left out");
  return Done{};
}

Result<TrajectoryFrame> TrrTrajectory::read(std::int64_t frame) const {
  if (frame < 0 || frame >= frame_count()) return no_such_trajectory_frame(*this, file_.path(), frame);
  const std::int64_t place = places_[static_cast<std::size_t>(frame)];
  const Result<TrrHead> head = head_at(place);
  if (!head) return head.error();
  if (head->atoms != atoms_ || !head->has_places())
    return Error{"the TRR file changed while it was read", file_.path(), 0, 0, ""};

  TrajectoryFrame made;
  made.time_ps = head->time;
  made.step = head->step;
  if (head->bytes_of[TrrHead::kBox] > 0) {
    const Result<std::vector<double>> box = part_of(place, *head, TrrHead::kBox);
    if (!box) return box.error();
    double v[9] = {};
    std::copy(box->begin(), box->end(), v);
    take_cell(cell_of_nine(v, kTrrAngstromOfNm), v, frame, made);
  }
  const Result<std::vector<double>> places = part_of(place, *head, TrrHead::kX);
  if (!places) return places.error();
  for (std::size_t i = 0; i < places->size(); i += 3) {
    made.x.push_back(kTrrAngstromOfNm * (*places)[i]);
    made.y.push_back(kTrrAngstromOfNm * (*places)[i + 1]);
    made.z.push_back(kTrrAngstromOfNm * (*places)[i + 2]);
  }
  if (Status status = check_places(made, file_.path(), frame); !status) return status.error();

  // Velocities and forces, in the file's own units.
  constexpr std::pair<int, std::array<const char*, 3>> kVectors[] = {{TrrHead::kV, {"vx", "vy", "vz"}},
                                                                     {TrrHead::kF, {"fx", "fy", "fz"}}};
  for (const auto& [part, names] : kVectors) {
    if (head->bytes_of[part] == 0) continue;
    const Result<std::vector<double>> vectors = part_of(place, *head, part);
    if (!vectors) return vectors.error();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      NamedNumbers column{names[axis], {}};
      for (std::size_t i = axis; i < vectors->size(); i += 3) column.values.push_back((*vectors)[i]);
      made.numbers.push_back(std::move(column));
    }
  }
  return made;
}

bool looks_like_trr(std::string_view first_bytes) {
  TrrHead head;
  return head.take(first_bytes);
}

Result<std::shared_ptr<const Trajectory>> open_trr(RandomFile file, const std::string&) {
  auto trajectory = std::make_shared<TrrTrajectory>(std::move(file));
  if (Status status = trajectory->find_frames(); !status) return status.error();
  return std::shared_ptr<const Trajectory>(std::move(trajectory));
}

}  // namespace

extern constexpr TrajectoryFormat kTrr = {.name = "TRR",
                                          .files = ".trr",
                                          .alone = "a TRR trajectory of GROMACS",
                                          .mark = std::string_view("\0\0\x07\xc9", 4),
                                          .recognise = looks_like_trr,
                                          .open = open_trr};

}  // namespace bihive
