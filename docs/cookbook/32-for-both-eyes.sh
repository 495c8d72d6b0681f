# For both eyes
# The left eye's view on the left: look through the page, or give the picture to a headset. `--stereo anaglyph` is for red and cyan glasses.
bihive render demo -o 32-for-both-eyes.png --size 720x360 --no-water --stereo side --turn 30,10
