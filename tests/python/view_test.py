"""bihive.view: the program serves spheres that lie in memory."""

import base64
import gzip
import html
import importlib.util
import json
import os
import pickle
import re
import sys
import threading
import types
import urllib.request
import unittest

import bihive as bh
import numpy as np
from program import ProgramTest, main

try:
    import traitlets
except ImportError:  # it comes with Jupyter
    traitlets = None


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

    def test_a_set_and_a_picture_as_html(self):
        places = "".join(f'<script id="page_{name}" type="text/plain"></script>\n' for name in ("state", "file", "trajectory"))
        self.write("page/one_file.html", "<!doctype html>" + places)

        def held(text, place):
            name, packing, content = re.search(rf'<script id="page_{place}" type="text/plain" data-name="([^"]*)"( data-packing="gzip")?>([^<]*)<', text).groups()
            content = base64.b64decode(content)
            return name, gzip.decompress(content) if packing else content

        s = bh.Spheres(np.eye(3), radius=0.5, name="three", columns={"charge": [1, 2, 3]})
        text = s.to_html(style="studio", floor="shadow")
        name, file = held(text, "file")
        self.assertEqual((name, file.splitlines()[0]), ("three.extxyz", b"3"))
        self.assertEqual(json.loads(held(text, "state")[1])["look"]["style"], "studio")
        # A picture: what it was drawn of, without what pictures alone have.
        picture = bh.render(s, camera="top", style="illustrative", looks=bh.Look("charge > 1", colour="red"), size=(40, 30), samples=1, shadows=False, threads=1)
        state = json.loads(held(picture.to_html(), "state")[1])
        self.assertEqual(state["look"]["style"], "illustrative")
        self.assertEqual(state["look"]["rows"], [{"select": "charge > 1", "action": "colour", "value": "red"}])
        self.assertEqual((state["settings"]["shadows"], state["settings"].get("samples_per_pixel")), (False, None))
        self.write("a.csv", "x,y,z,r\n0,0,0,1\n")
        self.assertEqual(held(bh.render(self.path("a.csv"), size=(8, 8)).to_html(), "file"), ("a.csv", b"x,y,z,r\n0,0,0,1\n"))
        like_it = bh.render(s, camera=picture, size=(8, 8))
        for without in (pickle.loads(pickle.dumps(picture)), like_it, picture.detach()):
            with self.assertRaisesRegex(bh.UsageError, "keeps no scene"):
                without.to_html()
        with self.assertRaisesRegex(bh.UsageError, "style"):
            bh.render(s, style={"bihive_style": 1}, size=(8, 8)).to_html()
        # A title comes along.
        self.write("b.xyz", "1\ntwo words\nC 0 0 0\n")
        self.assertIn(b'title="two words"', held(bh.read(self.path("b.xyz")).to_html(), "file")[1])
        os.environ["BIHIVE_PAGE"] = self.path("nowhere")
        with self.assertRaisesRegex(bh.MissingError, "make web"):
            s.to_html()

    def test_a_set_shows_itself_in_a_notebook(self):
        s = bh.Spheres(np.eye(3), radius=0.5)
        self.assertEqual(s._repr_png_(), bh.render(s, size=(480, 270))._repr_png_())
        self.assertIsNone(bh.Spheres(np.zeros((0, 3)), radius=1)._repr_png_())
        self.assertIsNone(bh.Spheres(np.zeros((200001, 3)), radius=1)._repr_png_(), "would take too long")

    def test_a_view_in_a_notebook(self):
        s = bh.Spheres(np.eye(3), radius=0.5, name="three")
        with bh.view(s, browser=False) as page:
            self.assertNotIn("<iframe", page._repr_html_(), "there is no page of one file")
        places = "".join(f'<script id="page_{name}" type="text/plain"></script>\n' for name in ("state", "file", "trajectory"))
        self.write("page/one_file.html", "<!doctype html><p>of one file</p>" + places)
        with bh.view(s, browser=False) as page:
            self.assertRegex(page._repr_html_(), r'(?s)^<iframe title="three".*of one file.*three.extxyz.*</iframe><a href="http://127')
        self.assertEqual(page._repr_html_(), "closed")

    @unittest.skipIf(traitlets is None, "traitlets is not installed")
    def test_a_widget(self):
        places = "".join(f'<script id="page_{name}" type="text/plain"></script>\n' for name in ("state", "file", "trajectory"))
        self.write("page/one_file.html", "<!doctype html>" + places)
        s = bh.Spheres(np.eye(3), radius=0.5, name="three")
        if importlib.util.find_spec("anywidget") is None:
            made = bh.widget(s, height=300, style="studio")
            self.assertIsInstance(made, bh.Page)
            self.assertIn("height: 300px", made._repr_html_())
            # In place of the package, which Debian has not: its class with the traits that it shares.
            stand_in = types.ModuleType("anywidget")
            stand_in.AnyWidget = type("AnyWidget", (traitlets.HasTraits,), {})
            sys.modules["anywidget"] = stand_in
            self.addCleanup(sys.modules.pop, "anywidget")
        made = bh.widget(s, height=300, style="studio")
        self.assertEqual((made.name, made.height, made.camera, made.pins, made.picked), ("three", 300, {}, [], None))
        self.assertIn(b'data-name="three.extxyz"', made.page)
        self.assertIn("export default { render }", made._esm)
        self.assertEqual(set(made.traits(sync=True)) & {"page", "name", "height", "camera", "pins", "picked"}, {"page", "name", "height", "camera", "pins", "picked"})
        heard = []
        made.observe(heard.append, "pins")
        made.pins = [2]
        self.assertEqual(heard[0]["new"], [2])
        for height in (0, 1.5, "tall", 10001):
            with self.assertRaisesRegex(bh.UsageError, "height"):
                bh.widget(s, height=height)

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
