// Widgets shared by the cards.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

#include "theme.h"

namespace bihive::window {

/// "samples" as "Samples".
std::string sentence(std::string_view text);

/// "12,345".
std::string grouped(std::int64_t count);

void heading(const char* text);

/// A label in the left column, and its control in the right one.
void label(const std::string& text);

/// Dim, over several lines.
void hint(const std::string& text);

/// A part of a card that is closed until the user opens it.
bool group(const char* name);

/// A name from a list; the empty one is shown as `otherwise`. True: another one is chosen.
bool choice(const char* name, const char* otherwise, const std::vector<std::string>& names, std::string& chosen);

bool check(const char* name, bool& value);

/// A check box that is a small square with a colour: "#rrggbb", or another text that means one.
bool colour_edit(const char* id, std::string& colour);

/// The text, shortened by full stops at its end to fit this width.
std::string elided(const std::string& text, float width);

/// Of what lies over the picture, from its borders.
constexpr float kMargin = 12;

/// Flags of the windows over the picture.
constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

/// The parts of the picture that controls cover, as last drawn. ImGui knows what is under the pointer as of the last
/// frame; events come with positions of their own.
class Covered {
 public:
  void clear() { areas_.clear(); }
  /// The window that is being drawn.
  void add_window();
  bool has(double x, double y) const;

 private:
  std::vector<ImVec4> areas_;
};

/// Text fields of which one is being edited: until the user has finished, its value stays.
class Fields {
 public:
  /// True: the user has finished another text.
  bool text(const std::string& name, const char* hint, std::string& value);
  /// The same for a number; an empty text, or one that is not a number from 0, gives `otherwise`, which is shown as
  /// empty.
  bool number(const std::string& name, const char* hint, double otherwise, double& value);
  void forget();

 private:
  std::string edited_, text_;  // the field, and its unfinished text
};

}  // namespace bihive::window
