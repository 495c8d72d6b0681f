// What the page's lists and controls offer, from the library's own tables.
#pragma once

#include <string>

namespace bihive {

/// A JSON object. "name" is what settings and looks hold, "label" what a list shows.
///   "built_ins"        [{"name", "label", "kind": "file", "scenario" or "fixed"}] (scene/load_scene.h)
///   "styles"           [{"name", "description"}]
///   "actions"          [{"name", "label", "value", "example", "names": "none", "colours", "materials" or "attributes",
///                      "is_number"}] (scene/look_text.h)
///   "materials", "lights", "colours", "element_colours", "sides", "projections": [names]
///   "views"            [{"name", "label"}]
///   "maps"             [{"name", "colours": ["#rrggbb" from low to high]}]; a map for categories has none
///   "settings"         the table of settings/parameter.h
///   "reading"          [{"id", "label", "help", "empty_means", "kind": "flag", "number" or "text", "excludes": [ids],
///                      "shown_for": of io/reading_settings.h, "inputs"}], those that have a control
///   "formats"          the names of formats that hold spheres, in a sentence
///   "most_pixels"      of the largest square picture that memory holds
std::string choices_to_json();

}  // namespace bihive
