#!/usr/bin/env python3
"""Looks at programs and libraries of a release build: what cmake/BihiveHardening.cmake promises is in each.

Usage: hardening_test.py SOURCE_FOLDER BUILD_FOLDER FILE...
"""

import os
import subprocess
import sys


def readelf(*words):
    return subprocess.run(["readelf", "-W", *words], capture_output=True, text=True, check=True).stdout


def faults_of(file, folders):
    dynamic, symbols = readelf("-d", file), readelf("--dyn-syms", file)
    if not any(mark in line for line in dynamic.splitlines() for mark in ("BIND_NOW", "Flags: NOW")):
        yield "functions of other libraries are bound late (no BIND_NOW)"
    if "GNU_RELRO" not in readelf("-l", file):
        yield "no segment is made read-only after the start (RELRO)"
    if "Type:                              DYN" not in readelf("-h", file) and "DYN (" not in readelf("-h", file):
        yield "it cannot lie at any address (PIE)"
    if "__stack_chk_fail" not in symbols:
        yield "no stack protector"
    if "_chk@" not in symbols.replace("__stack_chk_fail@", ""):
        yield "no checked functions of the C library (_FORTIFY_SOURCE)"
    with open(file, "rb") as opened:
        content = opened.read()
    for folder in folders:
        # A program of the build folder finds libraries that lie beside it; installed ones have no such path.
        at = content.find(os.fsencode(folder))
        if at >= 0 and not any(folder in line for line in dynamic.splitlines() if "RPATH" in line or "RUNPATH" in line):
            yield f"it holds the path of a folder of the build: {content[at:at + 120].split(bytes(1))[0]!r}"


def main():
    source, build, *files = sys.argv[1:]
    wrong = [f"{file}: {fault}" for file in files for fault in faults_of(file, [source, build])]
    print("\n".join(wrong) or f"{len(files)} files are hardened")
    return 1 if wrong or not files else 0


if __name__ == "__main__":
    sys.exit(main())
