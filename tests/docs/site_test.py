"""scripts/docs: every page is there, every link of the pages leads somewhere, and nothing comes from elsewhere."""

import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import urllib.parse

SOURCE = pathlib.Path(os.environ["BIHIVE_SOURCE"])
BUILD = pathlib.Path(os.environ["BIHIVE"]).parent


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.names, self.loaded = [], set(), []

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if "id" in values:
            self.names.add(values["id"])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in ("img", "script") and values.get("src"):
            self.loaded.append(values["src"])
        if tag == "link" and values.get("rel") == "stylesheet":
            self.loaded.append(values["href"])


def links_of(page):
    parser = Links()
    parser.feed(page.read_text(encoding="utf-8"))
    return parser


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="bihive_site_"))
        subprocess.run([SOURCE / "scripts/docs", BUILD, cls.folder], check=True, cwd=SOURCE, stdout=subprocess.DEVNULL)
        cls.html = cls.folder / "html"
        cls.pages = {page: links_of(page) for page in cls.html.rglob("*.html") if cls.html / "cpp" not in page.parents}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_every_page_of_docs_is_there(self):
        for page in [*(SOURCE / "docs").glob("*.md"), *(SOURCE / "docs/tutorial").glob("*.md"), SOURCE / "README.md"]:
            self.assertTrue((self.html / page.relative_to(SOURCE)).with_suffix(".html").is_file(), page)
        self.assertTrue((self.html / "cpp/index.html").is_file())
        self.assertTrue((self.html / "thesis_report.html").is_file())

    @unittest.skipUnless((BUILD / "python/bihive").is_dir(), "the Python package was not built")
    def test_every_public_name_of_python_has_a_page_with_its_arguments(self):
        pages = self.html / "docs/site/names"
        init = (BUILD / "python/bihive/__init__.py").read_text(encoding="utf-8")
        names = {"Spheres", "Tree", "render", "read", "film", "Look"}
        self.assertLessEqual(names, set(re.findall(r"\w+", init)))
        for name in names:
            text = (pages / f"{name}.html").read_text(encoding="utf-8")
            self.assertIn(f'id="bihive.{name}"', text)
        self.assertIn('id="bihive.Tree.nearest"', (pages / "Tree.html").read_text(encoding="utf-8"))
        self.assertGreater(len(list(pages.glob("*.html"))), 30)

    def test_every_function_of_c_has_a_page_with_its_declaration(self):
        header = (SOURCE / "bindings/c/bihive.h").read_text(encoding="utf-8")
        names = re.findall(r"^BIHIVE_API .*?\b(bihive_\w+)\(", header, re.M)
        self.assertGreater(len(names), 30)
        pages = self.html / "docs/site/c_names"
        listed = (pages / "index.html").read_text(encoding="utf-8")
        for name in [*names, "bihive_rays", "bihive_lists", "bihive_progress", "BIHIVE_SURFACE", "BIHIVE_CANCELLED"]:
            text = re.sub(r"<[^>]+>", "", (pages / f"{name}.html").read_text(encoding="utf-8"))
            self.assertRegex(text, rf"{name}(\(|\)|;| =)")
            self.assertIn(f'{name}.html', listed)
        nearest = re.sub(r"<[^>]+>", "", (pages / "bihive_nearest.html").read_text(encoding="utf-8"))
        self.assertIn("Missing ones: infinity and -1.", nearest)
        self.assertIn("const uint8_t* mask", nearest.replace("uint8_t *", "uint8_t* "))

    def test_every_link_leads_somewhere(self):
        self.assertGreater(len(self.pages), 60)
        checked = 0
        for page, parsed in self.pages.items():
            if page.name in ("genindex.html", "search.html", "py-modindex.html", "thesis_report.html"):
                continue
            for link in parsed.links:
                parts = urllib.parse.urlsplit(link)
                if parts.scheme or not (parts.path or parts.fragment):
                    continue
                to = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
                self.assertTrue(to.exists(), f"{page}: {link}")
                checked += 1
        self.assertGreater(checked, 1000)

    def test_nothing_comes_from_elsewhere(self):
        for page, parsed in self.pages.items():
            for source in parsed.loaded:
                self.assertEqual(urllib.parse.urlsplit(source).netloc, "", f"{page}: {source}")

    def test_without_its_programs_it_says_what_to_do(self):
        few = self.folder / "few"
        few.mkdir()
        (few / "dirname").symlink_to(shutil.which("dirname"))
        command = ["/bin/sh", SOURCE / "scripts/docs", BUILD, self.folder / "none"]
        done = subprocess.run(command, capture_output=True, text=True, env={"PATH": str(few)}, cwd=SOURCE)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertIn("scripts/setup docs", done.stderr)
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main()
