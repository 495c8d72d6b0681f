"""scripts/update_golden: what it says of a build without tests, of pictures written, and of a test that breaks.

A `ctest` of our own stands first in PATH, so that no picture of the project is touched.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))
WRITTEN = "7: golden.cpp:16: Failure\n7: Failed\n7: updated /somewhere/four-spheres.png\n"


class UpdateGolden(unittest.TestCase):
    def run_on(self, printed):
        """Runs the script on a build whose ctest prints this, and fails as a test does that wrote a picture."""
        with tempfile.TemporaryDirectory() as folder:
            build = pathlib.Path(folder)
            (build / "CTestTestfile.cmake").touch()
            (build / "printed").write_text(printed)
            ctest = build / "ctest"
            ctest.write_text(f'#!/bin/sh\necho "update: $BIHIVE_UPDATE_GOLDEN $*"\ncat {build}/printed\nexit 8\n')
            ctest.chmod(0o755)
            environment = dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}")
            command = [SOURCE / "scripts" / "update_golden", build]
            return subprocess.run(command, env=environment, capture_output=True, text=True)

    def test_pictures_written(self):
        done = self.run_on(WRITTEN + WRITTEN)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("2 pictures were written", done.stdout)

    def test_another_failure_is_told(self):
        done = self.run_on(WRITTEN + "7: golden.cpp:20: Failure\n7: no such folder\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no such folder", done.stderr)

    def test_a_crash_is_told(self):
        done = self.run_on(WRITTEN + "1/1 Test #7: golden.pictures ...***Exception: SegFault\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("SegFault", done.stderr)

    def test_it_asks_for_the_golden_tests(self):
        done = self.run_on("")
        self.assertEqual(done.returncode, 1)
        self.assertIn("update: 1 --test-dir", done.stderr)
        self.assertIn("-L ^golden$ --no-tests=error", done.stderr)

    def test_a_folder_without_a_build_is_told(self):
        done = subprocess.run([SOURCE / "scripts" / "update_golden", "nowhere"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no tests were built in nowhere", done.stderr)


if __name__ == "__main__":
    unittest.main()
