"""BIHIVE_TARGET: every instruction set of the machine can be forced, is named in the output, and gives the same bytes."""

import json
import os
import re

import numpy
from program import ProgramTest, main


class Targets(ProgramTest):
    def with_target(self, target, *arguments):
        return self.run_bihive(*arguments, env={**os.environ, "BIHIVE_TARGET": target})

    def targets(self):
        """The targets in the error message about an unknown target."""
        done = self.with_target("abacus", "info", "demo")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assert_one_error_line(done.stderr)
        self.assertIn("BIHIVE_TARGET", done.stderr)
        self.assertIn("'abacus'", done.stderr)
        return re.search(r"choose one of: ([a-z0-9, ]+)", done.stderr).group(1).split(", ")

    def test_an_unknown_one_names_those_that_there_are(self):
        targets = self.targets()
        self.assertIn("scalar", targets)
        self.assertLessEqual(set(targets), {"avx512", "avx2", "sse4", "neon", "scalar"})
        for command in (["stats", "demo"], ["render", "demo", "-o", "a.png"], ["--version"]):
            self.assertEqual(self.with_target("AVX2", *command).returncode, 2, command)
        self.assertFalse(os.path.exists(self.path("a.png")))

    def test_the_best_is_the_default(self):
        self.assertEqual(self.succeed_json("info", "demo")["target"], self.targets()[0])

    def test_each_renders_the_same_picture(self):
        pictures = set()
        for target in self.targets():
            done = self.with_target(target, "render", "scenario2", "--size", "200x150", "--recursion", "3", "-o", "a.png", "--json")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            said = json.loads(done.stdout)
            self.assertEqual((said["engine"], said["target"]), ("wide", target))
            pictures.add(self.read("a.png"))
        self.assertEqual(len(pictures), 1)
        self.succeed("render", "scenario2", "--size", "200x150", "--recursion", "3", "-o", "a.png", "--engine", "reference")
        self.assertEqual(pictures, {self.read("a.png")})

    def test_engines_without_vectors_have_no_target(self):
        said = self.succeed_json("render", "demo", "--size", "20x20", "-o", "a.png", "--engine", "reference")
        self.assertIsNone(said["target"])

    def test_each_traces_the_same_hits(self):
        random = numpy.random.default_rng(3)
        origins = random.uniform(-30, 30, (20000, 3))
        rays = numpy.hstack([origins, random.uniform(-12, 12, (20000, 3)) - origins]).astype(numpy.float32)
        numpy.save(self.path("rays.npy"), rays)
        answers = set()
        for target in self.targets():
            for any_hit in [], ["--any"]:
                arguments = ["--rays", "rays.npy", "--t", "t.npy", "--id", "id.npy", *any_hit]
                done = self.with_target(target, "trace", "scenario3", *arguments)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(f"engine wide on {target},", done.stdout)
                answers.add((bool(any_hit), self.read("t.npy"), self.read("id.npy")))
        self.assertEqual(len(answers), 2)

    def test_each_builds_the_same_tree(self):
        numbers = []
        for target in self.targets():
            wide = json.loads(self.with_target(target, "stats", "scenario2", "--json").stdout)["wide"]
            self.assertEqual(wide.pop("target"), target)
            wide.pop("build_ms")
            numbers.append(wide)
        for other in numbers[1:]:
            self.assertEqual(other, numbers[0])


if __name__ == "__main__":
    main()
