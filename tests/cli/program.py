"""Helpers of the program's tests: they run it, make scratch folders, and read PNG chunks."""

import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

BIHIVE = os.environ.get("BIHIVE", "bihive")
# How long a test waits for what must come: long, for other work may keep the machine busy.
PATIENCE_S = 600


def is_sanitized():
    """Whether this build is of the address sanitizer, whose run-time reserves terabytes. False where it cannot be told."""
    if shutil.which("prlimit") is None:
        return False
    return subprocess.run(["prlimit", "--as=4000000000", BIHIVE, "--version"], capture_output=True).returncode != 0


class ProgramTest(unittest.TestCase):
    """Each test runs in an empty folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="bihive_cli_")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def contents(self):
        """Every path below the folder, with its bytes; None if it is not a regular file."""
        found = {}
        for top, folders, files in os.walk(self.folder):
            for name in folders + files:
                path = os.path.join(top, name)
                found[path] = None
                if os.path.isfile(path) and os.access(path, os.R_OK):
                    with open(path, "rb") as file:
                        found[path] = file.read()
        return found

    def let_work(self, process, seconds):
        """Waits until a program has used so much processor time, as a busy machine takes longer, and handles Ctrl-C."""
        ticks = os.sysconf("SC_CLK_TCK")
        interrupt = 1 << (signal.SIGINT - 1)
        while process.poll() is None:
            with open(f"/proc/{process.pid}/stat") as stat_file:
                used = stat_file.read().rsplit(")", 1)[1].split()[11:13]
            with open(f"/proc/{process.pid}/status") as status_file:
                handled = [line for line in status_file if line.startswith("SigCgt:")]
            if sum(map(int, used)) >= seconds * ticks and handled and int(handled[0].split()[1], 16) & interrupt:
                return
            time.sleep(0.01)

    def run_bihive(self, *arguments, **options):
        """The finished process; stdout and stderr are text."""
        options.setdefault("cwd", self.folder)
        options.setdefault("stdout", subprocess.PIPE)
        return subprocess.run([BIHIVE, *arguments], stderr=subprocess.PIPE, text=True, timeout=PATIENCE_S, **options)

    def succeed(self, *arguments):
        """Runs the program, demands exit code 0 and an empty stderr, and returns stdout."""
        done = self.run_bihive(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def succeed_json(self, *arguments):
        """The same with one JSON object, and nothing else, on stdout."""
        value = json.loads(self.succeed(*arguments, "--json"))
        self.assertIsInstance(value, dict)
        return value

    def peak(self, *words, **environment):
        """The finished process, and the most memory that it had, in bytes."""
        # A build with the address sanitizer keeps 256 MB of what was freed, to find its use: here it counts as the program's.
        environment["ASAN_OPTIONS"] = ":".join(filter(None, [os.environ.get("ASAN_OPTIONS"), "quarantine_size_mb=0", "thread_local_quarantine_size_kb=0"]))
        script = ("import json, resource, subprocess, sys; done = subprocess.run(sys.argv[1:], capture_output=True, text=True); "
                  "print(json.dumps([done.returncode, done.stdout, done.stderr, "
                  "resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss]))")
        done = subprocess.run([sys.executable, "-c", script, BIHIVE, *words], cwd=self.folder, capture_output=True, text=True,
                              timeout=PATIENCE_S, env={**os.environ, **environment})
        code, out, err, kilobytes = json.loads(done.stdout)
        return code, out, err, kilobytes * 1024

    def assert_one_error_line(self, stderr, arguments=()):
        self.assertRegex(stderr, r"\Abihive: error: [^\n]+\n\Z", arguments)

    def fail_with(self, code, *arguments, **options):
        """Demands this exit code, one clear line on stderr, nothing on stdout, and an unchanged folder. Returns the
        line's text."""
        before = self.contents()
        done = self.run_bihive(*arguments, **options)
        self.assertEqual(done.returncode, code, (arguments, done.stderr))
        self.assertEqual(done.stdout, "", arguments)
        self.assert_one_error_line(done.stderr, arguments)
        self.assertEqual(self.contents(), before, arguments)
        return done.stderr[len("bihive: error: ") : -1]

    def fail_usage(self, *arguments):
        return self.fail_with(2, *arguments)

    def fail_input(self, *arguments, **options):
        return self.fail_with(1, *arguments, **options)


def png_chunks(data):
    """(type, bytes) of each chunk; checks signature and check sums."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG"
    chunks = []
    at = 8
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        (check,) = struct.unpack(">I", data[at + 8 + size : at + 12 + size])
        assert check == zlib.crc32(kind + body), kind
        chunks.append((kind.decode(), body))
        at += 12 + size
    return chunks


def png_size(data):
    return struct.unpack(">II", dict(png_chunks(data))["IHDR"][:8])


def png_text(data):
    """Keyword -> text of the tEXt chunks."""
    pairs = [body.split(b"\0", 1) for kind, body in png_chunks(data) if kind == "tEXt"]
    return {key.decode("latin-1"): text.decode("latin-1") for key, text in pairs}


def png_pixels(data):
    """Rows of (r, g, b) of an 8-bit RGB picture."""
    width, height = png_size(data)
    raw = zlib.decompress(b"".join(body for kind, body in png_chunks(data) if kind == "IDAT"))
    stride = 3 * width
    rows, above = [], bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        above = unfiltered(raw[start], raw[start + 1 : start + 1 + stride], above)
        rows.append([tuple(above[i : i + 3]) for i in range(0, stride, 3)])
    return rows


def png_numbers(data):
    """Rows of pixels, each a tuple of 3 or 4 numbers of 8 or 16 bits."""
    width, height = png_size(data)
    bits, colour_type = dict(png_chunks(data))["IHDR"][8:10]
    channels = {2: 3, 6: 4}[colour_type]
    step = channels * bits // 8
    raw = zlib.decompress(b"".join(body for kind, body in png_chunks(data) if kind == "IDAT"))
    stride = step * width
    rows, above = [], bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        above = unfiltered(raw[start], raw[start + 1 : start + 1 + stride], above, step)
        numbers = struct.unpack(f">{channels * width}{'B' if bits == 8 else 'H'}", above)
        rows.append([numbers[i : i + channels] for i in range(0, len(numbers), channels)])
    return rows


def unfiltered(method, line, above, step=3):
    """A row of bytes as it was before PNG's filter (0 none, 1 left, 2 above, 3 mean, 4 Paeth)."""
    line = bytearray(line)
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        estimate = left + above[i] - corner
        nearest = min((abs(estimate - value), rank, value) for rank, value in enumerate((left, above[i], corner)))
        line[i] = (line[i] + (0, left, above[i], (left + above[i]) // 2, nearest[2])[method]) & 255
    return bytes(line)


def main():
    unittest.main()
