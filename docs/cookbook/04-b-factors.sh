# Numbers as colours
# Any number in a file can be the colour; the legend explains it. `bihive info demo --attributes` lists the names.
bihive render demo -o 04-b-factors.png --size 480x360 --projection orthographic --no-water \
  --colour-by b_factor:magma:10,60 --legend --title 'Where the protein moves'
