# The drug through the wall
# Of all that is faint, a ray meets the first surface alone: the protein is a thin shell, however many atoms lie behind each other.
bihive render demo -o 31-the-drug-through-the-wall.png --size 480x360 --no-water --view-from 'best:resname 478' \
  --select protein --opacity 0.35 --colour '#b0c4de' --select 'resname 478' --colour '#e08020'
