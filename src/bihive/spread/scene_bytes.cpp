#include "bihive/spread/scene_bytes.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bihive/settings/parameter.h"
#include "bihive/spread/sphere_columns.h"

namespace bihive {
namespace {

// The same list of fields for both directions: transfer(archive, value) writes the value or fills it.
class Putting {
 public:
  explicit Putting(Bytes& bytes) : out_(bytes) {}
  static constexpr bool kTakes = false;

  template <class T>
  void plain(T& value) {
    out_.put(value);
  }
  void text(std::string& value) { out_.put_text(value); }

 private:
  ByteWriter out_;
};

class Taking {
 public:
  explicit Taking(ByteReader& bytes) : in_(bytes) {}
  static constexpr bool kTakes = true;

  template <class T>
  void plain(T& value) {
    value = in_.take<T>();
  }
  void text(std::string& value) { value = in_.take_text(); }

 private:
  ByteReader& in_;
};

// A value of the kind at this position of the variant.
template <std::size_t... Kinds>
SettingValue value_of_kind(std::size_t kind, std::index_sequence<Kinds...>) {
  SettingValue value;
  ((kind == Kinds ? void(value.emplace<Kinds>()) : void()), ...);
  return value;
}
SettingValue value_of_kind(std::size_t kind) {
  return value_of_kind(kind, std::make_index_sequence<std::variant_size_v<SettingValue>>());
}

// Structs of numbers are copied as they are.
template <class A, class T>
requires std::is_trivially_copyable_v<T>
void transfer(A& archive, T& value) {
  archive.plain(value);
}
template <class A>
void transfer(A& archive, std::string& value) {
  archive.text(value);
}
template <class A, class T>
void transfer(A& archive, std::vector<T>& values);
template <class A, class T>
requires(!std::is_trivially_copyable_v<T>) void transfer(A& archive, std::optional<T>& value) {
  bool there = value.has_value();
  archive.plain(there);
  if (A::kTakes && there) value.emplace();
  if (there) transfer(archive, *value);
}
template <class A>
void transfer(A& archive, ColourChoice& colour) {
  bool is_text = std::holds_alternative<std::string>(colour);
  archive.plain(is_text);
  if (A::kTakes && is_text) colour = std::string();
  if (A::kTakes && !is_text) colour = Vec3d();
  if (is_text)
    transfer(archive, std::get<std::string>(colour));
  else
    transfer(archive, std::get<Vec3d>(colour));
}
template <class A>
void transfer(A& archive, SettingValue& value) {
  std::size_t kind = value.index();
  archive.plain(kind);
  if (A::kTakes) value = value_of_kind(kind);
  std::visit([&archive](auto& held) { transfer(archive, held); }, value);
}
// A pair is not trivially copyable.
template <class A>
void transfer(A& archive, std::pair<double, double>& range) {
  transfer(archive, range.first);
  transfer(archive, range.second);
}

template <class A, class... Fields>
void all(A& archive, Fields&... fields) {
  (transfer(archive, fields), ...);
}

template <class A>
void transfer(A& archive, ColourMap& map) {
  all(archive, map.name, map.is_reversed, map.colours);
}
template <class A>
void transfer(A& archive, ColourBy& by) {
  all(archive, by.attribute, by.map, by.range, by.logarithmic, by.nan_colour, by.title);
}
// Rows of members come before the row that says whether their object is present.
template <class A>
void transfer(A& archive, PictureSettings& picture) {
  const auto rows = picture_parameters();
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    SettingValue value;  // GCC 12 leaves it without one if a conditional expression on kTakes initialises it
    if (!A::kTakes) value = row->get(picture);
    transfer(archive, value);
    if (A::kTakes) row->set(picture, value);
  }
}
template <class A>
void transfer(A& archive, RenderSettings& s) {
  transfer(archive, static_cast<PictureSettings&>(s));
  all(archive, s.line_scale, s.light_sets, s.dots_per_inch, s.view, s.crop, s.threads);
}
template <class A>
void transfer(A& archive, NamedNumbers& column) {
  transfer(archive, column.name);
}
template <class A>
void transfer(A& archive, NamedTexts& column) {
  all(archive, column.name, column.texts);
}
template <class A, class T>
void transfer(A& archive, std::vector<T>& values) {
  auto count = static_cast<std::int64_t>(values.size());
  archive.plain(count);
  if (A::kTakes) values.resize(static_cast<std::size_t>(count));
  for (T& value : values) transfer(archive, value);
}

template <class A>
void transfer(A& archive, Scene& scene) {
  int exponent = scene.spheres.scale_exponent();
  Vec3d origin = scene.spheres.origin();
  archive.plain(exponent);
  archive.plain(origin);
  if (A::kTakes) scene.spheres = SphereSet::from_stored({}, exponent, origin);
  SphereAttributes& attributes = scene.spheres.attributes();
  all(archive, scene.spheres.cell(), attributes.numbers, attributes.texts, scene.materials, scene.size_of_input,
      scene.coloured_by, scene.legend_names, scene.length_unit, scene.lights, scene.plane, scene.clips, scene.camera,
      scene.background, scene.ambient_light, scene.picture, scene.name, scene.seed);
}

}  // namespace

void put_scene(const Scene& scene, const RenderSettings& settings, Bytes& bytes) {
  Scene shell = without_spheres(scene);
  RenderSettings copy = settings;
  Putting out(bytes);
  all(out, shell, copy);
}

void take_scene(ByteReader& bytes, Scene& scene, RenderSettings& settings) {
  scene = Scene();
  settings = RenderSettings();
  Taking in(bytes);
  all(in, scene, settings);
}

}  // namespace bihive
