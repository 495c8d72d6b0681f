// Every choice that the command line offers by name, in one place: what is parsed is also what is printed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bihive/image/transfer.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/framing.h"

namespace bihive::cli {

template <class T>
using Names = std::vector<std::pair<std::string, T>>;

inline const Names<View> kViews{
    {"shaded", View::shaded}, {"recursion", View::recursion}, {"traversal", View::traversal},
    {"normal", View::normal}, {"distance", View::distance},   {"id", View::id},
    {"tree", View::tree}};
inline const Names<Engine> kEngines{
    {"auto", Engine::automatic}, {"wide", Engine::wide}, {"reference", Engine::reference}, {"brute", Engine::brute}};
inline const Names<Transfer> kTransfers{{"srgb", Transfer::srgb}, {"none", Transfer::none}};
inline const Names<ViewFrom> kSides{{"front", ViewFrom::front}, {"back", ViewFrom::back}, {"left", ViewFrom::left},
                                    {"right", ViewFrom::right}, {"top", ViewFrom::top},   {"bottom", ViewFrom::bottom},
                                    {"iso", ViewFrom::iso}};

/// The name of a value that is in the list.
template <class T>
std::string name_of(const Names<T>& names, T value) {
  for (const auto& [name, named] : names)
    if (named == value) return name;
  return "";
}

}  // namespace bihive::cli
