// Options that people type because another program has them, and what stands for them here (docs/coming_from.md).
#pragma once

#include <array>
#include <string_view>

namespace bihive::cli {

struct ForeignOption {
  std::string_view names;   ///< between blanks, with a blank at both ends
  std::string_view option;  ///< ours; empty: there is none
  std::string_view usage;   ///< of ours
};

/// The hint for an option without a counterpart.
inline constexpr std::string_view kSpheresAlone =
    "bihive draws spheres, bonds, arrows and tubes; docs/coming_from.md says what else is possible";

inline constexpr std::array kForeignOptions{
    ForeignOption{" --cartoon --ribbon --ribbons --surface --mesh --isosurface --lines ", "", ""},
    ForeignOption{" --tube --tubes --putty ", "--trace", "--trace chain"},
    ForeignOption{" --vectors --vector --arrow ", "--arrows", "--arrows VX,VY,VZ"},
    ForeignOption{" --sticks --stick --licorice ", "--style", "--style licorice"},
    ForeignOption{" --ball-and-stick --balls-and-sticks ", "--style", "--style ball-and-stick"},
    ForeignOption{" --perspective ", "--projection", "--projection perspective"},
    ForeignOption{" --orthographic --ortho --orthoscopic ", "--projection", "--projection orthographic"},
    ForeignOption{" --center --centre ", "--look-at", "--look-at EXPR"},
    ForeignOption{" --zoom-on ", "--zoom-to", "--zoom-to EXPR"},
    ForeignOption{" --orient ", "--view-from", "--view-from principal"},
    ForeignOption{" --rotate --rotation ", "--turn", "--turn AZ,EL"},
    ForeignOption{" --superpose --intra-fit ", "--align", "--align EXPR"},
    ForeignOption{" --track ", "--follow", "--follow EXPR"},
    ForeignOption{" --spin ", "--turntable", "--turntable 360"},
    ForeignOption{" --transparent --transparent-background ", "--background", "--background none"},
    ForeignOption{" --transparency --alpha ", "--opacity", "--opacity, which is 1 minus the transparency"},
    ForeignOption{" --slice --clip-plane --cut ", "--clip", "--clip"},
    ForeignOption{" --resolution --width --height --res ", "--size", "--size WxH"},
    ForeignOption{" --antialiasing --aa --spp ", "--samples", "--samples"},
    ForeignOption{" --ambient-occlusion --occlusion ", "--ao", "--ao"},
    ForeignOption{" --depth-cue --depthcue --mist ", "--fog", "--fog"},
    ForeignOption{" --sphere-scale --scale --radius-factor ", "--radius-scale", "--radius-scale"},
};

}  // namespace bihive::cli
