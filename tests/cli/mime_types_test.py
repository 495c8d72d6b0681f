"""Types of files: of the desktop (data/desktop) and of the installed page (web/public/bihive.webmanifest)."""

import configparser
import json
import os
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree

from program import PATIENCE_S, ProgramTest, main

SOURCE = pathlib.Path(os.environ["BIHIVE_SOURCE"])
DATA = SOURCE / "data/desktop"
# RFC 6838, 4.2.
TYPE = re.compile(r"[a-z-]+/[A-Za-z0-9][A-Za-z0-9!#$&^_.+-]{0,126}")
# Browsers take the registered top-level types alone, and those that begin with x-. "chemical" is not one of them.
OF_BROWSERS = {"application", "audio", "example", "font", "image", "message", "model", "multipart", "text", "video"}


class MimeTypes(ProgramTest):
    def known_endings(self):
        """What the program says that it reads."""
        self.write("a.unknown", "hello\n")
        said = self.run_bihive("info", "a.unknown").stderr
        return set(re.findall(r"\.[a-z0-9]+", said.split("known are", 1)[1]))

    def of_desktop(self):
        """Type: endings."""
        space = "{http://www.freedesktop.org/standards/shared-mime-info}"
        top = xml.etree.ElementTree.parse(DATA / "bihive-types.xml").getroot()
        self.assertEqual(top.tag, space + "mime-info")
        found = {}
        for one in top:
            self.assertEqual(one.tag, space + "mime-type")
            found[one.get("type")] = [glob.get("pattern") for glob in one.findall(space + "glob")]
            self.assertTrue(one.findtext(space + "comment"))
        return found

    def test_types_of_the_desktop(self):
        types = self.of_desktop()
        patterns = [pattern for some in types.values() for pattern in some]
        self.assertEqual(len(patterns), len(set(patterns)))
        known = self.known_endings()
        for name, some in types.items():
            self.assertRegex(name, TYPE)
            self.assertTrue(some, name)
            for pattern in some:
                self.assertRegex(pattern, r"\A\*\.[a-z0-9]+\Z")
        self.assertLessEqual({pattern[1:] for pattern in patterns}, known)
        entry = configparser.ConfigParser(interpolation=None)
        entry.optionxform = str
        entry.read(DATA / "bihive.desktop")
        named = entry["Desktop Entry"]["MimeType"]
        self.assertTrue(named.endswith(";"))
        self.assertEqual(named.rstrip(";").split(";"), list(types))
        if shutil.which("desktop-file-validate"):
            done = subprocess.run(["desktop-file-validate", DATA / "bihive.desktop"], capture_output=True, text=True, timeout=PATIENCE_S)
            self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_types_of_the_installed_page(self):
        manifest = json.loads((SOURCE / "web/public/bihive.webmanifest").read_text())
        known = self.known_endings()
        for handler in manifest["file_handlers"]:
            for name, endings in handler["accept"].items():
                self.assertRegex(name, TYPE)
                top = name.split("/")[0]
                self.assertTrue(top in OF_BROWSERS or top.startswith("x-"), name)
                self.assertLessEqual(set(endings), known)


if __name__ == "__main__":
    main()
