"""Help, version, and every way to call the program wrongly."""

import os
import re
import shlex

from program import ProgramTest, main

COMMANDS = ["render", "stats", "trace", "scene", "info", "select"]


class Help(ProgramTest):
    def test_version_is_one_line(self):
        self.assertRegex(self.succeed("--version"), r"\Abihive \d+\.\d+\.\d+( \([0-9a-f]+(-dirty)?\))?\n\Z")

    def test_help_names_every_command(self):
        text = self.succeed("--help")
        for command in COMMANDS:
            self.assertIn(command, text)

    def test_nothing_asked_is_help_and_exit_code_2(self):
        done = self.run_bihive()
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("Usage: bihive", done.stderr)

    def examples(self, command):
        text = self.succeed(command, "--help")
        self.assertIn(f"Usage: bihive {command} ", text)
        self.assertIn("Examples:\n", text)
        lines = text.split("Examples:\n")[1].strip().splitlines()
        return [line.strip() for line in lines]

    def test_each_command_has_two_examples_that_work(self):
        for command in COMMANDS:
            examples = self.examples(command)
            self.assertEqual(len(examples), 2, command)
            for example in examples:
                words = shlex.split(example)
                self.assertEqual(words[:2], ["bihive", command])
                if command == "trace":
                    continue  # needs rays: trace_test.py
                with self.subTest(example):
                    self.succeed(*words[1:])

    def test_help_says_every_option_of_the_contract(self):
        contract = {
            "render": "-o --size --crop --recursion --view --engine --max-prims --max-depth --threads --samples --shadows "
            "--no-shadows --transfer --background --bits --dpi --eye --look-at --up --fov --projection --turn --zoom --view-from --fit --zoom-to --radius --radius-scale "
            "--recenter --frame --json --count --seed",
            "film": "-o --frames --fps --pictures --hold-first --hold-last --reverse --ping-pong --turntable --turn-axis --follow --align --fit-frames --camera-keys --colour-range --codec --shard --join --size --samples --json",
            "stats": "--max-prims --max-depth --json --count --radius --seed",
            "trace": "--rays --t --id --any --plane --engine --threads --count --radius --seed",
            "scene": "--count --radius --seed -o",
            "info": "--json",
        }
        for command, options in contract.items():
            text = self.succeed(command, "--help-all")
            for option in options.split():
                self.assertRegex(text, r"(?<![\w-])" + re.escape(option) + r"(?![\w-])", command)


    def test_the_short_help_shows_what_people_use(self):
        short, long = self.succeed("render", "--help"), self.succeed("render", "--help-all")
        self.assertLess(len(short.splitlines()), 75)
        self.assertIn("--help-all shows all", short)
        for text in (short, long):
            self.assertIn("--style", text)
        self.assertNotIn("--ao-directions", short)
        self.assertIn("--ao-directions", long)

    def test_a_near_name_is_said(self):
        for word, near in [("--color", "--colour"), ("--colour_by=chain", "--colour-by"), ("--light-point", "--light-points")]:
            self.assertIn(f"did you mean {near}?", self.fail_usage("render", "demo", "-o", "a.png", word))
        self.assertNotIn("did you mean", self.fail_usage("render", "demo", "-o", "a.png", "--zzzzzzzz"))

    def test_what_is_not_drawn(self):
        for command in ("render", "film"):
            for word in ("--cartoon", "--surface", "--mesh", "--ribbons"):
                said = self.fail_usage(command, "demo", "-o", "a.png", word)
                self.assertIn("bihive draws spheres, bonds, arrows and tubes; docs/coming_from.md", said)
        for word, ours in [("--perspective", "--projection perspective"), ("--transparency=0.3", "--opacity"), ("--width", "--size WxH"),
                           ("--licorice", "--style licorice"), ("--tube", "--trace chain"), ("--vectors=vx,vy,vz", "--arrows")]:
            self.assertIn(f"did you mean {ours}", self.fail_usage("render", "demo", "-o", "a.png", word))
        # None of them is an option of ours, and each advice names one.
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "apps/cli/words/foreign_options.h"), encoding="utf-8") as file:
            table = file.read()
        ours = set(re.findall(r"--[a-z-]+", self.succeed("render", "--help-all") + self.succeed("film", "--help-all")))
        rows = re.findall(r'ForeignOption\{((?:\s*"[^"]*")+),\s*"([^"]*)", "([^"]*)"\}', table)
        foreign = {name for names, _, _ in rows for name in re.findall(r"--[a-z-]+", names)}
        self.assertGreater(len(foreign), 30)
        self.assertEqual(foreign & ours, set())
        self.assertEqual({option for _, option, _ in rows if option} - ours, set())
        self.assertTrue(all(usage.startswith(option) for _, option, usage in rows))


class WrongUsage(ProgramTest):
    def render(self, *arguments):
        return self.fail_usage("render", "demo", "-o", "a.png", *arguments)

    def test_words_that_do_not_exist(self):
        self.assertIn("paint", self.fail_usage("paint"))
        self.assertIn("--paint", self.render("--paint"))
        self.assertIn("extra", self.render("run.xtc", "extra"))
        self.assertIn("there is no command 'veiw'", self.fail_usage("veiw", "demo"))

    def test_what_is_required(self):
        self.assertIn("INPUT", self.fail_usage("render"))
        self.assertIn("--output", self.fail_usage("render", "demo"))
        for missing in ["--rays", "--t", "--id"]:
            others = [word for option in ["--rays", "--t", "--id"] if option != missing for word in (option, "x.npy")]
            self.assertIn(missing, self.fail_usage("trace", "demo", *others))
        self.assertIn("--output", self.fail_usage("scene", "scenario1"))

    def test_values_out_of_range(self):
        wrong = {
            "--size": ["0x0", "1x0", "65536x1", "640", "640x", "x480", "640 x 480", "-1x1", "1e3x10", "640x480x2"],
            "--recursion": ["0", "17", "-1", "2.5", "five", ""],
            "--samples": ["0", "4097", "1.5"],
            "--max-prims": ["0", "-1", "many", "1.0", "99999999999999999999"],
            "--max-depth": ["0", "-3", "infinite"],
            "--threads": ["-1", "4097", "two"],
            "--fov": ["0", "180", "-30", "nan", "wide"],
            "--radius": ["-1", "nan", "inf", "1e39", "1m"],
            "--radius-scale": ["-1", "nan"],
            "--frame": ["x", "1.5"],
            "--count": ["0", "-1", "1e3", "0x10"],
            "--seed": ["-1", "18446744073709551616", "x"],
            "--view": ["pretty", ""],
            "--engine": ["tpu"],
            "--transfer": ["gamma"],
            "--view-from": ["inside"],
            "--projection": ["fisheye", ""],
            "--background": ["reddish", "#fff", "#12345g", "1,2", "0,0,1.5", "0,0,nan"],
            "--eye": ["1,2", "1,2,3,4", "a,b,c", "1,,3", "nan,0,0", "1e39,0,0"],
            "--look-at": ["1,2", "here)"],
            "--up": ["y"],
        }
        for option, values in wrong.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    self.assertIn(option + ":", self.render(f"{option}={value}"))

    def test_options_of_other_programs(self):
        for command, option, meant in [("render", "--perspective=none", "--projection perspective"), ("render", "--ortho", "--projection orthographic"),
                                       ("render", "--zoom-on=all", "--zoom-to EXPR"), ("render", "--orient", "--view-from principal"),
                                       ("film", "--superpose=all", "--align EXPR"), ("film", "--spin", "--turntable 360")]:
            said = self.fail_usage(command, "demo", "-o", "a.png", option)
            self.assertIn(f"did you mean {meant}? see bihive {command} --help", said)
        self.assertNotIn("--align", self.fail_usage("render", "demo", "-o", "a.png", "--superpose=all"))

    def test_negative_numbers_need_no_equals_sign(self):
        self.assertIn("--threads:", self.render("--threads", "-1"))
        self.succeed("render", "demo", "-o", "a.png", "--size", "4x4", "--eye", "-1,-2,300", "--up", "0,-1,0")

    def test_a_value_is_given_once(self):
        self.assertIn("--size is given more than once", self.render("--size", "8x8", "--size", "9x9"))

    def test_contradictions(self):
        self.render("--shadows", "--no-shadows")
        self.render("--view-from", "top", "--eye", "0,0,100")
        self.render("--view-from", "top", "--up", "0,1,0")
        for view in ["traversal", "tree"]:
            self.assertIn("tree", self.render("--view", view, "--engine", "brute"))
            self.assertIn("reference tree", self.render("--view", view, "--engine", "wide"))
        self.assertIn("same file", self.fail_usage("trace", "demo", "--rays", "r", "--t", "a.npy", "--id", "a.npy"))

    def test_a_wish_for_an_instruction_set_that_is_not_there(self):
        wish = {**os.environ, "BIHIVE_TARGET": "abacus"}
        done = self.run_bihive("info", "demo", env=wish)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("BIHIVE_TARGET", done.stderr)
        self.assertIn("abacus", done.stderr)

    def test_cameras_that_see_nothing(self):
        self.render("--eye", "1,2,3", "--look-at", "1,2,3")
        self.render("--up", "0,0,0")
        self.render("--eye", "0,0,9", "--look-at", "0,0,0", "--up", "0,0,1")

    def test_options_that_do_not_fit_the_input(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        for given in ["demo", "a.xyz", "four-spheres"]:
            self.assertIn("--count", self.fail_usage("stats", given, "--count", "5"))
            self.assertIn("--seed", self.fail_usage("stats", given, "--seed", "5"))
        for given in ["scenario1", "four-spheres"]:
            self.assertIn("--frame", self.fail_usage("info", given, "--frame", "0"))
            self.assertIn("--recenter", self.fail_usage("info", given, "--recenter"))
            self.assertIn("--radius-scale", self.fail_usage("info", given, "--radius-scale", "2"))
        self.assertIn("--radius", self.fail_usage("info", "four-spheres", "--radius", "2"))

    def test_scenarios_check_their_radius(self):
        self.fail_usage("stats", "scenario1", "--radius", "20")
        self.fail_usage("stats", "scenario2", "--radius", "4")
        self.fail_usage("stats", "scenario3", "--radius", "0")

    def test_scene_writes_two_kinds_of_file(self):
        self.assertIn(".npy", self.fail_usage("scene", "scenario1", "-o", "a.txt"))
        self.assertIn("scenario1", self.fail_usage("scene", "demo", "-o", "a.npy"))
        self.assertIn("--count", self.fail_usage("scene", "four-spheres", "--count", "4", "-o", "a.npy"))

    def test_an_empty_value_takes_no_other_word(self):
        self.succeed("render", "demo", "--title=", "-o", "a.png", "--size", "16x12", "--samples", "1")
        self.assertEqual(os.listdir(self.folder), ["a.png"])
        self.assertIn("--view-from", self.fail_usage("render", "demo", "--view-from=", "left", "-o", "b.png"))
        self.assertIn("--title=: cannot be opened", self.fail_with(1, "info", "--", "--title="))


if __name__ == "__main__":
    main()
