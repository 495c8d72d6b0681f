# A protein of glass around its drug
# Of all spheres of one opacity a ray meets the first alone, so the protein looks like one hollow body.
bihive render demo -o 05-a-protein-of-glass.png --size 480x360 --no-water \
  --select protein --opacity 0.25 --select 'resname 478' --colour '#d03020' --material plastic
