"""bihive render --engine gpu: its files and its output. Pictures are compared pixel by pixel in agreement_test.cpp."""

import json
import os
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../cli"))
from program import BIHIVE, PATIENCE_S, ProgramTest, main, png_numbers, png_pixels, png_text  # noqa: E402

SIZE = ["--size", "96x64"]


class RenderOnGpu(ProgramTest):
    def test_json_says_what_was_done(self):
        said = self.succeed_json("render", "scenario1", *SIZE, "--engine", "gpu", "--max-prims", "2", "-o", "gpu.png")
        self.assertEqual(said["engine"], "gpu")
        self.assertIsNone(said["target"])
        self.assertIn("OpenGL ES 3", said["gpu"])
        self.assertEqual(said["rays"]["primary"], 96 * 64)
        self.assertGreater(said["rays"]["all"], said["rays"]["primary"])
        self.assertGreater(said["build_ms"], 0)
        self.assertGreater(said["render_ms"], 0)

        # As many rays as on the CPU, nearly; the same words in the picture.
        cpu = self.succeed_json("render", "scenario1", *SIZE, "--engine", "reference", "-o", "cpu.png")
        self.assertNotIn("gpu", cpu)
        self.assertAlmostEqual(said["rays"]["all"] / cpu["rays"]["all"], 1, delta=0.005)
        words = [png_text(self.read(name)) for name in ("gpu.png", "cpu.png")]
        records = [json.loads(text.pop("bihive")) for text in words]
        self.assertEqual(words[0], words[1])
        self.assertEqual([["engine", "gpu"] in record["options"] for record in records], [True, False])

    def test_tree_and_brute_force_draw_the_same(self):
        self.succeed("render", "scenario3", "--count", "100", *SIZE, "--engine", "gpu", "-o", "tree.png")
        said = self.succeed_json("render", "scenario3", "--count", "100", *SIZE, "--engine", "gpu-brute", "-o", "brute.png")
        self.assertEqual(said["engine"], "gpu-brute")
        pairs = zip(sum(png_pixels(self.read("tree.png")), []), sum(png_pixels(self.read("brute.png")), []))
        self.assertLessEqual(sum(tree != brute for tree, brute in pairs), 3)

    def test_max_prims_shows_in_the_traversal_view(self):
        view = ["render", "scenario1", "--count", "64", *SIZE, "--engine", "gpu", "--view", "traversal"]
        pictures = set()
        for max_prims in ["1", "64"]:
            self.succeed(*view, "--max-prims", max_prims, "-o", "a.png")
            pictures.add(self.read("a.png"))
        self.assertEqual(len(pictures), 2)

    def test_ctrl_c_leaves_no_picture(self):
        process = subprocess.Popen(
            [BIHIVE, "render", "scenario1", "--engine", "gpu", "--samples", "4096", "-o", "a.png"],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.let_work(process, 2)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=PATIENCE_S)
        self.assertEqual((process.returncode, out, err), (130, b"", b""))
        self.assertEqual(self.contents(), {})

    def test_looks_are_those_of_the_cpu(self):
        looks = {
            "default": [],
            "studio": ["--style", "studio", "--exposure", "0.5", "--tone", "filmic"],
            "xray": ["--style", "xray", "--crop", "20,10,80,50"],
            "lines": ["--style", "illustrative", "--select", "chain A", "--outline", "2"],
            "clear": ["--style", "flat", "--background", "none", "--title", "Title", "--aperture", "2"],
            "ids": ["--no-water", "--view", "id"],
        }
        for name, look in looks.items():
            given = ["render", "demo", *SIZE, "--samples", "2", *look]
            self.succeed(*given, "--engine", "gpu", "-o", "gpu.png")
            self.succeed(*given, "-o", "cpu.png")
            ours, theirs = (sum(png_numbers(self.read(file)), []) for file in ("gpu.png", "cpu.png"))
            self.assertEqual(len(ours), len(theirs), name)
            apart = sum(max(abs(a - b) for a, b in zip(p, q)) > 8 for p, q in zip(ours, theirs))
            self.assertLessEqual(apart, 0.01 * len(ours), name)

    def test_what_it_does_not_draw(self):
        cut = ["--select", "all", "--clip", "plane:0,0,1,0"]
        for options, words in [(["--samples", "auto"], "adaptive samples"), (cut, "cut spheres")]:
            said = self.fail_usage("render", "demo", "--engine", "gpu", *options, "-o", "a.png")
            self.assertIn("--engine gpu draws no " + words, said)

    def test_samples_smooth_edges(self):
        colours = []
        for samples in ["1", "4"]:
            self.succeed("render", "four-spheres", *SIZE, "--engine", "gpu", "--view", "id", "--samples", samples, "-o", "a.png")
            colours.append(len(set(sum(png_pixels(self.read("a.png")), []))))
        self.assertLessEqual(colours[0], 6)
        self.assertGreater(colours[1], 20)


if __name__ == "__main__":
    main()
