"""bihive film among strangers and faults: planted folders and links, pictures that were there before, kills, an ffmpeg that
hangs or lies, and descriptions that ask for what is not theirs to ask."""

# ctest: COST 600

import glob
import json
import os
import shutil
import signal
import stat
import subprocess
import time
import unittest

from film_test import HAS_FFMPEG, LOSSLESS, SMALL, FilmTest
from program import BIHIVE, PATIENCE_S, is_sanitized, main

NOBODY = 65534
IS_ROOT = os.geteuid() == 0
# As an ffmpeg that counts six pictures in whatever was written.
COUNTS = 'case "$*" in *-progress*) echo frame=6; exit 0;; esac\n'
LAST = 'for word in "$@"; do last=${word#file:}; done\n'


class FaultTest(FilmTest):
    def hidden(self):
        return [name for name in self.names() if name.startswith(".bihive-")]

    def half_film(self):
        """run.y4m.part of a run that was killed after two of its six pictures. Returns the bytes of the whole film."""
        if not hasattr(self, "whole_film"):
            self.film("run.xyz", "-o", "run.y4m", *SMALL)
            self.whole_film, self.plan = self.read("run.y4m"), self.read("run.y4m.json")
            os.unlink(self.path("run.y4m"))
            os.unlink(self.path("run.y4m.json"))
        os.mkdir(self.path("run.y4m.part"), 0o700)
        self.write("run.y4m.part/film.json", self.plan)
        self.write("run.y4m.part/film.y4m", self.whole_film[: len(self.whole_film) // 2])
        self.write("run.y4m.part/lock", "")
        return self.whole_film


class Strangers(FaultTest):
    def setUp(self):
        super().setUp()
        self.write("victim", "SECRET")
        os.chmod(self.path("victim"), 0o600)

    def refused(self, words):
        said = self.fail_input("film", "run.xyz", "-o", "run.y4m", *SMALL)
        self.assertIn(words, said)
        self.assertEqual(self.read("victim"), b"SECRET")

    def test_a_half_film_goes_on(self):
        data = self.half_film()
        self.assertEqual(self.film("run.xyz", "-o", "run.y4m", *SMALL)["kept"], 2)
        self.assertEqual(self.read("run.y4m"), data)
        self.assertEqual(self.names(), ["run.xyz", "run.y4m", "run.y4m.json", "victim"])

    @unittest.skipUnless(IS_ROOT, "only root can give files away")
    def test_folders_and_files_of_others(self):
        for name in ("", "/film.json", "/film.y4m", "/lock"):
            with self.subTest(name):
                self.half_film()
                os.chown(self.path("run.y4m.part" + name), NOBODY, NOBODY)
                self.refused("belongs to another user")
                shutil.rmtree(self.path("run.y4m.part"))

    def test_links_and_other_things_in_the_folder(self):
        for name in ("film.json", "film.y4m", "lock"):
            for make, words in ((lambda path: os.symlink("../victim", path), "symbolic link"),
                                (lambda path: os.symlink("../new", path), "symbolic link"),
                                (lambda path: os.link(self.path("victim"), path), "hard links"),
                                (os.mkdir, ""), (os.mkfifo, "is not a regular file")):
                with self.subTest(name=name, words=words):
                    self.half_film()
                    if os.path.exists(self.path("run.y4m.part/" + name)):
                        os.unlink(self.path("run.y4m.part/" + name))
                    make(self.path("run.y4m.part/" + name))
                    self.refused(words)
                    self.assertNotIn("new", self.names())
                    shutil.rmtree(self.path("run.y4m.part"))

    def test_a_folder_that_others_may_write_to(self):
        self.half_film()
        for mode in (0o777, 0o770, 0o1777):
            os.chmod(self.path("run.y4m.part"), mode)
            self.refused("can be written to by other users")
        os.chmod(self.path("run.y4m.part"), 0o755)
        self.assertEqual(self.film("run.xyz", "-o", "run.y4m", *SMALL)["kept"], 2)

    def test_a_link_in_the_place_of_the_folder(self):
        self.half_film()
        os.rename(self.path("run.y4m.part"), self.path("elsewhere"))
        os.symlink("elsewhere", self.path("run.y4m.part"))
        self.refused("symbolic link")
        os.unlink(self.path("run.y4m.part"))
        self.write("run.y4m.part", "")
        self.refused("is in the place")

    def test_pictures_and_description_of_a_sequence(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL)
        os.unlink(self.path("run/3.png"))
        os.symlink("../victim", self.path("run/3.png"))
        said = self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL)
        self.assertIn("run/3.png: exists already, and was not written by bihive film", said)
        os.unlink(self.path("run/3.png"))
        for name in ("film.json", "film.index"):
            kept = self.read("run/" + name)
            os.unlink(self.path("run/" + name))
            os.link(self.path("victim"), self.path("run/" + name))
            self.assertIn("hard links", self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL))
            os.unlink(self.path("run/" + name))
            self.write("run/" + name, kept)
            os.chmod(self.path("run/" + name), 0o666)
            self.assertIn("chmod go-w", self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL))
            os.chmod(self.path("run/" + name), 0o644)
        self.assertEqual(self.film("run.xyz", "-o", "run/%d.png", *SMALL)["drawn"], 1)
        self.assertEqual(self.read("victim"), b"SECRET")

    def test_what_bihive_has_not_made_stays(self):
        self.half_film()
        self.write("run.y4m.part/notes.txt", "mine")
        self.film("run.xyz", "-o", "run.y4m", *SMALL)
        self.assertEqual(self.names("run.y4m.part"), ["notes.txt"])
        self.assertIn("is in the place", self.fail_input("film", "run.xyz", "-o", "run.y4m", *SMALL))


class Privacy(FaultTest):
    def outputs(self):
        return ["run.y4m", "run.mkv"] if HAS_FFMPEG else ["run.y4m"]

    def film_as(self, name):
        self.film("run.xyz", "-o", name, *SMALL, *(LOSSLESS if name.endswith("mkv") else []))

    def test_a_replaced_film_keeps_owner_and_mode(self):
        for name in self.outputs():
            self.write(name, "old")
            os.chmod(self.path(name), 0o600)
            if IS_ROOT:
                os.chown(self.path(name), NOBODY, NOBODY)
            os.symlink(name, self.path("link" + name))
            self.film_as("link" + name)
            self.assertTrue(os.path.islink(self.path("link" + name)))
            for path in (name, name + ".json"):
                info = os.stat(self.path(path))
                self.assertEqual(stat.S_IMODE(info.st_mode), 0o600, path)
                self.assertEqual(info.st_uid, NOBODY if IS_ROOT else os.geteuid(), path)
            self.assertNotEqual(self.read(name), b"old")
            self.assertEqual(self.hidden(), [])

    def test_a_new_film_has_the_mode_of_other_new_files(self):
        before = os.umask(0o027)
        self.addCleanup(os.umask, before)
        for name in self.outputs():
            self.film_as(name)
            self.assertEqual(stat.S_IMODE(os.stat(self.path(name)).st_mode), 0o640)

    def test_nobody_else_sees_a_film_that_is_made(self):
        before = os.umask(0)
        self.addCleanup(os.umask, before)
        process = self.begin("run.xyz", "-o", "run.y4m", "--size", "400x300", "--style", "plain", "--samples", "25")
        part = self.path("run.y4m.part")
        self.wait_for(lambda: os.path.exists(part))
        mode = stat.S_IMODE(os.stat(part).st_mode)
        process.kill()
        process.communicate()
        self.assertEqual(mode, 0o700)

    def test_a_mount_point_is_written_in_place(self):
        self.write("inside.y4m", "x")
        self.write("outside.y4m", "old")
        mount = 'mount --bind "$0/outside.y4m" "$0/inside.y4m" && '
        if subprocess.run(["unshare", "-rm", "sh", "-c", mount + "true", self.folder], stderr=subprocess.DEVNULL).returncode:
            self.skipTest("mounting is not permitted here")
        words = ["film", "run.xyz", "-o", "inside.y4m", *SMALL]
        done = subprocess.run(["unshare", "-rm", "sh", "-c", mount + 'cd "$0" && "$@"', self.folder, BIHIVE, *words],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.film("run.xyz", "-o", "a.y4m", *SMALL)
        self.assertEqual(self.read("outside.y4m"), self.read("a.y4m"))
        self.assertEqual(self.read("inside.y4m"), b"x")


    def test_a_link_to_another_ending(self):
        for link, target in (("a.y4m", "nowhere"), ("b.mp4", "c.y4m"), ("d.y4m", "e.mkv")):
            os.symlink(target, self.path(link))
            said = self.fail_usage("film", "run.xyz", "-o", link, *SMALL)
            self.assertIn(f"the link {link} leads to {target}, which does not end in {link[1:]}", said)

    def test_descriptions_that_are_none(self):
        """The message says what to do."""
        os.mkdir(self.path("run.y4m.part"), 0o700)
        os.mkdir(self.path("run"))
        for text in ("", '{"bihive_film": 1', "[]"):
            self.write("run.y4m.part/film.json", text)
            self.assertIn("is no description of a film; remove the folder to begin anew",
                          self.fail_input("film", "run.xyz", "-o", "run.y4m", *SMALL))
            self.write("run/film.json", text)
            self.assertIn("is no description of a film; move it away",
                          self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL))

    def test_a_full_disk(self):
        """What is whole stays, and the message says so."""
        script = 'mount -t tmpfs -o size=16k none "$0/disk" && cd "$0" && "$@"; code=$?; ls disk; exit $code'
        os.mkdir(self.path("disk"))
        if subprocess.run(["unshare", "-rm", "sh", "-c", script, self.folder, "true"], capture_output=True).returncode:
            self.skipTest("mounting is not permitted here")
        words = [BIHIVE, "film", "run.xyz", "-o", "disk/a.y4m", *SMALL]
        done = subprocess.run(["unshare", "-rm", "sh", "-c", script, self.folder, *words], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (1, "a.y4m.part\n"))
        self.assertIn("No space left on device; free some space, and run the same again: whole pictures are kept", done.stderr)
        self.assert_one_error_line(done.stderr)


class PicturesThatWereThere(FaultTest):
    whole = ["run.xyz", "-o", "run/%d.png", *SMALL]

    def test_a_file_with_the_name_of_a_picture(self):
        os.mkdir(self.path("run"))
        for content in (b"", b"NOT A PICTURE"):
            self.write("run/3.png", content)
            self.assertIn("run/3.png: exists already", self.fail_input("film", *self.whole))

    def test_pictures_without_their_description(self):
        self.film(*self.whole)
        kept_at = os.stat(self.path("run/0.png")).st_mtime_ns
        os.unlink(self.path("run/film.json"))
        # The same film again is the same film.
        self.assertEqual(self.film(*self.whole)["kept"], 6)
        self.assertEqual(os.stat(self.path("run/0.png")).st_mtime_ns, kept_at)
        # Another film takes their places, as the message says.
        other = [*self.whole, "--view", "normal"]
        said = self.fail_input("film", *other)
        self.assertIn("remove it to replace its pictures, or name another output", said)
        os.unlink(self.path("run/film.json"))
        report = self.film(*other)
        self.assertEqual((report["drawn"], report["kept"]), (6, 0))
        self.film("run.xyz", "-o", "new/%d.png", *SMALL, "--view", "normal")
        self.assertEqual(self.pixels_of_sequence("run"), self.pixels_of_sequence("new"))
        self.assertEqual(self.film(*other)["kept"], 6)

    def test_only_pictures_of_a_film_are_replaced(self):
        self.film(*self.whole)
        os.unlink(self.path("run/film.json"))
        picture = self.read("run/2.png")
        other = [*self.whole, "--view", "normal"]
        for foreign in (b"mine", picture[:-1], picture + b"\0", self.read("run/1.png")):
            self.write("run/2.png", foreign)
            before = self.contents()
            self.assertIn("run/2.png: exists already, and was not written by bihive film; move it away",
                          self.fail_input("film", *other))
            self.assertEqual(self.contents(), before)
        # Without the index, nobody knows whose they are.
        self.write("run/2.png", picture)
        os.unlink(self.path("run/film.index"))
        self.assertIn("run/0.png: exists already", self.fail_input("film", *other))
        self.assertEqual(self.read("run/2.png"), picture)

    def test_a_film_that_replaces_another_goes_on_after_a_kill(self):
        self.film(*self.whole)
        os.unlink(self.path("run/film.json"))
        # As a run that was killed after two pictures of the new film.
        other = [*self.whole, "--view", "normal"]
        old = {name: self.read("run/" + name) for name in ("2.png", "3.png", "4.png", "5.png")}
        self.film(*other)
        lines = self.read("run/film.index").splitlines(keepends=True)
        self.assertEqual(len(lines), 14)
        self.write("run/film.index", b"".join(lines[:10]) + lines[10][:9])
        for name, data in old.items():
            self.write("run/" + name, data)
        report = self.film(*other)
        self.assertEqual((report["drawn"], report["kept"]), (4, 2))
        self.film("run.xyz", "-o", "new/%d.png", *SMALL, "--view", "normal")
        self.assertEqual(self.pixels_of_sequence("run"), self.pixels_of_sequence("new"))

    def test_a_shorter_film_tells_which_pictures_are_left(self):
        for shard in ("0/2", "1/2"):
            self.film(*self.whole, "--shard", shard)
        self.film("--join", "-o", "run/%d.png")
        os.unlink(self.path("run/film.json"))
        said = self.run_bihive("film", *self.whole, "--frames", ":4")
        self.assertEqual(said.returncode, 0)
        self.assertIn("run/4.png: is of an earlier film, as is 1 more here; remove what you do not need", said.stderr)
        os.unlink(self.path("run/5.png"))
        os.unlink(self.path("run/4.png"))
        self.assertEqual(self.run_bihive("film", *self.whole, "--frames", ":4").stderr, "")

    def test_shards_replace_pictures_too(self):
        self.film(*self.whole)
        os.unlink(self.path("run/film.json"))
        for shard in ("0/3", "2/3", "1/3"):
            self.film(*self.whole, "--view", "normal", "--shard", shard)
        self.film("--join", "-o", "run/%d.png")
        self.film("run.xyz", "-o", "new/%d.png", *SMALL, "--view", "normal")
        self.assertEqual(self.pixels_of_sequence("run"), self.pixels_of_sequence("new"))
        self.assertEqual(self.names("run"), [f"{k}.png" for k in range(6)] + ["film.index", "film.json"])

    def test_a_picture_that_has_changed(self):
        self.film(*self.whole)
        good = self.read("run/2.png")
        for bad in (good[:-1], good[:50] + bytes([good[50] ^ 1]) + good[51:], good + b"\0", self.read("run/1.png")):
            self.write("run/2.png", bad)
            self.assertIn("run/2.png: exists already", self.fail_input("film", *self.whole))
        self.write("run/2.png", good)
        self.assertEqual(self.film(*self.whole)["kept"], 6)

    def test_an_index_that_a_kill_has_cut(self):
        self.film(*self.whole)
        index = self.read("run/film.index")
        lines = index.splitlines(keepends=True)
        self.assertEqual(len(lines), 7)
        # The last picture's line, and with it the picture, did not come to be.
        for cut in range(1, len(lines[-1])):
            self.write("run/film.index", index[:-cut])
            if os.path.exists(self.path("run/5.png")):
                os.unlink(self.path("run/5.png"))
            if cut in (1, 5, len(lines[-1]) - 1):
                report = self.film(*self.whole)
                self.assertEqual((report["kept"], report["drawn"]), (5, 1))
                self.assertEqual(self.read("run/film.index"), index)
        # Nothing but a part of its first line.
        for name in glob.glob(self.path("run/*.png")):
            os.unlink(name)
        self.write("run/film.index", index[:10])
        self.assertEqual(self.film(*self.whole)["drawn"], 6)
        self.assertEqual(self.read("run/film.index"), index)

    def test_an_index_that_is_none(self):
        os.mkdir(self.path("run"))
        self.write("run/film.index", "Chapter 1\n")
        self.assertIn("run/film.index: exists already, and was not written by bihive film", self.fail_input("film", *self.whole))
        self.assertEqual((self.names("run"), self.read("run/film.index")), (["film.index"], b"Chapter 1\n"))

    def test_shards_have_indices_of_their_own(self):
        for shard in ("0/2", "1/2"):
            self.film(*self.whole, "--shard", shard)
        self.assertEqual([name for name in self.names("run") if not name.endswith("png")],
                         ["film.0-2.index", "film.1-2.index", "film.json"])
        self.assertEqual(self.film(*self.whole, "--shard", "1/2")["kept"], 3)
        picture = self.read("run/4.png")
        self.write("run/4.png", picture + b"\0")
        self.assertIn("run/4.png", self.fail_input("film", "--join", "-o", "run/%d.png"))
        self.write("run/4.png", picture)
        self.film("--join", "-o", "run/%d.png")
        self.assertEqual([name for name in self.names("run") if not name.endswith("png")], ["film.index", "film.json"])
        self.assertEqual(self.film(*self.whole)["kept"], 6)

    def test_pictures_of_shards_in_the_folder_of_parts(self):
        for shard in ("0/2", "1/2"):
            self.film("run.xyz", "-o", "run.y4m", *SMALL, "--shard", shard)
        path = "run.y4m.part/picture-00000003.png"
        picture = self.read(path)
        self.write(path, self.read("run.y4m.part/picture-00000002.png"))
        self.assertIn(path, self.fail_input("film", "--join", "-o", "run.y4m"))
        self.write(path, picture)
        self.film("--join", "-o", "run.y4m")
        self.assertEqual(self.names(), ["run.xyz", "run.y4m", "run.y4m.json"])


class FilmsThatWereThere(FaultTest):
    def outputs(self):
        return [("run.y4m", []), *([("run.mkv", LOSSLESS)] if HAS_FFMPEG else [])]

    def test_a_finished_film_is_kept(self):
        for name, codec in self.outputs():
            words = ["run.xyz", "-o", name, *SMALL, *codec]
            self.film(*words)
            before = self.contents()
            made_at = os.stat(self.path(name)).st_mtime_ns
            os.symlink(name, self.path("link" + name))
            for output in (name, "link" + name):
                report = self.film("run.xyz", "-o", output, *SMALL, *codec)
                self.assertEqual((report["drawn"], report["kept"], report["pictures"]), (0, 6, 6))
            os.unlink(self.path("link" + name))
            self.assertEqual(self.contents(), before)
            self.assertEqual(os.stat(self.path(name)).st_mtime_ns, made_at)
            self.assertIn("6 kept from before", self.succeed("film", *words))
            self.assertEqual(self.single(name + ".json", "--frame", "2")[:4], b"\x89PNG")

    def test_a_film_is_made_again_when_a_file_of_its_options_changes(self):
        self.write("s.json", '{"bihive_style": 1, "background": "black"}')
        self.write("map.txt", "#000000\n#ff0000\n")
        words = ["run.xyz", "-o", "run.y4m", "--size", "48x32", "--samples", "1", "--style", "s.json", "--colour-by", "x:map.txt"]
        self.assertEqual(self.film(*words)["drawn"], 6)
        self.assertEqual(self.film(*words)["kept"], 6)
        self.write("s.json", '{"bihive_style": 1, "background": "blue"}')
        self.assertEqual(self.film(*words)["drawn"], 6)
        self.write("map.txt", "#000000\n#00ff00\n")
        self.assertEqual(self.film(*words)["drawn"], 6)
        self.assertEqual(self.film(*words)["kept"], 6)

    def test_the_film_of_shards_too(self):
        for shard in ("0/2", "1/2"):
            self.film("run.xyz", "-o", "run.y4m", *SMALL, "--shard", shard)
        self.film("--join", "-o", "run.y4m")
        self.assertEqual(self.film("run.xyz", "-o", "run.y4m", *SMALL)["kept"], 6)

    def test_any_other_is_replaced(self):
        for name, codec in self.outputs():
            words = ["run.xyz", "-o", name, *SMALL, *codec]
            self.write(name, "not a film")
            self.assertEqual(self.film(*words)["drawn"], 6)
            film, plan = self.read(name), self.read(name + ".json")
            for bad in (b"", film[:-1], film + b"\0", film[:50] + b"!" + film[51:]):
                self.write(name, bad)
                self.assertEqual(self.film(*words)["drawn"], 6)
            os.unlink(self.path(name))
            self.assertEqual(self.film(*words)["drawn"], 6)
            for bad in (b"", b"{}", plan.replace(b'"hash": "', b'"hash": "0'), plan.replace(b'"bytes"', b'"octets"')):
                self.write(name + ".json", bad)
                self.assertEqual(self.film(*words)["drawn"], 6)
            os.unlink(self.path(name + ".json"))
            self.assertEqual(self.film(*words)["drawn"], 6)
            for more in (["--zoom", "2"], ["--fps", "30"], ["--frames", "::2"]):
                self.assertGreater(self.film(*words, *more)["drawn"], 0)
            self.write("run.xyz", self.read("run.xyz"))
            self.assertEqual(self.film(*words)["drawn"], 6)

    @unittest.skipUnless(IS_ROOT, "only root can give files away")
    def test_so_is_that_of_another_user(self):
        words = ["run.xyz", "-o", "run.y4m", *SMALL]
        self.film(*words)
        for name in ("run.y4m", "run.y4m.json"):
            os.chown(self.path(name), NOBODY, NOBODY)
            self.assertEqual(self.film(*words)["drawn"], 6)
            os.chown(self.path(name), os.geteuid(), -1)


class Kills(FaultTest):
    def test_a_kill_before_the_first_picture_leaves_no_folder(self):
        process = self.begin("run.xyz", "-o", "run.y4m", "--size", "4000x4000", "--samples", "256")
        self.let_work(process, 0.5)
        process.kill()
        process.communicate()
        self.assertEqual(self.names(), ["run.xyz"])

    def test_a_clean_up_that_was_killed(self):
        for there in (["film.y4m"], ["lock"], ["segment-00000000-00000003.mp4"], ["unfinished-0123456789abcdef.mp4"],
                      ["picture-00000001.png", "film.0-2.index"], []):
            with self.subTest(there):
                os.mkdir(self.path("run.y4m.part"), 0o700)
                for name in there:
                    self.write("run.y4m.part/" + name, "half")
                self.assertEqual(self.film("run.xyz", "-o", "run.y4m", *SMALL)["drawn"], 6)
                self.assertEqual(self.names(), ["run.xyz", "run.y4m", "run.y4m.json"])
                os.unlink(self.path("run.y4m"))
        # The film's description alone, or with a film that has lost its end.
        self.half_film()
        self.write("run.y4m.part/film.y4m", "YUV4")
        self.assertEqual(self.film("run.xyz", "-o", "run.y4m", *SMALL)["drawn"], 6)

    def test_the_next_run_removes_what_a_killed_one_left(self):
        os.mkdir(self.path(".bihive-0123456789abcdef.film"), 0o700)
        self.write(".bihive-0123456789abcdef.film/film.y4m", "half")
        os.mkdir(self.path(".bihive-0123456789abcde0.film"), 0o700)
        self.write(".bihive-0123456789abcde0.film/letter", "not a film")
        self.film("run.xyz", "-o", "run.y4m", *SMALL)
        self.assertEqual(self.hidden(), [".bihive-0123456789abcde0.film"])

    def test_too_few_descriptors(self):
        if is_sanitized():
            self.skipTest("the sanitizer needs descriptors of its own to look at objects")
        before = self.contents()
        for limit in range(4, 14):
            done = subprocess.run(["sh", "-c", f'ulimit -n {limit}; exec "$0" "$@"', BIHIVE, "film", "run.xyz", "-o", "run.y4m",
                                   *SMALL, "--threads", "1"], cwd=self.folder, capture_output=True, text=True)
            if done.returncode == 0:
                break
            self.assert_one_error_line(done.stderr)
            # Where a picture is whole, it stays.
            part = self.path("run.y4m.part/film.y4m")
            if os.path.exists(part):
                self.assertGreater(os.path.getsize(part), 3 * 48 * 32)
                shutil.rmtree(os.path.dirname(part))
            self.assertEqual(self.contents(), before, limit)
        else:
            self.fail("13 descriptors are not enough")

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_the_ffmpeg_of_a_killed_run_writes_on(self):
        # It begins to write when the next run is at work, and ends after it.
        environment = self.fake_ffmpeg(f'case "$*" in *pipe:0*) sleep 1;; esac\nexec {shutil.which("ffmpeg")} "$@"\n')
        command = ["run.xyz", "-o", "run.mkv", *SMALL, *LOSSLESS]
        process = self.begin(*command, env=environment)
        self.wait_for(lambda: self.hidden() != [])
        process.kill()
        process.communicate()
        done = self.run_bihive("film", *command, env=environment)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.film("run.xyz", "-o", "all/%d.png", *SMALL)
        self.assertEqual(self.decoded("run.mkv"), self.pixels_of_sequence("all"))
        self.assertNotIn("run.mkv.part", self.names())

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_a_segment_that_lacks_pictures_is_made_again(self):
        command = ["run.xyz", "-o", "run.mkv", *SMALL, *LOSSLESS]
        self.film(*command)
        os.mkdir(self.path("run.mkv.part"), 0o700)
        os.rename(self.path("run.mkv.json"), self.path("run.mkv.part/film.json"))
        # It says that it has four pictures, and has three.
        segment = self.path("run.mkv.part/segment-00000000-00000004.mkv")
        subprocess.run(["ffmpeg", "-v", "error", "-i", self.path("run.mkv"), "-frames:v", "3", "-c", "copy", segment], check=True)
        os.unlink(self.path("run.mkv"))
        self.assertEqual(self.film(*command)["drawn"], 6)
        self.film("run.xyz", "-o", "all/%d.png", *SMALL)
        self.assertEqual(self.decoded("run.mkv"), self.pixels_of_sequence("all"))


class Ffmpeg(FaultTest):
    def test_an_ffmpeg_that_hangs_ends_with_the_first_signal(self):
        for script in ("exec sleep 700\n", "cat > /dev/null; sleep 700\n", "trap '' TERM INT; sleep 700; sleep 700\n",
                       LAST + 'case "$*" in *-progress*) sleep 700;; esac; cat > "$last"\n'):
            for signal_sent in (signal.SIGTERM, signal.SIGINT):
                with self.subTest(script=script, signal=signal_sent):
                    environment = self.fake_ffmpeg('echo $$ > "$HERE/started"\n' + script)
                    environment["HERE"] = self.folder
                    process = self.begin("run.xyz", "-o", "run.mp4", "--size", "640x480", "--style", "plain", "--samples", "1",
                                         env=environment)
                    self.wait_for(lambda: os.path.exists(self.path("started")) and self.read("started"))
                    self.let_work(process, 0)
                    group = int(self.read("started"))
                    process.send_signal(signal_sent)
                    self.assertEqual(process.wait(timeout=PATIENCE_S), 128 + signal_sent)
                    process.communicate()
                    self.assertEqual(self.group_of(group), [])
                    os.unlink(self.path("started"))
                    self.assertEqual(self.names(), ["bin", "run.xyz"])

    def group_of(self, group):
        """The processes of a group that still run."""
        found = []
        for path in glob.glob("/proc/[0-9]*/stat"):
            try:
                with open(path) as file:
                    fields = file.read().rsplit(")", 1)[1].split()
            except OSError:
                continue
            if int(fields[2]) == group and fields[0] != "Z":
                found.append(path)
        return found

    def test_an_ffmpeg_that_lies(self):
        for script, words in (("exit 0\n", "wrote no film"),
                              ("cat > /dev/null\n", "wrote no film"),
                              (LAST + 'cat > /dev/null; case "$last" in -) ;; *) echo rubbish > "$last";; esac\n', "a file that is not a film"),
                              (LAST + 'case "$last" in -) echo frame=5;; *) cat > "$last";; esac\n', "given 6 pictures, and wrote"),
                              (LAST + 'case "$last" in -) echo frame=x;; *) cat > "$last";; esac\n', "not a film")):
            environment = self.fake_ffmpeg(script)
            done = self.run_bihive("film", "run.xyz", "-o", "run.mp4", *SMALL, env=environment)
            self.assertIn(words if script != "exit 0\n" else "ffmpeg", done.stderr)
            self.assertEqual(done.returncode, 3)
            self.assert_one_error_line(done.stderr)
            self.assertEqual(self.names(), ["bin", "run.xyz"])

    def test_a_folder_that_is_called_ffmpeg(self):
        os.makedirs(self.path("bin/ffmpeg"))
        said = self.fail_with(3, "film", "run.xyz", "-o", "run.mp4", env={**os.environ, "PATH": self.path("bin")})
        self.assertIn("is not installed", said)

    def test_an_ffmpeg_that_is_no_program(self):
        self.fake_ffmpeg("")
        self.write("bin/ffmpeg", "no program")
        done = self.run_bihive("film", "run.xyz", "-o", "run.mp4", *SMALL,
                               env={**os.environ, "PATH": self.path("bin")})
        self.assertEqual(done.returncode, 3)
        self.assert_one_error_line(done.stderr)
        self.assertEqual(self.names(), ["bin", "run.xyz"])

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_a_codec_that_changes_the_number_of_pictures(self):
        said = self.fail_with(3, "film", "run.xyz", "-o", "run.mkv", *SMALL, "--codec", "-vf framestep=2 -c:v ffv1")
        self.assertIn("was given 6 pictures, and wrote 3 pictures", said)
        self.assertIn("--codec", said)


class Descriptions(FaultTest):
    def setUp(self):
        super().setUp()
        self.film("run.xyz", "-o", "run.y4m", *SMALL)
        self.plan = json.loads(self.read("run.y4m.json"))

    def planned(self, **asked):
        plan = json.loads(json.dumps(self.plan))
        plan["asked"].update(asked)
        self.write("film.json", json.dumps(plan))

    def test_words_that_are_no_options_of_a_picture(self):
        for words in (["--help"], ["-h"], ["--version"], ["-o", "other.png"], ["-oother.png"], ["--output=other.png"],
                      ["other.xyz"], ["--film", "film.json"], ["--trajectory", "run.xyz"], ["--json"], ["--threads", "9"],
                      ["--camera-keys", "keys"], ["--codec", "x"], ["--join"], ["--"], [""], ["-"], ["--layers", "depth"],
                      ["--size", "9x9", "render"]):
            self.planned(options=words)
            said = self.fail_input("render", "run.xyz", "--film", "film.json", "--picture", "0", "-o", "o.png")
            self.assertIn("film.json: its options contain", said, words)

    def test_values_that_no_picture_takes(self):
        for words in (["--size", "0x9"], ["--size"], ["--samples", "99999"], ["--engine", "none"], ["--size", "9x9", "--size", "9x9"]):
            self.planned(options=words)
            said = self.fail_input("render", "run.xyz", "--film", "film.json", "--picture", "0", "-o", "o.png")
            self.assertIn("film.json: its options are invalid", said, words)

    def test_files_that_they_name(self):
        self.write("private", "root:x:0:0\n")
        for words in (["--element-colours", "private"], ["--element-colours=private"], ["--style", self.path("private")],
                      ["--title-values", "private"]):
            self.planned(options=[*SMALL[:2], *words])
            said = self.fail_input("render", "run.xyz", "--film", "film.json", "--picture", "0", "-o", "o.png")
            self.assertIn("its options name the file", said)
            self.assertNotIn("root:", said)
        # A file that the user names too is the user's own wish.
        self.write("log.csv", "e\n" + "1\n2\n3\n4\n5\n6\n")
        titled = ["--title-values", "log.csv", "--title", "{e}"]
        self.film("run.xyz", "-o", "titled/%d.png", *SMALL, *titled)
        self.succeed("render", "run.xyz", "--film", "titled/film.json", "--frame", "2", *titled[:2], "-o", "o.png")
        self.assertEqual(self.read("o.png"), self.read("titled/2.png"))

    def test_numbers_that_no_film_has(self):
        good = json.dumps(self.plan)
        for old, new in (('"pictures": 6', '"pictures": 1e300'), ('"pictures": 6', '"pictures": 600000000'),
                         ('"pictures": 6', '"pictures": 5'), ('"first": 0', '"first": -1'), ('"step": 1', '"step": 9223372036854775807'),
                         ('"size_px": [48, 32]', '"size_px": [0, 32]'), ('"size_px": [48, 32]', '"size_px": [70000, 32]'),
                         ('"turntable_deg": 0', '"turntable_deg": 1e300'), ('"colour_range": "first"', '"colour_range": "all"')):
            text = good.replace(old, new).replace(old.replace(": 0", ": 0.0"), new)
            self.assertNotEqual(text, good, old)
            self.write("film.json", text)
            self.assertIn("is no description of a film",
                          self.fail_input("render", "run.xyz", "--film", "film.json", "--picture", "0", "-o", "o.png"))

    def test_a_codec_in_a_file_is_data(self):
        self.film("run.xyz", "-o", "run.mp4", *SMALL, "--shard", "0/1")
        path = "run.mp4.part/film.json"
        plan = self.read(path).decode()
        for codec in ("-f image2 made/x", "-i run.y4m", "-filter_complex movie=run.y4m", "-attach run.xyz", "made/other.mp4",
                      "-c:v ffv1 made/other.mkv", "-vf movie=run.y4m", "-c:v libx264 -x264-params csv=made/x", "-crf", "-pass 1",
                      "-passlogfile made/x", "-c:v -y", "-crf http://x", "-report", "-c:v /x", "-movflags +faststart -y a"):
            self.write(path, plan.replace('"codec": ""', f'"codec": "{codec}"'))
            if HAS_FFMPEG:
                self.assertIn(path + ": the codec contains ", self.fail_input("film", "--join", "-o", "run.mp4"))

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_a_codec_that_the_user_gives_again(self):
        for codec, more in (("-c:v ffv1 -pix_fmt gbrp -g 1", []), ("-vf null -c:v ffv1", ["--codec", "-vf null -c:v ffv1"])):
            for shard in ("0/2", "1/2"):
                self.film("run.xyz", "-o", "run.mkv", *SMALL, "--shard", shard, "--codec", codec)
            self.assertIn("another codec", self.fail_input("film", "--join", "-o", "run.mkv", "--codec", "-c:v x"))
            self.assertEqual(self.film("--join", "-o", "run.mkv", *more)["pictures"], 6)


if __name__ == "__main__":
    main()
