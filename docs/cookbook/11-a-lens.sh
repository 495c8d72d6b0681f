# A lens, and what is sharp
# `--focus` takes a distance or the spheres that shall be sharp.
bihive render demo -o 11-a-lens.png --size 480x360 --no-water --colour-by chain --view-from iso --zoom 1.5 \
  --aperture 1.5 --focus 'resid 37 and chain B'
