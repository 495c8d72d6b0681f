"""Figure 4.4 at small size: its tables and charts show the measurements, and its verdicts follow their rules."""

import json
import os
import re
import statistics

from program import ProgramTest, main

SOURCE = os.environ["BIHIVE_SOURCE"]
SCENARIOS, COUNTS, TREES = [2, 3], [64, 100], [1, 8]


class Figure44(ProgramTest):
    def measure(self, **changes):
        """The experiment of a quick run with fewer configurations, and some of its stated values changed."""
        with open(os.path.join(SOURCE, "thesis/figure-4.4/values.json")) as file:
            document = json.load(file)
        values = {"scenarios": SCENARIOS, "spheres_list": COUNTS, "max_prims_list": TREES, **changes}
        for name, value in values.items():
            document["values"][name]["value"] = value
        os.makedirs(self.path("values/figure-4.4"), exist_ok=True)
        self.write("values/figure-4.4/values.json", json.dumps(document))
        results = self.succeed_json("thesis", "figure-4.4", "--quick", "--out", "out", "--values", "values")
        (experiment,) = results["experiments"]
        return experiment

    def test_without_egl_it_says_so(self):
        os.environ["BIHIVE_EGL"], before = "/nowhere", os.environ.get("BIHIVE_EGL")
        try:
            experiment = self.measure(scenarios=[2], spheres_list=[64], max_prims_list=[1])
        finally:
            del os.environ["BIHIVE_EGL"]
            if before is not None:
                os.environ["BIHIVE_EGL"] = before
        self.assertEqual(experiment["missing_steps"], [])
        self.assertIn("The engine gpu was not measured: the graphics processor cannot be used: there is no EGL (/nowhere).",
                      experiment["paragraphs"])
        self.assertEqual([table for table in experiment["tables"] if "gpu" in table["title"]], [])
        self.assertEqual(len(experiment["data"]["wide"]["configurations"]), 1)

    def rows(self, experiment, title, engine="reference"):
        """First cell -> the other cells of a row."""
        of_engine = [table for table in experiment["tables"] if table["title"].endswith(f"(engine {engine})")]
        (table,) = [table for table in of_engine if table["title"].startswith(title)]
        return {row[0]["text"]: row[1:] for row in table["rows"]}

    def test_it_says_what_was_measured(self):
        experiment = self.measure(**{"winner.configurations": 4, "only_rises.spheres": 100})
        measured = experiment["data"]["reference"]
        fps = {}
        for each in measured["configurations"]:
            ms = each["frame_ms"]["frame_ms"]
            self.assertEqual(list(ms), ["brute", "max_prims1", "max_prims8"])
            fps[each["scenario"], each["spheres"]] = [1000 / statistics.median(times) for times in ms.values()]
        self.assertEqual(set(fps), {(scenario, count) for scenario in SCENARIOS for count in COUNTS})

        # A tree is faster than brute force, and the gain is that of the best tree.
        gains = {key: 100 * (max(trees) / brute - 1) for key, (brute, *trees) in fps.items()}
        for each in measured["configurations"]:
            gain = gains[each["scenario"], each["spheres"]]
            self.assertGreater(gain, 0)
            self.assertAlmostEqual(each["gain_percent"], gain, delta=1e-6 * gain)

        # Gains agree within a factor of two of the speed-up.
        table = self.rows(experiment, "Gains")
        stated = experiment["stated"]
        for name, what, choose in [("best", "most", max), ("least", "least", min)]:
            gain = choose(gains[2, count] for count in COUNTS)
            thesis, ours = table["Scenario 2, " + what]
            self.assertEqual(ours["text"], f"{gain:+.0f} %")
            ratio = (1 + gain / 100) / (1 + stated["scenario2.gain_percent." + name]["value"] / 100)
            self.assertEqual(ours["verdict"], "agrees" if 0.5 <= ratio <= 2 else "differs")
            self.assertEqual(thesis["text"], stated["scenario2.gain_percent." + name]["printed"])

        # Wins are counted.
        wins = sum(trees[1] > trees[0] for _, *trees in fps.values())
        ours = self.rows(experiment, "Which")["BIH 8 is the best"][1]
        self.assertEqual((ours["text"], ours["verdict"]), (f"in {wins} of 4", "differs"))

        # The shape of each curve; changes below three percent do not count.
        for (scenario, count), (_, first, last) in fps.items():
            shape = "only rises" if last > 1.03 * first else "only falls" if first > 1.03 * last else "up and down, or flat"
            thesis, ours = self.rows(experiment, "The curve")[f"Scenario {scenario}, {count} spheres"][:2]
            self.assertEqual(ours["text"], shape)
            self.assertEqual(thesis["text"], "only rises" if (scenario, count) == (2, 100) else "rises, peaks, falls")
            self.assertEqual(ours["verdict"], "agrees" if shape == thesis["text"] else "differs")

        # Brute force by scenario.
        for count, cells in self.rows(experiment, "Brute force").items():
            times = measured["brute_force_by_scenario"]["spheres" + count]["frame_ms"]
            best = [min(each) for each in times.values()]
            self.assertEqual(cells[2]["text"], f"{max(best) / min(best):.3f}")
            self.assertEqual(cells[2]["verdict"], "agrees" if max(best) <= 1.1 * min(best) else "differs")

        # The wide engine has its own numbers of the same form.
        wide = experiment["data"]["wide"]
        self.assertEqual(wide.keys(), measured.keys())
        self.assertEqual(len(wide["configurations"]), len(fps))
        self.assertEqual(self.rows(experiment, "Frames", "wide").keys(), self.rows(experiment, "Frames").keys())

        # The graphics processor has them too, if there is one; the report names it.
        if "BIHIVE_EGL" not in os.environ:
            gpu = experiment["data"]["gpu"]
            self.assertEqual(gpu.keys(), measured.keys())
            self.assertEqual(len(gpu["configurations"]), len(fps))
            self.assertEqual(self.rows(experiment, "Frames", "gpu").keys(), self.rows(experiment, "Frames").keys())
            name = gpu["configurations"][0]["frame_ms"]["gpu"]
            self.assertIn("OpenGL ES 3", name)
            self.assertIn(name, experiment["paragraphs"][-1])

        # Bars: brute force and each tree for each count. Lines: each tree for each count.
        for scenario in SCENARIOS:
            for name, marks in [("", 3 * len(COUNTS)), ("-max_prims", 2 * len(COUNTS))]:
                svg = self.read(f"out/figure-4.4/reference-scenario{scenario}{name}.svg").decode()
                self.assertEqual(len(re.findall(r'class="mark', svg)), marks)
        self.assertIn(f"<title>BF, 64: {float(f'{fps[3, 64][0]:.4g}'):g}</title>", svg_of(self, 3))

    def test_verdicts_follow_the_stated_values(self):
        # With a stated best gain of a thousand times its value, and brute force stated to depend on the scenario.
        experiment = self.measure(**{"scenario2.gain_percent.best": 1495000, "brute.dependence_on_scenario": 1})
        self.assertEqual(self.rows(experiment, "Gains")["Scenario 2, most"][1]["verdict"], "differs")
        times = experiment["data"]["reference"]["brute_force_by_scenario"]
        for count, cells in self.rows(experiment, "Brute force").items():
            best = [min(each) for each in times["spheres" + count]["frame_ms"].values()]
            self.assertEqual(cells[2]["verdict"], "agrees" if max(best) > 1.1 * min(best) else "differs")


def svg_of(test, scenario):
    return test.read(f"out/figure-4.4/reference-scenario{scenario}.svg").decode()


if __name__ == "__main__":
    main()
