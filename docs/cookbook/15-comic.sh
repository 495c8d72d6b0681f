# A comic
# `toon` has three steps of brightness; the outline is three pixels wide.
bihive render demo -o 15-comic.png --size 480x360 --no-water --material toon --colour-by resname:okabe-ito --outline 3
