"""Limits of the system: few descriptors, little memory, short files, little time, few threads; and many threads."""

import os
import shutil
import subprocess
import time

import numpy
from program import BIHIVE, PATIENCE_S, ProgramTest, main

SMALL = ["--size", "40x30", "--samples", "1"]
NOBODY = 65534


class Limits(ProgramTest):
    def setUp(self):
        super().setUp()
        if shutil.which("prlimit") is None:
            self.skipTest("prlimit is missing")
        # The run-time of the address sanitizer reserves terabytes and starts a thread of its own at the end.
        if self.limited(["--as=4000000000"], "--version").returncode != 0:
            self.skipTest("this build, of the address sanitizer, does not live within limits")
        self.succeed("render", "demo", "-o", "whole.png", *SMALL)
        self.whole = self.read("whole.png")
        numpy.save(self.path("rays.npy"), numpy.ones((100, 6), dtype=numpy.float32))
        self.before = self.contents()

    def limited(self, limits, *words, **options):
        return subprocess.run(["prlimit", *limits, BIHIVE, *words], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE_S, **options)

    def judge(self, limits, done, output="a.png"):
        """Success with a whole picture, or one line with nothing left. Returns whether it succeeded."""
        self.assertIn(done.returncode, (0, 1), (limits, done.stderr))
        if done.returncode == 0:
            self.assertEqual(done.stderr, "", limits)
            self.assertEqual(self.read(output), self.whole, limits)
            os.remove(self.path(output))
        else:
            self.assert_one_error_line(done.stderr, limits)
        self.assertEqual(self.contents(), self.before, limits)
        return done.returncode == 0

    def test_address_space(self):
        """With too little for the program's libraries the loader itself says so, with its own exit code."""
        least = 150
        while self.limited([f"--as={least}000000"], "--version").returncode != 0:
            least += 10
        succeeded = {}
        for megabytes in [least, least + 5, least + 10, least + 20, least + 40, least + 80, 300, 400, 600]:
            for threads in ["1", "4", "32", "200"]:
                limits = [f"--as={megabytes}000000"]
                done = self.limited(limits, "render", "demo", "-o", "a.png", *SMALL, "--threads", threads)
                succeeded[megabytes, threads] = self.judge([*limits, threads], done)
        for threads in ["1", "4", "32", "200"]:
            self.assertTrue(succeeded[600, threads], (threads, "fewer threads would do"))

    def test_memory_is_predicted(self):
        done = self.limited(["--as=400000000"], "render", "scenario1", "--count", "30000000", "-o", "a.png")
        self.assertFalse(self.judge("count", done))
        self.assertIn("the limit of this process (ulimit -v) leaves", done.stderr)

    def test_descriptors(self):
        for count in range(3, 14):
            limits = [f"--nofile={count}"]
            done = self.limited(limits, "render", "demo", "-o", "a.png", *SMALL)
            if done.returncode == 127:  # the loader opens the program's libraries
                self.assertEqual(self.contents(), self.before)
                continue
            self.judge(limits, done)
            done = self.limited(limits, "trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy")
            self.assertIn(done.returncode, (0, 1), done.stderr)
            there = [os.path.exists(self.path(name)) for name in ["t.npy", "id.npy"]]
            self.assertEqual(there, [done.returncode == 0] * 2)
            for name in ["t.npy", "id.npy"] if there[0] else []:
                os.remove(self.path(name))

    def test_file_sizes(self):
        for count in [0, 1, 100, len(self.whole) - 1, len(self.whole)]:
            limits = [f"--fsize={count}"]
            done = self.limited(limits, "render", "demo", "-o", "a.png", *SMALL)
            self.assertEqual(self.judge(limits, done), count == len(self.whole))

    def test_time(self):
        begin = time.monotonic()
        done = self.limited(["--cpu=2:20"], "render", "scenario3", "-o", "a.png", "--size", "4000x4000", "--samples", "64")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (152, "", ""))
        self.assertEqual(self.contents(), self.before)
        self.assertLess(time.monotonic() - begin, PATIENCE_S)

    def test_threads_of_a_user(self):
        """Root has no such limit, so root runs it as another user."""
        program = BIHIVE
        other = {}
        if os.getuid() == 0:
            program = self.path("program")
            shutil.copy(BIHIVE, program)
            os.chmod(program, 0o755)
            os.chmod(self.folder, 0o777)
            other = {"user": NOBODY, "group": NOBODY, "extra_groups": []}
            self.before = self.contents()
        for count in [0, 1, 2, 5]:
            for threads in ["2", "8", "100"]:
                words = ["prlimit", f"--nproc={count}", program, "render", "demo", "-o", "a.png", *SMALL, "--threads", threads]
                done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S, **other)
                self.assertTrue(self.judge([count, threads], done), done.stderr)

    def test_any_number_of_threads_draws_the_same(self):
        for threads in ["1", "2", "3", "17", "100", "1000"]:
            self.succeed("render", "demo", "-o", "a.png", *SMALL, "--threads", threads)
            self.assertEqual(self.read("a.png"), self.whole, threads)
            os.remove(self.path("a.png"))

    def test_pictures_beyond_any_size(self):
        self.assertIn("65535", self.fail_usage("render", "demo", "-o", "a.png", "--size", "100000x100000"))
        # The widest ones stream: light and bytes of the whole picture would be 2.4 GB.
        wide = ["--size", "65535x2500", "--crop", "0,1200,65535,1216", "--view", "id", "--threads", "2"]
        done = self.limited(["--as=500000000"], "render", "demo", "-o", "a.png", *wide)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    main()
