"""scripts/thesis_archive: what it keeps of a run, and which run it refuses; a stand-in makes the run."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))
PAGE = '<h1>r</h1><figure><img src="data:image/png;base64,AAAA" width="1" alt="a"><figcaption>c</figcaption></figure><svg></svg>'


class ThesisArchive(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="bihive_archive_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def archive(self, *options, busy=False, exit_code=0):
        """Runs the script with a program that writes such a report, and says with which arguments it was called."""
        results = json.dumps(
            {"load": {"busy": busy, "most_others": 0.4 if busy else 0.01}, "experiments": [{"id": "ä", "data": [0.1]}, {}]}
        )
        program = self.folder / "bihive"
        program.write_text(
            f"#!{sys.executable}\nimport os, sys\nassert sys.argv[1:5] == ['thesis', 'all', '--out', 'report'], sys.argv\n"
            f"for name in sys.argv[5::2]: assert name in ('--device', '--quick'), sys.argv\n"
            f"for name in sys.argv[6::2]: assert os.path.isfile(name), name\n"
            f"os.mkdir('report')\nopen('report/results.json', 'w').write({results!r})\n"
            f"open('report/report.html', 'w').write({PAGE!r})\nsys.exit({exit_code})\n"
        )
        program.chmod(0o755)
        out = self.folder / "out"
        script = [sys.executable, SOURCE / "scripts/thesis_archive", "--bihive", program, *options, out]
        return out, subprocess.run(script, capture_output=True, text=True, check=False)

    def test_numbers_are_kept_whole_and_pictures_lose_their_bytes(self):
        out, done = self.archive()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(json.loads((out / "results.json").read_text())["load"]["busy"])
        page = (out / "report.html").read_text()
        self.assertNotIn("base64", page)
        for kept in ["<h1>r</h1>", "<figcaption>c</figcaption>", "<svg></svg>", "left out of the archive"]:
            self.assertIn(kept, page)

    def test_results_are_the_same_in_fewer_bytes(self):
        out, done = self.archive()
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (out / "results.json").read_text(encoding="utf-8")
        self.assertEqual(json.loads(text)["experiments"], [{"id": "ä", "data": [0.1]}, {}])
        self.assertIn('\n{"id":"ä","data":[0.1]},\n{}\n', text)

    def test_files_of_devices_are_shown_and_kept(self):
        phone = self.folder / "phone.json"
        phone.write_text("{}")
        out, done = self.archive("--device", phone)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "phone.json").read_text(), "{}")
        shutil.rmtree(out)
        out, done = self.archive("--device", self.folder / "none.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("none.json is not there", done.stderr)
        self.assertFalse(out.exists())

    def test_a_busy_machine_is_refused_unless_it_is_asked_for(self):
        out, done = self.archive(busy=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("other programs took 40 % of the processors", done.stderr)
        self.assertFalse(out.exists())
        out, done = self.archive("--busy", busy=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((out / "results.json").is_file())

    def test_a_failed_run_archives_nothing(self):
        out, done = self.archive(exit_code=3)
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing is archived", done.stderr)
        self.assertFalse(out.exists())

    def test_a_missing_program_is_named(self):
        script = [sys.executable, SOURCE / "scripts/thesis_archive", "--bihive", self.folder / "none", self.folder / "out"]
        done = subprocess.run(script, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("build it first", done.stderr)


if __name__ == "__main__":
    unittest.main()
