"""Every script is named as every other file is: words in lower case joined by underscores, and no ending, because its
first line says what runs it."""

import os
import pathlib
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))


class Names(unittest.TestCase):
    def scripts(self):
        return sorted(p for p in (SOURCE / "scripts").iterdir() if p.is_file())

    def test_words_joined_by_underscores(self):
        self.assertGreater(len(self.scripts()), 10)
        for script in self.scripts():
            self.assertRegex(script.name, r"\A[a-z][a-z0-9]*(_[a-z0-9]+)*\Z")

    def test_each_is_a_program(self):
        for script in self.scripts():
            self.assertTrue(script.read_bytes().startswith(b"#!/"), f"{script.name} does not begin with #!")
            self.assertTrue(os.access(script, os.X_OK), f"{script.name} cannot be executed")


if __name__ == "__main__":
    unittest.main()
