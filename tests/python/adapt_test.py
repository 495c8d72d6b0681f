"""Atoms of ASE and MDAnalysis: by what they can do, and with the packages themselves where they are installed."""

import os
import unittest

import bihive as bh
import numpy as np

SOURCE = os.environ["BIHIVE_SOURCE"]
SIZE = (32, 24)


class AseLike:
    """What ASE's Atoms have."""

    def __init__(self):
        self.arrays = {
            "numbers": np.array([8, 1, 1]),
            "positions": np.array([[0, 0, 0], [0.76, 0.59, 0], [-0.76, 0.59, 0]]),
            "tags": np.array([3, 4, 5]),
            "initial_charges": np.array([-0.8, 0.4, 0.4]),
            "momenta": np.zeros((3, 3)),
        }
        self.cell = np.diag([4.0, 5, 6])

    def get_positions(self):
        return self.arrays["positions"].copy()

    def get_atomic_numbers(self):
        return self.arrays["numbers"].copy()

    def get_cell(self):
        return self.cell


class Timestep:
    triclinic_dimensions = np.diag([10.0, 10, 10])


class Trajectory:
    """Moves the atoms of its universe, as MDAnalysis does."""

    def __init__(self, universe):
        self.universe, self.ts = universe, Timestep()

    def __iter__(self):
        return self[:]

    def __getitem__(self, part):
        for frame in range(4)[part] if isinstance(part, slice) else part:
            self.universe.atoms.positions = self.universe.first + np.float32(frame)
            yield self.ts


class AtomGroup:
    def __init__(self, universe, positions):
        self.universe, self.positions = universe, positions
        self.elements = np.array(["O", "H", "H"], dtype=object)
        self.names = np.array(["OW", "HW1", "HW2"], dtype=object)
        self.resids = np.array([1, 1, 1])

    @property
    def charges(self):
        raise NoDataError("no charges")

    @property
    def ts(self):
        return self.universe.trajectory.ts


class NoDataError(Exception):
    """MDAnalysis' has other bases, too."""


class Universe:
    def __init__(self):
        self.first = np.array([[0, 0, 0], [0.76, 0.59, 0], [-0.76, 0.59, 0]], dtype=np.float32)
        self.trajectory = Trajectory(self)
        self.atoms = AtomGroup(self, self.first.copy())


class ByDuckTyping(unittest.TestCase):
    def test_ase(self):
        picture = bh.render(AseLike(), size=SIZE, cell=True, looks=bh.Look("charge > 0 and tags = 5", colour="red"))
        self.assertEqual(picture.size, SIZE)
        s = bh.Tree(AseLike()).spheres
        self.assertEqual(s["element"].tolist(), [8, 1, 1])
        self.assertEqual(s["tags"].tolist(), [3, 4, 5])
        self.assertEqual(s.cell[:3].tolist(), np.diag([4, 5, 6]).tolist())
        self.assertGreater(s.radius[0], s.radius[1])

    def test_a_universe_and_its_atoms(self):
        universe = Universe()
        for thing in [universe, universe.atoms]:
            s = bh.Tree(thing).spheres
            self.assertEqual(s["element"].tolist(), [8, 1, 1])
            self.assertEqual(s["name"].tolist(), ["OW", "HW1", "HW2"])
            self.assertNotIn("charge", s.columns)
            self.assertEqual(s.cell[0].tolist(), [10, 0, 0])
        self.assertEqual(bh.render(universe.atoms, size=SIZE, select="name OW").size, SIZE)

    def test_velocities_of_atoms(self):
        universe = Universe()
        self.assertNotIn("vx", bh.Tree(universe).spheres.columns)
        universe.atoms.velocities = np.array([[3, 4, 0], [0, 0, -2], [1, 2, 2]], dtype=np.float32)
        s = bh.Tree(universe).spheres
        self.assertEqual(s["vz"].tolist(), [0, -2, 2])
        self.assertEqual(s["speed"].tolist(), [5, 2, 3])
        self.assertEqual(bh.select(s, "speed > 2.5").tolist(), [True, False, True])
        self.assertNotIn("fx", s.columns)

    def test_atoms_without_elements(self):
        universe = Universe()
        universe.atoms.elements = np.array(["", "", ""], dtype=object)
        with self.assertRaisesRegex(bh.UsageError, "spheres: the atoms have neither elements nor radii"):
            bh.render(universe)
        universe.atoms.masses = np.array([15.9994, 1.008, 3.024])  # repartitioned: no element's
        with self.assertRaisesRegex(bh.UsageError, "neither elements nor radii"):
            bh.render(universe)
        universe.atoms.masses = np.array([15.9994, 1.008, 1.00794])
        with self.assertWarnsRegex(bh.InputWarning, "by their masses"):
            self.assertEqual(bh.Tree(universe).spheres["element"].tolist(), [8, 1, 1])
        del universe.atoms.masses
        universe.atoms.types = np.array(["O", "H", "H"], dtype=object)
        self.assertEqual(bh.Tree(universe).spheres["element"].tolist(), [8, 1, 1])
        del universe.atoms.types
        universe.atoms.radii = np.array([1.0, 2, 3])
        self.assertEqual(bh.Tree(universe).spheres.radius.tolist(), [1, 2, 3])

    def test_an_error_of_the_atoms_own_passes(self):
        class Broken(AtomGroup):
            @property
            def charges(self):
                raise OSError("disk")

        universe = Universe()
        universe.atoms = Broken(universe, universe.first)
        with self.assertRaisesRegex(OSError, "disk"):
            bh.render(universe)




class RealPackages(unittest.TestCase):
    @unittest.skipUnless(os.path.isdir("/usr/lib/python3/dist-packages/MDAnalysis"), "MDAnalysis is not installed")
    def test_mdanalysis(self):
        import tempfile
        import warnings

        # The entry's name stands in the last columns of old files, where MDAnalysis looks for charges.
        with open(os.path.join(SOURCE, "data", "1hpv.pdb")) as file:
            lines = [line[:66].rstrip() + "\n" for line in file]
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = os.path.join(folder.name, "1hpv.pdb")
        with open(path, "w") as file:
            file.writelines(lines)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import MDAnalysis

            universe = MDAnalysis.Universe(path)
        ours, theirs = bh.read(path), bh.Tree(universe.atoms).spheres
        self.assertEqual(len(ours), len(theirs))
        np.testing.assert_array_equal(ours["element"], theirs["element"])
        np.testing.assert_allclose(ours.xyz, theirs.xyz, atol=1e-4)
        np.testing.assert_allclose(ours.radius, theirs.radius, rtol=1e-6)
        for expression in ["chain A and name CA", "resname HOH", "b_factor > 20", "protein and element C"]:
            np.testing.assert_array_equal(bh.select(ours, expression), bh.select(theirs, expression), expression)

    @unittest.skipUnless(os.path.isdir("/usr/lib/python3/dist-packages/ase"), "ASE is not installed")
    def test_ase(self):
        from ase.build import bulk

        atoms = bulk("NaCl", "rocksalt", a=5.64, cubic=True)
        s = bh.Tree(atoms).spheres
        self.assertEqual(sorted(set(s["element"])), [11, 17])
        self.assertEqual(bh.render(atoms, size=SIZE, replicate=(2, 2, 2), cell=True).size, SIZE)


if __name__ == "__main__":
    unittest.main()
