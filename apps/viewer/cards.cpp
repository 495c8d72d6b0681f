#include "cards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bihive/scene/camera.h"
#include "bihive/scene/load_scene.h"
#include "bihive/viewer/viewer_json.h"
#include "theme.h"
#include "widgets.h"

namespace bihive::window {
namespace {

constexpr float kButtons = 58;  // height of the bar of buttons
constexpr float kCardWidth = 348;
constexpr float kNarrow = 520, kNarrowUpright = 760;  // as the page has them (web/src/cards.css)
constexpr float kBarOfNarrow = 48;
constexpr float kLeastSheet = 200, kMostSheet = 430, kShareOfSheet = 0.44F;
constexpr double kZoomOfButton = 1.25;
const ImVec4 kGround{kPanel.x, kPanel.y, kPanel.z, 0.8F};  // background of the axes

bool is_stay(const std::string& card) {
  return card == "measure" || card == "show" || card == "cut";  // beside which the picture is clicked
}

// The buttons of a bar, by the width of their titles.
float width_of_button(const Card& card) {
  return ImGui::CalcTextSize(std::string(card.title).c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
}

float width_of_bar() {
  float width = 0;
  for (const Card& card : cards())
    if (card.in_bar) width += width_of_button(card) + (width > 0 ? ImGui::GetStyle().ItemInnerSpacing.x : 0);
  return width;
}

std::string file_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

// The built-in ones have names for people.
std::string name_of_scene(const SceneFacts& facts) {
  for (const BuiltInScene& one : kBuiltInScenes)
    if (facts.name == one.name) return one.title;
  return facts.title.empty() ? file_of(facts.name) : facts.title;
}

}  // namespace

// --- Which card is open -----------------------------------------------------------------------------------------

void Cards::show(const std::string& id, const std::string& shown_input) {
  open_ = id;
  closes_in_ = 0;
  if (id == "open") file.begin(shown_input);
}

void Cards::close() {
  open_.clear();
  closes_in_ = 0;
}

bool Cards::dismiss(const Layout& layout) {
  if (open_.empty() || layout.is_narrow() || is_stay(open_)) return false;
  // The click ends a text that is being typed, which its field takes in one of the next frames.
  constexpr int kFrames = 2;
  closes_in_ = kFrames;
  return true;
}

Layout Cards::layout(ImVec2 display, double text_scale, float per_unit, bool shown) const {
  Layout layout;
  layout.display = display;
  layout.scale = static_cast<float>(text_scale);
  const float width = display.x / layout.scale;
  const bool narrow = width <= kNarrow || (width <= kNarrowUpright && display.y > display.x);
  if (narrow && shown) layout.bar = kBarOfNarrow * layout.scale;
  const float rest = display.y - layout.bar;
  if (narrow && shown && !open_.empty())
    layout.sheet = is_tall_ ? std::max(rest - kMargin * layout.scale, 1.0F)
                            : std::min(0.8F * rest, std::clamp(kShareOfSheet * display.y, kLeastSheet * layout.scale,
                                                               kMostSheet * layout.scale));
  layout.picture = {std::max(display.x, 1.0F), std::max(std::floor(rest - layout.sheet), 1.0F)};
  layout.picture_px = {std::max(std::round(layout.picture.x * per_unit), 1.0F),
                       std::max(std::round(layout.picture.y * per_unit), 1.0F)};
  layout.lower = layout.picture.y;
  return layout;
}

void Cards::begin(const Viewer& viewer) {
  table.forget();
  rows.start_anew(viewer.look());
  pins.clear();
  controls_.start_anew();
  fields_.forget();
  changed(viewer, true);
}

void Cards::moved(const Viewer& viewer) {
  table.forget();
  union_.forget();
  pins.moved(viewer);
}

void Cards::changed(const Viewer& viewer, bool other_spheres) {
  moved(viewer);
  groups_.forget_legend();
  if (!other_spheres) return;
  groups_.forget();
  cut_.forget();
  ranges_.forget();
}

// --- What is always there ---------------------------------------------------------------------------------------

bool Cards::card_button(const Card& card, float width, const std::string& input) {
  const std::string id(card.id);
  const bool is_open = open_ == id;
  if (is_open) ImGui::PushStyleColor(ImGuiCol_Button, kChosen);
  const bool clicked = ImGui::Button(std::string(card.title).c_str(), {width, 0});
  if (is_open) ImGui::PopStyleColor();
  if (!clicked) return false;
  if (is_open)
    close();
  else
    show(id, input);
  return true;
}

void Cards::draw_bar(const Layout& layout, const std::string& input, Covered& covered) {
  const float space = ImGui::GetStyle().ItemInnerSpacing.x, margin = kMargin * layout.scale;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, layout.is_narrow() ? ImVec2(space, space) : ImVec2(0, 0));
  if (layout.is_narrow()) {
    ImGui::SetNextWindowPos({0, layout.display.y - layout.bar});
    ImGui::SetNextWindowSize({layout.display.x, layout.bar});
  } else {
    ImGui::SetNextWindowPos({layout.display.x - margin, margin}, ImGuiCond_Always, {1, 0});
  }
  ImGui::Begin("bar", nullptr,
               kOverlay | (layout.is_narrow() ? 0 : ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoBackground));
  covered.add_window();
  const auto is_here = [&](const Card& card) { return card.in_bar && !(layout.is_narrow() && card.is_second); };
  const auto count = static_cast<float>(std::count_if(cards().begin(), cards().end(), is_here));
  const float each = (layout.display.x - (count + 1) * space) / count;
  bool is_first = true;
  for (const Card& card : cards()) {
    if (!is_here(card)) continue;
    if (!is_first) ImGui::SameLine(0, space);
    is_first = false;
    card_button(card, layout.is_narrow() ? each : 0, input);
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

// What this is; a click tells how it was read. Below the bar where both do not fit beside each other.
void Cards::draw_chip(const Viewer& viewer, const Layout& layout, const std::string& input, Covered& covered) {
  const SceneFacts& facts = viewer.facts();
  const float margin = kMargin * layout.scale, padding = ImGui::GetStyle().FramePadding.x;
  const float beside = layout.display.x - width_of_bar() - 3 * margin;
  const bool is_below = !layout.is_narrow() && beside < 0.6F * kCardWidth * layout.scale;
  const float room = (layout.is_narrow() || is_below ? layout.display.x - 2 * margin : beside) - 2 * padding;
  const std::string whole = name_of_scene(facts);
  const std::string entry = facts.entry_id.empty() || facts.entry_id == whole ? "" : facts.entry_id + " · ";
  const std::string more = entry + grouped(facts.spheres) + (facts.has_elements ? " atom" : " sphere") +
                           (facts.spheres == 1 ? "" : "s") + " · " + facts.format;
  const float space = ImGui::GetStyle().ItemSpacing.x, wide = ImGui::CalcTextSize(more.c_str()).x;
  const bool has_more = wide + space < 0.6F * room;
  const std::string name = elided(whole, has_more ? room - wide - space : room);

  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::SetNextWindowPos({margin, is_below ? kButtons * layout.scale : margin});
  ImGui::SetNextWindowBgAlpha(0.88F);
  ImGui::Begin("chip", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize);
  covered.add_window();
  const float name_wide = ImGui::CalcTextSize(name.c_str()).x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushStyleColor(ImGuiCol_Button, {0, 0, 0, 0});
  if (ImGui::Button("##what", {name_wide + (has_more ? wide + space : 0) + 2 * padding, 0})) {
    if (open_ == "scene")
      close();
    else
      show("scene", input);
  }
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\n%s", whole.c_str(), more.c_str());
  const float y = corner.y + ImGui::GetStyle().FramePadding.y;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({corner.x + padding, y}, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
  if (has_more) list.AddText({corner.x + padding + name_wide + space, y}, ImGui::GetColorU32(kDim), more.c_str());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

// Closer, farther, all of it, and the directions of x, y and z.
void Cards::draw_zoom(const Viewer& viewer, const Layout& layout, CardRequests& requests, Covered& covered) {
  const float margin = kMargin * layout.scale, side = 1.35F * ImGui::GetFrameHeight(), axes = 1.7F * side;
  const float width = std::max(axes, ImGui::CalcTextSize("Home").x + 2 * ImGui::GetStyle().FramePadding.x);
  // A card of the whole height would reach them.
  const bool card_is_beside = !layout.is_narrow() && !open_.empty();
  const float right = layout.display.x - margin - (card_is_beside ? kCardWidth * layout.scale + margin : 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::SetNextWindowPos({right, layout.lower - margin}, ImGuiCond_Always, {1, 1});
  ImGui::Begin("zoom", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoBackground);
  covered.add_window();
  const auto button = [&](const char* name, const char* help) {
    const bool clicked = ImGui::Button(name, {width, side});
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return clicked;
  };
  if (layout.picture.y > 8 * side) {
    const ImVec2 corner = ImGui::GetCursorScreenPos(), middle{corner.x + width / 2, corner.y + axes / 2};
    ImGui::Dummy({width, axes});
    ImGui::GetWindowDrawList()->AddCircleFilled(middle, 0.46F * axes, ImGui::GetColorU32(kGround));
    // Steps in pixels of a picture of one pixel: shares of the shorter side.
    const Camera camera = with_projection(viewer.settings().camera, Projection::orthographic);
    const PixelPlaces places(camera, 1, 1);
    const std::array<std::pair<const char*, Vec3d>, 3> kAxes{{{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}}};
    const std::array<ImVec4, 3> kColours{
        {{0.94F, 0.45F, 0.42F, 1}, {0.55F, 0.80F, 0.50F, 1}, {0.45F, 0.65F, 0.96F, 1}}};
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
      const Vec3d seen =
          places.from_eye(camera.eye + camera.shorter_side * kAxes[i].second) - places.from_eye(camera.eye);
      const float reach = 0.34F * axes;
      const ImVec2 end{middle.x + reach * static_cast<float>(seen.x), middle.y + reach * static_cast<float>(seen.y)};
      ImDrawList& list = *ImGui::GetWindowDrawList();
      list.AddLine(middle, end, ImGui::ColorConvertFloat4ToU32(kColours[i]), layout.scale * 2);
      const ImVec2 letter = ImGui::CalcTextSize(kAxes[i].first);
      list.AddText(
          {middle.x + 1.3F * (end.x - middle.x) - letter.x / 2, middle.y + 1.3F * (end.y - middle.y) - letter.y / 2},
          ImGui::ColorConvertFloat4ToU32(kColours[i]), kAxes[i].first);
    }
  }
  if (layout.picture.y > 11 * side) {
    if (!undoes.empty() && button("Undo", ("Undo " + undoes + " (Ctrl+Z)").c_str())) requests.undo = -1;
    if (!redoes.empty() && button("Redo", ("Redo " + redoes + " (Shift+Ctrl+Z)").c_str())) requests.undo = 1;
  }
  if (button("+", "Closer (+)")) requests.zoom = kZoomOfButton;
  if (button("-", "Farther (-)")) requests.zoom = 1 / kZoomOfButton;
  if (button("Home", "Show all (Home, R)")) requests.home = true;
  ImGui::End();
  ImGui::PopStyleVar();
}

// --- The open card ----------------------------------------------------------------------------------------------

void Cards::draw_card(const Viewer& viewer, const FrameReport& report, const Layout& layout, const std::string& input,
                      CardRequests& requests, Covered& covered) {
  const Card* const card = card_named(open_);
  if (card == nullptr) return;
  const float margin = kMargin * layout.scale, upper = kButtons * layout.scale;
  const float width =
      layout.is_narrow() ? layout.display.x : std::min(kCardWidth * layout.scale, layout.display.x - 2 * margin);
  const ImVec2 corner =
      layout.is_narrow() ? ImVec2(0, layout.picture.y) : ImVec2(layout.display.x - margin - width, upper);
  const float head = ImGui::GetFrameHeight() + ImGui::GetStyle().WindowPadding.y;

  // The head stays when the rest is scrolled.
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize({width, head});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      {ImGui::GetStyle().WindowPadding.x, ImGui::GetStyle().WindowPadding.y / 2});
  ImGui::Begin("head", nullptr, kOverlay);
  covered.add_window();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(std::string(card->title).c_str());
  const float square = ImGui::GetFrameHeight();
  const float buttons = layout.is_narrow() ? 2 * square + ImGui::GetStyle().ItemSpacing.x : square;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - buttons);
  if (layout.is_narrow()) {
    if (ImGui::ArrowButton("tall", is_tall_ ? ImGuiDir_Down : ImGuiDir_Up)) is_tall_ = !is_tall_;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", is_tall_ ? "Half the window" : "Whole window");
    ImGui::SameLine();
  }
  const bool closes = ImGui::Button("×", {square, square});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Close (Esc)");
  ImGui::End();
  ImGui::PopStyleVar();

  const float most = layout.is_narrow() ? layout.sheet - head : layout.lower - upper - head - margin;
  ImGui::SetNextWindowPos({corner.x, corner.y + head});
  ImGui::SetNextWindowSizeConstraints({width, layout.is_narrow() ? most : 0}, {width, std::max(most, 1.0F)});
  ImGui::Begin(("card " + open_).c_str(), nullptr,
               (kOverlay & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysAutoResize |
                   (open_ == "open" ? ImGuiWindowFlags_NoNavInputs : 0));  // there Tab completes
  covered.add_window();
  ViewerSettings settings = viewer.settings();
  ViewerLook look = viewer.look();
  const std::string shown = open_;
  if (shown == "scene") draw_scene(viewer, input, requests);
  if (shown == "open") requests.open = file.draw(viewer, fields_);
  if (shown == "style") draw_style(viewer, settings, look);
  if (shown == "colour") {
    ranges_.update(viewer.scene().spheres, look.colour_by.substr(0, look.colour_by.find(':')));
    controls_.draw_colours(viewer.facts(), look, ranges_);
  }
  if (shown == "show") draw_show(viewer);
  if (shown == "cut") cut_.draw(viewer, rows);
  if (shown == "measure") draw_measure(viewer, input);
  if (shown == "save") {
    const PictureSizePx screen{static_cast<int>(layout.picture_px.x), static_cast<int>(layout.picture_px.y)};
    requests.save = save.draw(screen, look);
  }
  if (shown == "share") draw_share(requests);
  if (shown == "more") draw_more(viewer, report, settings, look, layout, input, requests);
  ImGui::End();
  if (closes) close();

  if (settings_to_json(settings) != settings_to_json(viewer.settings())) requests.settings = settings;
  if (look != viewer.look()) requests.look = look;
}

CardRequests Cards::draw(const Viewer& viewer, const FrameReport& report, const Layout& layout,
                         const std::string& input, Covered& covered) {
  CardRequests requests;
  pins.draw_marks(viewer, layout.picture_px, layout.per_unit());
  if (open_ == "cut") cut_.draw_handle(viewer, rows, layout.picture_px, layout.per_unit(), covered);
  draw_chip(viewer, layout, input, covered);
  draw_zoom(viewer, layout, requests, covered);
  const float margin = kMargin * layout.scale;
  if (!(layout.is_narrow() && !open_.empty()) &&
      groups_.draw_legend(viewer, rows, {margin, layout.lower - margin}, 0.5F * layout.picture.y, covered))
    show("show", input);
  draw_card(viewer, report, layout, input, requests, covered);
  draw_bar(layout, input, covered);
  if (closes_in_ > 0 && --closes_in_ == 0) close();
  ViewerLook look = requests.look.value_or(viewer.look());
  rows.put_into(look);
  if (look != viewer.look()) requests.look = look;
  return requests;
}

}  // namespace bihive::window
