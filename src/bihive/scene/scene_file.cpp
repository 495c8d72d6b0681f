#include "bihive/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "bihive/base/setting_name.h"
#include "bihive/image/colour_text.h"
#include "bihive/io/assemble/finish.h"
#include "bihive/io/data_path.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/default_colours.h"
#include "bihive/scene/focus.h"
#include "bihive/scene/json_parts.h"
#include "bihive/scene/look_json.h"
#include "bihive/scene/scene_json.h"
#include "bihive/scene/show_density.h"
#include "bihive/settings/check_picture.h"
#include "bihive/settings/parameter_json.h"

namespace bihive {
namespace {

using nlohmann::json;

// Turns a document that the schema accepts into a scene. `error` keeps the first fault that a schema cannot see;
// everything after it does not matter.
class Extraction {
 public:
  Extraction(const json& document, const std::string& name, const ReadOptions& options, LooksOfFile looks,
             const Style* style)
      : document_(document), name_(name), options_(options), looks_(looks), style_(style) {
    if (style == nullptr) return;
    apply_style(*style, loaded_.scene);
    loaded_.rig = style->lights;
  }

  Result<LoadedScene> run() {
    Scene& scene = loaded_.scene;
    scene.name = document_.value("name", name_);
    take_seed();
    take_picture();
    take_materials();
    take_camera();
    take_lights();
    take_plane();
    take_clips();
    if (document_.contains("background")) scene.background = colour(document_.at("background"));
    if (document_.contains("ambient_light")) {
      need_version(2, "/ambient_light");
      scene.ambient_light = colour(document_.at("ambient_light"));
    }
    if (failed_.message.empty()) take_spheres();
    if (failed_.message.empty() && style_ != nullptr && !document_.contains("materials"))
      take_density(loaded_, *style_);
    if (failed_.message.empty()) take_focus();
    if (failed_.message.empty()) take_looks();
    if (!failed_.message.empty()) return failed_;
    return std::move(loaded_);
  }

 private:
  void fail(const std::string& pointer, const std::string& what, const std::string& hint = "") {
    if (failed_.message.empty()) failed_ = Error{pointer + ": " + what, name_, 0, 0, hint};
  }

  static Vec3d vector(const json& value) { return vector_from_json(value); }

  Vec3d colour(const json& value) const { return colour_from_json(value, loaded_.scene.picture.transfer); }

  // A key introduced by a later version of the format.
  void need_version(int version, const std::string& pointer) {
    if (document_.at("bihive_scene").get<int>() < version)
      fail(pointer,
           fmt::format("expected no such key in version {} of the format", document_.at("bihive_scene").get<int>()),
           fmt::format("write \"bihive_scene\": {}", version));
  }

  void take_seed() {
    if (!document_.contains("seed")) return;
    const json& value = document_.at("seed");
    if (value.is_number_unsigned())
      loaded_.scene.seed = value.get<std::uint64_t>();
    else
      fail("/seed", "expected a whole number from 0 to 18446744073709551615, found " + value.dump());
  }

  // The picture comes first, because a text colour depends on its transfer.
  void take_picture() {
    if (!document_.contains("picture")) return;
    const json& value = document_.at("picture");
    loaded_.states_fog = value.contains("fog");
    const std::string newer = newer_key(value, document_.at("bihive_scene").get<int>());
    if (!newer.empty()) need_version(2, "/picture/" + newer);
    PictureSettings& picture = loaded_.scene.picture;
    bihive::take_picture(value, picture);
    if (!check_picture(picture)) fail("/picture/fog", "the start of the fog is not before its end");
  }

  Material material(const json& value, const std::string& pointer) {
    for (const char* key : {"tint", "bands", "glow"})
      if (value.contains(key)) need_version(2, pointer + "/" + key);
    Material made = matte_material();
    take_material(value, loaded_.scene.picture.transfer, made);
    if (made.transmissive > 0 && !(made.refraction_index > 0))
      fail(pointer + "/refraction_index", "expected a number above 0, because transmissive is above 0, found 0");
    return made;
  }

  void take_materials() {
    if (!document_.contains("materials")) return;
    const json& values = document_.at("materials");
    std::vector<Material>& materials = loaded_.scene.materials;
    materials.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string pointer = "/materials/" + std::to_string(i);
      const std::string& material_name = values[i].at("name").get_ref<const std::string&>();
      if (!position_of_material_.emplace(material_name, static_cast<std::int32_t>(i)).second)
        fail(pointer + "/name", "another material is called \"" + material_name + "\" too");
      materials.push_back(material(values[i], pointer));
    }
  }

  // A material's position from its name or its position.
  std::int32_t material_position(const json& value, const std::string& pointer) {
    const std::size_t count = loaded_.scene.materials.size();
    if (value.is_string()) {
      const auto known = position_of_material_.find(value.get_ref<const std::string&>());
      if (known != position_of_material_.end()) return known->second;
      fail(pointer, "no material is called \"" + value.get<std::string>() + "\"", known_materials());
    } else if (value.get<std::uint64_t>() < count) {
      return value.get<std::int32_t>();
    } else {
      fail(pointer,
           "expected a material's position from 0 to " + std::to_string(count - 1) + ", found " + value.dump());
    }
    return 0;
  }

  std::string known_materials() const {
    constexpr std::size_t kMost = 12;
    std::string names;
    for (const auto& [known, position] : position_of_material_) {
      if (static_cast<std::size_t>(std::count(names.begin(), names.end(), ',')) + 1 == kMost) return names + ", ...";
      names += (names.empty() ? "known materials: " : ", ") + known;
    }
    return names.empty() ? "the document has no materials" : names;
  }

  void take_camera() {
    loaded_.has_camera = document_.contains("camera");
    if (!loaded_.has_camera) return;
    const json& value = document_.at("camera");
    Camera& camera = loaded_.scene.camera;
    camera.eye = vector(value.at("eye"));
    camera.look_at = vector(value.at("look_at"));
    if (value.contains("up")) camera.up = vector(value.at("up"));
    camera.fov_deg = value.value("fov_deg", camera.fov_deg);
    take_projection(value, camera);
    for (const char* key : {"aperture", "focus"})
      if (value.contains(key)) need_version(2, std::string("/camera/") + key);
    camera.aperture = value.value("aperture", camera.aperture);
    if (value.contains("focus") && value.at("focus").is_number()) camera.focus = value.at("focus").get<double>();
    const Status status = check_camera(camera);
    if (status) return;
    // The path already names the camera.
    const std::string& what = status.error().message;
    const std::size_t colon = what.rfind("camera: ", 0) == 0 ? std::string_view("camera: ").size() : 0;
    fail("/camera", what.substr(colon), status.error().hint);
  }

  // Without a shorter side, the picture shows as much at look_at as the angle would.
  void take_projection(const json& value, Camera& camera) {
    for (const char* key : {"projection", "shorter_side"})
      if (value.contains(key)) need_version(2, std::string("/camera/") + key);
    const bool parallel = value.value("projection", std::string("perspective")) == "orthographic";
    if (value.contains("shorter_side")) {
      if (!parallel) return fail("/camera/shorter_side", "expected no such key without the projection orthographic");
      camera.shorter_side = value.at("shorter_side").get<double>();
      camera.projection = Projection::orthographic;
    } else if (parallel) {
      camera = with_projection(camera, Projection::orthographic);
    }
  }

  void take_lights() {
    loaded_.has_lights = document_.contains("lights");
    if (!loaded_.has_lights) return;
    for (const json& value : document_.at("lights")) {
      PointLight light{vector(value.at("position"))};
      if (value.contains("colour")) light.colour = colour(value.at("colour"));
      if (value.contains("radius")) {
        need_version(2, fmt::format("/lights/{}/radius", loaded_.scene.lights.size()));
        light.radius = value.at("radius").get<double>();
      }
      loaded_.scene.lights.push_back(light);
    }
  }

  void take_plane() {
    if (!document_.contains("plane")) return;
    const json& value = document_.at("plane");
    ScenePlane plane;
    plane.plane.point = vector(value.at("point"));
    // Scale the normal by its largest component first, so that its length neither overflows nor underflows.
    Vec3d normal = vector(value.at("normal"));
    const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (largest == 0) return fail("/plane/normal", "expected a vector of a length above 0, found [0, 0, 0]");
    // A normal of length 1 up to rounding stays as it is, so that a written scene reads as the same scene.
    const bool unit = std::abs(dot(normal, normal) - 1) < 1e-15;
    plane.plane.normal = unit ? normal : normalized(normal / largest);
    plane.material = loaded_.scene.materials.front();
    if (value.contains("material")) {
      const json& described = value.at("material");
      const std::string pointer = "/plane/material";
      if (described.is_object())
        plane.material = material(described, pointer);
      else
        plane.material = loaded_.scene.materials[static_cast<std::size_t>(material_position(described, pointer))];
    }
    if (value.contains("checker")) {
      const json& described = value.at("checker");
      Checker checker;
      checker.size = described.at("size").get<double>();
      checker.second_colour = colour(described.at("second_colour"));
      checker.fade_distance = described.value("fade_distance", checker.fade_distance);
      plane.checker = checker;
    }
    if (value.contains("shadows_only")) {
      need_version(2, "/plane/shadows_only");
      plane.shadows_only = value.at("shadows_only").get<bool>();
    }
    loaded_.scene.plane = plane;
  }

  void take_clips() {
    if (!document_.contains("clips")) return;
    need_version(2, "/clips");
    for (const json& value : document_.at("clips")) {
      loaded_.scene.clips.push_back(clip_from_json(value));
      check_clip(loaded_.scene.clips.back(), "/clips/" + std::to_string(loaded_.scene.clips.size() - 1));
    }
  }

  void check_clip(const Clip& clip, const std::string& pointer) {
    if (const Status status = bihive::check_clip(clip); !status) fail(pointer, status.error().message);
  }

  // The bits of a sphere's clips, from their positions.
  std::uint64_t clips_of_sphere(const json& positions, const std::string& pointer) {
    std::uint64_t bits = 0;
    for (const json& value : positions) {
      const auto position = value.get<std::uint64_t>();
      if (position < loaded_.scene.clips.size())
        bits |= std::uint64_t{1} << position;
      else
        fail(pointer, fmt::format("there is no clip {}, because `clips` has {}", position, loaded_.scene.clips.size()));
    }
    return bits;
  }

  // The document's cell and copies apply unless the caller's options state others.
  void take_cell(ReadOptions& options) {
    for (const char* key : {"cell", "replicate", "wrapping"})
      if (document_.contains(key)) need_version(2, std::string("/") + key);
    if (document_.contains("cell")) {
      const json& cell = document_.at("cell");
      const json& vectors = cell.at("vectors");
      if (!options.cell_vectors)
        options.cell_vectors = {vector(vectors.at(0)), vector(vectors.at(1)), vector(vectors.at(2))};
      if (!options.cell_origin && cell.contains("origin")) options.cell_origin = vector(cell.at("origin"));
      if (cell.contains("periodic")) options.cell_periodic = cell.at("periodic").get<std::array<bool, 3>>();
    }
    if (document_.contains("replicate") && options.replicate == ReadOptions().replicate)
      options.replicate = document_.at("replicate").get<std::array<std::int32_t, 3>>();
    if (document_.contains("wrapping") && options.wrapping == Wrapping::none) {
      const json& wrapping = document_.at("wrapping");
      options.wrapping = wrapping == "wrap"             ? Wrapping::wrap
                         : wrapping == "wrap_molecules" ? Wrapping::wrap_molecules
                                                        : Wrapping::unwrap;
    }
  }

  void take_spheres() {
    const json& value = document_.at("spheres");
    if (value.is_array())
      take_inline_spheres(value);
    else
      take_sphere_file(value);
  }

  void take_inline_spheres(const json& values) {
    if (options_.frame != 0)
      return fail("/spheres",
                  "there is no frame " + std::to_string(options_.frame) + ": the spheres are in the document");
    if (!options_.trajectory.empty())
      return fail("/spheres", "a trajectory moves the spheres of a file, and these are in the document");
    if (!options_.assembly.empty())
      return fail("/spheres", "there is no assembly \"" + options_.assembly + "\": the spheres are in the document");
    if (!options_.columns.empty())
      return fail("/spheres", "there are no columns to choose: the spheres are in the document");
    // Fill the arrays. A sphere without colour, opacity or material gets the default.
    const std::size_t n = values.size();
    RawSpheres raw;
    raw.format = "scene file";
    for (std::vector<double>* numbers : {&raw.x, &raw.y, &raw.z, &raw.r}) numbers->resize(n);
    std::vector<std::int32_t> materials(n, 0);
    std::vector<Vec3f>& colours = raw.attributes.colour;
    std::vector<float>& opacities = raw.attributes.opacity;
    std::vector<bool> coloured(n, false);
    for (std::size_t i = 0; i < n; ++i) {
      const json& value = values[i];
      const bool plain = value.is_array();
      const json& centre = plain ? value : value.at("centre");
      raw.x[i] = centre.at(0).get<double>();
      raw.y[i] = centre.at(1).get<double>();
      raw.z[i] = centre.at(2).get<double>();
      raw.r[i] = (plain ? value.at(3) : value.at("radius")).get<double>();
      const std::string pointer = "/spheres/" + std::to_string(i);
      if (plain && value.size() > 4) materials[i] = material_position(value.at(4), pointer + "/4");
      if (plain) continue;
      if (value.contains("material")) materials[i] = material_position(value.at("material"), pointer + "/material");
      if (value.contains("colour")) {
        colours.resize(n);
        colours[i] = to_float(colour(value.at("colour")));
        coloured[i] = true;
      }
      if (value.contains("opacity")) {
        opacities.resize(n, 1.0f);
        opacities[i] = value.at("opacity").get<float>();
      }
      if (value.contains("outline")) {
        need_version(2, pointer + "/outline");
        raw.attributes.outline_px.resize(n, -1.0f);
        raw.attributes.outline_px[i] = value.at("outline").get<float>();
      }
      if (value.contains("crease")) {
        need_version(2, pointer + "/crease");
        raw.attributes.crease.resize(n, 0);
        raw.attributes.crease[i] = value.at("crease").get<std::int32_t>();
      }
      if (value.contains("clips")) {
        need_version(2, pointer + "/clips");
        raw.attributes.clips.resize(n, 0);
        raw.attributes.clips[i] = clips_of_sphere(value.at("clips"), pointer + "/clips");
      }
    }
    if (!failed_.message.empty()) return;
    for (std::size_t i = 0; i < colours.size(); ++i)
      if (!coloured[i]) colours[i] = to_float(loaded_.scene.materials[static_cast<std::size_t>(materials[i])].colour);

    // Continue as with any other file.
    ReadOptions options = options_;
    take_cell(options);
    Result<SphereFile> file = finish_spheres(std::move(raw), "", options);
    if (!file) return fail("/spheres", file.error().message, file.error().hint);
    if (std::any_of(materials.begin(), materials.end(), [](std::int32_t position) { return position != 0; }))
      loaded_.scene.material_of_sphere = std::move(materials);
    keep(std::move(*file), "", options_.recenter);
  }

  // The spheres of a file, inline or not. With `move_the_rest` everything else moves with the spheres.
  void keep(SphereFile file, const std::string& name_of_file, bool move_the_rest) {
    Scene& scene = loaded_.scene;
    scene.spheres = std::move(file.spheres);
    loaded_.title = std::move(file.title);
    loaded_.entry_id = std::move(file.entry_id);
    loaded_.frames = file.frames;
    loaded_.time_ps = file.time_ps;
    loaded_.step = file.step;
    loaded_.assemblies = std::move(file.assemblies);
    loaded_.rules = std::move(file.rules);
    loaded_.recentred_by = file.recentred_by;
    loaded_.has_assumed_radii = file.assumed_radii;
    for (const std::string& warning : file.warnings) loaded_.warnings.push_back(name_of_file + warning);
    if (!move_the_rest) return;
    scene.camera.eye = scene.camera.eye - file.recentred_by;
    scene.camera.look_at = scene.camera.look_at - file.recentred_by;
    for (PointLight& light : scene.lights) light.position = light.position - file.recentred_by;
    if (scene.plane) scene.plane->plane.point = scene.plane->plane.point - file.recentred_by;
    for (Clip& clip : scene.clips) clip = moved(clip, -file.recentred_by);
  }

  // A relative path starts from the document's folder.
  std::string beside(const std::string& path) const {
    const std::size_t slash = name_.rfind('/');
    return path.front() != '/' && slash != std::string::npos ? name_.substr(0, slash + 1) + path : path;
  }

  void take_sphere_file(const json& value) {
    // The document's values apply unless the caller's options state others.
    ReadOptions options = options_;
    if (!options.radius && value.contains("radius")) options.radius = value.at("radius").get<double>();
    options.radius_scale *= value.value("radius_scale", 1.0);
    const bool recentred_by_document = value.value("recenter", false);
    options.recenter = options.recenter || recentred_by_document;
    if (value.contains("trajectory")) {
      need_version(2, "/spheres/trajectory");
      if (options.trajectory.empty()) options.trajectory = beside(value.at("trajectory").get<std::string>());
    }
    if (value.contains("assembly")) {
      need_version(2, "/spheres/assembly");
      if (options.assembly.empty()) options.assembly = value.at("assembly").get<std::string>();
    }
    if (value.contains("columns")) {
      need_version(2, "/spheres/columns");
      if (options.columns.empty()) options.columns = value.at("columns").get<ColumnChoice>();
    }
    take_cell(options);
    loaded_.stated_frame = value.value("frame", std::int64_t{0});
    if (options.frame == 0) options.frame = loaded_.stated_frame;

    const std::string path = beside(value.at("file").get<std::string>());
    loaded_.files.push_back(data_path(path).file);
    if (!options.trajectory.empty()) loaded_.files.push_back(data_path(options.trajectory).file);
    Result<SphereFile> file = read_spheres(path, options);
    if (!file) return fail("/spheres/file", file.error().to_string());

    // The camera belongs to the document's own spheres, so it moves along if the caller moves them.
    const std::string format = file->format;
    keep(std::move(*file), path + ": ", options.recenter && !recentred_by_document);

    // The material: if it states a colour, all spheres have that colour; otherwise those of the file, by element or by
    // type.
    const std::int32_t position =
        value.contains("material") ? material_position(value.at("material"), "/spheres/material") : 0;
    Scene& scene = loaded_.scene;
    if (position != 0) scene.material_of_sphere.assign(static_cast<std::size_t>(scene.spheres.size()), position);
    const bool states_colour = document_.contains("materials") &&
                               document_.at("materials").at(static_cast<std::size_t>(position)).contains("colour");
    if (states_colour)
      scene.spheres.attributes().colour.clear();
    else
      take_default_colours(scene, format, style_);
  }

  // Focus on selected spheres, now that they are known.
  void take_focus() {
    const json* const camera = document_.contains("camera") ? &document_.at("camera") : nullptr;
    if (camera == nullptr || !camera->contains("focus") || !camera->at("focus").is_string()) return;
    Camera& of_scene = loaded_.scene.camera;
    const Result<double> focus = focus_on(loaded_.scene.spheres, of_scene, camera->at("focus").get<std::string>());
    if (focus)
      of_scene.focus = *focus;
    else
      fail("/camera/focus", focus.error().message, focus.error().hint);
  }

  // Last, because they change the spheres.
  void take_looks() {
    if (!document_.contains("looks")) return;
    need_version(2, "/looks");
    for (const json& value : document_.at("looks")) loaded_.looks.push_back(look_from_json(value));
    if (looks_ == LooksOfFile::keep || !failed_.message.empty()) return;
    std::size_t position = 0;
    const auto counts = apply_looks(loaded_.scene, loaded_.looks, &position);
    if (counts) return;
    const Error& error = counts.error();
    const std::string place = error.column > 0 ? "/select: column " + std::to_string(error.column) : "";
    fail("/looks/" + std::to_string(position) + place, error.message, error.hint);
  }

  const json& document_;
  const std::string& name_;
  const ReadOptions& options_;
  LooksOfFile looks_;
  const Style* style_;
  LoadedScene loaded_;
  std::map<std::string, std::int32_t> position_of_material_;
  Error failed_;
};

}  // namespace

Result<LoadedScene> parse_scene(std::string_view text, const std::string& name, const ReadOptions& options,
                                LooksOfFile looks, const Style* style) {
  const Result<json> document = parse_json(text, name);
  if (!document) return document.error();
  if (document->contains("bihive_film"))
    return Error{"is the description of a film, not a scene", name, 0, 0,
                 "name the film's input, and this file after " + setting_name("film")};
  if (document->is_object() && document->contains("input"))
    return Error{"is a picture of another input, and holds no spheres", name, 0, 0,
                 "its input is " + document->at("input").dump(-1, ' ', false, json::error_handler_t::replace)};
  const Status status = check_against_schema(*document, name);
  if (!status) return status.error();
  return Extraction(*document, name, options, looks, style).run();
}

bool looks_like_scene(std::string_view bytes) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes.substr(0, kByteOrderMark.size()) == kByteOrderMark) bytes.remove_prefix(kByteOrderMark.size());
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || bytes[first] != '{') return false;

  // Databases of other programs begin with their first row.
  const std::size_t key = bytes.find_first_not_of(" \t\r\n", first + 1);
  return key == std::string_view::npos || bytes.substr(key, 3) != "\"1\"";
}

}  // namespace bihive
