"""scripts/scale_page: the model of made-up measurements, a refusal, and docs/scale.md equals its generator's output."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

TOP = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parents[2]))
sys.path.insert(0, str(TOP / "bench/ranks"))

import model  # noqa: E402

SPHERES = 1000
MACHINE = {"processor": "P", "cpus": "2", "vectors": "avx2", "memory_gb": 1, "system": "S", "compiler": "C"}


def run(what, result, **marks):
    return {"command": f"measure {what}", "seconds": 2.5, "what": what, "scene": "cloud", "result": result, **marks}


def simulated(ranks):
    pair = {"mean": 10, "largest": 20}
    one = {"ranks": ranks, "simulated_ms": 800 / ranks, "rays": 100, "asked": 150, "messages": 7, "bytes": 700}
    one.update({name: dict(pair) for name in ("messages_of_rank", "bytes_of_rank", "sent_bytes_of_rank")})
    return {**one, "spheres_of_rank": {"mean": SPHERES / ranks, "largest": SPHERES / ranks}}


def report():
    runs = [run("tree", {"spheres": n, "render_ms": n**0.5}, look=look) for n in (10, 1000) for look in ("primary", "default")]
    for ranks in (1, 2):
        peaks = [100 + 3 * SPHERES // ranks] * ranks
        runs.append(run("memory", {"spheres": SPHERES, "render_ms": 500}, look="primary", ranks=ranks, peak_bytes=peaks))
    exchange = {"messages": 3, "bytes": 4e6}
    runs += [run("hosts", {"render_ms": 9, "exchange": exchange}, look="primary", gbit_per_s=rate) for rate in (None, 10)]
    for look in ("primary", "default"):
        result = {"gbit_per_s": 10, "render_ms": 800, "simulated": [simulated(ranks) for ranks in (1, 2, 16)]}
        runs.append(run("simulated", result, look=look))
    return {"part": "ranks", "date": "2026-01-02", "commit": "abcdef123", "machine": MACHINE, "runs": runs}


class ScalePageTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bihive_scale_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def make(self, *words):
        return subprocess.run([TOP / "scripts/scale_page", *map(str, words)], capture_output=True, text=True, timeout=60)

    def test_the_model_goes_through_what_was_measured(self):
        made = model.Model(report())
        self.assertAlmostEqual(made.memory(SPHERES, 1), 3100)
        self.assertAlmostEqual(made.memory(10 * SPHERES, 5), 100 + 3 * 2000)
        self.assertAlmostEqual(made.setup_of_sphere_s, 2 / SPHERES)
        # The simulation's own set has its own time; a tree of a hundred times the spheres takes ten times as long.
        self.assertAlmostEqual(made.picture_ms("default", SPHERES, 16), 50)
        self.assertAlmostEqual(made.picture_ms("default", 100 * SPHERES, 16), 500)
        self.assertAlmostEqual(made.picture_ms("default", SPHERES, 4), 200)

    def test_page_and_charts(self):
        (self.folder / "ranks.json").write_text(json.dumps(report()))
        done = self.make(self.folder, "--docs", self.folder / "docs")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.folder / "docs/scale.md").read_text()
        self.assertIn("abcdef123", page)
        for chart in ("memory", "hosts", "picture"):
            xml.etree.ElementTree.parse(self.folder / f"docs/scale/{chart}.svg")
        # From what was kept the same page is made.
        self.assertEqual(self.make("--docs", self.folder / "docs").returncode, 0)
        self.assertEqual((self.folder / "docs/scale.md").read_text(), page)

    def test_what_cannot_be_one_table_is_refused(self):
        done = self.make(self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("scripts/bench ranks", done.stderr)
        mixed = report()
        mixed["runs"][0]["result"]["commit"] = "123456789"
        (self.folder / "ranks.json").write_text(json.dumps(mixed))
        done = self.make(self.folder, "--docs", self.folder / "docs")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("more than one commit", done.stderr)
        self.assertFalse((self.folder / "docs").exists())

    def test_the_page_of_the_project_is_the_generators(self):
        shutil.copytree(TOP / "docs/scale", self.folder / "scale")
        self.assertEqual(self.make("--docs", self.folder).returncode, 0)
        for path in [pathlib.Path("scale.md"), *(p.relative_to(self.folder) for p in (self.folder / "scale").iterdir())]:
            self.assertEqual((self.folder / path).read_text(), (TOP / "docs" / path).read_text(), path)


if __name__ == "__main__":
    unittest.main()
