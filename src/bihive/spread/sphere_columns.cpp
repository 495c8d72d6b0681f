#include "bihive/spread/sphere_columns.h"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace bihive {
namespace {

// Calls use(column) for each column that the whole set has, always in the same order.
template <class AnyScene, class Use>
void for_each_column(const SphereColumns& has, AnyScene& scene, const Use& use) {
  auto& attributes = scene.spheres.attributes();
  if (has.element) use(attributes.element);
  if (has.type) use(attributes.type);
  if (has.colour) use(attributes.colour);
  if (has.opacity) use(attributes.opacity);
  if (has.outline) use(attributes.outline_px);
  if (has.crease) use(attributes.crease);
  if (has.clips) use(attributes.clips);
  for (auto& column : attributes.numbers) use(column.values);
  for (auto& column : attributes.texts) use(column.text_of_sphere);
  if (has.material) use(scene.material_of_sphere);
  if (has.meaning) use(scene.coloured_by_of_sphere);
  if (has.input_id) use(scene.id_in_input);
}

template <class T>
void put_chosen(const std::vector<T>& column, const std::vector<std::int64_t>& ids, ByteWriter& out) {
  static thread_local std::vector<T> chosen;
  chosen.clear();
  chosen.reserve(ids.size());
  for (const std::int64_t id : ids) chosen.push_back(column[static_cast<std::size_t>(id)]);
  out.put_array(chosen.data(), chosen.size());
}

template <class T>
void append(ByteReader& in, std::size_t count, std::vector<T>& column) {
  const std::size_t before = column.size();
  column.resize(before + count);
  in.take_array(column.data() + before, count);
}

}  // namespace

SphereColumns SphereColumns::of(const Scene& scene) {
  const SphereAttributes& attributes = scene.spheres.attributes();
  SphereColumns has;
  has.element = !attributes.element.empty();
  has.type = !attributes.type.empty();
  has.colour = !attributes.colour.empty();
  has.opacity = !attributes.opacity.empty();
  has.outline = !attributes.outline_px.empty();
  has.crease = !attributes.crease.empty();
  has.clips = !attributes.clips.empty();
  has.material = !scene.material_of_sphere.empty();
  has.meaning = !scene.coloured_by_of_sphere.empty();
  has.input_id = !scene.id_in_input.empty();
  return has;
}

void pack_spheres(const Scene& scene, const SphereColumns& has, const std::vector<std::int64_t>& whole_ids,
                  const std::vector<std::int64_t>& ids, Bytes& bytes) {
  ByteWriter out(bytes);
  out.put(static_cast<std::int64_t>(ids.size()));
  if (whole_ids.empty())
    out.put_array(ids.data(), ids.size());
  else
    put_chosen(whole_ids, ids, out);
  for (const auto* column : {&scene.spheres.x(), &scene.spheres.y(), &scene.spheres.z(), &scene.spheres.r()})
    put_chosen(*column, ids, out);
  for_each_column(has, scene, [&](const auto& column) { put_chosen(column, ids, out); });
}

void append_spheres(ByteReader& in, const SphereColumns& has, Scene& scene, std::vector<std::int64_t>& whole_ids) {
  const auto count = static_cast<std::size_t>(in.take<std::int64_t>());
  append(in, count, whole_ids);
  StoredSpheres stored;
  for (auto* column : {&stored.x, &stored.y, &stored.z, &stored.r}) append(in, count, *column);
  scene.spheres.append_stored(stored);
  for_each_column(has, scene, [&](auto& column) { append(in, count, column); });
}

void order_spheres(const std::vector<std::int64_t>& ids, const SphereColumns& has, Scene& scene,
                   std::vector<std::int64_t>& whole_ids) {
  const auto order = [&](auto& column) {
    std::remove_reference_t<decltype(column)> ordered;
    ordered.reserve(ids.size());
    for (const std::int64_t id : ids) ordered.push_back(column[static_cast<std::size_t>(id)]);
    column = std::move(ordered);
  };
  order(whole_ids);
  scene.spheres.order_stored(ids);
  for_each_column(has, scene, order);
}

void keep_first_spheres(std::int64_t count, const SphereColumns& has, Scene& scene,
                        std::vector<std::int64_t>& whole_ids) {
  const auto kept = static_cast<std::size_t>(count);
  whole_ids.resize(kept);
  scene.spheres.keep_first(count);
  for_each_column(has, scene, [&](auto& column) { column.resize(kept); });
}

Scene without_spheres(const Scene& scene) {
  Scene shell;
  shell.spheres = SphereSet::from_stored({}, scene.spheres.scale_exponent(), scene.spheres.origin());
  shell.spheres.cell() = scene.spheres.cell();
  for (const NamedNumbers& column : scene.spheres.attributes().numbers)
    shell.spheres.attributes().numbers.push_back({column.name, {}});
  for (const NamedTexts& column : scene.spheres.attributes().texts)
    shell.spheres.attributes().texts.push_back({column.name, column.texts, {}});
  shell.materials = scene.materials;
  shell.size_of_input = scene.size_of_input;
  shell.coloured_by = scene.coloured_by;
  shell.length_unit = scene.length_unit;
  shell.lights = scene.lights;
  shell.plane = scene.plane;
  shell.clips = scene.clips;
  shell.camera = scene.camera;
  shell.background = scene.background;
  shell.ambient_light = scene.ambient_light;
  shell.picture = scene.picture;
  shell.name = scene.name;
  shell.seed = scene.seed;
  return shell;
}

}  // namespace bihive
