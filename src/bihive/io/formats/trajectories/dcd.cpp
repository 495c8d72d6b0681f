// DCD: Fortran records, each between two copies of its length [DCD]. A head of three records, then for each frame the
// cell (where there is one) and x, y and z in binary32. Lengths of records have 32 bits, or 64 where the compiler chose
// so.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/trajectories/frame_checks.h"
#include "bihive/io/packed/byte_reader.h"

namespace bihive {
namespace {

constexpr std::int32_t kDcdHeadBytes = 84;  // of the first record: a word and 20 numbers
constexpr std::int32_t kMostTitles = 1000;
constexpr std::int64_t kCellBytes = 48;             // six numbers in binary64
constexpr std::int32_t kLastOfAngles = 24;          // CHARMM's versions after it write a matrix as the cell [DCD]
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

using CellRecord = double[6];

// Whether the symmetric matrix xx, xy, yy, xz, yz, zz is that of a cell: the matrices that CHARMM writes are positive
// definite.
bool is_shape_matrix(const CellRecord& v) {
  const double minor = v[0] * v[2] - v[1] * v[1];
  const double whole =
      v[0] * (v[2] * v[5] - v[4] * v[4]) - v[1] * (v[1] * v[5] - v[4] * v[3]) + v[3] * (v[1] * v[4] - v[2] * v[3]);
  return v[0] > 0 && minor > 0 && whole > 0;
}

// The cell record holds a, gamma, b, beta, alpha, c. Angles are in degrees, or their cosines (NAMD), or the six are the
// symmetric matrix xx, xy, yy, xz, yz, zz (CHARMM since version 25). Angles in files that state such a version make no
// shape matrix of small cells, and three right angles are never one.
std::optional<Cell> cell_of_record(const CellRecord& v, std::int32_t version) {
  const double angles[3] = {v[4], v[3], v[1]};
  const bool has_other_numbers = std::any_of(std::begin(v), std::end(v), [](double n) { return n < 0; }) ||
                                 std::any_of(std::begin(angles), std::end(angles), [](double n) { return n > 180; });
  const bool are_cosines =
      std::all_of(std::begin(angles), std::end(angles), [](double n) { return n >= -1 && n <= 1; });
  const bool are_right = std::all_of(std::begin(angles), std::end(angles), [](double n) { return n == 90; });
  const bool is_matrix = version > kLastOfAngles ? is_shape_matrix(v) && !are_right : has_other_numbers && !are_cosines;
  if (is_matrix) return cell_of_nine({v[0], v[1], v[3], v[1], v[2], v[4], v[3], v[4], v[5]}, 1);
  if (are_cosines) return cell_of_cosines({v[0], v[2], v[5]}, {v[4], v[3], v[1]});
  return unit_cell({v[0], v[2], v[5], v[4], v[3], v[1]});
}

// How the file's numbers are stored.
struct DcdCoding {
  ByteOrder order;
  std::int64_t mark_bytes;  // of a record's length

  std::int64_t length_of(std::string_view mark) const {
    ByteReader reader(mark, order);
    std::int32_t small = 0;
    std::int64_t length = 0;
    if (mark_bytes == 8) return reader.take(length) ? length : -1;
    return reader.take(small) ? small : -1;
  }
};

class DcdTrajectory : public Trajectory {
 public:
  explicit DcdTrajectory(RandomFile file) : file_(std::move(file)) {}

  std::string format() const override { return "DCD"; }
  std::int64_t frame_count() const override { return static_cast<std::int64_t>(places_.size()); }
  std::int64_t sphere_count() const override { return atoms_; }

  Status read_head(DcdCoding coding);
  Result<TrajectoryFrame> read(std::int64_t frame) const override;

 private:
  Error damaged(const std::string& what) const { return {"the DCD file is damaged: " + what, file_.path(), 0, 0, ""}; }
  // The record that begins at `place`, which moves behind it.
  Result<std::string> record(std::int64_t& place) const;
  Status find_frames(std::int64_t first_place);
  Status read_frame(std::int64_t frame, TrajectoryFrame& into) const;
  // The length of the record at `place`; less than 0 if the file has no such bytes.
  Result<std::int64_t> length_at(std::int64_t place) const;
  // The atoms that a frame holds.
  std::int64_t atoms_of(std::int64_t frame) const {
    return frame == 0 || free_atoms_.empty() ? atoms_ : static_cast<std::int64_t>(free_atoms_.size());
  }
  std::int64_t frame_bytes(std::int64_t frame, bool cell) const {
    const std::int64_t marks = 2 * coding_.mark_bytes;
    return (cell ? kCellBytes + marks : 0) + (has_fourth_ ? 4 : 3) * (4 * atoms_of(frame) + marks);
  }
  // Whether a frame whose first record has that length begins with a cell. The head may promise cells that single
  // frames lack.
  bool begins_with_cell(std::int64_t length, std::int64_t frame) const {
    return length == kCellBytes && (has_cells_ || length != 4 * atoms_of(frame));
  }

  RandomFile file_;
  DcdCoding coding_{};
  bool has_cells_ = false, has_fourth_ = false;
  std::int32_t version_ = 0;
  double time_step_ps_ = 0;
  std::int64_t first_step_ = 0, steps_apart_ = 0;
  std::int64_t atoms_ = 0;
  std::vector<std::int64_t> places_;      // of each frame
  std::vector<std::int32_t> free_atoms_;  // from 0, those that later frames hold; empty: all
};

Result<std::int64_t> DcdTrajectory::length_at(std::int64_t place) const {
  const Result<std::string> bytes = file_.read(place, coding_.mark_bytes);
  if (!bytes) return bytes.error();
  return coding_.length_of(*bytes);
}

Result<std::string> DcdTrajectory::record(std::int64_t& place) const {
  const std::int64_t mark = coding_.mark_bytes;
  const Result<std::int64_t> length = length_at(place);
  if (!length) return length.error();
  if (*length < 0) return damaged("a record has a negative length");
  if (*length > file_.size()) return damaged("a record is longer than the file");
  Result<std::string> content = file_.read(place + mark, *length);
  if (!content) return content.error();
  const Result<std::int64_t> again = length_at(place + mark + *length);
  if (!again) return again.error();
  if (*again != *length) return damaged("a record's two lengths differ at byte " + std::to_string(place));
  place += *length + 2 * mark;
  return content;
}

Status DcdTrajectory::read_head(DcdCoding coding) {
  coding_ = coding;
  const ByteOrder order = coding.order;
  std::int64_t place = 0;
  const Result<std::string> head = record(place);
  if (!head) return head.error();
  ByteReader numbers(*head, order);
  numbers.skip(4);
  std::int32_t control[20] = {};
  for (std::int32_t& number : control) numbers.take(number);
  version_ = control[19];
  const bool is_charmm = version_ != 0;
  has_cells_ = is_charmm && control[10] != 0;
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
    const Result<std::string> begin = file_.read(place + coding.mark_bytes, 4);
    if (!begin) return begin.error();
    std::int32_t count = 0;
    ByteReader(*begin, order).take(count);
    if (count < 0 || count > kMostTitles) return titles.error();
    place += 2 * coding.mark_bytes + 4 + 80 * std::int64_t{count};
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

  return find_frames(place);
}

// The head's number of frames is often not kept, and frames may differ in whether they have a cell.
Status DcdTrajectory::find_frames(std::int64_t place) {
  // Frames of one length: then the file's length tells their number.
  const auto cell_at = [&](std::int64_t at, std::int64_t frame) -> std::optional<bool> {
    const Result<std::int64_t> length = length_at(at);
    if (!length) return std::nullopt;
    if (begins_with_cell(*length, frame)) return true;
    return *length == 4 * atoms_of(frame) ? std::optional(false) : std::nullopt;
  };
  const std::int64_t first = frame_bytes(0, has_cells_), later = frame_bytes(1, has_cells_);
  const std::int64_t behind_first = file_.size() - place - first;
  if (behind_first >= 0 && behind_first % later == 0 && cell_at(place, 0) == has_cells_ &&
      (behind_first == 0 || cell_at(file_.size() - later, 1) == has_cells_)) {
    places_.push_back(place);
    for (std::int64_t next = place + first; next < file_.size(); next += later) places_.push_back(next);
    return Done{};
  }

  // Else go from frame to frame.
  while (place < file_.size()) {
    const std::int64_t frame = frame_count();
    const std::int64_t left = file_.size() - place;
    const std::optional<bool> cell = left < coding_.mark_bytes ? false : cell_at(place, frame);
    if (!cell && frame == 0) return damaged("its first frame has another number of atoms than its head says");
    if (!cell) {
      warn(damaged_tail(frame, place, file_.size()));
      break;
    }
    if (frame_bytes(frame, *cell) > left) {
      warn(cut_tail(frame));
      break;
    }
    places_.push_back(place);
    place += frame_bytes(frame, *cell);
  }
  return Done{};
}

Status DcdTrajectory::read_frame(std::int64_t frame, TrajectoryFrame& into) const {
  const bool some = frame > 0 && !free_atoms_.empty();
  const auto count = static_cast<std::size_t>(atoms_of(frame));
  std::int64_t place = places_[static_cast<std::size_t>(frame)];
  const Result<std::int64_t> first_length = length_at(place);
  if (!first_length) return first_length.error();
  into.cell.reset();
  if (begins_with_cell(*first_length, frame)) {
    const Result<std::string> bytes = record(place);
    if (!bytes) return bytes.error();
    CellRecord v = {};
    ByteReader numbers(*bytes, coding_.order);
    for (double& number : v) numbers.take(number);
    take_cell(cell_of_record(v, version_), std::array{v[0], v[2], v[5]}, frame, into);
  }
  for (std::vector<double>* axis : {&into.x, &into.y, &into.z}) {
    const Result<std::string> bytes = record(place);
    if (!bytes) return bytes.error();
    if (bytes->size() != 4 * count) return damaged("frame " + std::to_string(frame) + " has another number of atoms");
    axis->resize(static_cast<std::size_t>(atoms_));
    ByteReader numbers(*bytes, coding_.order);
    for (std::size_t i = 0; i < count; ++i) {
      float value = 0;
      numbers.take(value);
      (*axis)[some ? static_cast<std::size_t>(free_atoms_[i]) : i] = double(value);
    }
  }
  return Done{};
}

Result<TrajectoryFrame> DcdTrajectory::read(std::int64_t frame) const {
  if (frame < 0 || frame >= frame_count()) return no_such_trajectory_frame(*this, file_.path(), frame);
  TrajectoryFrame made;
  // Fixed atoms stand in the first frame alone.
  if (frame > 0 && !free_atoms_.empty())
    if (Status status = read_frame(0, made); !status) return status.error();
  made.warnings.clear();
  if (Status status = read_frame(frame, made); !status) return status.error();
  if (Status status = check_places(made, file_.path(), frame); !status) return status.error();
  made.step = first_step_ + frame * steps_apart_;
  if (time_step_ps_ > 0) made.time_ps = time_step_ps_ * static_cast<double>(*made.step);
  return made;
}

std::optional<DcdCoding> coding_of(std::string_view first_bytes) {
  for (const std::int64_t mark_bytes : {4, 8})
    for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
      const DcdCoding coding{order, mark_bytes};
      const auto mark = static_cast<std::size_t>(mark_bytes);
      if (first_bytes.size() < mark + 4 || coding.length_of(first_bytes.substr(0, mark)) != kDcdHeadBytes) continue;
      if (const std::string_view word = first_bytes.substr(mark, 4); word == "CORD" || word == "VELD") return coding;
    }
  return std::nullopt;
}

bool looks_like_dcd(std::string_view first_bytes) {
  return coding_of(first_bytes).has_value();
}

Result<std::shared_ptr<const Trajectory>> open_dcd(RandomFile file, const std::string&) {
  const Result<std::string> first = file.read(0, std::min<std::int64_t>(12, file.size()));
  if (!first) return first.error();
  const std::optional<DcdCoding> coding = coding_of(*first);
  if (!coding) return Error{"this is no DCD file", file.path(), 0, 0, ""};
  if (first->substr(static_cast<std::size_t>(coding->mark_bytes), 4) == "VELD")
    return Error{"the DCD file holds velocities, not places", file.path(), 0, 0, ""};
  auto trajectory = std::make_shared<DcdTrajectory>(std::move(file));
  if (Status status = trajectory->read_head(*coding); !status) return status.error();
  return std::shared_ptr<const Trajectory>(std::move(trajectory));
}

}  // namespace

extern constexpr TrajectoryFormat kDcd = {.name = "DCD",
                                          .files = ".dcd",
                                          .alone = "a DCD trajectory of CHARMM, NAMD or LAMMPS",
                                          .recognise = looks_like_dcd,
                                          .open = open_dcd};

}  // namespace bihive
