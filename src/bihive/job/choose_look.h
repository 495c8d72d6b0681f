// The look of a picture: from a style and the options that change parts of it.
#pragma once

#include "bihive/job/picture_request.h"

namespace bihive {

/// The style that the user names, or the default one. Fails with kBadUsage on an unknown name, with kBadInput on a file
/// that is no style.
Style choose_style(const StyleOptions& options);

/// The options replace parts of the scene's look, and an input without lights gets those of its rig. The camera must
/// stand already.
void apply_look(const StyleOptions& options, Input& input);

}  // namespace bihive
