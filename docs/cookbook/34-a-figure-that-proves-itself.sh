# A figure that proves itself
# The file says how it was drawn. Anyone who has it can draw it again, and compare every bit; the second command fails if one differs.
bihive render demo -o 34-a-figure-that-proves-itself.png --size 480x360 --style studio --colour-by chain --legend
bihive verify 34-a-figure-that-proves-itself.png
