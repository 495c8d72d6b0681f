#include "bihive/job/engine.h"

namespace bihive {

Engine structure_of(RenderEngine engine) {
  switch (engine) {
    case RenderEngine::wide:
      return Engine::wide;
    case RenderEngine::reference:
    case RenderEngine::gpu:
      return Engine::reference;
    case RenderEngine::brute:
    case RenderEngine::gpu_brute:
      return Engine::brute;
    case RenderEngine::wide_brute:
      return Engine::wide_brute;
    case RenderEngine::automatic:
      break;
  }
  return Engine::automatic;
}

}  // namespace bihive
