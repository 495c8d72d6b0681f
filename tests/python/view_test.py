"""bihive.view: the program serves spheres that lie in memory."""

import html
import json
import os
import re
import threading
import urllib.request
import unittest

import bihive as bh
import numpy as np
from program import ProgramTest, main


def fetched(url):
    with urllib.request.urlopen(url) as answer:
        return answer.read()


class View(ProgramTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("page"))
        self.write("page/index.html", "<!doctype html><title>page</title>")
        os.environ["BIHIVE_PAGE"] = self.path("page")
        self.addCleanup(os.environ.pop, "BIHIVE_PAGE")

    def test_spheres_from_memory(self):
        s = bh.Spheres(np.eye(3), radius=0.5, columns={"charge": [1, 2, 3]}, name="three")
        with bh.view(s, browser=False) as page:
            self.assertIn(page.url, page._repr_html_())
            start = json.loads(fetched(page.url + "start.json"))
            self.assertEqual(start, {"source": {"url": "file/three.extxyz"}})
            self.write("got.extxyz", fetched(page.url + "file/three.extxyz").decode())
            links = os.listdir(page._folder)
            self.assertEqual([os.path.islink(os.path.join(page._folder, one)) for one in links], [True], "no file in between")
        self.assertFalse(page.is_open)
        self.assertFalse(os.path.exists(page._folder))
        again = bh.read(self.path("got.extxyz"))
        self.assertTrue(np.array_equal(again.xyz, s.xyz))
        self.assertEqual(again["charge"].tolist(), [1, 2, 3])
        page.close()

    def test_a_page_with_spheres_from_memory(self):
        places = "".join(f'<script id="page_{name}" type="text/plain"></script>\n' for name in ("state", "file", "trajectory"))
        self.write("page/one_file.html", "<!doctype html>" + places)
        s = bh.Spheres(np.eye(3), radius=0.5, name="three")
        bh.save_page(s, self.path("out.html"), camera="top", floor="shadow", looks=bh.Look([0], colour="red"))
        with open(self.path("out.html"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn('data-name="three.extxyz"', text)
        with self.assertRaisesRegex(bh.UsageError, "no_such"):
            bh.save_page(s, self.path("other.html"), no_such=1)
        with self.assertRaisesRegex(bh.UsageError, "camera"):
            bh.save_page(s, self.path("other.html"), camera=bh.render(s, size=(8, 8)))
        with self.assertRaises(FileNotFoundError):
            bh.save_page(self.path("missing.xyz"), self.path("other.html"))
        self.assertFalse(os.path.exists(self.path("other.html")))

    def test_a_page_for_a_notebook(self):
        places = "".join(f'<script id="page_{name}" type="text/plain"></script>\n' for name in ("state", "file", "trajectory"))
        self.write("page/one_file.html", "<!doctype html><p>a & b</p>" + places)
        made = bh.page(bh.Spheres(np.eye(3), radius=0.5, name='th"ree'), style="studio")
        self.assertRegex(made.html, r'data-name="th(&quot;|")ree.extxyz"')
        self.assertRegex(repr(made), r'<bihive.Page: th"ree, 0.0 MB>')
        shown = made._repr_html_()
        srcdoc, *more = re.findall(r' srcdoc="([^"]*)"></iframe>$', shown)
        self.assertEqual((html.unescape(srcdoc), more), (made.html, []), "all of it, in one attribute")
        self.assertIn(' sandbox="allow-scripts allow-downloads"', shown)
        self.assertIn('title="th&quot;ree"', shown)
        with self.assertRaisesRegex(bh.UsageError, "no_such"):
            bh.page("demo", no_such=1)

    def test_files_and_built_in_names(self):
        self.write("a.csv", "x,y,z\n0,0,0\n")
        with bh.view(self.path("a.csv"), browser=False) as page:
            self.assertEqual(fetched(page.url + "file/a.csv"), b"x,y,z\n0,0,0\n")
        with bh.view("demo", browser=False) as page:
            self.assertEqual(json.loads(fetched(page.url + "start.json")), {"source": {"built_in": "demo"}})

    def test_several_threads_close_it(self):
        for name in ("a" * 5000, "three"):
            page = bh.view(bh.Spheres(np.eye(3), radius=0.5, name=name), browser=False)
            wrong = []

            def close():
                try:
                    self.assertIn(page.url, repr(page))
                    page.close()
                    self.assertFalse(page.is_open)
                except BaseException as error:
                    wrong.append(error)

            threads = [threading.Thread(target=close) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(wrong, [])
            self.assertFalse(os.path.exists(page._folder))

    @unittest.skipUnless(os.path.isdir("/proc/self/fd"), "no list of open files")
    def test_no_file_stays_open(self):
        spheres = bh.Spheres(np.eye(3), radius=0.5)
        bh.view(spheres, browser=False).close()
        before = os.listdir("/proc/self/fd")
        for _ in range(3):
            bh.view(spheres, browser=False).close()
        os.environ["BIHIVE_PAGE"] = self.path("nowhere")
        errors = []
        for _ in range(3):
            try:
                bh.view(spheres, browser=False)
            except bh.Error as error:
                errors.append(error)  # what an interpreter keeps of an exception must hold no pipe
        self.assertEqual(len(errors), 3)
        self.assertEqual(len(os.listdir("/proc/self/fd")), len(before))

    def test_what_is_wrong(self):
        with self.assertRaisesRegex(OSError, "missing.pdb"):
            bh.view(self.path("missing.pdb"))
        with self.assertRaisesRegex(bh.UsageError, "port"):
            bh.view("demo", port=70000)
        os.environ["BIHIVE_PAGE"] = self.path("nowhere")
        with self.assertRaises(bh.Error):
            bh.view("demo", browser=False)


if __name__ == "__main__":
    main()
