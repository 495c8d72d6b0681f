"""scripts/bench: the report of a part names its command, commit and machine; nothing is measured here."""

import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import unittest
from unittest import mock

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("bench", str(SOURCE / "scripts" / "bench"))
bench = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench", loader))
loader.exec_module(bench)


class BenchScript(unittest.TestCase):
    def report(self, part, target="", commit_later="abc"):
        """The report of a part that measures nothing, with this BIHIVE_TARGET, and this commit at its start."""
        with mock.patch.dict(os.environ, {"BIHIVE_TARGET": target}), mock.patch.object(bench, "commit_now") as commit:
            commit.return_value = "abc"
            made = bench.Bench(SOURCE / "build", SOURCE / "out", False)
            commit.return_value = commit_later
            setattr(made, part, lambda: [made.run("echo", "{}")])
            return made.report(part)

    def test_a_report_names_its_origin(self):
        report = self.report("thesis")
        self.assertEqual((report["part"], report["command"], report["commit"]), ("thesis", "scripts/bench thesis", "abc"))
        self.assertTrue({"cpus", "vectors", "memory_gb"} <= report["machine"].keys())
        self.assertEqual(report["runs"][0]["command"], "echo {}")

    def test_a_forced_instruction_set_is_a_part_of_the_command(self):
        report = self.report("thesis", "avx2")
        self.assertEqual(report["command"], "BIHIVE_TARGET=avx2 scripts/bench thesis")
        self.assertEqual(report["runs"][0]["command"], "BIHIVE_TARGET=avx2 echo {}")

    def test_a_part_that_builds_must_find_the_same_commit(self):
        for part in ("wasm", "page"):
            with self.assertRaisesRegex(SystemExit, "sources changed"):
                self.report(part, commit_later="def")
        self.assertEqual(self.report("growth", commit_later="def")["commit"], "abc")

    def test_an_unknown_part_is_an_error_that_names_the_parts(self):
        done = subprocess.run([SOURCE / "scripts" / "bench", "frames"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no part 'frames'; there are: scenes, avx2", done.stderr)


if __name__ == "__main__":
    unittest.main()
