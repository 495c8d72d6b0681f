"""A build folder that was configured before the packages of the window were installed."""

import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = os.environ["BIHIVE_SOURCE"]


class LatePackages(unittest.TestCase):
    def configure(self, folder, *options):
        command = ["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", *options]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return "bihive-view" in pathlib.Path(folder, "build.ninja").read_text()

    def test_the_window_is_built_once_its_packages_are_there(self):
        if "BIHIVE_VIEW" not in os.environ:
            self.skipTest("bihive-view was not built: its packages are not there")
        with tempfile.TemporaryDirectory() as folder:
            self.assertFalse(self.configure(folder, "-DCMAKE_DISABLE_FIND_PACKAGE_glfw3=ON"))
            self.assertTrue(self.configure(folder, "-UCMAKE_DISABLE_FIND_PACKAGE_glfw3"))
            self.assertFalse(self.configure(folder, "-DBIHIVE_BUILD_VIEWER=OFF"))


if __name__ == "__main__":
    unittest.main()
