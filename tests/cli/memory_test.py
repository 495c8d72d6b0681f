"""Every command refuses an input that cannot fit the machine's memory, before any work and with the same words."""

import os

from program import ProgramTest, main


class Memory(ProgramTest):
    def refused(self, memory, *arguments):
        environment = {**os.environ, "BIHIVE_MEMORY": str(memory)}
        return self.fail_input(*arguments, env=environment)

    def test_a_tree(self):
        small_picture = ["render", "demo", "-o", "a.png", "--size", "10x10"]
        for arguments in (small_picture, ["stats", "demo"]):
            message = self.refused(20000, *arguments)
            self.assertIn("the tree of 1,631 spheres would take about", message)
            self.assertIn("of memory, and this machine has 20 kB", message)
        self.assertFalse(os.path.exists(self.path("a.png")))
        done = self.run_bihive(*small_picture, env={**os.environ, "BIHIVE_MEMORY": "1000000"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_window(self):
        """The window program refuses it before it opens a window, so this needs no screen."""
        if "BIHIVE_VIEW" not in os.environ:
            self.skipTest("bihive-view was not built")
        self.assertIn("the tree of 1,631 spheres would take about", self.refused(20000, "view", "demo"))
        self.assertIn("so many spheres would take", self.refused(20000, "view", "scenario1"))

    def test_a_scenario_and_a_picture(self):
        self.assertIn("so many spheres would take", self.refused(20000, "info", "scenario1"))
        large = ["render", "four-spheres", "-o", "a.png", "--size", "1000x1000"]
        self.assertIn("so large a picture would take about 18 MB", self.refused(1000000, *large))


if __name__ == "__main__":
    main()
