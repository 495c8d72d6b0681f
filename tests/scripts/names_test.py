"""Every script is named as every other file is: words in lower case joined by underscores, and no ending, because its
first line says what runs it. Files that the documents for newcomers name are there."""

import os
import pathlib
import re
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


class NamedFiles(unittest.TestCase):
    """`render/tracer.h` in HACKING.md and docs/architecture.md: from the top, or from one of these folders."""

    BASES = ("", "src/bihive", "src/bihive/io", "src/bihive/render", "bindings/python", "tests")

    def test_each_is_there(self):
        for document in ("HACKING.md", "docs/architecture.md"):
            text = (SOURCE / document).read_text(encoding="utf-8")
            names = set(re.findall(r"`([a-z_]+(?:/[A-Za-z_.-]+)+\.(?:cpp|h|py|ts|md|txt))`", text))
            self.assertGreater(len(names), 30)
            for name in sorted(names):
                if not any(word.isupper() for word in re.split(r"[/_.]", name)):  # FORMAT.cpp is a name to come
                    with self.subTest(document=document):
                        self.assertTrue(any((SOURCE / base / name).is_file() for base in self.BASES), f"{document} names {name}")


if __name__ == "__main__":
    unittest.main()
