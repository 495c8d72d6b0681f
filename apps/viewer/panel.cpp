#include "panel.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bihive/scene/load_scene.h"
#include "bihive/scene/names.h"
#include "bihive/viewer/viewer_json.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

// A slider's range; numbers beyond it need the command line.
constexpr int kMostPrims = 64, kMostDepth = 64;
constexpr int kLargestSavedPx = 65535;

// A limit of the tree: the engine's choice, or a number. At the slider's left end the engine chooses.
void limit_slider(const char* name, std::optional<std::int64_t>& value, int max) {
  label(name);
  int position = value ? static_cast<int>(std::clamp<std::int64_t>(*value, 1, max)) : 0;
  const std::string shown = !value ? "auto" : *value == kUnlimited ? "unlimited" : std::to_string(*value);
  const std::string id = std::string("##") + name;
  if (!ImGui::SliderInt(id.c_str(), &position, 0, max, shown.c_str(), ImGuiSliderFlags_AlwaysClamp)) return;
  if (position == 0)
    value.reset();
  else
    value = position;
}

// Only a perspective camera has a lens.
Camera projected(Camera camera, Projection projection) {
  if (projection == Projection::orthographic) camera.aperture = 0;
  return with_projection(camera, projection);
}

}  // namespace

PanelPlace Panel::place(ImVec2 display, double text_scale) {
  const auto across = static_cast<float>(348 * text_scale);
  const bool below = display.y > display.x && display.x < 1.6F * across;
  return {below, below ? std::floor(display.y / 2) : across};
}

PanelRequests Panel::draw(const Viewer& viewer, const FrameReport& report, ImVec2 display, double text_scale) {
  PanelRequests requests;
  ViewerSettings settings = viewer.settings();
  const auto [below, extent] = place(display, text_scale);
  ImGui::SetNextWindowPos(below ? ImVec2(0, display.y - extent) : ImVec2(display.x - extent, 0));
  ImGui::SetNextWindowSize(below ? ImVec2(display.x, extent) : ImVec2(extent, display.y));
  ImGui::Begin("bihive", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  draw_scene(viewer, requests);
  heading("look");
  requests.look = look.draw(viewer);
  draw_picture(viewer, settings);
  ViewerLook wanted = viewer.look();
  bool look_changed = false;
  effects.draw(viewer, settings, wanted, look_changed);
  if (look_changed) look.leave_rows();
  if (look_changed) requests.look = wanted;
  draw_speed(viewer, report);
  draw_camera(settings, requests);
  draw_saving(requests);
  draw_tree(settings);
  draw_keys();
  ImGui::End();

  if (settings_to_json(settings) != settings_to_json(viewer.settings())) requests.settings = settings;
  return requests;
}

void Panel::draw_scene(const Viewer& viewer, PanelRequests& requests) {
  const SceneFacts& facts = viewer.facts();
  const std::size_t slash = facts.name.rfind('/');
  const std::string name = slash == std::string::npos ? facts.name : facts.name.substr(slash + 1);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##scene", name.c_str(), ImGuiComboFlags_HeightLarge)) {
    ImGui::TextColored(kDim, "built-in scenes; for a file press O, or drop it");
    for (const BuiltInScene& one : kBuiltInScenes)
      if (ImGui::Selectable(one.name, facts.name == one.name)) requests.built_in = one.name;
    ImGui::EndCombo();
  }
  ImGui::TextColored(
      kDim, "%s", fmt::format("{} sphere{}, {}", facts.spheres, facts.spheres == 1 ? "" : "s", facts.format).c_str());
  if (!facts.rules.empty() && ImGui::IsItemHovered()) {
    ImGui::BeginTooltip();
    for (const std::string& rule : facts.rules) ImGui::TextUnformatted(rule.c_str());
    ImGui::EndTooltip();
  }
  constexpr double kOwn = -1;
  ReadOptions wanted = reading;
  double radius = reading.radius.value_or(kOwn);
  bool changed = effects.number("radius", "the file's own", kOwn, radius);
  if (changed) wanted.radius = radius == kOwn ? std::nullopt : std::optional(radius);
  if (can_scale_radii) changed = effects.number("radius x", "1", 1, wanted.radius_scale) || changed;
  if (changed) requests.reading = wanted;
  ImGui::PushTextWrapPos(0);
  for (const std::string& warning : facts.warnings) ImGui::TextColored(kBad, "%s", warning.c_str());
  ImGui::PopTextWrapPos();
}

void Panel::draw_picture(const Viewer& viewer, ViewerSettings& settings) {
  heading("picture");
  label("engine");
  if (ImGui::RadioButton("CPU", settings.engine == ViewerEngine::cpu)) settings.engine = ViewerEngine::cpu;
  ImGui::SameLine();
  ImGui::BeginDisabled(!viewer.has_gl());
  if (ImGui::RadioButton("GPU", settings.engine == ViewerEngine::gpu)) settings.engine = ViewerEngine::gpu;
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", viewer.has_gl() ? viewer.gl_description().c_str() : "no graphics processor that can do it");

  label("view");
  if (ImGui::BeginCombo("##view", name_of(kViews, settings.view).c_str(), ImGuiComboFlags_HeightLarge)) {
    int number = 1;
    for (const auto& [name, view] : kViews) {
      const std::string entry = std::to_string(number++) + "  " + name;
      if (ImGui::Selectable(entry.c_str(), settings.view == view)) settings.view = view;
    }
    ImGui::EndCombo();
  }
  effects.parameters(ParameterGroup::picture, settings);
}

void Panel::draw_camera(ViewerSettings& settings, PanelRequests& requests) const {
  heading("camera");
  label("projection");
  if (ImGui::BeginCombo("##projection", name_of(kProjections, settings.camera.projection).c_str())) {
    for (const auto& [name, projection] : kProjections)
      if (ImGui::Selectable(name.c_str(), settings.camera.projection == projection))
        settings.camera = projected(settings.camera, projection);
    ImGui::EndCombo();
  }
  const float space = ImGui::GetStyle().ItemSpacing.x;
  const float across = (ImGui::GetContentRegionAvail().x - 3 * space) / 4;
  int column = 0;
  const auto button = [&](const char* name) {
    if (column++ % 4 != 0) ImGui::SameLine();
    return ImGui::Button(name, {across, 0});
  };
  for (const auto& [name, side] : kSides)
    if (button(name.c_str())) requests.side = side;
  if (button("home")) requests.home = true;
}

void Panel::draw_tree(ViewerSettings& settings) const {
  heading("tree");
  limit_slider("max_prims", settings.max_prims, kMostPrims);
  limit_slider("max_depth", settings.max_depth, kMostDepth);
  table.draw();
}

void Panel::draw_speed(const Viewer& viewer, const FrameReport& report) const {
  heading("speed");
  const std::string fps = report.fps > 0 ? fmt::format("{:.1f} frames/s moving", report.fps) : "move to see frames/s";
  ImGui::TextUnformatted(fps.c_str());
  const std::string rays = fmt::format("{:.3g} Mray/s", report.mray_per_s);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(rays.c_str()).x);
  ImGui::TextUnformatted(rays.c_str());
  const std::string progress = report.settled       ? "all drawn"
                               : report.divisor > 1 ? fmt::format("1/{} of width and height", report.divisor)
                                                    : fmt::format("{:.0f} %", 100 * report.done);
  ImGui::ProgressBar(static_cast<float>(report.done), {-1, ImGui::GetTextLineHeight() / 3}, "");
  ImGui::TextColored(kDim, "%s", progress.c_str());
  if (viewer.settings().engine == ViewerEngine::gpu) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(kDim, "%s", viewer.gl_description().c_str());
    ImGui::PopTextWrapPos();
  }
}

void Panel::draw_saving(PanelRequests& requests) {
  heading("save the picture");
  const float button = ImGui::CalcTextSize("save").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputText("##file", &file_name);
  ImGui::SameLine();
  if (ImGui::Button("save")) requests.save = true;
  label("pixels");
  std::array<int, 2> size{save_size.width, save_size.height};
  if (ImGui::InputInt2("##pixels", size.data()))
    save_size = {std::clamp(size[0], 0, kLargestSavedPx), std::clamp(size[1], 0, kLargestSavedPx)};
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("0: as large as the picture on the screen");
}

void Panel::draw_keys() const {
  heading("mouse and keys");
  ImGui::PushTextWrapPos(0);
  ImGui::TextColored(kDim,
                     "drag to turn, with shift or another button to shift, wheel to zoom; arrows, + and - likewise\n"
                     "1-7 view   E engine   R home   O open   S save   H panel   Q quit\n"
                     "of several frames: space plays, comma and full stop step");
  ImGui::PopTextWrapPos();
}

}  // namespace bihive::window
