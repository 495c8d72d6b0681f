"""Ctrl-C, full disks and paths that may not be written: no partial file is left."""

import os
import pty
import re
import resource
import select
import shutil
import signal
import stat
import subprocess
import time
import unittest

import numpy
from program import BIHIVE, PATIENCE_S, ProgramTest, main

LONG = ["scenario3", "--size", "4000x4000", "--samples", "64", "--shadows"]


class Interrupt(ProgramTest):
    def interrupted(self, arguments, delay_s, number=signal.SIGINT, **options):
        """Runs the program, sends the signal after this much work, and returns exit code, stdout and stderr."""
        process = subprocess.Popen(
            [BIHIVE, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
        )
        self.let_work(process, delay_s)
        self.assertIsNone(process.poll(), "the work was over too early for this test")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process.send_signal(number)
        out, err = process.communicate(timeout=PATIENCE_S)
        # Processor time, of which a busy machine takes no more. The whole work would take minutes.
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime - delay_s, 30)
        return process.returncode, out, err

    def test_a_long_render_leaves_no_file(self):
        before = self.contents()
        for delay_s in [0.3, 1.5]:
            self.assertEqual(self.interrupted(["render", *LONG, "-o", "a.png"], delay_s), (130, "", ""))
            self.assertEqual(self.contents(), before)

    def test_a_picture_in_bands_leaves_no_file(self):
        self.write("a.png", "old")
        before = self.contents()
        environment = {**os.environ, "BIHIVE_MEMORY": "4000000"}
        self.assertEqual(self.interrupted(["render", *LONG, "-o", "a.png"], 5, env=environment), (130, "", ""))
        self.assertEqual(self.contents(), before)

    def test_an_old_picture_stays(self):
        self.write("a.png", "old")
        self.assertEqual(self.interrupted(["render", *LONG, "-o", "a.png", "--json"], 0.5), (130, "", ""))
        self.assertEqual(self.read("a.png"), b"old")

    def test_other_signals_end_it_too(self):
        for number in [signal.SIGTERM, signal.SIGHUP]:
            code, out, err = self.interrupted(["render", *LONG, "-o", "a.png"], 0.5, number)
            self.assertEqual((code, out, err), (128 + number, "", ""))
            self.assertEqual(self.contents(), {})

    def test_a_long_trace_leaves_no_file(self):
        rays = numpy.zeros((300000, 6), dtype=numpy.float32)
        rays[:, 2] = 100
        rays[:, 3:] = numpy.random.default_rng(1).uniform(-20, 20, (len(rays), 3)) - [0, 0, 100]
        numpy.save(self.path("rays.npy"), rays)
        # Each ray meets all spheres here, so a chunk must be smaller if there are more spheres.
        command = ["trace", "scenario3", "--count", "20000", "--radius", "0.1", "--engine", "brute", "--threads", "1"]
        files = ["--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy"]
        self.assertEqual(self.interrupted(command + files, 0.5), (130, "", ""))
        self.assertEqual(os.listdir(self.folder), ["rays.npy"])

    def test_a_signal_that_comes_twice_is_one_request(self):
        # The report of the finished steps is still written; a second signal that counted would have prevented that. On
        # a busy machine the two signals can come too far apart, so the test makes several attempts.
        for attempt in range(10):
            folder = f"report{attempt}"
            process = subprocess.Popen([BIHIVE, "thesis", "figure-4.4", "--out", folder], cwd=self.folder)
            self.let_work(process, 0)
            # The steps begin after the command line and the machine have been looked at, seconds of work with sanitizers.
            while process.poll() is None and not os.path.exists(self.path(f"{folder}/steps")):
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=PATIENCE_S), 130)
            if os.path.exists(self.path(f"{folder}/report.html")):
                return
        self.fail("no report after a signal that came twice, ten times")

    def test_a_terminal_shows_progress_and_is_left_clean(self):
        screen, terminal = pty.openpty()
        process = subprocess.Popen(
            [BIHIVE, "render", *LONG, "-o", "a.png"], cwd=self.folder, stdout=subprocess.PIPE, stderr=terminal
        )
        os.close(terminal)
        progress = re.compile(rb"rendering \[#* *\] +\d+ % [\d.]+ (s|min \d+ s) left")
        shown = b""
        while not progress.search(shown):
            self.assertTrue(select.select([screen], [], [], PATIENCE_S)[0], shown)
            shown += os.read(screen, 4096)
        process.send_signal(signal.SIGINT)
        self.assertEqual((process.communicate(timeout=PATIENCE_S)[0], process.returncode), (b"", 130))
        try:
            while chunk := os.read(screen, 4096):
                shown += chunk
        except OSError:
            pass  # the terminal's other end is closed
        os.close(screen)
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-60:])

    def test_progress_is_for_terminals(self):
        done = self.run_bihive("render", "scenario1", "--size", "700x700", "--samples", "4", "-o", "a.png")
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class FullDisk(ProgramTest):
    def commands(self):
        rays = numpy.ones((4000, 6), dtype=numpy.float32)
        numpy.save(self.path("rays.npy"), rays)
        return [
            ["render", "scenario3", "--view", "id", "--size", "300x300", "-o", "out.png"],
            ["scene", "scenario1", "-o", "out.npy"],
            ["scene", "scenario1", "-o", "out.json"],
            ["trace", "demo", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy"],
        ]

    def test_a_device_that_is_full(self):
        for name in ["out.png", "out.npy", "out.json"]:
            os.symlink("/dev/full", self.path(name))
        for command in self.commands()[:3]:
            done = self.run_bihive(*command)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertRegex(done.stderr, r"\Abihive: error: [^\n]*No space left on device[^\n]*\n\Z")

    def test_a_limit_on_file_sizes(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        for command in self.commands():
            self.assertIn("File too large", self.fail_input(*command, preexec_fn=limit))

    def test_a_disk_without_room(self):
        # A disk of 48 kB in its own mount namespace: room for t.npy (32 kB), but not for id.npy too.
        disk = self.path("disk")
        os.mkdir(disk)
        mount = 'mount -t tmpfs -o size=48k none "$0" && '
        probe = subprocess.run(["unshare", "-rm", "sh", "-c", mount + "true", disk], capture_output=True, text=True)
        if probe.returncode != 0:
            self.skipTest("mounting is not permitted here: " + probe.stderr.strip())
        for command in self.commands():
            script = mount + 'cd "$0" && echo old > old && "$@"; echo "exit code $?"; ls -A; cat old'
            absolute = [self.path(word) if word == "rays.npy" else word for word in command]
            done = subprocess.run(["unshare", "-rm", "sh", "-c", script, disk, BIHIVE, *absolute], capture_output=True, text=True)
            self.assertEqual(done.stdout, "exit code 1\nold\nold\n", done.stderr)
            self.assertRegex(done.stderr, r"\Abihive: error: [^\n]*No space left on device[^\n]*\n\Z")


class Unwritable(ProgramTest):
    """A folder and a file without permission. Root may write anywhere, so root runs these as another user."""

    def run_as_user(self, *arguments):
        if os.getuid() != 0:
            return self.run_bihive(*arguments)
        # Other users may not be allowed to read the program's folder; a copy is readable.
        program = self.path("program")
        if not os.path.exists(program):
            shutil.copy(BIHIVE, program)
            os.chmod(program, 0o755)
        return subprocess.run(
            [program, *arguments], cwd=self.folder, capture_output=True, text=True, user=65534, group=65534, extra_groups=[]
        )

    def expect_denied(self, *arguments):
        before = self.contents()
        done = self.run_as_user(*arguments)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertRegex(done.stderr, r"\Abihive: error: [^\n]*Permission denied[^\n]*\n\Z")
        self.assertEqual({name: data for name, data in self.contents().items() if not name.endswith("/program")},
                         {name: data for name, data in before.items() if not name.endswith("/program")})

    def setUp(self):
        super().setUp()
        os.chmod(self.folder, 0o755)
        os.mkdir(self.path("closed"))
        os.chmod(self.path("closed"), 0o555)
        self.addCleanup(os.chmod, self.path("closed"), 0o755)
        self.write("locked.png", "old")
        os.chmod(self.path("locked.png"), stat.S_IRUSR | stat.S_IRGRP | stat.S_IROTH)
        self.write("secret.xyz", "1\n\nC 0 0 0\n")
        os.chmod(self.path("secret.xyz"), 0)

    def test_a_folder_that_may_not_be_written(self):
        self.expect_denied("render", "demo", "-o", "closed/a.png", "--size", "8x8")
        self.expect_denied("scene", "scenario1", "-o", "closed/a.npy")

    def test_a_file_that_may_not_be_written(self):
        self.expect_denied("render", "demo", "-o", "locked.png", "--size", "8x8")

    def test_a_file_that_may_not_be_read(self):
        if os.getuid() == 0:
            self.expect_denied("info", "secret.xyz")
        else:
            done = self.run_bihive("info", "secret.xyz")
            self.assertEqual(done.returncode, 1)
            self.assertIn("Permission denied", done.stderr)


if __name__ == "__main__":
    main()
