"""bihive.film: of files by the program, of frames in memory."""

import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

import bihive as bh
import numpy as np
from adapt_test import AseLike, Universe
from program import ProgramTest, main

FFMPEG = shutil.which("ffmpeg")
OPTIONS = {"size": (32, 24), "samples": 1, "style": "flat"}


def pictures_of(path):
    """uint8 (frames, height, width, 3) by ffmpeg."""
    words = ["ffmpeg", "-loglevel", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, 24, 32, 3)


@unittest.skipUnless(FFMPEG, "ffmpeg is not installed: scripts/setup test installs it")
class Films(ProgramTest):
    def assert_film(self, name, pictures):
        """The pictures of a film, but for the losses of its codec."""
        found = pictures_of(self.path(name)).astype(float)
        self.assertEqual(len(found), len(pictures))
        for one, expected in zip(found, pictures):
            self.assertLess(np.abs(one - np.asarray(expected)).mean(), 6)

    def test_frames_in_memory(self):
        frames = [bh.Spheres([[x, 0, 0], [0, 0, 0]], radius=1) for x in (2, 3, 4, 5)]
        self.assertEqual(bh.film(iter(frames), self.path("a.mp4"), fps=10, **OPTIONS), 4)
        first = bh.render(frames[0], **OPTIONS)
        self.assert_film("a.mp4", [bh.render(s, camera=first, **OPTIONS) for s in frames])
        self.assertEqual(os.listdir(self.folder), ["a.mp4"])
        rate = "ffprobe -v error -show_entries stream=r_frame_rate -of csv=p=0 a.mp4".split()
        self.assertEqual(subprocess.run(rate, cwd=self.folder, stdout=subprocess.PIPE).stdout.strip(), b"10/1")
        self.assertEqual(bh.film(frames, self.path("b.webm"), frames=slice(1, 4, 2), **OPTIONS), 2)

    def test_masks_and_positions(self):
        frames = [bh.Spheres([[x, 0, 0], [0, 0, 0], [0, 3, 0]], radius=1) for x in (2, 3)]
        options = {"looks": bh.Look([0], radius_scale=0.5), **OPTIONS}  # colour suffers from the codec
        self.assertEqual(bh.film(frames, self.path("a.mp4"), select=np.array([True, True, False]), **options), 2)
        first = bh.render(frames[0], select="index 0 1", **options)
        self.assert_film("a.mp4", [bh.render(s, camera=first, select="index 0 1", **options) for s in frames])
        with self.assertRaisesRegex(bh.UsageError, "select: expected a mask of shape"):
            bh.film([*frames, frames[0][[0, 1]]], self.path("b.mp4"), select=[True, True, False], **options)
        self.assertEqual(os.listdir(self.folder), ["a.mp4"])

    def test_a_universe(self):
        universe = Universe()
        self.assertEqual(bh.film(universe, self.path("a.mp4"), select="element O and x > -1", **OPTIONS), 4)
        universe = Universe()
        self.assertEqual(bh.film(universe.atoms, self.path("b.mp4"), frames=slice(0, 4, 2), **OPTIONS), 2)
        universe = Universe()
        self.assertEqual(bh.film(universe.trajectory, self.path("c.mkv"), atoms=universe.atoms, **OPTIONS), 4)
        with self.assertRaisesRegex(bh.UsageError, "source: a trajectory of MDAnalysis does not know its atoms"):
            bh.film(universe.trajectory, self.path("d.mp4"), **OPTIONS)
        self.assertNotIn("d.mp4", os.listdir(self.folder))

    def test_a_list_of_atoms(self):
        self.assertEqual(bh.film([AseLike(), AseLike()], self.path("a.mp4"), title="{frame}", **OPTIONS), 2)

    def test_files(self):
        self.write("run.xyz", "".join(f"2\n\nC {x} 0 0\nO 0 0 0\n" for x in (2, 3, 4)))
        bh.film(self.path("run.xyz"), self.path("a.mp4"), **OPTIONS)
        frames = [bh.read(self.path("run.xyz"), frame=i) for i in range(3)]
        first = bh.render(frames[0], **OPTIONS)
        self.assert_film("a.mp4", [bh.render(s, camera=first, **OPTIONS) for s in frames])
        bh.film(self.path("run.xyz"), self.path("b.mp4"), frames="0:2", select="element C", fps="30000/1001", **OPTIONS)
        self.assertEqual(len(pictures_of(self.path("b.mp4"))), 2)
        bh.film("demo", self.path("c.mp4"), turntable=360, pictures=3, camera=bh.Orthographic("iso"), **OPTIONS)
        self.assertEqual(len(pictures_of(self.path("c.mp4"))), 3)
        with self.assertRaisesRegex(bh.Error, "frames: "):
            bh.film(self.path("run.xyz"), self.path("d.mp4"), frames="9:12", **OPTIONS)

    def test_orders_of_files(self):
        self.write("run.xyz", "".join(f"2\n\nC {x} 0 0\nO 0 0 0\n" for x in (2, 3, 4)))
        first = bh.render(bh.read(self.path("run.xyz"), frame=0), **OPTIONS)
        pictures = [bh.render(bh.read(self.path("run.xyz"), frame=i), camera=first, **OPTIONS) for i in range(3)]
        bh.film(self.path("run.xyz"), self.path("a.mp4"), reverse=True, ping_pong=False, hold_last=2, **OPTIONS)
        self.assert_film("a.mp4", [pictures[k] for k in (2, 1, 0, 0, 0)])
        bh.film(self.path("run.xyz"), self.path("b.mp4"), ping_pong=True, hold_first=1, **OPTIONS)
        self.assert_film("b.mp4", [pictures[k] for k in (0, 0, 1, 2, 1)])
        with self.assertRaisesRegex(bh.UsageError, "reverse: expected True or False"):
            bh.film(self.path("run.xyz"), self.path("c.mp4"), reverse=2, **OPTIONS)
        with self.assertRaisesRegex(bh.UsageError, "hold_last: is for a film of a file"):
            bh.film([first], self.path("c.mp4"), hold_last=2, **OPTIONS)

    def test_failures_leave_nothing(self):
        frames = [bh.Spheres(np.zeros((1, 3)), radius=1)] * 2

        def broken():
            yield frames[0]
            raise RuntimeError("broken")

        for call, error in [
            (lambda: bh.film(broken(), self.path("a.mp4"), **OPTIONS), RuntimeError),
            (lambda: bh.film([], self.path("a.mp4"), **OPTIONS), bh.UsageError),
            (lambda: bh.film(frames, self.path("a.gif"), **OPTIONS), bh.UsageError),
            (lambda: bh.film(frames, self.path("a.mp4"), fps=0, **OPTIONS), bh.UsageError),
            (lambda: bh.film(3, self.path("a.mp4"), **OPTIONS), bh.UsageError),
            (lambda: bh.film(frames, self.path("no/a.mp4"), **OPTIONS), bh.FileError),
            (lambda: bh.film(self.path("absent"), self.path("a.mp4"), **OPTIONS), bh.FileError),
            (lambda: bh.film([frames[0], 3], self.path("a.mp4"), **OPTIONS), bh.UsageError),
        ]:
            with self.assertRaises(error):
                call()
            self.assertEqual(os.listdir(self.folder), [])

    def fake_ffmpeg(self, script):
        """A program of this name comes first in PATH. It has the real one as $real."""
        path = os.environ["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        os.makedirs(self.path("bin"), exist_ok=True)
        self.write("bin/ffmpeg", f"#!/bin/sh\nreal={FFMPEG}\n" + script)
        os.chmod(self.path("bin/ffmpeg"), 0o755)
        os.environ["PATH"] = self.path("bin") + ":" + path

    def test_a_replaced_film_keeps_owner_and_mode(self):
        frames = [bh.Spheres(np.zeros((1, 3)), radius=1)] * 2
        self.write("run.xyz", "1\n\nC 0 0 0\n" * 2)
        for source in (frames, self.path("run.xyz")):
            self.write("a.mp4", "old")
            os.chmod(self.path("a.mp4"), 0o640)
            if os.geteuid() == 0:
                os.chown(self.path("a.mp4"), 65534, 65534)
            os.symlink("a.mp4", self.path("link.mp4"))
            bh.film(source, self.path("link.mp4"), **OPTIONS)
            info = os.stat(self.path("a.mp4"))
            self.assertEqual((info.st_mode & 0o777, info.st_uid), (0o640, 65534 if os.geteuid() == 0 else os.geteuid()))
            self.assertTrue(os.path.islink(self.path("link.mp4")))
            self.assertEqual(len(pictures_of(self.path("a.mp4"))), 2)
            self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".")], [])
            os.unlink(self.path("link.mp4"))

    def test_a_new_film_has_the_mode_of_other_new_files(self):
        before = os.umask(0o027)
        self.addCleanup(os.umask, before)
        bh.film([bh.Spheres(np.zeros((1, 3)), radius=1)], self.path("a.mp4"), **OPTIONS)
        self.assertEqual(os.stat(self.path("a.mp4")).st_mode & 0o777, 0o640)
        # What a killed program left goes away.
        os.mkdir(self.path(".bihive-0123456789abcdef.film"), 0o700)
        self.write(".bihive-0123456789abcdef.film/film.mp4", "half")
        bh.film([bh.Spheres(np.zeros((1, 3)), radius=1)], self.path("a.mp4"), **OPTIONS)
        self.assertEqual(os.listdir(self.folder), ["a.mp4"])

    def test_an_ffmpeg_that_lies(self):
        frames = [bh.Spheres(np.zeros((1, 3)), radius=1)] * 3
        last = 'for word in "$@"; do last=$word; done\n'
        for script, words in (("exit 0\n", "ffmpeg"), ("cat > /dev/null\n", "wrote no film"),
                              (last + 'cat > /dev/null; echo rubbish > "${last#file:}"\n', "a file that is not a film"),
                              ('case "$*" in *pipe:0*) { head -c 2304; cat >/dev/null; } | "$real" "$@";; *) exec "$real" "$@";; esac\n',
                               "given 3 pictures, and wrote 1 pictures")):
            self.fake_ffmpeg(f"cd {self.path('bin')}\n" + script)
            with self.assertRaisesRegex(bh.MissingError, words):
                bh.film(frames, self.path("a.mp4"), **OPTIONS)
            self.assertEqual(os.listdir(self.folder), ["bin"])

    def wait_until_idle(self, process):
        """Until it waits for somebody: it takes no time of a processor for half a second."""
        used, since = None, time.monotonic()
        while time.monotonic() - since < 0.5:
            with open(f"/proc/{process.pid}/stat") as file:
                now = file.read().rsplit(")", 1)[1].split()[11:13]
            if now != used:
                used, since = now, time.monotonic()
            time.sleep(0.02)

    def test_ctrl_c_ends_an_ffmpeg_that_hangs(self):
        self.fake_ffmpeg('case "$*" in *pipe:0*) echo $$ > "$HERE/started"; exec sleep 700;; esac; exec "$real" "$@"\n')
        self.write("run.xyz", "1\n\nC 0 0 0\n" * 40)
        one = "bh.Spheres([[0, 0, 0]], radius=1)"
        for source in (f"({one} for _ in range(1000))", repr(self.path("run.xyz"))):
            script = f"import bihive as bh; bh.film({source}, {self.path('a.mp4')!r}, size=(640, 480), samples=1, style='plain')"
            process = subprocess.Popen([sys.executable, "-c", script], env={**os.environ, "HERE": self.folder},
                                       stderr=subprocess.PIPE, start_new_session=True, text=True)
            while not (os.path.exists(self.path("started")) and self.read("started")):
                self.assertIsNone(process.poll())
                time.sleep(0.02)
            self.wait_until_idle(process)
            process.send_signal(signal.SIGINT)
            self.assertIn("KeyboardInterrupt", process.communicate(timeout=600)[1])
            with self.assertRaises(ProcessLookupError):
                os.kill(int(self.read("started")), 0)
            os.unlink(self.path("started"))
            self.assertEqual(sorted(os.listdir(self.folder)), ["bin", "run.xyz"])

    def test_progress(self):
        """A function gets the finished share, from 0 to 1, of every kind of film."""
        frames = [bh.Spheres([[x, 0, 0], [0, 0, 0]], radius=1) for x in (2, 3, 4, 5)]
        self.write("run.xyz", "".join(f"2\n\nC {x} 0 0\nO 0 0 0\n" for x in range(2, 42)))
        for source, options, known in (
            (frames, {}, [0.25, 0.5, 0.75, 1, 1]),
            (frames, {"frames": slice(1, 4, 2)}, [0.5, 1, 1]),
            (frames, {"frames": [0, 3]}, [0.5, 1, 1]),
            ((one for one in frames), {}, [0, 0, 0, 0, 1]),
            (Universe(), {}, [0, 0, 0, 0, 1]),  # its trajectory has no length; one of MDAnalysis has
            (self.path("run.xyz"), {}, None),
            ("demo", {"turntable": 360, "pictures": 3}, None),
        ):
            shares = []
            bh.film(source, self.path("a.mp4"), progress=shares.append, **options, **OPTIONS)
            self.assertEqual((shares, shares[-1]), (sorted(shares), 1))
            self.assertTrue(all(0 <= share <= 1 for share in shares), shares)
            if known is not None:
                self.assertEqual(shares, known)

        def stop(share):
            raise RuntimeError("enough")

        for source in (frames, self.path("run.xyz")):
            with self.assertRaisesRegex(RuntimeError, "enough"):
                bh.film(source, self.path("b.mp4"), progress=stop, **OPTIONS)
        self.assertNotIn("b.mp4", os.listdir(self.folder))

    def test_ffmpeg_is_missing(self):
        path = os.environ["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        os.environ["PATH"] = self.folder
        with self.assertRaisesRegex(bh.MissingError, "ffmpeg"):
            bh.film([bh.Spheres(np.zeros((1, 3)), radius=1)], self.path("a.mp4"), **OPTIONS)


if __name__ == "__main__":
    main()
