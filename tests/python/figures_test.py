"""Figures drawn again and compared: verify() and again() give what the program gives."""

import json
import os
import subprocess
import tempfile
import unittest

import bihive as bh
import numpy as np

SMALL = {"size": (64, 48), "samples": 1}
ATOMS = "2\n\nC 0 0 0\nO 1.2 0 0\n"


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        with open(self.path("two.xyz"), "w") as file:
            file.write(ATOMS)
        bh.render(self.path("two.xyz"), view_from="left", **SMALL).save(self.path("two.png"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_a_figure_holds(self):
        verdict = bh.verify(self.path("two.png"), progress=False)
        self.assertTrue(verdict)
        self.assertEqual((verdict.verified, verdict.error, verdict.changed_files, verdict.pixels_differ), (True, None, (), 0))
        self.assertTrue(verdict.sentence.endswith("two.png: the same bits"))
        self.assertIn(bh.__version__, verdict.drawn_by)

    def test_as_the_program_says_it(self):
        done = subprocess.run([os.environ["BIHIVE"], "verify", self.path("two.png"), "--json"], capture_output=True, text=True)
        (theirs,) = json.loads(done.stdout)["figures"]
        ours = bh.verify(self.path("two.png"))
        for name, value in theirs.items():
            expected = tuple(value) if isinstance(value, list) else value
            self.assertEqual(getattr(ours, name), expected, name)

    def test_another_input(self):
        with open(self.path("other.xyz"), "w") as file:
            file.write(ATOMS.replace("O 1.2", "S 1.2"))
        verdict = bh.verify(self.path("two.png"), self.path("other.xyz"), difference=self.path("difference.png"))
        self.assertFalse(verdict)
        self.assertEqual(verdict.changed_files, ("input",))
        self.assertGreater(verdict.pixels_differ, 0)
        self.assertEqual(len(verdict.first_difference), 2)
        self.assertTrue(os.path.exists(self.path("difference.png")))
        self.assertEqual(bh.again(self.path("two.png"), self.path("other.xyz")), bh.render(self.path("other.xyz"), view_from="left", **SMALL))

    def test_other_files_than_png(self):
        for style in ("default", "glossy"):
            picture = bh.render("demo", style=style, **SMALL)
            for ending in ("tif", "exr"):
                path = self.path("figure." + ending)
                try:
                    picture.save(path)
                except bh.MissingError:
                    continue
                self.assertEqual(bh.verify(path).sentence, f"{path}: the same bits")
                # The program says the same of it.
                subprocess.run([os.environ["BIHIVE"], "verify", path], check=True, capture_output=True)

    def test_a_saved_request(self):
        path = self.path("scene.json")
        subprocess.run([os.environ["BIHIVE"], "scene", "save", path, "demo", "--size", "64x48", "--samples", "1", "--fit", "resname 478"], check=True,
                       capture_output=True)
        self.assertEqual(bh.render(path), bh.render("demo", fit="resname 478", **SMALL))
        self.assertEqual(bh.render(path, size=(32, 24)).size, (32, 24))

    def test_what_cannot_be_drawn(self):
        os.remove(self.path("two.xyz"))
        verdict = bh.verify(self.path("two.png"))
        self.assertFalse(verdict)
        self.assertIn("two.xyz", verdict.error)
        bh.render("demo", **SMALL).save(self.path("bare.png"), metadata=False)
        self.assertRegex(bh.verify(self.path("bare.png")).error, "does not say how it was drawn")
        with self.assertRaises(bh.FileError):
            bh.verify(self.path("none.png"))
        with self.assertRaisesRegex(bh.InputError, "does not say how it was drawn"):
            bh.again(self.path("bare.png"))

    def test_changes(self):
        again = bh.again(self.path("two.png"))
        self.assertEqual(again, bh.render(self.path("two.xyz"), view_from="left", **SMALL))
        changed = bh.again(self.path("two.png"), size=(32, 24), camera="top", looks=bh.Look("element O", colour="red"))
        self.assertEqual(
            changed, bh.render(self.path("two.xyz"), view_from="top", size=(32, 24), samples=1, looks=bh.Look("element O", colour="red"))
        )
        self.assertFalse(np.array_equal(np.asarray(changed), np.asarray(again)))
        changed.save(self.path("changed.png"))
        self.assertTrue(bh.verify(self.path("changed.png")))

    def test_words_for_a_methods_section(self):
        again = bh.again(self.path("two.png"), style="illustrative")
        self.assertRegex(
            again.methods,
            r"bihive 0\.\d+\.\d+(, commit \w+(-dirty)?)? \[bihive\]: 2 spheres of two\.xyz \(SHA-256 [0-9a-f]{64}\), style illustrative, "
            r"perspective projection of 30 degrees, 64 x 48 pixels of 1 sample, fog, outlines\.",
        )
        self.assertIn("@misc{bihive,", again.methods)
        self.assertIn(": 2 spheres, perspective", bh.render(bh.Spheres([[0, 0, 0], [1, 0, 0]], radius=1), **SMALL).methods)

    def test_wrong_use(self):
        with self.assertRaisesRegex(bh.UsageError, "difference: is written as PNG"):
            bh.verify(self.path("two.png"), difference="a.jpg")
        with self.assertRaisesRegex(bh.UsageError, "difference: is the figure or its input"):
            bh.verify(self.path("two.png"), difference=self.path("two.png"))
        with self.assertRaisesRegex(bh.UsageError, "style: expected the name or the path"):
            bh.again(self.path("two.png"), style={})
        with self.assertRaisesRegex(bh.UsageError, "camera"):
            bh.again(self.path("two.png"), camera=bh.again(self.path("two.png")))
        with self.assertRaisesRegex(bh.UsageError, "sampels"):
            bh.again(self.path("two.png"), sampels=4)


if __name__ == "__main__":
    unittest.main()
