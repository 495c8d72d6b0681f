// One picture by several processes: bands of rows, handed out by a counter that all share.
#pragma once

#include "commands/draw_picture.h"
#include "support/team.h"

namespace bihive::cli {

/// The same bits as alone. `file`: that of rank 0, null on the others, whose answer counts their own rays. Fails and
/// throws as draw_picture().
Drawn draw_with_team(const Scene& scene, const Tracer& tracer, const RenderSettings& settings, PictureFile* file,
                     const ProgressCallback& progress, Team& team);

Fingerprint fingerprint_of_program();
/// Hashes that all ranks compare before they draw: of the program, the spheres, the settings (`described`, as the
/// picture's file keeps them).
std::vector<Fingerprint> fingerprints_of(const Scene& scene, const std::string& described);

}  // namespace bihive::cli
