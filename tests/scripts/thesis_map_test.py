"""docs/thesis_map.md is as the lists of claims make it, and names tests and experiments that exist."""

import glob
import json
import os
import re
import subprocess
import sys
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
        cls.entries = []
        for path in glob.glob(os.path.join(SOURCE, "thesis/*/values.json")):
            with open(path, encoding="utf-8") as file:
                document = json.load(file)
            cls.entries += [*document["values"].values(), *document.get("remarks", [])]

    def test_the_page_is_written_from_the_claims(self):
        script = [sys.executable, os.path.join(SOURCE, "scripts/thesis_map"), "--check"]
        done = subprocess.run(script, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_every_test_that_is_named_exists(self):
        declared = set(re.findall(r"^TEST(?:_P|_F)?\((\w+), (\w+)\)", text_of("tests/**/*_test.cpp"), re.MULTILINE))
        named = [test for entry in self.entries for test in entry.get("held_by", [])]
        for test in named:
            suite, name = test.split(".")
            if suite.endswith("_test"):
                self.assertTrue(f"def {name}(" in text_of(f"tests/cli/{suite}.py"), test)
            else:
                self.assertIn((suite, name), declared)
        self.assertGreater(len(named), 50)

    def test_every_claim_has_the_words_of_the_text(self):
        claims = {entry["claim"] for entry in self.entries if "claim" in entry}
        self.assertGreater(len(claims), 60)
        for entry in self.entries:
            self.assertGreater(len(entry["sentence"]), 20, entry)

    def test_every_experiment_has_values_and_a_template(self):
        table = text_of("src/bihive/thesis/experiments.h")
        named = set(re.findall(r'^  row\(\w+, "([^"]+)"', table, re.MULTILINE))
        self.assertEqual(len(named), 7)
        folders = lambda file: {os.path.basename(os.path.dirname(path)) for path in glob.glob(f"{SOURCE}/thesis/*/{file}")}
        self.assertEqual(folders("values.json"), named)
        self.assertEqual(folders("report.html"), named | {"report"})


if __name__ == "__main__":
    unittest.main()
