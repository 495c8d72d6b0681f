"""The report of `bihive thesis`: interrupted runs, resumed runs, verdicts, and results.json against its schema."""

import html.parser
import json
import os
import shutil
import signal
import subprocess
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
        document["values"][name] = {"value": 4321987, "sentence": "changed"}
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

    def test_text_of_the_values_is_text(self):
        # Sentences come from a file: none of them may become part of the page's code.
        shutil.copytree(os.path.join(SOURCE, "thesis"), self.path("values"))
        changed = "values/figure-4.4/values.json"
        document = json.loads(self.read(changed))
        for value in document["values"].values():
            value["sentence"] = "<script>alert(1)</script> & \"'"
        document["values"].update({"scenarios": {"value": [1], "sentence": "one"}, "spheres_list": {"value": [64], "sentence": "one"}})
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
