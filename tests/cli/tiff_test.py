"""`bihive render -o x.tif`: pictures as TIFF."""

import struct
import unittest
import zlib

from program import ProgramTest, main, png_numbers

SIZE = ["--size", "70x50", "--samples", "2"]
WIDTH, HEIGHT, BITS, COMPRESSION, DESCRIPTION, STRIPS, CHANNELS, STRIP_BYTES = 256, 257, 258, 259, 270, 273, 277, 279
X_RESOLUTION, UNIT, SOFTWARE, PREDICTOR, EXTRA = 282, 296, 305, 317, 338
BYTES_OF = {2: 1, 3: 2, 4: 4, 5: 8}


def tags_of(data):
    """Tag -> values of the only directory."""
    assert data[:4] == b"II*\0"
    (at,) = struct.unpack("<I", data[4:8])
    (count,) = struct.unpack("<H", data[at : at + 2])
    tags = {}
    for i in range(count):
        entry = data[at + 2 + 12 * i :][:12]
        tag, kind, number = struct.unpack("<HHI", entry[:8])
        size = number * BYTES_OF[kind]
        place = 8 if size <= 4 else struct.unpack("<I", entry[8:])[0]
        value = (entry if size <= 4 else data)[place : place + size]
        if kind == 2:
            tags[tag] = value.rstrip(b"\0").decode()
        elif kind == 5:
            tags[tag] = [a / b for a, b in struct.iter_unpack("<II", value)]
        else:
            tags[tag] = list(struct.unpack(f"<{number}{'HI'[kind - 3]}", value))
    assert data[at + 2 + 12 * count :][:4] == b"\0\0\0\0", "one directory"
    return tags


def numbers_of(data):
    """Rows of pixels, as png_numbers()."""
    tags = tags_of(data)
    width, height, channels = tags[WIDTH][0], tags[HEIGHT][0], tags[CHANNELS][0]
    assert tags[COMPRESSION] == [8] and tags[PREDICTOR] == [2]
    raw = b"".join(zlib.decompress(data[at : at + size]) for at, size in zip(tags[STRIPS], tags[STRIP_BYTES]))
    most, form = (256, "B") if tags[BITS][0] == 8 else (65536, "H")
    numbers = struct.unpack(f"<{width * height * channels}{form}", raw)
    rows = []
    for y in range(height):
        row = list(numbers[y * width * channels : (y + 1) * width * channels])
        for i in range(channels, len(row)):
            row[i] = (row[i] + row[i - channels]) % most
        rows.append([tuple(row[i : i + channels]) for i in range(0, len(row), channels)])
    return rows


class Tiff(ProgramTest):
    def setUp(self):
        super().setUp()
        done = self.run_bihive("render", "four-spheres", "-o", "x.tif", "--size", "9x9")
        if done.returncode == 3 and "libtiff" in done.stderr:
            raise unittest.SkipTest("built without libtiff")

    def test_the_pixels_are_those_of_the_png(self):
        for more in ([], ["--bits", "16"], ["--background", "none"], ["--background", "none", "--bits", "16", "--matte", "black"],
                     ["--title", "Title", "--crop", "5,5,60,40"]):
            self.succeed("render", "demo", *SIZE, *more, "-o", "a.tif")
            self.succeed("render", "demo", *SIZE, *more, "-o", "a.png")
            self.assertEqual(numbers_of(self.read("a.tif")), png_numbers(self.read("a.png")), more)
        self.assertEqual(tags_of(self.read("a.tif"))[BITS], [8, 8, 8])

    def test_opacity_is_straight(self):
        self.succeed("render", "demo", *SIZE, "--background", "none", "-o", "a.TIFF")
        self.assertEqual(tags_of(self.read("a.TIFF"))[EXTRA], [2])

    def test_size_in_print_and_texts(self):
        self.succeed("render", "demo", "--size", "2x1cm", "--dpi", "150", "--samples", "1", "-o", "a.tif")
        tags = tags_of(self.read("a.tif"))
        self.assertEqual((tags[WIDTH], tags[HEIGHT], tags[X_RESOLUTION], tags[UNIT]), ([118], [59], [150], [2]))
        self.assertIn("bihive", tags[SOFTWARE])
        self.assertIn('"samples_per_pixel"', tags[DESCRIPTION])
        self.succeed("render", "demo", *SIZE, "--no-metadata", "-o", "a.tif")
        self.assertNotIn(DESCRIPTION, tags_of(self.read("a.tif")))

    def test_equal_pictures_are_equal_files(self):
        files = set()
        for threads in ("1", "3"):
            self.succeed("render", "demo", *SIZE, "--threads", threads, "-o", "a.tif")
            files.add(self.read("a.tif"))
        self.assertEqual(len(files), 1)

    def test_what_cannot_be(self):
        self.assertIn("--layers", self.fail_usage("render", "demo", "-o", "b.tif", "--layers", "depth"))
        self.assertIn("bihive writes PNG, TIFF and OpenEXR, not .jpg", self.fail_usage("render", "demo", "-o", "b.jpg"))
        self.assertIn(".gif is a film", self.fail_usage("render", "demo", "-o", "b.gif"))
        self.assertIn("missing", self.fail_input("render", "demo", *SIZE, "-o", "missing/b.tif"))


if __name__ == "__main__":
    main()
