// Code that is compiled for every target and tells which one it is.
#include "bihive/simd/target.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/simd/compiled_target.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/simd/dispatch.h"
#include "bihive/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

CompiledTarget compiled_target_here() {
  return {hwy::TargetName(HWY_TARGET), kFloatLanes};
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(compiled_target_here);

CompiledTarget compiled_target() {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(compiled_target_here)();
}

}  // namespace bihive
#endif
