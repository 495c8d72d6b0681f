# A thin slice
# Two planes leave three Ångström of the protein, coloured by residue, as in a section under a microscope.
bihive render demo -o 20-a-thin-slice.png --size 480x360 --no-water --colour-by resname:okabe-ito \
  --clip plane:0,0,1,2 --clip plane:0,0,-1,1 --turn 15,10
