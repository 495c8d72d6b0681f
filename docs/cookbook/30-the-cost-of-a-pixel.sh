# The cost of a pixel
# Steps through the tree for each pixel, with leaves of one sphere: dark is cheap.
bihive render scenario1 -o 30-the-cost-of-a-pixel.png --count 200 --max-prims 1 --engine reference --size 480x360 --view traversal
