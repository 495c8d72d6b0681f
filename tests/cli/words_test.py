"""Manual pages and completions are written from the command line's own description, so they say what --help says."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import textwrap
import unittest

from program import BIHIVE, ProgramTest, main

# An option in --help: two spaces, then its names.
OPTION = re.compile(r"^  (-[-A-Za-z0-9,]+)", re.MULTILINE)


def need(program):
    return unittest.skipUnless(shutil.which(program), f"{program} is not installed")


class Words(ProgramTest):
    def describe(self, *words):
        return self.succeed("describe", *words)

    def commands(self):
        return self.describe("commands").split()

    def options(self, *command):
        """The names of the options that --help lists."""
        names = ",".join(OPTION.findall(self.succeed(*command, "--help-all"))).split(",")
        self.assertIn("--help", names)
        return names


class ManualPages(Words):
    def shown(self, *command):
        """What a reader sees, without the page's layout."""
        page = self.describe("man", *command)
        return re.sub(r"\\f[BIR]", "", page).replace("\\-", "-")

    def test_every_command_of_help_has_one(self):
        listed = re.findall(r"^  ([a-z-]+) ", self.succeed("--help-all").split("Subcommands:")[1], re.MULTILINE)
        self.assertEqual(self.commands(), listed)
        page = self.shown()
        for command in listed:
            self.assertIn(f"\nbihive-{command}(1)\n", page)

    def test_every_option_of_help_is_there_and_no_other(self):
        for command in [[], *([name] for name in self.commands())]:
            page = self.shown(*command)
            paragraphs = re.findall(r"^\.TP\n(-.*)$", page, re.MULTILINE)
            names = [name for line in paragraphs for name in re.findall(r"(?:^|, )(-[-a-z0-9]+)", line)]
            self.assertEqual(sorted(names), sorted(self.options(*command)), command)

    def test_a_page_says_what_help_says_of_an_option(self):
        self.assertIn("\n.TP\n--view shaded|recursion", self.shown("render"))
        self.assertIn("Degrees: the camera moves AZ to the right and EL up around its target;", self.shown("film"))
        self.assertIn("\nbihive render INPUT [TRAJECTORY] -o FILE [OPTION]...\n", self.shown("render"))
        self.assertIn("\nbihive thesis [EXPERIMENT]... [OPTION]...\n", self.shown("thesis"))

    @need("groff")
    def test_groff_has_nothing_to_say(self):
        for command in [[], *([name] for name in self.commands())]:
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=self.describe("man", *command), text=True,
                                  capture_output=True, check=True, timeout=600)
            self.assertEqual(done.stderr, "", command)
            self.assertIn("User commands", done.stdout)

    def test_options_of_a_command_are_json(self):
        rows = {row["id"]: row for row in json.loads(self.describe("options", "film"))}
        self.assertEqual(rows["turntable"]["value"], "DEG")
        self.assertEqual(rows["help"]["value"], "")
        listed = {line.split()[1] for line in self.describe("options").splitlines() if line.startswith("film --")}
        self.assertEqual({"--" + name.replace("_", "-") for name in rows}, listed)

    def test_describe_refuses_other_words(self):
        for words in ([], ["man", "nothing"], ["man", "render", "film"], ["tcsh"], ["bash", "zsh"], ["commands", "all"], ["options", "nothing"]):
            done = self.run_bihive("describe", *words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertIn("bihive describe knows: commands, options [COMMAND], settings, reading, picture, colour-maps, man [COMMAND], bash, zsh, fish", done.stderr)


class Bash(Words):
    def complete(self, *words):
        """What bash offers for the last word."""
        script = self.describe("bash") + textwrap.dedent("""
            COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
            _bihive
            printf '%s\\n' "${COMPREPLY[@]}"
            """)
        done = subprocess.run(["bash", "-u", "-c", script, "bash", "bihive", *words], cwd=self.folder, text=True,
                              capture_output=True, timeout=600)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout.split()

    def test_commands(self):
        self.assertEqual(self.complete(""), [*self.commands(), *self.options()])
        self.assertEqual(self.complete("st"), ["stats", "styles"])
        self.assertEqual(self.complete("nothing"), [])

    def test_options_of_each_command(self):
        for command in self.commands():
            self.assertEqual(sorted(self.complete(command, "-")), sorted(self.options(command)))
        self.assertEqual(self.complete("render", "demo", "--view"), ["--view", "--view-from"])

    def test_values(self):
        self.assertEqual(self.complete("render", "demo", "--view", "t"), ["traversal", "tree"])
        self.assertEqual(self.complete("render", "demo", "--view", "=", "t"), ["traversal", "tree"])
        self.assertEqual(self.complete("render", "demo", "--view", "="), self.complete("render", "--view", ""))
        self.assertEqual(self.complete("render", "--bits", ""), ["8", "16"])
        self.assertEqual(self.complete("render", "--light", "c"), ["cloudy"])
        self.assertEqual(self.complete("render", "--style", "gl"), ["glossy"])
        self.assertEqual(self.complete("thesis", "fig"), ["figure-4.1", "figure-4.2", "figure-4.3", "figure-4.4", "figure-4.5"])
        # A number is no word of a list, and no file stands in its place.
        self.write("8", "")
        self.assertEqual(self.complete("render", "--fov", ""), [])

    def test_files_and_folders(self):
        self.write("scene one.pdb", "")
        self.write("other.pdb", "")
        os.mkdir(self.path("sc-folder"))
        offered = self.complete("render", "sc")
        self.assertEqual(offered[:3], ["scenario1", "scenario2", "scenario3"])
        self.assertEqual(sorted(offered[3:]), ["one.pdb", "sc-folder", "scene"])  # split() cut a name with a space
        self.assertEqual(self.complete("render", "-o", "o"), ["other.pdb"])
        self.assertEqual(self.complete("thesis", "--out", ""), ["sc-folder"])
        self.assertEqual(self.complete("scene", "o"), [])


class Zsh(Words):
    @need("zsh")
    def test_options_and_values(self):
        os.mkdir(self.path("functions"))
        self.write("functions/_bihive", self.describe("zsh"))
        # A shell on a terminal of its own, whose completion prints what it would offer.
        self.write("ask", textwrap.dedent("""
            zmodload zsh/zpty
            zpty shell zsh -f -i
            zpty -w shell "PS1= PS2= RPS1=; cd $PWD; fpath=($PWD/functions \\$fpath); autoload -Uz compinit; compinit -u -D"
            zpty -w shell "zstyle ':completion:*' list-grouped false; unsetopt beep; LISTMAX=0; setopt no_always_last_prompt"
            zpty -w shell "print REA''DY"
            zpty -r shell line '*READY*'
            zpty -n -w shell "$1"$'\\t\\t'
            zpty -r -m shell line "*$2*" && print -r -- FOUND
            zpty -d shell
            """))
        for line, expected in (("bihive rend", "render"), ("bihive render demo --view tre", "tree"), ("bihive stats --max-d", "--max-depth"),
                               ("bihive thesis tab", "table-4.2")):
            done = subprocess.run(["timeout", "120", "zsh", "-f", self.path("ask"), line, expected], cwd=self.folder,
                                  text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=600)
            self.assertIn("FOUND", done.stdout, (line, done.stderr))


class Fish(Words):
    @need("fish")
    def test_options_and_values(self):
        self.write("bihive.fish", self.describe("fish"))

        def complete(line):
            done = subprocess.run(["fish", "--no-config", "-c", f"source bihive.fish; complete -C '{line}'"], cwd=self.folder,
                                  env={**os.environ, "HOME": self.folder, "XDG_CONFIG_HOME": self.folder, "XDG_DATA_HOME": self.folder},
                                  text=True, capture_output=True, timeout=600)
            self.assertEqual(done.stderr, "")
            return [offered.split("\t")[0] for offered in done.stdout.splitlines()]

        self.assertEqual(sorted(complete("bihive ")), sorted(self.commands()))
        self.assertEqual(sorted(complete("bihive render demo --")), sorted(n for n in self.options("render") if n.startswith("--")))
        self.assertEqual(complete("bihive render demo --view t"), ["traversal", "tree"])
        self.assertEqual(complete("bihive thesis table"), ["table-4.2"])


if __name__ == "__main__":
    main()
