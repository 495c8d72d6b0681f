# Sizes that can be measured
# An orthographic picture has one scale, which the bar shows.
bihive render demo -o 14-sizes-for-a-paper.png --size 480x360 --projection orthographic --no-water --scale-bar --axes \
  --colour-by chain --legend
