"""Outputs: never an input, whole or absent, into streams without a byte too many, and under any name and owner."""

# ctest: COST 400

import contextlib
import glob
import gzip
import json
import os
import resource
import shutil
import signal
import stat
import subprocess
import time
import unittest

import numpy
from program import BIHIVE, PATIENCE_S, ProgramTest, main

XYZ = "3\nwater\nO 0 0 0\nH 0.757 0.586 0\nH -0.757 0.586 0\n"
SMALL = ["--size", "24x16", "--samples", "1"]
PNG_END = b"IEND\xaeB`\x82"
NOBODY = 65534


class OutputTest(ProgramTest):
    def rays(self, name="rays.npy", count=3):
        numpy.save(self.path(name), numpy.ones((count, 6), dtype=numpy.float32))
        return name

    def binary(self, *arguments, **options):
        options.setdefault("stdout", subprocess.PIPE)
        return subprocess.run([BIHIVE, *arguments], cwd=self.folder, stderr=subprocess.PIPE, timeout=PATIENCE_S, **options)

    def as_nobody(self, *arguments):
        """Runs a copy of the program, which other users may read, in a folder that belongs to nobody in particular."""
        program = self.path("program")
        shutil.copy(BIHIVE, program)
        os.chmod(program, 0o755)
        os.chmod(self.folder, 0o777)
        done = subprocess.run([program, *arguments], cwd=self.folder, capture_output=True, text=True, user=NOBODY,
                              group=NOBODY, extra_groups=[])
        os.remove(program)
        return done


class InputAndOutput(OutputTest):
    def test_the_input_is_never_the_output(self):
        self.write("in.xyz", XYZ)
        os.symlink("in.xyz", self.path("soft.xyz"))
        os.link(self.path("in.xyz"), self.path("hard.xyz"))
        for output in ["in.xyz", "./in.xyz", "soft.xyz", "hard.xyz", self.path("in.xyz")]:
            self.assertIn("input", self.fail_input("render", "in.xyz", "-o", output, *SMALL))
        self.rays()
        os.link(self.path("rays.npy"), self.path("more.npy"))
        for output in ["rays.npy", "more.npy"]:
            self.assertIn("input", self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", output, "--id", "i.npy"))
            self.assertIn("input", self.fail_input("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", output))
        self.assertIn("input", self.fail_input("trace", "in.xyz", "--rays", "rays.npy", "--t", "in.xyz", "--id", "i.npy"))

    def test_the_files_that_an_input_names_are_inputs_too(self):
        self.write("in.xyz", XYZ)
        self.write("scene.json", '{"bihive_scene": 1, "spheres": {"file": "in.xyz"}}')
        self.assertIn("in.xyz", self.fail_input("render", "scene.json", "-o", "in.xyz", *SMALL))
        self.write("style.json", "{}")
        self.assertIn("input", self.fail_input("render", "in.xyz", "--style", "style.json", "-o", "style.json", *SMALL))
        self.write("colours.txt", "O #ff0000\n")
        words = ["--element-colours", "colours.txt", "-o", "colours.txt"]
        self.assertIn("input", self.fail_input("render", "in.xyz", *words, *SMALL))

    def test_a_built_in_name_is_no_file(self):
        self.succeed("render", "demo", "-o", "demo", *SMALL)
        self.succeed("render", "demo", "-o", "demo", *SMALL)

    def test_two_outputs_are_two_files(self):
        self.rays()
        self.write("t.npy", "old")
        os.link(self.path("t.npy"), self.path("hard.npy"))
        os.symlink("t.npy", self.path("soft.npy"))
        os.symlink("new.npy", self.path("to_new.npy"))
        for t, i in [("t.npy", "./t.npy"), ("t.npy", "hard.npy"), ("soft.npy", "t.npy"), ("new.npy", "./new.npy"),
                     ("to_new.npy", "new.npy"), ("-", "/dev/stdout")]:
            self.assertIn("same file", self.fail_usage("trace", "demo", "--rays", "rays.npy", "--t", t, "--id", i))


class Streams(OutputTest):
    def picture(self):
        self.succeed("render", "demo", "-o", "whole.png", *SMALL)
        return self.read("whole.png")

    def test_the_standard_output_under_each_of_its_names(self):
        picture = self.picture()
        for name in ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"]:
            done = self.binary("render", "demo", "-o", name, *SMALL)
            self.assertEqual((done.returncode, done.stdout), (0, picture), name)
            self.assertRegex(done.stderr.decode(), r"\A[^\n]+: 24 x 16, 1,631 spheres[^\n]*\n\Z")
            for mode, before in [("wb", b""), ("ab", b"before")]:
                self.write("to", before)
                with open(self.path("to"), mode) as to:
                    self.assertEqual(self.binary("render", "demo", "-o", name, *SMALL, stdout=to).returncode, 0)
                self.assertEqual(self.read("to"), before + picture, (name, mode))
            self.assertIn("--json", self.fail_usage("render", "demo", "-o", name, "--json", *SMALL))

    def test_another_open_file_goes_on_where_it_stands(self):
        picture = self.picture()
        self.write("log", b"before")
        with open(self.path("log"), "ab") as log:
            name = f"/dev/fd/{log.fileno()}"
            done = self.binary("render", "demo", "-o", name, *SMALL, "--json", pass_fds=[log.fileno()])
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(json.loads(done.stdout)["size"], "24x16")
        self.assertEqual(self.read("log"), b"before" + picture)

    def test_other_commands(self):
        scene = self.binary("scene", "four-spheres", "-o", "-")
        self.succeed("scene", "four-spheres", "-o", "four.json")
        self.assertEqual(scene.stdout, self.read("four.json"))
        self.assertIn(b"4 spheres", scene.stderr)
        self.rays()
        traced = self.binary("trace", "demo", "--rays", "rays.npy", "--t", "-", "--id", "id.npy")
        self.succeed("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy")
        self.assertEqual(traced.stdout, self.read("t.npy"))
        self.assertFalse(os.path.exists(self.path("-")))

    def test_the_file_of_the_standard_output(self):
        with open(self.path("a.png"), "wb") as to:
            done = self.binary("render", "demo", "-o", "a.png", *SMALL, stdout=to)
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"standard output", done.stderr)

    def test_a_closed_stream_is_not_the_next_file(self):
        self.write("far.csv", "x,y,z,r\n1e8,0,0,1\n1e8,3,0,1\n")  # rounding is warned about, on stderr
        self.run_bihive("render", "far.csv", "-o", "whole.png", *SMALL)
        for closed in [(1,), (2,), (1, 2), (0, 1, 2)]:
            done = subprocess.run([BIHIVE, "render", "far.csv", "-o", "a.png", *SMALL], cwd=self.folder, timeout=PATIENCE_S,
                                  preexec_fn=lambda: [os.close(stream) for stream in closed], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
            self.assertEqual(done.returncode, 1 if 1 in closed else 0, closed)
            self.assertEqual(self.read("a.png"), self.read("whole.png"), closed)
            os.remove(self.path("a.png"))
        done = self.run_bihive("render", "demo", "-o", "-", *SMALL, stdout=None, preexec_fn=lambda: os.close(1))
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot be written", done.stderr)

    def test_the_standard_input(self):
        self.write("in.xyz", XYZ)
        self.write("in.xyz.gz", gzip.compress(XYZ.encode()))
        self.write("scene.json", '{"bihive_scene": 1, "spheres": {"file": "in.xyz"}}')
        for name in ["in.xyz", "in.xyz.gz", "scene.json"]:
            expected = self.succeed_json("info", name)
            with open(self.path(name), "rb") as file:
                done = self.binary("info", "-", "--json", stdin=file)
            self.assertEqual((done.returncode, done.stderr), (0, b""), name)
            self.assertEqual(json.loads(done.stdout)["spheres"], expected["spheres"])
            piped = self.binary("info", "-", "--json", input=self.read(name))
            self.assertEqual(piped.stdout, done.stdout)
        for words in [["render", "-", "-o", "-", *SMALL], ["stats", "-"], ["select", "-", "element O"]]:
            self.assertEqual(self.binary(*words, input=XYZ.encode()).returncode, 0, words)
        self.rays()
        trace = ["trace", "demo", "--rays", "-", "--t", "t.npy", "--id", "id.npy"]
        self.assertEqual(self.binary(*trace, input=self.read("rays.npy")).returncode, 0)
        self.assertIn("--rays", self.fail_usage("trace", "-", "--rays", "-", "--t", "t.npy", "--id", "i.npy"))
        self.assertIn("standard input", self.fail_usage("web", "-"))
        empty = self.binary("info", "-", stdin=subprocess.DEVNULL)
        self.assertEqual(empty.returncode, 1)
        self.assertIn(b"standard input: ", empty.stderr)
        rays = self.binary(*trace, input=b"no rays")
        self.assertEqual(rays.returncode, 1)
        self.assertIn(b"error: standard input: ", rays.stderr)

    def test_two_outputs_on_the_standard_output(self):
        self.rays()
        for first, second in [("-", "/dev/stdout"), ("/dev/stdout", "-")]:
            error = self.fail_usage("trace", "demo", "--rays", "rays.npy", "--t", first, "--id", second)
            self.assertIn(f"two outputs name the same file: {first} and {second}", error)


class Pipes(OutputTest):
    def commands(self):
        self.rays(count=200000)
        return [["render", "demo", "-o", "fifo", "--size", "600x600", "--samples", "1", "--bits", "16"],
                ["scene", "scenario1", "--count", "200000", "-o", "fifo.npy"],
                ["trace", "demo", "--rays", "rays.npy", "--t", "fifo", "--id", "id.npy"]]

    def work_until_blocked(self, process):
        """Waits until all threads of the program sleep, and returns the processor time that it has used. A thread that
        works is in another state, also while a busy machine has no processor for it."""
        folder, rounds, used = f"/proc/{process.pid}", 0, None
        while rounds < 10 and process.poll() is None:
            states = set()
            for task in os.listdir(folder + "/task"):
                with contextlib.suppress(OSError):
                    states.add(self.stat_fields(f"{folder}/task/{task}")[0])
            now = sum(map(int, self.stat_fields(folder)[11:13]))
            rounds = rounds + 1 if states == {"S"} and now == used else 0
            used = now
            time.sleep(0.02)
        self.assertIsNone(process.poll())
        return used / os.sysconf("SC_CLK_TCK")

    def stat_fields(self, folder):
        with open(folder + "/stat") as file:
            return file.read().rsplit(")", 1)[1].split()

    def time_of_children(self):
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    def test_signals_end_it(self):
        for name in ["fifo", "fifo.npy"]:
            os.mkfifo(self.path(name))
        for reader in [False, True]:
            for command in self.commands():
                for number in [signal.SIGINT, signal.SIGTERM]:
                    name = self.path("fifo.npy" if "fifo.npy" in command else "fifo")
                    opened = os.open(name, os.O_RDONLY | os.O_NONBLOCK) if reader else None
                    process = subprocess.Popen([BIHIVE, *command], cwd=self.folder, stdout=subprocess.PIPE,
                                               stderr=subprocess.PIPE)
                    used = self.work_until_blocked(process)
                    before = self.time_of_children()
                    process.send_signal(number)
                    process.wait(timeout=PATIENCE_S)
                    # It ends at once: processor time, of which a busy machine takes no more. A slow machine and a sanitizer
                    # take more, as they did until here.
                    self.assertLess(self.time_of_children() - before - used, 0.5 + used, command)
                    self.assertEqual(process.returncode, 128 + number, command)
                    self.assertEqual(process.communicate(), (b"", b""))
                    if opened is not None:
                        os.close(opened)
        self.assertEqual(sorted(os.listdir(self.folder)), ["fifo", "fifo.npy", "rays.npy"])

    def test_a_reader_gets_everything(self):
        os.mkfifo(self.path("fifo"))
        self.succeed("render", "demo", "-o", "a.png", *SMALL)
        process = subprocess.Popen([BIHIVE, "render", "demo", "-o", "fifo", *SMALL], cwd=self.folder,
                                   stdout=subprocess.DEVNULL)
        self.assertEqual(self.read("fifo"), self.read("a.png"))
        self.assertEqual(process.wait(timeout=PATIENCE_S), 0)


class Names(OutputTest):
    HOSTILE = "a\x1b[31m\nb\u009b1m\x1b]0;title\x07\u202ec\xad.xyz"

    def assert_harmless(self, text):
        for character in text:
            code = ord(character)
            self.assertFalse(code < 0x20 and character != "\n" or 0x7F <= code < 0xA0 or 0x202A <= code <= 0x202E, text)

    def test_no_name_reaches_the_terminal_raw(self):
        self.write(self.HOSTILE, XYZ)
        raw = "bad\udc9b31m\udcff.xyz"
        self.write(raw, XYZ)
        self.rays()
        for name in [self.HOSTILE, raw]:
            self.write(name + "bad", "no spheres")
            commands = [["info", name], ["info", name, "--attributes"], ["stats", name], ["select", name, "all"],
                        ["render", name, "-o", name + ".png", *SMALL], ["scene", "four-spheres", "-o", name + ".json"],
                        ["trace", name, "--rays", "rays.npy", "--t", name + "t", "--id", name + "i"],
                        ["info", name + "missing"], ["render", name, "-o", name], ["frobnicate" + name],
                        ["render", name, "-o", "a.png", "--view", name], ["select", name, "name " + name],
                        ["render", name, "-o", name + ".png", "--style", name],
                        ["thesis", "figure-4.1", "--out", "r", "--values", name], ["convert", name, "-o", name + ".csv"],
                        ["film", name, "-o", name + ".y4m", "--pictures", "1", *SMALL], ["film", name, "-o", name],
                        ["view", name + "missing"], ["view", name + "bad"], ["view", name, "--screenshot", name + "/a.png"], ["web", name + "missing"]]
            for command in commands:
                done = self.binary(*command)
                with self.subTest(command):
                    self.assert_harmless(done.stdout.decode())
                    self.assert_harmless(done.stderr.decode())
                    if done.returncode == 0 and command[0] in ["render", "scene", "trace"]:
                        self.assertEqual(done.stdout.count(b"\n"), 1)

    def test_long_names(self):
        for length in [240, 249, 250, 251, 252, 255]:
            name = "p" * (length - 4) + ".png"
            self.succeed("render", "demo", "-o", name, *SMALL)
            self.assertTrue(self.read(name).endswith(PNG_END))
        self.rays()
        self.succeed("trace", "demo", "--rays", "rays.npy", "--t", "t" * 255, "--id", "i" * 255)
        self.assertIn("too long", self.fail_input("render", "scenario3", "-o", "p" * 256))

    def test_names_of_other_formats(self):
        for ending in ["jpg", "JPEG", "ppm", "svg", "pdf", "webp"]:
            self.assertIn("PNG, TIFF and OpenEXR", self.fail_usage("render", "demo", "-o", "a." + ending))
            self.assertIn("PNG, TIFF and OpenEXR", self.fail_usage("view", "demo", "--screenshot", "a." + ending))
        for ending in ["gif", "apng", "mp4"]:
            self.assertIn("bihive film", self.fail_usage("render", "demo", "-o", "a." + ending))
        for ending in ["exr", "tif", "TIFF"]:
            self.assertIn("PNG", self.fail_usage("view", "demo", "--screenshot", "a." + ending))
        self.succeed("render", "demo", "-o", "picture", *SMALL)


class Replacing(OutputTest):
    def test_a_link_to_nothing_is_followed(self):
        os.mkdir(self.path("folder"))
        os.symlink("folder/new.png", self.path("link.png"))
        self.succeed("render", "demo", "-o", "link.png", *SMALL)
        self.assertTrue(os.path.islink(self.path("link.png")))
        self.assertTrue(self.read("folder/new.png").endswith(PNG_END))
        os.symlink("missing/new.png", self.path("nowhere.png"))
        self.assertIn("missing", self.fail_input("render", "demo", "-o", "nowhere.png", *SMALL))
        os.symlink("loop.png", self.path("loop.png"))
        self.assertIn("links", self.fail_input("render", "demo", "-o", "loop.png", *SMALL))

    def let_write(self, process, folder):
        """Waits until the program has written bytes of a file in this folder."""
        while process.poll() is None:
            for name in glob.glob(f"/proc/{process.pid}/fd/*"):
                with contextlib.suppress(OSError):
                    if os.readlink(name).startswith(folder) and os.stat(name).st_size > 0:
                        return
            time.sleep(0.01)
        self.fail("the work was over too early for this test")

    def test_sigkill_leaves_nothing(self):
        """Where the file system has files without names; /dev/shm has."""
        folder = subprocess.run(["mktemp", "-d", "/dev/shm/bihive_XXXXXX"], capture_output=True, text=True).stdout.strip()
        self.addCleanup(shutil.rmtree, folder)
        environment = {**os.environ, "BIHIVE_MEMORY": "4000000"}
        process = subprocess.Popen([BIHIVE, "render", "scenario3", "--size", "4000x4000", "--samples", "64", "-o",
                                    folder + "/a.png"], env=environment, stdout=subprocess.DEVNULL)
        self.let_write(process, folder)
        process.kill()
        process.wait(timeout=PATIENCE_S)
        self.assertEqual(os.listdir(folder), [])

    def test_a_planted_link_is_not_followed(self):
        """A name that others can guess is no name for root's new files."""
        self.write("victim", "old")
        self.rays()
        pid = os.getpid()
        for guess in range(pid, pid + 3000):
            os.symlink("victim", self.path(f"t.npy.{guess}.part"))
        self.succeed("trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy")
        self.assertEqual(self.read("victim"), b"old")

    def test_owner_and_permissions(self):
        self.write("a.png", "old")
        if os.getuid() == 0:
            os.chown(self.path("a.png"), NOBODY, NOBODY)
        before = os.stat(self.path("a.png"))
        os.chmod(self.path("a.png"), 0o6754)
        self.succeed("render", "demo", "-o", "a.png", *SMALL)
        after = os.stat(self.path("a.png"))
        self.assertEqual((after.st_uid, after.st_gid), (before.st_uid, before.st_gid))
        self.assertEqual(stat.S_IMODE(after.st_mode), 0o754)

    @unittest.skipIf(os.getuid() != 0, "needs root, to be two users")
    def test_files_of_others(self):
        # In a folder of everybody, a link of somebody else may lead anywhere.
        os.mkdir(self.path("tmp"))
        os.symlink(self.path("victim.png"), self.path("tmp/a.png"))
        os.lchown(self.path("tmp/a.png"), NOBODY, NOBODY)
        self.write("victim.png", "old")
        for mode in (0o777, 0o1777):
            os.chmod(self.path("tmp"), mode)
            self.assertIn("link", self.fail_input("render", "demo", "-o", "tmp/a.png", *SMALL))
            self.assertEqual(self.read("victim.png"), b"old")
        # A sticky folder, and one of everybody: both are said before the work.
        self.write("tmp/b.png", "old")
        self.write("c.png", "old")
        for name in ["tmp/b.png", "c.png"]:
            os.chmod(self.path(name), 0o666)
            done = self.as_nobody("render", "scenario3", "--size", "9000x9000", "-o", name)
            self.assertEqual(done.returncode, 1)
            self.assert_one_error_line(done.stderr)
            self.assertIn("somebody else", done.stderr)
            self.assertEqual(self.read(name), b"old")

    def test_an_append_only_folder(self):
        os.mkdir(self.path("log"))
        mark = ["chattr", "+a", self.path("log")]
        if shutil.which("chattr") is None or subprocess.run(mark, capture_output=True).returncode != 0:
            self.skipTest("chattr does not work here")
        try:
            self.assertIn("append-only", self.fail_input("render", "scenario3", "-o", "log/a.png", "--size", "9000x9000"))
        finally:
            subprocess.run(["chattr", "-a", self.path("log")])

    def test_a_mount_point_is_written_in_place(self):
        self.write("inside.png", "x" * 100000)
        self.write("outside.png", "old")
        mount = 'mount --bind "$0/outside.png" "$0/inside.png" && '
        probe = subprocess.run(["unshare", "-rm", "sh", "-c", mount + "true", self.folder], capture_output=True, text=True)
        if probe.returncode != 0:
            self.skipTest("mounting is not permitted here: " + probe.stderr.strip())
        script = mount + 'cd "$0" && "$@"'
        words = ["render", "demo", "-o", "inside.png", *SMALL]
        done = subprocess.run(["unshare", "-rm", "sh", "-c", script, self.folder, BIHIVE, *words], capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.succeed("render", "demo", "-o", "a.png", *SMALL)
        self.assertEqual(self.read("outside.png"), self.read("a.png"))
        self.assertEqual(self.read("inside.png"), b"x" * 100000)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.png", "inside.png", "outside.png"])

    def test_every_other_output_may_be_a_mount_point(self):
        self.write("in.xyz", XYZ)
        self.rays()
        for words, names in [(["convert", "in.xyz", "-o", "a.csv"], ["a.csv"]), (["scene", "four-spheres", "-o", "a.json"], ["a.json"]),
                             (["trace", "in.xyz", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy"], ["t.npy", "id.npy"]),
                             (["trace", "in.xyz", "--rays", "rays.npy", "--t", "t.npy", "--id", "free.npy"], ["t.npy"]),
                             (["render", "in.xyz", "-o", "a.exr", *SMALL], ["a.exr"])]:
            self.succeed(*words)
            written = {name: self.read(name) for name in [*names, "free.npy"] if os.path.exists(self.path(name))}
            for name in names:
                self.write("outside." + name, "old" * 10000)
            mount = "".join(f'mount --bind "$0/outside.{name}" "$0/{name}" && ' for name in names)
            done = subprocess.run(["unshare", "-rm", "sh", "-c", mount + 'cd "$0" && "$@"', self.folder, BIHIVE, *words],
                                  capture_output=True, text=True)
            if "mount" in done.stderr or "unshare" in done.stderr:
                self.skipTest("mounting is not permitted here: " + done.stderr.strip())
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            for name, data in written.items():
                self.assertEqual(self.read("outside." + name if name in names else name), data, words)
            for name in [*written, *("outside." + name for name in names)]:
                os.remove(self.path(name))
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.xyz", "rays.npy"])


if __name__ == "__main__":
    main()
