"""Ranks that ask for something else, never start, or are stopped: all end soon, with one line that says why."""

import os
import signal
import subprocess
import time
import unittest

from program import PATIENCE_S, main
from ranks import BIHIVE_MPI, OnRanks, is_open_mpi

WORDS = ["render", "run.xyz", "-o", "a.png", "--size", "20x20"]
# Far more work than a test waits for.
LONG = ["render", "demo", "-o", "a.png", "--size", "12000x9000", "--samples", "64", "--threads", "1"]
# The number of its process, for each rank.
WITH_NUMBER = 'echo $$ > pid.$OMPI_COMM_WORLD_RANK.new; mv pid.$OMPI_COMM_WORLD_RANK.new pid.$OMPI_COMM_WORLD_RANK; exec "$0" "$@"'
RANKS = 2  # ranks that wait for each other keep all cores busy


@unittest.skipUnless(BIHIVE_MPI and is_open_mpi(), "bihive-mpi was not built: install libopenmpi-dev and openmpi-bin")
class Ranks(OnRanks):
    def setUp(self):
        super().setUp()
        self.environment = {**os.environ, "BIHIVE_MPI_PATIENCE": "3"}

    def two(self, first, second):
        """Rank 0 runs the first command, rank 1 the second."""
        return subprocess.run([*self.mpirun(1, *first), ":", "-n", "1", *second], cwd=self.folder, env=self.environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S)

    def test_help_is_said_once(self):
        for words, text in (["--help"], "mpirun -n N"), (["-h"], "mpirun -n N"), (["render", "--help"], "--size"), (["--version"], "bihive"):
            done = self.run_ranks(RANKS, BIHIVE_MPI, *words)
            self.assertEqual((done.returncode, self.errors(done)), (0, []), done.stderr)
            alone = subprocess.run([BIHIVE_MPI, *words], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual((alone.returncode, alone.stdout), (0, done.stdout))
            self.assertIn(text, done.stdout)

    def test_no_arguments(self):
        done = self.run_ranks(RANKS, BIHIVE_MPI)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr.count("Usage: mpirun"), 1, done.stderr)

    def test_a_rank_with_other_arguments(self):
        for first, second in ((WORDS, ["--help"]), (["render", "--help"], WORDS), (WORDS, []), (WORDS, [*WORDS, "--distribute"])):
            with self.subTest(first=first, second=second):
                done = self.two([BIHIVE_MPI, *first], [BIHIVE_MPI, *second])
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertEqual(len(self.errors(done)), 1, done.stderr)
                self.assertIn("the command line of rank 1 is not that of rank 0", self.errors(done)[0])
                self.assertEqual(self.leftovers(), [])

    def test_a_rank_that_never_starts(self):
        done = self.two([BIHIVE_MPI, *WORDS], ["sleep", str(PATIENCE_S)])
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)
        self.assertIn("not all ranks have started this program within 4 s", self.errors(done)[0])
        self.assertEqual(self.leftovers(), [])

    def test_a_rank_that_ends_early(self):
        self.assertNotEqual(self.two([BIHIVE_MPI, *WORDS], ["true"]).returncode, 0)
        self.assertEqual(self.leftovers(), [])

    def begin(self, *words):
        process = subprocess.Popen(self.mpirun(RANKS, "sh", "-c", WITH_NUMBER, BIHIVE_MPI, *words), cwd=self.folder, env=self.environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        numbers = []
        deadline = time.monotonic() + PATIENCE_S
        for rank in range(RANKS):
            while not os.path.exists(self.path(f"pid.{rank}")):
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            numbers.append(int(self.read(f"pid.{rank}")))

        def end():
            for number in numbers:
                try:
                    os.kill(number, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            process.kill()
            process.communicate()

        self.addCleanup(end)
        return process, numbers

    def wait_for_work(self, number, seconds):
        """Until the process has used so much processor time."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            with open(f"/proc/{number}/stat") as file:
                used = file.read().rsplit(")", 1)[1].split()[11:13]
            if sum(map(int, used)) >= seconds * os.sysconf("SC_CLK_TCK"):
                return
            time.sleep(0.02)
        self.fail("it does not work")

    def test_a_rank_that_is_stopped(self):
        # In the middle of a picture.
        for rank, more in ((0, []), (1, ["--distribute"])):
            with self.subTest(rank=rank, more=more):
                process, numbers = self.begin(*LONG, *more)
                self.wait_for_work(numbers[rank], 0.6)
                os.kill(numbers[rank], signal.SIGSTOP)
                out, err = process.communicate(timeout=PATIENCE_S)
                self.assertEqual((process.returncode, out), (3, ""), err)
                errors = [line for line in err.splitlines() if line.startswith("bihive: ") and "%" not in line]
                self.assertEqual(len(errors), 1, err)
                self.assertIn(f"rank {rank} has been silent for 3 s", errors[0])
                for number in range(RANKS):
                    os.remove(self.path(f"pid.{number}"))
                self.assertEqual(self.leftovers(), [])

    def test_all_ranks_are_stopped_for_a_while(self):
        process, numbers = self.begin("render", "demo", "-o", "a.png", "--size", "1600x1200", "--threads", "1")
        self.wait_for_work(numbers[0], 0.25)
        for sign in (signal.SIGSTOP, signal.SIGCONT):
            for number in numbers:
                os.kill(number, sign)
            time.sleep(6 if sign == signal.SIGSTOP else 0)
        err = process.communicate(timeout=PATIENCE_S)[1]
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual(self.read("a.png")[:4], b"\x89PNG")

    def test_patience_that_is_no_number(self):
        for text in ("", "-1", "long", "1e3", "99999999"):
            done = subprocess.run([BIHIVE_MPI, "--help"], env={**os.environ, "BIHIVE_MPI_PATIENCE": text}, capture_output=True, text=True,
                                  timeout=PATIENCE_S)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn("BIHIVE_MPI_PATIENCE", done.stderr)


if __name__ == "__main__":
    main()
