"""Every kind of bad input gets one clear line and exit code 1, and leaves the folder as it was."""

# ctest: COST 500

import gzip
import io
import os

import numpy
from program import ProgramTest, main

LAMMPS_FRAME = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS pp pp pp
0 10
0 10
0 10
ITEM: ATOMS id type x y z
1 1 1 1 1
2 1 2 2 2
3 1 3 3 3
"""
PDB_ATOM = "ATOM      1  CA  ALA A   1      11.104   6.134  -6.504  1.00  0.00           C  \n"
SCENE = '{"bihive_scene": 1, "materials": [{"name": "a"}], "spheres": [[0, 0, 0, 1], [2, 0, 0, 1, "a"]]}'


def npy(array):
    file = io.BytesIO()
    numpy.save(file, array)
    return file.getvalue()


BAD_FILES = {
    "empty.pdb": b"",
    "empty.xyz": b"",
    "empty.npy": b"",
    "blank.txt": b"\n \n\t\n",
    "junk.bin": bytes((i * 97 + i * i * 31) % 256 for i in range(5000)),
    "junk.pdb": bytes((i * 89 + i * i * 7) % 256 for i in range(5000)),
    "zeros.bin": bytes(4096),
    "truncated.pdb.gz": gzip.compress((PDB_ATOM * 2000).encode())[:-500],
    "truncated.xyz.gz": gzip.compress(b"2\n\nC 0 0 0\nC 1 1 1\n")[:20],
    "damaged.xyz.gz": gzip.compress(b"2\n\nC 0 0 0\nC 1 1 1\n")[:-8] + bytes(8),
    "huge_count.xyz": b"100000000000\n\nC 0 0 0\n",
    "huge_count.lammpstrj": LAMMPS_FRAME.replace("ATOMS\n3", "ATOMS\n100000000000").encode(),
    "no_count.xyz": b"many\n\nC 0 0 0\n",
    "zero_count.xyz": b"0\n\n",
    "zero_atoms.lammpstrj": LAMMPS_FRAME.split("1 1 1 1 1")[0].replace("ATOMS\n3", "ATOMS\n0").encode(),
    "no_atoms.pdb": b"HEADER    NOTHING\nEND\n",
    "only_header.csv": b"x,y,z,r\n",
    "nan.xyz": b"1\n\nC 0 nan 0\n",
    "inf.csv": b"x,y,z,r\n0,0,0,1\n0,inf,0,1\n",
    "nan.csv": b"x,y,z,r\n0,0,0,nan\n",
    "too_large.csv": b"x,y,z,r\n1e39,0,0,1\n",
    "negative_radius.csv": b"x,y,z,r\n0,0,0,-1\n",
    "short_line.csv": b"x,y,z,r\n0,0,0,1\n0,0\n",
    "words.csv": b"x,y,z,r\n0,zero,0,1\n",
    "shape_1d.npy": npy(numpy.zeros(12)),
    "shape_2_columns.npy": npy(numpy.zeros((5, 2))),
    "shape_5_columns.npy": npy(numpy.zeros((5, 5))),
    "no_rows.npy": npy(numpy.zeros((0, 4))),
    "nan.npy": npy(numpy.array([[0, 0, numpy.nan, 1]])),
    "inf.npy": npy(numpy.array([[0, 0, numpy.inf, 1]], dtype=numpy.float32)),
    "negative_radius.npy": npy(numpy.array([[0, 0, 0, -2.0]])),
    "cut.npy": npy(numpy.zeros((100, 4)))[:-5],
    "objects.npy": npy(numpy.array([["a", "b", "c"]])),
    "cut_in_frame.lammpstrj": LAMMPS_FRAME[: LAMMPS_FRAME.index("2 1 2")].encode(),
    "cut_in_header.lammpstrj": LAMMPS_FRAME[: LAMMPS_FRAME.index("ITEM: BOX")].encode(),
    "cut_in_line.lammpstrj": LAMMPS_FRAME[: LAMMPS_FRAME.index(" 3 3\n")].encode(),
    "cut.xyz": b"3\n\nC 0 0 0\nC 1 1 1\n",
    "unknown_key.json": SCENE.replace('"materials"', '"material"').encode(),
    "cut.json": SCENE[: len(SCENE) // 2].encode(),
    "no_spheres.json": b'{"bihive_scene": 1, "spheres": []}',
    "no_file.json": b'{"bihive_scene": 1, "spheres": {"file": "nope.xyz"}}',
    "itself.json": b'{"bihive_scene": 1, "spheres": {"file": "itself.json"}}',
    "negative_radius.json": b'{"bihive_scene": 1, "spheres": [[0, 0, 0, -1]]}',
    "too_large.json": b'{"bihive_scene": 1, "spheres": [[1e39, 0, 0, 1]]}',
    "other.json": b'{"spheres": [[0, 0, 0, 1]]}',
}


class BadFiles(ProgramTest):
    def test_every_file_in_every_command(self):
        numpy.save(self.path("rays.npy"), numpy.ones((2, 6), dtype=numpy.float32))
        for name, content in BAD_FILES.items():
            self.write(name, content)
        for name in BAD_FILES:
            for command in [
                ["render", name, "-o", "a.png", "--size", "8x8"],
                ["stats", name],
                ["stats", name, "--json"],
                ["info", name, "--json"],
                ["trace", name, "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy"],
            ]:
                with self.subTest(command):
                    self.assertIn(name, self.fail_input(*command))

    def test_places_are_named(self):
        places = {
            "nan.xyz": "nan.xyz:3:",
            "inf.csv": "inf.csv:3:",
            "words.csv": "words.csv:2:",
            "short_line.csv": "short_line.csv:3:",
            "unknown_key.json": '/: unknown key "material"',
            "cut.json": "cut.json:1:",
            "negative_radius.json": "/spheres/0/3: expected a number from 0",
        }
        for name, place in places.items():
            self.write(name, BAD_FILES[name])
            self.assertIn(place, self.fail_input("info", name))

    def test_formats_that_are_not_read_are_named(self):
        files = {
            "a.stl": (b"solid cube\n", "a mesh (STL)"),
            "a": (b"%VERSION  VERSION_STAMP = V0001.000\n", "a topology of Amber (PRMTOP), without coordinates"),
            "a.json": (b'{"1": {"numbers": [1, 8]}}', "a database of ASE in JSON"),
            "a.cube": (b"a\nb\n 1 0 0 0\n 2 1 0 0\n 2 0 1 0\n 2 0 0 1\n", "a cube of Gaussian"),
        }
        for name, (content, what) in files.items():
            self.write(name, content)
            error = self.fail_input("info", name)
            self.assertIn(what, error)
            self.assertIn("which bihive does not read; ", error)

    def test_missing_file_and_folder(self):
        os.mkdir(self.path("folder"))
        self.assertIn("missing.pdb", self.fail_input("info", "missing.pdb"))
        self.assertIn("folder", self.fail_input("info", "folder"))
        self.assertIn("missing", self.fail_input("render", "missing/a.pdb", "-o", "a.png"))
        self.assertIn("scenario4", self.fail_input("stats", "scenario4"))
        self.assertEqual("the path is empty; name a file", self.fail_input("info", ""))

    def test_the_description_of_a_film(self):
        self.write("film.json", '{"bihive_film": 1, "asked": {}, "fixed": {}}')
        for command in (["info", "film.json"], ["render", "film.json", "-o", "a.png"]):
            self.assertIn("film.json: is the description of a film, not a scene; name the film's input, and this file after --film",
                          self.fail_input(*command))

    def test_names_with_line_breaks_stay_one_line(self):
        self.fail_input("info", "two\nlines\x1b[31m.pdb")

    def test_more_than_memory_holds_is_refused_at_once(self):
        self.assertIn("memory", self.fail_input("stats", "scenario1", "--count", "1000000000000"))


class BadOutputs(ProgramTest):
    def outputs(self, path):
        """Each command that writes, with its output at `path`."""
        numpy.save(self.path("rays.npy"), numpy.ones((2, 6), dtype=numpy.float32))
        return [
            ["render", "demo", "-o", path + ".png", "--size", "8x8"],
            ["scene", "scenario1", "-o", path + ".npy"],
            ["scene", "scenario1", "-o", path + ".json"],
            ["trace", "demo", "--rays", "rays.npy", "--t", path + ".npy", "--id", "id.npy"],
            ["trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", path + ".npy"],
            ["convert", "demo", "-o", path + ".npy"],
        ]

    def test_missing_folder(self):
        for command in self.outputs("missing/out"):
            self.assertIn("missing", self.fail_input(*command))

    def test_a_file_where_a_folder_should_be(self):
        self.write("file", "content")
        for command in self.outputs("file/out"):
            self.assertIn("file/out", self.fail_input(*command))

    def test_a_folder_where_the_file_should_be(self):
        for end in [".png", ".npy", ".json"]:
            os.mkdir(self.path("out" + end))
        for command in self.outputs("out"):
            self.assertIn("folder", self.fail_input(*command))

    def test_bad_news_comes_before_the_work(self):
        # At this size the picture would take minutes; the call must fail at once.
        self.fail_input("render", "scenario3", "-o", "missing/a.png", "--size", "20000x20000", "--samples", "16")

    def test_output_that_nobody_takes(self):
        with open("/dev/full", "w") as full:
            for command in [["stats", "demo", "--json"], ["info", "demo"], ["--help"]]:
                done = self.run_bihive(*command, stdout=full)
                self.assertEqual(done.returncode, 1, command)
                self.assertRegex(done.stderr, r"\Abihive: error: [^\n]*No space left[^\n]*\n\Z")


if __name__ == "__main__":
    main()
