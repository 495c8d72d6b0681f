"""bihive-bench: the content of its JSON, the agreement of both ray tracers, and its errors."""

# ctest: needs bihive-bench

import json
import os
import subprocess

from program import PATIENCE_S, ProgramTest, main

BENCH = os.environ["BIHIVE_BENCH"]
KINDS = ["primary", "random", "shadow", "mirror1", "mirror2", "mirror3", "mirror_shadow2", "mirror_shadow3", "ao", "ao_random", "comb"]
QUICK = ["--rays", "4096", "--reps", "1"]


class BenchTest(ProgramTest):
    def run_bihive(self, *arguments, **options):
        options.setdefault("cwd", self.folder)
        options.setdefault("stdout", subprocess.PIPE)
        return subprocess.run([BENCH, *arguments], stderr=subprocess.PIPE, text=True, timeout=PATIENCE_S, **options)

    def test_json_has_the_published_keys_and_no_mismatch(self):
        report = self.succeed_json("scenario2", "--peer", "embree", "--threads", "2", *QUICK)
        keys = "spheres threads target commit build_ms bytes_per_sphere mray_per_s peer ratio mismatches"
        self.assertLessEqual(set(keys.split()), set(report))
        self.assertEqual((report["spheres"], report["threads"]), (4096, 2))
        self.assertIn(report["target"], ["avx512", "avx2", "sse4", "neon", "scalar"])
        self.assertEqual(report["mismatches"], 0)
        self.assertEqual(report["peer"]["name"], "embree")
        self.assertRegex(report["peer"]["version"], r"^3\.")
        self.assertEqual(list(report["mray_per_s"]), KINDS)
        self.assertEqual(list(report["peer"]["mray_per_s"]), KINDS)
        self.assertLessEqual({"build", "bytes", *KINDS}, set(report["ratio"]))
        self.assertEqual(report["rays"]["primary"], 4096)
        for kind in KINDS:
            ours, peers = report["mray_per_s"][kind], report["peer"]["mray_per_s"][kind]
            self.assertGreater(ours, 0, kind)
            self.assertAlmostEqual(report["ratio"][kind], ours / peers, places=6, msg=kind)
        self.assertAlmostEqual(
            report["ratio"]["bytes"], report["peer"]["bytes_per_sphere"] / report["bytes_per_sphere"], places=6
        )
        self.assertGreaterEqual(report["bytes_per_sphere"], 16)
        # A whole picture has more rays than pixels.
        self.assertGreater(report["frame_ms"], 0)
        self.assertGreater(report["frame_rays"], 4096)
        self.assertEqual(report["tile"]["random"], 2048)  # a thread's part of the rays

    def test_every_kind_of_input_agrees_with_the_peer(self):
        # Two crossing spheres in a file, the four spheres, a molecule: framed by the program itself.
        self.write("two.xyz", "2\n\nC 0 0 0\nC 0.5 0.2 0\n")
        for name in ["two.xyz", "four-spheres", "demo", "s3", "mol"]:
            report = self.succeed_json(name, "--peer", "embree", *QUICK)
            self.assertEqual(report["mismatches"], 0, name)
            self.assertGreater(report["rays"]["primary"], 0, name)

    def test_only_what_is_asked_for(self):
        report = self.succeed_json("s1", "--only", "random,build", *QUICK)
        self.assertEqual(list(report["mray_per_s"]), ["random"])
        self.assertGreater(report["build_ms"], 0)
        self.assertIsNone(report["peer"])
        self.assertIsNone(report["ratio"])
        report = self.succeed_json("s1", "--only", "mirror3", *QUICK)
        self.assertEqual(list(report["mray_per_s"]), ["mirror3"])
        self.assertIsNone(report["build_ms"])
        self.assertIsNone(report["frame_ms"])
        report = self.succeed_json("s1", "--only", "frame", *QUICK)
        self.assertEqual(report["mray_per_s"], {})
        self.assertGreater(report["frame_ms"], 0)

    def test_a_kind_without_rays_is_null(self):
        # A single sphere: mirrored rays meet nothing.
        self.write("one.xyz", "1\n\nC 0 0 0\n")
        report = self.succeed_json("one.xyz", "--peer", "embree", *QUICK)
        self.assertGreater(report["mray_per_s"]["mirror1"], 0)
        self.assertIsNone(report["mray_per_s"]["mirror2"])
        self.assertIsNone(report["ratio"]["mirror2"])
        self.assertEqual(report["rays"]["mirror2"], 0)

    def test_calls_of_few_rays(self):
        for call in ["1", "64", "1024"]:
            report = self.succeed_json("s1", "--peer", "embree", "--only", "comb,shadow,random", "--call", call, *QUICK)
            self.assertEqual(report["mismatches"], 0, call)
            self.assertGreater(report["mray_per_s"]["comb"], 0)
        self.assertIn("--call", self.fail_usage("s1", "--call", "0"))

    def test_a_target_may_be_forced(self):
        report = self.succeed_json("s2", "--target", "sse4", "--peer", "embree", "--only", "primary", *QUICK)
        self.assertEqual((report["target"], report["mismatches"]), ("sse4", 0))
        # The peer has no such thing.
        self.assertEqual(self.succeed_json("s2", "--target", "scalar", "--only", "primary", *QUICK)["target"], "scalar")
        done = self.run_bihive("s2", "--target", "scalar", "--peer", "embree", *QUICK)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--target scalar: Embree cannot be restricted to it", done.stderr)

    def test_text_has_a_line_a_kind(self):
        lines = self.succeed("s1", "--peer", "embree", *QUICK).splitlines()
        self.assertIn("4,096 spheres", lines[0])
        names = [line.split()[0] for line in lines]
        self.assertEqual([name for name in names if name in KINDS], KINDS)
        self.assertRegex(lines[-1], r"^wrong answers: 0, Embree's \d+$")

    def test_bad_input(self):
        self.assertIn("missing.pdb", self.fail_input("missing.pdb"))
        self.write("broken.csv", "x,y,z\n1,2,three\n")
        self.assertIn("broken.csv:2", self.fail_input("broken.csv", "--json"))
        self.assertIn("nowhere.pdb", self.fail_input("mol", "--molecule", "nowhere.pdb"))

    def test_bad_usage(self):
        for arguments in [
            [],
            ["s1", "--peer", "povray"],
            ["s1", "--only", "primary,secondary"],
            ["s1", "--threads", "0"],
            ["s1", "--reps", "none"],
            ["s1", "--target", "avx1024"],
            ["s1", "s2"],
            ["demo", "--count", "3"],
        ]:
            self.fail_usage(*arguments)

    def frames(self, *arguments):
        program = os.path.join(os.path.dirname(BENCH), "bihive-frames")
        return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=PATIENCE_S, cwd=self.folder)

    def test_frames_of_the_nine_configurations(self):
        done = self.frames("thesis", "2", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = [(f["scenario"], f["spheres"]) for f in json.loads(done.stdout)["configurations"]]
        self.assertEqual(found, [(scenario, spheres) for scenario in (1, 2, 3) for spheres in (64, 128, 256)])

    def test_bad_usage_of_frames(self):
        for arguments in [[], ["thesis"], ["thesis", "0", "1"], ["pictures", "1", "1"], ["other", "1", "1"]]:
            done = self.frames(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assert_one_error_line(done.stderr)

    def ranks(self, *arguments):
        program = os.path.join(os.path.dirname(BENCH), "bihive-ranks")
        return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=PATIENCE_S, cwd=self.folder)

    def test_simulated_ranks(self):
        picture = ["render", "demo", "--size", "64x48", "--style", "plain"]
        done = self.ranks("1,5", "--rate", "1", "--latency", "10", *picture)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        one, five = json.loads(done.stdout)["simulated"]
        self.assertEqual((one["ranks"], one["same_bits"], one["messages"], one["bytes"]), (1, True, 0, 0))
        self.assertEqual((five["ranks"], five["same_bits"]), (5, True))
        # Each message and its bytes count for both ranks.
        for what in ("messages", "bytes"):
            self.assertGreater(five[what], 0)
            self.assertAlmostEqual(five[what + "_of_rank"]["mean"] * 5, 2 * five[what])
        # The network alone takes so long for the bytes of a rank.
        self.assertGreaterEqual(five["simulated_ms"], five["bytes_of_rank"]["largest"] * 8e-6)
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_bad_usage_of_ranks(self):
        picture = ["render", "demo", "-o", "a.png"]
        for arguments in [[], ["0", *picture], ["1,x", *picture], ["2", "--rate", "0", *picture], ["2", "--speed", "3", *picture],
                          ["2", "film", "demo", "-o", "a.mp4"]]:
            done = self.ranks(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assert_one_error_line(done.stderr)

    def test_help(self):
        text = self.succeed("--help")
        for word in ["--peer", "--threads", "--only", "--reps", "--json", "u1e7", "Examples"]:
            self.assertIn(word, text)


if __name__ == "__main__":
    main()
