# A crystal's cell and its neighbours
# Copies along the cell's vectors, and its edges.
bihive render demo -o 07-crystal-neighbours.png --size 480x360 --replicate 2x2x1 --cell --colour-by chain \
  --no-water --view-from iso --fog 0.5
