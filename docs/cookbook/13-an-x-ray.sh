# An X-ray, and one bright chain
bihive render demo -o 13-an-x-ray.png --size 480x360 --style xray --no-water \
  --select 'resname 478' --material matte --opacity 1 --colour '#ffc840'
