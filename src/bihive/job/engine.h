// The engine that draws a picture: one of the CPU's, or the GPU.
#pragma once

#include "bihive/render/tracer.h"
#include "bihive/scene/names.h"

namespace bihive {

/// With `gpu` rays traverse the reference tree; with `gpu_brute` they test every sphere.
enum class RenderEngine { automatic, wide, reference, brute, wide_brute, gpu, gpu_brute };

inline const Names<Engine> kEngines{{"auto", Engine::automatic},
                                    {"wide", Engine::wide},
                                    {"reference", Engine::reference},
                                    {"brute", Engine::brute},
                                    {"wide-brute", Engine::wide_brute}};
inline const Names<RenderEngine> kRenderEngines{
    {"auto", RenderEngine::automatic},        {"wide", RenderEngine::wide},
    {"reference", RenderEngine::reference},   {"brute", RenderEngine::brute},
    {"wide-brute", RenderEngine::wide_brute}, {"gpu", RenderEngine::gpu},
    {"gpu-brute", RenderEngine::gpu_brute}};

inline bool is_gpu(RenderEngine engine) {
  return engine == RenderEngine::gpu || engine == RenderEngine::gpu_brute;
}

/// The structure that an engine builds.
Engine structure_of(RenderEngine engine);

}  // namespace bihive
