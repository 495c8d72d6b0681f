"""Ranks on two machines: network namespaces with an Ethernet between them. For `make test-all`."""

# ctest: LABELS long

import json
import os
import pathlib
import subprocess
import sys
import unittest

from program import PATIENCE_S, main
from ranks import BIHIVE_MPI, MPIRUN, OnRanks, is_open_mpi

sys.path.insert(0, os.path.join(os.environ["BIHIVE_SOURCE"], "bench/ranks"))

import hosts  # noqa: E402


@unittest.skipUnless(BIHIVE_MPI and is_open_mpi() and hosts.can_make(),
                     "needs bihive-mpi, Open MPI, ip (Debian: iproute2) and the right to make network namespaces")
class TwoHosts(OnRanks):
    def on_hosts(self, of_each, *words):
        with hosts.two(pathlib.Path(self.folder), ranks_of_each=of_each) as (enter, options):
            command = self.mpirun(2 * of_each, BIHIVE_MPI, *words)
            at = command.index(MPIRUN) + 1
            return subprocess.run([*enter, *command[:at], *options, *command[at:]], cwd=self.folder,
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S)

    def test_the_picture_of_one_process(self):
        words = ["render", "demo", "--json", "--size", "320x240", "--threads", "1"]
        alone = json.loads(self.run_bihive(*words, "-o", "alone.png").stdout)
        for of_each in (1, 2):
            for more in ([], ["--distribute"]):
                with self.subTest(of_each=of_each, more=more):
                    done = self.on_hosts(of_each, *words, "-o", "hosts.png", *more)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    report = json.loads(done.stdout)
                    self.assertEqual(report["picture_hash"], alone["picture_hash"])
                    self.assertEqual(report["rays"], alone["rays"])

    def test_a_film_with_more_ranks_than_pictures(self):
        film = ["film", "run.xyz", "--frames", "0:3", "--size", "64x48", "--threads", "1"]
        self.succeed(*film, "-o", "alone/%d.png")
        done = self.on_hosts(2, *film, "-o", "hosts/%d.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        for i in range(3):
            self.assertEqual(self.read(f"hosts/{i}.png"), self.read(f"alone/{i}.png"))


if __name__ == "__main__":
    main()
