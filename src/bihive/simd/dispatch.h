// Chooses the target before the first call of vector code.
#pragma once

namespace bihive {

/// Takes the wish of BIHIVE_TARGET, or the best target, into use.
bool choose_first_target();

/// Cheap after the first call; call it before HWY_DYNAMIC_DISPATCH.
inline void ensure_target() {
  static const bool chosen = choose_first_target();
  (void)chosen;
}

}  // namespace bihive
