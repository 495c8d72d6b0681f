"""bihive info --distance, --angle, --dihedral: against numbers worked out here."""

import csv
import io
import json
import math
import os

from program import ProgramTest, main

# Hydrogen peroxide, dihedral 90 degrees, in two frames; in the second one H3 lies in the next cell.
FRAMES = """4
Lattice="10 0 0 0 10 0 0 0 10" Properties=species:S:1:pos:R:3 Time=0.5
H 1 0 0
O 0 0 0
O 0 0 1.5
H 0 1 1.5
4
Lattice="10 0 0 0 10 0 0 0 10" Properties=species:S:1:pos:R:3 Time=1.5
H 1 0 0
O 0 0 0
O 0 0 1.5
H 0 -9 1.5
"""


class MeasuresTest(ProgramTest):
    def rows(self, *arguments):
        return list(csv.reader(io.StringIO(self.succeed("info", *arguments))))

    def test_all_frames_as_csv(self):
        self.write("a.xyz", FRAMES)
        rows = self.rows("a.xyz", "--distance", "1,2", "--distance", "2,3", "--angle", "0,1,2", "--dihedral", "0,1,2,3")
        self.assertEqual(rows[0], ["frame", "time_ps", "step", "distance_1_2", "distance_2_3", "angle_0_1_2", "dihedral_0_1_2_3"])
        self.assertEqual(rows[1], ["0", "0.5", "", "1.5", "1", "90", "90"])
        self.assertEqual(rows[2], ["1", "1.5", "", "1.5", "1", "90", "90"])

    def test_without_images(self):
        self.write("a.xyz", FRAMES)
        rows = self.rows("a.xyz", "--distance", "2,3", "--dihedral", "0,1,2,3", "--no-periodic")
        self.assertEqual([row[3:] for row in rows[1:]], [["1", "90"], ["9", "-90"]])

    def test_one_frame_and_json(self):
        self.write("a.xyz", FRAMES)
        self.assertEqual(self.rows("a.xyz", "--distance", "0,1", "--frame", "-1")[1:], [["1", "1.5", "", "1"]])
        self.assertEqual(
            json.loads(self.succeed("info", "a.xyz", "--angle", "0,1,0", "--frame", "0", "--json"))["frames"],
            [{"frame": 0, "time_ps": 0.5, "step": None, "angle_0_1_0": 0}],
        )

    def test_the_bundled_molecule(self):
        # The second and the third atom of the file, by its own columns.
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "data/1hpv.pdb"), encoding="ascii") as file:
            atoms = [line for line in file if line.startswith(("ATOM", "HETATM"))]
        at = [[float(line[k : k + 8]) for k in (30, 38, 46)] for line in atoms[:3]]
        (row,) = self.rows("demo", "--distance", "1,2", "--no-periodic")[1:]
        self.assertAlmostEqual(float(row[3]), math.dist(at[1], at[2]), delta=1e-5)

    def test_a_line_has_no_dihedral(self):
        self.write("a.xyz", "4\n\nC 0 0 0\nC 1 0 0\nC 2 0 0\nC 3 1 0\n")
        self.assertEqual(self.rows("a.xyz", "--dihedral", "0,1,2,3")[1][3], "nan")
        self.assertIsNone(json.loads(self.succeed("info", "a.xyz", "--dihedral", "0,1,2,3", "--json"))["frames"][0]["dihedral_0_1_2_3"])

    def test_wrong_use(self):
        self.write("a.xyz", FRAMES)
        for bad in ["1", "1,2,3", "1,x", "1,-2", "", "1.5,2", "1,2,"]:
            self.assertIn("expected 2 positions of spheres", self.fail_usage("info", "a.xyz", "--distance", bad))
        self.assertIn("there is no sphere 4", self.fail_input("info", "a.xyz", "--angle", "0,1,4"))
        for other in ("--frames", "--attributes", "--trees"):
            self.fail_usage("info", "a.xyz", "--distance", "0,1", other)
        self.fail_usage("info", "a.xyz", "--distance", "0,1", "--replicate", "2x1x1")


if __name__ == "__main__":
    main()
