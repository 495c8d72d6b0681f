"""No output of a request is a file that it reads, whichever option names that. The options come from the program's own
description, so that one that is added later is tried too."""

# ctest: COST 300

import os
import shutil
import unittest

import numpy
from program import ProgramTest, main

XYZ = "2\n\nO 0 0 0\nH 1 0 0\n2\n\nO 0 0 0\nH 1 0 1\n"
SMALL = ["--size", "8x8", "--samples", "1"]
# The outputs of each command, with the ending that each must have, and a command line without them.
OUTPUTS = {
    "render": [("--output", ".png"), ("--output", ".exr")],
    "again": [("--output", ".png")],
    "verify": [("--difference", ".png")],
    "film": [("--output", ".y4m"), ("--output", ".y4m.json"), ("--output", ".y4m.part/film.json"), ("--output", "%02d.png")],
    "view": [("--screenshot", ".png")],
    "trace": [("--t", ".npy"), ("--id", ".npy")],
    "convert": [("--output", ".xyz"), ("--output", ".csv"), ("--output", ".npy"), ("--output", ".ply"), ("--output", ".json")],
    "compare": [("--output", ".html")],
    "measure": [("--per-sphere", ".csv"), ("--cavities", ".csv"), ("--contacts", ".csv"), ("--buried", ".csv")],
    "scene-save": [("SCENE", ".json")],
    "thesis": [("--out", "report.html"), ("--out", "results.json")],
    "web": [("--html", ".html")],
}
NO_OUTPUT = {"stats", "tune", "info", "select", "scene", "styles"}
# `bihive view` and `bihive web` take the names of looks and colours alone; `bihive thesis --page` is an output, and the only one.
REFUSED = {("view", "--style"), ("view", "--element-colours"), ("web", "--style"), ("web", "--element-colours"), ("thesis", "--page")}


class RequestFilesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("in.xyz", XYZ)
        numpy.save(self.path("rays.npy"), numpy.ones((2, 6), dtype=numpy.float32))
        self.succeed("film", "in.xyz", "-o", "film.y4m", *SMALL)
        self.succeed("render", "in.xyz", "-o", "figure.png", *SMALL)

    def options(self):
        """(command, option) of each place that takes a file, but for the outputs."""
        lines = [line.split()[:2] for line in self.succeed("describe", "options").splitlines() if line.endswith(" files")]
        outputs = {(command, option) for command, all_of in OUTPUTS.items() for option, _ in all_of} | {("scene", "--output")}
        return [(command, option) for command, option in lines if (command, option) not in outputs]

    def content(self, option):
        """What a command must read before it can know its outputs."""
        if option == "--film":
            return self.read("film.y4m.json")
        if option == "FIGURE":
            return self.read("figure.png")
        return XYZ.encode()

    def words(self, command, option, named, output, output_option):
        """The command line, and the path of the output that is the input `named`."""
        words = [command]
        if output_option == "SCENE":
            words.append(output)
        if option == "FIGURE":
            return words + [named, output_option, output]
        if command == "again":
            words.append("figure.png")
        if option != "INPUT" and command not in ("thesis",):
            words.append("in.xyz")
        for needed, value in {"trace": [("--rays", "rays.npy"), ("--t", "t.npy"), ("--id", "id.npy")],
                              "convert": [("--format", "xyz")], "measure": [("--by", "element")]}.get(command, []):
            if needed not in (option, output_option):
                words += [needed, value]
        # A picture of a film has the film's size.
        if command in ("render", "film") and option != "--film":
            words += SMALL
        if command == "thesis":
            words += ["figure-4.1", "--quick"]
        words += [named] if option in ("INPUT", "TRAJECTORY") else [option, named]
        if option == "--film":
            words += ["--picture", "0"]
        if option == "--title-values":
            words += ["--title", "{a}"]
        return words if output_option == "SCENE" else words + [output_option, output]

    def try_all(self, link):
        tried = set()
        for command, option in self.options():
            if command in NO_OUTPUT:
                continue
            for output_option, ending in OUTPUTS[command]:
                with self.subTest(command=command, option=option, output=output_option + ending, link=link):
                    tried.add((command, option))
                    output = named = "same" + ending
                    if command == "thesis":
                        os.mkdir(self.path("out"))
                        output, named = "out", "out/" + ending
                    elif ending.startswith(".y4m."):
                        output = "same.y4m"
                    elif "%" in ending:
                        named = "same00.png"
                    if "/" in named and not os.path.isdir(self.path(os.path.dirname(named))):
                        os.mkdir(self.path(os.path.dirname(named)))
                    content = self.content(option)
                    self.write(named, content)
                    asked = named
                    if link:
                        asked = "other" + os.path.splitext(named)[1]
                        os.symlink(named, self.path(asked))
                    before = self.contents()
                    done = self.run_bihive(*self.words(command, option, asked, output, output_option))
                    self.assertEqual(self.contents(), before, done.stderr)
                    self.assert_one_error_line(done.stderr)
                    if (command, option) not in REFUSED:
                        self.assertEqual(done.returncode, 1, done.stderr)
                        self.assertRegex(done.stderr, "is the input .* too|film's parts", done.stderr)
                for name in ["same.y4m.part", "out"]:
                    shutil.rmtree(self.path(name), ignore_errors=True)
                for name in os.listdir(self.folder):
                    if name.startswith(("same", "other")):
                        os.remove(self.path(name))
        return tried

    def test_every_option_that_names_a_file(self):
        tried = self.try_all(link=False)
        self.assertGreaterEqual(tried, {("again", "FIGURE"), ("verify", "FIGURE"), ("render", "--title-values"), ("render", "--film"), ("render", "--style"),
                                        ("film", "--camera-keys"), ("trace", "--rays"), ("convert", "--trajectory"),
                                        ("view", "INPUT"), ("thesis", "--device")})

    def test_and_by_a_link(self):
        self.try_all(link=True)

    def test_files_that_a_scene_names(self):
        self.write("spheres.y4m", XYZ)
        self.write("scene.json", '{"bihive_scene": 1, "spheres": {"file": "spheres.y4m"}}')
        self.assertIn("is the input", self.fail_input("film", "scene.json", "-o", "spheres.y4m", *SMALL))
        self.write("spheres05.png", XYZ)
        self.write("numbered.json", '{"bihive_scene": 1, "spheres": {"file": "spheres05.png"}}')
        self.assertIn("is the input", self.fail_input("film", "numbered.json", "-o", "spheres%02d.png", *SMALL))


if __name__ == "__main__":
    main()
