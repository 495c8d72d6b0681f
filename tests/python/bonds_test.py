"""Bonds of spheres: those of files, those given as pairs, and pictures of them."""

import copy
import pickle

import bihive as bh
import numpy as np
from program import ProgramTest, main

OPTIONS = {"size": (64, 48), "samples": 1, "threads": 1}
SDF = """


  3  2  0  0  0  0            999 V2000
    0.0000    0.0000    0.0000 O   0  0
    0.9600    0.0000    0.0000 H   0  0
   -0.2400    0.9300    0.0000 H   0  0
  1  2  1  0
  3  1  2  0
M  END
"""


class Bonds(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("w.sdf", SDF)

    def test_of_a_file(self):
        s = bh.read(self.path("w.sdf"))
        self.assertEqual(s.bonds.tolist(), [[0, 1, 1], [0, 2, 2]])
        self.assertEqual(s.bonds.dtype, np.int32)
        # They go with their spheres.
        self.assertEqual(s[[2, 0]].bonds.tolist(), [[0, 1, 2]])
        self.assertEqual(s[1:].bonds.tolist(), [])
        self.assertEqual(s.moved(s.xyz + 1).bonds.tolist(), s.bonds.tolist())
        for again in (pickle.loads(pickle.dumps(s)), copy.deepcopy(s)):
            self.assertEqual(again, s)
            self.assertEqual(again.bonds.tolist(), s.bonds.tolist())
        small = {"ball_scale": 0.2, **OPTIONS}  # else the atoms hide their bonds
        drawn = bh.render(s, bonds="file", **small).hash
        self.assertEqual(bh.render(s, bonds="auto", **small).hash, drawn)
        self.assertEqual(bh.render(pickle.loads(pickle.dumps(s)), bonds="auto", **small).hash, drawn)
        one_bond = bh.Spheres(s.xyz, radius=s.radius, element=["O", "H", "H"], bonds=[[0, 1]])
        self.assertNotEqual(bh.render(one_bond, bonds="file", **small).hash, drawn)

    def test_given_as_pairs(self):
        xyz = [[0, 0, 0], [3, 0, 0], [0, 3, 0]]
        s = bh.Spheres(xyz, radius=0.5, bonds=[[2, 0], [0, 1], [0, 2]])
        self.assertEqual(s.bonds.tolist(), [[0, 1, 0], [0, 2, 0]])
        self.assertEqual(bh.Spheres(xyz, radius=0.5, bonds=[[0, 1, 4]]).bonds.tolist(), [[0, 1, 4]])
        self.assertEqual(bh.Spheres(xyz, radius=0.5, bonds=[]).bonds.shape, (0, 3))
        self.assertEqual(bh.Spheres(xyz, radius=0.5).bonds.shape, (0, 3))
        self.assertNotEqual(s, bh.Spheres(xyz, radius=0.5))
        # Sticks between spheres of no element.
        with_sticks = bh.render(s, bonds="file", stick_radius=0.2, **OPTIONS)
        self.assertNotEqual(with_sticks.hash, bh.render(s, **OPTIONS).hash)
        with self.assertRaisesRegex(bh.UsageError, "states no bonds"):
            bh.render(bh.Spheres(xyz, radius=0.5), bonds="file", **OPTIONS)

    def test_that_are_none(self):
        xyz = np.zeros((3, 3))
        for bonds in ([0, 1], [[0, 1, 2, 3]], [[0, 3]], [[-1, 0]], [[0.5, 1]], [["a", "b"]], [[0, 1, 5]], [[1, 1]]):
            with self.subTest(bonds), self.assertRaisesRegex(bh.UsageError, "bonds"):
                bh.Spheres(xyz, radius=1, bonds=bonds)

    def test_of_copies_go_to_the_next_copy(self):
        self.write("c.mol2", "@<TRIPOS>MOLECULE\nm\n2 1\nSMALL\nNO_CHARGES\n@<TRIPOS>ATOM\n1 C1 0.5 5 5 C.3 1 A\n"
                             "2 C2 9.5 5 5 C.3 1 A\n@<TRIPOS>BOND\n1 1 2 1\n@<TRIPOS>CRYSIN\n10 10 10 90 90 90 1 1\n")
        s = bh.read(self.path("c.mol2"), replicate=(3, 1, 1))
        self.assertEqual(s.bonds.tolist(), [[0, 5, 1], [1, 2, 1], [3, 4, 1]])


if __name__ == "__main__":
    main()
