#include "save_card.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bihive/render/memory.h"
#include "widgets.h"

namespace bihive::window {
namespace {

constexpr int kLargestPx = 65535;

// As the page has them (web/src/saving.ts).
struct SavedSize {
  const char* name;
  int times_screen;
  PictureSizePx fixed;
  double wide_cm;  // at 300 pixels per inch, in the shape of the screen's picture
};
constexpr std::array<SavedSize, 8> kSizes{{{"as on the screen", 1, {0, 0}, 0},
                                           {"2 × the screen", 2, {0, 0}, 0},
                                           {"4 × the screen", 4, {0, 0}, 0},
                                           {"slide", 0, {1920, 1080}, 0},
                                           {"square", 0, {2000, 2000}, 0},
                                           {"one column, 8.5 cm at 300 dpi", 0, {0, 0}, 8.5},
                                           {"two columns, 17.8 cm at 300 dpi", 0, {0, 0}, 17.8},
                                           {"other", 0, {0, 0}, 0}}};
constexpr int kOther = static_cast<int>(kSizes.size()) - 1;

PictureSizePx in_px(const SavedSize& size, PictureSizePx screen) {
  if (size.times_screen > 0) return {size.times_screen * screen.width, size.times_screen * screen.height};
  if (size.wide_cm <= 0) return size.fixed;
  const auto px = static_cast<int>(std::lround(size.wide_cm / 2.54 * 300));
  return {px, std::max(1, static_cast<int>(std::lround(double(px) * screen.height / screen.width)))};
}

bool is_possible(PictureSizePx size) {
  return std::max(size.width, size.height) <= kLargestPx && check_picture_memory(size.width, size.height).ok();
}

}  // namespace

PictureSizePx SaveCard::size(PictureSizePx screen) const {
  return chosen_ == kOther ? own_ : in_px(kSizes[static_cast<std::size_t>(chosen_)], screen);
}

bool SaveCard::draw(PictureSizePx screen, ViewerLook& look) {
  const PictureSizePx now = size(screen);
  label("Size");
  if (ImGui::BeginCombo("##size", kSizes[static_cast<std::size_t>(chosen_)].name, ImGuiComboFlags_HeightLarge)) {
    for (int i = 0; i <= kOther; ++i) {
      const SavedSize& one = kSizes[static_cast<std::size_t>(i)];
      const bool possible = i == kOther || is_possible(in_px(one, screen));
      if (!ImGui::Selectable(one.name, i == chosen_, possible ? 0 : ImGuiSelectableFlags_Disabled)) continue;
      if (i == kOther) own_ = now;
      chosen_ = i;
    }
    ImGui::EndCombo();
  }
  label("Pixels");
  std::array<int, 2> pixels{now.width, now.height};
  if (ImGui::InputInt2("##pixels", pixels.data())) {
    chosen_ = kOther;
    own_ = {std::clamp(pixels[0], 1, kLargestPx), std::clamp(pixels[1], 1, kLargestPx)};
  }
  bool transparent = look.background == "none";
  if (check("Transparent", transparent)) look.background = transparent ? "none" : "";
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the picture has opacity instead of a background");
  label("File");
  ImGui::InputText("##file", &file_name);
  hint("Never over another file: its name gets a number.");
  return ImGui::Button("Save picture", {-1, 0});
}

}  // namespace bihive::window
