// A user's choices as JSON: for links, saved states, and the page's worker.
#pragma once

#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/viewer/viewer_look.h"
#include "bihive/viewer/viewer_settings.h"

namespace bihive {

/// One line: {"engine":"cpu","view":"shaded","max_prims":null,"max_depth":null, ..., "set":["fog"],"focus_on":"",
/// "replicate":null,"camera":{"eye":[x,y,z],"look_at":[x,y,z],"up":[x,y,z],"fov_deg":30,"projection":"perspective",
/// "shorter_side":50,"aperture":0,"focus":0}}, with each parameter of settings/parameter.h that windows have under its
/// id. "set" names those that the user has set; the others are the scene's. Numbers come back exactly.
std::string settings_to_json(const ViewerSettings& settings);

/// Missing members come from `base`. With "set" the user's parameters are those that it names, and no others; without
/// it, those present are added. A limit of the tree is a number, "unlimited" (kUnlimited), or null, which leaves the
/// choice to the engine. "replicate": [2,2,1], or null for the input's. Another projection without a shorter side keeps
/// the size of objects at the distance of look_at. Error: not JSON, an unknown key, a wrong type, a number out of
/// range; the message begins with the JSON pointer ("/camera/eye: ..."). Whether the camera sees anything is not
/// checked here: Viewer::set() checks it.
Result<ViewerSettings> settings_from_json(std::string_view json, const ViewerSettings& base = {});

/// One line:
/// {"style":"studio","element_colours":"","background":"none","lights":["cloudy"],"colour_by":"b_factor:magma",
/// "nan_colour":"","crease":"chain","floor":"shadow","rows":[{"select":"chain A","action":"colour","value":"red"}]}.
std::string viewer_look_to_json(const ViewerLook& look);

/// Missing members come from `base`. Errors as above. Whether the scene has such spheres and attributes is not checked
/// here: Viewer::set_look() checks it.
Result<ViewerLook> viewer_look_from_json(std::string_view json, const ViewerLook& base = {});

/// The table of settings/parameter.h, an array with an object for each row.
std::string parameters_to_json();

}  // namespace bihive
