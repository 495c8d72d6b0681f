"""The report of `bihive thesis`: interrupted runs, resumed runs, verdicts, and results.json against its schema."""

import contextlib
import html.parser
import json
import os
import shutil
import signal
import subprocess
import threading
import time

import jsonschema
from program import BIHIVE, PATIENCE_S, ProgramTest, main

SOURCE = os.environ["BIHIVE_SOURCE"]


class Rows(html.parser.HTMLParser):
    """Class and text of every row of every table."""

    def __init__(self, text):
        super().__init__()
        self.rows = []
        self.inside = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "tr":
            self.rows.append((dict(attributes).get("class", ""), ""))
            self.inside = True

    def handle_endtag(self, tag):
        self.inside = self.inside and tag != "tr"

    def handle_data(self, data):
        if self.inside:
            self.rows[-1] = (self.rows[-1][0], self.rows[-1][1] + data + " ")


class Report(ProgramTest):
    def report(self, out):
        return self.read(out + "/report.html").decode()

    def results(self, out):
        """results.json, checked against its schema."""
        with open(os.path.join(SOURCE, "docs/results.schema.json")) as file:
            schema = json.load(file)
        jsonschema.Draft7Validator.check_schema(schema)
        results = json.loads(self.read(out + "/results.json"))
        jsonschema.Draft7Validator(schema).validate(results)
        for experiment in results["experiments"]:
            for table in experiment["tables"]:
                for row in table["rows"]:
                    self.assertEqual(len(row), len(table["columns"]), table["title"])
            for illustration in experiment["illustrations"]:
                self.assertTrue(os.path.isfile(self.path(out + "/" + illustration["file"])), illustration)
        return results

    def test_pictures_that_were_removed_are_made_again(self):
        self.assertEqual(self.run_bihive("thesis", "figure-4.1", "--quick", "--out", "r").returncode, 0)
        shutil.rmtree(self.path("r/figure-4.1"))
        self.assertEqual(self.run_bihive("thesis", "figure-4.1", "--quick", "--out", "r").returncode, 0)
        self.results("r")  # looks for every picture
        self.assertIn("data:image/png", self.report("r"))

    def test_only_what_is_asked_for_is_run(self):
        self.assertEqual(self.run_bihive("thesis", "figure-4.1", "--quick", "--out", "r").returncode, 0)
        os.remove(self.path("r/steps/figure-4.1/scenario2.json"))
        done = self.run_bihive("thesis", "figure-4.3", "--quick", "--out", "r")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"figure-4\.1 +1 steps missing")
        self.assertFalse(os.path.exists(self.path("r/steps/figure-4.1/scenario2.json")))

    def step_files(self, out, experiment):
        """Name of each finished step, with the time of its file."""
        folder = self.path(out + "/steps/" + experiment)
        if not os.path.isdir(folder):
            return {}
        files = [name for name in os.listdir(folder) if name.endswith(".json")]
        return {name[: -len(".json")]: os.stat(os.path.join(folder, name)).st_mtime_ns for name in files}

    def test_an_interrupted_run_says_what_is_missing_and_goes_on(self):
        command = ["thesis", "figure-4.4", "--quick", "--out", "out"]
        # On a busy machine a run can be over before this script has seen its second step.
        for _ in range(10):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            process = subprocess.Popen([BIHIVE, *command], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            while len(self.step_files("out", "figure-4.4")) < 2 and process.poll() is None:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=PATIENCE_S)
            if process.returncode != 0:
                break
        self.assertEqual((said, process.returncode), (("", ""), 130))

        # The report shows the finished steps and names the missing ones.
        done = self.step_files("out", "figure-4.4")
        results = self.results("out")
        (experiment,) = results["experiments"]
        missing = experiment["missing_steps"]
        self.assertFalse(results["complete"])
        self.assertGreaterEqual(len(missing), 1)
        self.assertEqual(set(missing) & set(done), set())
        report = self.report("out")
        self.assertIn('class="banner"', report)
        for step in missing:
            self.assertIn(step, report)
        self.assertGreaterEqual(len(experiment["tables"]), 1)

        # The same command runs the missing steps, and nothing else.
        self.succeed(*command)
        after = self.step_files("out", "figure-4.4")
        self.assertEqual(set(after), set(done) | set(missing))
        self.assertEqual({step: after[step] for step in done}, done)
        results = self.results("out")
        self.assertTrue(results["complete"])
        self.assertEqual(results["experiments"][0]["missing_steps"], [])
        self.assertNotIn('class="banner"', self.report("out"))

        # When everything is done it runs nothing.
        self.succeed(*command)
        self.assertEqual(self.step_files("out", "figure-4.4"), after)

    def test_a_changed_value_turns_its_row_red(self):
        experiment, name = "table-4.2", "scenario1.max_prims1.inner_nodes"
        shutil.copytree(os.path.join(SOURCE, "thesis"), self.path("values"))
        changed = "values/" + experiment + "/values.json"
        document = json.loads(self.read(changed))
        before = document["values"][name]["printed"]
        document["values"][name] = {"value": 4321987, "kind": "stated", "sentence": "changed"}
        self.write(changed, json.dumps(document))

        self.succeed("thesis", experiment, "--quick", "--out", "as_it_is")
        self.succeed("thesis", experiment, "--quick", "--out", "changed", "--values", "values")
        green, red = [
            [row for row in Rows(self.report(out)).rows if row[1].startswith("Inner nodes") and value in row[1]]
            for out, value in [("as_it_is", before), ("changed", "4321987")]
        ]
        self.assertEqual([row[0] for row in green], ["agrees"])
        self.assertEqual([row[0] for row in red], ["differs"])
        # Counted in the scenario's own table, because verdicts on times in other tables vary from run to run.
        counts = []
        for out in ("as_it_is", "changed"):
            rows = self.results(out)["experiments"][0]["tables"][0]["rows"]
            verdicts = [cell["verdict"] for row in rows for cell in row]
            counts.append({verdict: verdicts.count(verdict) for verdict in ("agrees", "differs")})
        self.assertEqual(counts[1]["differs"], counts[0]["differs"] + 1)
        self.assertEqual(counts[1]["agrees"], counts[0]["agrees"] - 1)

    def test_a_claim_shows_the_finding_that_decides(self):
        """What the text states weighs more than what we infer, whichever comes first."""
        shutil.copytree(os.path.join(SOURCE, "thesis"), self.path("values"))
        changed = "values/figure-4.1/values.json"
        document = json.loads(self.read(changed))
        document["values"]["camera.look_at"]["value"] = [0, 0, 77]
        document["values"]["light.position"]["value"] = [0, 41, 0]
        for name in ["camera.look_at", "light.position"]:
            document["values"][name].pop("printed", None)
        self.write(changed, json.dumps(document))
        self.succeed("thesis", "figure-4.1", "--quick", "--out", "out", "--values", "values")
        (claim,) = [each for each in self.results("out")["verdicts"] if each["claim"].startswith("Camera, light and plane")]
        self.assertEqual(claim["verdict"], "contradicted")
        self.assertIn("41", claim["found"])
        self.assertNotIn("77", claim["found"])

    def test_text_of_the_values_is_text(self):
        # Sentences come from a file: none of them may become part of the page's code.
        shutil.copytree(os.path.join(SOURCE, "thesis"), self.path("values"))
        changed = "values/figure-4.4/values.json"
        document = json.loads(self.read(changed))
        for value in document["values"].values():
            value["sentence"] = "<script>alert(1)</script> & \"'"
        one = {"kind": "stated", "sentence": "one"}
        document["values"].update({"scenarios": {"value": [1], **one}, "spheres_list": {"value": [64], **one}})
        self.write(changed, json.dumps(document))
        self.succeed("thesis", "figure-4.4", "--quick", "--out", "out", "--values", "values")
        report = self.report("out")
        self.assertNotIn("<script", report)
        self.assertIn("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;&#39;", report)
        self.results("out")

    def test_the_page_needs_nothing_from_outside(self):
        self.succeed("thesis", "figure-4.4", "--quick", "--out", "out", "--values", self.small_values())
        report = self.report("out")
        for word in ["http://", "https://", "<script", "<link rel=\"stylesheet", "@import", "url("]:
            outside = report.replace('xmlns="http://www.w3.org/2000/svg"', "")
            self.assertNotIn(word, outside)

    def test_it_says_on_which_machine_and_how_it_was_made(self):
        self.succeed("thesis", "figure-4.5", "--quick", "--seed", "3", "--out", "out")
        results, report = self.results("out"), self.report("out")
        self.assertEqual(results["command"], "bihive thesis figure-4.5 --out out --quick --seed 3")
        self.assertRegex(results["compiler"], r"^(gcc|clang) \d+.*; vectors: \w+$")
        for text in [results["command"], results["compiler"], results["machine"]]:
            self.assertIn(text.replace("&", "&amp;"), report)
        self.assertIn("Efficient Ray Tracing for Mobile Devices", report)
        self.assertNotIn("as in the thesis", report)
        self.succeed("thesis", "figure-4.5", "--quick", "--out", "a user's out")
        self.assertEqual(self.results("a user's out")["command"], r"bihive thesis figure-4.5 --out 'a user'\''s out' --quick")

    def with_load(self, others):
        """A report whose steps were measured beside so much other work."""
        for name in self.step_files("out", "table-4.2"):
            path = "out/steps/table-4.2/" + name + ".json"
            step = json.loads(self.read(path))
            step["load"] = {"seconds": 10, "others": others, "known": True, "most_others": others}
            self.write(path, json.dumps(step))
        self.succeed("thesis", "table-4.2", "--quick", "--out", "out")
        return self.results("out"), self.report("out")

    def test_a_busy_machine_is_told_at_the_top(self):
        self.succeed("thesis", "table-4.2", "--quick", "--out", "out")
        idle, report = self.with_load(0.01)
        self.assertEqual((idle["load"]["busy"], 'class="banner busy"' in report), (False, False))
        busy, report = self.with_load(0.5)
        self.assertEqual((busy["load"]["busy"], busy["load"]["others"]), (True, 0.5))
        self.assertLess(report.index('class="banner busy"'), report.index("<nav"))

    def test_damaged_steps_are_run_again(self):
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out")
        whole = self.step_files("out", "figure-4.2")
        for i, name in enumerate(whole):
            path = "out/steps/figure-4.2/" + name + ".json"
            step = json.loads(self.read(path))
            step["load"] = [{"seconds": "1"}, {}, None, 1][i % 4]
            self.write(path, json.dumps(step))
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out")
        for name in whole:
            self.assertIsInstance(json.loads(self.read("out/steps/figure-4.2/" + name + ".json"))["load"]["seconds"], float)

    def test_an_older_run_beside_a_new_one(self):
        run = ["thesis", "section-d", "figure-4.5", "--quick", "--out"]
        self.succeed(*run, "old")
        self.succeed(*run, "new", "--against", "old/results.json")
        untimed = lambda results: [each for each in results["against"] if not self.finding(results, each)["timed"]]
        self.assertEqual(untimed(self.results("new")), [])
        self.assertIn("Beside an older run", self.report("new"))

        # Another verdict, another value, and a finding that is gone, as if the older run had had them.
        older = json.loads(self.read("old/results.json"))
        findings = {finding["name"]: finding for finding in older["experiments"][1]["findings"]}
        findings["depth3.leaves"]["verdict"] = "differs"
        findings["depth3.depth"]["ours"] = "17"
        older["experiments"][0]["findings"].pop()
        self.write("old/results.json", json.dumps(older))
        self.succeed(*run, "new", "--against", "old/results.json")
        changed = {each["name"]: (each["changed"], each["then"], each["now"]) for each in untimed(self.results("new"))}
        self.assertEqual(
            changed,
            {"depth3.leaves": ("verdict", "differs", "agrees"), "depth3.depth": ("value", "agrees", "agrees")},
        )
        self.assertIn("1 are new", self.report("new"))

    def finding(self, results, wanted):
        (found,) = [
            finding
            for experiment in results["experiments"]
            for finding in experiment["findings"]
            if (experiment["id"], finding["name"]) == (wanted["experiment"], wanted["name"])
        ]
        return found

    def test_runs_of_other_devices_stand_beside_the_phone(self):
        run = {"experiment": "figure-4.4", "engine": "gpu", "device": "a <phone>", "width_px": 284, "height_px": 160, "quick": True, "rounds": 2, "complete": True, "configurations": []}
        for scenario in (1, 2, 3):
            for spheres in (64, 128, 256):
                for max_prims, ms in [(None, 1000.0), (1, 200.0), (8, 100.0)]:
                    run["configurations"].append({"scenario": scenario, "spheres": spheres, "max_prims": max_prims, "fps": 1000 / ms, "frame_ms": [ms, ms * 1.1]})
        self.write("one.json", json.dumps(run))
        run["device"], run["configurations"] = "another", run["configurations"][:3]
        self.write("two.json", json.dumps({**run, "complete": False}))
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out", "--device", "one.json", "--device", "two.json")
        devices, report = self.results("out")["devices"], self.report("out")
        self.assertEqual([each["device"] for each in devices], ["a <phone>", "another"])
        self.assertEqual([each["configurations"] for each in devices], [9, 1])
        self.assertAlmostEqual(devices[0]["drift"], 1.1)
        self.assertAlmostEqual(devices[0]["best_fps"], 1000 / 105)
        self.assertIn("a &lt;phone&gt;", report)
        self.assertIn("iPhone 5s, stated by the text", report)
        self.assertIn("900 to 900 %, mean 900", report)
        run["configurations"][0]["frame_ms"] = [0]
        self.write("bad.json", json.dumps(run))
        self.write("worse.json", "[1]")
        del run["configurations"][0]
        run["configurations"][0]["max_prims"] = 0
        self.write("zero.json", json.dumps(run))
        for file in ("bad.json", "worse.json", "zero.json", "none.json"):
            self.assertIn(file + ": ", self.fail_input("thesis", "figure-4.2", "--quick", "--out", "bad", "--device", file))
        self.assertFalse(os.path.exists(self.path("bad")))

    def test_frames_on_a_screen_have_a_part_of_their_own(self):
        configurations = [
            {"scenario": scenario, "spheres": spheres, "max_prims": max_prims, "turning": turning,
             "frames": frames, "seconds": 2.0, "fps": frames / 2}
            for scenario in (1, 2, 3) for spheres in (64, 128, 256)
            for max_prims, frames in [(None, 240), (8, 55)] for turning in (False, True)
        ]
        shown = {"experiment": "shown-frames", "by": "window", "device": "a <screen>", "width_px": 1136, "height_px": 640,
                 "seconds": 2.0, "threads": 2, "complete": True, "configurations": configurations}
        self.write("shown.json", json.dumps(shown))
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out", "--device", "shown.json")
        results, report = self.results("out"), self.report("out")
        self.assertNotIn("devices", results)
        self.assertEqual(
            [(each["by"], each["engine"], each["turning"], len(each["rates"])) for each in results["shown_frames"]],
            [("window", "wide", False, 9), ("window", "wide", True, 9), ("window", "BIH 8", False, 9), ("window", "BIH 8", True, 9)],
        )
        self.assertEqual({rate["fps"] for rate in results["shown_frames"][2]["rates"]}, {27.5})
        self.assertIn("a &lt;screen&gt;", report)
        self.assertIn("Frames on a screen", report)
        self.assertIn("27.5", report)
        for name, value in [("frames", 0), ("seconds", 0), ("turning", 3)]:
            wrong = [{**configurations[0], name: value}]
            self.write("bad.json", json.dumps({**shown, "configurations": wrong}))
            self.assertIn("bad.json: ", self.fail_input("thesis", "figure-4.2", "--quick", "--out", "bad", "--device", "bad.json"))

    def test_an_older_run_that_is_none(self):
        self.write("bad.json", "{}")
        self.write("text.json", '{"bihive_results": "2", "experiments": []}')
        self.write("worse.json", '{"bihive_results": 2, "experiments": [{"id": "a", "findings": [{"name": 1}]}]}')
        wrong = "it is not as docs/results.schema.json says"
        cases = [("bad.json", "expected results.json of bihive thesis"), ("text.json", "expected results.json of bihive thesis"),
                 ("worse.json", wrong), ("none.json", "")]
        for i, document in enumerate([{"experiments": None}, {"experiments": 3}, {"experiments": [1]},
                                      {"experiments": [{"id": "a", "findings": None}]},
                                      {"experiments": [{"id": "a", "findings": [{"name": "b", "ours": 1, "verdict": "agrees"}]}]},
                                      {"experiments": [], "version": 1}, {"experiments": [], "date": None}]):
            self.write(f"{i}.json", json.dumps({"bihive_results": 2, **document}))
            cases.append((f"{i}.json", wrong))
        for file, words in cases:
            error = self.fail_input("thesis", "figure-4.2", "--quick", "--out", "out", "--against", file)
            self.assertIn(file + ": ", error)
            self.assertIn(words, error)
        self.assertFalse(os.path.exists(self.path("out")))

    def test_older_runs_are_read_once_and_first(self):
        """A pipe gives its bytes once; and a run may replace the file that it is compared with."""
        run = ["thesis", "figure-4.2", "--quick", "--out", "out"]
        self.succeed(*run)
        older = self.read("out/results.json")
        read, write = os.pipe()

        def feed():
            with contextlib.suppress(BrokenPipeError), os.fdopen(write, "wb") as pipe:
                pipe.write(older)

        writer = threading.Thread(target=feed)
        writer.start()
        done = self.run_bihive(*run, "--against", f"/dev/fd/{read}", pass_fds=[read])
        os.close(read)
        writer.join()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("Beside an older run", self.report("out"))
        self.assertIn("0 of the older run were not looked at", self.report("out"))

    def test_every_claim_is_decided_by_findings_that_exist(self):
        with open(os.path.join(SOURCE, "thesis/report/claims.json")) as file:
            claims = json.load(file)["claims"]
        os.environ["BIHIVE_EGL"], before = "/nowhere", os.environ.get("BIHIVE_EGL")
        try:
            self.succeed("thesis", "all", "--quick", "--out", "out")
        finally:
            del os.environ["BIHIVE_EGL"]
            if before is not None:
                os.environ["BIHIVE_EGL"] = before
        results = self.results("out")
        names = {experiment["id"]: [finding["name"] for finding in experiment["findings"]] for experiment in results["experiments"]}
        for experiment, all_names in names.items():
            self.assertEqual(len(set(all_names)), len(all_names), experiment)
        for claim in claims:
            for pattern in claim["findings"]:
                found = [
                    name for name in names[claim["experiment"]]
                    if (name.startswith(pattern[:-1]) if pattern.endswith("*") else name == pattern)
                ]
                self.assertNotEqual(found, [], (claim["claim"], pattern))
        self.assertEqual(len(results["verdicts"]), len(claims))
        verdicts = {each["claim"]: each["verdict"] for each in results["verdicts"]}
        self.assertNotIn("not_run", verdicts.values())
        for claim in claims:
            if verdicts[claim["claim"]] in ("contradicted", "not_inferred", "text_inconsistent"):
                self.assertIn("reason" if "reason" in claim else "note", claim)
            self.assertEqual(verdicts[claim["claim"]] == "value_lost", claim.get("lost", False), claim["claim"])
        for words, verdict in [
            ("Table 4.2, Scenario 1: every row", "reproduced"),
            ("(b) has four leaves with 16 primitives each", "reproduced"),
            ("The first three images had MAX_PRIMS equal to infinity", "text_inconsistent"),
            ("It gives each primitive a leaf of its own", "text_inconsistent"),
            ("A larger MAX_PRIMS needs less memory", "inferred"),
            ("A leaf for each primitive considerably increases performance", "shape_only"),
            ("The tree becomes shallower with a larger MAX_PRIMS", "reproduced"),
            ("At recursion depth 1 the transparent sphere is dark grey", "inferred"),
            ("Large spheres in such a small space could lead to overlaps", "inferred"),
            ("Overlaps could make a wrong tree", "own_check"),
            ("In Scenario 1 nodes overlap more, since many primitives lie in a small volume", "not_inferred"),
        ]:
            self.assertEqual(verdicts[words], verdict, words)
        report = self.report("out")
        self.assertLess(report.index('id="verdicts"'), report.index('id="figure-4.1"'))

        # Only what the text states and what agrees with it is green.
        for experiment in results["experiments"]:
            green = sum(
                cell["verdict"] == "agrees" and cell["kind"] == "stated"
                for table in experiment["tables"] for row in table["rows"] for cell in row if "kind" in cell
            )
            self.assertEqual(green, experiment["counts"]["stated"]["agrees"], experiment["id"])
        self.assertEqual(results["experiments"][5]["counts"]["stated"], {"agrees": 1, "differs": 0, "undecided": 0})

    def small_values(self):
        """A folder of stated values with one configuration of Figure 4.4."""
        with open(os.path.join(SOURCE, "thesis/figure-4.4/values.json")) as file:
            document = json.load(file)
        document["values"]["scenarios"]["value"] = [2]
        document["values"]["spheres_list"]["value"] = [64]
        os.makedirs(self.path("small/figure-4.4"))
        self.write("small/figure-4.4/values.json", json.dumps(document))
        return "small"


if __name__ == "__main__":
    main()
