"""Inputs that are small and ask for much, or are not quite what they seem."""

# ctest: COST 300

import contextlib
import signal
import gzip
import json
import os
import struct
import subprocess

import numpy
from program import ProgramTest, main, png_pixels

XYZ = "2\n\nO 0 0 0\nC 1 1 1\n"
SMALL = ["--size", "24x16", "--samples", "1"]


class Sizes(ProgramTest):
    def test_an_array_without_numbers(self):
        """81 bytes, and a side that nobody counts up to."""
        head = b"{'descr': '<f4', 'fortran_order': True, 'shape': (0, 1099511627776), }\n"
        self.write("empty.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head)
        self.assertIn("shape", self.fail_input("info", "empty.npy"))
        self.assertIn("shape", self.fail_input("trace", "demo", "--rays", "empty.npy", "--t", "t.npy", "--id", "i.npy"))

    def test_packed_bombs(self):
        """Half a gigabyte, packed in half a megabyte: text of spheres, zeros of an array, blanks of a scene."""
        # Beside what the program takes for one sphere: 10 MB, with the address sanitizer 160 MB.
        self.write("one.txt", "0 0 0 1\n")
        empty_bytes = self.peak("info", "one.txt")[3]
        for name, begin, piece in [("a.txt.gz", b"", b"0 0 0 1\n"), ("b.json.gz", b"{", b" " * 8)]:
            with gzip.open(self.path(name), "wb", compresslevel=1) as file:
                file.write(begin)
                for _ in range(128):
                    file.write(piece * (1 << 19))
            code, out, err, bytes_used = self.peak("info", name, BIHIVE_MEMORY="200000000")
            self.assertEqual((code, out), (1, ""))
            self.assert_one_error_line(err)
            self.assertIn("BIHIVE_MEMORY allows 200 MB", err)
            self.assertLess(bytes_used - empty_bytes, 440e6, name)

    def test_an_input_without_end(self):
        """What is read, and the room that it moves into, stay below the limit together."""
        code, out, err, bytes_used = self.peak("info", "/dev/zero", BIHIVE_MEMORY="120000000")
        self.assertEqual((code, out), (1, ""))
        self.assert_one_error_line(err)
        self.assertIn("/dev/zero: what is read would take about", err)
        self.write("one.txt", "0 0 0 1\n")
        self.assertLess(bytes_used - self.peak("info", "one.txt")[3], 125e6)

    def test_rows_are_counted(self):
        """What fits as text need not fit as numbers."""
        self.write("many.txt", "0 0 0 1\n" * 2000000)
        code, _, err, bytes_used = self.peak("info", "many.txt", BIHIVE_MEMORY="20000000")
        self.assertEqual(code, 1)
        self.assertIn("BIHIVE_MEMORY allows 20 MB", err)
        # Beside what the program takes for one sphere: 10 MB, with the address sanitizer 160 MB.
        self.write("one.txt", "0 0 0 1\n")
        self.assertLess(bytes_used - self.peak("info", "one.txt")[3], 60e6)
        numpy.save(self.path("many.npy"), numpy.zeros((1000000, 4), dtype=numpy.float32))
        code, _, err, _ = self.peak("info", "many.npy", BIHIVE_MEMORY="20000000")
        self.assertEqual(code, 1)
        self.assertIn("BIHIVE_MEMORY allows 20 MB", err)

    def test_a_control_group(self):
        """The limit of a container, where this machine lets the test make one. The address sanitizer alone takes 160 MB and more."""
        folder = f"/sys/fs/cgroup/bihive_test_{os.getpid()}"
        name = "memory.max"
        if os.path.isdir("/sys/fs/cgroup/memory"):
            folder, name = f"/sys/fs/cgroup/memory/bihive_test_{os.getpid()}", "memory.limit_in_bytes"
        try:
            os.mkdir(folder)
            with open(os.path.join(folder, name), "w") as file:
                file.write("400000000")
        except OSError as error:
            if os.path.isdir(folder):
                os.rmdir(folder)
            self.skipTest(f"no control group can be made: {error}")
        self.addCleanup(os.rmdir, folder)

        def enter():
            with open(os.path.join(folder, "cgroup.procs"), "w") as file:
                file.write(str(os.getpid()))

        said = self.fail_input("info", "scenario1", "--count", "40000000", preexec_fn=enter)
        self.assertIn("this control group, which allows", said)

    def while_it_grows(self, name):
        """The first error text of `bihive info` that tells of a file that grows."""
        self.write("grows.txt", "0 0 0 1\n" * 400000)
        writer = subprocess.Popen(
            ["sh", "-c", "exec yes '1 1 1 1' | head -c 2000000000 >> grows.txt"],
            cwd=self.folder,
            start_new_session=True,
        )
        try:
            for _ in range(20):
                with open(self.path("grows.txt")) as file:
                    done = self.run_bihive("info", name, stdin=file)
                self.assertIn(done.returncode, (0, 1))
                if "grew while it was read" in done.stderr:
                    return done.stderr
            return self.fail("the file grew, and nobody said so")
        finally:
            # Both programs of the pipe.
            with contextlib.suppress(ProcessLookupError):
                os.killpg(writer.pid, signal.SIGKILL)
            writer.wait()

    def test_a_file_that_grows(self):
        self.assertIn("warning: grows.txt: grew", self.while_it_grows("grows.txt"))
        self.assertIn("warning: standard input: grew", self.while_it_grows("-"))


class Documents(ProgramTest):
    def test_a_packed_scene(self):
        self.write("in.xyz", XYZ)
        document = '{"bihive_scene": 1, "spheres": {"file": "in.xyz"}, "background": [0, 0, 0]}'
        self.write("scene.json", document)
        self.write("scene.json.gz", gzip.compress(document.encode()))
        plain, packed = [self.succeed_json("info", name) for name in ["scene.json", "scene.json.gz"]]
        self.assertEqual({**plain, "name": ""}, {**packed, "name": ""})
        for name in ["scene.json", "scene.json.gz"]:
            self.succeed("render", name, "-o", name + ".png", *SMALL)
        plain, packed = [png_pixels(self.read(name + ".png")) for name in ["scene.json", "scene.json.gz"]]
        self.assertEqual(plain, packed)
        self.write("style.json.gz", gzip.compress(b"{"))
        self.assertIn("cut", self.fail_input("info", "style.json.gz"))

    def test_no_name_ends_at_a_nul(self):
        self.write("in.xyz", XYZ)
        self.write("nul.json", r'{"bihive_scene": 1, "spheres": {"file": "in.xyz\u0000.bak"}}')
        said = self.fail_input("info", "nul.json")
        self.assertIn(r"in.xyz\u0000.bak", said)
        self.assertIn("NUL", said)
        self.write("key.json", r'{"bihive_scene": 1, "na\u0000me": "x", "spheres": []}')
        self.assertIn("NUL", self.fail_input("info", "key.json"))

    def test_an_angle_that_shows_nothing(self):
        for degrees in ["1e-300", "1e-200", "1e-38"]:
            self.assertIn("--fov", self.fail_usage("render", "demo", "-o", "a.png", "--fov", degrees, *SMALL))
        self.succeed("render", "demo", "-o", "a.png", "--fov", "0.001", *SMALL)


class Thesis(ProgramTest):
    def test_values_that_are_not_there(self):
        words = ["thesis", "figure-4.1", "--quick", "--out", "out", "--values"]
        self.assertIn("missing", self.fail_input(*words, "missing"))
        os.mkdir(self.path("values"))
        self.assertIn("figure-4.1", self.fail_input(*words, "values"))
        self.assertIn("no values", self.fail_input("thesis", "all", "--quick", "--out", "out", "--values", "values"))
        self.write("file", "x")
        self.assertIn("file", self.fail_input(*words, "file"))

    def test_steps_that_this_program_did_not_write(self):
        words = ["thesis", "table-4.2", "--quick", "--out", "out"]
        self.succeed(*words)
        folder = self.path("out/steps/table-4.2")
        for name in os.listdir(folder):
            with open(os.path.join(folder, name)) as file:
                document = json.load(file)
            document["result"] = {"wrong": [None]}
            with open(os.path.join(folder, name), "w") as file:
                json.dump(document, file)
        done = self.run_bihive(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"\Abihive: warning: [^\n]*steps/table-4.2[^\n]*\n\Z")
        self.assertNotIn("missing", done.stdout)


if __name__ == "__main__":
    main()
