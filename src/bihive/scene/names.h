// Names of views, sides and projections: on the command line, in saved settings, in links.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/scene/framing.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

template <class T>
using Names = std::vector<std::pair<std::string, T>>;

inline const Names<View> kViews{
    {"shaded", View::shaded}, {"recursion", View::recursion}, {"traversal", View::traversal},
    {"normal", View::normal}, {"distance", View::distance},   {"id", View::id},
    {"tree", View::tree}};
inline const Names<ViewFrom> kSides{{"front", ViewFrom::front}, {"back", ViewFrom::back}, {"left", ViewFrom::left},
                                    {"right", ViewFrom::right}, {"top", ViewFrom::top},   {"bottom", ViewFrom::bottom},
                                    {"iso", ViewFrom::iso}};
inline const Names<Projection> kProjections{{"perspective", Projection::perspective},
                                            {"orthographic", Projection::orthographic}};

/// The name of a value that is in the list.
template <class T>
std::string name_of(const Names<T>& names, T value) {
  for (const auto& [name, named] : names)
    if (named == value) return name;
  return "";
}

/// "perspective|orthographic".
template <class T>
std::string list_of(const Names<T>& names) {
  std::string list;
  for (const auto& [name, value] : names) list += (list.empty() ? "" : "|") + name;
  return list;
}

/// The value of a name; null if it is not in the list.
template <class T>
const T* value_named(const Names<T>& names, std::string_view wanted) {
  for (const auto& [name, value] : names)
    if (name == wanted) return &value;
  return nullptr;
}

}  // namespace bihive
