"""The library for C: its pictures are those of `bihive render`. c_library.c looks at everything else."""

import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from program import PATIENCE_S, ProgramTest, main, png_numbers  # noqa: E402

C_LIBRARY = os.environ["BIHIVE_C_LIBRARY"]
MOLECULE = str(pathlib.Path(os.environ["BIHIVE_SOURCE"]) / "data/1hpv.pdb")


class PicturesFromC(ProgramTest):
    def test_are_those_of_the_program(self):
        for style in ["default", "illustrative", "xray"]:
            done = subprocess.run(
                [C_LIBRARY, MOLECULE, style, self.path("c.rgba")], capture_output=True, text=True, timeout=PATIENCE_S
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.succeed("render", MOLECULE, "-o", "c.png", "--style", style, "--size", "160x120", "--samples", "2")
            rgba = self.read("c.rgba")
            expected = b"".join(bytes([*pixel, 255]) for row in png_numbers(self.read("c.png")) for pixel in row)
            self.assertGreater(len(set(expected)), 50, "a picture with something in it")
            self.assertTrue(rgba == expected, style)


if __name__ == "__main__":
    main()
