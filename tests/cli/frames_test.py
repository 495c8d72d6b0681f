"""Files with many frames: bihive info --frames, packed files, and the memory that a frame takes."""

import gzip
import os
import shutil
import subprocess

from program import ProgramTest, main


def dump(frames, atoms):
    """A LAMMPS dump whose number of atoms grows by one each frame."""
    text = []
    for frame in range(frames):
        count = atoms + frame
        text.append(
            f"ITEM: TIMESTEP\n{frame * 10}\nITEM: NUMBER OF ATOMS\n{count}\nITEM: BOX BOUNDS pp pp pp\n"
            f"0 {10 + frame}\n0 20\n0 30\nITEM: ATOMS id type x y z radius charge\n"
        )
        text += [f"{i} 1 {i % 10} {frame} {i % 7} 0.5 {frame - i}\n" for i in range(count)]
    return "".join(text)


class Frames(ProgramTest):
    def test_all_frames(self):
        self.write("a.dump", dump(150, 5))
        told = self.succeed_json("info", "a.dump", "--frames")
        self.assertEqual(told["frames"], 150)
        self.assertEqual(told["format"], "LAMMPS dump")
        self.assertEqual(told["spheres"], {"min": 5, "max": 154})
        self.assertEqual(told["step"], {"min": 0, "max": 1490})
        self.assertIsNone(told["time_ps"])
        self.assertEqual(told["bounds"], {"lo": [-0.5, -0.5, -0.5], "hi": [9.5, 149.5, 6.5]})
        self.assertEqual(told["radius"], {"min": 0.5, "max": 0.5})
        self.assertEqual(told["cell"]["frames"], 150)
        self.assertEqual(told["cell"]["edges"][0], {"min": 10, "max": 159})
        self.assertEqual(told["cell"]["volume"], {"min": 6000, "max": 159 * 600})
        charge = [one for one in told["attributes"] if one["name"] == "charge"]
        self.assertEqual(charge, [{"name": "charge", "min": -4, "max": 149}])
        text = self.succeed("info", "a.dump", "--frames")
        for line in ["150 frames", "5 to 154", "0 to 1,490", "10 to 159"]:
            self.assertIn(line, text)

    def test_of_a_trajectory(self):
        folder = os.path.join(os.environ["BIHIVE_SOURCE"], "tests/data/io/trajectories")
        told = self.succeed_json("info", f"{folder}/water.gro", f"{folder}/water.trr", "--frames")
        self.assertEqual((told["frames"], told["spheres"]), (3, {"min": 30, "max": 30}))
        self.assertEqual(told["time_ps"]["max"], 4)

    def test_a_fault_in_a_later_frame(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n" * 3 + "1\n\nC 0 zero 0\n" + "1\n\nC 0 0 0\n")
        self.assertIn("a.xyz:12:5:", self.fail_input("info", "a.xyz", "--frames"))

    def test_a_kept_index(self):
        self.write("a.dump", dump(20, 5))
        first = self.succeed("info", "a.dump", "--frames", "--keep-index")
        self.assertTrue(os.path.isfile(self.path("a.dump.bihive-index")))
        self.assertEqual(self.succeed("info", "a.dump", "--frames", "--keep-index"), first)
        self.write("a.dump.bihive-index", self.read("a.dump.bihive-index")[:-9])
        done = self.run_bihive("info", "a.dump", "--frames", "--keep-index")
        self.assertEqual((done.returncode, done.stdout), (0, first))
        self.assertIn("made anew", done.stderr)
        self.fail_usage("info", "a.dump", "--keep-index")

    def test_usage(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        for words in [("demo",), ("scenario1",), ("-",), ("a.xyz", "--frame", "0"), ("a.xyz", "--attributes")]:
            self.fail_usage("info", *words, "--frames")

    def test_packed(self):
        text = dump(4, 50)
        self.write("a.dump", text)
        self.write("a.dump.gz", gzip.compress(text.encode()))
        names = ["a.dump", "a.dump.gz"]
        if shutil.which("zstd"):
            subprocess.run(["zstd", "-q", "a.dump"], cwd=self.folder, check=True)
            names.append("a.dump.zst")
            self.write("cut.dump.zst", self.read("a.dump.zst")[:-20])
            self.assertIn("the zstd data is cut", self.fail_input("info", "cut.dump.zst"))
            self.write("damaged.dump.zst", self.read("a.dump.zst")[:40] + bytes(40) + self.read("a.dump.zst")[80:])
            self.assertIn("the zstd data is damaged", self.fail_input("info", "damaged.dump.zst"))
        told = [self.succeed_json("info", name, "--frame", "3") for name in names]
        for one in told:
            self.assertEqual(one["spheres"], 53)
            del one["name"]
            self.assertEqual(one, told[0])

    def test_memory_holds_a_frame(self):
        """Sixty megabytes of frames, and no more than before for one of them."""
        peaks = []
        for name, frames in [("one.dump", 1), ("many.dump", 800)]:
            self.write(name, dump(frames, 2000))
            code, _, err, peak = self.peak("info", name, "--frame", str(frames - 1))
            self.assertEqual(code, 0, err)
            peaks.append(peak)
        self.assertGreater(os.path.getsize(self.path("many.dump")), 30e6)
        self.assertLess(peaks[1], peaks[0] + 10e6)


if __name__ == "__main__":
    main()
