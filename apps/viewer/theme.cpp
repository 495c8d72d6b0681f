#include "theme.h"

#include <filesystem>

namespace bihive::window {
namespace {

constexpr double kFontSize = 15;

// The paths of a sans-serif font on Linux systems; without it, ImGui's own coarse font.
constexpr const char* kFonts[] = {
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
};

// Letters of European languages, and the signs of names and messages.
constexpr ImWchar kLetters[] = {0x20,   0x24F,  0x370,  0x3FF,  0x400,  0x4FF,  0x2010, 0x2044,
                                0x2070, 0x209C, 0x2190, 0x2193, 0x2200, 0x2265, 0};

void use_font(double size, double pixels_per_unit) {
  ImGuiIO& io = ImGui::GetIO();
  const auto pixels = static_cast<float>(size * pixels_per_unit);
  io.FontGlobalScale = static_cast<float>(1 / pixels_per_unit);
  for (const char* font : kFonts) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(font, ignored)) continue;
    if (io.Fonts->AddFontFromFileTTF(font, pixels, nullptr, kLetters) != nullptr) return;
  }
  ImFontConfig plain;
  plain.SizePixels = pixels;
  io.Fonts->AddFontDefault(&plain);
}

ImVec4 lighter(ImVec4 colour, float by) {
  return {colour.x + by, colour.y + by, colour.z + by, colour.w};
}

}  // namespace

void use_theme(double text_scale, double pixels_per_unit) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.WindowBorderSize = 0;
  style.WindowPadding = {16, 12};
  style.FramePadding = {8, 4};
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.GrabMinSize = 12;
  style.PopupRounding = 4;
  style.ItemSpacing = {8, 5};
  style.CellPadding = {4, 1};
  style.ScrollbarSize = 10;

  const ImVec4 control = lighter(kPanel, 0.07F), hovered = lighter(kPanel, 0.12F);
  ImVec4* colours = style.Colors;
  colours[ImGuiCol_Text] = {0.90F, 0.91F, 0.93F, 1};
  colours[ImGuiCol_TextDisabled] = kDim;
  colours[ImGuiCol_WindowBg] = kPanel;
  colours[ImGuiCol_PopupBg] = lighter(kPanel, 0.03F);
  colours[ImGuiCol_Border] = lighter(kPanel, 0.08F);
  for (const int plain : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_Header}) colours[plain] = control;
  for (const int above : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered})
    colours[above] = hovered;
  for (const int active : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive})
    colours[active] = lighter(kPanel, 0.17F);
  for (const int accent : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_CheckMark, ImGuiCol_PlotHistogram})
    colours[accent] = kAccent;
  colours[ImGuiCol_Separator] = lighter(kPanel, 0.08F);
  colours[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  colours[ImGuiCol_TableRowBg] = {0, 0, 0, 0};
  colours[ImGuiCol_TableRowBgAlt] = {1, 1, 1, 0.03F};

  style.ScaleAllSizes(static_cast<float>(text_scale));
  use_font(kFontSize * text_scale, pixels_per_unit);
}

}  // namespace bihive::window
