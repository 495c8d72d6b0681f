// The theme of the window: dark and plain, so that the picture stands out.
#pragma once

#include <imgui.h>

namespace bihive::window {

inline const ImVec4 kBackground{0.075F, 0.08F, 0.09F, 1};
inline const ImVec4 kPanel{0.105F, 0.115F, 0.13F, 1};
inline const ImVec4 kDim{0.60F, 0.64F, 0.70F, 1};
inline const ImVec4 kAccent{0.30F, 0.62F, 0.86F, 1};
inline const ImVec4 kChosen{0.21F, 0.39F, 0.53F, 1};  // a button of what is open or chosen
inline const ImVec4 kBad{0.96F, 0.48F, 0.42F, 1};
inline const ImVec4 kGood{0.55F, 0.80F, 0.55F, 1};

/// Sets colours, spaces and font of the current ImGui context. `text_scale` in ImGui's units; the font has the
/// framebuffer's resolution.
void use_theme(double text_scale, double pixels_per_unit);

}  // namespace bihive::window
