// Text and marks drawn on a finished picture.
#pragma once

#include <optional>
#include <string>

namespace bihive {

struct Labels {
  bool legend = false;     ///< the meaning of the colours (scene/legend.h)
  bool scale_bar = false;  ///< a round length of the world; for orthographic pictures
  bool axes = false;       ///< the directions of x, y and z
  std::string title = "";  ///< UTF-8; empty: none
  /// The unit of lengths, after the scale bar's number. Unset: the input's (Scene::length_unit). Empty: none.
  std::optional<std::string> length_unit = std::nullopt;
  /// Above the legend's last bar or list of names, UTF-8; empty: the attribute's name.
  std::string legend_title = "";

  bool any() const { return legend || scale_bar || axes || !title.empty(); }
};

}  // namespace bihive
