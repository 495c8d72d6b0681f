"""Spheres.save and bihive.convert: files that hold the spheres again."""

import os
import unittest

import bihive as bh
import numpy as np
from program import ProgramTest, main


class Files(ProgramTest):
    def test_every_format_is_read_again(self):
        rng = np.random.default_rng(4)
        colours = rng.uniform(size=(20, 3)).astype(np.float32)
        s = bh.Spheres(rng.normal(size=(20, 3)), radius=rng.uniform(0.1, 1, 20), colour=colours, columns={"charge": rng.normal(size=20)})
        for ending in ("extxyz", "csv", "npy", "ply"):
            path = self.path(f"a.{ending}")
            left_out = s.save(path)
            again = bh.read(path)
            self.assertTrue(np.array_equal(again.xyz, s.xyz), ending)
            self.assertTrue(np.array_equal(again.radius, s.radius), ending)
            if ending == "npy":
                self.assertTrue(left_out)
                continue
            self.assertTrue(np.array_equal(again["charge"], s["charge"]), ending)
            self.assertTrue(np.array_equal(again["colour"], s["colour"]), ending)
        self.assertEqual(s.save(self.path("b.txt"), "csv"), [])
        self.assertEqual(self.read("b.txt"), self.read("a.csv"))

    def test_the_bytes_are_those_of_the_program(self):
        bh.convert("demo", self.path("python.csv"), select="chain A", frame=0)
        self.run_bihive("convert", "demo", "-o", "program.csv", "--select", "chain A")
        self.assertEqual(self.read("python.csv"), self.read("program.csv"))

    def test_what_cannot_be_written(self):
        s = bh.Spheres([[0, 0, 0]], radius=1)
        with self.assertRaisesRegex(bh.UsageError, "expected an ending of .xyz"):
            s.save(self.path("a.pdb"))
        with self.assertRaisesRegex(bh.UsageError, "bihive convert"):
            s.save(self.path("a.json"))
        with self.assertRaisesRegex(bh.UsageError, "found 'pdb'"):
            s.save(self.path("a.csv"), "pdb")
        with self.assertRaises(OSError):
            s.save(self.path("missing/a.csv"))
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
