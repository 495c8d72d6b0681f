// Groups of spheres that have a name: the list of the card "Show", and the legend over the picture. Each entry changes
// rows of the look, which stand in the same card.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bihive/viewer/contents.h"
#include "bihive/viewer/viewer.h"
#include "look_rows.h"
#include "widgets.h"

namespace bihive::window {

class Groups {
 public:
  /// Other spheres: what they are is asked for when it is needed.
  void forget();
  /// Other colours.
  void forget_legend() { has_legend_ = false; }

  void draw_list(const Viewer& viewer, LookRows& rows);
  /// With its lower left corner there. True: the rest of a long legend is asked for.
  bool draw_legend(const Viewer& viewer, LookRows& rows, ImVec2 corner, float most_height, Covered& covered);

 private:
  struct Entry {
    std::string name, selection, colour;
  };
  struct Key {
    std::string title, least, most;
    std::vector<std::string> scale;  // colours from low to high; empty: categories
    std::vector<Entry> entries;
  };

  void update(const Viewer& viewer);
  void update_legend(const Viewer& viewer);
  bool is_only(const LookRows& rows, const std::string& selection) const;
  void show_only(LookRows& rows, const std::string& selection, bool only) const;
  void draw_entry(const Entry& entry, LookRows& rows, const std::string& count);
  void draw_details(const Entry& entry, LookRows& rows) const;

  bool has_groups_ = false, has_legend_ = false;
  std::vector<ContentGroup> groups_;
  std::vector<Key> legend_;
  std::map<std::string, std::string> colours_;  // of selections, by the legend
};

}  // namespace bihive::window
