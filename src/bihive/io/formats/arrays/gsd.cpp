#include "bihive/io/formats/arrays/gsd.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/io/assemble/unit_cell.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/frames/raw_frames.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// Columns of numbers that are kept under the names that LAMMPS dumps have for them.
struct KeptArray {
  const char* array;
  std::array<const char*, 3> names;  // one or three
  double by_default;                 // of the schema
};
constexpr KeptArray kKeptArrays[] = {{"particles/mass", {"mass"}, 1},
                                     {"particles/charge", {"q"}, 0},
                                     {"particles/body", {"body"}, -1},
                                     {"particles/velocity", {"vx", "vy", "vz"}, 0},
                                     {"particles/image", {"ix", "iy", "iz"}, 0}};
constexpr double kDefaultDiameter = 1;

class GsdFrame {
 public:
  GsdFrame(const GsdFile& file, std::int64_t frame, RowChunk chunk) : file_(file), frame_(frame), chunk_(chunk) {}

  Result<RawSpheres> read() {
    if (frame_ < 0 || frame_ >= file_.frame_count()) return no_such_frame(file_.path(), frame_, file_.frame_count());
    if (file_.schema() != "hoomd")
      return Error{"the GSD file holds no particles of HOOMD-blue but " + quote(file_.schema()), file_.path(), 0, 0,
                   ""};
    spheres_.format = "GSD";
    spheres_.frames = file_.frame_count();
    for (Status (GsdFrame::*step)() :
         {&GsdFrame::read_count, &GsdFrame::read_places, &GsdFrame::read_types, &GsdFrame::read_radii,
          &GsdFrame::read_numbers, &GsdFrame::read_bonds, &GsdFrame::read_cell})
      if (Status status = (this->*step)(); !status) return status.error();
    return std::move(spheres_);
  }

 private:
  Error wrong(const std::string& array, const std::string& what) const {
    return {"frame " + std::to_string(frame_) + " of the GSD file: " + array + " " + what, file_.path(), 0, 0, ""};
  }

  // The particles of a frame: by their number, else by the rows of their positions.
  Result<std::int64_t> count_of(std::int64_t frame) const {
    const Result<std::optional<GsdArray>> stated = file_.array(frame, "particles/N");
    if (!stated) return stated.error();
    if (!*stated) return file_.rows(frame, "particles/position").value_or(0);
    const double count = (*stated)->values.size() == 1 ? (*stated)->values[0] : -1;
    if (!(count >= 0 && count < 0x1p53 && count == std::floor(count)))
      return wrong("particles/N", "is no number of particles");
    return static_cast<std::int64_t>(count);
  }

  Status read_count() {
    const Result<std::int64_t> own = count_of(frame_);
    if (!own) return own.error();
    const Result<std::int64_t> first = count_of(0);
    if (!first) return first.error();
    rows_ = *own;
    count_ = chunk_.of(rows_).count();
    is_as_first_ = *own == *first;
    return Done{};
  }

  // An array with one row for each particle. What a frame does not state is that of frame 0 if the particles are as
  // many, else the schema's default: then `array` is empty.
  Status take(const std::string& name, std::int64_t columns, std::optional<GsdArray>& array) const {
    array.reset();
    if (!file_.has(frame_, name) && !is_as_first_) return Done{};
    Result<std::optional<GsdArray>> found = file_.array(frame_, name, chunk_);
    if (!found) return found.error();
    array = std::move(*found);
    if (array && (array->rows != rows_ || array->columns != columns))
      return wrong(name, "has " + std::to_string(array->rows) + " x " + std::to_string(array->columns) +
                             " numbers for " + std::to_string(rows_) + " particles");
    return Done{};
  }

  // The same with the default where frame 0 states other numbers: so all frames have the same columns.
  Status take(const std::string& name, std::int64_t columns, double by_default, std::optional<GsdArray>& array) const {
    if (Status status = take(name, columns, array); !status) return status;
    if (!array && !is_as_first_ && file_.has(0, name))
      array = GsdArray{rows_, columns, std::vector<double>(static_cast<std::size_t>(count_ * columns), by_default)};
    return Done{};
  }

  Status read_places() {
    if (rows_ == 0) return Done{};
    std::optional<GsdArray> array;
    if (Status status = take("particles/position", 3, array); !status) return status;
    if (!array) return wrong("particles/position", "is missing");
    for (std::size_t i = 0; i < array->values.size(); ++i) {
      if (coordinate_fault(array->values[i])) return wrong("particles/position", "has a number that is not finite");
      (i % 3 == 0 ? spheres_.x : i % 3 == 1 ? spheres_.y : spheres_.z).push_back(array->values[i]);
    }
    return Done{};
  }

  // The names of types are texts of one length, padded by zeros.
  Status read_types() {
    std::optional<GsdArray> ids;
    if (Status status = take("particles/typeid", 1, ids); !status) return status;
    Result<std::optional<GsdArray>> names = file_.array(frame_, "particles/types");
    if (!names) return names.error();
    NamedTexts column{"type", {}, {}};
    if (*names) {
      for (std::int64_t row = 0; row < (*names)->rows; ++row) {
        std::string name;
        for (std::int64_t k = 0; k < (*names)->columns; ++k) {
          const double letter = (*names)->values[static_cast<std::size_t>(row * (*names)->columns + k)];
          if (letter == 0) break;
          if (!(letter >= -128 && letter < 256)) return wrong("particles/types", "has a number that is no letter");
          name += static_cast<char>(static_cast<int>(letter));
        }
        column.texts.push_back(name);
      }
    }
    if (column.texts.empty()) column.texts = {"A"};  // the schema's own
    for (std::int64_t i = 0; i < count_; ++i) {
      const double id = ids ? ids->values[static_cast<std::size_t>(i)] : 0;
      if (!(id >= 0 && id < static_cast<double>(column.texts.size())))
        return wrong("particles/typeid", "names a type that does not exist");
      column.text_of_sphere.push_back(static_cast<std::int32_t>(id));
      spheres_.attributes.type.push_back(static_cast<std::int32_t>(id));
    }
    spheres_.attributes.texts.push_back(printable_texts(std::move(column)));
    return Done{};
  }

  Status read_radii() {
    std::optional<GsdArray> diameters;
    if (Status status = take("particles/diameter", 1, kDefaultDiameter, diameters); !status || !diameters)
      return status;
    for (const double diameter : diameters->values) {
      if (radius_fault(diameter / 2)) return wrong("particles/diameter", "has a number that is no diameter");
      spheres_.r.push_back(diameter / 2);
    }
    spheres_.rules.push_back("radii: half of particles/diameter");
    return Done{};
  }

  Status read_numbers() {
    for (const KeptArray& kept : kKeptArrays) {
      const std::int64_t columns = kept.names[1] != nullptr ? 3 : 1;
      std::optional<GsdArray> array;
      if (Status status = take(kept.array, columns, kept.by_default, array); !status) return status;
      if (!array) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) {
        NamedNumbers column{kept.names[k], {}};
        for (std::size_t i = k; i < array->values.size(); i += static_cast<std::size_t>(columns))
          column.values.push_back(array->values[i]);
        spheres_.attributes.numbers.push_back(std::move(column));
      }
    }
    return Done{};
  }

  // Two particles each, counted from 0. What a frame does not state is that of frame 0. Bonds that cannot be are told,
  // and no fault of the particles.
  Status read_bonds() {
    if (chunk_.count != 1) return Done{};
    const Result<std::optional<GsdArray>> count = file_.array(frame_, "bonds/N");
    if (!count) return count.error();
    const Result<std::optional<GsdArray>> groups = file_.array(frame_, "bonds/group");
    if (!groups) return groups.error();
    const double bonds = *count && (*count)->values.size() == 1 ? (*count)->values[0] : 0;
    if (bonds == 0) return Done{};
    bool is_right = *groups && (*groups)->columns == 2 && static_cast<double>((*groups)->rows) == bonds;
    for (std::size_t i = 0; is_right && i < (*groups)->values.size(); ++i) {
      const double id = (*groups)->values[i];
      is_right = id >= 0 && id < static_cast<double>(count_) && id == std::floor(id);
    }
    if (!is_right) {
      spheres_.warnings.push_back("frame " + std::to_string(frame_) +
                                  " of the GSD file: bonds/group does not name two particles for each of bonds/N, so "
                                  "its bonds are left out");
      return Done{};
    }
    const std::vector<double>& ids = (*groups)->values;
    for (std::size_t i = 0; i < ids.size(); i += 2)
      spheres_.attributes.bonds.add(static_cast<std::int32_t>(ids[i]), static_cast<std::int32_t>(ids[i + 1]));
    spheres_.attributes.bonds.are_all = true;
    return Done{};
  }

  // Lx, Ly, Lz, xy, xz, yz; the middle of the cell is the origin. The tilts are shares of the lengths.
  Status read_cell() {
    const Result<std::optional<GsdArray>> box = file_.array(frame_, "configuration/box");
    if (!box) return box.error();
    if (*box && (*box)->values.size() == 6) {
      const std::vector<double>& v = (*box)->values;
      Cell cell;
      cell.vectors = {Vec3d{v[0], 0, 0}, Vec3d{v[3] * v[1], v[1], 0}, Vec3d{v[4] * v[2], v[5] * v[2], v[2]}};
      cell.origin = -0.5 * (cell.vectors[0] + cell.vectors[1] + cell.vectors[2]);
      bool finite = true;
      for (const double number : v) finite = finite && std::isfinite(number);
      if (finite)
        spheres_.cell = cell;
      else
        spheres_.warnings.push_back(unreadable_cell(frame_));
    }
    const Result<std::optional<GsdArray>> step = file_.array(frame_, "configuration/step");
    if (!step) return step.error();
    // A step that is not stated is 0, as the schema says.
    if (!*step) spheres_.step = 0;
    if (*step && (*step)->values.size() == 1 && (*step)->values[0] >= 0 && (*step)->values[0] < 9e15)
      spheres_.step = static_cast<std::int64_t>((*step)->values[0]);
    return Done{};
  }

  const GsdFile& file_;
  std::int64_t frame_;
  RowChunk chunk_;
  std::int64_t rows_ = 0;     // particles of the frame
  std::int64_t count_ = 0;    // of the chunk
  bool is_as_first_ = false;  // as many as in frame 0
  RawSpheres spheres_;
};

class GsdFrames : public RawFrames {
 public:
  explicit GsdFrames(GsdFile file) : file_(std::move(file)) {}
  Result<RawSpheres> read(std::int64_t frame) const override { return read_gsd_frame(file_, frame); }

 private:
  GsdFile file_;
};

Result<std::shared_ptr<const RawFrames>> open_gsd(RandomFile file, const std::string&, const ColumnChoice&) {
  Result<GsdFile> gsd = GsdFile::open(std::move(file));
  if (!gsd) return gsd.error();
  return std::shared_ptr<const RawFrames>(std::make_shared<GsdFrames>(std::move(*gsd)));
}

}  // namespace

Result<RawSpheres> read_gsd_frame(const GsdFile& file, std::int64_t frame, RowChunk chunk) {
  return GsdFrame(file, frame, chunk).read();
}

extern constexpr Format kGsd(
    "GSD", ".gsd", Format::kFrames | Format::kParts,
    [](const FileHead& head) { return GsdFile::looks_like(head.bytes); }, open_gsd,
    "its mark | one frame of the particles of HOOMD-blue | half of the file's diameter, else from distances");

}  // namespace bihive
