# A drug in its pocket
# Only what lies within 5 Ångström of the drug stays, drawn smaller than its real size, so that the drug is visible.
bihive render demo -o 03-a-drug-in-its-pocket.png --size 480x360 --no-water --view-from left \
  --select 'not within 5 of resname 478' --hide \
  --select 'within 5 of resname 478' --radius-scale 0.55 \
  --select 'resname 478' --colour '#40b060' --radius-scale 1 --outline 2
