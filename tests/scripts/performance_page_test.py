"""scripts/performance_page: verdicts, charts and refusals for made-up measurements; and docs/performance.md equals its generator's output."""

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
KINDS = ["primary", "random", "shadow", "mirror1", "mirror2", "mirror3", "mirror_shadow2", "mirror_shadow3"]
MACHINE = {"processor": "P", "cpus": "2", "l1d": "a", "l2": "b", "l3": "c", "vectors": "avx512f", "memory_gb": 1}
MACHINE.update({"system": "S", "compiler": "C"})


def result_of(scene, threads, ratio):
    rates = {kind: 10 * ratio for kind in KINDS}
    peer = {kind: 10 for kind in KINDS}
    return {
        "input": scene,
        "spheres": 4096,
        "threads": threads,
        "target": "avx512",
        "build_ms": 1,
        "build_fresh_ms": 2,
        "build_peak_bytes": 5e6,
        "bytes_per_sphere": 18,
        "levels": 2,
        "nodes": 17,
        "frame_ms": 33,
        "rays": {kind: 1000 for kind in KINDS},
        "tile": {kind: 1048576 if kind == "random" else 131072 for kind in KINDS},
        "mray_per_s": rates,
        "peer": {
            "version": "3.13.5",
            "build_ms": ratio,
            "build_fresh_ms": 2 * ratio,
            "bytes_per_sphere": 40,
            "mray_per_s": peer,
            "mode": {kind: "16" for kind in KINDS},
        },
        "ratio": {"build": ratio, "build_fresh": ratio, "bytes": 2.2, **{kind: ratio for kind in KINDS}},
        "peer_wrong": 1,
        "mismatches": 0,
    }


def report(part, results):
    runs = [{"command": f"measure {part} {i}", "seconds": 1.0, "result": result} for i, result in enumerate(results)]
    return {"part": part, "date": "2026-01-02", "commit": "abcdef123", "machine": MACHINE, "runs": runs}


class PerformancePageTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bihive_page_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def generate(self, reports):
        measured = self.folder / "measured"
        measured.mkdir()
        for made in reports:
            (measured / f"{made['part']}.json").write_text(json.dumps(made))
        command = [sys.executable, TOP / "scripts/performance_page", measured, "--docs", self.folder / "docs"]
        self.ran = subprocess.run(command, stderr=subprocess.PIPE, text=True)
        page = self.folder / "docs/performance.md"
        return page.read_text() if page.is_file() else None

    def assert_refused(self, made, *words):
        """No page, no kept file, and a message with these words."""
        self.assertIsNone(self.generate([report("thesis", [{"threads": 2, "configurations": []}]), made]))
        self.assertEqual(self.ran.returncode, 1)
        for word in words:
            self.assertIn(word, self.ran.stderr)
        self.assertEqual(list((self.folder / "docs/performance").glob("*")), [])

    def test_targets_are_judged_by_the_worst_scene(self):
        # Random rays: floor 2.8, aim 4. s2 with two threads is below; s1 alone would be fine.
        page = self.generate(
            [report("scenes", [result_of("s1", 1, 12.5), result_of("s1", 2, 12.5), result_of("s2", 2, 1.5)])]
        )
        row = next(line for line in page.splitlines() if line.startswith("| s1 s2 s3 mol | random"))
        self.assertIn("2.8x (4x)", row)
        self.assertIn("12.5x (s1, random)", row)
        self.assertIn("1.50x (s2, random)", row)
        self.assertIn("missed by 46 %", row)
        self.assertIn("| not measured |", page)
        self.assertIn("up to 131,072 rays, of random ones up to 1,048,576", page)
        self.assertRegex(page, r"\| s1 \| 1.00 \(12.5\).*\| 5.00 \| 17 \| 2 \| 33.0 \|")
        self.assertIn("Of 24,000 rays, 0 answers of ours were wrong and 3 of Embree's", page)

    def test_met_and_aim_met(self):
        page = self.generate([report("scenes", [result_of("s1", n, 9) for n in (1, 2)])])
        rows = {line.split("|")[2].strip(): line for line in page.splitlines() if line.startswith("| s1 s2 s3 mol")}
        self.assertTrue(rows["primary"].endswith("| met |"), rows["primary"])
        self.assertTrue(rows["random"].endswith("| aim met |"), rows["random"])
        self.assertTrue(rows["bytes per sphere, at most"].endswith("| met |"))

    def test_frames_of_the_thesis_count_with_their_bytes(self):
        """There is a floor for AVX2 and AVX-512: 200 frames a second are too few."""
        for target, rate, said in [("avx2", 250, "met"), ("avx2", 200, "missed by 17 %"), ("avx512", 200, "missed by 17 %"), ("sse4", 200, "")]:
            frames = {"scenario": 1, "spheres": 64, "render_ms": 3, "fps": 333, "fps_with_bytes": rate}
            run = {"threads": 2, "target": target, "configurations": [frames]}
            page = self.generate([report("thesis", [run])])
            self.assertIn(f"| scenario 1, 64 spheres | 3.00 | 333 | {rate} | {said} |", page)
            shutil.rmtree(self.folder / "measured")

    def test_rays_stand_beside_their_bound(self):
        least = {"nodes": 2, "leaves": 1, "nodes_in_order": 3, "leaves_in_order": 1.5, "candidates": 1, "bytes": 50, "mray_per_s": 80}
        result = dict(result_of("s1", 1, 2), bound={"random": least, "comb": least})
        result["mray_per_s"]["comb"], result["ratio"]["comb"] = 40, 2.5
        page = self.generate([report("bound", [result])])
        self.assertIn("| s1 | random | 20.0 | **2.00x** | 2.8x: missed by 29 % | 80.0 | 25 % | 2.00 | 3.00 | 1.00 | 1.50 | 50.0 |", page)
        self.assertIn("| s1 | comb | 40.0 | **2.50x** | 2.5x: met | 80.0 | 50 % |", page)

    def test_hostile_sets_name_their_worst_rays(self):
        good, bad = (dict(result_of(f"{name}.npy", 1, ratio), set=name) for name, ratio in (("a plane", 3), ("a line", 1.2)))
        for result in (good, bad):
            result["rays"] = {kind: 4096 for kind in KINDS}
        bad["rays"]["shadow"], bad["ratio"]["shadow"] = 4095, 0.1  # too few to count
        page = self.generate([report("cliffs", [good, bad])])
        self.assertIn("| random | 21.0 | a line: 12.0 (0.57) | a line: 1.20x | 1 | 0 |", page)
        self.assertRegex(page, r"\| a plane \| 4,096 \| .*3.00x \(.*\) \|")
        self.assertRegex(page, r"\| a line \| 4,096 \| .*\*\*1.20x\*\* \(.*\) \| 0.57 \(")

    def test_a_section_says_its_own_machine_commit_date_and_command(self):
        wide = report("scenes", [result_of("s1", 1, 3)])
        narrow = dict(report("avx2", [dict(result_of("s1", 1, 3), target="avx2")]), commit="fedcba321", date="2026-03-04")
        narrow["machine"] = dict(MACHINE, processor="Q", vectors="avx2")
        narrow["command"] = "BIHIVE_TARGET=avx2 scripts/bench avx2"
        page = self.generate([wide, narrow])
        first, second = page.split("\n## AVX2\n")
        for words in ["Machine: P, 2 cores with AVX-512", "run: AVX-512", "Commit: abcdef123", "Date: 2026-01-02", "`scripts/bench scenes` (1 s)"]:
            self.assertIn(words, first)
        for words in ["Machine: Q, 2 cores with AVX2", "run: AVX2", "Commit: fedcba321", "Date: 2026-03-04", f"`{narrow['command']}` (1 s)"]:
            self.assertIn(words, second)
        self.assertNotIn("Machine", first.split("\n## ")[0])

    def test_a_report_of_two_commits_is_refused(self):
        results = [dict(result_of("s1", n, 3), commit=commit) for n, commit in ((1, "abcdef123"), (2, "0123abcde"))]
        self.assert_refused(report("scenes", results), "scenes.json", "more than one commit", "0123abcde, abcdef123")

    def test_a_report_of_other_programs_than_it_says_is_refused(self):
        made = report("growth", [dict(result_of("u1e3", 2, 1), commit="0123abcde")])
        self.assert_refused(made, "growth.json", "more than one commit", "0123abcde, abcdef123")

    def test_a_report_of_uncommitted_changes_is_refused(self):
        made = dict(report("growth", [result_of("u1e3", 2, 1)]), commit="abcdef123-dirty")
        self.assert_refused(made, "growth.json", "abcdef123-dirty")

    def test_a_report_of_two_machines_is_refused(self):
        results = [dict(result_of("s1", n, 3), machine=machine) for n, machine in ((1, "P"), (2, "Q"))]
        self.assert_refused(report("scenes", results), "scenes.json", "more than one machine", "P, Q")

    def test_a_run_that_names_another_machine_is_refused(self):
        made = report("growth", [result_of("u1e3", 2, 1)])
        made["runs"][0]["machine"] = dict(MACHINE, l2="larger")
        self.assert_refused(made, "growth.json", "more than one machine")

    def test_a_report_of_two_instruction_sets_is_refused(self):
        results = [dict(result_of("s1", n, 3), target=target) for n, target in ((1, "avx512"), (2, "avx2"))]
        self.assert_refused(report("scenes", results), "more than one instruction set", "avx2, avx512")

    def test_a_hundred_million_spheres_have_a_table_of_their_own(self):
        huge = dict(report("huge", [dict(result_of("u1e8", 2, 1), spheres=10**8)]), commit="fedcba321")
        growth = [dict(result_of("u1e3", 2, 1), spheres=10**k, build_ms=10.0**k / 1e4) for k in (3, 4)]
        page = self.generate([report("growth", growth), huge])
        small, large = page.split("\n## A hundred million spheres\n")
        self.assertIn("| 100,000,000 |", large)
        self.assertIn("fedcba321", large)
        self.assertNotIn("fedcba321", small)

    def test_occlusion_beside_tachyon_and_the_program_as_a_whole(self):
        def picture(ratio):
            rays = {"primary": 4e6, "ambient": 76.6e6, "shadow": 5e6}
            return {"rays": rays, "all_ms": 100, "tachyon_ms": 100 * ratio, "ratio": ratio}

        drawn = {"threads": 2, "scenes": {"1tii": picture(7.2), "u1e6": picture(8.5)}}
        made = report("occlusion", [drawn] + 3 * [{"rays": {"ambient": 19.1e6}}])
        for run, seconds in zip(made["runs"][1:], (0.4, 0.7, 0.6)):
            run["seconds"] = seconds
        page = self.generate([made])
        self.assertIn("| 1tii | 4.0 | 76.6 | 5.0 | 100 | 720 | **7.20x** | 8x | missed by 10 % |", page)
        self.assertRegex(page, r"\| u1e6 .*\*\*8.50x\*\* \| 4x \| aim met \|")
        self.assertIn("19.1 million rays of ambient occlusion: 0.60 s,\nmedian of 3", page)

    def test_films_their_memory_and_large_files(self):
        def film(pictures, peak):
            parts = {f"{part}_ms": ms * pictures for part, ms in (("read", 3), ("build", 4), ("trace", 50), ("write", 6))}
            return {**parts, "drawn": pictures, "pictures_per_s": 18.0, "peak_memory_bytes": peak}

        def picture(name, spheres):
            parts = {"read_ms": 700, "build_ms": 80, "render_ms": 90, "write_ms": 30}
            return {**parts, "scene": f"out/{name}", "spheres": spheres, "peak_memory_bytes": 50 * spheres}

        facts = {"spheres": 108000, "all_ms": 200, "tachyon_ms": 900, "ratio": 4.5}
        made = report("film", [film(200, 90e6), film(20, 31e6), {"threads": 2, "styles": {"plain": facts}}] + 3 * [picture("a.npy", 10**7)])
        commands = ["bihive film a.dump -o a.mp4 --style plain --json", "bihive film b.dump --frames 0:20 --style plain", "bihive-frames film 2"]
        for run, command in zip(made["runs"], [*commands, *3 * ["bihive render a.npy"]]):
            run["command"] = f"build/{command}"
        for run, seconds in zip(made["runs"][3:], (0.9, 1.2, 1.0)):
            run["seconds"] = seconds
        page = self.generate([made])
        self.assertIn("| plain | 200 | 18.0 | 3.00 | 4.00 | 50.0 | 6.00 | 90.0 |", page)
        self.assertIn("| plain | 200 | 900 | **4.50x** |", page)
        self.assertIn("| 20 | 31.0 |", page)
        self.assertIn("| `a.npy` | 10,000,000 | 1.00 | 700 | 80.0 | 90.0 | 30.0 | 50.0 |", page)

    def test_commands_and_charts(self):
        growth = [dict(result_of("u1e3", 2, 1), spheres=10**k, build_ms=10.0**k / 1e4) for k in (3, 4, 5)]
        page = self.generate([report("growth", growth), report("scenes", [result_of("s1", 1, 3)])])
        for words in ["make bench", "measure growth 2\n", "measure scenes 0\n", "(performance_findings.md)"]:
            self.assertIn(words, page)
        charts = sorted(path.name for path in (self.folder / "docs/performance").glob("*.svg"))
        self.assertEqual(charts, ["growth_build.svg", "growth_rays.svg", "ratios_1.svg"])
        for name in charts:
            self.assertIn(f"(performance/{name})", page)
            root = xml.etree.ElementTree.parse(self.folder / "docs/performance" / name).getroot()
            self.assertTrue(root.tag.endswith("svg"))
            self.assertGreater(len(root), 10, name)

    @unittest.skipUnless((TOP / "docs/performance").is_dir(), "nothing was measured yet")
    def test_the_page_in_docs_is_what_its_measurements_give(self):
        docs = self.folder / "docs"
        shutil.copytree(TOP / "docs/performance", docs / "performance")
        for chart in (docs / "performance").glob("*.svg"):
            chart.unlink()
        subprocess.run([sys.executable, TOP / "scripts/performance_page", "--docs", docs], check=True)
        self.assertEqual((docs / "performance.md").read_text(), (TOP / "docs/performance.md").read_text())
        for chart in sorted((TOP / "docs/performance").glob("*.svg")):
            self.assertEqual((docs / "performance" / chart.name).read_text(), chart.read_text(), chart.name)


if __name__ == "__main__":
    unittest.main()
