"""bihive compare: the same bits from all structures, counts that do not depend on threads, the JSON's schema, the report."""

import html.parser
import json
import os

import jsonschema
from program import ProgramTest, main

SOURCE = os.environ.get("BIHIVE_SOURCE", os.path.join(os.path.dirname(__file__), "../.."))
STRUCTURES = "wide bih bvh-sah bvh-lbvh grid pkd brute".split()
KINDS = "primary random shadow mirror ao points".split()
FEW = ["--rays-count", "512"]


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


class Compare(ProgramTest):
    def compare(self, *words):
        result = self.succeed_json("compare", *words)
        with open(os.path.join(SOURCE, "docs/comparison.schema.json")) as file:
            schema = json.load(file)
        jsonschema.Draft7Validator.check_schema(schema)
        jsonschema.Draft7Validator(schema).validate(result)
        return result

    def test_all_structures_and_kinds(self):
        result = self.compare("demo", *FEW)
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
                self.assertGreater(one["mray_per_s"][kind], 0)
                self.assertGreaterEqual(steps["sphere_tests"]["99_percent"], 1)
                self.assertAlmostEqual(steps["cost"], steps["nodes"]["mean"] + steps["sphere_tests"]["mean"])
            if one["name"] != "brute":
                self.assertGreaterEqual(one["references"], result["spheres"] if one["name"] != "wide" else 1)
                self.assertLess(one["kinds"]["random"]["cost"], result["spheres"] / 4)
        brute = result["structures"][-1]
        self.assertEqual(brute["kinds"]["random"]["sphere_tests"], {"mean": result["spheres"], "99_percent": result["spheres"]})
        self.assertEqual((brute["nodes"], brute["bytes"]), (0, 0))

    def test_counts_depend_on_the_spheres_alone(self):
        def counts(*words):
            result = self.compare("scenario2", "--count", "500", "--radius", "0.3", "--rays", "random,ao,points", *FEW, *words)
            return [(one["name"], one["kinds"], one["expected"], one["bytes"]) for one in result["structures"]], result["threads"]

        one, two = counts(), counts("--threads", "2")
        self.assertEqual(one[0], two[0])
        self.assertEqual((one[1], two[1]), (1, 2))

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
        self.assertEqual((result["queries"]["shadow"], result["structures"][0]["mray_per_s"]["shadow"]), (0, None))
        self.assertIsNone(result["structures"][0]["expected"]["cost"])
        self.assertIn("no primary ray leads to one", self.succeed("compare", "points.csv", *FEW, "--rays", "shadow"))

    def test_text(self):
        text = self.succeed("compare", "demo", *FEW, "--rays", "random,ao")
        lines = text.splitlines()
        self.assertIn("spheres, 1 thread, ", lines[0])
        self.assertRegex(lines[1], r"is the fastest|the only")
        for name in STRUCTURES:
            self.assertEqual(sum(line.startswith(name + " ") for line in lines[2:]), 3, name)
        self.assertIn("random: 512 rays", text)
        self.assertEqual(lines[-1], "Every answer has the bits of the reference BIH.")

    def test_report(self):
        self.write("<b>&.xyz", "2\n\nC 1 2 3\nO 2 2 3\n")
        self.succeed("compare", "<b>&.xyz", *FEW, "-o", "report.html")
        page = Page(self.read("report.html").decode())
        text = " ".join(page.words)
        self.assertIn("Structures for <b>&.xyz", text)
        self.assertNotIn("b", page.tags)
        self.assertNotIn("script", page.tags)
        self.assertEqual(page.links, ["data:,"])
        self.assertIn("Every structure gave the same answers, bit for bit.", text)
        self.assertNotIn("{{", text)
        for name in STRUCTURES:
            self.assertIn(name, text)
        done = self.run_bihive("compare", "<b>&.xyz", *FEW, "--rays", "random", "-o", "-")
        self.assertEqual(done.returncode, 0)
        self.assertTrue(done.stdout.startswith("<!DOCTYPE html>"))
        self.assertIn("Every answer has the bits", done.stderr)

    def test_refusals(self):
        for words, part in (
            (["--structures", "wide,octopus"], "there is no structure \"octopus\"; there are wide, bih"),
            (["--structures", "bih,bih"], "bih stands twice"),
            (["--structures", ""], "there is no structure \"\""),
            (["--rays", "x-rays"], "there are no rays \"x-rays\"; there are primary"),
            (["--rays-count", "0"], "--rays-count"),
            (["--json", "-o", "-"], "--json and a report on -"),
        ):
            self.assertIn(part, self.fail_usage("compare", "demo", *words))
        self.assertIn("stored spheres", self.fail_usage("compare", "demo", "--replicate", "2x2x2"))


if __name__ == "__main__":
    main()
