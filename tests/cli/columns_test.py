"""--columns, and data sets within files: FILE:/GROUP/NAME."""

import json
import os
import shutil

from program import ProgramTest, main

DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data", "io")


class Columns(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", "px,py,pz,size\n1,2,3,0.5\n4,5,6,0.25\n")
        self.chosen = ["--columns", "x=px,y=py,z=pz,r=size"]

    def test_all_commands_that_read_files(self):
        self.assertIn("--columns", self.fail_input("info", "a.csv"))
        self.assertEqual(self.succeed_json("info", "a.csv", *self.chosen)["spheres"], 2)
        self.assertEqual(self.succeed_json("stats", "a.csv", *self.chosen)["spheres"], 2)
        selected = self.succeed_json("select", "a.csv", "radius > 0.3", *self.chosen)
        self.assertEqual(selected["selected"], 1)
        picture = self.succeed_json("render", "a.csv", "-o", "a.png", "--size", "32x32", *self.chosen)
        self.assertEqual(picture["settings"]["columns"], {"x": "px", "y": "py", "z": "pz", "r": "size"})
        self.succeed("convert", "a.csv", "-o", "b.csv", *self.chosen)
        with open(self.path("b.csv")) as written:
            self.assertIn("4,5,6,0.25", written.read())

    def test_films_have_frames_of_them(self):
        xyz = "1\nProperties=species:S:1:pos:R:3:q:R:3\nH 0 0 0 {0} 2 3\n"
        self.write("a.xyz", xyz.format(1) + xyz.format(2))
        chosen = ["--columns", "x=q_1,y=q_2,z=q_3"]
        self.succeed("film", "a.xyz", "-o", "f/%d.png", "--size", "16x16", *chosen)
        self.succeed("render", "a.xyz", "--film", "f/film.json", "--frame", "1", "-o", "b.png")
        with open(self.path("f/1.png"), "rb") as film, open(self.path("b.png"), "rb") as single:
            self.assertEqual(film.read(), single.read())

    def test_scene_files(self):
        columns = {"x": "px", "y": "py", "z": "pz", "radius": "4"}
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "a.csv", "columns": columns}}))
        self.assertEqual(self.succeed_json("info", "s.json")["spheres"], 2)
        self.write("old.json", json.dumps({"bihive_scene": 1, "spheres": {"file": "a.csv", "columns": columns}}))
        self.assertIn("/spheres/columns", self.fail_input("info", "old.json"))
        self.write("bad.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "a.csv", "columns": {"x": 1}}}))
        self.assertIn("/spheres/columns: expected an object of texts", self.fail_input("info", "bad.json"))
        self.write("inline.json", json.dumps({"bihive_scene": 2, "spheres": [[0, 0, 0, 1]]}))
        self.assertIn("columns", self.fail_input("info", "inline.json", "--columns", "x=1"))

    def test_bad_options(self):
        self.assertIn("PART=COLUMN", self.fail_usage("info", "a.csv", "--columns", "px"))
        self.assertIn("twice", self.fail_usage("info", "a.csv", "--columns", "x=px,x=py"))
        self.assertIn("--columns", self.fail_usage("info", "scenario1", "--columns", "x=1"))
        self.assertIn("cannot be chosen", self.fail_input("info", "demo", "--columns", "x=1"))


class DataSets(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("sets.h5", "water.h5md", "amber.nc", "lammps.nc"):
            shutil.copy(os.path.join(DATA, name), self.path(name))

    def has_hdf5(self):
        return "has no libhdf5" not in self.run_bihive("info", "sets.h5").stderr

    def test_hdf5(self):
        if not self.has_hdf5():
            self.skipTest("this build has no libhdf5")
        self.assertEqual(self.succeed_json("info", "sets.h5:/run/xyz", "--radius", "1")["format"], "HDF5")
        self.succeed("render", "sets.h5:/run/film", "--frame", "1", "-o", "a.png", "--size", "16x16", "--radius", "1")
        self.assertEqual(self.succeed_json("info", "sets.h5:/run/film", "--frames", "--radius", "1")["frames"], 2)
        self.succeed("film", "sets.h5:/run/film", "-o", "f/%d.png", "--size", "16x16", "--radius", "1")
        self.assertTrue(os.path.exists(self.path("f/1.png")))
        self.assertIn("/run/xyz (3 x 3)", self.fail_input("info", "sets.h5"))
        # The file is never an output.
        shutil.copy(self.path("sets.h5"), self.path("sets.png"))
        before = os.stat(self.path("sets.png")).st_size
        self.fail_input("render", "sets.png:/run/xyz", "-o", "sets.png", "--size", "16x16")
        self.assertEqual(os.stat(self.path("sets.png")).st_size, before)

    def test_trajectories(self):
        self.write("atoms.xyz", "3\n\nO 0 0 0\nH 1 0 0\nH 0 1 0\n")
        inputs = ["amber.nc"] + (["water.h5md:/particles/water"] if self.has_hdf5() else [])
        for trajectory in inputs:
            self.succeed("convert", "atoms.xyz", "--trajectory", trajectory, "--frame", "1", "-o", "b.csv")
            with open(self.path("b.csv")) as written:
                self.assertIn("H,4,5.5,6", written.read())
        self.assertIn("together with a file of its atoms", self.fail_input("info", "amber.nc"))
        self.assertEqual(self.succeed_json("info", "lammps.nc", "--frames", "--radius", "1")["frames"], 2)


if __name__ == "__main__":
    main()
