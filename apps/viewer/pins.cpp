#include "pins.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bihive/base/json_text.h"
#include "bihive/geometry/lattice.h"
#include "bihive/geometry/measures.h"
#include "bihive/scene/camera.h"
#include "bihive/viewer/shown_measures.h"

namespace bihive::window {
namespace {

using nlohmann::json;

constexpr std::size_t kMostPins = 4;

std::string readable(double value) {
  return fmt::format("{:.6g}", value);
}

std::string text_of(const json& attributes, const char* name) {
  const auto at = attributes.find(name);
  if (at == attributes.end() || at->is_null()) return "";
  return at->is_string() ? at->get<std::string>() : at->is_number_float() ? readable(at->get<double>()) : at->dump();
}

std::string in_one(const std::vector<std::string>& texts, const char* between) {
  std::string all;
  for (const std::string& text : texts)
    if (!text.empty()) all += (all.empty() ? "" : between) + text;
  return all;
}

// The test of an attribute in a selection.
std::string test_of(const json& attributes, const char* name) {
  const auto at = attributes.find(name);
  if (at == attributes.end() || at->is_null() || *at == "") return "";
  if (!at->is_string()) return std::string(name) + " " + at->dump();
  std::string quoted;
  for (const char c : at->get<std::string>()) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return std::string(name) + " \"" + quoted + "\"";
}

NamedSphere in_words(const Picked& picked, const Scene& scene) {
  const json known = *json_from_text<json>(picked_to_json(picked, scene));
  const json& attributes = known.at("attributes");
  const auto text = [&](const char* name) { return text_of(attributes, name); };
  const auto test = [&](const char* name) { return test_of(attributes, name); };
  NamedSphere named;
  named.id = input_id(scene, picked.sphere);
  named.centre = scene.spheres.centre(picked.sphere);

  // The title, such as "CA, ALA 28, chain A", and all the rest.
  const std::string atom = text("name"), kind = text("element");
  const std::string chain = text("chain");
  named.title = in_one({!atom.empty()   ? atom
                        : !kind.empty() ? kind
                                        : text("type"),
                        in_one({text("resname"), text("resid")}, " "), chain.empty() ? "" : "chain " + chain},
                       ", ");
  if (named.title.empty()) named.title = fmt::format("sphere {}", named.id);
  std::vector<std::string> details{fmt::format("index {}", named.id)};
  constexpr std::array kInTitle{"name", "resname", "resid", "chain", "id", "index"};
  for (const auto& [name, value] : attributes.items())
    if (std::find(kInTitle.begin(), kInTitle.end(), name) == kInTitle.end() && !text(name.c_str()).empty())
      details.push_back(name + " " + text(name.c_str()));
  details.push_back("radius " + readable(known.at("radius").get<double>()));
  details.push_back(
      fmt::format("at {}, {}, {}", readable(named.centre.x), readable(named.centre.y), readable(named.centre.z)));
  named.details = in_one(details, "\n");

  const std::string residue =
      attributes.contains("resid") ? in_one({test("chain"), test("resid"), test("insertion")}, " and ") : "";
  const std::string of_kind = !test("resname").empty() ? test("resname")
                              : !test("type").empty()  ? test("type")
                                                       : test("element");
  for (const auto& [label, selection] :
       std::initializer_list<std::pair<std::string, std::string>>{{"This", fmt::format("index {}", named.id)},
                                                                  {"Residue", residue},
                                                                  {"Chain", test("chain")},
                                                                  {"All of its kind", of_kind}})
    if (!selection.empty()) named.selections.emplace_back(label, selection);
  return named;
}

}  // namespace

std::optional<NamedSphere> Pins::named(const Viewer& viewer, double x_px, double y_px) {
  const Result<std::optional<Picked>> picked = viewer.pick(x_px, y_px);
  if (!picked || !*picked) return std::nullopt;
  return in_words(**picked, viewer.scene());
}

void Pins::toggle(const Viewer& viewer, NamedSphere sphere) {
  if (std::erase_if(pins_, [&](const NamedSphere& one) { return one.id == sphere.id; }) == 0) {
    if (pins_.size() == kMostPins) pins_.erase(pins_.begin());
    pins_.push_back(std::move(sphere));
  }
  measure(viewer);
}

void Pins::clear() {
  pins_.clear();
  measure_.clear();
}

void Pins::moved(const Viewer& viewer) {
  const Scene& scene = viewer.scene();
  std::erase_if(pins_, [&](const NamedSphere& one) { return !shown_id(scene, one.id); });
  for (NamedSphere& one : pins_) one.centre = scene.spheres.centre(*shown_id(scene, one.id));
  measure(viewer);
}

void Pins::measure(const Viewer& viewer) {
  constexpr std::array kKinds{"", "", "Distance", "Angle", "Dihedral"};
  measure_.clear();
  if (pins_.size() < 2) return;
  const Scene& scene = viewer.scene();
  std::vector<std::int64_t> ids;
  for (const NamedSphere& one : pins_) ids.push_back(*shown_id(scene, one.id));
  const std::optional<Lattice> lattice = Lattice::of(scene.spheres.cell());
  const double value = measured(scene.spheres, ids, lattice);
  const bool of_images = lattice && value != measured(scene.spheres, ids, std::nullopt);
  if (!std::isfinite(value)) return;
  const std::string unit = ids.size() > 2 ? "°" : scene.length_unit.empty() ? "" : " " + scene.length_unit;
  measure_ = fmt::format("{} {:.4g}{}{}", kKinds[ids.size()], value, unit, of_images ? ", of nearest images" : "");
}

void Pins::draw_marks(const Viewer& viewer, ImVec2 picture_px, float per_unit) const {
  if (pins_.empty()) return;
  const PixelPlaces places(viewer.settings().camera, static_cast<int>(picture_px.x), static_cast<int>(picture_px.y));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float size = ImGui::GetFontSize();
  std::vector<std::optional<ImVec2>> at;
  for (const NamedSphere& one : pins_) {
    const Vec3d point = places.from_eye(one.centre);
    at.push_back(point.z > 0 ? std::optional<ImVec2>({static_cast<float>(places.x_px(point)) / per_unit,
                                                      static_cast<float>(places.y_px(point)) / per_unit})
                             : std::nullopt);
  }
  for (std::size_t i = 1; i < at.size(); ++i)
    if (at[i - 1] && at[i]) {
      list.AddLine(*at[i - 1], *at[i], ImGui::GetColorU32(kBackground), size / 4);
      list.AddLine(*at[i - 1], *at[i], ImGui::GetColorU32(kAccent), size / 8);
    }
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (!at[i]) continue;
    const std::string number = std::to_string(i + 1);
    const ImVec2 text = ImGui::CalcTextSize(number.c_str());
    list.AddCircleFilled(*at[i], 0.7F * size, ImGui::GetColorU32(kBackground));
    list.AddCircle(*at[i], 0.7F * size, ImGui::GetColorU32(kAccent), 0, size / 8);
    list.AddText({at[i]->x - text.x / 2, at[i]->y - text.y / 2}, ImGui::GetColorU32(ImGuiCol_Text), number.c_str());
  }
}

std::optional<std::string> Pins::draw_list() {
  std::optional<std::string> selected;
  for (std::size_t i = 0; i < pins_.size(); ++i) {
    ImGui::TextWrapped("%s", fmt::format("{}  {}", i + 1, pins_[i].title).c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", pins_[i].details.c_str());
  }
  if (!measure_.empty()) ImGui::TextColored(kGood, "%s", measure_.c_str());
  if (pins_.empty()) return selected;
  const NamedSphere last = pins_.back();
  if (ImGui::Button("Clear")) clear();
  ImGui::TextColored(kDim, "Select");
  for (const auto& [label, selection] : last.selections) {
    const float wide = ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < wide) ImGui::NewLine();
    if (ImGui::Button(label.c_str())) selected = selection;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", selection.c_str());
  }
  return selected;
}

void UnionMeasures::draw(const Viewer& viewer, Fields& fields) {
  fields.text("Of", "all that is shown", selection_);
  fields.number("Probe", "0", 0, probe_);
  hint(
      "Of the union of all spheres, exactly. A probe is added to every radius: 1.4 for the surface that water "
      "reaches.");
  if (ImGui::Button("Measure", {-1, 0})) {
    lines_.clear();
    const Result<std::string> text = shown_measures_to_json(viewer.scene(), viewer.input_spheres(), selection_, probe_);
    if (!text) {
      lines_.push_back(text.error().to_string());
      return;
    }
    const json found = *json_from_text<json>(*text);
    const std::string unit = viewer.scene().length_unit.empty() ? "" : " " + viewer.scene().length_unit;
    const auto in_unit = [&](double value, const char* power) {
      return readable(value) + (unit.empty() ? "" : unit + power);
    };
    double cavities = 0;
    for (const json& one : found.at("cavities")) cavities += one.get<double>();
    const std::size_t count = found.at("cavities").size();
    const auto pieces = found.at("components").get<std::int64_t>();
    lines_ = {"Area " + in_unit(found.at("area").get<double>(), "²"),
              "Volume " + in_unit(found.at("volume").get<double>(), "³")};
    if (found.at("undecided_spheres").get<std::int64_t>() > 0)
      lines_.emplace_back("Cavities could not be told apart in this arrangement.");
    else
      lines_.push_back(
          (count == 0 ? "No cavities"
                      : fmt::format("{} {} of {}", count, count == 1 ? "cavity" : "cavities", in_unit(cavities, "³"))) +
          (pieces == 1 ? "; in one piece" : fmt::format("; in {} pieces", pieces)));
    lines_.push_back(
        fmt::format("Of {} spheres, with their radii as read.", grouped(found.at("spheres").get<std::int64_t>())));
  }
  for (const std::string& line : lines_) ImGui::TextWrapped("%s", line.c_str());
}

}  // namespace bihive::window
