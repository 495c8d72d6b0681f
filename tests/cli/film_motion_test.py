"""bihive film: the axis of turntables, films that keep spheres in place, cameras for all frames."""

import json
import shutil

from film_test import SMALL, FilmTest
from program import main, png_pixels, png_text


def unit(vector):
    length = sum(x * x for x in vector) ** 0.5
    return [x / length for x in vector]


class TurntableAxis(FilmTest):
    def setUp(self):
        super().setUp()
        self.write("one.xyz", "3\n\nC 0 0 0\nO 3 0 0\nN 0 2 1\n")

    def directions(self, *arguments, given="one.xyz", more=SMALL):
        shutil.rmtree(self.path("turn"), ignore_errors=True)
        self.film(given, "-o", "turn/%d.png", *more, "--turntable", "360", "--pictures", "4", *arguments)
        cameras = [json.loads(png_text(self.read(f"turn/{k}.png"))["Settings"])["camera"] for k in range(4)]
        return [unit([a - b for a, b in zip(one["eye"], one["look_at"])]) for one in cameras]

    def assert_same_along(self, axis, directions):
        for k in range(1, 4):
            self.assertAlmostEqual(directions[k][axis], directions[0][axis], places=6)
            self.assertGreater(sum(abs(a - b) for a, b in zip(directions[k], directions[0])), 0.1)

    def test_it_turns_about_the_up_of_the_world(self):
        for more in (["--view-from", "iso"], ["--turn", "20,30"], ["--turn", "20,30,40"], []):
            self.assert_same_along(1, self.directions(*more))
        self.assert_same_along(2, self.directions("--view-from", "top"))
        # From above, the picture's own vertical passes over the poles.
        tumbling = self.directions("--view-from", "iso", "--turn-axis", "picture")
        self.assertGreater(abs(tumbling[1][1] - tumbling[0][1]), 0.1)

    def test_it_turns_about_the_axis_that_is_asked_for(self):
        self.assert_same_along(2, self.directions("--turn-axis", "z", "--view-from", "left"))
        self.assert_same_along(0, self.directions("--turn-axis", "x", "--view-from", "iso"))
        self.succeed("render", "one.xyz", "--film", "turn/film.json", "--picture", "3", "-o", "3.png")
        self.assertEqual(self.read("3.png"), self.read("turn/3.png"))

    def test_it_turns_about_the_up_of_a_camera_that_was_stated(self):
        scene = {"bihive_scene": 2, "camera": {"eye": [9, 0, 5], "look_at": [0, 0, 0], "up": [0, 0, 2]}, "spheres": [[0, 0, 0, 1], [2, 0, 0, 1]]}
        self.write("s.json", json.dumps(scene))
        self.assert_same_along(2, self.directions(given="s.json", more=["--size", "48x32"]))

    def test_what_is_refused(self):
        self.assertIn("--turn-axis is for --turntable", self.fail_usage("film", "one.xyz", "-o", "a.y4m", "--turn-axis", "y"))
        self.assertIn("--turn-axis", self.fail_usage("film", "one.xyz", "-o", "a.y4m", "--turntable", "9", "--turn-axis", "up"))


class InPlace(FilmTest):
    """Films that keep selected spheres in place."""

    def camera(self, k):
        return json.loads(png_text(self.read(f"run/{k}.png"))["Settings"])["camera"]

    def frames(self, name, frames, cell=None):
        """An extended XYZ file of argon at these points."""
        lattice = f'Lattice="{cell} 0 0 0 {cell} 0 0 0 {cell}" ' if cell else ""
        self.write(name, "".join(f"{len(points)}\n{lattice}Properties=species:S:1:pos:R:3\n" +
                                 "".join(f"Ar {x} {y} {z}\n" for x, y, z in points) for points in frames))

    def test_the_camera_follows(self):
        self.frames("walk.xyz", [[(k, 0, 0), (k + 1, 2 * k, 0), (0, 0, 9)] for k in range(4)])
        self.film("walk.xyz", "-o", "run/%d.png", *SMALL, "--follow", "index 0 1")
        for k in range(4):
            for part in ("eye", "look_at"):
                moved = [a - b for a, b in zip(self.camera(k)[part], self.camera(0)[part])]
                for found, wanted in zip(moved, (k, k, 0)):
                    self.assertAlmostEqual(found, wanted, places=5)
        self.assertEqual(self.read("run/2.png"), self.one("walk.xyz", 2))

    def one(self, given, frame):
        self.succeed("render", given, "--film", "run/film.json", "--frame", str(frame), "-o", "one.png")
        return self.read("one.png")

    def test_it_follows_through_the_boundaries_of_a_cell(self):
        cell = 10
        for count in (1, 2):
            # Where the second sphere has left the cell before the first, the mean of both is in the middle of nowhere.
            places = [[((3 * k + i) % cell, 5 + k / 8, 5) for i in range(count)] for k in range(8)]
            self.frames("walk.xyz", [[*here, (1, 1, 1)] for here in places], cell)
            self.film("walk.xyz", "-o", "run/%d.png", *SMALL, "--follow", f"index 0..{count - 1}")
            for k in range(8):
                for axis in range(2):
                    self.assertAlmostEqual(self.camera(k)["eye"][axis] - self.camera(0)["eye"][axis],
                                           places[k][0][axis] - places[0][0][axis], places=4)
            shutil.rmtree(self.path("run"))
        # Without a cell it follows the mean.
        self.frames("open.xyz", [[*here, (1, 1, 1)] for here in places])
        self.film("open.xyz", "-o", "run/%d.png", *SMALL, "--follow", "index 0 1")
        self.assertAlmostEqual(self.camera(3)["eye"][0] - self.camera(0)["eye"][0], (9 + 0) / 2 - (0 + 1) / 2, places=4)

    def test_a_selection_may_change_and_vanish(self):
        self.frames("grow.xyz", [[(0, 0, 0), (4, 0, 0)], [(1, 0, 0), (5, 0, 0), (6, 0, 0)], [(1, 0, 0)], [(4, 1, 0), (5, 1, 0)]])
        self.film("grow.xyz", "-o", "run/%d.png", *SMALL, "--follow", "x > 3.5")
        moved = [self.camera(k)["eye"][0] - self.camera(0)["eye"][0] for k in range(4)]
        for found, wanted in zip(moved, (0, 1.5, 1.5, 0.5)):
            self.assertAlmostEqual(found, wanted, places=5)

    def test_frames_are_laid_over_the_first(self):
        body = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0, 0, 5)]
        turned = [[(x, y, z), (-y + 7, x - 3, z + 1), (z, -y, x + 9)] for x, y, z in body]
        self.frames("body.xyz", [[point[k] for point in turned] for k in range(3)])
        self.film("body.xyz", "-o", "run/%d.png", "--size", "48x32", "--align", "index 0..2")
        pictures = [png_pixels(self.read(f"run/{k}.png")) for k in range(3)]
        for k in (1, 2):
            different = sum(a != b for one, other in zip(pictures[0], pictures[k]) for a, b in zip(one, other))
            self.assertLess(different, 48 * 32 / 50)
        self.assertEqual(self.camera(0), self.camera(2))
        self.assertEqual(self.read("run/2.png"), self.one("body.xyz", 2))
        shutil.rmtree(self.path("run"))
        self.run_bihive("film", "body.xyz", "-o", "run/%d.png", "--size", "48x32")
        pictures = [png_pixels(self.read(f"run/{k}.png")) for k in range(3)]
        self.assertGreater(sum(a != b for one, other in zip(pictures[0], pictures[1]) for a, b in zip(one, other)), 48 * 32 / 20)

    def test_descriptions_with_wrong_motions_are_refused(self):
        self.film("run.xyz", "-o", "run/%d.png", *SMALL, "--follow", "index 0")
        plan = json.loads(self.read("run/film.json"))
        for shifts in ([[0, 0, 0]], [[1e300, 0, 0]] * 6, [[0, 0]] * 6, ["x"] * 6):
            plan["fixed"]["shifts"] = shifts
            self.write("wrong.json", json.dumps(plan))
            done = self.run_bihive("render", "run.xyz", "--film", "wrong.json", "--frame", "1", "-o", "a.png")
            self.assertEqual(done.returncode, 1, shifts)
            self.assertIn("wrong.json: is no description of a film", done.stderr)

    def test_shards_know_the_same_motions(self):
        for option in ("--follow", "--align"):
            shutil.rmtree(self.path("run"), ignore_errors=True)
            shutil.rmtree(self.path("all"), ignore_errors=True)
            for shard in ("0/2", "1/2"):
                self.film("run.xyz", "-o", "run/%d.png", *SMALL, option, "index 0..4", "--shard", shard)
            self.film("run.xyz", "-o", "all/%d.png", *SMALL, option, "index 0..4")
            for k in range(6):
                self.assertEqual(self.read(f"run/{k}.png"), self.read(f"all/{k}.png"), option)

    def test_what_is_refused(self):
        self.frames("grow.xyz", [[(0, 0, 0), (4, 0, 0), (1, 2, 3)], [(1, 0, 0), (5, 0, 0), (6, 0, 0), (7, 1, 0)]])
        film = ["film", "grow.xyz", "-o", "a.y4m", *SMALL]
        for words, reason in [
            (["--follow", "index 9"], '--follow "index 9" selects no sphere of the first frame'),
            (["--align", "index 9"], '--align "index 9" selects no sphere of the first frame'),
            (["--align", "index 0 1"], '--align "index 0 1" selects 2 of the spheres, and needs 3 or more'),
            (["--align", "all"], '--align "all" selects 3 spheres in frame 0, and 4 in frame 1'),
            (["--align", "all", "--follow", "all"], "--follow and --align both keep spheres in place"),
            (["--follow", "all", "--frames", "0:1"], "--follow is for a film of several frames"),
            (["--follow", "index and"], "--follow: "),
        ]:
            self.assertIn(reason, self.fail_usage(*film, *words), words)
        self.assertEqual(self.run_bihive(*film, "--follow", "colour 3").returncode, 2)


class GrowingSets(FilmTest):
    def setUp(self):
        super().setUp()
        # A row that grows to the right, until most of it is outside.
        self.write("grow.xyz", "".join(f"{n}\n\n" + "".join(f"Ar {4 * i} 0 0\n" for i in range(n)) for n in (2, 3, 9)))

    def test_a_set_that_leaves_the_picture_is_told(self):
        done = self.run_bihive("film", "grow.xyz", "-o", "run/%d.png", *SMALL)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"\Abihive: warning: \d of \d spheres are outside of picture [12]: --fit-frames all brings [^\n]*\n\Z")
        for more in (["--fit-frames", "all"], ["--fit-frames", "each"], ["--eye", "0,0,9"], ["--frames", "0:1"]):
            shutil.rmtree(self.path("run"), ignore_errors=True)
            self.film("grow.xyz", "-o", "run/%d.png", *SMALL, *more)

    def camera(self, k):
        return json.loads(png_text(self.read(f"run/{k}.png"))["Settings"])["camera"]

    def test_all_frames_are_in_view(self):
        for more in ([], ["--projection", "orthographic"], ["--view-from", "iso"], ["--zoom", "0.5"]):
            shutil.rmtree(self.path("run"), ignore_errors=True)
            self.film("grow.xyz", "-o", "run/%d.png", *SMALL, "--fit-frames", "all", *more)
            self.assertEqual(self.camera(0), self.camera(2))
            # The last frame has all spheres of the others: its own camera is that of the film.
            self.succeed("render", "grow.xyz", "--frame", "2", "-o", "last.png", *SMALL, *more)
            alone = json.loads(png_text(self.read("last.png"))["Settings"])["camera"]
            for part in ("eye", "look_at"):
                for a, b in zip(alone[part], self.camera(2)[part]):
                    self.assertAlmostEqual(a, b, places=6)

    def test_each_frame_for_itself(self):
        self.film("grow.xyz", "-o", "run/%d.png", *SMALL, "--fit-frames", "each")
        for k in range(3):
            self.succeed("render", "grow.xyz", "--frame", str(k), "-o", "one.png", *SMALL)
            self.assertEqual(json.loads(png_text(self.read("one.png"))["Settings"])["camera"], self.camera(k))
            self.succeed("render", "grow.xyz", "--film", "run/film.json", "--frame", str(k), "-o", "one.png")
            self.assertEqual(self.read("one.png"), self.read(f"run/{k}.png"))

    def test_what_is_refused(self):
        film = ["film", "grow.xyz", "-o", "a.y4m", *SMALL, "--fit-frames"]
        for words, reason in [(["all", "--eye", "0,0,9"], "--fit-frames all is for a camera that bihive places"),
                              (["all", "--fit", "all"], "--fit-frames all is for a camera that bihive places"),
                              (["each", "--follow", "all"], "--fit-frames each moves the camera in each picture, and so does --follow"),
                              (["some"], "--fit-frames: expected one of first, all, each")]:
            self.assertIn(reason, self.fail_usage(*film, *words), words)
        self.assertIn("--fit-frames all is for a camera that does not turn",
                      self.fail_usage("film", "grow.xyz", "--frames", "0:1", "-o", "a.y4m", "--turntable", "9", "--fit-frames", "all"))


if __name__ == "__main__":
    main()
