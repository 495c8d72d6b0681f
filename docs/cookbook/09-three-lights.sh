# Three lamps of a studio
# Key, fill and rim light with soft shadows, on light grey.
bihive render demo -o 09-three-lights.png --size 480x360 --style studio --view-from right
