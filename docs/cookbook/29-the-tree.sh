# The tree that finds the hits
# The boxes of the bounding interval hierarchy, level by level.
bihive render scenario1 -o 29-the-tree.png --count 300 --size 480x360 --view tree --view-from iso
