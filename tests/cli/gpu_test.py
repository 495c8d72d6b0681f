"""--engine gpu: the messages when it cannot be used. (tests/gl tests everything that needs a driver.)"""

import os

from program import ProgramTest, main


class Gpu(ProgramTest):
    def test_without_egl_the_exit_code_is_3(self):
        environment = {**os.environ, "BIHIVE_EGL": "/nowhere/libEGL.so"}
        for engine in ["gpu", "gpu-brute"]:
            said = self.fail_with(3, "render", "scenario1", "--engine", engine, "--count", "8", "-o", "a.png", env=environment)
            self.assertIn("there is no EGL (/nowhere/libEGL.so)", said)
            self.assertIn("apt-get install libegl1 libgl1-mesa-dri", said)
        # A library that is not EGL.
        environment["BIHIVE_EGL"] = "libz.so.1"
        said = self.fail_with(3, "render", "scenario1", "--engine", "gpu", "--count", "8", "-o", "a.png", env=environment)
        self.assertIn("libz.so.1 is no EGL", said)

    def test_views_that_it_does_not_have(self):
        said = self.fail_usage("render", "scenario1", "--engine", "gpu", "--view", "tree", "-o", "a.png")
        self.assertIn("--view tree is drawn by the CPU alone, not by --engine gpu", said)
        said = self.fail_usage("render", "scenario1", "--engine", "gpu-brute", "--view", "traversal", "-o", "a.png")
        self.assertIn("--view traversal shows a tree, and --engine gpu-brute has none", said)

    def test_it_draws_and_does_not_trace(self):
        said = self.fail_usage("trace", "demo", "--rays", "r.npy", "--t", "t.npy", "--id", "i.npy", "--engine", "gpu")
        for name in ["auto", "wide", "reference", "brute"]:
            self.assertIn(name, said)


if __name__ == "__main__":
    main()
