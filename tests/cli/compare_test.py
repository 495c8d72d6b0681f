"""bihive compare: the same bits from all structures, counts that do not depend on threads, the JSON's schema, the report."""

import base64
import html.parser
import json
import os

import jsonschema
import numpy
from program import ProgramTest, main, png_pixels, png_size

SOURCE = os.environ.get("BIHIVE_SOURCE", os.path.join(os.path.dirname(__file__), "../.."))
STRUCTURES = "wide bih bvh-sah bvh-lbvh bvh-ploc kd-sah octree grid pkd brute".split()
KINDS = "primary random shadow mirror ao points".split()
FEW = ["--rays-count", "256", "--threads", "1"]


class Page(html.parser.HTMLParser):
    """The words of a page, its tags, and what it would fetch."""

    def __init__(self, text):
        super().__init__()
        self.words, self.tags, self.links, self.open = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.links += [value for key, value in attributes if key in ("src", "href")]

    def handle_data(self, data):
        self.words.append(data)


def schema_of(name):
    with open(os.path.join(SOURCE, f"docs/{name}.schema.json")) as file:
        return json.load(file)


class Compare(ProgramTest):
    def compare(self, *words, command="compare", schema="comparison"):
        result = self.succeed_json(command, *words)
        schema = schema_of(schema)
        jsonschema.Draft7Validator.check_schema(schema)
        jsonschema.Draft7Validator(schema).validate(result)
        return result

    def test_names_are_the_same_everywhere(self):
        """The program's tables, its help, the documentation and the schemas know the same structures, rays and parameters."""
        with open(os.path.join(SOURCE, "docs/comparison.md")) as file:
            documentation = file.read()
        help_text = " ".join(self.succeed("compare", "--help").split())
        self.assertIn("The structures (all): " + ", ".join(STRUCTURES), help_text)
        self.assertIn("The rays (all): " + ", ".join(KINDS), help_text)

        def names_of(heading):
            part = documentation.split(f"## {heading}\n")[1].split("\n## ")[0]
            return [line.split("`")[1] for line in part.splitlines() if line.startswith("| `")]

        self.assertEqual(names_of("Structures"), STRUCTURES)
        self.assertEqual(names_of("Rays"), KINDS)
        parameters = names_of("Parameters")
        for schema in ("comparison", "sweep"):
            self.assertEqual(schema_of(schema)["definitions"]["kind"]["enum"], KINDS)
        for schema in ("sweep", "tuning"):
            self.assertEqual(list(schema_of(schema)["definitions"]["parameters"]["properties"]), parameters)
        self.assertIn(", ".join(parameters), self.fail_usage("compare", "demo", "--sweep", "x=1"))

    def test_all_structures_and_kinds(self):
        result = self.compare("demo", "--rays-count", "512")
        self.assertEqual([one["name"] for one in result["structures"]], STRUCTURES)
        self.assertEqual(list(result["queries"]), KINDS)
        self.assertTrue(result["same_bits"])
        # 512 primary rays are rounded to whole blocks.
        self.assertEqual((result["queries"]["primary"], result["queries"]["random"]), (576, 512))
        self.assertEqual(result["queries"]["mirror"], result["queries"]["ao"])
        for one in result["structures"]:
            self.assertTrue(one["same_bits"], one["name"])
            self.assertEqual(list(one["kinds"]), KINDS)
            for kind, steps in one["kinds"].items():
                self.assertEqual(steps["different"], 0, (one["name"], kind))
                self.assertEqual(len(one["mray_per_s"][kind]), len(result["threads"]))
                self.assertGreaterEqual(steps["nodes"]["mean"], steps["leaves"]["mean"])
                self.assertGreaterEqual(steps["sphere_tests"]["99_percent"], 1)
                self.assertAlmostEqual(steps["cost"], steps["nodes"]["mean"] + steps["test_steps"]["mean"])
            if one["name"] != "brute":
                self.assertEqual(len(one["levels"]), 0 if one["name"] == "grid" else one["depth"])
                self.assertGreaterEqual(one["references"], result["spheres"] if one["name"] != "wide" else 1)
                self.assertLess(one["kinds"]["random"]["cost"], result["spheres"] / 4)
        brute = result["structures"][-1]
        self.assertEqual(brute["kinds"]["random"]["sphere_tests"], {"mean": result["spheres"], "99_percent": result["spheres"]})
        self.assertEqual((brute["nodes"], brute["bytes"]), (0, 0))

    def test_counts_depend_on_the_spheres_alone(self):
        def counts(*words):
            result = self.compare("scenario2", "--count", "500", "--radius", "0.3", "--rays", "random,ao,points", "--rays-count", "256", *words)
            return [(one["name"], one["kinds"], one["expected"], one["bytes"]) for one in result["structures"]], result["threads"]

        one, two, both = counts("--threads", "1"), counts("--threads", "2"), counts("--threads", "2,1")
        self.assertEqual(one[0], two[0])
        self.assertEqual(one[0], both[0])
        self.assertEqual((one[1], two[1], both[1]), ([1], [2], [2, 1]))

    def test_costs_of_steps(self):
        fits = [one["fit"] for one in self.compare("demo", "--rays-count", "1024", "--structures", "bih,kd-sah")["structures"]]
        for fit in fits:
            self.assertEqual(fit["groups"], 4 * len(KINDS))
            self.assertGreater(sum(fit[step] for step in ("fixed_ns", "inner_ns", "leaf_ns", "test_ns")), 0)
        # Too few queries for groups.
        few = self.compare("demo", "--rays-count", "16", "--rays", "random", "--structures", "bih")["structures"]
        self.assertIsNone(few[0]["fit"])

    def test_chosen_ones(self):
        result = self.compare("four-spheres", "--structures", "grid,bih", "--rays", "points,primary", *FEW)
        self.assertEqual([one["name"] for one in result["structures"]], ["grid", "bih"])
        self.assertEqual(list(result["queries"]), ["points", "primary"])
        self.assertEqual(result["correlation"], {"points": None, "primary": None})

    def test_slow_structures_take_a_sample(self):
        result = self.compare("scenario3", "--count", "300000", "--radius", "0.05", "--structures", "brute,wide", "--rays", "random",
                              "--rays-count", "4096")
        brute, wide = (one["kinds"]["random"]["queries"] for one in result["structures"])
        self.assertEqual((brute, wide), (2**28 // 300000, 4096))
        self.assertTrue(result["same_bits"])

    def test_degenerate_spheres(self):
        self.write("one.xyz", "1\n\nC 1 2 3\n")
        self.assertTrue(self.compare("one.xyz", *FEW, "--rays", "random,mirror,points")["same_bits"])
        # Points without extent: rays hit nothing, and no ray starts at a hit.
        self.write("points.csv", "x,y,z,r\n" + "0.5,0.5,0.5,0\n" * 40)
        result = self.compare("points.csv", *FEW, "--rays", "random,shadow,points")
        self.assertTrue(result["same_bits"])
        self.assertEqual((result["queries"]["shadow"], result["structures"][0]["mray_per_s"]["shadow"]), (0, []))
        self.assertIsNone(result["structures"][0]["expected"]["cost"])
        self.assertIn("no primary ray leads to one", self.succeed("compare", "points.csv", *FEW, "--rays", "shadow"))

    def test_text(self):
        text = self.succeed("compare", "demo", *FEW, "--rays", "random,ao")
        lines = text.splitlines()
        self.assertRegex(lines[0], r"spheres, 1( and \d+)? threads?, ")
        self.assertRegex(lines[1], r"is the fastest|the only")
        for name in STRUCTURES:
            self.assertEqual(sum(line.startswith(name + " ") for line in lines[2:]), 4, name)
        self.assertIn("random: 256 rays", text)
        self.assertEqual(lines[-1], "Every answer has the bits of the reference BIH.")

    def test_report(self):
        self.write("<b>&.xyz", "2\n\nC 1 2 3\nO 2 2 3\n")
        self.succeed("compare", "<b>&.xyz", *FEW, "-o", "report.html")
        page = Page(self.read("report.html").decode())
        text = " ".join(page.words)
        self.assertIn("Structures for <b>&.xyz", text)
        self.assertNotIn("b", page.tags)
        self.assertNotIn("script", page.tags)
        self.assertEqual(page.links[0], "data:,")
        for link in page.links[1:]:
            self.assertTrue(link.startswith("data:image/png;base64,"), link[:60])
        self.assertIn("Every structure gave the same answers, bit for bit.", text)
        self.assertNotIn("{{", text)
        for name in STRUCTURES:
            self.assertIn(name, text)
        self.assertIn("What a step costs", text)
        # A single kind has too few groups for a fit.
        done = self.run_bihive("compare", "<b>&.xyz", *FEW, "--rays", "random", "-o", "-")
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("What a step costs", done.stdout)
        self.assertTrue(done.stdout.startswith("<!DOCTYPE html>"))
        self.assertIn("Every answer has the bits", done.stderr)

    def test_report_shows_where_the_steps_are(self):
        """A picture for each structure, on one scale: brute force has the same steps everywhere, a tree has not."""
        self.succeed("compare", "four-spheres", *FEW, "--rays", "primary", "-o", "report.html")
        page = Page(self.read("report.html").decode())
        pictures = [link.split(",")[1] for link in page.links if link.startswith("data:image/png")]
        self.assertEqual(len(pictures), len(STRUCTURES))
        colours = {}
        for name, text in zip(STRUCTURES, pictures):
            png = base64.b64decode(text)
            self.assertEqual(png_size(png), (192, 192))
            colours[name] = {pixel for row in png_pixels(png) for pixel in row}
        self.assertEqual(len(colours["brute"]), 1)
        self.assertGreater(len(colours["bvh-sah"]), 2)
        text = " ".join(page.words)
        self.assertIn("4 at most", text)
        self.assertIn("Where the steps are", text)

    def test_refusals(self):
        for words, part in (
            (["--structures", "wide,octopus"], "there is no structure \"octopus\"; there are wide, bih"),
            (["--structures", "bih,bih"], "bih stands twice"),
            (["--structures", ""], "there is no structure \"\""),
            (["--structures", "octre"], "did you mean octree?"),
            (["--structures", "embree"], "libembree-dev"),
            (["--sweep", "max-prim=2"], "did you mean max-prims?"),
            (["--sweep", "max-prims"], "max-prims has no values"),
            (["--sweep", "max-prims=0"], "max-prims: expected a whole number from 1"),
            (["--sweep", "max-prims=2,2"], "max-prims has the value 2 twice"),
            (["--sweep", "max-prims=2", "--sweep", "max-prims=3"], "max-prims stands twice"),
            (["--pixel", "3"], "expected a pixel X,Y"),
            (["--pixel", "0,600"], "lies outside the picture of 256 x 256 pixels"),
            (["--pixel", "0,0", "--sweep", "max-prims=2"], "--pixel prints the path of one ray"),
            (["--threads", "1,x"], "--threads"),
            (["--rays", "x-rays"], "there are no rays \"x-rays\"; there are primary"),
            (["--rays-count", "0"], "--rays-count"),
            (["--json", "-o", "-"], "--json and a report on -"),
        ):
            self.assertIn(part, self.fail_usage("compare", "demo", *words))
        self.assertIn("stored spheres", self.fail_usage("compare", "demo", "--replicate", "2x2x2"))
        self.assertIn("grid takes none of these parameters", self.fail_input("compare", "demo", "--structures", "grid", "--sweep", "max-prims=2"))
        many = ",".join(str(i) for i in range(1, 300))
        self.assertIn("combinations", self.fail_input("compare", "demo", "--structures", "bih", "--sweep", "max-prims=" + many))
        self.assertIn("no sphere is selected", self.fail_input("compare", "demo", "--select", "name XX"))
        self.assertIn("has no parameters to tune", self.fail_input("tune", "demo", "--structure", "pkd"))

    def test_sweep(self):
        words = ["demo", "--structures", "bih,kd-sah,grid", "--rays", "random,shadow", *FEW]
        self.assertIn("grid takes none", self.fail_input("compare", *words, "--sweep", "max-depth=3"))
        words[2] = "bih,bvh-ploc"
        sweep = ["--sweep", "max-prims=1,4,16", "--sweep", "max-depth=8,20"]
        result = self.compare(*words, *sweep, schema="sweep")
        bih, ploc = result["structures"]
        # The second one has no limit of levels.
        self.assertEqual([point["parameters"] for point in ploc["points"]], [{"max-prims": n} for n in (1, 4, 16)])
        self.assertEqual(
            [point["parameters"] for point in bih["points"]],
            [{"max-prims": n, "max-depth": d} for n in (1, 4, 16) for d in (8, 20)],
        )
        for swept in result["structures"]:
            costs = [point["cost"] for point in swept["points"]]
            for point in swept["points"]:
                self.assertEqual(point["different"], 0)
                self.assertEqual(point["good_by_work"], point["cost"] <= 1.02 * min(costs))
                self.assertLessEqual(point["depth"], point["parameters"].get("max-depth", 1000))
                self.assertAlmostEqual(point["cost"], sum(kind["cost"] for kind in point["kinds"].values()) / 2)
        # The same counts as the comparison's.
        alone = self.compare(*words, *sweep[:2], schema="sweep")["structures"][0]["points"]
        own = self.compare("demo", "--structures", "bih", "--rays", "random,shadow", *FEW)["structures"][0]["kinds"]
        eight = self.compare(*words, "--sweep", "max-prims=8", schema="sweep")["structures"][0]["points"][0]
        for kind, steps in own.items():
            self.assertAlmostEqual(steps["cost"], eight["kinds"][kind]["cost"])
        self.assertEqual(len(alone), 3)
        text = self.succeed("compare", *words, *sweep, "-o", "sweep.html")
        self.assertRegex(text, r"bih: best by counted cost max-prims \d+")
        page = Page(self.read("sweep.html").decode())
        self.assertIn("Parameters for demo", " ".join(page.words))
        self.assertNotIn("{{", " ".join(page.words))
        self.assertEqual(page.tags.count("table"), 4)

    def test_tune(self):
        result = self.compare("demo", "--rays-count", "128", command="tune", schema="tuning")
        self.assertEqual(result["structure"], "wide")
        self.assertIn(result["best"], result["candidates"])
        self.assertEqual(result["own"]["parameters"], {})
        self.assertGreater(result["own"]["rounds"], 0)
        for one in result["candidates"]:
            self.assertEqual(one["ns"] is None, one["rounds"] == 0)
        # Counted work does not depend on the machine: no two candidates are one tree.
        trees = [(one["bytes"], one["depth"], one["cost"]) for one in result["candidates"]]
        self.assertEqual(len(set(trees)), len(trees))
        self.assertRegex(self.succeed("tune", "demo", "--structure", "bih", "--rays", "random", "--rays-count", "128"), r"bih: (nothing to gain|[\d.]+ times as fast with --|as fast by the clock as its own choice)")
        # One sphere has one tree.
        self.write("one.xyz", "1\n\nC 1 2 3\n")
        self.assertIn("nothing to gain", self.succeed("tune", "one.xyz", "--rays-count", "64"))

    def test_rays_with_a_tuned_tree(self):
        numpy.save(self.path("rays.npy"), numpy.array([[30, 20, 0, -1, -0.5, 0.1], [0, 0, 90, 0, 0, -1]], dtype=numpy.float32))
        rays = ["trace", "demo", "--rays", "rays.npy", "--t"]
        self.succeed(*rays, "own_t.npy", "--id", "own_id.npy")
        said = self.run_bihive(*rays, "t.npy", "--id", "id.npy", "--tune").stderr
        self.assertRegex(said, r"bihive: (no other tree is faster than the engine's own choice|--max-.*: ([\d.]+ times )?as fast)")
        self.assertEqual(self.read("own_t.npy"), self.read("t.npy"))
        self.assertEqual(self.read("own_id.npy"), self.read("id.npy"))
        self.assertIn("searches --max-prims and --max-depth", self.fail_usage(*rays, "t.npy", "--id", "id.npy", "--tune", "--max-prims", "4"))
        self.assertIn("needs a tree", self.fail_usage(*rays, "t.npy", "--id", "id.npy", "--tune", "--engine", "brute"))

    def test_pictures_with_a_tuned_tree(self):
        picture = ["demo", "--size", "48x32", "--samples", "1", "-o"]
        self.succeed("render", *picture, "own.png")
        said = self.run_bihive("render", *picture, "tuned.png", "--tune").stderr
        self.assertRegex(said, "^bihive: (--max-prims \\d+(, --max-depth \\d+)?: ([\\d.]+ times )?as fast (by the clock )?as the engine's own choice(, and faster by counted steps)?|no other tree is faster.*)\n$")
        self.assertEqual(self.read("own.png"), self.read("tuned.png"))
        said = self.run_bihive("render", *picture, "reference.png", "--tune", "--engine", "reference").stderr
        self.assertEqual(self.read("own.png"), self.read("reference.png"))
        # A film has the tree of its first frame.
        self.write("two.xyz", "2\n\nC 0 0 0\nO 1 1 1\n" * 3)
        said = self.run_bihive("film", "two.xyz", "-o", "film/%05d.png", "--size", "16x16", "--tune").stderr
        self.assertEqual(said.count("the engine's own choice"), 1)
        for words in (["--max-prims", "4"], ["--view", "tree"], ["--engine", "brute"]):
            self.assertIn("--tune", self.fail_usage("render", *picture, "no.png", "--tune", *words))
        self.succeed("scene", "save", "scene.json", "demo", "--tune")
        self.assertIn("own choice", self.run_bihive("render", "scene.json", "--size", "48x32", "--samples", "1", "-o", "saved.png").stderr)

    def test_path_of_a_pixel(self):
        result = self.compare("demo", "--pixel", "128,128", schema="ray_paths")
        self.assertEqual([one["name"] for one in result["structures"]], STRUCTURES)
        self.assertEqual(len({(one["id"], one["t"]) for one in result["structures"]}), 1)
        for one in result["structures"]:
            self.assertEqual(one["sphere_tests"], sum(len(step["spheres"]) for step in one["steps"]))
            if one["name"] != "brute":
                self.assertEqual(one["nodes"], len(one["steps"]))
                hits = [step["t"] for step in one["steps"] if step["t"] is not None]
                self.assertEqual(hits, sorted(hits, reverse=True))
        text = self.succeed("compare", "demo", "--pixel", "128,128", "--structures", "bih")
        self.assertIn("the ray through pixel 128,128 of 256 x 256", text)

    def test_boxes(self):
        cells = [(i % 6, i // 6 % 6, i // 36) for i in range(216)]
        lines = [",".join(map(str, [*cell, *(c + 1 for c in cell)])) for cell in cells]
        self.write("cells.csv", "xmin,ymin,zmin,xmax,ymax,zmax\n# a comment\n" + "\n".join(lines) + "\n")
        result = self.compare("cells.csv", "--boxes", "--rays-count", "400", schema="boxes")
        self.assertEqual((result["boxes"], [one["name"] for one in result["structures"]]), (216, ["bih", "bvh-sah", "brute"]))
        for one in result["structures"]:
            self.assertEqual(one["rays"]["different"] + one["points"]["different"], 0)
            # A point lies in one cell, but for faces.
            self.assertAlmostEqual(one["points"]["found"], 1, delta=0.01)
            self.assertEqual(one["rays"]["found"], result["structures"][0]["rays"]["found"])
        self.assertIn("Every structure finds the boxes of brute force.", self.succeed("compare", "cells.csv", "--boxes", "--rays-count", "50"))
        for text, part in (
            ("0,0,0,1,1\n", "bad.csv:1: expected six numbers"),
            ("0,0,0,1,1,1\n0,0,0,1,1,1,1\n", "bad.csv:2: expected six numbers, found more"),
            ("0,0,x,1,1,1\n", 'bad.csv:1: expected a number up to 1e37, found "x"'),
            ("0,0,0,1,-1,1\n", "bad.csv:1: the box ends before it begins along y: 0 > -1"),
            ("", "there is no box"),
        ):
            self.write("bad.csv", text)
            self.assertIn(part, self.fail_input("compare", "bad.csv", "--boxes"))
        self.assertIn("leave out", self.fail_usage("compare", "cells.csv", "--boxes", "--structures", "bih"))

    def test_boxes_of_a_geometry(self):
        cells = [{"bbox": [[i, 0, 0], [i + 1, 1, 1]], "logic": "0"} for i in range(5)]
        outer = {"md": {"name": "outer"}, "volumes": [{"logic": "0"}, *cells, {"bbox": None}, {"bbox": [[None, 0, 0], [1, 1, 1]]}, {"bbox": [[-1e300, 0, 0], [1, 1, 1]]}]}
        inner = {"volumes": cells[:2]}
        geometry = {"_format": "ORANGE", "universes": [outer, inner, {"md": {"name": "array"}, "_type": "rectarray"}, {"volumes": [{"bbox": None}]}]}
        self.write("geometry.org.json", json.dumps(geometry))
        words = ["compare", "geometry.org.json", "--boxes", "--rays-count", "50"]
        result = self.run_bihive(*words, "--json")
        self.assertIn("4 volumes without a finite box are left out", result.stderr)
        found = json.loads(result.stdout)
        jsonschema.validate(found, schema_of("boxes"))
        self.assertEqual((found["boxes"], found["universe"]), (5, "outer"))
        self.assertEqual(self.succeed_json(*words, "--universe", "1")["boxes"], 2)
        for universe, part in (
            ("otter", "did you mean outer?"), ("9", "it has 4: the first is outer, the last 3"), ("array", 'universe "array" has no volumes'),
            ("3", 'no volume of universe "3" has a finite box'),
        ):
            self.assertIn(part, self.fail_input(*words, "--universe", universe))
        for bbox, part in (
            ([[0, 0, 0]], "[[x, y, z], [x, y, z]]"), ([[0, 0, "a"], [1, 1, 1]], "values other than numbers"),
            ([[0, 2, 0], [1, 1, 1]], 'universe "0", volume 0: its bbox ends before it begins along y'),
        ):
            self.write("bad.json", json.dumps({"universes": [{"volumes": [{"bbox": bbox}]}]}))
            self.assertIn(part, self.fail_input("compare", "bad.json", "--boxes"))
        self.write("bad.json", "{")
        self.assertIn("not valid JSON", self.fail_input("compare", "bad.json", "--boxes"))
        self.write("one.csv", "0,0,0,1,1,1\n")
        self.assertIn("is CSV", self.fail_usage("compare", "one.csv", "--boxes", "--universe", "a"))
        self.assertIn("--boxes", self.fail_usage("compare", "demo", "--universe", "a"))

    def test_selected_spheres(self):
        result = self.compare("demo", "--select", "name CA", "--structures", "bih,brute", "--rays", "points", *FEW)
        self.assertEqual(result["spheres"], 198)
        self.assertTrue(result["same_bits"])
        self.assertEqual(result["structures"][1]["kinds"]["points"]["sphere_tests"]["mean"], 198)


if __name__ == "__main__":
    main()
