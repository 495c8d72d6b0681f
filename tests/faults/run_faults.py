#!/usr/bin/env python3
"""Lets each call of a program fail in turn, and judges what the program makes of it.

Usage: run_faults.py BIHIVE FAULTS_LIBRARY [--most N] [--jobs J] [--command NAME...] [--kind KIND...]

For each command and each kind of call (faults.cpp) it runs the program again and again: the first call fails, then the second,
until a run meets no fault. With --most N it takes N of these calls, evenly spread.
Some 6,500 allocations come before the program looks at the words of its command; they fail in one command alone.

A run is right if
  - the exit code is 0, 1 or 3, and no signal ended the program (`web` is asked for two files, then ended by SIGTERM: 0);
  - stderr is empty, or with exit code 1 or 3 one line of error, after warnings at most;
  - with exit code 0 the outputs are the bytes of a run without faults; otherwise all of them are these, or all are the old
    files (absent, or those of a previous run);
  - no other file has come, gone or changed, and no descriptor is open at the end. `thesis` and `film` go on where they
    stopped: their folders may hold what is done, each file whole.
With --most, commands that write no file have half as many calls fail, at least one of each kind.
Prints a line for each run that is not, a table, and ends with exit code 1 if there is one.
"""

import argparse
import concurrent.futures
import fcntl
import http.client
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zlib

XYZ = "4\nfour\nO 0 0 0\nH 0.757 0.586 0\nH -0.757 0.586 0\nC 1 1 1\n"
SMALL = ["--size", "16x12", "--samples", "1", "--threads", "3"]
PATIENCE_S = 120
ANSWER_S = 10
SIGNALS, SIGNAL_S = 3, 10
TRAJECTORIES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../data/io/trajectories")
GLIBC_ENDS_IT = "Fatal glibc error: failed to register TLS destructor: out of memory"

# Name: words of the command, files that it writes.
COMMANDS = {
    "render": (["render", "in.xyz", "--size", "160x130", "--samples", "1", "--threads", "3", "-o", "a.png"], ["a.png"]),
    "render-exr": (["render", "in.xyz", *SMALL, "-o", "a.exr", "--layers", "radiance,depth,id"], ["a.exr"]),
    "render-json": (["render", "scene.json", *SMALL, "-o", "a.png", "--json"], ["a.png"]),
    "render-stream": (["render", "in.xyz", *SMALL, "-o", "-"], []),
    "render-look": (["render", "in.xyz.gz", *SMALL, "-o", "a.png", "--select", "element O or within 1 of element C",
                     "--colour", "red", "--view-from", "iso", "--legend", "--title", "T"], ["a.png"]),
    "trace": (["trace", "in.xyz", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy", "--threads", "2"],
              ["t.npy", "id.npy"]),
    "scene-json": (["scene", "four-spheres", "-o", "four.json"], ["four.json"]),
    "scene-npy": (["scene", "scenario2", "--count", "64", "-o", "two.npy"], ["two.npy"]),
    "info": (["info", "in.pdb", "--attributes"], []),
    "info-json": (["info", "in.cif", "--json"], []),
    "info-lammps": (["info", "in.lammpstrj"], []),
    "info-csv": (["info", "in.csv"], []),
    "info-gro": (["info", "water.gro", "--attributes"], []),
    "info-gsd": (["info", "water.gsd", "--json"], []),
    "info-xtc": (["info", "water.gro", "--trajectory", "water.xtc", "--frame", "2"], []),
    "info-trr": (["info", "water.gro", "--trajectory", "water.trr", "--frame", "1"], []),
    "render-dcd": (["render", "water.gro", "--trajectory", "water.dcd", "--frame", "1", *SMALL, "-o", "a.png"], ["a.png"]),
    "convert-csv": (["convert", "in.pdb", "-o", "a.csv", "--select", "element C"], ["a.csv"]),
    "convert-scene": (["convert", "in.cif", "-o", "a.json"], ["a.json"]),
    "convert-stream": (["convert", "water.gsd", "-o", "-", "--format", "extxyz"], []),
    "film": (["film", "in.xyz", *SMALL, "--pictures", "3", "--turntable", "90", "-o", "a.y4m"], ["a.y4m"]),
    "film-sequence": (["film", "in.xyz", *SMALL, "--pictures", "2", "--turntable", "90", "-o", "out/%d.png"], []),
    "web": (["web", "in.pdb", "--no-browser", "--json", "--port", "0"], []),
    "view": (["view", "in.xyz"], []),
    "window": (["view", "in.xyz"], []),
    "thesis": (["thesis", "figure-4.1", "--quick", "--threads", "2", "--out", "out"], []),
    "select": (["select", "in.pdb", "within 3 of (name CA and not chain B) or index 0..1"], []),
    "stats": (["stats", "in.xyz", "--json"], []),
    "styles": (["styles"], []),
    "help": (["render", "--help"], []),
    "usage": (["render", "in.xyz", "-o", "a.jpg"], []),
    "mpi": (["render", "in.xyz", *SMALL, "-o", "a.png"], ["a.png"]),
    "mpi-rank-0": (["render", "in.xyz", *SMALL, "-o", "a.png"], ["a.png"]),
    "mpi-rank-1": (["film", "in.xyz", *SMALL, "--pictures", "2", "--turntable", "90", "-o", "out/%d.png"], []),
    "missing": (["info", "missing.xyz"], []),
    "version": (["--version"], []),
}
WHOLE = "styles"  # of this command every allocation fails; `window` is another program
OF_ITS_OWN = 100  # allocations of --version that other commands need not have
# These end so without a fault, and may with one. Here is no screen for a window.
EXPECTED = {"usage": 2, "missing": 1, "view": 3, "window": 3}
WINDOW = {"view", "window"}  # they need bihive-view; of `view` the calls of bihive fail, of `window` those of bihive-view
# bihive-mpi alone, and as two ranks, in one of which calls fail, once it has begun to read its input. What MPI itself makes of a
# failing call is its own: the exit code and the lines are not judged.
MPI = {"mpi": None, "mpi-rank-0": 0, "mpi-rank-1": 1}
# What these leave is judged file by file: folders, and the film's description, which stands beside the film.
FOLDER = {"thesis": ("out/",), "film": ("a.y4m.part/", "a.y4m.json"), "film-sequence": ("out/",), "mpi-rank-1": ("out/",)}
# Asio hands a signal on through a pipe of its own. Where every write fails, none arrives, so nothing but SIGKILL ends it.
EXCEPT = {"web": {"write+"}}
MOST = {"thesis": 100, "mpi-rank-0": 6, "mpi-rank-1": 6}  # of calls of a kind, of which there are too many

# In this order; those with + let all later calls fail too.
KINDS = ["malloc", "malloc+", "open", "open+", "read", "read-short", "read-eintr", "write", "write+", "write-short",
         "write-eintr", "fsync", "close", "rename", "linkat", "unlink", "mmap", "pthread_create", "pthread_create+", "fchmod",
         "fchown", "flock", "ftruncate", "lseek", "access", "socket", "bind", "listen", "accept", "recv", "send", "epoll", "mkdir", "rmdir"]


def inputs():
    """Name: bytes of the files in a command's folder."""
    import gzip
    import struct

    atom = "ATOM  {:5d}  {:<3} {} {}{:4d}    {:8.3f}{:8.3f}{:8.3f}  1.00 20.00           {}  \n"
    pdb = "".join(atom.format(i, n, "ALA", c, i, i * 1.5, i % 3, i % 2, e) for i, (n, c, e) in enumerate(
        [("N", "A", "N"), ("CA", "A", "C"), ("C", "A", "C"), ("O", "B", "O"), ("CB", "B", "C")], 1))
    cif = ("data_x\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.Cartn_x\n"
           "_atom_site.Cartn_y\n_atom_site.Cartn_z\nATOM C CA 0 0 0\nATOM O O 1 2 3\n")
    lammps = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
              "ITEM: ATOMS id type x y z q\n1 1 0 0 0 0.5\n2 2 1 1 1 -0.5\n")
    head = "{'descr': '<f4', 'fortran_order': False, 'shape': (40, 6), }"
    head += " " * (63 - (10 + len(head)) % 64) + "\n"
    numbers = [0.1 * i - 2 for i in range(40) for _ in range(3)]
    rows = b"".join(struct.pack("<6f", *numbers[3 * i:3 * i + 3], 1, 0.1 * i, -1) for i in range(40))
    water = {}
    for ending in ["gro", "gsd", "dcd", "xtc", "trr"]:
        with open(os.path.join(TRAJECTORIES, "water." + ending), "rb") as file:
            water["water." + ending] = file.read()
    return {
        **water,
        "page/index.html": b"<!doctype html><title>page</title>",
        "in.xyz": XYZ.encode(),
        "in.xyz.gz": gzip.compress(XYZ.encode(), mtime=0),
        "in.pdb": pdb.encode(),
        "in.cif": cif.encode(),
        "in.lammpstrj": lammps.encode(),
        "in.csv": b"x,y,z,r,charge,part\n0,0,0,1,-1,a\n1,1,1,0.5,2,b\n",
        "scene.json": b'{"bihive_scene": 2, "name": "s", "spheres": {"file": "in.xyz"}, "lights": [{"position": [9, 9, 9]}], '
                      b'"looks": [{"select": "element O", "colour": "#ff0000"}]}',
        "rays.npy": b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode() + rows,
    }


def is_whole(name, data):
    """Whether a file of the thesis's report, or of a film, is no part of one. The next run of `film` cuts off what stands
    after the last whole picture of its .y4m, and after the last whole line of an index; each rank has its own."""
    if name in ("a.y4m.part/lock", "a.y4m.part/film.y4m") or re.fullmatch(r"out/film(\.\d+-\d+)?\.index", name):
        return True
    ending = os.path.splitext(name)[1]
    if ending == ".json":
        try:
            json.loads(data)
            return True
        except ValueError:
            return False
    ends = {".html": b"</html>", ".svg": b"</svg>", ".png": b"IEND\xaeB`\x82"}
    return ending in ends and data.rstrip(b"\n").endswith(ends[ending])


def files_below(folder):
    """Path from there: bytes."""
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


def ask(process):
    """What a browser does: two files. Then the server is ended. A fault may take any of that, also the first signal, which
    Asio reads from a pipe of its own."""
    try:
        port = json.loads(process.stdout.readline())["port"]
    except ValueError:
        return  # it ends by itself, or has no end
    for target in ["/", "/file/in.pdb"]:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=ANSWER_S)
        try:
            connection.request("GET", target)
            connection.getresponse().read()
        except (OSError, http.client.HTTPException):
            pass
        finally:
            connection.close()
    for _ in range(SIGNALS):
        process.send_signal(signal.SIGTERM)
        try:
            return process.wait(SIGNAL_S)
        except subprocess.TimeoutExpired:
            pass


def run_program(name, words, folder, environment):
    """Exit code, or "no end"; both outputs."""
    with subprocess.Popen(words, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE) as process:
        try:
            if name == "web":
                ask(process)
            out, err = process.communicate(timeout=PATIENCE_S)
            return process.returncode, out, err.decode(errors="replace")
        except subprocess.TimeoutExpired:
            process.kill()
            return "no end", b"", ""


def is_open_mpi():
    if shutil.which("mpirun") is None:
        return False
    return "Open MPI" in subprocess.run(["mpirun", "--version"], capture_output=True, text=True, timeout=PATIENCE_S).stdout


def on_two_ranks(words, rank, environment):
    """The command on two ranks of mpirun, where this rank alone has the library of faults."""
    faults = [f"{name}={value}" for name, value in environment.items() if name.startswith(("LD_PRELOAD", "BIHIVE_FAULT"))]
    others = {name: value for name, value in environment.items() if not name.startswith(("LD_PRELOAD", "BIHIVE_FAULT"))}
    others |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "BIHIVE_MPI_PATIENCE": "20"}
    made = ["mpirun", "--oversubscribe", "--bind-to", "none"]
    for number in range(2):
        made += [":"] * number + ["-n", "1", *(["env", *faults] if number == rank else []), *words]
    return made, others


def request_for_window(bihive, words, folder):
    """What bihive passes to bihive-view. It looks for that beside itself first."""
    copy, other = os.path.join(folder, "bihive"), os.path.join(folder, "bihive-view")
    shutil.copy(bihive, copy)
    with open(other, "w") as file:
        file.write("#!/bin/sh\nprintf %s \"$1\"\n")
    os.chmod(other, 0o755)
    with open(os.path.join(folder, "in.xyz"), "w") as file:
        file.write(XYZ)
    done = subprocess.run([copy, *words], cwd=folder, capture_output=True, text=True, check=True)
    return done.stdout


class Case:
    """One command in folders of its own."""

    def __init__(self, options, name, nameless, shared):
        self.program, self.library = os.path.abspath(options.bihive), os.path.abspath(options.library)
        self.name, self.nameless = name, nameless
        self.words, self.outputs = COMMANDS[name]
        self.files = {file: data for file, data in inputs().items()
                      if file == "in.xyz" or file in self.words or (name == "web" and file.startswith("page/"))}
        self.prepared = lambda folder: None
        self.top = tempfile.mkdtemp(prefix="bihive_faults_")
        if name == "window":
            with tempfile.TemporaryDirectory(prefix="bihive_faults_") as folder:
                self.words = [request_for_window(self.program, self.words, folder)]
            self.program = beside(self.program, "bihive-view")
        if name in MPI:
            self.program = beside(self.program, "bihive-mpi")
        clean = self.run("", 0)
        expected = EXPECTED.get(name, 0)
        if clean["code"] != expected:
            raise SystemExit(f"{name} ends with {clean['code']} without a fault: {clean['err']}")
        self.code = expected
        self.shared = shared
        self.ended_by_glibc = 0
        pairs = [note.split() for note in clean["notes"] if note]
        self.calls = {pair[0]: int(pair[1]) for pair in pairs if len(pair) == 2}
        self.new = {output: clean["files"].get(output) for output in self.outputs}
        self.old = {output: b"old " + output.encode() for output in self.outputs}

    def run(self, kind, at):
        folder = os.path.join(self.top, f"{kind}.{at}")
        os.mkdir(folder)
        files = dict(self.files)
        if kind and at % 2:
            files.update(self.old)
        for name, data in files.items():
            os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        self.prepared(folder)
        report = folder + ".report"
        environment = {"PATH": "/usr/bin:/bin", "LD_PRELOAD": self.library, "BIHIVE_FAULT_REPORT": report,
                       "BIHIVE_PAGE": os.path.join(folder, "page")}
        if kind:
            environment["BIHIVE_FAULT"] = f"{kind.rstrip('+')}:{at}{'+' if kind.endswith('+') else ''}"
        if not self.nameless:
            environment["BIHIVE_FAULT_NO_TMPFILE"] = "1"
        words = [self.program, *self.words]
        if self.name in MPI:
            environment["BIHIVE_FAULT_AFTER"] = "in.xyz"
        if MPI.get(self.name) is not None:
            words, environment = on_two_ranks(words, MPI[self.name], environment)
        code, out, err = run_program(self.name, words, folder, environment)
        found = files_below(folder)
        notes = []
        if os.path.exists(report):
            with open(report) as file:
                notes = file.read().split("\n")
            os.remove(report)
        shutil.rmtree(folder)
        return {"code": code, "out": out, "err": err, "files": found, "notes": notes, "before": files}

    def faults_of(self, kind, result):
        """What is wrong with a run, as a list of texts."""
        wrong = []
        # The C library ends the program itself where it finds no memory for this; docs/reliability.md states it. Other
        # threads may have said before that there is none. All else is judged.
        if kind.startswith("malloc") and GLIBC_ENDS_IT in result["err"] and result["code"] in (-6, 1):
            self.ended_by_glibc += 1
            result["code"], result["err"] = 1, "bihive: error: not enough memory\n"
        code, lines = result["code"], result["err"].splitlines()
        if self.name in MPI and code != "no end":
            code, lines = min(abs(code), 1), ["bihive: error: "] if code else []
            result["notes"] = []
        if code not in {0, 1, 3, self.code}:
            wrong.append(f"exit code {code}")
        # Where the picture goes to stdout, "-: ..." is the report.
        errors = [line for line in lines if not line.startswith(("bihive: warning: ", "-: "))]
        if code == 0 and errors:
            wrong.append("success, and lines on stderr")
        if code in (1, 2, 3) and (len(errors) != 1 or not errors[0].startswith("bihive: error: ")):
            wrong.append(f"{len(errors)} lines of error")
        files, before = result["files"], result["before"]
        is_new = [files.get(name) == self.new[name] for name in self.outputs]
        is_old = [files.get(name) == before.get(name) for name in self.outputs]
        if code == 0 and not all(is_new):
            wrong.append("success, and an output is not whole")
        if not all(is_new) and not all(is_old):
            wrong.append("outputs are neither whole nor as before")
        others = {name: data for name, data in files.items() if name not in self.outputs}
        for name in [name for name in others if name.startswith(FOLDER.get(self.name, ("//",)))]:
            if not is_whole(name, others.pop(name)):
                wrong.append(f"a part of {name}")
        # Where removing is what fails, something stays.
        if others != self.files and not (kind == "unlink" and set(self.files) < set(others)):
            wrong.append("other files: " + ", ".join(sorted(set(others) ^ set(self.files))))
        if "open 0" not in result["notes"] and any(note.startswith("open") for note in result["notes"]):
            wrong.append("descriptors stay " + " ".join(note for note in result["notes"] if note.startswith("open")))
        return wrong

    def close(self):
        shutil.rmtree(self.top)


def beside(program, name):
    return os.path.join(os.path.dirname(os.path.abspath(program)), name)


def leftovers(options):
    """Where files have names from the beginning, a run removes what a killed one left, and nothing else."""
    case = Case(options, "scene-npy", False, 0)
    dead, alive, other = [".bihive-" + name + ".part" for name in ["0123456789abcdef", "fedcba9876543210", "short"]]
    case.files.update({dead: b"left", alive: b"in use", other: b"no file of ours"})
    holder = None

    def hold(path):
        nonlocal holder
        holder = open(path, "rb")
        fcntl.flock(holder, fcntl.LOCK_EX)

    case.prepared = lambda folder: hold(os.path.join(folder, alive))
    result = case.run("", 0)
    holder.close()
    case.close()
    if dead in result["files"] or not {alive, other} <= set(result["files"]):
        return [f"leftovers: {sorted(result['files'])}"]
    return []


def at_once(options):
    """Films that begin at once in one folder do not remove each other's hidden folders, however late they lock them."""
    environment = {"PATH": "/usr/bin:/bin", "LD_PRELOAD": os.path.abspath(options.library), "BIHIVE_FAULT_LATE_LOCKS": "20000"}
    program = os.path.abspath(options.bihive)
    wrong = set()
    with tempfile.TemporaryDirectory(prefix="bihive_faults_") as folder:
        with open(os.path.join(folder, "in.xyz"), "w") as file:
            file.write(XYZ)
        for number in range(6):
            films = [subprocess.Popen([program, "film", "in.xyz", *SMALL, "--pictures", "1", "-o", f"{number}-{k}.y4m"],
                                      cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                     for k in range(8)]
            for film in films:
                err = film.communicate(timeout=PATIENCE_S)[1]
                if film.returncode != 0 or err:
                    wrong.add(f"films at once: {film.returncode}: {err!r}")
        wrong |= {f"films at once leave {name}" for name in os.listdir(folder) if name.startswith(".bihive-")}
    return sorted(wrong)


def step(case, kind, most, pool, jobs):
    """Lets calls of a kind fail: each until a run meets no fault, or so many of them. (runs, texts of wrong ones)"""
    # The part of all commands before they look at their words is tried once, by one of them.
    before = case.shared if kind.startswith("malloc") and case.name not in (WHOLE, "window", *MPI) else 0
    if most and not case.outputs:
        most = max(1, most // 2)
    most = min(most, MOST[case.name]) if most and case.name in MOST else most or MOST.get(case.name, 0)
    runs, wrong, at = 0, [], before + 1
    calls = case.calls.get(kind.rstrip("+"), 0) - before
    if most and calls > most:
        first = zlib.crc32(f"{case.name} {kind}".encode())
        chosen = [before + 1 + (first + k * calls // most) % calls for k in range(most)]
    else:
        chosen = None
    while True:
        batch = chosen if chosen else range(at, at + 4 * jobs)
        met_all = True
        for n, result in pool.map(lambda n: (n, case.run(kind, n)), batch):
            met = "fault" in result["notes"]
            met_all = met_all and met
            runs += met
            for text in case.faults_of(kind, result) if met else []:
                wrong.append(f"{case.name} {kind}:{n}: {text}: {result['err'][:300]!r}")
        if chosen or not met_all:
            return runs, wrong
        at += 4 * jobs


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--most", type=int, default=0, help="runs for each command and kind; 0: all")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--command", nargs="*", default=list(COMMANDS))
    parser.add_argument("--kind", nargs="*", default=KINDS)
    parser.add_argument("bihive")
    parser.add_argument("library")
    options = parser.parse_args()
    begin = time.monotonic()
    version = Case(options, "version", True, 0)
    shared = version.calls["malloc"] - OF_ITS_OWN
    version.close()
    all_runs, all_wrong, by_glibc = 0, leftovers(options) + at_once(options), 0
    for text in all_wrong:
        print("WRONG", text)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name in options.command:
            if name in WINDOW and not os.path.exists(beside(options.bihive, "bihive-view")):
                print(f"{name}: left out, bihive-view was not built")
                continue
            if name in MPI and not (os.path.exists(beside(options.bihive, "bihive-mpi")) and is_open_mpi()):
                print(f"{name}: left out, there is no bihive-mpi or no Open MPI")
                continue
            for nameless in [True, False] if COMMANDS[name][1] else [True]:
                case = Case(options, name, nameless, shared)
                runs_of_case = {}
                for kind in options.kind:
                    if kind in EXCEPT.get(name, ()):
                        continue
                    if not nameless and kind in ("malloc", "malloc+", "read", "read-short", "read-eintr"):
                        continue
                    runs, wrong = step(case, kind, options.most, pool, options.jobs)
                    runs_of_case[kind] = runs
                    all_runs += runs
                    all_wrong += wrong
                    for text in wrong:
                        print("WRONG", text, flush=True)
                by_glibc += case.ended_by_glibc
                case.close()
                met = ", ".join(f"{kind} {runs}" for kind, runs in runs_of_case.items() if runs)
                print(f"{name}{'' if nameless else ' (named files)'}: {met}", flush=True)
    print(f"{all_runs} runs with a fault, {len(all_wrong)} wrong, {by_glibc} ended by the C library itself, "
          f"{time.monotonic() - begin:.0f} s")
    # No fault at all would prove nothing.
    return 1 if all_wrong or all_runs == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
