// H5MD [H5MD]: particles in groups of HDF5, each array with its own frames.
#include <algorithm>

#include "bihive/io/formats/arrays/particle_layout.h"
#include "bihive/io/text/text_scanner.h"

namespace bihive {
namespace {

constexpr std::string_view kParticles = "/particles/";

// An element of the group: an array that stays, or `value` of a group of that name, over frames.
FramedArray element_of(const ArrayFile& file, const std::string& name) {
  if (const ArrayFacts* const moving = file.find(name + "/value"); moving != nullptr && !moving->lengths.empty())
    return {moving, true, 1};
  if (const ArrayFacts* const fixed = file.find(name)) return {fixed, false, 1};
  return {};
}

std::optional<std::string> unit_of(const ArrayFile& file, const FramedArray& of) {
  return file.text(of.array->name, "unit");
}

// Names under which numbers of LAMMPS dumps and of GSD are kept too.
struct H5mdName {
  const char* of_file;
  const char* name;
  std::vector<std::string> parts;
};
const std::vector<H5mdName>& h5md_names() {
  static const std::vector<H5mdName> names = {{"species", "type", {}},
                                              {"charge", "q", {}},
                                              {"velocity", "velocity", {"vx", "vy", "vz"}},
                                              {"force", "force", {"fx", "fy", "fz"}},
                                              {"image", "image", {"ix", "iy", "iz"}}};
  return names;
}

// A group below /particles that has places.
std::string group_of_particles(const ArrayFile& file) {
  for (const ArrayFacts& array : file.arrays()) {
    if (array.name.rfind(kParticles, 0) != 0) continue;
    const std::size_t end = array.name.find('/', kParticles.size());
    if (end == std::string::npos) continue;
    const std::string rest = array.name.substr(end);
    if (rest == "/position" || rest == "/position/value") return array.name.substr(0, end);
  }
  return "";
}

// When the frames of the places are: arrays, or a step and what comes between (H5MD's fixed steps).
void take_steps(const ArrayFile& file, const std::string& position, ParticleLayout& layout) {
  const ArrayFacts* const step = file.find(position + "/step");
  if (step != nullptr && step->lengths.empty()) {
    if (const Result<std::vector<double>> apart = file.read_all(*step)) layout.steps_apart = apart->front();
    layout.first_step = file.number(step->name, "offset");
  } else if (step != nullptr && step->lengths.size() == 1) {
    layout.step = {step, true, 1};
  }
  const ArrayFacts* const time = file.find(position + "/time");
  if (time == nullptr) return;
  const std::optional<double> unit = picoseconds_of(file.text(time->name, "unit"));
  if (!unit) return;
  if (time->lengths.empty()) {
    if (const Result<std::vector<double>> apart = file.read_all(*time)) layout.time_apart_ps = apart->front() * *unit;
    layout.first_time_ps = file.number(time->name, "offset").value_or(0) * *unit;
  } else if (time->lengths.size() == 1) {
    layout.time_ps = {time, true, *unit};
  }
}

}  // namespace

Result<ParticleLayout> h5md_layout(const ArrayFile& file, const std::string& wanted) {
  const std::string group = wanted.empty() ? group_of_particles(file) : wanted;
  ParticleLayout layout;
  layout.format = "H5MD";
  const std::string position = group + "/position";
  layout.places = element_of(file, position);
  if (group.empty() || !layout.places)
    return Error{"no group of particles with places is in the H5MD file", file.path(), 0, 0, ""};
  const std::vector<std::int64_t> shape = layout.places.lengths();
  if (shape.size() != 2 || (shape[1] != 2 && shape[1] != 3))
    return Error{"the places " + quote(layout.places.array->name) + " are no array of two or three columns",
                 file.path(), 0, 0, ""};
  layout.places.unit = angstrom_of(unit_of(file, layout.places));
  layout.rules.push_back("particles: the group " + printable(group));
  if (layout.places.unit != 1) layout.rules.push_back("lengths: the file's, in Angstrom");

  layout.edges = element_of(file, group + "/box/edges");
  if (layout.edges) {
    const std::vector<std::int64_t> edges = layout.edges.lengths();
    const bool fits = edges == std::vector<std::int64_t>{3} || edges == std::vector<std::int64_t>{3, 3};
    if (!fits) {
      layout.rules.push_back("cell: left out, as its edges are neither three lengths nor three vectors");
      layout.edges = {};
    }
  }
  if (layout.edges) {
    const std::optional<std::string> unit = unit_of(file, layout.edges);
    layout.edges.unit = unit ? angstrom_of(unit) : layout.places.unit;
    const std::vector<std::string> boundary = file.texts(group + "/box", "boundary");
    for (std::size_t k = 0; boundary.size() == 3 && k < 3; ++k) layout.periodic[k] = boundary[k] != "none";
  }
  take_steps(file, position, layout);

  // Everything else of as many particles.
  const std::int64_t count = shape[0];
  for (const ArrayFacts& array : file.arrays()) {
    if (array.name.rfind(group + "/", 0) != 0) continue;
    std::string name = array.name.substr(group.size() + 1);
    const bool moves = name.size() > 6 && name.compare(name.size() - 6, 6, "/value") == 0;
    if (moves) name.resize(name.size() - 6);
    if (name == "position" || name.find('/') != std::string::npos) continue;
    const FramedArray of{&array, moves, 1};
    if (moves && array.lengths.empty()) continue;
    const std::vector<std::int64_t> lengths = of.lengths();
    if (lengths.empty() || lengths.size() > 2 || lengths[0] != count) continue;
    // Arrays with other frames than the places have say when in a way of their own.
    if (moves && (!layout.places.moves || array.lengths[0] != layout.places.array->lengths[0])) continue;
    ParticleColumn column{of, name, {}};
    for (const H5mdName& known : h5md_names())
      if (name == known.of_file) {
        column.name = known.name;
        column.names = known.parts;
      }
    layout.columns.push_back(std::move(column));
  }
  return layout;
}

}  // namespace bihive
