"""The library for C: its pictures are those of `bihive render`. c_library.c looks at everything else."""

import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from program import PATIENCE_S, ProgramTest, main, png_numbers  # noqa: E402

C_LIBRARY = os.environ["BIHIVE_C_LIBRARY"]
MOLECULE = str(pathlib.Path(os.environ["BIHIVE_SOURCE"]) / "data/1hpv.pdb")


# Camera, lens, lights, appearance, labels, views and engines: names and values of C, and the same for the program.
SETTINGS = [
    ["view_from", "left", "turn", "20,10", "zoom", "1.5", "projection", "orthographic"],
    ["eye", "30,10,60", "look_at", "0,0,0", "fov", "20", "aperture", "0.5", "focus", "resname 478"],
    ["select", "chain B", "colour", "orange", "radius_scale", "0.5", "select", "resname 478", "material", "glass", "outline", "3"],
    ["colour_by", "b_factor:viridis", "legend", "true", "no_water", "true", "light", "studio", "clip", "plane:0,0,1,10"],
    ["view", "traversal", "max_prims", "2", "engine", "reference", "background", "#203040"],
    ["projection", "orthographic", "scale_bar", "true", "title", "{spheres} spheres", "dpi", "300", "element_colours", "jmol"],
]


class PicturesFromC(ProgramTest):
    def test_are_those_of_the_program(self):
        for style, settings in [("default", []), ("illustrative", []), ("xray", []), *(("default", one) for one in SETTINGS)]:
            done = subprocess.run(
                [C_LIBRARY, MOLECULE, style, self.path("c.rgba"), *settings], capture_output=True, text=True, timeout=PATIENCE_S
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            words = [
                "--" + name.replace("_", "-") + ("" if value == "true" else "=" + value)
                for name, value in zip(settings[::2], settings[1::2])
            ]
            self.succeed("render", MOLECULE, "-o", "c.png", "--style", style, "--size", "160x120", "--samples", "2", *words)
            rgba = self.read("c.rgba")
            expected = b"".join(bytes([*pixel, 255]) for row in png_numbers(self.read("c.png")) for pixel in row)
            self.assertGreater(len(set(expected)), 5, "a picture with something in it")
            self.assertTrue(rgba == expected, (style, settings))


if __name__ == "__main__":
    main()
