#!/usr/bin/env python3
"""Kills a program before each of its calls that change files, runs it again, and judges what both leave.

Usage: run_kills.py BIHIVE FAULTS_LIBRARY [--most N] [--jobs J] [--command NAME...] [--kind KIND...]

For each command and each kind of call (faults.cpp) the program ends by SIGKILL before the first call, then before the second,
until a run meets none; with --most N before N of them, evenly spread: once with the outputs there before, once without. Right is:
  - after the kill each output is whole or as it was, and no other file has changed;
  - the next run succeeds, and leaves exactly the files and folders of a run that nobody killed, with their bytes.
Prints a line for each run that is wrong, and a table.
"""

import argparse
import concurrent.futures
import os
import shutil
import subprocess
import sys
import tempfile

from run_faults import PATIENCE_S, SMALL, inputs

SAVE = ("import bihive\n"
        "s = bihive.read('in.xyz')\n"
        "s.save('a.csv')\n"
        "bihive.render(s, size=(16, 12), samples=1).save('a.png')\n")
# Words of the command; Python runs the program text instead.
COMMANDS = {
    "render": ["render", "in.xyz", *SMALL, "-o", "a.png"],
    "render-exr": ["render", "in.xyz", *SMALL, "-o", "a.exr", "--layers", "radiance,depth,id"],
    "trace": ["trace", "in.xyz", "--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy"],
    "scene": ["scene", "four-spheres", "-o", "a.json"],
    "convert": ["convert", "in.pdb", "-o", "a.csv"],
    "index": ["info", "in.xyz", "--frames", "--keep-index"],
    "film": ["film", "in.xyz", *SMALL, "--pictures", "3", "--turntable", "90", "-o", "a.y4m"],
    "film-sequence": ["film", "in.xyz", *SMALL, "--pictures", "2", "--turntable", "90", "-o", "out/%d.png"],
    "film-mp4": ["film", "in.xyz", *SMALL, "--pictures", "3", "--turntable", "90", "-o", "a.mp4"],
    "thesis": ["thesis", "figure-4.1", "--quick", "--threads", "2", "--out", "out"],
    "python": SAVE,
}
# Their bytes tell the time, also that of the input, or are those of another program.
NAMES_ALONE = (".mp4", ".y4m.json", "film.json", ".html", "results.json", "out/steps/", "out/figure-4.1/", ".bihive-index")
# They go on where they stopped: their parts are not judged before that.
GOES_ON = {"film": ("a.y4m.part",), "film-mp4": ("a.mp4.part",), "film-sequence": ("out",), "thesis": ("out",)}
KINDS = ["write", "fsync", "close", "linkat", "rename", "unlink", "fchmod", "flock", "ftruncate", "mkdir", "rmdir"]
KILLED = -9
# Python itself makes thousands of these.
NOT_OF_PYTHON = {"close", "write"}


def tree_below(folder):
    """Path from there: bytes; None for a folder."""
    found = {}
    for place, folders, names in os.walk(folder):
        for name in folders:
            found[os.path.relpath(os.path.join(place, name), folder)] = None
        for name in names:
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


class Case:
    def __init__(self, options, name, nameless):
        self.options, self.name, self.nameless = options, name, nameless
        self.words = COMMANDS[name]
        self.top = tempfile.mkdtemp(prefix="bihive_kills_")
        self.inputs = {file: data for file, data in inputs().items()
                       if file == "in.xyz" or (isinstance(self.words, list) and file in self.words)}
        self.calls = {}
        self.clean = self.run_whole({})
        # What is there before: the outputs themselves, with other bytes; not the parts of a report or of a sequence.
        self.outputs = {path for path, data in self.clean.items() if path not in self.inputs and data is not None}
        self.old = {path: b"old" for path in self.outputs if "/" not in path and not path.endswith((".y4m.json", ".mp4.json"))}
        if self.old:
            self.run_whole(self.old)

    def run_whole(self, before):
        """What a run leaves that nobody kills. Counts its calls."""
        folder = self.folder("clean", before)
        code, text, calls = self.run(folder, "")
        if code != 0:
            raise SystemExit(f"{self.name} ends with {code} without a fault: {text}")
        self.calls = {kind: max(count, self.calls.get(kind, 0)) for kind, count in {**self.calls, **calls}.items()}
        left = tree_below(folder)
        shutil.rmtree(folder)
        return left

    def folder(self, name, more):
        folder = os.path.join(self.top, name)
        os.mkdir(folder)
        for path, data in {**self.inputs, **more}.items():
            with open(os.path.join(folder, path), "wb") as file:
                file.write(data)
        return folder

    def run(self, folder, fault):
        """Exit code, what was said, and how often each kind was called."""
        report = folder + ".report"
        environment = {"PATH": "/usr/bin:/bin", "LD_PRELOAD": os.path.abspath(self.options.library),
                       "BIHIVE_FAULT_REPORT": report, "PYTHONPATH": os.environ.get("PYTHONPATH", "")}
        command = [sys.executable, "-c", self.words] if isinstance(self.words, str) else [self.options.bihive, *self.words]
        environment["BIHIVE_FAULT_PROGRAM"] = os.path.basename(command[0])
        if fault:
            environment["BIHIVE_FAULT"] = fault
        if not self.nameless:
            environment["BIHIVE_FAULT_NO_TMPFILE"] = "1"
        done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                              timeout=PATIENCE_S, check=False)
        calls = {}
        if os.path.exists(report):
            with open(report) as file:
                pairs = [line.split() for line in file]
            calls = {pair[0]: int(pair[1]) for pair in pairs if len(pair) == 2}
            os.remove(report)
        return done.returncode, done.stderr.decode(errors="replace"), calls

    def is_same(self, path, data):
        expected = self.clean.get(path)
        # The first line of an index stands for the film's description, which tells the time of the input.
        if path.endswith("film.index") and data and expected:
            data, expected = data.split(b"\n", 1)[1:], expected.split(b"\n", 1)[1:]
        return data == expected or (any(mark in path for mark in NAMES_ALONE) and data is not None and expected is not None)

    def judge(self, kind, at, replaces):
        """What is wrong with a run that was killed there, and with the next one; None if nobody killed it."""
        before = self.old if replaces else {}
        folder = self.folder(f"{kind}.{at}.{replaces}", before)
        try:
            code, text, _ = self.run(folder, f"{kind}:{at}!")
            if code != KILLED:
                return None
            wrong = []
            for path, data in tree_below(folder).items():
                if path in self.inputs and data != self.inputs[path]:
                    wrong.append(f"the input {path} has changed")
                if path in self.outputs and not path.startswith(GOES_ON.get(self.name, ("//",))):
                    if data != before.get(path) and not self.is_same(path, data):
                        wrong.append(f"{path} is neither whole nor as before")
            for path in before:
                if not os.path.exists(os.path.join(folder, path)):
                    wrong.append(f"{path} is gone")
            left = sorted(set(tree_below(folder)) - set(self.inputs) - set(self.outputs))
            code, text, _ = self.run(folder, "")
            if code != 0:
                wrong.append(f"the next run ends with {code}: {text.strip()[:300]}")
            found = tree_below(folder)
            if set(found) != set(self.clean):
                more, less = sorted(set(found) - set(self.clean)), sorted(set(self.clean) - set(found))
                wrong.append(f"the next run leaves {more}, and lacks {less}")
            wrong += [f"{path} differs after the next run" for path, data in found.items()
                      if path in self.clean and not self.is_same(path, data)]
            return [f"{text} (the kill left {left})" for text in wrong]
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def close(self):
        shutil.rmtree(self.top)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--most", type=int, default=0, help="kills for each command and kind; 0: at every call")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--command", nargs="*", default=None)
    parser.add_argument("--kind", nargs="*", default=KINDS)
    parser.add_argument("bihive")
    parser.add_argument("library")
    options = parser.parse_args()
    options.bihive = os.path.abspath(options.bihive)
    kills, all_wrong = 0, 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name in options.command or COMMANDS:
            if name == "film-mp4" and shutil.which("ffmpeg") is None:
                print("film-mp4: left out, there is no ffmpeg")
                continue
            if name == "python" and subprocess.run([sys.executable, "-c", "import bihive"], capture_output=True, check=False).returncode:
                print("python: left out, the package is not in PYTHONPATH")
                continue
            for nameless in [True, False]:
                case = Case(options, name, nameless)
                table = {}
                for kind in options.kind:
                    count = case.calls.get(kind, 0)
                    if not count or (name == "python" and kind in NOT_OF_PYTHON):
                        continue
                    places = range(1, count + 1)
                    if options.most and count > options.most:
                        places = sorted({1 + k * count // options.most for k in range(options.most)})
                    both = [(at, replaces) for at in places for replaces in ([False, True] if case.old else [False])]
                    results = list(pool.map(lambda one, kind=kind: (one[0], case.judge(kind, *one)), both))
                    table[kind] = sum(wrong is not None for _, wrong in results)
                    kills += table[kind]
                    for at, wrong in results:
                        for text in wrong or []:
                            all_wrong += 1
                            print(f"WRONG {name}{'' if nameless else ' (named files)'} {kind}:{at}: {text}", flush=True)
                case.close()
                met = ", ".join(f"{kind} {number}" for kind, number in table.items() if number)
                print(f"{name}{'' if nameless else ' (named files)'}: {met}", flush=True)
    print(f"{kills} kills, {all_wrong} wrong")
    return 1 if all_wrong or kills == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
