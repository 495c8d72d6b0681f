# Cut open
# A plane takes away half of the protein. The spheres are cut, not left out: their insides are seen as flat discs. The drug stays whole.
bihive render demo -o 06-cut-open.png --size 480x360 --no-water \
  --select protein --clip plane:0,0,1,-4 --select 'resname 478' --colour orange
