"""What tests of mpirun share."""

import json
import os
import shutil
import struct
import subprocess

from program import PATIENCE_S, ProgramTest

BIHIVE_MPI = os.environ.get("BIHIVE_MPI")
MPIRUN = shutil.which("mpirun")
FRAMES = 7


def frame(number):
    places = [f"C {i + 0.1 * number * i:.2f} {0.3 * i * i:.2f} {0.2 * number:.2f}\n" for i in range(5)]
    return f"5\nframe {number}\n" + "".join(places)


def gsd_file(places, radii, types):
    """A GSD file of HOOMD-blue with one frame: places x, y, z of all particles in one list, and types 0 ("A") and 1 ("B")."""
    count = len(radii)
    floats = {"particles/position": (3, places), "particles/diameter": (1, [2 * radius for radius in radii])}
    chunks = [(name, count, columns, 9, struct.pack(f"<{len(values)}f", *values)) for name, (columns, values) in floats.items()]
    chunks.append(("particles/typeid", count, 1, 3, struct.pack(f"<{count}I", *types)))
    chunks.append(("particles/types", 2, 2, 5, b"A\0B\0"))
    names = b"".join(name.encode() + b"\0" for name, *_ in chunks)
    names += bytes(-len(names) % 64)
    index, place = b"", 256 + len(names)
    for number, (_, rows, columns, kind, data) in enumerate(chunks):
        index += struct.pack("<QQqIHBB", 0, rows, place, columns, number, kind, 0)
        place += len(data)
    head = struct.pack("<QQQQQII64s64s80x", 0x65DF65DF65DF65DF, place, len(chunks), 256, len(names) // 64, 0x10004,
                       0x20000, b"test", b"hoomd")
    return head + names + b"".join(data for *_, data in chunks) + index


def is_open_mpi():
    """Whether mpirun is Open MPI's: another one names the ranks in other ways."""
    if MPIRUN is None:
        return False
    said = subprocess.run([MPIRUN, "--version"], capture_output=True, text=True, timeout=PATIENCE_S)
    return "Open MPI" in said.stdout


class OnRanks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("run.xyz", "".join(map(frame, range(FRAMES))))

    def mpirun(self, count, *command):
        options = ["--oversubscribe", "--bind-to", "none", "-n", str(count)]
        if os.geteuid() == 0:
            options.append("--allow-run-as-root")
        return [MPIRUN, *options, *command]

    def run_ranks(self, count, *command):
        return subprocess.run(self.mpirun(count, *command), cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=PATIENCE_S)

    def errors(self, done):
        """The lines of the program, without those of mpirun."""
        return [line for line in done.stderr.splitlines() if line.startswith("bihive: ")]

    def leftovers(self):
        return sorted(name for name in os.listdir(self.folder) if name != "run.xyz")

    def hash_of(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["picture_hash"]

    def expect_picture_of_one_process(self, ranks, scene, options, threads="1"):
        """The same picture by so many ranks, with all spheres on each rank or some."""
        alone = self.hash_of(self.run_bihive("render", scene, "-o", "alone.png", "--json", *options))
        for count in ranks:
            for more in ([], ["--distribute"]):
                with self.subTest(options=options, ranks=count, more=more):
                    words = ["render", scene, "-o", "ranks.png", "--json", "--threads", threads, *options, *more]
                    self.assertEqual(self.hash_of(self.run_ranks(count, BIHIVE_MPI, *words)), alone)
