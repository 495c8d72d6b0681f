"""Pictures and films by three ranks of mpirun: bihive-mpi, and shards of bihive, as docs/many_machines.md says."""

import importlib.util
import json
import os
import random
import re
import subprocess
import unittest

from program import BIHIVE, PATIENCE_S, ProgramTest, main
from ranks import BIHIVE_MPI, FRAMES, OnRanks, frame, gsd_file, is_open_mpi

# Each rank draws the shard of its own number.
SHARD_OF_RANK = 'exec "$0" "$@" --shard $OMPI_COMM_WORLD_RANK/$OMPI_COMM_WORLD_SIZE'


@unittest.skipUnless(is_open_mpi(), "there is no Open MPI here: install openmpi-bin")
class Shards(OnRanks):
    def on_ranks(self, count, *arguments):
        return self.run_ranks(count, "sh", "-c", SHARD_OF_RANK, BIHIVE, *arguments)

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


# Rank 2 draws another picture.
OWN_SIZE = 'exec "$0" render run.xyz --size 5x$((OMPI_COMM_WORLD_RANK / 2 + 3)) "$@"'


@unittest.skipUnless(BIHIVE_MPI and is_open_mpi(), "bihive-mpi was not built: install libopenmpi-dev and openmpi-bin")
class Program(OnRanks):
    def test_three_ranks_give_the_same_picture(self):
        self.expect_picture_of_one_process((3,), "demo", ["--size", "97x103", "--style", "glossy"])
        self.expect_picture_of_one_process((3,), "demo", ["--size", "60x50", "--view", "distance"])  # by rank 0 alone

    def test_fewer_spheres_than_ranks(self):
        self.write("one.xyz", "2\n\nC 0 0 0\nC 0 0 0\n")
        alone = self.hash_of(self.run_bihive("render", "one.xyz", "-o", "alone.png", "--json", "--size", "40x30"))
        words = ["render", "one.xyz", "-o", "ranks.png", "--json", "--size", "40x30", "--threads", "1", "--distribute"]
        self.assertEqual(self.hash_of(self.run_ranks(4, BIHIVE_MPI, *words)), alone)
        # A rank without rows has no radii, and the set has.
        self.succeed("scene", "scenario1", "--count", "2", "-o", "two.npy")
        self.expect_picture_of_one_process((3, 4), "two.npy", ["--size", "40x30"])

    def test_the_rays_are_those_of_all_ranks(self):
        words = ["render", "demo", "-o", "a.png", "--json", "--size", "160x120", "--style", "plain"]
        alone = json.loads(self.run_bihive(*words).stdout)["rays"]
        ranks = json.loads(self.run_ranks(3, BIHIVE_MPI, *words).stdout)["rays"]
        self.assertEqual(ranks, alone)

    def test_a_film_of_three_ranks_equals_that_of_one_process_too(self):
        small = ["--size", "48x32", "--samples", "1", "--threads", "1"]
        self.succeed("film", "run.xyz", "-o", "whole.y4m", *small)
        done = self.run_ranks(3, BIHIVE_MPI, "film", "run.xyz", "-o", "ranks.y4m", *small)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.read("ranks.y4m"), self.read("whole.y4m"))
        self.assertEqual(done.stdout.count("ranks.y4m"), 1, done.stdout)
        # In another order, and by more ranks than pictures.
        order = [*small, "--frames", ":2", "--ping-pong", "--hold-first", "2", "--reverse"]
        self.succeed("film", "run.xyz", "-o", "whole.y4m", *order)
        done = self.run_ranks(3, BIHIVE_MPI, "film", "run.xyz", "-o", "ranks.y4m", *order)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.read("ranks.y4m"), self.read("whole.y4m"))

    def test_three_ranks_share_two_pictures(self):
        film = ["film", "run.xyz", "--frames", "2:4", "--size", "150x100", "--threads", "1"]
        self.succeed(*film, "-o", "whole/%d.png")
        done = self.run_ranks(3, BIHIVE_MPI, *film, "-o", "ranks/%d.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([self.read(f"ranks/{i}.png") for i in (0, 1)], [self.read(f"whole/{i}.png") for i in (0, 1)])
        # A rank that fails ends all, also the one that has no picture of its own.
        self.write("bad.xyz", frame(0) + frame(1).replace("C 1", "C x"))
        done = self.run_ranks(3, BIHIVE_MPI, "film", "bad.xyz", "-o", "bad/%d.png", *film[4:])
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)

    def test_one_rank_says_what_is_wrong_for_all(self):
        wrong = [
            (["render", "absent.xyz", "-o", "a.png"], 1, "absent.xyz"),
            (["render", "run.xyz", "-o", "missing/a.png"], 1, "missing"),
            (["render", "run.xyz", "-o", "a.png", "--samples", "many"], 2, "--samples"),
            (["info", "run.xyz"], 2, "render and film"),
            (["film", "run.xyz", "-o", "a.y4m", "--shard", "0/2"], 2, "--shard"),
            (["film", "run.xyz", "-o", "a.y4m", "--distribute"], 2, "--distribute"),
            (["render", "absent.xyz", "-o", "a.png", "--distribute"], 1, "absent.xyz"),
            (["render", "run.xyz", "-o", "missing/a.png", "--distribute"], 1, "missing"),
            (["render", "run.xyz", "-o", "a.png", "--distribute", "--engine", "brute"], 2, "--engine"),
            (["render", "run.xyz", "-o", "a.png", "--distribute", "--view", "tree"], 2, "--distribute"),
        ]
        for words, code, text in wrong:
            with self.subTest(words=words):
                done = self.run_ranks(3, BIHIVE_MPI, *words)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(len(self.errors(done)), 1, done.stderr)
                self.assertIn(text, self.errors(done)[0])
                self.assertEqual(self.leftovers(), [])

    def test_rank_0_alone_reads(self):
        """The others need no file, and the standard input is that of rank 0."""
        alone = self.hash_of(self.run_bihive("render", "run.xyz", "-o", "alone.png", "--json", "--size", "80x60"))
        elsewhere = 'test $OMPI_COMM_WORLD_RANK = 0 || cd /; exec "$0" render "$@"'
        for more in ([], ["--distribute"]):
            words = ["-o", "a.png", "--json", "--size", "80x60", "--threads", "1", *more]
            done = self.run_ranks(3, "sh", "-c", elsewhere, BIHIVE_MPI, "run.xyz", *words)
            self.assertEqual(self.hash_of(done), alone)
        with open(self.path("run.xyz"), "rb") as text:
            done = subprocess.run(self.mpirun(3, BIHIVE_MPI, "render", "-", *words), cwd=self.folder, stdin=text, capture_output=True,
                                  text=True, timeout=PATIENCE_S)
        self.assertEqual(self.hash_of(done), alone)

    def test_ranks_with_other_words(self):
        done = self.run_ranks(3, "sh", "-c", OWN_SIZE, BIHIVE_MPI, "-o", "a.png")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.errors(done), ["bihive: error: the command line of rank 2 is not that of rank 0; give all ranks the same "
                                             "program and the same arguments"])
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_ranks_of_other_builds(self):
        version = self.run_bihive("--version").stdout.split()[1].encode()
        with open(BIHIVE_MPI, "rb") as file:
            program = file.read()
        self.assertIn(version, program)
        self.write("other", program.replace(version, b"9" + version[1:]))
        other = self.path("other")
        os.chmod(other, 0o755)
        first = self.mpirun(1, BIHIVE_MPI, "render", "run.xyz", "-o", "a.png")
        done = subprocess.run([*first, ":", "-n", "2", other, "render", "run.xyz", "-o", "a.png"], cwd=self.folder, capture_output=True,
                              text=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)
        self.assertIn("the program of rank 1 is not that of rank 0", self.errors(done)[0])

    def test_a_full_disk(self):
        for more in ([], ["--distribute"]):
            done = self.run_ranks(3, BIHIVE_MPI, "render", "demo", "-o", "/dev/full", "--size", "320x240", *more)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(len(self.errors(done)), 1, done.stderr)
            self.assertIn("/dev/full", self.errors(done)[0])
            self.assertEqual(self.leftovers(), [])

    def test_parts_of_a_gsd_file(self):
        numbers = random.Random(3)
        count = 1 << 16  # fewer are read by rank 0
        places = [numbers.uniform(-20, 20) for _ in range(3 * count)]
        radii = [numbers.uniform(0.1, 0.4) for _ in range(count)]
        with open(self.path("set.gsd"), "wb") as file:
            file.write(gsd_file(places, radii, [numbers.randrange(2) for _ in range(count)]))
        for options in ([], ["--radius", "0.2", "--colour-by", "z"]):
            self.expect_picture_of_one_process((3,), "set.gsd", ["--size", "80x60", *options])

    def test_parts_of_a_dump(self):
        numbers = random.Random(4)
        count = 1 << 16
        head = "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n0 40\n0 40\n0 40\nITEM: ATOMS id type xs ys zs radius\n"
        rows = [f"{i + 1} {numbers.choice((1, 2, 12))} {numbers.random():.5g} {numbers.random()} {numbers.random():.3f} 0.3\n"
                for i in range(count)]
        whole = head.format(count) + "".join(rows)
        self.write("set.dump", whole + "\n")
        self.expect_picture_of_one_process((3,), "set.dump", ["--size", "80x60"])
        # Rank 0 reads a file with several frames.
        self.write("two.dump", whole + whole)
        self.expect_picture_of_one_process((3,), "two.dump", ["--size", "80x60"])
        # One row of the last rank makes all colours bytes, so rank 0 reads them.
        colours = [f"{row.strip()} 0 1 0.5\n" for row in rows[:-1]] + [f"{rows[-1].strip()} 0 255 0\n"]
        self.write("colours.dump", head.format(count).replace("radius", "radius red green blue") + "".join(colours))
        self.expect_picture_of_one_process((3,), "colours.dump", ["--size", "80x60"])
        # Each rank knows the numbers of its lines.
        rows[-5] = "1 1 0.5 x 0.5 0.3\n"
        self.write("bad.dump", head.format(count) + "".join(rows))
        alone = self.run_bihive("render", "bad.dump", "-o", "a.png")
        done = self.run_ranks(3, BIHIVE_MPI, "render", "bad.dump", "-o", "a.png", "--distribute")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.errors(done), self.errors(alone))
        self.write("few.dump", head.format(count + 1) + "".join(rows))
        done = self.run_ranks(3, BIHIVE_MPI, "render", "few.dump", "-o", "a.png", "--distribute")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)
        self.assertIn("few.dump:4: the dump promises 65537 atoms, but 65536 lines follow", self.errors(done)[0])

    @unittest.skipUnless(importlib.util.find_spec("h5py"), "needs h5py")
    def test_parts_of_an_h5md_file(self):
        import h5py
        import numpy

        numbers = numpy.random.default_rng(5)
        count = 1 << 16
        places = (40 * numbers.random((2, count, 3))).astype("f4")
        kinds = numbers.integers(1, 4, (2, count)).astype("i4")
        with h5py.File(self.path("set.h5md"), "w") as file:
            for name, values in (("position", places), ("species", kinds)):
                group = file.create_group("particles/all/" + name)
                group.create_dataset("value", data=values)
                group.create_dataset("step", data=numpy.arange(2))
            file["particles/all/charge"] = numbers.random(count)
        self.expect_picture_of_one_process((3,), "set.h5md", ["--size", "80x60"])
        # Types that are no whole numbers are numbered as they come, so they need all rows.
        with h5py.File(self.path("set.h5md"), "r+") as file:
            del file["particles/all/species/value"]
            file["particles/all/species/value"] = kinds + 0.5
        done = self.run_ranks(3, BIHIVE_MPI, "render", "set.h5md", "-o", "a.png", "--distribute")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)
        self.assertIn("types whole ones", self.errors(done)[0])

    def test_parts_of_a_file(self):
        self.succeed("scene", "scenario1", "--count", "200", "-o", "set.npy")
        self.expect_picture_of_one_process((3,), "set.npy", ["--size", "80x60", "--recenter", "--view-from", "iso"])
        with open(self.path("set.npy"), "rb") as file:
            content = file.read()
        self.write("bad.npy", content[:-4] + b"\x00\x00\xc0\x7f")  # a radius of the last rank that is not a number
        done = self.run_ranks(3, BIHIVE_MPI, "render", "bad.npy", "-o", "a.png", "--distribute")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)
        self.assertIn("row 199 (from 0): the radius is not finite", self.errors(done)[0])
        elsewhere = 'test $OMPI_COMM_WORLD_RANK = 0 || cd /; exec "$0" render set.npy --distribute "$@"'
        done = self.run_ranks(3, "sh", "-c", elsewhere, BIHIVE_MPI, "-o", "a.png")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(self.errors(done)), 1, done.stderr)
        self.assertIn("set.npy", self.errors(done)[0])
        os.mkdir(self.path("other"))
        self.write("other/set.npy", content)
        elsewhere = 'test $OMPI_COMM_WORLD_RANK = 2 && cd other; exec "$0" render set.npy --distribute "$@"'
        for other in (["scenario1", "--count", "100"], ["scenario3", "--count", "200", "--radius", "0.5"]):
            self.succeed("scene", *other, "-o", "set.npy")
            done = self.run_ranks(3, "sh", "-c", elsewhere, BIHIVE_MPI, "-o", "a.png")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(len(self.errors(done)), 1, done.stderr)
            self.assertIn("different files", self.errors(done)[0])
        self.assertFalse(os.path.exists(self.path("a.png")))


if __name__ == "__main__":
    main()
