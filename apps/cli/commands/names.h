// Every choice that the command line offers by name. The same names are parsed and printed. The library has the names
// of views and sides.
#pragma once

#include "bihive/render/tracer.h"
#include "bihive/scene/names.h"
#include "commands/commands.h"

namespace bihive::cli {

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
inline const Names<RangeOfColours> kRangesOfColours{
    {"first", RangeOfColours::first}, {"film", RangeOfColours::film}, {"frame", RangeOfColours::frame}};

}  // namespace bihive::cli
