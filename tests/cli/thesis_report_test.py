"""The report of `bihive thesis`: interrupted runs, resumed runs, verdicts, and results.json against its schema."""

# ctest: COST 700

import json
import os
import re
import shutil
import signal
import subprocess
import time

import jsonschema
from program import BIHIVE, PATIENCE_S, ProgramTest, main

SOURCE = os.environ["BIHIVE_SOURCE"]


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
        return results

    def test_pictures_that_were_removed_are_made_again(self):
        self.assertEqual(self.run_bihive("thesis", "figure-4.1", "--quick", "--out", "r").returncode, 0)
        shutil.rmtree(self.path("r/figure-4.1"))
        self.assertEqual(self.run_bihive("thesis", "figure-4.1", "--quick", "--out", "r").returncode, 0)
        self.assertEqual(self.report("r").count("data:image/png"), 6)  # three, and on the first page again
        self.assertNotIn("has not been made yet", self.report("r"))

    def test_only_what_is_asked_for_is_run(self):
        self.assertEqual(self.run_bihive("thesis", "figure-4.1", "--quick", "--out", "r").returncode, 0)
        os.remove(self.path("r/steps/figure-4.1/scenario2.json"))
        done = self.run_bihive("thesis", "figure-4.3", "--quick", "--out", "r")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"figure-4\.1: 1 steps missing")
        self.assertFalse(os.path.exists(self.path("r/steps/figure-4.1/scenario2.json")))

    def step_files(self, out, experiment):
        """Name of each finished step, with the time of its file."""
        folder = self.path(out + "/steps/" + experiment)
        if not os.path.isdir(folder):
            return {}
        files = [name for name in os.listdir(folder) if name.endswith(".json")]
        return {name[: -len(".json")]: os.stat(os.path.join(folder, name)).st_mtime_ns for name in files}

    def test_an_interrupted_run_says_what_is_missing_and_goes_on(self):
        command = ["thesis", "table-4.2", "--quick", "--out", "out"]
        # On a busy machine a run can be over before this script has seen its second step.
        for _ in range(10):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            process = subprocess.Popen([BIHIVE, *command], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            while len(self.step_files("out", "table-4.2")) < 2 and process.poll() is None:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=PATIENCE_S)
            if process.returncode != 0:
                break
        self.assertEqual((said, process.returncode), (("", ""), 130))

        # The report shows the finished steps and names the missing ones.
        done = self.step_files("out", "table-4.2")
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

        # The same command runs the missing steps, and nothing else.
        self.succeed(*command)
        after = self.step_files("out", "table-4.2")
        self.assertEqual(set(after), set(done) | set(missing))
        self.assertEqual({step: after[step] for step in done}, done)
        results = self.results("out")
        self.assertTrue(results["complete"])
        self.assertEqual(results["experiments"][0]["missing_steps"], [])
        self.assertNotIn('class="banner"', self.report("out"))

        # When everything is done it runs nothing.
        self.succeed(*command)
        self.assertEqual(self.step_files("out", "table-4.2"), after)

    def test_a_claim_shows_its_worst_finding(self):
        shutil.copytree(os.path.join(SOURCE, "thesis"), self.path("values"))
        changed = "values/figure-4.1/values.json"
        document = json.loads(self.read(changed))
        document["values"]["light.position"]["value"] = [0, 41, 0]
        self.write(changed, json.dumps(document))
        words = ("thesis", "figure-4.1", "--quick", "--out")
        for out, options, verdict, style in [("as_it_is", [], "set_agrees", "set"), ("changed", ["--values", "values"], "set_differs", "differs")]:
            self.succeed(*words, out, *options)
            (claim,) = [each for each in self.results(out)["claims"] if each["claim"].startswith("Camera, light and plane")]
            self.assertEqual(claim["verdict"], verdict)
            row = re.search(r'<tr class="(\w+)"><th scope="row">Camera, light and plane', self.report(out))
            self.assertEqual(row[1], style)
        self.assertIn("5 of 6", claim["found"])

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
        self.assertEqual(results["command"], "bihive thesis figure-4.5 --quick --seed 3 --out out")
        self.assertRegex(results["compiler"], r"^(gcc|clang) \d+.*; vectors: \w+$")
        for text in [results["command"], results["compiler"], results["machine"]]:
            self.assertIn(text.replace("&", "&amp;"), report)
        self.assertIn("Efficient Ray Tracing for Mobile Devices", report)
        self.assertNotIn("as in the thesis", report)
        self.succeed("thesis", "figure-4.5", "--quick", "--out", "a user's out")
        self.assertEqual(self.results("a user's out")["command"], r"bihive thesis figure-4.5 --quick --out 'a user'\''s out'")

    def with_load(self, others):
        """A report whose steps were measured beside so much other work."""
        for name in self.step_files("out", "table-4.2"):
            path = "out/steps/table-4.2/" + name + ".json"
            step = json.loads(self.read(path))
            step["others"] = others
            self.write(path, json.dumps(step))
        self.succeed("thesis", "table-4.2", "--quick", "--out", "out")
        return self.results("out"), self.report("out")

    def test_a_busy_machine_is_told_at_the_top(self):
        self.succeed("thesis", "table-4.2", "--quick", "--out", "out")
        idle, report = self.with_load(0.01)
        self.assertEqual((idle["load"]["busy"], 'class="banner busy"' in report), (False, False))
        busy, report = self.with_load(0.5)
        self.assertEqual((busy["load"]["busy"], busy["load"]["most_others"]), (True, 0.5))
        self.assertLess(report.index('class="banner busy"'), report.index("<main"))

    def test_damaged_steps_are_run_again(self):
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out")
        whole = self.step_files("out", "figure-4.2")
        for i, name in enumerate(whole):
            path = "out/steps/figure-4.2/" + name + ".json"
            step = json.loads(self.read(path))
            step["others"] = ["1", {}, None, [1]][i % 4]
            self.write(path, json.dumps(step))
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out")
        for name in whole:
            self.assertIsInstance(json.loads(self.read("out/steps/figure-4.2/" + name + ".json"))["others"], (int, float))

    def test_runs_of_other_devices_stand_beside_the_phone(self):
        run = {"experiment": "figure-4.4", "engine": "gpu", "device": "a <phone>", "width_px": 284, "height_px": 160, "quick": True, "rounds": 2, "complete": True, "configurations": []}
        for scenario in (1, 2, 3):
            for spheres in (64, 128, 256):
                for max_prims, ms in [(None, 1000.0), (1, 200.0), (8, 100.0)]:
                    run["configurations"].append({"scenario": scenario, "spheres": spheres, "max_prims": max_prims, "fps": 1000 / ms, "frame_ms": [ms, ms * 1.1]})
        self.write("one.json", json.dumps(run))
        run["device"], run["configurations"] = "another", run["configurations"][:3]
        costs = {"inner_per_test": 1.3, "inner_per_test_error": 0.1, "leaf_per_inner": 0, "leaf_per_inner_error": 0}
        self.write("two.json", json.dumps({**run, "complete": False, "costs": costs}))
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out", "--device", "one.json", "--device", "two.json")
        devices, report = self.results("out")["devices"], self.report("out")
        self.assertEqual([each["device"] for each in devices], ["a <phone>", "another"])
        self.assertEqual([each["configurations"] for each in devices], [9, 1])
        self.assertAlmostEqual(devices[0]["drift"], 1.1)
        self.assertAlmostEqual(devices[0]["best_fps"], 1000 / 105)
        self.assertEqual((devices[1]["costs"]["inner_words"], devices[1]["costs"]["leaf_words"]), ("1.30 ± 0.10", "0 (at its bound)"))
        self.assertIn("0 (at its bound)", report)
        self.assertIn("a &lt;phone&gt;", report)
        self.assertIn("The text states of its iPhone 5s", " ".join(report.split()))
        self.assertNotIn("No phone was measured", report)
        self.assertIn("Scenario 1: 900 to 900 %, mean 900", report)
        run["configurations"][0]["frame_ms"] = [0]
        self.write("bad.json", json.dumps(run))
        self.write("worse.json", "[1]")
        del run["configurations"][0]
        run["configurations"][0]["max_prims"] = 0
        self.write("zero.json", json.dumps(run))
        for file in ("bad.json", "worse.json", "zero.json", "none.json"):
            self.assertIn(file + ": ", self.fail_input("thesis", "figure-4.2", "--quick", "--out", "bad", "--device", file))
        self.assertFalse(os.path.exists(self.path("bad")))

    def test_the_file_of_a_phone_has_both_engines_their_heat_and_the_screen(self):
        rate = {"scenario": 1, "spheres": 64, "max_prims": None, "fps": 10.0, "frame_ms": [100.0, 120.0]}
        run = {"experiment": "figure-4.4", "device": "a phone", "width_px": 568, "height_px": 320, "quick": False, "rounds": 2,
               "complete": True, "configurations": [rate, {**rate, "max_prims": 8, "fps": 40.0, "frame_ms": [25.0, 25.0]}]}
        passes = [{"engine": engine, "minute": minute, "round_ms": ms * slower}
                  for engine, slower in (("cpu", 1), ("gpu", 0.5)) for minute, ms in ((1, 800), (1, 820), (1, 840), (5, 900), (10, 1000))]
        shown = {"experiment": "shown-frames", "by": "page", "device": "a phone", "width_px": 1136, "height_px": 640,
                 "seconds": 1.0, "threads": 1, "complete": False, "configurations": []}
        phone = {"experiment": "phone", "minutes": 10, "runs": [{**run, "engine": "cpu"}, {**run, "engine": "gpu"}], "passes": passes, "shown": shown}
        self.write("phone.json", json.dumps(phone))
        self.succeed("thesis", "figure-4.2", "--quick", "--out", "out", "--device", "phone.json")
        results = self.results("out")
        self.assertEqual([each["engine"] for each in results["devices"]], ["cpu", "gpu"])
        self.assertEqual(results["devices"][0]["heat"], {"first_minute": 1, "first_ms": 820, "last_minute": 10, "last_ms": 1000})
        self.assertEqual(results["devices"][1]["heat"]["last_ms"], 500)
        # A quarter of the text's picture: a quarter of the rate in its size.
        self.assertAlmostEqual(results["devices"][0]["best_fps"], 40)
        self.assertAlmostEqual(results["devices"][0]["best_fps_scaled"], 10)
        self.assertNotIn("shown_frames", results)
        self.assertIn("minute 1: 820 ms, minute 10: 1000 ms", self.report("out"))
        self.write("bad.json", json.dumps({**phone, "passes": [{"engine": "cpu"}]}))
        self.assertIn("bad.json: ", self.fail_input("thesis", "figure-4.2", "--quick", "--out", "bad", "--device", "bad.json"))

    def test_the_page_for_phones_is_written(self):
        os.mkdir(self.path("page"))
        self.write("page/phone.html", "<!doctype html>")
        done = self.run_bihive("thesis", "--page", "written.html", env={**os.environ, "BIHIVE_PAGE": self.path("page")})
        self.assertEqual((done.returncode, done.stderr, self.read("written.html")), (0, "", b"<!doctype html>"))
        absent = {**os.environ, "BIHIVE_PAGE": self.path("absent")}
        self.assertIn("without the page", self.fail_with(3, "thesis", "--page", "none.html", env=absent))
        self.assertIn("--out", self.fail_usage("thesis", "--page", "a.html", "--out", "out"))
        self.assertIn("--out is required", self.fail_usage("thesis"))

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

    def test_every_claim_is_decided(self):
        os.environ["BIHIVE_EGL"], before = "/nowhere", os.environ.get("BIHIVE_EGL")
        try:
            self.succeed("thesis", "all", "--quick", "--out", "out")
        finally:
            del os.environ["BIHIVE_EGL"]
            if before is not None:
                os.environ["BIHIVE_EGL"] = before
        results = self.results("out")
        wanted = []
        for experiment in results["experiments"]:
            with open(os.path.join(SOURCE, "thesis", experiment["id"], "values.json")) as file:
                document = json.load(file)
            claims = {name: entry for name, entry in document["values"].items() if "claim" in entry}
            # Each entry with a claim has a finding.
            self.assertEqual([finding["name"] for finding in experiment["findings"]], list(claims))
            wanted += [*dict.fromkeys(entry["claim"] for entry in claims.values()), *(remark["claim"] for remark in document.get("remarks", []))]
            for finding in experiment["findings"]:
                entries = [entry for entry in claims.values() if entry["claim"] == finding["claim"]]
                self.assertTrue(finding["verdict"] == "agrees" or any("reason" in e or "note" in e for e in entries), finding)
        self.assertEqual([claim["claim"] for claim in results["claims"]], wanted)
        verdicts = {each["claim"]: each["verdict"] for each in results["claims"]}
        for words, verdict in [
            ("Table 4.2, Scenario 1: every row", "fitted_agrees"),
            ("(a) and (d) are a root alone with all primitives", "stated_agrees"),
            ("(b) has four leaves with 16 primitives each", "fitted_agrees"),
            ("All primitives are visible", "fitted_agrees"),
            ("The best of all is BIH 8 with 64 primitives in Scenario 1", "fitted_differs"),
            ("The first three images had MAX_PRIMS equal to infinity", "stated_text_inconsistent"),
            ("It gives each primitive a leaf of its own", "stated_text_inconsistent"),
            ("BIH 8 is the best in 7 of 9 configurations", "fitted_agrees"),
            ("The materials are those of Table 4.1", "set_agrees"),
            ("Scenario 2 has a great quantity of void in the structure", "inferred_agrees"),
            ("A tree of one leaf is less efficient than brute force, by the test of the global box", "inferred_differs"),
            ("Overlaps could make a wrong tree", "own_check_agrees"),
            ("Figure 4.4: the bars", "value_lost"),
        ]:
            self.assertEqual(verdicts[words], verdict, words)

        # Nothing that the text states of an outcome differs, but for what a clock says of another machine.
        timed = {"Scenario 1 with MAX_PRIMS 8 is built fastest, Scenario 3 with 1 slowest", "Scenario 3 gains most build time from MAX_PRIMS 1 to 8",
                 "A higher MAX_PRIMS makes trees faster to build", "A leaf for each primitive considerably increases performance"}
        self.assertLessEqual({claim for claim, verdict in verdicts.items() if verdict == "stated_differs"}, timed)

        # Nobody has measured a phone: the report says so, and asks for it.
        asked = " ".join(re.sub(r"<[^>]+>", "", self.report("out")).split())
        self.assertIn("No phone was measured for this report, and no graphics processor. bihive thesis --page phone.html", asked)

        # At most 6,000 words in sight; the rest is folded, but for its headings.
        report = re.sub(r"<style>.*?</style>|<svg.*?</svg>", "", self.report("out"), flags=re.S)
        report = re.sub(r"<details>(<summary>.*?</summary>).*?</details>", r"\1", report, flags=re.S)
        words = re.sub(r"<[^>]+>", " ", report).split()
        self.assertLess(len(words), 6000)
        self.assertGreater(len(words), 1500)
        self.assertLess(self.report("out").index("costs.svg" if "costs.svg" in report else "bihive-costs"), self.report("out").index('id="claims"'))

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
