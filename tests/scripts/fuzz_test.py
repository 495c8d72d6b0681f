"""scripts/fuzz with a false target: it counts what ran, over several runs, and fails where something was found."""

import os
import shutil
import subprocess
import tempfile
import unittest

SOURCE = os.environ["BIHIVE_SOURCE"]
TARGET = """#!/bin/sh
for word in "$@"; do
  case $word in
    -artifact_prefix=*) prefix=${word#-artifact_prefix=} ;;
    -max_total_time=*) sleep 1 ;;
  esac
done
echo "#9 DONE cov: 123 ft: 200 corp: 3/9b" >&2
echo "stat::number_of_executed_units: 1000" >&2
if [ -n "$FIND" ] && [ ! -e "${prefix}crash-1" ]; then touch "${prefix}crash-1"; exit 77; fi
"""


class Fuzz(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="bihive_fuzz_")
        self.addCleanup(shutil.rmtree, self.folder)
        targets = os.path.join(self.folder, "build/tests/fuzz")
        os.makedirs(targets)
        path = os.path.join(targets, "csv_fuzz")
        with open(path, "w") as file:
            file.write(TARGET)
        os.chmod(path, 0o755)

    def run_fuzz(self, *arguments, **environment):
        environment = {
            **os.environ,
            "BIHIVE_FUZZ_BUILD": os.path.join(self.folder, "build"),
            "BIHIVE_FUZZ_KEPT": os.path.join(self.folder, "kept"),
            **environment,
        }
        return subprocess.run(
            [os.path.join(SOURCE, "scripts/fuzz"), *arguments], capture_output=True, text=True, env=environment
        )

    def test_it_counts_over_several_runs(self):
        # No minute: nothing runs, but the columns are there.
        done = self.run_fuzz("0", "csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"csv +\d+ +0 +0 +0 +0\nall runs so far: 0 executions, 0 finds\n$")
        with open(os.path.join(self.folder, "kept/runs.tsv"), "a") as file:
            file.write("2000-01-01T00:00:00Z\tabc\tcsv\t60\t5000\t120\t3\t0\n")
        done = self.run_fuzz("0", "csv")
        self.assertIn("all runs so far: 5000 executions, 0 finds", done.stdout)
        done = self.run_fuzz("--fast", "0", "csv")
        self.assertIn("all runs so far: 5000 executions, 0 finds", done.stdout)

    def test_it_goes_on_after_a_find_and_fails(self):
        # A minute of a target that ends at once would take a minute: the false one stops it by ten finds.
        with open(os.path.join(self.folder, "build/tests/fuzz/csv_fuzz"), "w") as file:
            file.write(TARGET.replace('[ ! -e "${prefix}crash-1" ]', "true").replace("sleep 1", ":"))
        done = self.run_fuzz("1", "csv", FIND="1")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"csv +\d+ +10000 +123 +0 +10\n")
        self.assertIn("inputs that failed are in", done.stderr)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "kept/finds/csv-crash-1")))

    def test_what_it_refuses(self):
        self.assertEqual(self.run_fuzz().returncode, 2)
        self.assertEqual(self.run_fuzz("soon").returncode, 2)
        self.assertEqual(self.run_fuzz("--fast").returncode, 2)
        self.assertEqual(self.run_fuzz("--fast", "soon").returncode, 2)
        self.assertEqual(self.run_fuzz("--quick").returncode, 2)
        self.assertIn("no target nothing", self.run_fuzz("1", "nothing").stderr)


if __name__ == "__main__":
    unittest.main()
