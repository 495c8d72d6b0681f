"""Exceptions and warnings hold nothing that a terminal obeys, and nothing that nobody sees, whatever was given."""

import os
import subprocess
import sys
import tempfile
import unicodedata
import unittest
import warnings

import bihive

HOSTILE = "a\x1b[31m\x07\x7f\u009b1m\u202eb\u2066\u061c\u2028\u200b\ufeff\U000e0041z"
RAW = b"a\x1b[31m\xff\xfe\xc2\x9b"


class MessagesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="bihive_python_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def assert_harmless(self, text):
        for character in text:
            self.assertFalse(unicodedata.category(character) in ("Cc", "Cf", "Cs", "Zl", "Zp") and character != "\n", repr(text))

    def fails(self, call):
        with self.assertRaises(Exception) as caught:
            call()
        self.assertNotIsInstance(caught.exception, (UnicodeError, SystemError))
        self.assert_harmless(str(caught.exception))
        return caught.exception

    def test_arguments(self):
        spheres = bihive.Spheres([[0, 0, 0]], radius=1)
        for call in [lambda: bihive.read(self.path(HOSTILE)), lambda: bihive.read(os.fsdecode(os.fsencode(self.folder) + b"/" + RAW)),
                     lambda: bihive.render(spheres, **{HOSTILE: 1}), lambda: bihive.render(spheres, background=HOSTILE),
                     lambda: bihive.render(spheres, style=HOSTILE), lambda: bihive.render(spheres, view=HOSTILE),
                     lambda: bihive.select(spheres, HOSTILE), lambda: bihive.select(spheres, "name ~ '" + HOSTILE),
                     lambda: spheres.save(self.path(HOSTILE)), lambda: spheres.save(self.path("no/" + HOSTILE + ".csv")),
                     lambda: spheres.save(self.path("a.csv"), format=HOSTILE)]:
            self.fails(call)

    def test_files_with_bytes_that_are_no_text(self):
        with open(self.path("a.xyz"), "wb") as file:
            file.write(b"2\n\nC 0 0 0\nC 0 " + RAW + b" 0\n")
        self.assertIsInstance(self.fails(lambda: bihive.read(self.path("a.xyz"))), bihive.InputError)

    def test_warnings(self):
        # Elements that nobody knows, at one place.
        name = self.path(HOSTILE + ".xyz")
        with open(name, "wb") as file:
            file.write(b"1\n\nQ\xc2\x9b\xff 0 0 0\n")
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            bihive.read(name)
        self.assertTrue(said)
        for warning in said:
            self.assert_harmless(str(warning.message))


class MaskTest(unittest.TestCase):
    def test_threads_that_save_leave_the_mask_alone(self):
        """The mask of a process is everybody's: another thread's files must not become so."""
        program = """
import bihive, os, sys, threading
os.chdir(sys.argv[1])
os.umask(0o027)
spheres = bihive.Spheres([[0, 0, 0]], radius=1)
picture = bihive.render(spheres, size=(8, 8), samples=1)
done = threading.Event()
def save(k):
    for i in range(40):
        spheres.save(f"{k}.{i % 2}.csv"), picture.save(f"{k}.{i % 2}.png")
threads = [threading.Thread(target=save, args=(k,)) for k in range(3)]
def look():
    n = 0
    while not done.is_set():
        os.close(os.open(f"mine.{n}", os.O_CREAT | os.O_WRONLY, 0o666))
        if os.stat(f"mine.{n}").st_mode & 0o027: print("open to all")
        os.remove(f"mine.{n}")
        n += 1
watch = threading.Thread(target=look); watch.start()
for t in threads: t.start()
for t in threads: t.join()
done.set(); watch.join()
if any(os.stat(f).st_mode & 0o777 != 0o640 for f in os.listdir(".")): print("modes", [oct(os.stat(f).st_mode) for f in os.listdir(".")])
if os.umask(0) != 0o027: print("the mask is gone")
"""
        with tempfile.TemporaryDirectory(prefix="bihive_python_") as folder:
            done = subprocess.run([sys.executable, "-c", program, folder], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
