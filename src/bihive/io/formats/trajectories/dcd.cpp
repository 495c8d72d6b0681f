// DCD: Fortran records, each between two copies of its length [DCD]. A head of three records, then for each frame the
// cell (if the head says so) and x, y and z in binary32.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/trajectories/frame_checks.h"
#include "bihive/io/packed/byte_reader.h"

namespace bihive {
namespace {

constexpr std::int64_t kMark = 4;           // bytes of a record's length
constexpr std::int32_t kDcdHeadBytes = 84;  // of the first record: a word and 20 numbers
constexpr std::int32_t kMostTitles = 1000;
constexpr double kPicosecondsOfAkma = 4.888821e-2;  // CHARMM's unit of time

// The cell of three lengths and the cosines of its angles; nothing if there is none.
std::optional<Cell> cell_of_cosines(Vec3d lengths, Vec3d cosines) {
  for (int k = 0; k < 3; ++k)
    if (!(lengths[k] > 0) || !std::isfinite(lengths[k])) return std::nullopt;
  const double sine = std::sqrt(1 - cosines.z * cosines.z);
  const double y = (cosines.x - cosines.y * cosines.z) / sine;
  const double z_squared = 1 - cosines.y * cosines.y - y * y;
  if (!(sine > 0 && z_squared > 0)) return std::nullopt;
  Cell cell;
  cell.vectors = {Vec3d{lengths.x, 0, 0}, Vec3d{lengths.y * cosines.z, lengths.y * sine, 0},
                  Vec3d{lengths.z * cosines.y, lengths.z * y, lengths.z * std::sqrt(z_squared)}};
  return cell;
}

// The cell record holds a, gamma, b, beta, alpha, c. Angles are in degrees, or their cosines (NAMD), or the six are the
// symmetric matrix xx, xy, yy, xz, yz, zz (CHARMM since version 25).
std::optional<Cell> cell_of_record(const double (&v)[6]) {
  const double angles[3] = {v[4], v[3], v[1]};
  const bool is_matrix = std::any_of(std::begin(v), std::end(v), [](double n) { return n < 0; }) ||
                         std::any_of(std::begin(angles), std::end(angles), [](double n) { return n > 180; });
  const bool are_cosines =
      std::all_of(std::begin(angles), std::end(angles), [](double n) { return n >= -1 && n <= 1; });
  if (are_cosines) return cell_of_cosines({v[0], v[2], v[5]}, {v[4], v[3], v[1]});
  if (is_matrix) return cell_of_nine({v[0], v[1], v[3], v[1], v[2], v[4], v[3], v[4], v[5]}, 1);
  return unit_cell({v[0], v[2], v[5], v[4], v[3], v[1]});
}

class DcdTrajectory : public Trajectory {
 public:
  explicit DcdTrajectory(RandomFile file) : file_(std::move(file)) {}

  std::string format() const override { return "DCD"; }
  std::int64_t frame_count() const override { return frames_; }
  std::int64_t sphere_count() const override { return atoms_; }

  Status read_head(ByteOrder order);
  Result<TrajectoryFrame> read(std::int64_t frame) const override;

 private:
  Error damaged(const std::string& what) const { return {"the DCD file is damaged: " + what, file_.path(), 0, 0, ""}; }
  // The record that begins at `place`, which moves behind it.
  Result<std::string> record(std::int64_t& place) const;
  Status read_frame(std::int64_t frame, TrajectoryFrame& into) const;
  std::int64_t frame_bytes(std::int64_t atoms) const {
    return (has_cell_ ? 48 + 2 * kMark : 0) + (has_fourth_ ? 4 : 3) * (4 * atoms + 2 * kMark);
  }

  RandomFile file_;
  ByteOrder order_ = ByteOrder::little;
  bool has_cell_ = false, has_fourth_ = false;
  double time_step_ps_ = 0;
  std::int64_t first_step_ = 0, steps_apart_ = 0;
  std::int64_t atoms_ = 0, frames_ = 0;
  std::int64_t first_place_ = 0;          // of the first frame
  std::vector<std::int32_t> free_atoms_;  // from 0, those that later frames hold; empty: all
};

Result<std::string> DcdTrajectory::record(std::int64_t& place) const {
  const auto mark_at = [&](std::int64_t at) -> Result<std::int32_t> {
    const Result<std::string> bytes = file_.read(at, kMark);
    if (!bytes) return bytes.error();
    std::int32_t length = 0;
    ByteReader(*bytes, order_).take(length);
    return length;
  };
  const Result<std::int32_t> length = mark_at(place);
  if (!length) return length.error();
  if (*length < 0) return damaged("a record has a negative length");
  Result<std::string> content = file_.read(place + kMark, *length);
  if (!content) return content.error();
  const Result<std::int32_t> again = mark_at(place + kMark + *length);
  if (!again) return again.error();
  if (*again != *length) return damaged("a record's two lengths differ at byte " + std::to_string(place));
  place += *length + 2 * kMark;
  return content;
}

Status DcdTrajectory::read_head(ByteOrder order) {
  order_ = order;
  std::int64_t place = 0;
  const Result<std::string> head = record(place);
  if (!head) return head.error();
  ByteReader numbers(*head, order);
  numbers.skip(4);
  std::int32_t control[20] = {};
  for (std::int32_t& number : control) numbers.take(number);
  const bool is_charmm = control[19] != 0;
  has_cell_ = is_charmm && control[10] != 0;
  has_fourth_ = is_charmm && control[11] != 0;
  first_step_ = control[1];
  steps_apart_ = control[2];
  ByteReader delta(std::string_view(*head).substr(4 + 9 * 4), order);
  if (is_charmm) {
    float step = 0;
    delta.take(step);
    time_step_ps_ = double(step) * kPicosecondsOfAkma;
  } else {
    delta.take(time_step_ps_);
    time_step_ps_ *= kPicosecondsOfAkma;
  }

  // The titles do not matter; some programs write a wrong length, but the right number of titles of 80 letters. Then
  // come the number of atoms and, if some are fixed, the numbers of the others.
  if (const Result<std::string> titles = record(place); !titles) {
    const Result<std::string> begin = file_.read(place + kMark, 4);
    if (!begin) return begin.error();
    std::int32_t count = 0;
    ByteReader(*begin, order).take(count);
    if (count < 0 || count > kMostTitles) return titles.error();
    place += 2 * kMark + 4 + 80 * std::int64_t{count};
  }
  const Result<std::string> count = record(place);
  if (!count) return count.error();
  std::int32_t atoms = 0;
  if (!ByteReader(*count, order).take(atoms) || atoms < 1) return damaged("it has no atoms");
  atoms_ = atoms;
  if (control[8] > 0) {
    const Result<std::string> numbers_of_free = record(place);
    if (!numbers_of_free) return numbers_of_free.error();
    ByteReader ids(*numbers_of_free, order);
    for (std::int32_t id = 0; ids.take(id);) {
      if (id < 1 || id > atoms) return damaged("it has no atom " + std::to_string(id));
      free_atoms_.push_back(id - 1);
    }
    if (free_atoms_.empty()) return damaged("all atoms are fixed");
  }

  // The file's length tells the number of frames; the head's number is often not kept.
  first_place_ = place;
  const std::int64_t left = file_.size() - place;
  const std::int64_t later = frame_bytes(free_atoms_.empty() ? atoms_ : static_cast<std::int64_t>(free_atoms_.size()));
  if (left >= frame_bytes(atoms_)) frames_ = 1 + (left - frame_bytes(atoms_)) / later;
  const std::int64_t rest = frames_ == 0 ? left : (left - frame_bytes(atoms_)) % later;
  if (rest != 0) warn("the file ends inside frame " + std::to_string(frames_) + ", which is left out: it may be cut");
  return Done{};
}

Status DcdTrajectory::read_frame(std::int64_t frame, TrajectoryFrame& into) const {
  const bool some = frame > 0 && !free_atoms_.empty();
  const auto count = some ? free_atoms_.size() : static_cast<std::size_t>(atoms_);
  std::int64_t place = first_place_;
  if (frame > 0)
    place += frame_bytes(atoms_) + (frame - 1) * frame_bytes(static_cast<std::int64_t>(
                                                     free_atoms_.empty() ? std::size_t(atoms_) : free_atoms_.size()));
  if (has_cell_) {
    const Result<std::string> bytes = record(place);
    if (!bytes) return bytes.error();
    if (bytes->size() != 48) return damaged("a cell has not six numbers");
    double v[6] = {};
    ByteReader numbers(*bytes, order_);
    for (double& number : v) numbers.take(number);
    into.cell = cell_of_record(v);
  }
  for (std::vector<double>* axis : {&into.x, &into.y, &into.z}) {
    const Result<std::string> bytes = record(place);
    if (!bytes) return bytes.error();
    if (bytes->size() != 4 * count) return damaged("frame " + std::to_string(frame) + " has another number of atoms");
    axis->resize(static_cast<std::size_t>(atoms_));
    ByteReader numbers(*bytes, order_);
    for (std::size_t i = 0; i < count; ++i) {
      float value = 0;
      numbers.take(value);
      (*axis)[some ? static_cast<std::size_t>(free_atoms_[i]) : i] = double(value);
    }
  }
  return Done{};
}

Result<TrajectoryFrame> DcdTrajectory::read(std::int64_t frame) const {
  if (frame < 0 || frame >= frames_) return no_such_trajectory_frame(*this, file_.path(), frame);
  TrajectoryFrame made;
  // Fixed atoms stand in the first frame alone.
  if (frame > 0 && !free_atoms_.empty())
    if (Status status = read_frame(0, made); !status) return status.error();
  if (Status status = read_frame(frame, made); !status) return status.error();
  if (Status status = check_places(made, file_.path(), frame); !status) return status.error();
  made.step = first_step_ + frame * steps_apart_;
  if (time_step_ps_ > 0) made.time_ps = time_step_ps_ * static_cast<double>(*made.step);
  return made;
}

std::optional<ByteOrder> byte_order_of(std::string_view first_bytes) {
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
    std::int32_t length = 0;
    if (ByteReader(first_bytes, order).take(length) && length == kDcdHeadBytes) return order;
  }
  return std::nullopt;
}

bool looks_like_dcd(std::string_view first_bytes) {
  const std::string_view word = first_bytes.substr(std::min<std::size_t>(4, first_bytes.size()), 4);
  return byte_order_of(first_bytes).has_value() && (word == "CORD" || word == "VELD");
}

Result<std::shared_ptr<const Trajectory>> open_dcd(RandomFile file, const std::string&) {
  const Result<std::string> first = file.read(0, 8);
  if (!first) return first.error();
  const std::optional<ByteOrder> order = byte_order_of(*first);
  if (!order) return Error{"this is no DCD file", file.path(), 0, 0, ""};
  if (first->substr(4) == "VELD") return Error{"the DCD file holds velocities, not places", file.path(), 0, 0, ""};
  auto trajectory = std::make_shared<DcdTrajectory>(std::move(file));
  if (Status status = trajectory->read_head(*order); !status) return status.error();
  return std::shared_ptr<const Trajectory>(std::move(trajectory));
}

}  // namespace

extern constexpr TrajectoryFormat kDcd = {.name = "DCD",
                                          .files = ".dcd",
                                          .alone = "a DCD trajectory of CHARMM, NAMD or LAMMPS",
                                          .recognise = looks_like_dcd,
                                          .open = open_dcd};

}  // namespace bihive
