"""Pictures by one to eight ranks of mpirun, and ranks that are stopped: for `make test-all`."""

# ctest: LABELS long

import itertools
import os
import signal
import subprocess
import time
import unittest

from program import PATIENCE_S, main
from ranks import BIHIVE_MPI, OnRanks, is_open_mpi


def is_running(process):
    """Whether it runs; one whose parent has not asked for its end yet does not."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@unittest.skipUnless(BIHIVE_MPI and is_open_mpi(), "bihive-mpi was not built: install libopenmpi-dev and openmpi-bin")
class ManyRanks(OnRanks):
    def test_any_number_of_ranks_gives_the_same_picture(self):
        looks = [
            ["--size", "160x120"],
            ["--size", "97x203", "--style", "illustrative", "--samples", "auto", "--background", "none"],
            ["--size", "80x60", "--style", "glossy", "--aperture", "1", "--samples", "3"],
            ["--size", "80x60", "--select", "all", "--opacity", "0.4", "--legend", "--title", "hi"],
            ["--size", "80x60", "--clip", "sphere:0,0,0,8", "--clip", "plane:0,0,1,3"],
            ["--size", "64x400", "--view", "normal", "--crop", "3,17,60,391"],
            ["--size", "60x100", "--view", "id"],
            ["--size", "60x50", "--view", "distance"],  # which rank 0 draws alone
        ]
        for options in looks:
            self.expect_picture_of_one_process((1, 2, 3, 4, 7, 8), "demo", options)

    def test_copies_and_layers(self):
        self.write("cell.xyz", '2\nLattice="4 0 0 0 4 0 0 0 4"\nC 0 0 0\nO 1.5 1 2\n')
        copies = ["render", "cell.xyz", "--json", "--size", "60x50", "--threads", "1", "--replicate", "3x3x2", "--cell"]
        alone = self.hash_of(self.run_bihive(*copies, "-o", "alone.png"))
        self.assertEqual(self.hash_of(self.run_ranks(3, BIHIVE_MPI, *copies, "-o", "ranks.png")), alone)
        refused = self.run_ranks(3, BIHIVE_MPI, *copies, "-o", "ranks.png", "--distribute")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertEqual(len(self.errors(refused)), 1, refused.stderr)
        for layers in ("radiance,depth,id,normal", "depth,id"):
            words = ["render", "demo", "--size", "60x50", "--layers", layers, "--threads", "1"]
            self.succeed(*words, "-o", "alone.exr")
            done = self.run_ranks(3, BIHIVE_MPI, *words, "-o", "ranks.exr", "--distribute")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.read("ranks.exr"), self.read("alone.exr"), layers)

    def test_any_number_of_threads(self):
        for threads in ("2", "3"):
            self.expect_picture_of_one_process((2, 3), "demo", ["--size", "160x120"], threads)

    def test_parts_of_a_file(self):
        self.succeed("scene", "scenario2", "--count", "5000", "-o", "set.npy")
        for options in ([], ["--recenter", "--projection", "orthographic", "--axes"], ["--radius", "0.3", "--fog", "0.4"]):
            self.expect_picture_of_one_process((1, 2, 3, 4, 7, 8), "set.npy", ["--size", "80x60", *options])

    def test_ctrl_c_and_a_rank_that_dies(self):
        words = ["render", "demo", "-o", "a.png", "--size", "6000x4000", "--threads", "1"]
        kinds = ("mpirun is interrupted", "a rank is killed")
        for kind, more in itertools.product(kinds, ([], ["--distribute"])):
            with self.subTest(kind=kind, more=more):
                running = subprocess.Popen(self.mpirun(3, BIHIVE_MPI, *words, *more), cwd=self.folder, stdout=subprocess.DEVNULL,
                                           stderr=subprocess.DEVNULL)
                ranks = []
                while len(ranks) < 3:
                    self.assertIsNone(running.poll(), "it ended before it was stopped")
                    found = subprocess.run(["pgrep", "-P", str(running.pid)], capture_output=True, text=True)
                    ranks = [int(line) for line in found.stdout.split()]
                    time.sleep(0.05)
                time.sleep(1)
                if kind == "a rank is killed":
                    os.kill(ranks[1], signal.SIGKILL)
                else:
                    running.send_signal(signal.SIGINT)
                self.assertNotEqual(running.wait(timeout=PATIENCE_S), 0)
                for rank in ranks:
                    self.assertFalse(is_running(rank), "nothing runs on")
                self.assertEqual(self.leftovers(), [])


if __name__ == "__main__":
    main()
