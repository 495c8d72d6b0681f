"""--assembly of the commands that read files."""

import json

from program import ProgramTest, main

ROWS = ["1.000000  0.000000  0.000000", "0.000000  1.000000  0.000000", "0.000000  0.000000  1.000000"]


def operator(number, shift):
    return "".join(f"REMARK 350   BIOMT{row + 1}   {number}  {ROWS[row]}     {shift[row]:10.5f}\n" for row in range(3))


PDB = ("REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n" + operator(1, (0, 0, 0)) + operator(2, (6, 0, 0))
       + "REMARK 350 BIOMOLECULE: 2\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: B\n" + operator(1, (0, 0, 0))
       + "ATOM      1  N   ALA A   1       1.000   2.000   3.000  1.00 20.25           N\n"
       + "ATOM      2  C   ALA B   1       2.000   2.000   3.000  1.00 21.25           C\n")


class Assembly(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.pdb", PDB)

    def test_info_lists_the_assemblies_of_a_file(self):
        self.assertIn("assemblies        1, 2\n", self.succeed("info", "a.pdb"))
        self.assertEqual(self.succeed_json("info", "a.pdb")["assemblies"], ["1", "2"])
        self.assertEqual(self.succeed_json("info", "demo")["assemblies"], [])

    def test_all_commands_take_the_same_spheres(self):
        info = self.succeed_json("info", "a.pdb", "--assembly", "1")
        self.assertEqual(info["spheres"], 2)
        for place, expected in [("lo", 1 - 1.55), ("hi", 7 + 1.55)]:
            self.assertAlmostEqual(info["bounds"][place][0], expected, places=5)
        selected = self.succeed_json("select", "a.pdb", "chain A and copy = 2", "--assembly", "1")
        self.assertEqual(selected["ids"], [1])
        self.assertEqual(self.succeed_json("stats", "a.pdb", "--assembly", "1")["spheres"], 2)
        picture = self.succeed_json("render", "a.pdb", "-o", "a.png", "--size", "32x32", "--assembly", "1")
        self.assertEqual(picture["settings"]["assembly"], "1")
        self.assertEqual(picture["spheres"], 2)

    def test_a_scene_file_asks_for_one_and_the_option_goes_first(self):
        self.write("s.json", json.dumps({"bihive_scene": 2, "spheres": {"file": "a.pdb", "assembly": "1"}}))
        self.assertEqual(self.succeed_json("info", "s.json")["spheres"], 2)
        self.assertEqual(self.succeed_json("info", "s.json", "--assembly", "2")["spheres"], 1)
        self.write("old.json", json.dumps({"bihive_scene": 1, "spheres": {"file": "a.pdb", "assembly": "1"}}))
        self.assertIn("/spheres/assembly", self.fail_input("info", "old.json"))
        self.write("inline.json", json.dumps({"bihive_scene": 2, "spheres": [[0, 0, 0, 1]]}))
        self.assertIn("assembly", self.fail_input("info", "inline.json", "--assembly", "1"))

    def test_faults(self):
        self.assertIn("there are 1, 2", self.fail_input("info", "a.pdb", "--assembly", "3"))
        self.assertIn("no assemblies", self.fail_input("info", "demo", "--assembly", "1"))
        self.assertIn("--assembly", self.fail_usage("info", "scenario1", "--assembly", "1"))
        self.assertIn("--assembly", self.fail_usage("info", "a.pdb", "--assembly", ""))


if __name__ == "__main__":
    main()
