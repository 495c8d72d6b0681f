# A protein of glass around its drug
# Opacity counts once for each sphere, in the right order, whatever their number.
bihive render demo -o 05-a-protein-of-glass.png --size 480x360 --no-water \
  --select protein --opacity 0.06 --select 'resname 478' --colour '#d03020' --material plastic
