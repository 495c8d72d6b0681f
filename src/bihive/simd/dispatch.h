// Chooses the target before the first call of vector code.
#pragma once

namespace bihive {

/// Activates the target that BIHIVE_TARGET names, or else the best one.
bool choose_first_target();

/// Cheap after the first call; call it before HWY_DYNAMIC_DISPATCH.
inline void ensure_target() {
  static const bool chosen = choose_first_target();
  (void)chosen;
}

}  // namespace bihive
