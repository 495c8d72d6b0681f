"""The version stands in CMakeLists.txt, from which programs and packages have it; the other texts that name it agree."""

import json
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))


def text(name):
    return (SOURCE / name).read_text(encoding="utf-8")


class Version(unittest.TestCase):
    version = re.search(r"^project\(bihive VERSION (\d+\.\d+\.\d+) ", text("CMakeLists.txt"), re.M).group(1)
    minor = version.rpartition(".")[0]

    def test_metadata(self):
        self.assertEqual(re.search(r"^version: (.*)$", text("CITATION.cff"), re.M).group(1), self.version)
        self.assertEqual(json.loads(text("web/viewer/package.json"))["version"], self.version)

    def test_pages_that_name_it(self):
        for page, pattern, expected, times in [
            ("docs/library.md", r"find_package\(bihive ([\d.]+)", self.minor, 3),
            ("docs/packages.md", r"bihive[_-](\d+\.\d+\.\d+)", self.version, 3),
            ("docs/web.md", r"bihive-viewer-(\d+\.\d+\.\d+)\.tgz", self.version, 2),
        ]:
            self.assertEqual(re.findall(pattern, text(page)), [expected] * times, page)

    def test_the_changelog_begins_with_what_is_unreleased_and_this_version(self):
        titles = re.findall(r"^## (.*)$", text("CHANGELOG.md"), re.M)
        self.assertEqual(titles[0], "Unreleased")
        self.assertRegex(titles[1], rf"\A{re.escape(self.version)} \(\d{{4}}-\d\d-\d\d\)\Z")


if __name__ == "__main__":
    unittest.main()
