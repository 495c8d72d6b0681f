"""Films say how they were made: `bihive verify` draws their pictures again, `bihive again` makes the film again."""

import json
import os
import shutil
import struct
import unittest
import zlib

from program import ProgramTest, main, png_chunks, png_text

SMALL = ["--size", "32x24", "--samples", "1"]
RUN = "".join(f"2\nframe {i}\nC {i * 0.2:.1f} 0 0\nO 1.2 0 {i * 0.1:.1f}\n" for i in range(4))


class FilmTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("run.xyz", RUN)

    def film(self, name, *options):
        return self.succeed("film", "run.xyz", "-o", name, *SMALL, *options)

    def verify_json(self, *arguments, code=0):
        done = self.run_bihive("verify", *arguments, "--json")
        self.assertEqual(done.returncode, code, (done.stdout, done.stderr))
        return json.loads(done.stdout)["figures"]


class Sequence(FilmTest):
    def test_each_picture_of_a_sequence_is_a_figure(self):
        self.film("run/%02d.png", "--colour-by", "x", "--follow", "index 0", "--title", "{frame}")
        self.assertIn("4 of 4 figures", self.succeed("verify", "run"))
        record = json.loads(png_text(self.read("run/02.png"))["bihive"])
        self.assertEqual((record["record"], record["frame"]), (2, 2))
        self.succeed("render", "run.xyz", "--film", "run/film.json", "--frame", "2", "-o", "one.png")
        self.assertEqual(self.read("run/02.png"), self.read("one.png"))
        self.succeed("again", "run/02.png", "-o", "again.png")
        self.assertEqual(self.read("run/02.png"), self.read("again.png"))
        self.assertIn("camera", self.fail_usage("again", "run/02.png", "--zoom", "2"))
        self.assertIn("camera", self.fail_input("scene", "save", "s.json", "run/02.png"))
        # Aligned spheres move.
        self.write("run3.xyz", RUN.replace("2\n", "3\n").replace("C ", "H 0 1 0\nC "))
        self.succeed("film", "run3.xyz", "-o", "al/%02d.png", *SMALL, "--align", "all")
        self.assertIn("4 of 4 figures", self.succeed("verify", "al"))
        self.film("no/%02d.png", "--no-metadata")
        self.assertEqual(png_text(self.read("no/02.png")), {})


@unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
class EncodedFilm(FilmTest):
    def test_all_kinds_are_verified(self):
        for ending in ("mp4", "mov", "mkv", "webm", "gif", "apng"):
            name = "a." + ending
            self.film(name, "--colour-by", "x", "--ping-pong", "--hold-first", "1", "--title", "t=1;#\\ [{frame}]")
            verdict = self.verify_json(name)[0]
            self.assertEqual((verdict["verified"], verdict["pictures"], verdict["before_coding"]), (True, 7, ending != "apng"), ending)
            said = self.succeed("verify", name)
            self.assertEqual("coded with loss" in said, ending != "apng")
            # Another run is another picture.
            self.write("other.xyz", RUN.replace("1.2", "1.4"))
            verdict = self.verify_json(name, "other.xyz", code=1)[0]
            self.assertEqual((verdict["changed_files"], verdict["edited"]), (["input"], False))
            self.assertGreater(verdict["pictures_differ"], 0)
        self.assertEqual(self.succeed("verify", "a.gif", "a.mp4").splitlines()[-1], "2 of 2 figures have the same bits")
        self.assertIn("6 of 6 figures", self.succeed("verify", "."))

    def test_folders_and_threads_change_no_byte(self):
        os.mkdir(self.path("in"))
        self.write("in/run.xyz", RUN)
        for ending in ("apng", "gif", "mp4"):
            self.film("a." + ending, "--threads", "1", "--codec=-c:v libx264 -threads 1" if ending == "mp4" else "--no-ao")
            self.succeed("film", "in/run.xyz", "-o", "in/b." + ending, *SMALL, "--threads", "2",
                         "--codec=-c:v libx264 -threads 1" if ending == "mp4" else "--no-ao")
            self.assertEqual(self.read("a." + ending), self.read("in/b." + ending))

    def test_a_changed_apng_is_told(self):
        self.film("a.apng")
        chunks = png_chunks(self.read("a.apng"))
        text = dict(body.split(b"\0", 1) for kind, body in chunks if kind == "tEXt")
        self.assertEqual(len(json.loads(text[b"bihive"])["pictures"]), 4)
        out = b"\x89PNG\r\n\x1a\n"
        for kind, body in chunks:
            if kind == "fdAT":
                pixels = bytearray(zlib.decompress(body[4:]))
                pixels[-1] ^= 1
                body = body[:4] + zlib.compress(bytes(pixels))
            named = kind.encode() + body
            out += struct.pack(">I", len(body)) + named + struct.pack(">I", zlib.crc32(named))
        self.write("b.apng", out)
        verdict = self.verify_json("b.apng", code=1)[0]
        self.assertEqual((verdict["verified"], verdict["edited"], verdict["pictures_differ"]), (False, True, 0))

    def test_without_a_record(self):
        for ending in ("mp4", "gif", "apng"):
            self.film("a." + ending, "--no-metadata")
            self.assertNotIn(b"pictures", self.read("a." + ending))
            self.assertIn("does not say how it was drawn", self.verify_json("a." + ending, code=1)[0]["error"])
        self.assertIn("--methods is of pictures", self.fail_input("verify", "a.gif", "--methods"))
        self.write("c.mp4", b"nothing")
        self.assertIn("ffmpeg", self.verify_json("c.mp4", code=1)[0]["error"])

    def test_again(self):
        self.write("keys.json", '{"keys": [{"picture": 0, "turn": [0, 0, 0]}, {"picture": 1, "turn": [90, 20, 0]}]}')
        self.film("a.apng", "--camera-keys", "keys.json", "--colour-by", "x", "--frames", "::2", "--reverse", "--fps", "10")
        os.remove(self.path("keys.json"))
        self.succeed("again", "a.apng")
        self.assertEqual(self.read("a.apng"), self.read("a-again.apng"))
        self.succeed("again", "a.apng", "-o", "b.gif", "--style", "flat")
        self.assertTrue(self.verify_json("b.gif")[0]["verified"])

    def test_shards_and_interrupted_films_have_it_too(self):
        self.film("a.apng")
        for i in range(2):
            self.film("b.apng", "--shard", f"{i}/2")
        self.succeed("film", "--join", "-o", "b.apng")
        self.assertEqual(self.read("a.apng"), self.read("b.apng"))
        self.assertEqual(self.succeed("verify", "b.apng"), "b.apng: the same bits in all 4 pictures\n")


main()
