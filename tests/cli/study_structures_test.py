"""scripts/study_structures: a page with a figure for each question, made of small sets, and what it refuses."""

import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

from program import ProgramTest, main

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parents[2]))


class Study(ProgramTest):
    def study(self, *words):
        command = [sys.executable, str(SOURCE / "scripts/study_structures"), "--program", os.environ["BIHIVE"], *words]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def test_page_and_figures(self):
        self.write("own.csv", "x,y,z,r\n" + "".join(f"{i % 7},{i % 5},{i},{0.3}\n" for i in range(150)))
        folder = pathlib.Path(self.path("docs"))
        done = self.study(self.path("own.csv"), "--docs", str(folder), "--sets", "duplicates,giant,own", "--spheres", "160", "--rays-count", "128")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (folder / "structures_study.md").read_text()
        for name in ("duplicates", "giant", "own"):
            self.assertIn(f"| {name} |", page)
        sections = page.split("\n## ")[1:]
        self.assertEqual(len(sections), 8)
        for section in sections:
            self.assertTrue(section.splitlines()[0].endswith("?"), section)
            self.assertIn("*What would overturn it:*", section)
            figure = re.search(r"\]\((structures_study/\w+\.svg)\)", section).group(1)
            xml.etree.ElementTree.parse(folder / figure)

    def test_refusals(self):
        done = self.study("--sets", "duplicates,nothing")
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no set nothing; there are demo, scenario2", done.stderr)


if __name__ == "__main__":
    main()
