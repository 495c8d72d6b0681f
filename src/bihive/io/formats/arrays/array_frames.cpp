#include "bihive/io/formats/arrays/array_frames.h"

#include <algorithm>
#include <utility>

#include "bihive/base/memory.h"
#include "bihive/io/formats/arrays/array_file.h"
#include "bihive/io/formats/arrays/particle_layout.h"
#include "bihive/io/formats/format.h"
#include "bihive/io/formats/points/named_arrays.h"
#include "bihive/io/text/sphere_table.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

// "group/" and "group" are the same.
std::string bare_name(std::string name) {
  while (!name.empty() && name.back() == '/') name.pop_back();
  return name;
}

Error refusal(const ArrayFile& file, const RefusedArray& array) {
  return {array.what, file.path(), 0, 0, array.hint};
}

// Errors: those of the file; an array that is not read lies in what is asked for.
Result<std::shared_ptr<const ArrayFile>> open_arrays(RandomFile file, const std::string& inside) {
  const Result<std::string> head = file.read(0, std::min<std::int64_t>(8, file.size()));
  if (!head) return head.error();
  const bool is_hdf5 = looks_like_hdf5(*head);
  if (!is_hdf5 && !inside.empty())
    return Error{"names of data sets are for HDF5 files, and this is none: " + quote(inside), file.path(), 0, 0, ""};
  Result<std::shared_ptr<const ArrayFile>> opened = is_hdf5 ? open_hdf5(std::move(file)) : open_netcdf(std::move(file));
  if (!opened) return opened;
  if (const RefusedArray* const array = (*opened)->find_refused(bare_name(inside), true))
    return refusal(**opened, *array);
  return opened;
}

// The arrays in what is asked for that were never written: " /a /b".
std::string unwritten_arrays(const ArrayFile& file, const std::string& name) {
  constexpr std::size_t kReadable = 200;
  std::string names;
  for (const RefusedArray& array : file.refused())
    if (names.size() < kReadable && !array.is_fault && array.name.rfind(name + "/", 0) == 0)
      names += " " + printable(array.name);
  return names;
}

bool is_amber(const ArrayFile& file) {
  return file.text("/", "Conventions").value_or("").find("AMBER") != std::string::npos;
}

// Whether a group, or any (an empty name), holds places of H5MD.
bool is_h5md(const ArrayFile& file, const std::string& group) {
  return std::any_of(file.arrays().begin(), file.arrays().end(), [&](const ArrayFacts& array) {
    if (!group.empty()) return array.name == group + "/position" || array.name == group + "/position/value";
    return array.name.rfind("/particles/", 0) == 0 &&
           (array.name.ends_with("/position") || array.name.ends_with("/position/value"));
  });
}

std::string shape_of(const ArrayFacts& array) {
  std::string text;
  for (const std::int64_t length : array.lengths) text += (text.empty() ? "" : " x ") + std::to_string(length);
  return array.name + " (" + (text.empty() ? "one number" : text) + ")";
}

std::string list_of_arrays(const ArrayFile& file) {
  constexpr std::size_t kReadable = 200;
  std::string list;
  for (const ArrayFacts& array : file.arrays())
    if (list.size() < kReadable) list += (list.empty() ? "" : ", ") + printable(shape_of(array));
  return list.empty() ? "it has none of numbers" : "it has " + list;
}

class ParticleFrames : public RawFrames {
 public:
  ParticleFrames(std::shared_ptr<const ArrayFile> file, ParticleLayout layout, ColumnChoice choice)
      : file_(std::move(file)), layout_(std::move(layout)), choice_(std::move(choice)) {}

  Result<RawSpheres> read(std::int64_t frame) const override {
    const std::int64_t frames = frame_count(layout_);
    if (frame < 0 || frame >= frames) return no_such_frame(file_->path(), frame, frames);
    return read_particles(*file_, layout_, frame, choice_);
  }

 private:
  std::shared_ptr<const ArrayFile> file_;
  ParticleLayout layout_;
  ColumnChoice choice_;
};

class ArrayTrajectory : public Trajectory {
 public:
  ArrayTrajectory(std::shared_ptr<const ArrayFile> file, ParticleLayout layout)
      : file_(std::move(file)), layout_(std::move(layout)) {
    for (const std::string& warning : layout_.warnings) warn(warning);
  }

  std::string format() const override { return layout_.format; }
  std::int64_t frame_count() const override { return bihive::frame_count(layout_); }
  std::int64_t sphere_count() const override { return particle_count(layout_); }
  Result<TrajectoryFrame> read(std::int64_t frame) const override {
    if (frame < 0 || frame >= frame_count()) return no_such_frame(file_->path(), frame, frame_count());
    return read_places(*file_, layout_, frame);
  }

 private:
  std::shared_ptr<const ArrayFile> file_;
  ParticleLayout layout_;
};

// Data sets that no convention names: columns, or one array of places. Those of three dimensions have frames.
class DataSetFrames : public RawFrames {
 public:
  DataSetFrames(std::shared_ptr<const ArrayFile> file, std::vector<ArrayFacts> sets, ColumnChoice choice,
                std::string unwritten)
      : file_(std::move(file)), sets_(std::move(sets)), choice_(std::move(choice)), unwritten_(std::move(unwritten)) {
    for (const ArrayFacts& set : sets_)
      if (set.lengths.size() == 3 && frames_ == 1) frames_ = set.lengths[0];
  }

  Result<RawSpheres> read(std::int64_t frame) const override {
    if (frame < 0 || frame >= frames_) return no_such_frame(file_->path(), frame, frames_);
    double total = 0;
    NamedArrays all{"HDF5", {}, unwritten_, "name one: FILE:/GROUP/NAME; " + list_of_arrays(*file_)};
    for (const ArrayFacts& set : sets_) {
      const bool moves = set.lengths.size() == 3;
      std::vector<std::int64_t> begin(set.lengths.size(), 0), lengths = set.lengths;
      if (moves) {
        if (frame >= lengths[0]) {
          all.left_out += " " + set.name;
          continue;
        }
        begin[0] = frame;
        lengths[0] = 1;
      }
      Result<std::vector<double>> values = file_->read(set, begin, lengths);
      if (!values) return values.error();
      total += static_cast<double>(values->size() * sizeof(double));
      if (Status status = check_memory(total, "its data sets"); !status)
        return Error{status.error().message, file_->path(), 0, 0, "name those that are wanted: FILE:/GROUP/NAME"};
      if (moves) lengths.erase(lengths.begin());
      all.arrays.push_back({set.name.substr(set.name.rfind('/') + 1), std::move(lengths), std::move(*values)});
    }
    Result<RawSpheres> spheres = spheres_of_named_arrays(all, file_->path(), choice_);
    if (spheres) spheres->frames = frames_;
    return spheres;
  }

 private:
  std::shared_ptr<const ArrayFile> file_;
  std::vector<ArrayFacts> sets_;
  ColumnChoice choice_;
  std::string unwritten_;  // arrays that are left out
  std::int64_t frames_ = 1;
};

// The data sets of one to three dimensions directly in a group.
std::vector<ArrayFacts> sets_in(const ArrayFile& file, const std::string& group) {
  std::vector<ArrayFacts> sets;
  for (const ArrayFacts& array : file.arrays()) {
    if (array.name.rfind(group + "/", 0) != 0 || array.name.find('/', group.size() + 1) != std::string::npos) continue;
    if (!array.lengths.empty() && array.lengths.size() <= 3) sets.push_back(array);
  }
  return sets;
}

Result<std::vector<ArrayFacts>> chosen_sets(const ArrayFile& file, const std::string& inside) {
  if (const ArrayFacts* const set = file.find(inside)) {
    if (set->lengths.size() < 2 || set->lengths.size() > 3)
      return Error{
          "the data set " + quote(shape_of(*set)) + " has no rows of places", file.path(), 0, 0,
          "two dimensions are places, three are frames of places; name the group to take its data sets as columns"};
    return std::vector<ArrayFacts>{*set};
  }
  std::vector<ArrayFacts> sets = sets_in(file, inside);
  if (sets.empty() && inside.empty() && file.arrays().size() == 1) return chosen_sets(file, file.arrays().front().name);
  if (!sets.empty()) return sets;
  const std::string what = inside.empty() ? "the HDF5 file has no data sets in its first group"
                                          : "there is no data set and no group of data sets " + quote(inside);
  return Error{what, file.path(), 0, 0, "name one: FILE:/GROUP/NAME; " + list_of_arrays(file)};
}

// Places alone, as a trajectory has them.
bool lacks_atoms(const ParticleLayout& layout) {
  return std::all_of(layout.columns.begin(), layout.columns.end(), [](const ParticleColumn& column) {
    return column.name == "velocities" || column.name == "forces";
  });
}

// The reason why nothing is found where arrays that were never written are named.
Error or_unwritten(const ArrayFile& file, const std::string& name, const Error& error) {
  const RefusedArray* const array = file.find_refused(name, false);
  return array == nullptr ? error : refusal(file, *array);
}

// The frames of what is asked for: particles of a convention, or data sets.
Result<std::shared_ptr<const RawFrames>> frames_of(const std::shared_ptr<const ArrayFile>& file,
                                                   const std::string& name, const ColumnChoice& choice) {
  const bool is_hdf5 = file->arrays().empty() || file->arrays().front().name[0] == '/';
  const std::string unwritten = unwritten_arrays(*file, name);
  const auto particles = [&](Result<ParticleLayout> layout) -> Result<std::shared_ptr<const RawFrames>> {
    if (!layout) return layout.error();
    if (!unwritten.empty()) layout->rules.push_back("arrays that were never written are left out:" + unwritten);
    return std::shared_ptr<const RawFrames>(std::make_shared<ParticleFrames>(file, std::move(*layout), choice));
  };
  if (is_h5md(*file, name)) return particles(h5md_layout(*file, name));
  if (name.empty() && (!is_hdf5 || is_amber(*file))) {
    Result<ParticleLayout> layout = amber_layout(*file);
    if (layout && lacks_atoms(*layout))
      return Error{"this is a trajectory of AMBER (NetCDF), which is read only together with a file of its atoms",
                   file->path(), 0, 0, "give that file first, as in 'bihive render ATOMS.pdb FILE'"};
    return particles(std::move(layout));
  }
  Result<std::vector<ArrayFacts>> sets = chosen_sets(*file, name);
  if (!sets) return sets.error();
  return std::shared_ptr<const RawFrames>(std::make_shared<DataSetFrames>(file, std::move(*sets), choice, unwritten));
}

}  // namespace

Result<std::shared_ptr<const RawFrames>> open_array_frames(RandomFile file, const std::string& inside,
                                                           const ColumnChoice& choice) {
  const Result<std::shared_ptr<const ArrayFile>> arrays = open_arrays(std::move(file), inside);
  if (!arrays) return arrays.error();
  const std::string name = bare_name(inside);
  Result<std::shared_ptr<const RawFrames>> frames = frames_of(*arrays, name, choice);
  if (!frames) return or_unwritten(**arrays, name, frames.error());
  return frames;
}

std::optional<std::int64_t> particles_in_chunks(RandomFile file) {
  const Result<std::string> head = file.read(0, std::min<std::int64_t>(8, file.size()));
  if (!head || !looks_like_hdf5(*head)) return std::nullopt;
  const Result<std::shared_ptr<const ArrayFile>> arrays = open_arrays(std::move(file), "");
  if (!arrays || !is_h5md(**arrays, "")) return std::nullopt;
  const Result<ParticleLayout> layout = h5md_layout(**arrays, "");
  if (!layout || bihive::frame_count(*layout) < 1) return std::nullopt;
  for (const ParticleColumn& column : layout->columns)
    if (needs_all_rows(usual_role(column.name)) || !(*arrays)->labels(*column.of.array).empty()) return std::nullopt;
  return particle_count(*layout);
}

Result<RawSpheres> chunk_of_arrays(RandomFile file, RowChunk chunk) {
  const Result<std::shared_ptr<const ArrayFile>> arrays = open_arrays(std::move(file), "");
  if (!arrays) return arrays.error();
  const Result<ParticleLayout> layout = h5md_layout(**arrays, "");
  if (!layout) return layout.error();
  return read_particles(**arrays, *layout, 0, ColumnChoice{}, chunk);
}

Result<std::shared_ptr<const Trajectory>> open_array_trajectory(RandomFile file, const std::string& inside) {
  const Result<std::shared_ptr<const ArrayFile>> arrays = open_arrays(std::move(file), inside);
  if (!arrays) return arrays.error();
  const std::string name = bare_name(inside);
  Result<ParticleLayout> layout = is_h5md(**arrays, name) ? h5md_layout(**arrays, name) : amber_layout(**arrays);
  if (!layout) return or_unwritten(**arrays, name, layout.error());
  return std::shared_ptr<const Trajectory>(std::make_shared<ArrayTrajectory>(*arrays, std::move(*layout)));
}

extern constexpr Format kHdf5(
    "HDF5", ".h5 .hdf5 .h5md", Format::kFrames | Format::kColumns | Format::kParts | Format::kDataSets,
    [](const FileHead& head) { return looks_like_hdf5(head.bytes); }, open_array_frames,
    "its mark | data sets by name; H5MD: one frame of its particles | r, radius or diameter, else by element, else "
    "from distances");

extern constexpr Format kNetcdf(
    "NetCDF", ".nc .ncdf", Format::kFrames | Format::kColumns | Format::kDataSets,
    [](const FileHead& head) { return looks_like_netcdf(head.bytes); }, open_array_frames,
    "its mark | one frame of LAMMPS, or of AMBER beside its atoms | radius, else from distances");

extern constexpr TrajectoryFormat kH5mdTrajectory = {
    .name = "H5MD", .recognise = looks_like_hdf5, .open = open_array_trajectory};
extern constexpr TrajectoryFormat kAmberTrajectory = {
    .name = "NetCDF of AMBER", .recognise = looks_like_netcdf, .open = open_array_trajectory};

}  // namespace bihive
