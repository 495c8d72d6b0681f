#include "bihive/io/reading_settings.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/setting_name.h"
#include "bihive/io/cell_options.h"
#include "bihive/io/known_formats.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

constexpr double kLargestFloat = std::numeric_limits<float>::max();

// Puts a result, or gives its error.
template <class T, class Target>
Status put(Result<T> value, Target& target) {
  if (!value) return value.error();
  target = std::move(*value);
  return Done{};
}

// Bytes that are no UTF-8 become marks of replacement, as in reports.
std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json vector_json(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

ordered_json vectors_json(const std::array<Vec3d, 3>& vectors) {
  ordered_json json = ordered_json::array();
  for (const Vec3d& v : vectors) json.push_back(vector_json(v));
  return json;
}

// From 0, or less than 0 from the end.
Result<std::int64_t> frame_from_text(const std::string& text) {
  const std::optional<std::int64_t> frame = parse_int(text);
  if (!frame) return unexpected("a whole number", text);
  return *frame;
}

Result<std::int64_t> frames_of_mean(const std::string& text) {
  constexpr std::int64_t kMost = 9999;
  const Result<std::int64_t> frames = whole_number_from_text(text, 1, kMost);
  if (frames && *frames % 2 == 0)
    return Error{"expected an odd number, found " + text, "", 0, 0, "the frame is in the middle"};
  return frames;
}

bool excludes(const ReadingSetting& one, const ReadingSetting& other) {
  return std::find(one.excludes.begin(), one.excludes.end(), other.id) != one.excludes.end();
}

Status take_assembly(ReadOptions& options, const std::string& text) {
  if (text.empty()) return Error{"expected the id of an assembly, found an empty text", "", 0, 0, ""};
  options.assembly = text;
  return Done{};
}

std::vector<ReadingSetting> make_rows() {
  return {
      {.id = "radius",
       .value_name = "R",
       .help = "Radius of every sphere (scenarios: 1)",
       .inputs = "the scenarios and files",
       .with_chunks = true,
       .label = "Radius",
       .empty_means = "the file’s own",
       .shown_for = ReadingOf::scenarios_and_files,
       .is_number = true,
       .take = [](ReadOptions& o,
                  const std::string& text) { return put(number_from_text(text, 0, kLargestFloat), o.radius); },
       .value = [](const ReadOptions& o) { return text_of(*o.radius); }},
      {.id = "radius_scale",
       .value_name = "F",
       .help = "Files: multiply every radius",
       .with_chunks = true,
       .label = "Radius ×",
       .empty_means = "1",
       .is_number = true,
       .take = [](ReadOptions& o,
                  const std::string& text) { return put(number_from_text(text, 0, kLargestFloat), o.radius_scale); },
       .value = [](const ReadOptions& o) { return text_of(o.radius_scale); }},
      {.id = "frame",
       .value_name = "N",
       .help = "Files: which frame or model, from 0; -1 is the last (0)",
       .with_chunks = true,
       .take = [](ReadOptions& o, const std::string& text) { return put(frame_from_text(text), o.frame); },
       .value = [](const ReadOptions& o) { return text_of(o.frame); }},
      {.id = "trajectory",
       .value_name = "FILE",
       .help =
           "Files: coordinates of the same spheres per frame (" + names_of_formats(FormatsThat::are_trajectories) + ")",
       .take = [](ReadOptions& o, const std::string& text) { return put(Result<std::string>(text), o.trajectory); },
       .value = [](const ReadOptions& o) { return text_of(o.trajectory); }},
      {.id = "smooth",
       .value_name = "N",
       .help = "Files with frames: means of coordinates over N frames, an odd number, with the frame in the middle",
       .label = "Mean of frames",
       .empty_means = "1",
       .shown_for = ReadingOf::frames,
       .is_number = true,
       .take = [](ReadOptions& o, const std::string& text) { return put(frames_of_mean(text), o.smooth); },
       .value = [](const ReadOptions& o) { return text_of(o.smooth); }},
      {.id = "recenter",
       .help = "Files: move the middle of the set to the origin",
       .with_chunks = true,
       .take = [](ReadOptions& o, const std::string&) { return put(Result<bool>(true), o.recenter); },
       .value = [](const ReadOptions& o) { return text_of(o.recenter); }},
      {.id = "assembly",
       .value_name = "ID",
       .help = "PDB, mmCIF: copy the chains as this biological assembly says, e.g. 1; bihive info lists them",
       .inputs = "PDB and mmCIF files",
       .label = "Assembly",
       .empty_means = "the chains as they are",
       .shown_for = ReadingOf::molecules,
       .take = take_assembly,
       .value = [](const ReadOptions& o) { return text_of(o.assembly); }},
      {.id = "columns",
       .value_name = "PART=COLUMN,...",
       .help = names_of_formats(FormatsThat::have_columns) + ": columns by name or position, e.g. x=px,y=py,z=pz,r=5",
       .label = "Columns",
       .empty_means = "x=px,y=py,z=pz,r=5",
       .take = [](ReadOptions& o, const std::string& text) { return put(columns_from_text(text), o.columns); },
       .value = [](const ReadOptions& o) { return text_of(o.columns); }},
      {.id = "replicate",
       .value_name = "AxBxC",
       .help = "Files: this many copies along the vectors of the periodic cell",
       .take = [](ReadOptions& o, const std::string& text) { return put(copies_from_text(text), o.replicate); },
       .value = [](const ReadOptions& o) { return text_of(o.replicate); }},
      {.id = "cell_vectors",
       .value_name = "AX,AY,AZ,BX...",
       .help = "Files: the three vectors of the cell (the file's)",
       .take = [](ReadOptions& o,
                  const std::string& text) { return put(cell_vectors_from_text(text), o.cell_vectors); },
       .value = [](const ReadOptions& o) { return text_of(vectors_json(*o.cell_vectors)); }},
      {.id = "cell_origin",
       .value_name = "X,Y,Z",
       .help = "Files: the corner of the cell (the file's, else 0,0,0)",
       .take = [](ReadOptions& o, const std::string& text) { return put(cell_origin_from_text(text), o.cell_origin); },
       .value = [](const ReadOptions& o) { return text_of(vector_json(*o.cell_origin)); }},
      {.id = "periodic",
       .help = "Files: distances see the images of the periodic cell (usual); bihive trace and measure too",
       .with_chunks = true,
       .take =
           [](ReadOptions& o, const std::string&) {
             o.exposed_area_periodic = true;
             return put(Result<bool>(true), o.periodic);
           },
       .value = [](const ReadOptions& o) { return text_of(o.periodic); }},
      {.id = "no_periodic",
       .help = "Files: distances see the spheres alone, without images",
       .with_chunks = true,
       .excludes = {"periodic"},
       .take = [](ReadOptions& o, const std::string&) { return put(Result<bool>(false), o.periodic); },
       .report = "periodic",
       .value = [](const ReadOptions& o) { return text_of(o.periodic); }},
      {.id = "wrap",
       .help = "Files: move every centre into the cell",
       .label = "Every centre into the cell",
       .shown_for = ReadingOf::cells,
       .take = [](ReadOptions& o, const std::string&) { return put(Result<Wrapping>(Wrapping::wrap), o.wrapping); },
       .report = "wrapping",
       .value = [](const ReadOptions&) { return text_of("wrap"); }},
      {.id = "wrap_molecules",
       .help = "Files: bring molecules together, and move each into the cell as a whole; also as the value molecules "
               "of wrap",
       .excludes = {"wrap"},
       .label = "Molecules whole, in the cell",
       .shown_for = ReadingOf::cells,
       .take = [](ReadOptions& o,
                  const std::string&) { return put(Result<Wrapping>(Wrapping::wrap_molecules), o.wrapping); },
       .report = "wrapping",
       .value = [](const ReadOptions&) { return text_of("wrap_molecules"); }},
      {.id = "unwrap",
       .help = "Files: bring together what belongs together, by the columns ix, iy, iz, else by mol, bonds or residues",
       .excludes = {"wrap", "wrap_molecules"},
       .label = "Molecules whole",
       .shown_for = ReadingOf::cells,
       .take = [](ReadOptions& o, const std::string&) { return put(Result<Wrapping>(Wrapping::unwrap), o.wrapping); },
       .report = "wrapping",
       .value = [](const ReadOptions&) { return text_of("unwrap"); }},
      {.id = "exposed_area",
       .value_name = "R",
       .help = "Files: add the column exposed_area, the surface of each sphere that a probe of radius R reaches",
       .label = "Exposed area by probe",
       .empty_means = "not measured",
       .is_number = true,
       .take = [](ReadOptions& o,
                  const std::string& text) { return put(number_from_text(text, 0, kLargestFloat), o.exposed_area); },
       .value = [](const ReadOptions& o) { return text_of(*o.exposed_area); }},
  };
}

}  // namespace

std::span<const ReadingSetting> reading_settings() {
  static const std::vector<ReadingSetting> kRows = make_rows();
  return kRows;
}

std::string reading_settings_to_json() {
  ordered_json rows = ordered_json::array();
  for (const ReadingSetting& row : reading_settings())
    rows.push_back({{"id", row.id},
                    {"option", option_of_setting(row.id)},
                    {"value", row.value_name},
                    {"help", row.help},
                    {"inputs", row.inputs},
                    {"with_chunks", row.with_chunks}});
  return text_of(rows);
}

const ReadingSetting* reading_setting(std::string_view id) {
  for (const ReadingSetting& row : reading_settings())
    if (row.id == id) return &row;
  return nullptr;
}

Status GivenReading::take(std::string_view id, const std::string& text) {
  if (id == "wrap" && text == "molecules") return take("wrap_molecules", "");
  const ReadingSetting* const row = reading_setting(id);
  if (row == nullptr) return Error{"there is no setting of reading \"" + std::string(id) + "\"", "", 0, 0, ""};
  if (row->value_name.empty() && !text.empty() && text != "true")
    return unexpected("no value, or true", text, "leave it out to switch it off");
  if (has(id)) return Error{"is given more than once", "", 0, 0, ""};
  for (const auto& [other, value] : given_)
    if (excludes(*other, *row) || excludes(*row, *other))
      return Error{"excludes " + setting_name(other->id), "", 0, 0, "leave one of them out"};
  if (Status status = row->take(options_, text); !status) return status;
  const auto after = [](const auto& one, const ReadingSetting* other) { return one.first < other; };
  given_.insert(std::lower_bound(given_.begin(), given_.end(), row, after), {row, text});
  return Done{};
}

void GivenReading::set_frame(std::int64_t frame) {
  std::erase_if(given_, [](const auto& one) { return one.first->id == "frame"; });
  options_.frame = 0;
  if (frame < 0) return;
  const Status taken = take("frame", std::to_string(frame));
  BIHIVE_CHECK(taken.ok());
}

bool GivenReading::has(std::string_view id) const {
  return std::any_of(given_.begin(), given_.end(), [id](const auto& one) { return one.first->id == id; });
}

std::vector<std::pair<const ReadingSetting*, std::string>> GivenReading::all() const {
  return given_;
}

std::string reading_to_json(const GivenReading& given) {
  ordered_json json = ordered_json::object();
  for (const auto& [row, text] : given.all()) json[std::string(row->id)] = text;
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::ignore);
}

Result<GivenReading> reading_from_json(std::string_view text) {
  const Result<ordered_json> json = json_from_text<ordered_json>(text);
  if (!json) return json.error();
  if (!json->is_object()) return Error{"expected an object of settings of reading", "", 0, 0, ""};
  GivenReading given;
  for (const auto& [id, value] : json->items()) {
    Status status = given.take(id, value.is_string() ? value.get<std::string>() : value.dump());
    if (!status) return Error{setting_name(id) + ": " + status.error().message, "", 0, 0, status.error().hint};
  }
  return given;
}

}  // namespace bihive
