"""`bihive select`: counts, ids, and messages that show the place."""

import os
import re
import subprocess

from program import BIHIVE, PATIENCE_S, ProgramTest, main


class Select(ProgramTest):
    def fail_selection(self, *arguments):
        """Demands exit code 2 and three lines on stderr: the error, the expression, a caret. Returns them."""
        done = self.run_bihive(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""), (arguments, done.stderr))
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 3, done.stderr)
        self.assertTrue(lines[0].startswith("bihive: error: "), lines)
        self.assertRegex(lines[2], r"\A +\^\Z")
        return lines

    def test_count_and_ids(self):
        self.write("a.csv", "x,y,z,r,charge\n0,0,0,1,-1\n1,0,0,1,-1\n2,0,0,1,1\n3,0,0,1,-2\n")
        self.assertEqual(self.succeed("select", "a.csv", "charge < 0"), "a.csv: 3 of 4 spheres\nindex 0..1 3\n")
        self.assertEqual(self.succeed("select", "a.csv", "none"), "a.csv: 0 of 4 spheres\nnone\n")
        found = self.succeed_json("select", "a.csv", "charge < 0")
        self.assertEqual((found["selected"], found["spheres"], found["ids"]), (3, 4, [0, 1, 3]))
        self.assertEqual(found["expression"], "charge < 0")

    def test_the_printed_ids_are_a_selection(self):
        text = self.succeed("select", "demo", "within 4 of resname 478 and not hetero").splitlines()[1]
        again = self.succeed("select", "demo", text).splitlines()[1]
        self.assertEqual(text, again)

    def test_reading_options_move_what_is_compared(self):
        self.write("a.csv", "x,y,z,r\n10,0,0,1\n20,0,0,2\n")
        self.assertEqual(self.succeed_json("select", "a.csv", "x < 0")["ids"], [])
        self.assertEqual(self.succeed_json("select", "a.csv", "x < 0", "--recenter")["ids"], [0])
        self.assertEqual(self.succeed_json("select", "a.csv", "r > 3", "--radius-scale", "2")["ids"], [1])

    def test_a_scenario(self):
        self.assertEqual(self.succeed_json("select", "scenario2", "index 3..5", "--count", "64")["ids"], [3, 4, 5])

    def test_errors_show_the_place(self):
        self.write("a.csv", "x,y,z,r,charge\n0,0,0,1,-1\n")
        error, line, caret = self.fail_selection("select", "a.csv", "x > 0 and chrage < 0")
        self.assertIn("EXPRESSION: column 11: there is no attribute 'chrage'; did you mean 'charge'?", error)
        self.assertEqual(line, "  x > 0 and chrage < 0")
        self.assertEqual(caret, "            ^")
        error, _, caret = self.fail_selection("select", "a.csv", "x >")
        self.assertIn("column 4: expected a number or the name of a number, found the end", error)
        self.assertEqual(caret, "     ^")
        self.fail_selection("select", "demo", "chain A resname 478")

    def test_a_missing_expression_is_bad_usage(self):
        self.assertIn("EXPRESSION", self.fail_usage("select", "demo"))
        self.fail_input("select", "nope.pdb", "all")

    def test_the_examples_of_the_documentation(self):
        """Each line `EXPRESSION` of the table of examples of docs/selections.md, with the number that stands beside it."""
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "docs", "selections.md"), encoding="utf-8") as file:
            examples = re.findall(r"^\| `([^`]+)` \| ([0-9]+) \|", file.read().replace("\\|", "|"), re.MULTILINE)
        self.assertGreater(len(examples), 10)
        for expression, count in examples:
            self.assertEqual(self.succeed_json("select", "demo", expression)["selected"], int(count), expression)

    def test_the_commands_of_the_documentation(self):
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "docs", "selections.md"), encoding="utf-8") as file:
            blocks = re.findall(r"^```sh\n(.*?)^```", file.read(), re.MULTILINE | re.DOTALL)
        self.assertTrue(blocks)
        os.symlink(os.path.join(os.environ["BIHIVE_SOURCE"], "data"), self.path("data"))
        os.mkdir(self.path("build"))
        os.symlink(BIHIVE, self.path("build/bihive"))
        for block in blocks:
            done = subprocess.run(["bash", "-e", "-c", block], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual((done.returncode, done.stderr), (0, ""), block)

    def test_distances_see_the_images_of_a_cell(self):
        self.write(
            "box.xyz",
            '3\nLattice="10 0 0 0 10 0 0 0 10" Properties=species:S:1:pos:R:3\n'
            "O 9.8 5 5\nH 0.4 5.5 5\nH 5 5 5\n",
        )
        near = "within 1.5 of index 0"
        self.assertEqual(self.succeed("select", "box.xyz", near), "box.xyz: 2 of 3 spheres, periodic cell\nindex 0..1\n")
        self.assertEqual(self.succeed("select", "box.xyz", near, "--no-periodic"), "box.xyz: 1 of 3 spheres\nindex 0\n")
        self.assertEqual(self.succeed("select", "box.xyz", "x > 9"), "box.xyz: 1 of 3 spheres\nindex 0\n")
        self.assertTrue(self.succeed_json("select", "box.xyz", near, "--periodic")["periodic"])
        self.assertIn("excludes", self.fail_usage("select", "box.xyz", near, "--periodic", "--no-periodic"))


if __name__ == "__main__":
    main()
