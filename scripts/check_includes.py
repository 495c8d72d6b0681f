#!/usr/bin/env python3
"""Checks which folder of the library includes which, and that no file grows too long.

Usage: scripts/check_includes.py [top of the sources]

Prints a line for each offence (file:line: what is wrong) and exits with 1 where there is any.
"""

import pathlib
import re
import sys

# A folder of src/bihive, and the folders that it may include besides itself.
ALLOWED = {
    "base": set(),
    "math": {"base"},
    "geometry": {"base", "math"},
    "bih": {"base", "math", "geometry"},
    "simd": {"base"},
    "wide": {"base", "math", "geometry", "bih", "simd"},
    "image": {"base", "math"},
    "io": {"base", "math", "geometry", "image"},
    "scene": {"base", "math", "geometry", "io", "image"},
    "render": {"base", "math", "geometry", "bih", "simd", "wide", "scene", "image"},
    "gl": {"base", "math", "geometry", "bih", "scene", "image"},
    "viewer": {"base", "math", "geometry", "bih", "simd", "wide", "io", "scene", "image", "render", "gl"},
}
LIBRARY = "src/bihive"
PROGRAMS = "apps"
LONGEST_FILE = 800
CODE = {".h", ".cpp", ".py", ".cmake", ".glsl", ".ts", ".js"}
LOOKED_AT = ["src", "apps", "tests", "scripts", "cmake", "bench", "bindings", "thesis", "web"]

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def includes_of(path):
    """(line number, quote character, what is included) of each #include line."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def sources_below(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".h", ".cpp"}) if folder.is_dir() else []


def check_library(top):
    """Offences inside src/bihive: an arrow that runs back, or a header from outside."""
    root = top / LIBRARY
    for path in sources_below(root):
        name = path.relative_to(top)
        parts = path.relative_to(root).parts
        if len(parts) < 2 or parts[0] not in ALLOWED:
            yield f"{name}:1: '{parts[0]}' is not in the table of folders of scripts/check_includes.py"
            continue
        folder = parts[0]
        for number, quote, included in includes_of(path):
            if not included.startswith("bihive/"):
                if quote == '"':
                    yield f'{name}:{number}: "{included}" should be written "bihive/..." (or <...> for other libraries)'
                continue
            target = included.split("/")[1]
            if target != folder and target not in ALLOWED[folder]:
                allowed = ", ".join(sorted(ALLOWED[folder])) or "nothing"
                yield f"{name}:{number}: {folder} must not include {target} ({included}); allowed: {allowed}"
            elif not (top / "src" / included).is_file():
                yield f"{name}:{number}: there is no src/{included}"


def check_programs(top):
    """Offences inside apps: only headers of the library, and a program's own."""
    for path in sources_below(top / PROGRAMS):
        name = path.relative_to(top)
        program = path.relative_to(top / PROGRAMS).parts[0]
        for number, quote, included in includes_of(path):
            if included.startswith("bihive/"):
                if not (top / "src" / included).is_file():
                    yield f"{name}:{number}: there is no src/{included}"
            elif quote == '"' and not any(
                (base / included).resolve().is_relative_to((top / PROGRAMS / program).resolve())
                and (base / included).is_file()
                for base in (path.parent, top / PROGRAMS / program)
            ):
                yield f'{name}:{number}: "{included}" is neither a header of the library nor one of {PROGRAMS}/{program}'


def check_lengths(top):
    for folder in LOOKED_AT:
        for path in sorted((top / folder).rglob("*")):
            if path.suffix in CODE and path.is_file() and "node_modules" not in path.parts:
                lines = len(path.read_text(encoding="utf-8").splitlines())
                if lines > LONGEST_FILE:
                    yield f"{path.relative_to(top)}:{lines}: longer than {LONGEST_FILE} lines; it holds two concepts"


def offences(top):
    return [*check_library(top), *check_programs(top), *check_lengths(top)]


def main():
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    if not (top / LIBRARY).is_dir():
        sys.exit(f"{top}: there is no {LIBRARY} in it")
    found = offences(top)
    for offence in found:
        print(offence)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
