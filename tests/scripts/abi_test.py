"""The interface of libbihive_c is that of the last release, and scripts/abi tells where one has changed."""

# ctest: LABELS long

import os
import pathlib
import subprocess
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent)).resolve()
# Among the commits before 0.2.0: three functions had other arguments.
CHANGED = "e93002aefdea679bb7eb39d9484599aeac5d3527"


class Abi(unittest.TestCase):
    def compare(self, *commit):
        done = subprocess.run([SOURCE / "scripts" / "abi", *commit], capture_output=True, text=True, check=False)
        if done.returncode == 2:
            self.skipTest(done.stderr.strip())
        return done

    def test_the_release_has_nothing_that_is_gone(self):
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_changed_arguments_are_reported(self):
        done = self.compare(CHANGED)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("bihive_within", done.stdout)


if __name__ == "__main__":
    unittest.main()
