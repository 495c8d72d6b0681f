// Named choices of the command line alone.
#pragma once

#include "bihive/scene/names.h"
#include "commands/commands.h"

namespace bihive::cli {

inline const Names<RangeOfColours> kRangesOfColours{
    {"first", RangeOfColours::first}, {"film", RangeOfColours::film}, {"frame", RangeOfColours::frame}};
inline const Names<FittedFrames> kFittedFrames{
    {"first", FittedFrames::first}, {"all", FittedFrames::all}, {"each", FittedFrames::each}};

}  // namespace bihive::cli
