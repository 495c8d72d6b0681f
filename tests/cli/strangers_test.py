"""Files of strangers: what they name on the disk is not opened, what they claim takes no memory, what nests deep is refused."""

import glob
import gzip
import importlib.util
import io
import json
import os
import shutil
import struct
import subprocess
import unittest

import numpy
from program import BIHIVE, ProgramTest, main

PLACES = [[0, 1, 2], [3, 4, 5]]


@unittest.skipUnless(importlib.util.find_spec("h5py"), "needs h5py")
class OtherFiles(ProgramTest):
    """HDF5 files that name others. Each is refused by the name of what it names."""

    def setUp(self):
        super().setUp()
        import h5py

        self.h5py = h5py
        with h5py.File(self.path("other.h5"), "w") as file:
            file["positions"] = PLACES
            file["group/positions"] = PLACES
            file["particles/all/position/value"] = [PLACES]
        self.write("secret.bin", bytes(range(90)))

    def make(self, name):
        return self.h5py.File(self.path(name), "w", libver="latest")

    def refused(self, *arguments, by):
        told = self.fail_input("convert", *arguments, "-o", "out.csv")
        for words in by:
            self.assertIn(words, told)
        self.assertNotIn("damaged", told)
        return told

    def test_external_storage(self):
        with self.make("a.h5") as file:
            file.create_dataset("positions", shape=(30, 3), dtype="u1", external=[(self.path("secret.bin"), 0, 90)])
            file["inside/xyz"] = PLACES
        by = ["a.h5: the data set '/positions' keeps its numbers in another file", "secret.bin", "copy all into one file"]
        self.refused("a.h5", by=by)
        self.refused("a.h5", "--columns", "x=1,y=2,z=3", by=by)
        self.refused("a.h5:/positions", by=by)
        # What else is in the file can be read by its name.
        self.succeed("info", "a.h5:/inside/xyz", "--radius", "1")

    def test_external_links(self):
        with self.make("a.h5") as file:
            file["positions"] = self.h5py.ExternalLink("other.h5", "/positions")
        self.refused("a.h5", by=["'/positions' is a link into another file ('other.h5')"])
        self.refused("a.h5:/positions", by=["link into another file ('other.h5')"])
        with self.make("group.h5") as file:
            file["group"] = self.h5py.ExternalLink("other.h5", "/group")
            file["soft"] = self.h5py.SoftLink("/group/positions")
        for name in ("group.h5", "group.h5:/group", "group.h5:/group/positions", "group.h5:/soft"):
            self.refused(name, by=["is a link into another file ('other.h5')"])

    def test_h5md(self):
        with self.make("a.h5md") as file:
            file["particles"] = self.h5py.ExternalLink("other.h5", "/particles")
        self.refused("a.h5md", by=["'/particles' is a link into another file"])
        with self.make("b.h5md") as file:
            file["particles/all/position/value"] = [PLACES]
            file["particles/all/mass"] = self.h5py.ExternalLink("other.h5", "/positions")
        self.refused("b.h5md", by=["'/particles/all/mass' is a link into another file"])
        self.write("a.xyz", "2\n\nC 0 0 0\nC 1 1 1\n")
        told = self.fail_input("info", "a.xyz", "a.h5md")
        self.assertIn("'/particles' is a link into another file", told)

    def test_virtual_data_sets(self):
        layout = self.h5py.VirtualLayout(shape=(2, 3), dtype="i8")
        layout[:] = self.h5py.VirtualSource(self.path("other.h5"), "positions", shape=(2, 3))
        growing = self.h5py.VirtualLayout(shape=(2, 3), dtype="f8", maxshape=(None, 3))
        source = self.h5py.VirtualSource(self.path("other.h5"), "positions", shape=(2, 3), maxshape=(None, 3))
        growing[0 : self.h5py.h5s.UNLIMITED, :] = source[0 : self.h5py.h5s.UNLIMITED, :]
        own = self.h5py.VirtualLayout(shape=(2, 3), dtype="i8")
        own[:] = self.h5py.VirtualSource(".", "real", shape=(2, 3))
        with self.make("a.h5") as file:
            file.create_virtual_dataset("positions", layout)
        with self.make("b.h5") as file:
            file.create_virtual_dataset("positions", growing)
        with self.make("c.h5") as file:
            file["real"] = PLACES
            file.create_virtual_dataset("positions", own)
        for name in ("a.h5", "b.h5"):
            self.refused(name, by=["the data set '/positions' keeps its numbers in another file", "other.h5"])
        self.refused("c.h5", by=["the data set '/positions' is put together from others"])
        self.succeed("info", "c.h5:/real", "--radius", "1")

    def test_opens_none(self):
        """Not even to tell a shape: the trace of the calls shows it."""
        if not shutil.which("strace"):
            self.skipTest("needs strace")
        self.test_virtual_data_sets()
        for name in ("a.h5", "b.h5"):
            subprocess.run(
                ["strace", "-f", "-e", "trace=open,openat,openat2", "-o", self.path("trace"), BIHIVE, "info", self.path(name)],
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False,
            )
            trace = self.read("trace") if os.path.exists(self.path("trace")) else b""
            if name.encode() not in trace:
                self.skipTest("strace may not trace here")
            self.assertNotIn(b"other.h5", trace, name)

    def test_filters_of_plug_ins(self):
        with self.make("a.h5") as file:
            file.create_dataset("positions", data=PLACES, chunks=(2, 3), compression="lzf")
        by = ["the data set '/positions' is packed by a filter that libhdf5 has only as a plug-in", "32000", "h5repack -f GZIP=4"]
        self.refused("a.h5", by=by)
        # The library looks for plug-ins where the environment says, and here it does not.
        self.write("libfilter.so", b"\x7fELF")
        environment = {**os.environ, "HDF5_PLUGIN_PATH": self.folder, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": self.path("loaded")}
        subprocess.run([BIHIVE, "info", self.path("a.h5")], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        for name in glob.glob(self.path("loaded*")):
            with open(name, "rb") as file:
                self.assertNotIn(b"libfilter.so", file.read())

    def test_soft_links_and_known_filters(self):
        with self.make("a.h5") as file:
            file.create_dataset("data/places", data=PLACES, chunks=(2, 3), compression="gzip", shuffle=True, fletcher32=True)
            file["positions"] = self.h5py.SoftLink("/data/places")
        self.assertEqual(self.succeed_json("info", "a.h5", "--radius", "1")["spheres"], 2)


@unittest.skipUnless(importlib.util.find_spec("h5py"), "needs h5py")
class Claims(ProgramTest):
    """Shapes of HDF5 files that are not there take no memory."""

    def setUp(self):
        super().setUp()
        import h5py

        self.h5py = h5py

    def little_memory(self, *arguments, says):
        # Beside what the program takes for one sphere, with libhdf5.
        with self.h5py.File(self.path("one_sphere.h5"), "w") as file:
            file["positions"] = [[0, 0, 0]]
        empty_bytes = self.peak("info", "one_sphere.h5")[3]
        code, out, told, bytes_used = self.peak("info", *arguments)
        self.assertEqual((code, out), (1, ""))
        self.assert_one_error_line(told)
        self.assertIn(says, told)
        self.assertLess(bytes_used - empty_bytes, 100e6)

    def test_shapes_without_numbers(self):
        big = (20_000_000, 3)
        with self.h5py.File(self.path("chunks.h5"), "w") as file:
            file.create_dataset("positions", shape=big, dtype="f4", chunks=(1000, 3))
        with self.h5py.File(self.path("late.h5"), "w") as file:
            file.create_dataset("positions", shape=big, dtype="f4", fillvalue=1)
        with self.h5py.File(self.path("one.h5"), "w") as file:
            file.create_dataset("positions", shape=big, dtype="f4", chunks=(1000, 3))[0] = 1
        with self.h5py.File(self.path("packed.h5"), "w") as file:
            file.create_dataset("positions", shape=big, dtype="f4", chunks=(1000, 3), compression="gzip")[5] = 1
        for name in ("chunks.h5", "late.h5", "chunks.h5:/positions"):
            self.little_memory(name, says="'/positions' has a shape, but none of its numbers was ever written")
        for name in ("one.h5", "packed.h5"):
            self.little_memory(name, says="'/positions': some of its numbers were never written")

    def test_packed_beyond_reason(self):
        with self.h5py.File(self.path("a.h5"), "w") as file:
            # Equal numbers take a bit each, and equal bits nearly none.
            file.create_dataset("positions", data=numpy.full((12_000_000, 3), 7, "i4"), chunks=(4_000_000, 3), scaleoffset=0, compression="gzip")
        self.assertLess(os.path.getsize(self.path("a.h5")), 20_000)
        self.little_memory("a.h5", says="'/positions': it is packed beyond reason")

    def test_frames_that_were_not_written_yet(self):
        with self.h5py.File(self.path("a.h5md"), "w") as file:
            value = file.create_dataset("particles/all/position/value", shape=(5, 2, 3), dtype="f8", chunks=(1, 2, 3))
            value[0] = PLACES
            file.create_dataset("particles/all/force/value", shape=(5, 2, 3), dtype="f8", chunks=(1, 2, 3))
        told = self.succeed("info", "a.h5md", "--radius", "1")
        self.assertIn("arrays that were never written are left out: /particles/all/force/value", told)
        self.assertIn("some of its numbers were never written", self.fail_input("info", "a.h5md", "--frame", "1"))


@unittest.skipUnless(importlib.util.find_spec("h5py"), "needs h5py")
class Packed(ProgramTest):
    def test_gzip_zstd_streams_and_times(self):
        import h5py

        with h5py.File(self.path("a.h5"), "w") as file:
            file["positions"] = PLACES
            # More than stays in memory where other formats are unpacked.
            file["other"] = numpy.full(5_000_000, 0.5)
        raw = self.read("a.h5")

        def converted(name, **options):
            done = self.run_bihive("convert", name, "--radius", "1", "--format", "csv", "-o", "-", **options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout

        whole = converted("a.h5")
        self.write("a.h5.gz", gzip.compress(raw, 1))
        names = ["a.h5.gz"]
        if shutil.which("zstd"):
            subprocess.run(["zstd", "-q", self.path("a.h5")], check=True)
            names.append("a.h5.zst")
        for name in names:
            self.assertEqual(converted(name), whole)
        with open(self.path("a.h5"), "rb") as stream:
            self.assertEqual(converted("-", stdin=stream), whole)
        # A time of 0 is a time as any other; so is one that has more nanoseconds than 64 bits hold.
        for seconds in (0, 1 << 33, 1 << 34):
            os.utime(self.path("a.h5"), (seconds, seconds))
            self.assertEqual(converted("a.h5"), whole)


class SharedBytes(ProgramTest):
    """Arrays that lie in each other make many numbers of few bytes."""

    def test_vtk(self):
        count = 1000
        array = '<DataArray type="Float32" Name="a%d" NumberOfComponents="3" format="appended" offset="0"/>'
        head = f'<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="{count}"><Points>{array % 0}</Points><PointData>'
        head += "".join(array % i for i in range(300)) + '</PointData></Piece></PolyData><AppendedData encoding="raw">_'
        self.write("a.vtp", head.encode() + struct.pack("<I", 12 * count) + bytes(12 * count) + b"</AppendedData></VTKFile>")
        self.assertIn("the arrays have more bytes than the file", self.fail_input("info", "a.vtp"))

    def test_netcdf(self):
        def name(text):
            return struct.pack(">I", len(text)) + text.encode() + bytes(-len(text) % 4)

        def variable(text, dimensions, kind, begin):
            return name(text) + struct.pack(f">I{len(dimensions)}I5I", len(dimensions), *dimensions, 0, 0, kind, 0, begin)

        atoms, begin = 1000, 20000
        for dimensions, says in (((0, 1), "the trajectory has no frames|there is no frame 0"), ((1,), "its variables have more bytes than it has")):
            bytes_of = b"CDF\x01" + struct.pack(">III", 1, 10, 3)
            for text, length in (("frame", 0), ("atom", atoms), ("spatial", 3)):
                bytes_of += name(text) + struct.pack(">I", length)
            bytes_of += struct.pack(">II", 12, 1) + name("Conventions") + struct.pack(">II", 2, 5) + b"AMBER" + bytes(3)
            bytes_of += struct.pack(">II", 11, 201) + variable("coordinates", (0, 1, 2), 5, begin)
            for i in range(200):
                bytes_of += variable(f"v{i}", dimensions, 5, begin)
            self.write("a.nc", bytes_of.ljust(begin, b"\0") + bytes(12 * atoms))
            self.assertRegex(self.fail_input("info", "a.nc"), says)

    def test_zip(self):
        places = io.BytesIO()
        numpy.save(places, numpy.zeros((1000, 3), "f4"))
        body = places.getvalue()

        def entry(mark, text):
            return mark + struct.pack("<5H3I2H", 20, 0, 0, 0, 0, 0, len(body), len(body), len(text), 0) + (
                struct.pack("<3H2I", 0, 0, 0, 0, 0) if mark == b"PK\x01\x02" else b"") + text

        local = entry(b"PK\x03\x04", b"a000.npy") + body
        listed = b""
        for i in range(200):
            one = entry(b"PK\x01\x02", b"a%03d.npy" % i)
            listed += b"PK\x01\x02" + struct.pack("<H", 20) + one[4:]
        end = b"PK\x05\x06" + struct.pack("<4H2IH", 0, 0, 200, 200, len(listed), len(local), 0)
        self.write("a.npz", local + listed + end)
        self.assertIn("its members lie in each other", self.fail_input("info", "a.npz"))


class DeepJson(ProgramTest):
    """Brackets in brackets end in one line wherever JSON is read."""

    def test_all_files(self):
        deep = "[" * 300_000 + "]" * 300_000
        self.write("deep.json", deep)
        self.write("deep_scene.json", '{"bihive_scene": 1, "spheres": ' + deep + "}")
        self.write("keys.json", '{"keys": ' + deep + "}")
        self.write("style.json", '{"bihive_style": 1, "material": ' + deep + "}")
        self.write("a.xyz", "1\n\nC 0 0 0\n" * 3)
        says = "deep in each other"
        small = ("--size", "8x8", "--samples", "1")
        self.assertIn(says, self.fail_input("info", "deep_scene.json"))
        self.assertIn(says, self.fail_input("render", "a.xyz", "-o", "o.png", *small, "--style", "style.json"))
        self.assertIn(says, self.fail_input("film", "a.xyz", "-o", "o.y4m", *small, "--camera-keys", "keys.json"))
        self.succeed("film", "a.xyz", "-o", "x.y4m", *small)
        text = self.read("x.y4m.json").decode()
        for name, path in (("camera", ["asked", "camera"]), ("input", ["asked", "input"]), ("options", ["asked", "options"])):
            plan = json.loads(text)
            plan[path[0]][path[1]] = "@"
            self.write("plan.json", json.dumps(plan).replace('"@"', deep))
            self.fail_input("render", "a.xyz", "--film", "plan.json", "--picture", "1", "-o", "o.png")
        self.fail_input("thesis", "figure-4.1", "--out", "here", "--device", "deep.json")


class KeptIndex(ProgramTest):
    """An index beside a file is used only if this user made it for this file as it is."""

    FRAMES = "".join(f"2\nframe {i}\nC {i} 0 0\nC {i} 1 0.5\n" for i in range(10))

    def setUp(self):
        super().setUp()
        self.write("a.xyz", self.FRAMES)
        self.truth = self.succeed("info", "a.xyz", "--frames", "--json")
        self.succeed("info", "a.xyz", "--frames", "--keep-index")

    def told(self):
        done = self.run_bihive("info", "a.xyz", "--frames", "--keep-index", "--json")
        self.assertEqual((done.returncode, done.stdout), (0, self.truth))
        return done.stderr

    def test_content_that_changed_under_its_time(self):
        self.assertEqual(self.told(), "")
        before = os.stat(self.path("a.xyz"))
        with open(self.path("a.xyz"), "r+b") as file:
            file.write(self.FRAMES.replace("C 3 0 0", "C 7 0 0").encode())
        os.utime(self.path("a.xyz"), ns=(before.st_atime_ns, before.st_mtime_ns))
        self.truth = self.succeed("info", "a.xyz", "--frames", "--json")
        self.assertIn("made anew", self.told())

    def test_an_index_from_elsewhere(self):
        """A copy of both, as an archive brings them, has other marks of the system."""
        os.mkdir(self.path("copy"))
        for name in ("a.xyz", "a.xyz.bihive-index"):
            shutil.copy2(self.path(name), self.path("copy/" + name))
        done = self.run_bihive("info", "copy/a.xyz", "--frames", "--keep-index", "--json")
        self.assertEqual(done.returncode, 0)
        self.assertIn("made anew", done.stderr)

    def test_an_index_that_is_wrong(self):
        """Each frame that is read is looked at, and so is what follows the last one."""
        mark = b"bihive frames 3\n"
        index = self.read("a.xyz.bihive-index")
        self.assertTrue(index.startswith(mark))
        at = len(mark) + 9 * 8
        (count,) = struct.unpack_from("<Q", index, at)
        self.assertEqual(count, 10)
        frames = [list(struct.unpack_from("<3q", index, at + 8 + 24 * i)) for i in range(count)]
        lines = 40

        def put(frames, lines=lines, text_follows=0):
            content = index[: at - 16] + struct.pack("<2qQ", lines, text_follows, len(frames))
            content += b"".join(struct.pack("<3q", *one) for one in frames) + struct.pack("<3Q", 0, 0, 0)
            total = 0xCBF29CE484222325
            for byte in content:
                total = (total ^ byte) * 0x100000001B3 % 2**64
            self.write("a.xyz.bihive-index", content + struct.pack("<Q", total))

        put(frames)
        self.assertEqual(self.read("a.xyz.bihive-index"), index)
        self.assertEqual(self.told(), "")
        for wrong in (
            [[0, frames[1][1], 0], *frames[2:]],  # two frames as one
            [[0, 0, 0]] * 1000 + frames,
            [[begin, end, before // 2] for begin, end, before in frames],
        ):
            put(wrong)
            self.assertIn("made anew", self.told())
        put(frames[:5], frames[5][2])
        self.assertIn("made anew", self.told())
        put(frames[:5], frames[5][2], 1)
        self.assertIn("made anew", self.told())
        # Beyond the frame that is read first.
        moved = [list(one) for one in frames]
        moved[5][1] -= 7
        moved[6][0] -= 7
        for wrong in (moved, frames[:5] + [[frames[5][0], frames[6][1], frames[5][2]]] + frames[7:]):
            put(wrong)
            told = self.fail_input("info", "a.xyz", "--frames", "--keep-index")
            self.assertIn("a.xyz: the index of its frames does not fit it; remove a.xyz.bihive-index", told)

    def test_who_may_have_written_it(self):
        index = self.path("a.xyz.bihive-index")
        os.chmod(index, 0o646)
        self.assertIn("may be written by everybody, so it is not used", self.told())
        os.chmod(index, 0o644)
        self.assertEqual(self.told(), "")
        if os.geteuid() == 0:
            os.chown(index, 65534, 65534)
            self.assertIn("belongs to another user, so it is not used", self.told())
        os.rename(index, self.path("kept"))
        os.symlink("kept", index)
        self.assertIn("is a link, so it is not used", self.told())
        os.unlink(index)
        os.mkfifo(index)
        self.assertIn("is no file, so it is not used", self.told())

    def test_a_file_of_that_name_stays(self):
        for other in (b"", b"my notes\n", self.read("a.xyz.bihive-index")[1:]):
            self.write("a.xyz.bihive-index", other)
            self.assertIn("a.xyz.bihive-index: is no index of bihive, so it stays as it is", self.told())
            self.assertEqual(self.read("a.xyz.bihive-index"), other)
        self.write("a.xyz.bihive-index", b"bihive frames 1\n")
        self.assertIn("made anew", self.told())
        self.assertEqual(self.told(), "")


if __name__ == "__main__":
    main()
