# Warm from the left, cold from the right
# `from:RIGHT,UP,TOWARDS:COLOUR:STRENGTH:DEGREES` is a light around the camera. Degrees make the shadow soft.
bihive render demo -o 10-own-lights.png --size 480x360 --no-water --style studio --colour '#d8d8d8' --background '#101418' \
  --light from:-1,0.6,0.4:#ff9030:0.9:12 --light from:1,0.2,0.2:#3070ff:0.8:12
