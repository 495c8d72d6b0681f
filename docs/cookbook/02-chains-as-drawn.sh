# Chains as in a drawing
# Flat colours, outlines, and lines where two chains touch: the look of David Goodsell's drawings.
bihive render demo -o 02-chains-as-drawn.png --size 480x360 --style illustrative --no-water --view-from iso
