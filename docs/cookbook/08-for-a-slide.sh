# For a slide: no background
# The background is transparent, the file states 300 pixels per inch, and each number has 16 bits.
bihive render demo -o 08-for-a-slide.png --size 480x360 --style glossy --background none --bits 16 --dpi 300 --samples 16
