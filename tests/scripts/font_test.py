"""The letters that the library embeds are those of the font (scripts/bake_font)."""

import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["BIHIVE_SOURCE"])


class Font(unittest.TestCase):
    def test_the_outlines_are_current(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder, "outlines.bin")
            done = subprocess.run([SOURCE / "scripts/bake_font", output], capture_output=True, text=True)
            if done.returncode == 3:
                self.skipTest(done.stderr)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(output.read_bytes(), (SOURCE / "data/font/outlines.bin").read_bytes())


if __name__ == "__main__":
    unittest.main()
