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
    """Files that documents for newcomers and comments name: render/tracer.h."""

    BASES = ("", "src", "src/bihive", "src/bihive/io", "src/bihive/render", "src/bihive/wide", "src/bihive/gl", "apps/cli", "bindings/python", "tests", "docs")
    NAME = re.compile(r"(?<![\w./-])((?:[a-z_]+/)+[a-z_-]+\.(?:h|cpp|glsl|py|ts|md))\b")

    def missing(self, path, names):
        bases = [*(SOURCE / base for base in self.BASES), path.parent, path.parent.parent]
        return [f"{path.relative_to(SOURCE)}: {name}" for name in names if not any((base / name).is_file() for base in bases)]

    def test_documents(self):
        for document in ("HACKING.md", "docs/architecture.md"):
            names = set(self.NAME.findall((SOURCE / document).read_text(encoding="utf-8")))
            self.assertGreater(len(names), 25)
            self.assertEqual(self.missing(SOURCE / document, sorted(names)), [])

    def test_comments(self):
        missing, named = [], 0
        for folder in ("src", "apps", "bindings", "bench", "tests/support"):
            for path in (p for p in (SOURCE / folder).rglob("*") if p.suffix in (".h", ".cpp", ".glsl")):
                comments = re.findall(r"//.*", path.read_text(encoding="utf-8"))
                names = {name for comment in comments if "http" not in comment for name in self.NAME.findall(comment)}
                named += len(names)
                missing += self.missing(path, sorted(names))
        self.assertGreater(named, 200)
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
