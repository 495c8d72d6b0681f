# Light from everywhere
# Under a cloudy sky ambient occlusion alone shapes the surface: clefts are dark. The distance limits how far a cleft
# reaches.
bihive render demo -o 12-clouds.png --size 480x360 --no-water --colour white --background white --light cloudy \
  --ao-distance 12 --outline 0 --fog 0
