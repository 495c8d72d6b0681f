"""scripts/check_words finds every phrase of its list, and none in this project."""

import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))
SCRIPT = SOURCE / "scripts" / "check_words"

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("check_words", str(SCRIPT))
check_words = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_words", loader))
loader.exec_module(check_words)

# A line with each phrase, in the order of the list.
WRONG = [
    "/// Measures for so many seconds.",
    "// Arrays lie one behind the other.",
    "Some million rays a second, 16 bytes a sphere and 4 samples a pixel.",
    "Embree answers 12 millions a second.",
    "// A single large wish is refused.",
    "// It waits for ever.",
    "// In the place of the mean stands the median.",
    "// A sphere that glows in the dark.",
    "// Each walker returns its rays.",
    "// Rays walk the tree together.",
    '#include "after_effects.h"',
    "void send_on(Wave& wave);",
    "constexpr int kAhead = 8;",
    "std::vector<Sphere> stand_ins;",
    "int from_first(int value);",
]
RIGHT = [
    "so many that they do not fit; so much that it ends; twice a second; a walk through the tutorial",
    "behind the camera; the numbers behind a picture; a ray leaves a sphere; it draws pictures a viewer likes",
    "`glow` of a material; 9.1 pictures per second; up to N spheres; at most 8 bytes per node",
]


class CheckWords(unittest.TestCase):
    def offences(self, files):
        """Runs on a small project, given as path -> content."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check_words.offences(pathlib.Path(folder).resolve())

    def test_every_phrase_is_found(self):
        self.assertEqual(len(WRONG), len(check_words.PHRASES))
        for number, line in enumerate(WRONG):
            with self.subTest(line):
                self.assertRegex(line, check_words.FORBIDDEN[number][0])

    def test_place_and_advice(self):
        found = self.offences({"src/bihive/wide/a.h": "// Good.\n// 16 bytes a sphere.\n", "docs/a.md": "For ever.\n"})
        self.assertEqual(
            found,
            ['docs/a.md:1: "For ever": write forever', 'src/bihive/wide/a.h:2: "bytes a sphere": write bytes per sphere'],
        )

    def test_right_words(self):
        self.assertEqual(self.offences({"docs/a.md": "\n".join(RIGHT)}), [])

    def test_exceptions_and_other_files(self):
        wrong = "so many\n"
        self.assertEqual(self.offences({"CHANGELOG.md": wrong, "data/a.pdb": wrong, "docs/a.json": wrong}), [])
        for exception in check_words.EXCEPTIONS:
            name = exception + "a.md" if exception.endswith("/") else exception
            self.assertEqual(self.offences({name: wrong}), [], exception)

    def test_only_tracked_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for command in (["init", "-q"], ["config", "user.email", "a@b"], ["config", "user.name", "a"]):
                subprocess.run(["git", "-C", folder, *command], check=True)
            for name in ("tracked.md", "other.md"):
                (pathlib.Path(folder) / name).write_text("so many\n", encoding="utf-8")
            subprocess.run(["git", "-C", folder, "add", "tracked.md"], check=True)
            done = subprocess.run([SCRIPT, folder], stdout=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertEqual([line.split(":")[0] for line in done.stdout.splitlines()], ["tracked.md"])

    def test_this_project(self):
        self.assertEqual(check_words.offences(SOURCE.resolve()), [])


if __name__ == "__main__":
    unittest.main()
