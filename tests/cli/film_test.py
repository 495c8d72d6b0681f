"""bihive film: sequences, y4m and encoded films; resume, shards, cameras, titles and wrong options."""

import glob
import json
import os
import random
import shutil
import signal
import stat
import subprocess
import time
import unittest

from program import BIHIVE, PATIENCE_S, ProgramTest, main, png_numbers, png_pixels, png_text

SMALL = ["--size", "48x32", "--style", "plain", "--samples", "1"]
HAS_FFMPEG = shutil.which("ffmpeg") is not None
# Lossless, and of the pixels as they are.
LOSSLESS = ["--codec", "-c:v ffv1 -pix_fmt gbrp"]


def frames_of(count, spheres=12, seed=1, changing=False):
    """An extended XYZ file: spheres that wander, with a velocity each, a time and a step."""
    numbers = random.Random(seed)
    places = [[numbers.uniform(-5, 5) for _ in range(3)] for _ in range(spheres)]
    text = ""
    for frame in range(count):
        here = places[: spheres - frame % 3] if changing else places
        text += f"{len(here)}\nProperties=species:S:1:pos:R:3:speed:R:1 Time={0.5 * frame}\n"
        for i, place in enumerate(here):
            text += f"Ar {place[0]:.6f} {place[1]:.6f} {place[2]:.6f} {i * (frame + 1)}\n"
            for axis in range(3):
                place[axis] += numbers.uniform(-0.4, 0.4)
    return text


class FilmTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("run.xyz", frames_of(6))

    def film(self, *arguments):
        return self.succeed_json("film", *arguments)

    def begin(self, *arguments, **options):
        return subprocess.Popen([BIHIVE, "film", *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, **options)

    def wait_for(self, there):
        end = time.monotonic() + PATIENCE_S
        while not there():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    def names(self, folder="."):
        return sorted(os.listdir(self.path(folder)))

    def single(self, film, *which):
        """The bytes of one picture of a film, rendered alone."""
        self.succeed("render", "run.xyz", "--film", film, *which, "-o", "single.png")
        picture = self.read("single.png")
        os.unlink(self.path("single.png"))
        return picture

    def fake_ffmpeg(self, script):
        os.makedirs(self.path("bin"), exist_ok=True)
        self.write("bin/ffmpeg", "#!/bin/sh\n" + script)
        os.chmod(self.path("bin/ffmpeg"), stat.S_IRWXU)
        return {**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"]}

    def decoded(self, name):
        """The pixels of a film, as one text of bytes."""
        return subprocess.run(
            ["ffmpeg", "-v", "error", "-i", self.path(name), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
            stdout=subprocess.PIPE, check=True, timeout=PATIENCE_S,
        ).stdout

    def pixels_of_sequence(self, folder):
        rows = b""
        for name in self.names(folder):
            if name.endswith(".png"):
                rows += b"".join(bytes(pixel) for row in png_pixels(self.read(f"{folder}/{name}")) for pixel in row)
        return rows


class Names(FilmTest):
    """What frames call their spheres, and frames without any."""

    SIZE = ["--size", "60x30", "--style", "flat", "--radius", "1", "--samples", "1"]

    def colour_at(self, file, x, y=15):
        return self.pixels(file)[y][x]

    def pixels(self, file):
        return png_pixels(self.read(file))

    def test_labels_keep_their_colours(self):
        self.write("a.xyz", "2\n\nAA 0 0 0\nBB 3 0 0\n2\n\nBB 3 0 0\nAA 0 0 0\n2\n\nCC 3 0 0\nBB 0 0 0\n")
        self.film("a.xyz", "-o", "f/%d.png", *self.SIZE)
        left, right = [[self.colour_at(f"f/{k}.png", x) for k in range(3)] for x in (15, 42)]
        self.assertEqual(left[0], left[1])
        self.assertEqual(right[0], right[1])
        self.assertEqual(left[2], right[0])
        self.assertNotIn(right[2], [left[0], right[0]])
        # The same when another run makes the last picture alone, and as a picture of its own.
        self.succeed("render", "a.xyz", "--frame", "2", "-o", "2.png", *self.SIZE)
        self.assertEqual(self.colour_at("2.png", 15), left[2])
        self.film("a.xyz", "-o", "g/%d.png", *self.SIZE, "--frames", "2:")
        self.assertEqual(self.pixels("g/0.png"), self.pixels("2.png"))

    def test_more_categories_than_colours_are_told(self):
        self.write("a.xyz", "42\n\n" + "".join(f"bead{k} {3 * k} 0 0\n" for k in range(42)))
        warned = self.run_bihive("render", "a.xyz", "-o", "a.png", *self.SIZE).stderr
        self.assertIn("there are 40 colours for categories, and some of type share one: bead40 that of bead0, "
                      "bead41 that of bead1\n", warned)
        self.write("b.xyz", "40\n\n" + "".join(f"bead{k} {3 * k} 0 0\n" for k in range(40)))
        self.assertEqual(self.run_bihive("render", "b.xyz", "-o", "b.png", *self.SIZE).stderr, "")

    def test_frames_without_spheres_are_empty_pictures(self):
        one = "1\n\nO 0 0 0\n"
        self.write("a.xyz", "0\n\n" + one + "0\n\n" + one)
        said = self.film("a.xyz", "-o", "f/%d.png", *self.SIZE, "--title", "{spheres}", "--background", "#204060",
                         "--select", "element O", "--colour-by", "x", "--colour-range", "film")
        self.assertEqual(said["pictures"], 4)
        for empty in (0, 2):
            self.assertEqual(self.colour_at(f"f/{empty}.png", 30, 20), self.colour_at(f"f/{empty}.png", 2, 28))
        self.assertNotEqual(self.colour_at("f/1.png", 30, 20), self.colour_at("f/2.png", 30, 20))
        self.assertEqual(self.pixels("f/1.png"), self.pixels("f/3.png"))
        self.assertIn("there are no spheres in frame 2 (read as XYZ)",
                      self.fail_input("render", "a.xyz", "--frame", "2", "-o", "a.png"))
        self.write("none.xyz", "0\n\n0\n\n")
        self.assertIn("there are no spheres in the frames of the film", self.fail_input("film", "none.xyz", "-o", "n/%d.png"))

    def test_so_are_frames_whose_spheres_are_all_hidden(self):
        self.write("a.xyz", "1\n\nH 0 0 0\n2\n\nH 0 0 0\nO 3 0 0\n1\n\nH 1 0 0\n")
        self.film("a.xyz", "-o", "f/%d.png", *self.SIZE, "--no-hydrogens")
        self.assertEqual(self.pixels("f/0.png"), self.pixels("f/2.png"))
        self.assertNotEqual(self.pixels("f/0.png"), self.pixels("f/1.png"))
        self.assertIn("every sphere is hidden", self.fail_usage("film", "a.xyz", "-o", "g/%d.png", "--hide"))


class Sequences(FilmTest):
    def test_each_picture_has_the_bytes_of_a_single_one(self):
        looks = ["--colour-by", "speed", "--select", "index 3", "--radius-scale", "2", "--title", "frame {frame}"]
        report = self.film("run.xyz", "-o", "run/%04d.png", *SMALL, *looks)
        self.assertEqual((report["pictures"], report["drawn"], report["kept"], report["size"]), (6, 6, 0, "48x32"))
        self.assertEqual(self.names("run"), [f"000{k}.png" for k in range(6)] + ["film.index", "film.json"])
        for k in (0, 2, 5):
            self.assertEqual(self.read(f"run/000{k}.png"), self.single("run/film.json", "--frame", str(k)))
        pictures = {self.read(f"run/000{k}.png") for k in range(6)}
        self.assertEqual(len(pictures), 6)

    def test_frames_are_chosen(self):
        self.film("run.xyz", "-o", "p%d.png", *SMALL, "--frames", "1::2")
        self.assertEqual(self.names(),
                         ["p0.png", "p1.png", "p2.png", "pfilm.index", "pfilm.json", "run.xyz"])
        self.assertEqual(self.read("p2.png"), self.single("pfilm.json", "--frame", "5"))
        self.assertEqual(self.read("p1.png"), self.single("pfilm.json", "--picture", "1"))
        self.assertIn("frame 2 is not in the film",
                      self.fail_usage("render", "run.xyz", "--film", "pfilm.json", "--frame", "2", "-o", "x.png"))
        self.assertIn("no picture 3",
                      self.fail_usage("render", "run.xyz", "--film", "pfilm.json", "--picture", "3", "-o", "x.png"))

    def test_camera_and_colours_stay_those_of_the_first_frame(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--colour-by", "speed")
        settings = [json.loads(png_text(self.read(f"run/{k}.png"))["Settings"]) for k in range(6)]
        self.assertEqual([one["camera"] for one in settings], [settings[0]["camera"]] * 6)
        fixed = json.loads(self.read("run/film.json"))["fixed"]
        self.assertEqual(fixed["ranges_of_looks"], [[0, 11]])
        self.film("run.xyz", "-o", "all/%d.png", *SMALL, "--colour-by", "speed", "--colour-range", "film")
        self.assertEqual(json.loads(self.read("all/film.json"))["fixed"]["ranges_of_looks"], [[0, 66]])
        self.assertEqual(self.read("all/4.png"), self.single("all/film.json", "--frame", "4"))
        self.film("run.xyz", "-o", "each/%d.png", *SMALL, "--colour-by", "speed", "--colour-range", "frame")
        self.assertEqual(self.read("each/4.png"), self.single("each/film.json", "--frame", "4"))
        self.assertEqual(len({self.read(f"{folder}/4.png") for folder in ("run", "all", "each")}), 3)

    def test_existing_pictures_are_kept(self):
        whole = ["film", "run.xyz", "-o", "run/%d.png", *SMALL]
        self.succeed(*whole)
        before = self.contents()
        os.unlink(self.path("run/3.png"))
        kept_at = os.stat(self.path("run/2.png")).st_mtime_ns
        report = self.succeed_json(*whole)
        self.assertEqual((report["drawn"], report["kept"]), (1, 5))
        self.assertEqual(self.contents(), before)
        self.assertEqual(os.stat(self.path("run/2.png")).st_mtime_ns, kept_at)

    def test_other_options_or_another_input_are_another_film(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL)
        for more in (["--zoom", "2"], ["--fps", "30"], ["--frames", ":3"], ["--turntable", "90"]):
            said = self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL, *more)
            self.assertIn("holds pictures of another film", said)
            self.assertIn("run/film.json", said)
        self.assertRegex(said, r"its turntable_deg was 0.0, and is 90.0 now")
        self.assertRegex(self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL, "--zoom", "2"),
                         r"its options were \[.*\], and are \[.*\] now")
        self.write("run.xyz", frames_of(6, seed=2))
        self.assertIn("its input was", self.fail_input("film", "run.xyz", "-o", "run/%d.png", *SMALL))

    def test_an_input_of_the_far_future(self):
        """Its time in nanoseconds does not fit into 64 bits."""
        seconds = 10_000_000_000
        os.utime(self.path("run.xyz"), (seconds, seconds))
        if os.stat(self.path("run.xyz")).st_mtime != seconds:
            self.skipTest("this file system has no such time")
        self.film("run.xyz", "-o", "run/%d.png", *SMALL)
        (described,) = json.loads(self.read("run/film.json"))["asked"]["input"]
        self.assertEqual((described["changed_s"], described["changed_ns"]), (seconds, 0))
        self.assertEqual(self.succeed_json("film", "run.xyz", "-o", "run/%d.png", *SMALL)["kept"], 6)

    def test_frames_of_different_numbers_of_spheres(self):
        self.write("run.xyz", frames_of(5, changing=True))
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--select", "x > 0", "--colour", "red")
        for k in range(5):
            self.assertEqual(self.read(f"run/{k}.png"), self.single("run/film.json", "--frame", str(k)))

    def test_sixteen_bits_and_no_background(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--bits", "16", "--background", "none", "--frames", ":2")
        self.assertEqual(len(png_numbers(self.read("run/1.png"))[0][0]), 4)
        self.assertEqual(self.read("run/1.png"), self.single("run/film.json", "--frame", "1"))

    def test_a_trajectory_beside_its_atoms(self):
        data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../data/io/trajectories")
        files = sorted(os.listdir(data)) if os.path.isdir(data) else []
        trajectories = [name for name in files if name.endswith((".dcd", ".xtc", ".trr"))]
        self.assertTrue(trajectories)
        tops = [name for name in files if name.endswith((".gro", ".pdb", ".xyz"))]
        self.assertTrue(tops)
        for trajectory in trajectories:
            for top in tops:
                paths = [os.path.join(data, top), os.path.join(data, trajectory)]
                done = self.run_bihive("film", *paths, "-o", f"{trajectory}-%d.png", *SMALL, "--frames", ":2",
                                       "--title", "{time:.1f} ps, {spheres}")
                if done.returncode == 0:
                    self.assertRegex(png_text(self.read(f"{trajectory}-1.png"))["Settings"], r'"[1-9]\d*\.\d ps, \d+"')
                    self.succeed("render", *paths, "--film", f"{trajectory}-film.json", "--frame", "0", "-o", "a.png")
                    self.assertEqual(self.read("a.png"), self.read(f"{trajectory}-0.png"))
                    return
        self.fail("no pair of these files fits")


class Orders(FilmTest):
    """Held ends, backwards, there and back: each picture is drawn once."""

    # The frames, the order, and the numbers of the pictures in the film without it.
    ORDERS = [
        ([], ["--hold-first", "2"], [0, 0, 0, 1, 2, 3, 4, 5]),
        ([], ["--hold-last", "3"], [0, 1, 2, 3, 4, 5, 5, 5, 5]),
        ([], ["--reverse"], [5, 4, 3, 2, 1, 0]),
        ([], ["--ping-pong"], [0, 1, 2, 3, 4, 5, 4, 3, 2, 1]),
        ([], ["--reverse", "--ping-pong", "--hold-first", "1", "--hold-last", "2"], [5, 5, 4, 3, 2, 1, 0, 0, 0, 1, 2, 3, 4]),
        (["--frames", "1:6:2"], ["--reverse", "--hold-last", "1"], [2, 1, 0, 0]),
        (["--frames", "2"], ["--ping-pong", "--hold-first", "3"], [0, 0, 0, 0]),
    ]

    def cases(self):
        """The output and codec of a film, its frames and order, the pictures of the film without this order, and its own."""
        for output, codec in (("s/%02d.png", []), ("run.y4m", []), ("run.mkv", LOSSLESS)):
            if codec and not HAS_FFMPEG:
                continue
            plain = {}
            for frames, order, expected in self.ORDERS[1::3] if codec else self.ORDERS:
                key = "".join(frames)
                plain[key] = plain[key] if key in plain else self.plain(output, codec, frames)
                yield output, [*SMALL, *codec, *frames, *order], len(plain[key]), [plain[key][k] for k in expected]

    def pictures(self, output):
        """Those of a film, each as some bytes; and no film is there any more."""
        if output.endswith(".png"):
            folder = os.path.dirname(output)
            found = [self.read(f"{folder}/{name}") for name in self.names(folder) if name.endswith(".png")]
            shutil.rmtree(self.path(folder))
            return found
        self.assertNotIn(output + ".part", self.names())
        y4m = output.endswith(".y4m")
        data = self.read(output).split(b"\n", 1)[1] if y4m else self.decoded(output)
        size = 3 * 48 * 32 + (len(b"FRAME\n") if y4m else 0)
        os.unlink(self.path(output))
        return [data[at : at + size] for at in range(0, len(data), size)]

    def plain(self, output, codec, frames):
        """The pictures of the film in its usual order."""
        self.film("run.xyz", "-o", output, *SMALL, *codec, *frames)
        return self.pictures(output)

    def test_each_picture_is_drawn_once(self):
        for output, words, count, expected in self.cases():
            report = self.film("run.xyz", "-o", output, *words)
            self.assertEqual((report["pictures"], report["drawn"], report["kept"]), (len(expected), count, 0), words)
            self.assertEqual(self.film("run.xyz", "-o", output, *words)["drawn"], 0)
            self.assertEqual(self.pictures(output), expected, words)

    def test_shards(self):
        for output, words, count, expected in self.cases():
            shards = [self.film("run.xyz", "-o", output, *words, "--shard", f"{i}/4") for i in (3, 0, 2, 1)]
            self.assertEqual(sum(shard["drawn"] for shard in shards), count, words)
            self.assertEqual(self.film("--join", "-o", output)["pictures"], len(expected))
            if output.endswith(".png"):
                self.assertEqual(self.film("run.xyz", "-o", output, *words)["kept"], count)
            self.assertEqual(self.pictures(output), expected, words)

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_films_for_players(self):
        for name in ("run.mp4", "run.webm"):
            self.film("run.xyz", "-o", name, *SMALL, "--ping-pong", "--hold-last", "2", "--reverse")
            self.assertEqual(len(self.decoded(name)), 12 * 3 * 48 * 32)

    def test_repeated_pictures_of_a_sequence(self):
        words = ["run.xyz", "-o", "s/%02d.png", *SMALL, "--ping-pong"]
        self.assertIn("6 pictures of 48 x 32, 4 shown again; ", self.succeed("film", *words))
        before = self.contents()
        # A copy that is gone is copied again, and a picture that is gone is drawn again.
        os.unlink(self.path("s/08.png"))
        self.assertEqual(self.film(*words)["drawn"], 0)
        os.unlink(self.path("s/02.png"))
        self.assertEqual(self.film(*words)["drawn"], 1)
        self.assertEqual(self.contents(), before)
        self.write("s/08.png", "mine")
        self.assertIn("s/08.png: exists already, and was not written by bihive film", self.fail_input("film", *words))
        # The same pictures in another order are another film.
        os.unlink(self.path("s/08.png"))
        self.assertIn("its order was", self.fail_input("film", *words[:-1], "--reverse"))
        os.unlink(self.path("s/film.json"))
        said = self.run_bihive("film", *words[:-1], "--reverse").stderr
        self.assertIn("s/06.png: is of an earlier film, as are 2 more here", said)
        for name in ("06", "07", "09"):
            os.unlink(self.path(f"s/{name}.png"))
        found = self.pictures("s/%02d.png")
        self.assertEqual(found[::-1], self.plain("s/%02d.png", [], []))

    def test_a_picture_of_such_a_film(self):
        plain = self.plain("s/%d.png", [], [])
        self.film("run.xyz", "-o", "run.y4m", *SMALL, "--reverse", "--hold-first", "2", "--ping-pong")
        for which, k in ((["--picture", "1"], 5), (["--picture", "3"], 4), (["--picture", "11"], 4), (["--frame", "1"], 1)):
            self.assertEqual(self.single("run.y4m.json", *which), plain[k])
        self.assertIn("no picture 12: its last one is 11",
                      self.fail_usage("render", "run.xyz", "--film", "run.y4m.json", "--picture", "12", "-o", "x.png"))

    def test_a_camera_that_moves_goes_back_too(self):
        words = ["run.xyz", "-o", "a/%d.png", *SMALL, "--turntable", "90", "--frames", "0", "--pictures", "4"]
        self.film(*words)
        self.film(*words[:2], "b/%d.png", *words[3:], "--reverse")
        self.assertEqual([self.read(f"b/{k}.png") for k in range(4)], [self.read(f"a/{3 - k}.png") for k in range(4)])

    def test_a_film_that_was_killed_on_its_way_back(self):
        words = ["run.xyz", "-o", "run.y4m", *SMALL, "--ping-pong", "--hold-last", "1"]
        self.film(*words)
        data, plan = self.read("run.y4m"), self.read("run.y4m.json")
        size = 3 * 48 * 32 + len("FRAME\n")
        for left, drawn in ((10, 0), (2 * size + 1, 0), (4 * size, 0), (4 * size + 1, 0), (7 * size, 2)):
            os.unlink(self.path("run.y4m"))
            os.mkdir(self.path("run.y4m.part"), 0o700)
            self.write("run.y4m.part/film.json", plan)
            self.write("run.y4m.part/film.y4m", data[:-left])
            self.assertEqual(self.film(*words)["drawn"], drawn, left)
            self.assertEqual(self.read("run.y4m"), data)

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_an_encoded_film_that_was_stopped(self):
        self.write("run.xyz", frames_of(12))
        words = ["run.xyz", "-o", "run.mkv", "--size", "300x200", "--style", "plain", "--samples", "16", *LOSSLESS, "--ping-pong"]
        process = self.begin(*words)
        self.wait_for(lambda: glob.glob(self.path("run.mkv.part/picture-00000001.png")))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=PATIENCE_S), 130)
        process.communicate()
        there = len(glob.glob(self.path("run.mkv.part/picture-*.png")))
        report = self.film(*words)
        self.assertEqual((report["kept"], report["drawn"], report["pictures"]), (there, 12 - there, 22))
        self.film(*words[:2], "all/%03d.png", *words[3:-3], "--ping-pong")
        self.assertEqual(self.decoded("run.mkv"), self.pixels_of_sequence("all"))
        self.assertEqual(self.names(), ["all", "run.mkv", "run.mkv.json", "run.xyz"])

    def test_wrong_orders(self):
        film = ["film", "run.xyz", "-o", "x.y4m"]
        for more in (["--hold-first", "-1"], ["--hold-last", "1.5"], ["--hold-last", "100000000"], ["--hold-first", "1e3"]):
            self.fail_usage(*film, *more)
        self.assertIn("a film has at most 100,000,000 pictures", self.fail_usage(*film, "--hold-last", "99999999"))
        for more in (["--reverse"], ["--ping-pong"], ["--hold-first", "1"]):
            self.assertIn("--join takes the film's output alone", self.fail_usage("film", "--join", "-o", "x.y4m", *more))


class PercentSigns(FilmTest):
    """They stand for the number in the name of a sequence's files, and for themselves elsewhere."""

    def test_folders(self):
        for folder in ("100%_run", "a%b", "%d", "x%03d", "%%", "a%b/c%04d"):
            os.makedirs(self.path(folder))
            self.film("run.xyz", "-o", f"{folder}/frame%04d.png", *SMALL, "--frames", ":2")
            self.assertEqual(self.names(folder), ["frame0000.png", "frame0001.png", "framefilm.index", "framefilm.json"])
            self.assertEqual(self.read(f"{folder}/frame0001.png"), self.single(f"{folder}/framefilm.json", "--frame", "1"))
            shutil.rmtree(self.path(folder))
        self.film("run.xyz", "-o", "made%/%d.png", *SMALL, "--frames", ":2")
        self.assertEqual(self.names("made%"), ["0.png", "1.png", "film.index", "film.json"])

    def test_names(self):
        self.film("run.xyz", "-o", "100%%_%02d%%.png", *SMALL, "--frames", ":2")
        self.assertEqual(self.names(), ["100%_00%.png", "100%_01%.png", "100%_film.index", "100%_film.json", "run.xyz"])
        self.assertEqual(self.film("run.xyz", "-o", "100%%_%02d%%.png", *SMALL, "--frames", ":2")["kept"], 2)
        for output in ("100%_%04d.png", "%d_100%.png", "%%.png", "a%d/b.png"):
            said = self.fail_usage("film", "run.xyz", "-o", output)
            self.assertIn(f'found "{output}"; name it run/%05d.png; a percent sign in the file\'s name is %%', said)

    def test_films_in_one_file(self):
        os.makedirs(self.path("a%b/50%d"))
        outputs = [("run.y4m", []), *([("run.mkv", LOSSLESS)] if HAS_FFMPEG else [])]
        for name, codec in outputs:
            shown = self.decoded if codec else self.read
            self.film("run.xyz", "-o", name, *SMALL, *codec)
            for output in ("a%b/" + name, "a%b/50%d/%03d-100%%" + name[3:]):
                self.film("run.xyz", "-o", output, *SMALL, *codec)
                self.assertEqual(shown(output), shown(name))
                for shard in ("0/2", "1/2"):
                    self.film("run.xyz", "-o", output, *SMALL, *codec, "--shard", shard)
                self.film("--join", "-o", output)
                self.assertEqual(shown(output), shown(name))
        self.assertEqual(self.names("a%b/50%d"), sorted(f"%03d-100%%{name[3:]}{end}" for name, _ in outputs for end in ("", ".json")))


class Y4m(FilmTest):
    def test_each_picture_has_the_pixels_of_a_single_one(self):
        self.film("run.xyz", "-o", "run.y4m", *SMALL, "--fps", "29.97")
        self.assertEqual(self.names(), ["run.xyz", "run.y4m", "run.y4m.json"])
        data = self.read("run.y4m")
        head, rest = data.split(b"\n", 1)
        self.assertEqual(head, b"YUV4MPEG2 W48 H32 F2997:100 Ip A1:1 C444")
        size = 48 * 32
        self.assertEqual(len(rest), 6 * (6 + 3 * size))
        for k in (0, 4):
            frame = rest[k * (6 + 3 * size) :]
            self.assertEqual(frame[:6], b"FRAME\n")
            pixels = [pixel for row in png_pixels(self.single("run.y4m.json", "--frame", str(k))) for pixel in row]
            luma = bytes(16 + ((16829 * r + 33039 * g + 6416 * b + 32768) >> 16) for r, g, b in pixels)
            blue = bytes(128 + ((-9714 * r - 19071 * g + 28784 * b + 32767) >> 16) for r, g, b in pixels)
            red = bytes(128 + ((28784 * r - 24103 * g - 4681 * b + 32767) >> 16) for r, g, b in pixels)
            self.assertEqual(frame[6 : 6 + 3 * size], luma + blue + red)

    def test_a_link_is_followed(self):
        os.mkdir(self.path("there"))
        os.symlink("there/run.y4m", self.path("link.y4m"))
        self.film("run.xyz", "-o", "link.y4m", *SMALL)
        self.assertTrue(os.path.islink(self.path("link.y4m")))
        self.assertEqual(self.names("there"), ["run.y4m", "run.y4m.json"])

    def test_white_and_black_are_those_of_the_format(self):
        self.write("one.xyz", "1\n\nAr 0 0 0\n")
        for colour, value in (("white", b"\xeb\x80\x80"), ("black", b"\x10\x80\x80")):
            self.film("one.xyz", "-o", "one.y4m", "--size", "9x9", "--style", "plain", "--background", colour)
            plane = self.read("one.y4m").split(b"FRAME\n", 1)[1]
            self.assertEqual(bytes([plane[0], plane[81], plane[162]]), value)
            self.assertIn(value[:1], plane)


class Interrupted(FilmTest):
    def setUp(self):
        super().setUp()
        # A frame takes a part of a second; the whole film minutes.
        self.slow = ["--size", "400x300", "--style", "plain", "--samples", "9"]

    def test_a_killed_sequence_goes_on(self):
        self.write("run.xyz", frames_of(20))
        command = ["run.xyz", "-o", "run/%d.png", *self.slow]
        process = self.begin(*command)
        self.wait_for(lambda: os.path.exists(self.path("run/2.png")))
        process.kill()
        process.communicate()
        there = len(self.names("run")) - 2
        self.assertLess(there, 20)
        for name in self.names("run"):
            self.assertTrue(name.startswith("film.") or len(png_text(self.read("run/" + name))) >= 3, name)
        report = self.film(*command)
        self.assertEqual((report["kept"], report["drawn"]), (there, 20 - there))
        self.assertEqual(self.read("run/19.png"), self.single("run/film.json", "--frame", "19"))

    def test_a_killed_y4m_goes_on_behind_its_last_whole_picture(self):
        self.write("run.xyz", frames_of(20))
        command = ["run.xyz", "-o", "run.y4m", *self.slow]
        process = self.begin(*command)
        part = self.path("run.y4m.part/film.y4m")
        self.wait_for(lambda: os.path.exists(part) and os.path.getsize(part) > 3 * 360006 + 100)
        process.kill()
        process.communicate()
        # A picture that was being written.
        with open(part, "ab") as file:
            file.write(b"FRAME\n" + bytes(1000))
        report = self.film(*command)
        self.assertGreaterEqual(report["kept"], 3)
        self.assertEqual(report["kept"] + report["drawn"], 20)
        self.assertEqual(self.names(), ["run.xyz", "run.y4m", "run.y4m.json"])
        self.film("run.xyz", "-o", "again.y4m", *self.slow)
        self.assertEqual(self.read("run.y4m"), self.read("again.y4m"))

    def test_ctrl_c_keeps_whole_pictures_and_else_leaves_nothing(self):
        before = self.contents()
        for output in ("run/%d.png", "run.y4m"):
            process = self.begin("run.xyz", "-o", output, "--size", "4000x4000", "--samples", "256")
            self.let_work(process, 1)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=PATIENCE_S)
            self.assertEqual((process.returncode, out, err), (130, "", ""))
            self.assertEqual(self.contents(), before)
        self.write("run.xyz", frames_of(30))
        command = ["run.xyz", "-o", "run/%d.png", *self.slow]
        process = self.begin(*command)
        self.wait_for(lambda: os.path.exists(self.path("run/1.png")))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=PATIENCE_S), 130)
        process.communicate()
        self.assertEqual(set(self.names("run")) - {f"{k}.png" for k in range(30)}, {"film.index", "film.json"})
        self.assertGreater(self.film(*command)["kept"], 1)

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_an_encoded_film_goes_on(self):
        self.write("run.xyz", frames_of(30))
        command = ["run.xyz", "-o", "run.mkv", "--size", "300x200", "--style", "plain", "--samples", "16", *LOSSLESS]
        process = self.begin(*command)
        self.wait_for(lambda: glob.glob(self.path(".bihive-*.film/unfinished-*.mkv")))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=PATIENCE_S), 130)
        process.communicate()
        segments = [name for name in self.names("run.mkv.part") if name.startswith("segment-00000000-")]
        self.assertEqual(len(segments), 1)
        self.assertIn("another film",
                      self.fail_input("film", *command, "--zoom", "2"))
        report = self.film(*command)
        self.assertEqual(report["kept"], int(segments[0].split("-")[2].split(".")[0]))
        self.assertEqual(self.names(), ["run.mkv", "run.mkv.json", "run.xyz"])
        self.film(*command[:1], "-o", "all/%03d.png", *command[3:-2])
        self.assertEqual(self.decoded("run.mkv"), self.pixels_of_sequence("all"))


class Encoded(FilmTest):
    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_a_film_has_all_pictures(self):
        for name in ("run.mp4", "run.webm", "run.mov"):
            self.film("run.xyz", "-o", name, "--size", "49x33", "--style", "plain", "--samples", "1", "--fps", "10")
            shown = json.loads(subprocess.run(
                ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", self.path(name)],
                stdout=subprocess.PIPE, check=True).stdout)["streams"][0]
            # Sides are even.
            self.assertEqual((shown["width"], shown["height"], shown["nb_read_frames"]), (50, 34, "6"))
            self.assertEqual(shown["avg_frame_rate"], "10/1")
            # The last column is that before it, not a black one.
            picture = self.decoded(name)[: 50 * 34 * 3]
            for y in range(33):
                last, before = (picture[3 * (50 * y + x): 3 * (50 * y + x) + 3] for x in (49, 48))
                self.assertLess(max(abs(a - b) for a, b in zip(last, before)), 30)
        self.film("run.xyz", "-o", "run.mkv", *SMALL, *LOSSLESS)
        self.film("run.xyz", "-o", "run/%d.png", *SMALL)
        self.assertEqual(self.decoded("run.mkv"), self.pixels_of_sequence("run"))

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_animations(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL)
        expected = self.pixels_of_sequence("run")
        for name in ("run.apng", "run.gif"):
            report = self.film("run.xyz", "-o", name, *SMALL, "--fps", "10")
            self.assertEqual((report["drawn"], report["kept"]), (6, 0))
            shown = json.loads(subprocess.run(
                ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", self.path(name)],
                stdout=subprocess.PIPE, check=True).stdout)["streams"][0]
            self.assertEqual((shown["width"], shown["height"], shown["nb_read_frames"]), (48, 32, "6"))
            self.assertEqual(shown["avg_frame_rate"], "10/1")
            self.assertEqual(self.film("run.xyz", "-o", name, *SMALL, "--fps", "10")["kept"], 6)
            self.assertNotIn(name + ".part", self.names())
        self.assertEqual(self.decoded("run.apng"), expected, "no loss")
        # 256 colours are near those of the pictures, and the file loops.
        found = self.decoded("run.gif")
        self.assertLess(sum(abs(a - b) for a, b in zip(found, expected)) / len(expected), 8)
        self.assertIn(b"NETSCAPE2.0", self.read("run.gif"))

    def test_animations_have_no_codec_and_a_gif_no_high_rate(self):
        self.assertIn("--codec is for .mp4, .mov, .mkv and .webm", self.fail_usage("film", "run.xyz", "-o", "x.gif", "--codec", "-c:v gif"))
        if HAS_FFMPEG:
            self.assertIn("a GIF shows at most 50 pictures per second", self.fail_usage("film", "run.xyz", "-o", "x.gif", *SMALL, "--fps", "60"))

    def test_a_missing_ffmpeg_is_said_before_any_work(self):
        os.mkdir(self.path("empty"))
        said = self.fail_with(3, "film", "run.xyz", "-o", "run.mp4", env={**os.environ, "PATH": self.path("empty")})
        self.assertIn("the program ffmpeg, which encodes films, is not installed", said)
        self.assertIn(".y4m", said)

    def test_an_ffmpeg_that_fails(self):
        for script, words in (("cat >/dev/null; echo 'no codec' >&2; exit 4", "failed with exit code 4, and said: no codec"),
                              ("echo bad >&2; exit 1", "bad"),
                              ("cat >/dev/null; kill -9 $$", "ended by signal 9, as the system does where there is too little memory"),
                              ("exec <&-; sleep 0.2; kill -11 $$", "ended by signal 11"),
                              ("cat >/dev/null", "wrote no film")):
            environment = self.fake_ffmpeg(script)
            done = self.run_bihive("film", "run.xyz", "-o", "run.mp4", *SMALL, env=environment)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.returncode, 3)
            self.assert_one_error_line(done.stderr)
            self.assertEqual(self.names(), ["bin", "run.xyz"])

    def test_ffmpeg_does_not_see_ctrl_c(self):
        # It says that it finds six pictures, when it is asked.
        environment = self.fake_ffmpeg('case "$*" in *-progress*) echo frame=6; exit 0;; esac\n'
                                       'for word in "$@"; do last=${word#file:}; done; cat > "$last"')
        report = subprocess.run([BIHIVE, "film", "run.xyz", "-o", "run.mp4", *SMALL, "--no-metadata", "--json"], cwd=self.folder,
                                env=environment, stdout=subprocess.PIPE, check=True, timeout=PATIENCE_S)
        self.assertEqual(json.loads(report.stdout)["drawn"], 6)
        # The program sends rows of pixels, and nothing else.
        self.film("run.xyz", "-o", "run/%d.png", *SMALL)
        self.assertEqual(self.read("run.mp4"), self.pixels_of_sequence("run"))


class Shards(FilmTest):
    def test_joined_shards_equal_the_whole(self):
        self.film("run.xyz", "-o", "whole.y4m", *SMALL)
        self.assertIn("there are no shards", self.fail_input("film", "--join", "-o", "run.y4m"))
        for shard in ("1/3", "0/3"):
            report = self.film("run.xyz", "-o", "run.y4m", *SMALL, "--shard", shard)
            self.assertEqual((report["drawn"], report["shard"]), (2, shard))
        self.assertIn("2 of 6 pictures are missing, the first is number 2",
                      self.fail_input("film", "--join", "-o", "run.y4m"))
        self.film("run.xyz", "-o", "run.y4m", *SMALL, "--shard", "2/3")
        self.assertEqual(self.film("run.xyz", "-o", "run.y4m", *SMALL, "--shard", "2/3")["kept"], 2)
        self.assertEqual(self.film("--join", "-o", "run.y4m")["pictures"], 6)
        self.assertEqual(self.read("run.y4m"), self.read("whole.y4m"))
        self.assertEqual(self.names(), ["run.xyz", "run.y4m", "run.y4m.json", "whole.y4m", "whole.y4m.json"])

    def test_shards_that_begin_at_the_same_moment(self):
        # The lock that a killed run has left is no film of somebody else's.
        os.makedirs(self.path("lone.y4m.part"), 0o700)
        self.write("lone.y4m.part/lock", "")
        self.film("run.xyz", "-o", "lone.y4m", *SMALL, "--shard", "0/2")
        whole = self.film("run.xyz", "-o", "whole.y4m", *SMALL)["pictures"]
        for attempt in range(4):
            words = ["film", "run.xyz", "-o", f"{attempt}.y4m", *SMALL, "--threads", "1", "--shard"]
            begun = [subprocess.Popen([BIHIVE, *words, f"{i}/{whole}"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.PIPE, text=True) for i in range(whole)]
            for shard in begun:
                self.assertEqual((shard.communicate()[1], shard.returncode), ("", 0))
            self.succeed("film", "--join", "-o", f"{attempt}.y4m")
            self.assertEqual(self.read(f"{attempt}.y4m"), self.read("whole.y4m"))

    def test_shards_of_a_sequence(self):
        for shard in ("0/2", "1/2"):
            self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--shard", shard)
        self.film("--join", "-o", "run/%d.png")
        self.film("run.xyz", "-o", "all/%d.png", *SMALL)
        self.assertEqual(self.pixels_of_sequence("run"), self.pixels_of_sequence("all"))

    @unittest.skipUnless(HAS_FFMPEG, "there is no ffmpeg here")
    def test_shards_are_encoded_when_they_are_joined(self):
        for shard in ("0/2", "1/2"):
            self.film("run.xyz", "-o", "run.mkv", *SMALL, *LOSSLESS, "--shard", shard)
        self.film("--join", "-o", "run.mkv")
        self.film("run.xyz", "-o", "all/%d.png", *SMALL)
        self.assertEqual(self.decoded("run.mkv"), self.pixels_of_sequence("all"))


class Cameras(FilmTest):
    def camera(self, picture):
        return json.loads(png_text(self.read(picture))["Settings"])["camera"]

    def test_a_turntable_of_one_frame(self):
        self.write("one.xyz", "3\n\nC 0 0 0\nO 3 0 0\nN 0 2 1\n")
        report = self.film("one.xyz", "-o", "turn/%d.png", *SMALL, "--turntable", "360", "--pictures", "4")
        self.assertEqual(report["pictures"], 4)
        eyes = [self.camera(f"turn/{k}.png")["eye"] for k in range(4)]
        middle = self.camera("turn/0.png")["look_at"]
        for k in range(4):
            there, opposite = eyes[k], eyes[(k + 2) % 4]
            for axis in range(3):
                self.assertAlmostEqual(there[axis] + opposite[axis], 2 * middle[axis], places=5)
        self.succeed("render", "one.xyz", "--film", "turn/film.json", "--picture", "3", "-o", "3.png")
        self.assertEqual(self.read("3.png"), self.read("turn/3.png"))
        self.assertIn("--picture", self.fail_usage("render", "one.xyz", "--film", "turn/film.json", "--frame", "0", "-o", "4.png"))
        self.assertEqual(self.film("one.xyz", "-o", "ten.y4m", *SMALL, "--turntable", "90", "--fps", "1")["pictures"], 10)

    def test_a_turntable_of_a_generated_scene(self):
        self.film("scenario1", "--count", "64", "-o", "turn/%d.png", "--size", "32x32", "--turntable", "90", "--pictures", "2")
        self.succeed("render", "scenario1", "--film", "turn/film.json", "--picture", "1", "-o", "1.png")
        self.assertEqual(self.read("1.png"), self.read("turn/1.png"))

    def test_key_frames(self):
        self.write("keys.json", json.dumps({"keys": [{"picture": 0, "turn": [0, 0, 0]},
                                                     {"picture": 5, "turn": [90, 20, 0], "zoom": 2}]}))
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--camera-keys", "keys.json")
        self.assertEqual(len({tuple(self.camera(f"run/{k}.png")["eye"]) for k in range(6)}), 6)
        self.assertEqual(self.read("run/3.png"), self.single("run/film.json", "--frame", "3"))
        self.write("bad.json", '{"keys": [{"picture": 0, "zoom": 0}]}')
        said = self.fail_input("film", "run.xyz", "-o", "x.y4m", "--camera-keys", "bad.json")
        self.assertIn("bad.json: /keys/0/zoom: expected a number above 0, found 0", said)
        self.write("late.json", '{"keys": [{"picture": 6, "zoom": 1}]}')
        self.assertIn("the last picture is 5", self.fail_usage("film", "run.xyz", "-o", "x.y4m", "--camera-keys", "late.json"))


class Titles(FilmTest):
    def title(self, picture):
        return json.loads(png_text(self.read(picture))["Settings"])["labels"]["title"]

    def test_values_of_the_frame(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--frames", "2:4", "--title", "{{n}} {frame:.1f} {spheres}")
        self.assertEqual([self.title(f"run/{k}.png") for k in (0, 1)], ["{n} 2.0 12", "{n} 3.0 12"])
        self.succeed("render", "run.xyz", "-o", "a.png", *SMALL, "--frame", "4", "--title", "frame {frame}")
        self.assertEqual(self.title("a.png"), "frame 4")
        self.succeed("render", "run.xyz", "-o", "last.png", *SMALL, "--frame", "-2", "--title", "frame {frame}")
        self.assertEqual(self.title("last.png"), "frame 4")
        self.write("timed.xyz", "1\nTime=0.5\nC 0 0 0\n1\nTime=1.25\nC 1 0 0\n")
        self.film("timed.xyz", "-o", "timed/%d.png", *SMALL, "--title", "t = {time:.1f} ps")
        self.assertEqual(self.title("timed/1.png"), "t = 1.2 ps")

    def test_values_of_a_table(self):
        self.write("log.csv", "energy, time\n" + "".join(f"{-1.25 * k},{k}\n" for k in range(6)))
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--title-values", "log.csv", "--title", "{energy:.2f} {time}", "--frames", "::2")
        self.assertEqual(self.title("run/2.png"), "-5.00 4")
        self.assertEqual(self.read("run/1.png"),
                         self.single("run/film.json", "--frame", "2", "--title-values", "log.csv"))
        for text, words in (("e\n1\n", "log.csv:3: has no row for frame 1"), ("e,e\n1,2\n", "two columns"),
                            ("e\nx\n", "log.csv:2: expected"), ("e\n1,2\n", "expected 1 fields, found 2"), ("", "no line of names")):
            self.write("log.csv", text)
            said = self.run_bihive("film", "run.xyz", "-o", "x/%d.png", *SMALL, "--title-values", "log.csv", "--title", "{e}")
            self.assertEqual(said.returncode, 1)
            self.assertIn(words, said.stderr)
            shutil.rmtree(self.path("x"), ignore_errors=True)

    def test_a_value_that_is_not_there(self):
        for title, words in (("{tme}", "a title knows no {tme}; there are {frame}, {time}, {step}, {spheres}"),
                             ("{step}", "the frame does not state its step"), ("{frame", "without its partner"),
                             ("{frame:3}", "expected {frame} or {frame:.2f}")):
            self.assertIn(words, self.fail_usage("film", "run.xyz", "-o", "x.y4m", "--title", title))


class WrongOptions(FilmTest):
    def test_wrong_options(self):
        film = ["film", "run.xyz", "-o", "x.y4m"]
        for more in (["--frames", "9:"], ["--frames", "a"], ["--frames", "0:5:0"], ["--fps", "0"], ["--fps", "1/0"],
                     ["--shard", "3/3"], ["--shard", "1"], ["--pictures", "3"], ["--codec", "-c:v x"], ["--bits", "16"],
                     ["--background", "none"], ["--frame", "1"], ["--layers", "depth"], ["--join"], ["--film", "x"],
                     ["--colour-range", "x"], ["--turntable", "9", "--camera-keys", "k"]):
            self.fail_usage(*film, *more)
        for output in ("x.avi", "x", "x.png", "%d%d.png", "%s.png", "a%d/b.png", "%5d.png", "-"):
            self.fail_usage("film", "run.xyz", "-o", output)
        self.fail_usage("film", "-o", "x.y4m")
        self.fail_usage("film", "run.xyz")
        self.fail_usage("render", "run.xyz", "-o", "x.png", "--picture", "1")
        self.fail_input("film", "missing.xyz", "-o", "x.y4m")
        self.fail_input("film", "run.xyz", "-o", "missing/x.y4m")
        self.write("no.json", "{}")
        self.assertIn("is no description of a film",
                      self.fail_input("render", "run.xyz", "--film", "no.json", "--frame", "0", "-o", "x.png"))

    def test_options_of_the_film_are_not_given_again(self):
        self.film("run.xyz", "-o", "x.y4m", *SMALL)
        said = self.fail_usage("render", "run.xyz", "--film", "x.y4m.json", "--frame", "0", "-o", "x.png", "--size", "9x9")
        self.assertIn("--size is given more than once: here, and in the film's options", said)

    def test_a_folder_in_the_way(self):
        os.mkdir(self.path("x.y4m.part"))
        self.write("x.y4m.part/mine", "kept")
        self.assertIn("is in the place", self.fail_input("film", "run.xyz", "-o", "x.y4m", *SMALL))

    def test_a_broken_frame_ends_the_film(self):
        self.write("run.xyz", frames_of(3) + "2\n\nAr 0 0 0\nAr 0 zero 0\n")
        done = self.run_bihive("film", "run.xyz", "-o", "x.y4m", *SMALL)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assert_one_error_line(done.stderr)
        self.assertIn("run.xyz:", done.stderr)
        # Whole pictures stay for another attempt; there is no film.
        self.assertNotIn("x.y4m", self.names())


if __name__ == "__main__":
    main()
