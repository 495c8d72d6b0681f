// The appearance of a picture: a style, and the options that change it.
#pragma once

#include "bihive/job/picture_request.h"

namespace bihive {

/// The style that the user names, or the default one. Fails with kBadUsage on an unknown name, with kBadInput on a file
/// that is not a style.
Style choose_style(const StyleOptions& options);

/// Applies the options to the scene's appearance; an input without lights gets those of its rig. The camera must be
/// known.
void apply_look(const StyleOptions& options, Input& input);

}  // namespace bihive
