"""What scripts/wheel refuses about a file of a wheel, and which tag it gives."""

import importlib.machinery
import importlib.util
import os
import pathlib
import sys
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent)).resolve()

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("wheel_script", str(SOURCE / "scripts" / "wheel"))
wheel = importlib.util.module_from_spec(importlib.util.spec_from_loader("wheel_script", loader))
loader.exec_module(wheel)


class Rules(unittest.TestCase):
    def faults(self, needed=(), versions=(), inside=(), glibc=(2, 34)):
        return list(wheel.faults_of("a.so", needed, set(versions), set(inside), glibc))

    def test_libraries(self):
        self.assertEqual(self.faults(["libc.so.6", "libstdc++.so.6", "libpng16.so.16"], inside=["libpng16.so.16"]), [])
        self.assertEqual(len(self.faults(["libpng16.so.16"])), 1)
        self.assertIn("libpng16.so.16", self.faults(["libpng16.so.16"])[0])

    def test_versions_of_symbols(self):
        self.assertEqual(self.faults(versions=[("GLIBC", (2, 2, 5)), ("GLIBC", (2, 34)), ("GLIBCXX", (3, 4, 29))]), [])
        self.assertEqual(len(self.faults(versions=[("GLIBC", (2, 35))])), 1)
        self.assertEqual(len(self.faults(versions=[("GLIBCXX", (3, 4, 30))])), 1)
        self.assertEqual(self.faults(versions=[("GLIBCXX", (3, 4, 30)), ("GLIBC", (2, 36))], glibc=(2, 36)), [])

    def test_the_tag_is_the_oldest_system_that_has_all_symbols(self):
        self.assertEqual(wheel.glibc_of({("GLIBC", (2, 2, 5))}), (2, 17))
        self.assertEqual(wheel.glibc_of({("GLIBC", (2, 33)), ("GLIBCXX", (3, 4, 19))}), (2, 33))
        self.assertEqual(wheel.glibc_of({("GLIBC", (2, 28)), ("GLIBCXX", (3, 4, 30))}), (2, 35))
        with self.assertRaises(SystemExit):
            wheel.glibc_of({("GLIBCXX", (3, 4, 99))})

    def test_what_a_program_says_of_itself(self):
        self.assertIn("libc.so.6", wheel.needed_by("/bin/ls"))
        self.assertTrue([number for name, number in wheel.versions_of("/bin/ls") if name == "GLIBC"])

    def test_a_wheel_of_another_tag(self):
        self.assertEqual(len(wheel.check(pathlib.Path("bihive-1-cp311-cp311-linux_x86_64.whl"))), 1)


if __name__ == "__main__":
    unittest.main()
