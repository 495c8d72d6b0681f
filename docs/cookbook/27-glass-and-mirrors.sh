# Glass, mirrors and a chequered floor
# A scene file states everything itself: camera, lights, materials, floor.
cat >still.json <<'END'
{"bihive_scene": 2,
 "camera": {"eye": [0, 2.2, 11], "look_at": [0, 0.1, 0], "fov_deg": 26},
 "lights": [{"position": [-8, 14, 9], "radius": 1.5}],
 "materials": [
   {"name": "mirror", "ambient": 0.05, "diffuse": 0.15, "reflective": 0.8, "specular": 0.3, "power": 200},
   {"name": "glass", "ambient": 0, "diffuse": 0.05, "specular": 0.2, "transmissive": 0.9, "refraction_index": 1.5},
   {"name": "red", "colour": "#c03028", "ambient": 0.2, "diffuse": 0.7, "specular": 0.1, "power": 40}],
 "plane": {"point": [0, -1, 0], "normal": [0, 1, 0],
           "material": {"colour": [0.8, 0.8, 0.8], "ambient": 0.3, "diffuse": 0.6, "specular": 0},
           "checker": {"size": 1, "second_colour": [0.45, 0.45, 0.5], "fade_distance": 60}},
 "background": "#b8d0e8",
 "picture": {"width_px": 480, "height_px": 360, "samples_per_pixel": 16, "recursion": 8},
 "spheres": [[-2.1, 0, -0.5, 1, "mirror"], [0, 0, 1.2, 1, "glass"], [2.1, 0, -0.5, 1, "red"],
             [0.2, -0.6, -2, 0.4, "red"], [-1, -0.7, 2.4, 0.3, "mirror"]]}
END
bihive render still.json -o 27-glass-and-mirrors.png
