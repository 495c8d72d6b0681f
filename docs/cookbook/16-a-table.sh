# A table with names of its own
# `--columns` names the column for each quantity. The remaining columns can be colours.
cat >tanks.csv <<'END'
east,north,height,size,full
0,0,0,1.0,0.9
4.5,0.3,0.2,1.2,0.4
2.1,4.0,0.1,0.8,0.7
6.4,4.3,0.5,1.5,0.1
-2.2,3.2,0,0.9,0.55
END
bihive render tanks.csv -o 16-a-table.png --size 480x360 --columns x=east,y=height,z=north,r=size \
  --colour-by full:viridis:0,1 --legend --turn 20,40
