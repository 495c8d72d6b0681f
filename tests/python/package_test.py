"""The package as a whole: docstrings, the page docs/python.md, types, what an import costs."""

import doctest
import importlib
import inspect
import os
import pkgutil
import re
import shutil
import subprocess
import sys
import unittest

import bihive as bh
from program import PATIENCE_S, ProgramTest, main

SOURCE = os.environ["BIHIVE_SOURCE"]
PACKAGE = os.path.dirname(bh.__file__)
PAGE = os.path.join(SOURCE, "docs", "python.md")


class Documentation(ProgramTest):
    def test_examples_in_docstrings(self):
        examples = 0
        for info in pkgutil.iter_modules(bh.__path__):
            if info.name == "_bihive":
                continue
            module = importlib.import_module("bihive." + info.name)
            names = {**vars(module), "render": bh.render, "read": bh.read}
            result = doctest.testmod(module, extraglobs=names)
            self.assertEqual(result.failed, 0, info.name)
            examples += result.attempted
        result = doctest.testmod(bh)
        self.assertEqual(result.failed, 0)
        self.assertGreater(examples + result.attempted, 20)

    def test_everything_public_is_explained(self):
        self.assertEqual(sorted(bh.__all__), bh.__all__)
        for name in bh.__all__:
            thing = getattr(bh, name)
            if name.startswith("__"):
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            for member, value in vars(thing).items() if inspect.isclass(thing) else []:
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    if member != "words":
                        self.assertTrue(inspect.getdoc(value), f"{name}.{member}")

    def test_the_page(self):
        with open(PAGE, encoding="utf-8") as file:
            page = file.read()
        blocks = re.findall(r"^```python( notest)?\n(.*?)^```", page, re.M | re.S)
        self.assertGreater(len(blocks), 5)
        shutil.copy(os.path.join(SOURCE, "data", "1hpv.pdb"), self.folder)
        names, before = {}, os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        for left_out, block in blocks:
            if not left_out:
                exec(compile(block, PAGE, "exec"), names)

    def test_every_option_of_the_command_line_is_known(self):
        help_text = self.succeed("render", "--help-all")
        options = set(re.findall(r"^\s+(?:-\w,)?(?:TRAJECTORY,)?(--[a-z-]+)", help_text, re.M))
        self.assertGreater(len(options), 50)
        # The input, the output, and what has another form here.
        elsewhere = {"--help", "--help-all", "--output", "--layers", "--film", "--picture", "--json", "--no-metadata", "--methods",
                     "--select", "--hide", "--show"}
        from bihive import _options

        known = set(_options.ONE_VALUE + _options.FLAGS + _options.SWITCHES + _options.SIZES + _options.ACTIONS + ["light"])
        spelt = {"--" + name.replace("_", "-") for name in known} | {"--no-" + name.replace("_", "-") for name in _options.SWITCHES}
        self.assertEqual(options - spelt - elsewhere, set())
        self.assertEqual(spelt - options, set())


class Tutorial(ProgramTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("build"))
        os.symlink(os.environ["BIHIVE"], self.path("build/bihive"))
        os.symlink(os.path.join(SOURCE, "data"), self.path("data"))

    def blocks(self, page, kind):
        with open(os.path.join(SOURCE, "docs", "tutorial", page), encoding="utf-8") as file:
            return re.findall(rf"^```{kind}\n(.*?)^```", file.read(), re.M | re.S)

    def test_commands_run_as_pasted(self):
        # Only pictures and films are smaller, so that the test is.
        ran = 0
        for page in ["first_picture.md", "own_looks.md", "films.md"]:
            for block in self.blocks(page, "sh"):
                block = re.sub(r" --(size|pictures) \S+", "", block.replace("\\\n", " "))
                block = re.sub(r"^build/bihive render (?!--film).*", r"\g<0> --size 96x72 --samples 1", block, flags=re.M)
                block = re.sub(r"^build/bihive film .*", r"\g<0> --size 96x72 --samples 1", block, flags=re.M)
                block = re.sub(r"^.*--turntable.*", r"\g<0> --pictures 3", block, flags=re.M)
                done = subprocess.run(["bash", "-e", "-c", block], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE_S)
                self.assertEqual(done.returncode, 0, page + ":\n" + block + done.stdout + done.stderr)
                ran += block.count("build/bihive")
        self.assertGreater(ran, 15)

    def test_python_runs_as_pasted(self):
        here = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, here)
        names = {}
        blocks = self.blocks("python.md", "python")
        self.assertEqual(len(blocks), 3)
        for block in blocks:
            exec(compile(re.sub(r"size=\(\d{3}, \d{3}\)", "size=(64, 48)", block).replace('select="chain A")', 'select="chain A", size=(64, 48))'), "python.md", "exec"), names)
        for name in ["cloud.png", "a.png", "run.mp4"]:
            self.assertGreater(os.path.getsize(name), 100)


class Types(ProgramTest):
    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed: scripts/setup test installs it")
    def test_mypy(self):
        # Debian's mypy runs under Debian's python, and looks into the folder where it is called.
        done = subprocess.run(
            [shutil.which("mypy"), "--strict", "--enable-incomplete-feature=Unpack", "--cache-dir", self.path("cache"), "-p", "bihive"],
            cwd=os.path.dirname(PACKAGE), capture_output=True, text=True, timeout=PATIENCE_S,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(os.path.exists(os.path.join(PACKAGE, "py.typed")))

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed: scripts/setup test installs it")
    def test_a_checker_finds_wrong_options_and_knows_the_answers(self):
        program = self.path("user.py")
        with open(program, "w", encoding="utf-8") as file:
            file.write(
                "import bihive as bh\n"
                "p = bh.render('demo', size=(8, 6), samples=1, ao=True, eye=(0, 0, 9), view='normal', looks=bh.Look('all'), fog=None)\n"
                "bh.render('demo', ao='yes')\n"
                "bh.render('demo', opacty_rule='once')\n"
                "bh.read('demo', frame='x')\n"
                "bh.film('demo', 'a.mp4', turntable=360, size=(8, 6), samples=1, turn_axis='z', colour_range='film')\n"
                "bh.film('demo', 'a.mp4', turn_axis='w')\n"
                "bh.film('demo', 'a.mp4', turntabel=3)\n"
                "hits = bh.Tree(bh.read('demo')).closest([[0, 0, 0]], [1, 0, 0])\n"
                "reveal_type(hits.t)\n"
                "reveal_type(hits.normals())\n"
            )
        done = subprocess.run(
            [shutil.which("mypy"), "--strict", "--enable-incomplete-feature=Unpack", "--cache-dir", self.path("cache"), program],
            capture_output=True, text=True, timeout=PATIENCE_S, env={**os.environ, "MYPYPATH": os.path.dirname(PACKAGE)},
        )
        found = [line.split("user.py:")[1] for line in done.stdout.splitlines() if "user.py:" in line]
        for line, says in ((3, 'Argument "ao"'), (4, 'did you mean "opacity_rule"'), (5, 'Argument "frame"'), (7, 'Argument "turn_axis"'), (8, 'did you mean "turntable"')):
            self.assertTrue(any(one.startswith(f"{line}: error: ") and says in one for one in found), done.stdout)
        for line in (10, 11):
            self.assertTrue(any(one.startswith(f"{line}: note: ") and "numpy.floating" in one for one in found), done.stdout)
        self.assertEqual(sum(": error: " in one for one in found), 5, done.stdout)

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed: scripts/setup test installs it")
    def test_stubtest(self):
        settings = self.path("mypy.ini")
        with open(settings, "w", encoding="utf-8") as file:
            file.write("[mypy]\nenable_incomplete_feature = Unpack\n")
        allowed = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stubtest_allowed.txt")
        # Debian's mypy is a module of Debian's python.
        done = subprocess.run(
            ["/usr/bin/python3", "-m", "mypy.stubtest", "bihive", "--concise", "--mypy-config-file", settings, "--allowlist", allowed],
            capture_output=True, text=True, timeout=PATIENCE_S, cwd=self.folder,
            env={**os.environ, "PYTHONPATH": os.path.dirname(PACKAGE)},
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_films_know_their_options(self):
        from bihive import _film, _option_types

        own = set(_option_types.FilmOptions.__annotations__) - set(_option_types.RenderOptions.__annotations__)
        self.assertEqual(own, {*_film._OF_PROGRAM, *_film._FLAGS_OF_PROGRAM} - {"frames"})

    def test_the_stub_names_what_the_module_has(self):
        from bihive import _bihive

        with open(os.path.join(PACKAGE, "_bihive.pyi"), encoding="utf-8") as file:
            stub = file.read()
        stated = set(re.findall(r"^(?:class|def) (\w+)", stub, re.M)) | {"__version__"}
        self.assertEqual(stated, {name for name in vars(_bihive) if not name.startswith("__")} | {"__version__"})
        for name in ["Spheres", "Picture", "Tree"]:
            body = re.search(rf"^class {name}:\n((?:    .*\n|\n)+)", stub, re.M).group(1)
            members = set(re.findall(r"^    def (\w+)", body, re.M)) - {"__len__"}
            real = {member for member in vars(getattr(_bihive, name)) if not member.startswith("_")}
            self.assertEqual(members, real, name)


class Import(unittest.TestCase):
    def test_it_brings_nothing_along(self):
        code = "import sys, numpy\nbefore = set(sys.modules)\nimport bihive\n"
        code += "print(sorted({name.split('.')[0] for name in set(sys.modules) - before}))"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=PATIENCE_S)
        brought = set(eval(done.stdout)) - set(sys.stdlib_module_names)
        self.assertEqual(brought, {"bihive"})

    def test_version(self):
        done = subprocess.run([os.environ["BIHIVE"], "--version"], capture_output=True, text=True)
        self.assertEqual(done.stdout.split()[1], bh.__version__)


if __name__ == "__main__":
    main()
