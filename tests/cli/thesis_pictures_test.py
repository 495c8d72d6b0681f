"""bihive thesis: the figures that are pictures (4.1, 4.2, 4.3), at small size."""

# ctest: COST 700

import json
import os
import shutil

from program import ProgramTest, main, png_pixels, png_size

SOURCE = os.environ["BIHIVE_SOURCE"]
FIGURES = ["figure-4.1", "figure-4.2", "figure-4.3"]


def grey(pixel):
    return pixel[0] == pixel[1] == pixel[2]


class Pictures(ProgramTest):
    def run_figures(self, *arguments, out="out"):
        """Experiments of results.json by id."""
        self.succeed("thesis", *arguments, "--quick", "--out", out)
        results = json.loads(self.read(out + "/results.json"))
        return {experiment["id"]: experiment for experiment in results["experiments"]}

    def pixels(self, name, out="out"):
        return [pixel for row in png_pixels(self.read(f"{out}/{name}")) for pixel in row]

    def verdicts(self, experiment):
        return {finding["name"]: finding["verdict"] for finding in experiment["findings"]}

    def pictures(self, part):
        """The names of all pictures in the data."""
        if isinstance(part, dict) and "picture_hash" in part:
            return [part["name"]]
        parts = part.values() if isinstance(part, dict) else part if isinstance(part, list) else []
        return [name for one in parts for name in self.pictures(one)]

    def stated(self, figure):
        with open(os.path.join(SOURCE, "thesis", figure, "values.json"), encoding="utf-8") as file:
            return json.load(file)

    def with_changed(self, figure, name, value):
        """A folder of values with one of them changed."""
        document = self.stated(figure)
        self.assertIn(name, document["values"])
        self.assertNotEqual(document["values"][name]["value"], value)
        document["values"][name]["value"] = value
        shutil.rmtree(self.path("changed"), ignore_errors=True)
        os.makedirs(self.path("changed/" + figure))
        self.write(f"changed/{figure}/values.json", json.dumps(document))
        return "changed"

    def test_every_picture_is_there_and_not_blank(self):
        experiments = self.run_figures(*FIGURES)
        self.assertEqual(list(experiments), FIGURES)
        names = set()
        for figure, experiment in experiments.items():
            self.assertEqual(experiment["missing_steps"], [])
            for picture in self.pictures(experiment["data"]):
                name = f"{figure}/{picture}"
                names.add(name)
                colours = set(self.pixels(name))
                # The traversal of a tree of one leaf is one blue rectangle on black.
                one_leaf = name in ["figure-4.3/a-traversal.png", "figure-4.3/d-traversal.png"]
                self.assertGreaterEqual(len(colours), 2 if one_leaf else 4, name)
        expected = {f"figure-4.1/scenario{n}.png" for n in (1, 2, 3)}
        expected |= {f"figure-4.2/depth{n}.png" for n in (1, 2, 3, 4, 5)} | {"figure-4.2/depth_colours.png"}
        expected |= {f"figure-4.3/{letter}-{kind}.png" for letter in "abcdef" for kind in ("traversal", "tree")}
        self.assertEqual(names, expected)

        # A quarter of the stated size; the drawings of the tree, which have two parts, half of it.
        for figure in FIGURES:
            values = self.stated(figure)["values"]
            width, height = values["width_px"]["value"], values["height_px"]["value"]
            for picture in self.pictures(experiments[figure]["data"]):
                divisor = 2 if picture.endswith("-tree.png") else 4
                self.assertEqual(png_size(self.read(f"out/{figure}/{picture}")), (width // divisor, height // divisor))

    def test_the_scenes_are_as_the_text_says(self):
        experiment = self.run_figures("figure-4.1")["figure-4.1"]
        verdicts = self.verdicts(experiment)
        # Our angle of view is a round number, and a slightly smaller one would do.
        self.assertEqual({name for name, verdict in verdicts.items() if verdict != "agrees"}, {"camera.needed_fov"})
        self.assertAlmostEqual(experiment["data"]["scene"]["camera"]["needed_fov_deg"], 27.8, delta=0.05)
        for name in ["camera.eye", "light.position", "plane.point", "red.colour", "transparent.transmissive"]:
            self.assertEqual(verdicts[name], "agrees")
        for scenario in ("1", "2", "3"):
            self.assertEqual(verdicts[f"scenario{scenario}.visible"], "agrees")
        # 2048 spheres of a grid of 12 x 12 x 12 = 1728: the others begin anew at its first place.
        coinciding = [experiment["data"]["scenarios"][f"scenario{scenario}"]["coinciding"] for scenario in (1, 2, 3)]
        self.assertEqual(coinciding, [0, 0, 2048 - 1728])

    def test_each_depth_is_the_deepest_somewhere(self):
        experiment = self.run_figures("figure-4.2")["figure-4.2"]
        self.assertEqual(set(self.verdicts(experiment).values()), {"agrees"})
        coding = experiment["data"]["coding"]
        depths = list(coding["depths"].values())
        self.assertEqual([entry["depth"] for entry in depths], [0, 1, 2, 3, 4, 5])
        self.assertEqual(sum(entry["pixels"] for entry in depths), coding["pixels"])

        # The counts are those of the picture.
        pixels = self.pixels("figure-4.2/depth_colours.png")
        self.assertEqual(len(pixels), coding["pixels"])
        for entry in depths:
            colour = tuple(round(255 * channel) for channel in entry["colour"])
            self.assertEqual(pixels.count(colour), entry["pixels"])
            self.assertGreater(entry["pixels"], 0.005 * len(pixels), entry)

        # The shares add up, and the caption in the report is the legend.
        self.assertAlmostEqual(sum(entry["percent"] for entry in depths), 100, delta=1e-6)
        report = self.read("out/report.html").decode()
        for entry in depths[1:]:
            self.assertIn(f"{entry['words']} {entry['depth']} ({entry['percent']:.2f} %)", report)
        # Each generation adds rays.
        rays = [result["rays_per_pixel"] for result in experiment["data"]["depths"].values()]
        self.assertEqual(rays, sorted(rays))
        self.assertEqual(rays[0], 1)

    def test_the_transparent_sphere_is_dark_grey_without_its_transmitted_light(self):
        experiment = self.run_figures("figure-4.2")["figure-4.2"]
        self.assertEqual(self.verdicts(experiment)["dark_grey.radiance"], "agrees")
        by_depth = [experiment["data"]["depths"][f"depth{n}"] for n in range(1, 6)]
        means = [result["transparent_sphere"]["brightness_mean"] for result in by_depth]
        self.assertEqual(means, sorted(means), "each generation adds light")
        for result in by_depth[1:]:
            self.assertGreater(result["changed_percent"], 0)
        # The middle of the sphere, in the middle of the picture: grey first, then with the red ones behind it.
        first, last = self.pixels("figure-4.2/depth1.png"), self.pixels("figure-4.2/depth5.png")
        reddened = sum(grey(a) and not grey(b) for a, b in zip(first, last))
        self.assertGreater(reddened, by_depth[0]["transparent_sphere"]["pixels"] / 4)

    def test_equal_trees_make_equal_files(self):
        experiment = self.run_figures("figure-4.3")["figure-4.3"]
        for one, other in [("a", "d"), ("c", "f")]:
            for kind in ["traversal", "tree"]:
                self.assertEqual(
                    self.read(f"out/figure-4.3/{one}-{kind}.png"), self.read(f"out/figure-4.3/{other}-{kind}.png")
                )
            for what in ["nodes", "pixels"]:
                self.assertEqual(self.verdicts(experiment)[f"{one}_and_{other}.{what}"], "agrees")
        files = {self.read(f"out/figure-4.3/{letter}-traversal.png") for letter in "abcdef"}
        self.assertEqual(len(files), 4)

    def test_trees_are_as_the_text_says_where_it_agrees_with_itself(self):
        experiment = self.run_figures("figure-4.3")["figure-4.3"]
        verdicts = self.verdicts(experiment)
        self.assertEqual({verdict for name, verdict in verdicts.items() if not name.startswith("as_stated")}, {"agrees"})
        trees = {letter: result["tree"] for letter, result in experiment["data"]["trees"].items()}
        self.assertEqual((trees["a"]["inner_nodes"], trees["a"]["leaves"], trees["a"]["spheres_per_leaf"]), (0, 1, 64))
        self.assertEqual((trees["b"]["leaves"], trees["b"]["spheres_per_leaf"], trees["b"]["depth"]), (4, 16, 3))
        self.assertEqual((trees["e"]["leaves"], trees["e"]["spheres_per_leaf"], trees["e"]["depth"]), (2, 32, 2))
        self.assertEqual((trees["f"]["inner_nodes"], trees["f"]["leaves"], trees["f"]["depth"]), (63, 64, 7))

        # With MAX_PRIMS unlimited, which the text states for (a) to (c), the text's own words on (b) and (c) do not
        # hold.
        self.assertEqual(verdicts["as_stated.a.leaves"], "agrees")
        self.assertEqual(verdicts["as_stated.b.leaves"], "text_inconsistent")
        self.assertEqual(verdicts["as_stated.c.spheres_per_leaf"], "text_inconsistent")

    def test_a_text_without_its_contradiction_agrees(self):
        folder = self.with_changed("figure-4.3", "abc.max_prims_stated", 1)
        experiment = self.run_figures("figure-4.3", "--values", folder)["figure-4.3"]
        # (b) is described with a limit of depth, which it has either way.
        self.assertEqual(set(self.verdicts(experiment).values()), {"agrees"})

    def test_the_traversal_counts_in_the_stated_steps(self):
        # Green: 0.2 a gap. Blue: 0.15 a leaf, 0.02 an inner node; so the text's green areas are seen.
        trees = self.run_figures("figure-4.3")["figure-4.3"]["data"]["trees"]
        self.assertEqual(set(self.pixels("figure-4.3/a-traversal.png")), {(0, 0, 0), (0, 0, 38)})
        for red, green, blue in set(self.pixels("figure-4.3/c-traversal.png")):
            self.assertEqual((red, green % 51), (0, 0))
            self.assertLess(blue, 255)
        for letter in "abcdef":
            pixels = self.pixels(f"figure-4.3/{letter}-traversal.png")
            seen = sum(green > blue for _, green, blue in pixels) / len(pixels)
            self.assertAlmostEqual(trees[letter]["seen"]["green_percent"], 100 * seen)
            self.assertEqual(seen > 0.02, letter in "bcef", letter)

    def test_blue_as_strong_as_green_hides_the_green_areas(self):
        document = self.stated("figure-4.3")
        for name in ["visit.leaf.blue", "visit.inner.blue"]:
            document["values"][name]["value"] = 0.2
        os.makedirs(self.path("changed/figure-4.3"))
        self.write("changed/figure-4.3/values.json", json.dumps(document))
        experiment = self.run_figures("figure-4.3", "--values", "changed")["figure-4.3"]
        self.assertEqual(self.verdicts(experiment)["green_areas"], "differs")

    def test_a_changed_value_turns_its_row(self):
        changes = {
            "figure-4.1": [
                ("camera.eye", [0.0, 0.0, 90.0], "camera.eye"),
                ("red.ambient", 0.4, "red.ambient"),
                ("scenario1.extent", [-20.0, 19.0], "scenario1.extent"),
                ("scenario2.extent", [-20.0, 19.0], "scenario2.extent"),
                ("scenario1.spacing_difference", 0.5, "scenario1.spacing_difference"),
                ("scenario2.clusters", 7, "scenario2.clusters"),
                ("scenario3.clustered_share", 0.4, "scenario3.clustered_share"),
                ("scenario2.cluster_side", 6.0, "scenario3.clustered_corners"),
                ("scenario3.spacing_difference", 0.5, "scenario3.spacing_difference"),
            ],
            "figure-4.2": [
                ("spheres", 5, "spheres"),
                ("coding.depth3.colour", [0.0, 1.0, 1.0], "coding.depth3.colour"),
                ("dark_grey.radiance", [0.3, 0.4], "dark_grey.radiance"),
            ],
            "figure-4.3": [
                ("b.leaves", 5, "b.leaves"),
                ("e.depth", 3, "e.depth"),
                ("f.spheres_per_leaf", 2, "f.spheres_per_leaf"),
                ("gap.green", 0.25, "gap.green"),
                ("f.max_prims", 4, "c_and_f.nodes"),
                ("f.max_prims", 4, "c_and_f.pixels"),
            ],
        }
        for figure, rows in changes.items():
            kept = self.verdicts(self.run_figures(figure)[figure])
            for name, value, row in rows:
                self.assertEqual(kept[row], "agrees")
                folder = self.with_changed(figure, name, value)
                changed = self.run_figures(figure, "--values", folder, out="other")[figure]
                self.assertEqual(self.verdicts(changed)[row], "differs", (figure, name))
                shutil.rmtree(self.path("other"))


if __name__ == "__main__":
    main()
