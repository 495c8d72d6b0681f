#include "bihive/job/methods_text.h"

#include <fmt/format.h>

#include <vector>

#include "bihive/job/messages.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

std::string input_in_words(const PictureRecord& record) {
  if (!record.built_in.empty()) return fmt::format(" of the built-in scene {}", record.built_in);
  std::string text;
  for (const RecordedFile& file : record.files)
    text += fmt::format("{}{} (SHA-256 {})", text.empty() ? " of " : ", ", escaped(file.name), file.sha256);
  return text;
}

std::string samples_in_words(const ordered_json& samples) {
  if (!samples.is_number()) return "as many samples as each needs";
  const auto count = samples.get<std::int64_t>();
  return fmt::format("{} sample{}", count, count == 1 ? "" : "s");
}

std::string camera_in_words(const ordered_json& camera) {
  if (camera.contains("projection")) return fmt::format("{} projection", camera["projection"].get<std::string>());
  std::string text = fmt::format("perspective projection of {:.4g} degrees", camera["fov_deg"].get<double>());
  if (camera.contains("aperture")) text += " with depth of field";
  return text;
}

// What determines the light, as far as it is switched on.
std::string light_in_words(const ordered_json& described) {
  std::vector<std::string> parts;
  if (described.value("shadows", false)) parts.emplace_back("shadows");
  if (const auto ao = described.find("ambient_occlusion"); ao != described.end())
    parts.push_back(fmt::format("ambient occlusion in {} directions", ao->at("directions").get<std::int64_t>()));
  if (described.contains("fog")) parts.emplace_back("fog");
  if (described.contains("outline_px")) parts.emplace_back("outlines");
  std::string text;
  for (const std::string& part : parts) text += ", " + part;
  return text;
}

}  // namespace

std::string methods_text(const PictureRequest& request, const ordered_json& described, const Scene& scene,
                         const PictureRecord& record) {
  const std::string commit = record.commit.empty() ? "" : ", commit " + record.commit;
  std::string sentence = fmt::format("The figure was rendered with bihive {}{} [bihive]: {} sphere{}", record.version,
                                     commit, grouped(scene.spheres.size()), scene.spheres.size() == 1 ? "" : "s");
  if (scene.spheres.has_images()) sentence += fmt::format(" in {} copies", grouped(scene.spheres.images().count()));
  sentence += input_in_words(record);
  if (!request.style.name.empty()) sentence += fmt::format(", style {}", escaped(request.style.name));
  sentence += fmt::format(", {}, {} x {} pixels of {}", camera_in_words(described.at("camera")),
                          described.at("width_px").get<std::int64_t>(), described.at("height_px").get<std::int64_t>(),
                          samples_in_words(described.at("samples_per_pixel")));
  sentence += light_in_words(described) +
              ". Rays and spheres intersect in double precision, and the picture has the same bits on every machine.\n";
  return sentence + fmt::format(
                        "\n@misc{{bihive,\n  author = {{{{bihive authors}}}},\n  title = {{bihive: a ray tracer for "
                        "spheres on a bounding interval hierarchy}},\n  note = {{Version {}{}}}\n}}\n",
                        record.version, commit);
}

}  // namespace bihive
