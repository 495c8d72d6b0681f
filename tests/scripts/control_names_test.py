"""The labels in messages of the page (bindings/wasm/control_names.cpp) are those of its controls."""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["BIHIVE_SOURCE"])


class ControlNames(unittest.TestCase):
    def test_every_label_is_one_of_the_page(self):
        code = (SOURCE / "bindings/wasm/control_names.cpp").read_text(encoding="utf-8")
        labels = re.findall(r'Control\{"\w+", "([^"]+)"\}', code)
        self.assertGreater(len(labels), 15)
        page = (SOURCE / "web/index.html").read_text(encoding="utf-8")
        shown = set(re.findall(r">([^<>]+)<", page)) | set(re.findall(r'aria-label="([^"]+)"', page))
        # The rest of the controls is made from the table of parameters, whose labels begin with a small letter.
        table = (SOURCE / "src/bihive/settings/picture_parameters.cpp").read_text(encoding="utf-8")
        shown |= {label.capitalize() for label in re.findall(r'\.label = "([^"]+)"', table)}
        self.assertEqual(set(labels) - shown, set())


if __name__ == "__main__":
    unittest.main()
