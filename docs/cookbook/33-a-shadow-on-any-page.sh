# A shadow on any page
# The floor is seen by the shadows on it alone. In a picture without background they are black with an opacity, and lie on whatever is below the picture.
bihive render demo -o 33-a-shadow-on-any-page.png --size 480x360 --no-water --floor shadow --turn 20,25 --background none \
  --light-points 64 --ao-directions 128
