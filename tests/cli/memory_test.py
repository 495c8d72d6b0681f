"""Every command refuses an input that cannot fit the machine's memory, before any work and with the same words."""

import os
import subprocess
import tempfile

from program import BIHIVE, PATIENCE_S, ProgramTest, is_sanitized, main


def make_group(limit):
    """A control group of its own below this process's, with that many bytes of memory: its folder, or why there is none."""
    try:
        with open("/proc/self/cgroup") as file:
            groups = [line.strip().split(":", 2) for line in file]
    except OSError as error:
        return None, f"the system names no control groups: {error}"
    places = [("/sys/fs/cgroup/memory" + group, "memory.limit_in_bytes") for _, names, group in groups
              if "memory" in names.split(",")]
    places += [("/sys/fs/cgroup" + group, "memory.max") for _, names, group in groups if names == ""]
    reason = "no control group holds memory here"
    for parent, name in places:
        try:
            folder = tempfile.mkdtemp(prefix="bihive_", dir=parent)
        except OSError as error:
            reason = f"no control group can be made: {error}"
            continue
        try:
            with open(os.path.join(folder, name), "w") as file:
                file.write(str(limit))
            return folder, ""
        except OSError as error:
            reason = f"a control group cannot be limited: {error}"
            os.rmdir(folder)
    return None, reason


class Memory(ProgramTest):
    def refused(self, memory, *arguments):
        environment = {**os.environ, "BIHIVE_MEMORY": str(memory)}
        return self.fail_input(*arguments, env=environment)

    def run_in_group(self, folder, *words):
        script = 'echo $$ > "$0/cgroup.procs" && exec "$@"'
        return subprocess.run(["sh", "-c", script, folder, BIHIVE, *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=PATIENCE_S)

    def test_a_tree(self):
        small_picture = ["render", "demo", "-o", "a.png", "--size", "10x10"]
        for arguments in (small_picture, ["stats", "demo"]):
            message = self.refused(20000, *arguments)
            self.assertIn("the tree of 1,631 spheres would take about", message)
            self.assertIn("of memory, and BIHIVE_MEMORY allows 20 kB", message)
        self.assertFalse(os.path.exists(self.path("a.png")))
        done = self.run_bihive(*small_picture, env={**os.environ, "BIHIVE_MEMORY": "1000000"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_control_group(self):
        """The limit of a container is asked for. What it does not allow is refused, so that nothing is killed."""
        folder, reason = make_group(480 << 20)  # the address sanitizer alone takes 160 MB and more
        if folder is None:
            self.skipTest(reason)
        self.addCleanup(os.rmdir, folder)

        def limited(*words):
            return self.run_in_group(folder, *words)

        done = limited("render", "scenario1", "--count", "30000000", "-o", "a.png", "--size", "10x10")
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertIn("and this control group, which allows 503 MB, leaves", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])
        done = limited("render", "demo", "-o", "a.png", "--size", "10x10")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_what_a_control_group_does_not_hold_is_refused_before_the_kernel_kills(self):
        """From far too little to enough: done, or one line that names the limit."""
        if is_sanitized():
            self.skipTest("the address sanitizer alone takes more than these groups allow")
        self.succeed("scene", "scenario2", "--count", "200000", "-o", "s.npy")
        self.succeed("convert", "s.npy", "-o", "s.extxyz")
        picture = ["-o", "a.png", "--size", "320x240", "--samples", "1"]
        commands = (["render", "s.npy", *picture], ["render", "s.extxyz", *picture], ["info", "s.npy"], ["stats", "s.extxyz"],
                    ["convert", "s.npy", "-o", "b.csv"], ["render", "demo", *picture[:2], "--size", "1500x1500"])
        ends = set()
        for megabytes in (16, 24, 32, 40, 48, 64, 200):
            folder, reason = make_group(megabytes << 20)
            if folder is None:
                self.skipTest(reason)
            self.addCleanup(os.rmdir, folder)
            for words in commands:
                with self.subTest(f"{megabytes} MB: {words}"):
                    done = self.run_in_group(folder, *words)
                    if megabytes == 16 and done.returncode == -9 and done.stderr == "":
                        continue  # too little for the program alone
                    self.assertIn(done.returncode, (0, 1), done.stderr)
                    ends.add(done.returncode)
                    if done.returncode == 1:
                        self.assertIn("control group", done.stderr)
                        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                    else:
                        self.assertEqual(done.stderr, "")
                    self.assertTrue(megabytes < 200 or done.returncode == 0, done.stderr)
        self.assertEqual(ends, {0, 1})

    def test_a_window(self):
        """The window program refuses it before it opens a window, so this needs no screen."""
        if "BIHIVE_VIEW" not in os.environ:
            self.skipTest("bihive-view was not built")
        self.assertIn("the tree of 1,631 spheres would take about", self.refused(20000, "view", "demo"))
        self.assertIn("this many spheres would take", self.refused(20000, "view", "scenario1"))

    def test_a_scenario_and_a_picture(self):
        self.assertIn("this many spheres would take", self.refused(20000, "info", "scenario1"))
        whole = ["render", "four-spheres", "-o", "a.png", "--size", "1000x1000", "--view", "distance"]
        self.assertIn("so large a picture would take about 18 MB", self.refused(1000000, *whole))

    def test_a_picture_that_does_not_fit_is_drawn_in_bands(self):
        """The same file, from any amount of memory."""
        labels = ["--projection", "orthographic", "--scale-bar", "--axes", "--title", "Title"]
        for more in (["--bits", "16"], ["--background", "none", *labels], ["--samples", "auto", "--crop", "5,50,190,220"]):
            arguments = ["render", "demo", "--size", "200x240", *more]
            self.succeed(*arguments, "-o", "whole.png")
            done = self.run_bihive(*arguments, "-o", "bands.png", env={**os.environ, "BIHIVE_MEMORY": "1000000"})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(self.read("whole.png"), self.read("bands.png"))
            self.assertEqual(sorted(os.listdir(self.folder)), ["bands.png", "whole.png"])
            on_output = subprocess.run([BIHIVE, *arguments, "-o", "-"], cwd=self.folder, capture_output=True,
                                       timeout=PATIENCE_S, env={**os.environ, "BIHIVE_MEMORY": "1000000"})
            self.assertEqual(on_output.stdout, self.read("whole.png"))


if __name__ == "__main__":
    main()
