// Options that people type because another program has them, and what stands for them here (docs/coming_from.md).
#pragma once

#include <array>
#include <string_view>

namespace bihive::cli {

struct ForeignOption {
  std::string_view names;   ///< between blanks, with a blank at both ends
  std::string_view advice;  ///< a hint as a whole
};

inline constexpr std::string_view kSpheresAlone =
    "bihive draws spheres alone; docs/coming_from.md says what else is possible";

inline constexpr std::array kForeignOptions{
    ForeignOption{
        " --cartoon --ribbon --ribbons --tube --trace --surface --mesh --isosurface --sticks --stick --licorice "
        "--bonds --lines --arrows --vectors ",
        kSpheresAlone},
    ForeignOption{" --perspective ", "did you mean --projection perspective?"},
    ForeignOption{" --orthographic --ortho --orthoscopic ", "did you mean --projection orthographic?"},
    ForeignOption{" --transparent --transparent-background ", "did you mean --background none?"},
    ForeignOption{" --transparency --alpha ", "did you mean --opacity? It is 1 minus the transparency"},
    ForeignOption{" --rotate --rotation ", "did you mean --turn?"},
    ForeignOption{" --slice --clip-plane --cut ", "did you mean --clip?"},
    ForeignOption{" --resolution --width --height --res ", "did you mean --size WxH?"},
    ForeignOption{" --antialiasing --aa --spp ", "did you mean --samples?"},
    ForeignOption{" --ambient-occlusion --occlusion ", "did you mean --ao?"},
    ForeignOption{" --depth-cue --depthcue --mist ", "did you mean --fog?"},
    ForeignOption{" --sphere-scale --scale --radius-factor ", "did you mean --radius-scale?"},
    ForeignOption{" --spin --rock ", "did you mean --turntable? bihive film has it"},
};

}  // namespace bihive::cli
