"""tests/readme/run_readme.py finds, skips and runs the right commands."""

import contextlib
import importlib.util
import io
import os
import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))

sys.dont_write_bytecode = True
spec = importlib.util.spec_from_file_location("run_readme", SOURCE / "tests" / "readme" / "run_readme.py")
run_readme = importlib.util.module_from_spec(spec)
spec.loader.exec_module(run_readme)


class RunReadme(unittest.TestCase):
    def run_text(self, text):
        """The result of run_blocks, and the files that exist afterwards."""
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            count = run_readme.run_blocks(text, folder)
            return count, sorted(path.name for path in pathlib.Path(folder).iterdir())

    def test_blocks(self):
        text = "a\n```sh\ntouch one\n\n# note\ntouch \\\n  two\n```\n```cpp\ntouch three\n```\n```sh notest\ntouch four\n```\n"
        self.assertEqual(self.run_text(text), (2, ["one", "two"]))

    def test_commands_that_are_not_run(self):
        text = "```sh\nsudo apt-get install -y git make\ngit clone x\ncd bihive\nmake test\n.ci/run\ntouch one\n```\n"
        self.assertEqual(self.run_text(text), (1, ["one"]))

    def test_demo_does_not_install(self):
        self.assertEqual(run_readme.replacement("make demo")[0], "scripts/demo")

    def test_first_failure_ends_it(self):
        self.assertEqual(self.run_text("```sh\ntouch one\nfalse\ntouch two\n```\n```sh\ntouch three\n```\n"), (None, ["one"]))


if __name__ == "__main__":
    unittest.main()
