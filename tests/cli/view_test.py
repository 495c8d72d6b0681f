"""bihive view: the window on a screen of its own (Xvfb), its content, and the effect of keys and pointer (xdotool)."""

# ctest: COST 700

import json
import os
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from program import BIHIVE, PATIENCE_S, ProgramTest, main, png_pixels, png_size, png_text
from screen import Screen

HAS_WINDOW = "BIHIVE_VIEW" in os.environ
CARD_PX, MARGIN_PX, CARD_TOP_PX = 348, 12, 58
CARD_COLOUR = (27, 29, 33)
# Controls of a wide window are above the first, left of the second and right of the third of these.
FREE_TOP_PX, FREE_LEFT_PX, FREE_RIGHT_PX = 92, 230, 84
BOX = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
0 4
0 5
0 6
ITEM: ATOMS id type x y z
1 1 1 1 1
2 2 2 3 4
"""
# Two spheres stay, so that each of the six frames is framed alike.
RUN = "".join(f"3\nframe {i}\nC 0 0 0\nO 6 3 0\nN {1 + i / 2} {1 + i / 4} 0\n" for i in range(6))


def share_off(a, b, tolerance):
    """The share of pixels of two pictures (rows of colours) that differ by more than that in a channel."""
    off = sum(
        any(abs(x - y) > tolerance for x, y in zip(p, q)) for row_a, row_b in zip(a, b) for p, q in zip(row_a, row_b)
    )
    return off / (len(a) * len(a[0]))


class NoWindow(ProgramTest):
    def test_without_a_display(self):
        if not HAS_WINDOW:
            self.skipTest("bihive-view was not built")
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.assertIn("no window can be opened here", self.fail_with(3, "view", "demo", env=environment))

    def test_without_the_program(self):
        """A copy of bihive alone in a folder, with no other place to look for bihive-view and bihive-thesis."""
        for words, program in [(("view", "demo"), "bihive-view"), (("thesis", "--out", "out"), "bihive-thesis")]:
            with tempfile.TemporaryDirectory() as folder:
                alone = shutil.copy(BIHIVE, folder)
                done = subprocess.run([alone, *words], env={"PATH": folder}, cwd=folder, capture_output=True, text=True)
                self.assertEqual(os.listdir(folder), ["bihive"])
            self.assertEqual(done.returncode, 3)
            self.assert_one_error_line(done.stderr)
            self.assertIn(f"the program {program} is not installed", done.stderr)

    def request(self, *words):
        """The request that a window would get, from a program that writes it down in its place."""
        shutil.copy(BIHIVE, self.path("bihive"))
        self.write("bihive-view", '#!/bin/sh\nprintf %s "$1" > request.json\n')
        os.chmod(self.path("bihive-view"), 0o755)
        done = subprocess.run([self.path("bihive"), "view", *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(self.read("request.json")), done.stderr

    def test_cameras_are_those_of_pictures(self):
        for camera in (
            ["--fit", "resname 478"],
            ["--zoom-to", "resname 478", "--view-from", "left"],
            ["--look-at", "chain A", "--eye", "0,0,90"],
            ["--view-from", "principal"],
            ["--view-from", "best:resname 478"],
            ["--turn", "30,20,5", "--zoom", "2", "--projection", "orthographic"],
            ["--up", "0,0,1"],
        ):
            # Fitted to a square, which fits every window; its longer side tells how a long axis lies.
            request, _ = self.request("demo", *camera)
            done = self.succeed("render", "demo", *camera, "--size", "801x800", "--samples", "1", "--no-shadows", "--style", "flat",
                                "--json", "-o", "a.png")
            drawn = json.loads(done)["settings"]["camera"]
            shown = request["settings"]["camera"]
            for key in ("eye", "look_at", "up"):
                self.assertEqual(shown[key], drawn[key], camera)
        self.assertIn("standard input", self.fail_usage("view", "-", "--turn", "30,20"))

    def test_requests_of_scene_files(self):
        self.write("two.xyz", "2\n\nC 0 0 0\nO 1.2 0 0\n")
        self.succeed("scene", "save", "s.json", "two.xyz", "--radius", "0.5", "--style", "flat", "--size", "9x9", "--samples", "900",
                     "--turn", "30,20", "--crop", "0,0,2,2", "--select", "element O", "--colour", "red")
        request, said = self.request("s.json", "--fog", "0.5")
        self.assertEqual((request["input"], request["reading"], request["look"]["style"]), ("two.xyz", {"radius": "0.5"}, "flat"))
        self.assertEqual(request["look"]["rows"], [{"select": "element O", "action": "colour", "value": "red"}])
        self.assertEqual((request["settings"]["fog"], request["settings"]["samples_per_pixel"]), (0.5, 64))
        self.assertIn("--crop left out", said)
        self.assertNotIn("size", request)

    def test_without_an_input(self):
        request, _ = self.request()
        self.assertEqual((request["input"], request["welcome"]), ("demo", True))
        request, _ = self.request("demo", "--tune", "--card", "style")
        self.assertEqual((request["tune"], request["card"], "welcome" in request), (True, "style", False))

    def test_usage(self):
        self.assertIn("--card:", self.fail_usage("view", "demo", "--card", "nothing"))
        self.assertIn("--tune", self.fail_usage("view", "demo", "--tune", "--max-prims", "4"))
        self.assertIn("--tune", self.fail_usage("view", "demo", "--tune", "--engine", "gpu"))
        self.assertIn("--tune", self.fail_usage("view", "demo", "--tune", "--view", "traversal"))
        self.assertIn("--tune", self.fail_usage("web", "demo", "--tune", "--no-browser"))
        self.assertIn("--engine:", self.fail_usage("view", "demo", "--engine", "reference"))
        self.assertIn("--view tree", self.fail_usage("view", "demo", "--engine", "gpu", "--view", "tree"))
        self.assertIn("--count is for", self.fail_usage("view", "demo", "--count", "5"))
        self.assertIn("--samples:", self.fail_usage("view", "demo", "--samples", "65"))
        self.assertIn("--style: there is no style", self.fail_usage("view", "demo", "--style", "nice"))
        self.assertIn("--style is for files", self.fail_usage("view", "four-spheres", "--style", "studio"))
        self.assertIn("bihive view", self.succeed("view", "--help"))


@unittest.skipUnless(HAS_WINDOW, "bihive-view was not built")
class Window(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.screen = Screen()

    @classmethod
    def tearDownClass(cls):
        cls.screen.end()

    def window_of(self, *arguments):
        """Rows of pixels of the whole window."""
        done = self.run_bihive("view", *arguments, "--screenshot", "window.png", env=self.screen.environment())
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return png_pixels(self.read("window.png"))

    @staticmethod
    def free(rows):
        """The part of a picture over which there are no controls."""
        return [row[FREE_LEFT_PX:-FREE_RIGHT_PX] for row in rows[FREE_TOP_PX:]]

    def screenshot(self, *arguments):
        return self.free(self.window_of(*arguments))

    def drawn(self, size, *arguments):
        self.succeed("render", *arguments, "-o", "rendered.png", "--size", size)
        return png_pixels(self.read("rendered.png"))

    def rendered(self, size, *arguments):
        """The same part of what bihive render draws."""
        return self.free(self.drawn(size, *arguments))

    def assert_is_card(self, rows, scale=1):
        """The part of a window where a card is, at the right border."""
        right = -MARGIN_PX * scale
        head = [row[right - CARD_PX * scale : right] for row in rows[CARD_TOP_PX * scale : (CARD_TOP_PX + 60) * scale]]
        pixels = [pixel for row in head for pixel in row]
        self.assertGreater(pixels.count(CARD_COLOUR) / len(pixels), 0.4)
        self.assertGreater(sum(min(pixel) > 200 for pixel in pixels), 25, "text")

    def test_the_cpu_shows_what_it_renders(self):
        window = self.window_of("demo", "--size", "620x420", "--engine", "cpu")
        self.assertEqual((len(window[0]), len(window)), (620, 420))
        self.assertTrue(self.free(window) == self.rendered("620x420", "demo"), "the pixels differ")

    def test_every_card(self):
        for card in ("scene", "open", "style", "colour", "show", "cut", "measure", "save", "share", "more"):
            given = ["demo", "--style", "flat", "--samples", "1"]
            window = self.window_of(*given, "--size", "1000x500", "--card", card)
            self.assert_is_card(window)
            drawn = self.drawn("1000x500", *given)
            beside = [row[FREE_LEFT_PX : -CARD_PX - 2 * MARGIN_PX - FREE_RIGHT_PX] for row in window[FREE_TOP_PX:]]
            self.assertTrue(
                beside == [row[FREE_LEFT_PX : -CARD_PX - 2 * MARGIN_PX - FREE_RIGHT_PX] for row in drawn[FREE_TOP_PX:]], card
            )

    def test_a_narrow_window_has_a_sheet_below(self):
        given = ["demo", "--style", "flat", "--samples", "1"]
        for engine, tolerance in (("cpu", 0), ("gpu", 0.01)):
            for card, height in ((None, 640 - 48), ("style", 310)):
                rows = self.window_of(*given, "--size", "360x640", "--engine", engine, *(["--card", card] if card else []))
                self.assertEqual((len(rows[0]), len(rows)), (360, 640))
                shown, drawn = ([row[140:-80] for row in part[50:height]] for part in (rows, self.drawn(f"360x{height}", *given)))
                self.assertLessEqual(share_off(shown, drawn, 8), tolerance, (engine, card))
                sheet = [pixel for row in rows[height:] for pixel in row]
                self.assertGreater(sheet.count(CARD_COLOUR) / len(sheet), 0.2)

    def test_a_search_keeps_the_bits(self):
        given = ["scenario2", "--count", "500", "--recursion", "2"]
        tuned = self.screenshot(*given, "--tune", "--size", "620x300")[:-60]  # a message is below
        self.assertTrue(tuned == self.rendered("620x300", *given)[:-60])

    def test_styles_are_those_of_render(self):
        for style in ("studio", "flat"):
            given = ["demo", "--style", style]
            picture = self.screenshot(*given, "--size", "620x320")
            self.assertTrue(picture == self.rendered("620x320", *given), "the pixels differ")

    def test_the_graphics_processor_draws_styles(self):
        given = ["demo", "--style", "studio"]
        picture = self.screenshot(*given, "--size", "620x320", "--engine", "gpu")
        self.assertLessEqual(share_off(picture, self.rendered("620x320", *given), 8), 0.01)

    def test_the_graphics_processor_shows_nearly_the_same(self):
        given = ["scenario3", "--recursion", "2"]
        picture = self.screenshot(*given, "--size", "620x420", "--engine", "gpu", "--max-prims", "2")
        self.assertLessEqual(share_off(picture, self.rendered("620x420", *given), 2), 0.005)

    def test_options_of_the_picture_and_of_the_file(self):
        self.write("two.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        given = ["two.csv", "--view", "normal", "--view-from", "top", "--radius-scale", "1.5"]
        picture = self.screenshot(*given, "--size", "620x200")
        self.assertTrue(picture == self.rendered("620x200", *given), "the pixels differ")

    def test_effects_of_a_scene_file(self):
        """Ambient occlusion, fog, outlines, tone, lens, samples and labels of a file, as bihive render draws them."""
        picture = {
            "samples_per_pixel": 9,
            "ambient_occlusion": {"distance": 2, "directions": 12},
            "fog": {"strength": 0.75},
            "outline": {"width_px": 3},
            "exposure": 0.5,
            "tone": "soft",
        }
        camera = {"eye": [0, 0, 9], "look_at": [0, 0, 0]}
        spheres = [[0, 0, 0, 1], [1, 0.5, -3, 1]]
        lens = {**camera, "aperture": 0.2, "focus": 8}
        labels = {"title": "Two", "axes": True}
        auto = {"samples_per_pixel": "auto"}
        for own_camera, own in [(lens, {}), (camera, labels), (camera, auto)]:
            document = {"bihive_scene": 2, "camera": own_camera, "picture": {**picture, **own}, "spheres": spheres}
            self.write("two.json", json.dumps(document))
            shown = self.screenshot("two.json", "--size", "620x240")
            self.assertTrue(shown == self.rendered("620x240", "two.json"), (own_camera, own))

    def test_looks_and_effects_are_those_of_render(self):
        self.write("box.lammpstrj", BOX)
        effects = ["--fog", "0.6", "--exposure", "0.5", "--tone", "filmic", "--ao-distance", "4", "--outline", "3"]
        light = ["--light", "headlight", "--light", "from:-1,1,1:orange:0.5:20", "--light-points", "3", "--no-shadows"]
        rows = ["--colour", "grey", "--select", "chain A", "--colour-by", "b_factor:magma", "--select", "resid 1..20"]
        rows += ["--radius-scale", "1.2", "--outline", "2", "--no-water", "--element-colours", "cpk"]
        labels = ["--title", "Two words", "--axes", "--scale-bar", "--projection", "orthographic"]
        lens = ["--aperture", "2", "--focus", "resname 478", "--fov", "40", "--samples", "8"]
        for given in [
            ["demo", "--style", "studio", *effects],
            ["demo", *light, "--background", "black", "--samples", "auto"],
            ["demo", *rows, "--no-ao"],
            ["demo", *labels],
            ["demo", *lens],
            ["box.lammpstrj", "--radius", "1", "--cell", "--replicate", "2x1x1", "--view-from", "iso"],
        ]:
            picture = self.screenshot(*given, "--size", "620x220")
            self.assertTrue(picture == self.rendered("620x220", *given), given)

    def test_looks_that_do_not_fit(self):
        env = self.screen.environment()
        for words, given in [
            ("nothing is called", ["demo", "--select", "charge > 0", "--hide"]),
            ("hidden", ["demo", "--hide"]),
            ("scale bar", ["demo", "--scale-bar"]),
            ("focus", ["demo", "--aperture", "1", "--focus", "resname NOT"]),
        ]:
            done = self.run_bihive("view", *given, env=env)
            self.assertEqual((done.returncode, done.stdout), (2, ""), given)
            self.assert_one_error_line(done.stderr)
            self.assertRegex(done.stderr, words if given[1] != "--select" else "charge")

    def test_bad_input(self):
        for name, content in [("broken.pdb", "ATOM what"), ("missing.xyz", None)]:
            if content is not None:
                self.write(name, content)
            self.assertIn(name, self.fail_input("view", name, env=self.screen.environment()))
        self.fail_input("view", "demo", "--screenshot", "no/such/folder.png", env=self.screen.environment())

    def test_without_opengl(self):
        screen = Screen("-extension", "GLX")
        self.addCleanup(screen.end)
        self.assertIn("OpenGL 3.3", self.fail_with(3, "view", "demo", env=screen.environment()))

    def test_fine_pixels(self):
        """A screen of 192 dots an inch: twice the pixels, with letters and cards twice as large."""
        screen = Screen(dpi=192)
        self.addCleanup(screen.end)
        arguments = ["view", "demo", "--size", "700x420", "--samples", "1", "--card", "cut", "--screenshot", "window.png"]
        done = self.run_bihive(*arguments, env=screen.environment())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = png_pixels(self.read("window.png"))
        self.assertEqual((len(rows[0]), len(rows)), (2 * 700, 2 * 420))
        self.assert_is_card(rows, 2)
        drawn = self.drawn("1400x840", "demo", "--samples", "1")
        part = slice(2 * 100, 2 * 200), slice(2 * 180, 2 * 240)
        self.assertTrue([row[part[1]] for row in rows[part[0]]] == [row[part[1]] for row in drawn[part[0]]], "the pixels differ")

    # --- Keys and pointer ---------------------------------------------------------------------------------------

    def open_window(self, *arguments):
        self.program = subprocess.Popen(
            [BIHIVE, "view", *arguments], cwd=self.folder, env=self.screen.environment(), stderr=subprocess.PIPE, text=True
        )
        self.addCleanup(self.close_window)
        found = self.tool("search", "--sync", "--onlyvisible", "--pid", str(self.program.pid))
        self.window = found.split()[0]
        self.tool("windowfocus", "--sync", self.window)

    def close_window(self):
        """Also of a window that is closed already."""
        if self.program.poll() is None:
            self.program.kill()
        if not self.program.stderr.closed:
            self.program.communicate()

    def tool(self, *arguments):
        done = subprocess.run(
            ["xdotool", *arguments], env=self.screen.environment(), capture_output=True, text=True, timeout=PATIENCE_S
        )
        self.assertEqual(done.returncode, 0, (arguments, done.stderr))
        return done.stdout

    def press(self, *keys):
        for key in keys:
            self.tool("key", key)
            time.sleep(0.05)

    def enter(self, text, pause_s):
        """Types a text into the field that has been clicked. A key that goes down and up between two frames is lost."""
        self.tool("type", "--delay", "50", text)
        self.tool("keydown", "Return")
        time.sleep(pause_s)
        self.tool("keyup", "Return")

    def saved(self, patience_s=PATIENCE_S):
        """Presses S; the settings and the scene of the picture that is written."""
        before = set(os.listdir(self.folder))
        self.press("s")
        deadline = time.monotonic() + patience_s
        while time.monotonic() < deadline:
            new = [name for name in set(os.listdir(self.folder)) - before if name.endswith(".png")]
            if new:
                data = self.read(new[0])
                text = png_text(data)
                picture = {"name": new[0], "size": png_size(data), "scene": text["Scene"], "frame": int(text.get("Frame", 0))}
                return {**picture, "look": json.loads(text["Look"]), **json.loads(text["Settings"])}
            time.sleep(0.05)
        self.fail("nothing was saved")

    def test_keys_and_pointer(self):
        self.write("pair.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        self.write("titled.xyz", "1\ntwo words\nC 0 0 0\n")
        self.write("broken.csv", "x,y,z\n1,2,what\n")
        self.open_window("demo", "--size", "700x400", "--samples", "1")
        first = self.saved()
        self.assertEqual((first["name"], first["scene"], first["size"]), ("demo.png", "demo", (700, 400)))
        self.assertEqual((first["view"], first["engine"]), ("shaded", "cpu"))

        # Views, engine.
        self.press("4", "e")
        after = self.saved()
        self.assertEqual((after["name"], after["view"], after["engine"]), ("demo-2.png", "normal", "gpu"))
        self.press("7")
        self.assertEqual(self.saved()["view"], "normal", "the graphics processor does not draw the tree")
        self.press("e", "7")
        self.assertEqual(self.saved()["view"], "tree")
        self.press("1")

        # The pointer turns, shifts and zooms; over controls it does not.
        self.tool("mousemove", "--window", self.window, "100", "100", "mousedown", "1")
        self.tool("mousemove", "--window", self.window, "160", "120", "mouseup", "1")
        turned = self.saved()["camera"]
        self.assertNotEqual(turned["eye"], first["camera"]["eye"])
        self.assertEqual(turned["look_at"], first["camera"]["look_at"])
        self.tool("mousemove", "--window", self.window, "100", "100", "mousedown", "3")
        self.tool("mousemove", "--window", self.window, "160", "120", "mouseup", "3")
        shifted = self.saved()["camera"]
        self.assertNotEqual(shifted["look_at"], turned["look_at"])
        self.tool("click", "4")
        nearer = self.saved()["camera"]

        def distance(camera):
            return sum((a - b) ** 2 for a, b in zip(camera["eye"], camera["look_at"])) ** 0.5

        self.assertAlmostEqual(distance(shifted) / distance(nearer), 1.15)
        self.tool("mousemove", "--window", self.window, "660", "370", "click", "4")
        self.assertEqual(self.saved()["camera"], nearer)
        self.press("Left", "minus")
        self.assertGreater(distance(self.saved()["camera"]), distance(nearer))
        time.sleep(1.5)  # what comes later is another change
        self.press("r")
        self.assertEqual(self.saved()["camera"], first["camera"])

        # Undo and redo, by their keys.
        self.press("ctrl+z")
        undone = self.saved()["camera"]
        self.assertGreater(distance(undone), distance(nearer))
        self.press("ctrl+shift+z")
        self.assertEqual(self.saved()["camera"], first["camera"])

        # Where controls are hidden, there is the picture.
        self.press("h")
        self.saved()
        self.tool("mousemove", "--window", self.window, "660", "370", "click", "4")
        self.assertNotEqual(self.saved()["camera"], first["camera"])
        self.press("h", "r")

        # A drag between two frames counts too, also if the last frame had the pointer over controls and a message.
        self.tool("mousemove", "--window", self.window, "660", "370")
        self.saved()
        time.sleep(0.5)  # for that frame
        os.kill(self.program.pid, signal.SIGSTOP)
        self.tool("mousemove", "--window", self.window, "100", "100", "mousedown", "1")
        self.tool("mousemove", "--window", self.window, "160", "120", "mouseup", "1")
        os.kill(self.program.pid, signal.SIGCONT)
        self.assertNotEqual(self.saved()["camera"]["eye"], first["camera"]["eye"])
        self.press("r")

        # A file with an error leaves the scene; another file replaces it.
        def open_file(name):
            self.press("o")
            self.tool("type", "--delay", "20", name)
            self.press("Return")
            time.sleep(1)

        open_file("broken.csv")
        self.assertEqual(self.saved()["scene"], "demo")
        open_file("pair.csv")
        self.title("pair.csv - bihive")
        open_file("titled.xyz")
        self.title("two words - bihive")
        open_file("pair.csv")
        pair = self.saved()
        self.assertEqual((pair["scene"], pair["name"]), ("pair.csv", "pair.png"))
        with open(os.path.join(self.screen.state.name, "bihive", "recent"), encoding="utf-8") as recent:
            self.assertEqual([os.path.basename(line.strip()) for line in recent][:2], ["pair.csv", "titled.xyz"])

        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)


    def test_frames_are_played(self):
        self.write("run.xyz", RUN)
        self.open_window("run.xyz", "--size", "700x400", "--samples", "1", "--frame", "1")
        self.assertEqual(self.frame()["frame"], 1)
        camera = self.frame()["camera"]
        for key, frame in [("period", 2), ("period", 3), ("comma", 2), ("comma", 1), ("comma", 0), ("comma", 5)]:
            self.press(key)
            self.wait_for_frame(frame)
        shown = self.frame()
        self.assertEqual(shown["camera"], camera, "the camera stays")
        native = self.drawn("700x400", "run.xyz", "--samples", "1", "--frame", "5")
        self.assertTrue(png_pixels(self.read(shown["name"])) == native, "the pixels differ")

        # It plays on and on, and stops where the key is pressed.
        self.press("space")
        seen = {self.frame()["frame"] for _ in range(12)}
        self.assertGreater(len(seen), 2)
        self.press("space")
        time.sleep(0.5)
        self.assertEqual(self.frame()["frame"], self.frame()["frame"])

        # The time line: its right end is the last frame, and the camera turns as ever.
        line = 700 - 175
        self.tool("mousemove", "--window", self.window, str(line), "380")
        time.sleep(0.3)
        self.tool("click", "1")
        time.sleep(1)
        self.press("Left")
        self.assertNotEqual(self.frame()["camera"], camera)
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def frame(self):
        return self.saved()

    def wait_for_frame(self, frame):
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            if self.frame()["frame"] == frame:
                return
            time.sleep(0.1)
        self.fail(f"frame {frame} does not come")

    def test_a_look_of_a_selection(self):
        """A row of the card "Show" by pointer and keys. Nothing but the picture says that the card has taken a key, so a
        busy machine gets more time at the next attempt."""
        self.write("pair.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        wanted = [{"select": "index 1", "action": "colour", "value": "orange"}]
        for pause_s in [0.3, 1, 4, 16]:
            self.open_window("pair.csv", "--size", "700x600", "--samples", "1", "--style", "flat", "--card", "show")
            look = self.saved()["look"]
            self.assertEqual((look["style"], look["rows"]), ("flat", []))
            rows = self.rows_after_typing(pause_s)
            if rows == wanted:
                break
            self.close_window()
        self.assertEqual(rows, wanted)
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def rows_after_typing(self, pause_s):
        """The rows of the saved picture; none if the card missed a key, or takes S for a letter."""

        def enter(x, y, text):
            self.tool("mousemove", "--window", self.window, str(x), str(y))
            time.sleep(pause_s)
            self.tool("click", "1")
            time.sleep(2 * pause_s)
            self.enter(text, pause_s)
            time.sleep(2 * pause_s)

        enter(512, 149, "")  # add
        enter(430, 149, "index 1")
        enter(600, 177, "orange")
        self.tool("mousemove", "--window", self.window, "100", "100")
        deadline = time.monotonic() + 10 * pause_s
        while time.monotonic() < deadline:
            try:
                rows = self.saved(patience_s=20 * pause_s)["look"]["rows"]
            except AssertionError:
                return []
            if rows:
                return rows
        return []

    def test_a_title_by_a_card(self):
        """The group labels of the card "Style" is opened by a click, and its first field gets a text. As above, a busy machine gets more
        time at the next attempt."""
        self.write("pair.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        for pause_s in [0.3, 1, 4, 16]:
            self.open_window("pair.csv", "--size", "700x700", "--samples", "1", "--style", "flat", "--card", "style")
            self.assertEqual(self.saved()["title"], "")
            for y in (340, 369):
                self.tool("mousemove", "--window", self.window, "600", str(y))
                time.sleep(pause_s)
                self.tool("click", "1")
                time.sleep(2 * pause_s)
            self.enter("A pair", pause_s)
            self.tool("mousemove", "--window", self.window, "100", "100")
            time.sleep(2 * pause_s)
            try:
                saved = self.saved(patience_s=20 * pause_s)
            except AssertionError:
                saved = {"title": ""}
            if saved["title"] == "A pair":
                break
            self.close_window()
        self.assertEqual(saved["title"], "A pair")
        options = ["--style", "flat", "--samples", "1", "--title", "A pair"]
        self.assertTrue(png_pixels(self.read(saved["name"])) == self.drawn("700x700", "pair.csv", *options))
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def click(self, x, y, *times):
        self.tool("mousemove", "--window", self.window, str(x), str(y))
        time.sleep(0.3)
        self.tool("click", "1")
        time.sleep(0.5)

    def wait_for(self, what, message):
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            if what():
                return
            time.sleep(0.1)
        self.fail(message)

    def card_is_open(self, width):
        corner = width - MARGIN_PX - CARD_PX
        return set(self.screen.pixels(self.window, corner + 2, CARD_TOP_PX + 2, 8, 4)) == {CARD_COLOUR}

    def test_cards_by_pointer_and_keys(self):
        width = 900
        more, share, picture = (width - 36, 26), (width - 104, 26), (220, 300)
        self.open_window("demo", "--size", f"{width}x600", "--samples", "1", "--style", "flat")
        self.saved()
        opened = lambda: self.card_is_open(width)
        closed = lambda: not self.card_is_open(width)
        self.assertTrue(closed())
        self.click(*more)
        self.wait_for(opened, "the button opens no card")
        self.press("Escape")
        self.wait_for(closed, "Escape closes no card")
        self.click(*share)
        self.wait_for(opened, "the button opens no card")
        self.click(*more)
        self.wait_for(opened, "another card")
        self.click(*more)
        self.wait_for(closed, "the button closes its card")
        self.click(*more)
        self.wait_for(opened, "the button opens its card")
        self.click(*picture)
        self.wait_for(closed, "a click on the picture closes no card")

        # The help is over everything, and goes again.
        middle = lambda: self.screen.pixels(self.window, 350, 250, 200, 100)
        before = middle()
        for key in ("question", "F1"):
            self.press(key)
            self.wait_for(lambda: middle() != before, f"{key} shows no help")
            self.press(key)
            self.wait_for(lambda: middle() == before, f"{key} hides no help")
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def test_a_click_beside_show_closes_nothing(self):
        self.open_window("demo", "--size", "900x600", "--samples", "1", "--style", "flat", "--card", "show")
        self.saved()
        self.click(300, 300)
        self.saved()
        self.assertTrue(self.card_is_open(900))
        self.press("q")

    def test_paths_are_completed(self):
        self.write("pair.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        self.write("titled.xyz", "1\ntwo words\nC 0 0 0\n")
        os.mkdir(self.path("sub"))
        self.write("sub/one.xyz", "1\n\nC 0 0 0\n")
        home = os.environ.get("HOME")
        self.addCleanup(lambda: os.environ.update(HOME=home) if home else os.environ.pop("HOME"))
        os.environ["HOME"] = str(self.folder)
        self.open_window("four-spheres", "--size", "700x500", "--samples", "1")
        self.saved()

        def type_path(text, *keys):
            self.press("o")
            self.tool("type", "--delay", "30", text)
            self.press(*keys)

        type_path("ti", "Tab", "Return")
        self.title("two words - bihive")
        type_path("~/pa", "Tab", "Return")
        self.title("pair.csv - bihive")
        # The list has the folder first; its own list has one file. The path begins with the folder of the shown file.
        self.press("o", "Down", "Return", "Down", "Return")
        self.title("one.xyz - bihive")
        # Letters are those of the path; Escape ends that.
        before = set(os.listdir(self.folder))
        self.press("o", "s", "BackSpace", "Escape")
        self.assertEqual(set(os.listdir(self.folder)), before)
        self.saved()
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def test_the_picture_as_a_command(self):
        self.write("two words.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        self.open_window("two words.csv", "--size", "500x300", "--samples", "1", "--style", "studio", "--fog", "0.5", "--max-prims", "2",
                         "--select", "index 1", "--colour", "orange")
        self.saved()
        self.press("Left", "Up", "Right")
        self.tool("mousemove", "--window", self.window, "250", "150", "click", "4")
        saved = self.saved()
        self.press("c")
        words = shlex.split(self.screen.clipboard())
        self.assertEqual(words[:5], ["bihive", "render", "two words.csv", "-o", "two words.png"])
        os.rename(self.path(saved["name"]), self.path("saved.png"))
        self.succeed(*words[1:])
        self.assertTrue(png_pixels(self.read("two words.png")) == png_pixels(self.read("saved.png")), words)
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def test_a_search_is_cancelled(self):
        self.open_window("scenario2", "--count", "60000", "--size", "500x300", "--tune")
        # Its progress lies over the picture, until a key ends it.
        notice = lambda: self.screen.pixels(self.window, 20, 106, 4, 20)
        self.wait_for(lambda: len(set(notice())) == 1 and sum(notice()[0]) > 60, "no progress is shown")
        self.press("Escape")
        self.wait_for(lambda: sum(notice()[0]) < 60 or len(set(notice())) > 1, "it goes on")
        saved = self.saved()
        self.assertEqual((saved["max_prims"], saved["max_depth"]), (None, None))
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)

    def test_frames_shown_are_counted(self):
        request = json.dumps({"shown_frames": self.path("shown.json"), "seconds": 0.01})
        command = [os.environ["BIHIVE_VIEW"], request]
        done = subprocess.run(command, env=self.screen.environment(), capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        shown = json.loads(self.read("shown.json"))
        self.assertEqual((shown["by"], shown["complete"], shown["width_px"], shown["height_px"]), ("window", True, 1136, 640))
        self.assertRegex(shown["device"], "the window by .+")
        found = [(one["scenario"], one["spheres"], one["max_prims"], one["turning"]) for one in shown["configurations"]]
        wanted = [
            (scenario, spheres, tree, turning)
            for scenario in (1, 2, 3) for spheres in (64, 128, 256) for tree in (None, 8) for turning in (False, True)
        ]
        self.assertEqual(found, wanted)
        for one in shown["configurations"]:
            self.assertGreaterEqual(one["seconds"], 0.01)
            self.assertAlmostEqual(one["fps"], one["frames"] / one["seconds"])
        self.succeed("thesis", "section-d", "--quick", "--out", "out", "--device", "shown.json")
        self.assertIn("Frames on a screen", self.read("out/report.html").decode())

        command[1] = json.dumps({"shown_frames": self.path("none/shown.json")})
        done = subprocess.run(command, env=self.screen.environment(), capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assert_one_error_line(done.stderr)

    def title(self, expected):
        """Waits until the window has that name."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            title = self.tool("getwindowname", self.window).strip()
            if title == expected:
                return
            time.sleep(0.05)
        self.fail(f"the window is called {title!r}, not {expected!r}")

    def test_files_are_dropped(self):
        self.write("pair of 100 %.csv", "x,y,z,r\n0,0,0,1\n3,1,0,1\n")
        self.write("broken.csv", "x,y,z\n1,2,what\n")
        self.write("one.xyz", "1\n\nC 0 0 0\n")
        self.open_window("four-spheres", "--size", "600x300", "--samples", "1")
        self.screen.drop(self.window, [self.path("pair of 100 %.csv")])
        self.title("pair of 100 %.csv - bihive")
        self.assertEqual(self.saved()["scene"], self.path("pair of 100 %.csv"))
        # A file with an error leaves the scene; of several files the first is shown.
        self.screen.drop(self.window, [self.path("broken.csv")])
        self.title("pair of 100 %.csv - bihive")
        self.screen.drop(self.window, [self.path("one.xyz"), self.path("broken.csv")])
        self.title("one.xyz - bihive")
        self.press("q")
        self.assertEqual(self.program.wait(timeout=PATIENCE_S), 0)


if __name__ == "__main__":
    main()
