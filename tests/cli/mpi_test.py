"""Films whose pictures are shared out over ranks of mpirun, as docs/many_machines.md says."""

import os
import shutil
import subprocess
import unittest

from program import BIHIVE, PATIENCE_S, ProgramTest, main

MPIRUN = shutil.which("mpirun")
FRAMES = 7
# Each rank draws the shard of its own number.
SHARD_OF_RANK = 'exec "$0" "$@" --shard $OMPI_COMM_WORLD_RANK/$OMPI_COMM_WORLD_SIZE'


def frame(number):
    places = [f"C {i + 0.1 * number * i:.2f} {0.3 * i * i:.2f} {0.2 * number:.2f}\n" for i in range(5)]
    return f"5\nframe {number}\n" + "".join(places)


def is_open_mpi():
    """Whether mpirun is Open MPI's: another one names the ranks in other ways."""
    if MPIRUN is None:
        return False
    said = subprocess.run([MPIRUN, "--version"], capture_output=True, text=True, timeout=PATIENCE_S)
    return "Open MPI" in said.stdout


@unittest.skipUnless(is_open_mpi(), "there is no Open MPI here: install openmpi-bin")
class Ranks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("run.xyz", "".join(map(frame, range(FRAMES))))

    def on_ranks(self, count, *arguments):
        options = ["--oversubscribe", "--bind-to", "none", "-n", str(count)]
        if os.geteuid() == 0:
            options.append("--allow-run-as-root")
        return subprocess.run([MPIRUN, *options, "sh", "-c", SHARD_OF_RANK, BIHIVE, *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=PATIENCE_S)

    def test_a_film_of_three_ranks_equals_that_of_one_process(self):
        small = ["--size", "48x32", "--samples", "1", "--threads", "1"]
        self.succeed("film", "run.xyz", "-o", "whole/%d.png", *small)
        done = self.on_ranks(3, "film", "run.xyz", "-o", "parts/%d.png", *small)
        self.assertEqual(done.returncode, 0, done.stderr)
        kept = self.on_ranks(3, "film", "run.xyz", "-o", "parts/%d.png", *small)
        self.assertEqual(kept.returncode, 0, kept.stderr)
        self.assertEqual(kept.stdout.count(" kept from before"), 3, kept.stdout)
        self.succeed("film", "--join", "-o", "parts/%d.png")
        for number in range(FRAMES):
            self.assertEqual(self.read(f"parts/{number}.png"), self.read(f"whole/{number}.png"), number)

    def test_a_missing_file_ends_all_ranks(self):
        done = self.on_ranks(3, "film", "absent.xyz", "-o", "parts/%d.png")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("absent.xyz", done.stderr)
        self.assertFalse(os.path.exists(self.path("parts")))


if __name__ == "__main__":
    main()
