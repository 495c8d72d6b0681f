"""The notebooks of docs/notebooks run from top to bottom, and show what they say."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["BIHIVE_SOURCE"])


class Notebooks(unittest.TestCase):
    def run_notebook(self, path):
        """The cells with what they gave."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="bihive_notebook_"))
        self.addCleanup(shutil.rmtree, folder)
        environment = {**os.environ, "JUPYTER_RUNTIME_DIR": str(folder), "IPYTHONDIR": str(folder)}
        command = ["/usr/bin/jupyter-nbconvert", "--to", "notebook", "--execute", "--output-dir", folder, path]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((folder / path.name).read_text())["cells"]

    def test_spheres(self):
        cells = self.run_notebook(SOURCE / "docs/notebooks/spheres.ipynb")
        outputs = [output for cell in cells for output in cell.get("outputs", [])]
        self.assertEqual([one for one in outputs if one["output_type"] == "error"], [])
        pictures = [one for one in outputs if "image/png" in one.get("data", {})]
        self.assertEqual(len(pictures), 4, "pictures show themselves, and so does a set of spheres")
        words = json.dumps(outputs)
        self.assertIn("1631 spheres from demo (PDB)", words)
        self.assertIn("35 atoms of the drug, 100 around it", words)

    def test_every_notebook_is_kept_without_output(self):
        for path in (SOURCE / "docs/notebooks").glob("*.ipynb"):
            for cell in json.loads(path.read_text())["cells"]:
                self.assertFalse(cell.get("outputs"), path)


if __name__ == "__main__":
    unittest.main(verbosity=2)
