"""docs/thesis_map.md names tests, experiments and values that exist."""

import glob
import os
import re
import unittest

SOURCE = os.environ["BIHIVE_SOURCE"]


def text_of(pattern):
    texts = []
    for path in sorted(glob.glob(os.path.join(SOURCE, pattern), recursive=True)):
        with open(path, encoding="utf-8") as file:
            texts.append(file.read())
    return "\n".join(texts)


class ThesisMap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.map = text_of("docs/thesis_map.md")
        cls.cells = [
            [cell.strip() for cell in line.strip("|").split("|")]
            for line in cls.map.splitlines()
            if line.startswith("| ")
        ]

    def test_every_test_that_is_named_exists(self):
        declared = set(re.findall(r"^TEST(?:_P|_F)?\((\w+), (\w+)\)", text_of("tests/**/*_test.cpp"), re.MULTILINE))
        named = 0
        for suite, name in re.findall(r"`(\w+)\.(\w+)`", " ".join(row[-1] for row in self.cells)):
            if suite.endswith("_test"):
                self.assertIn(f"def {name}(", text_of(f"tests/cli/{suite}.py"), suite)
            else:
                self.assertIn((suite, name), declared)
            named += 1
        self.assertGreater(named, 50)
        for suite in re.findall(r"`(\w+_test)`", self.map):
            self.assertTrue(os.path.exists(os.path.join(SOURCE, "tests", "cli", suite + ".py")), suite)

    def test_every_experiment_is_named_and_exists(self):
        folders = {os.path.basename(os.path.dirname(path)) for path in glob.glob(f"{SOURCE}/thesis/*/values.json")}
        self.assertEqual(len(folders), 7)
        self.assertEqual(set(re.findall(r"`bihive thesis ([a-z]+-[a-z0-9.]+)", self.map)), folders)

    def test_every_statement_has_a_command_or_says_why_not(self):
        statements = [row for row in self.cells if len(row) == 3 and row[0] != "The text says"]
        self.assertGreater(len(statements), 60)
        for row in statements:
            self.assertTrue(all(row), row)

    def test_the_sections_in_the_list_are_there(self):
        headings = {
            re.sub(r"[^a-z0-9 -]", "", heading.lower()).replace(" ", "-")
            for heading in re.findall(r"^## (.+)$", self.map, re.MULTILINE)
        }
        self.assertEqual(set(re.findall(r"\(#([^)]+)\)", self.map)), headings)


if __name__ == "__main__":
    unittest.main()
