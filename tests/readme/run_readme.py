#!/usr/bin/env python3
"""Runs the shell commands of a Markdown file in a scratch copy of the project.

Usage: run_readme.py README.md TOP_OF_THE_SOURCES SCRATCH_FOLDER

Every fenced block marked `sh` is run, in order, by `bash -e` from the top of the copy. Not run, and said so:
- blocks marked `sh notest`;
- commands that fetch or install packages, or run all other tests (SKIPPED below). `make demo` runs without the installation.
"""

import pathlib
import re
import shutil
import subprocess
import sys

FENCE = re.compile(r"^(\s*)```+\s*(.*?)\s*$")

# The beginning of a command, the command to run instead, and the reason.
SKIPPED = [
    (r"(sudo )?apt(-get)? ", "", "installs packages"),
    (r"git clone ", "", "the scratch copy takes the clone's place"),
    (r"cd bihive\b", "", "the scratch copy takes the clone's place"),
    (r"make demo\b", "scripts/demo", "without installing packages"),
    (r"make (test|verify|check|lint)\b", "", "would run this test again, or for long"),
    (r"scripts/(setup|test|verify|check|lint)\b", "", "installs, or would run this test again"),
    (r"\.ci/run\b", "", "would run this test again"),
]


def shell_blocks(text):
    """(line number, commands, whether to run them) of each block marked sh."""
    lines = text.splitlines()
    number = 0
    while number < len(lines):
        match = FENCE.match(lines[number])
        number += 1
        if not match:
            continue
        words = match.group(2).split()
        start = number
        while number < len(lines) and not FENCE.match(lines[number]):
            number += 1
        body = "\n".join(line[len(match.group(1)):] for line in lines[start:number])
        number += 1
        if words and words[0] in {"sh", "bash", "shell"}:
            yield start + 1, body, "notest" not in words[1:]


def commands_of(body):
    """The block's commands; a line that ends in a backslash goes on in the next."""
    return [line for line in body.replace("\\\n", " ").splitlines() if line.strip() and not line.lstrip().startswith("#")]


def replacement(command):
    """The command to run instead, and the reason; (command, None) if the command runs as it is."""
    for pattern, instead, reason in SKIPPED:
        if re.match(pattern, command.strip()):
            return instead, reason
    return command, None


def copy_sources(top, scratch):
    """Copies the files of a clone: those that git tracks or would track; without git all but build folders."""
    if scratch.exists():
        shutil.rmtree(scratch)
    listed = subprocess.run(
        ["git", "-C", str(top), "ls-files", "-z", "--cached", "--others", "--exclude-standard"], capture_output=True
    )
    if listed.returncode == 0:
        for name in filter(None, listed.stdout.decode().split("\0")):
            if (top / name).is_file():
                (scratch / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(top / name, scratch / name)
    else:
        shutil.copytree(top, scratch, ignore=shutil.ignore_patterns("build*", "out", ".git"))


def run_blocks(text, folder):
    """Runs the blocks; the number of commands run, or None after a failure."""
    count = 0
    for line, body, wanted in shell_blocks(text):
        if not wanted:
            print(f"line {line}: block skipped (notest)")
            continue
        script = []
        for command in commands_of(body):
            instead, reason = replacement(command)
            if reason:
                print(f"line {line}: '{command.strip()}' " + (f"is run as '{instead}'" if instead else "skipped") + f": {reason}")
            if instead:
                script.append(instead)
                count += 1
        if not script:
            continue
        print(f"line {line}: " + "\n         ".join(script), flush=True)
        if subprocess.run(["bash", "-e", "-o", "pipefail", "-c", "\n".join(script)], cwd=folder).returncode != 0:
            print(f"the block at line {line} failed")
            return None
    return count


def main():
    readme, top, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    copy_sources(top, scratch)
    count = run_blocks(readme.read_text(encoding="utf-8"), scratch)
    if count is None:
        sys.exit(1)
    if count == 0:
        sys.exit(f"{readme}: no command was run")
    print(f"{count} commands ran")
    shutil.rmtree(scratch)


if __name__ == "__main__":
    main()
