"""`bihive scene save`: the request for a picture as a scene file, from which `bihive render` draws the same bits."""

import json
import os

from program import ProgramTest, main

SMALL = ["--size", "60x40"]
MOLECULE = "2\n\nC 0 0 0\nO 1.2 0 0\n"

# A value of each option with one. A new option needs a row here: none may be lost.
VALUES = {
    "size": "8.5x6cm", "crop": "0,0,9,9", "view": "normal", "samples": "auto", "recursion": "3", "matte": "black", "stereo": "side",
    "eye_distance": "0.1", "fit_share": "0.9", "transfer": "none", "background": "none", "bits": "16", "dpi": "300", "style": "flat", "light": "from:1,1,1:red:0.5",
    "ao_distance": "5", "ao_directions": "16", "opacity_rule": "once", "light_points": "4", "fog": "0.5", "fog_start": "0.1", "fog_end": "0.9",
    "outline_step": "2", "outline_colour": "blue", "line_unit": "pt", "exposure": "-1", "tone": "filmic", "view_from": "best:chain A",
    "eye": "0,0,90", "look_at": "resname 478", "fit": "chain A and name CA", "zoom_to": "element O", "up": "0,0,1", "fov": "20",
    "projection": "orthographic", "turn": "30,-20,5", "zoom": "2", "aperture": "0.5", "focus": "resname 478", "engine": "reference",
    "max_prims": "4", "max_depth": "unlimited", "threads": "2", "count": "64", "seed": "3", "radius": "0.5", "frame": "-1",
    "trajectory": "run.xtc", "assembly": "1", "columns": "x=px,r=5", "replicate": "2x1x1", "cell_vectors": "9,0,0,0,9,0,0,0,9",
    "cell_origin": "1,2,3", "select": 'name "C\'" or chain A', "colour": "#ff0000", "colour_by": "b_factor:magma:10,60:log", "nan_colour": "grey",
    "opacity": "0.5", "material": "metal", "radius_scale": "0.8", "outline": "2", "crease": "chain", "legend_name": "größer \"als\" \\ 5",
    "clip": "plane:0,0,1,0", "element_colours": "jmol", "cell_width": "2", "cell_colour": "red", "title": "--t = {time:.1f}",
    "legend_title": "Charge (e)", "length_unit": "nm", "title_values": "log.csv", "smooth": "5", "exposed_area": "1.4", "font": "letters.ttf", "floor": "shadow",
    "bonds": "distance", "bond_reach": "1.3", "stick_radius": "0.2", "ball_scale": "0.3",
    "arrows": "x,y,z", "arrow_select": "chain A", "arrow_scale": "2", "arrow_share": "0.2", "arrow_radius": "0.2", "arrow_pivot": "middle", "arrow_colour": "b_factor:magma:0,60",
    "trace": "chain", "trace_select": "name CA", "trace_radius": "b_factor/50", "trace_atoms": "shown",
    "trail": "5", "trail_select": "chain A", "trail_radius": "0.1", "hbond_radius": "0.05", "hbond_colour": "yellow",
    "show_cavities": "1.4", "show_contacts": "0.5", "links": "pairs.csv", "link_radius": "force:0.1", "link_colour": "force:magma:0,9",
}
IMPLIED = {"nan_colour": ["--colour-by", "b_factor"]}


def option_of(name):
    return "--" + name.replace("_", "-")


class SceneSave(ProgramTest):
    def options_of(self, name):
        return json.loads(self.read(name))["options"]

    def test_no_option_is_lost(self):
        for row in json.loads(self.succeed("describe", "picture")):
            name = row["id"]
            given = [f"{option_of(name)}={VALUES[name]}"] if row["value"] else [option_of(name)]
            self.succeed("scene", "save", "a.json", "demo", *IMPLIED.get(name, []), *given)
            expected = [name, VALUES[name]] if row["value"] else [name]
            self.assertIn(expected, self.options_of("a.json"))
            # What is read is what was written.
            self.succeed("scene", "save", "b.json", "a.json")
            self.assertEqual(self.read("a.json"), self.read("b.json"), name)

    def test_the_same_bits(self):
        os.mkdir(self.path("in"))
        os.mkdir(self.path("out"))
        self.write("in/m.xyz", MOLECULE)
        self.write("in/s.json", '{"bihive_style": 1, "background": "black"}')
        self.write("in/map.txt", "#000000\n#ff0000\n")
        own = {"bihive_scene": 1, "spheres": [[0, 0, 0, 1], [2, 0, 0, 1]], "camera": {"eye": [0, 2, 10], "look_at": [0, 0, 0]}}
        self.write("in/own.json", json.dumps(own))
        for request in (
            ["demo", "--style", "illustrative", "--turn", "30,20", "--select", "chain A", "--opacity", "0.3", "--select", "resname 478", "--hide"],
            ["demo", "--fit", "resname 478", "--view-from", "best:resname 478", "--legend", "--colour-by", "chain", "--light", "from:1,1,1"],
            ["in/m.xyz", "--style", "in/s.json", "--colour-by", "x:in/map.txt", "--no-shadows", "--background", "none", "--zoom-to", "element O"],
            ["in/own.json", "--select", "index 1", "--colour", "red"],
            ["scenario1", "--count", "64", "--seed", "5", "--samples", "2"],
        ):
            self.succeed("render", *request, *SMALL, "-o", "a.png")
            self.succeed("scene", "save", "out/s.json", *request, *SMALL)
            self.succeed("render", "out/s.json", "-o", "b.png")
            self.assertEqual(self.read("a.png"), self.read("b.png"), request)
            # From the figure.
            if request[0] in ("demo", "scenario1"):
                self.succeed("scene", "save", "t.json", "a.png")
                self.assertEqual(self.options_of("t.json"), self.options_of("out/s.json"))
        self.assertNotIn(os.getcwd(), self.read("out/s.json").decode())

    def test_options_of_the_command_line_replace_those_of_the_file(self):
        self.succeed("scene", "save", "s.json", "demo", *SMALL, "--style", "flat", "--view-from", "left", "--select", "chain A", "--colour", "red")
        more = ["--size", "30x20", "--eye", "0,0,90", "--select", "chain B", "--hide"]
        self.succeed("render", "s.json", *more, "-o", "a.png")
        self.succeed("render", "demo", "--style", "flat", "--size", "30x20", "--eye", "0,0,90", "--select", "chain A", "--colour", "red",
                     "--select", "chain B", "--hide", "-o", "b.png")
        self.assertEqual(self.read("a.png"), self.read("b.png"))

    def test_every_command_takes_the_input(self):
        os.mkdir(self.path("in"))
        self.write("in/m.xyz", MOLECULE)
        self.succeed("scene", "save", "s.json", "in/m.xyz", *SMALL, "--radius", "0.5", "--max-prims", "1", "--select", "element O", "--hide")
        given = ["in/m.xyz", "--radius", "0.5"]
        for words in (["info"], ["info", "--attributes"], ["info", "--distance", "0,1"], ["select", "element O"]):
            name, *rest = words
            tree = ["--max-prims", "1"] if words == ["info"] else []
            self.assertEqual(self.succeed(name, "s.json", *rest), self.succeed(name, *given, *tree, *rest), words)
        of_file, of_input = (json.loads(self.succeed("stats", *words, "--json")) for words in (["s.json"], [*given, "--max-prims", "1"]))
        self.assertEqual(of_file["max_prims"], of_input["max_prims"])
        self.succeed("convert", "s.json", "-o", "a.csv")
        self.succeed("convert", *given, "-o", "b.csv")
        self.assertEqual(self.read("a.csv"), self.read("b.csv"))
        # Options of the command line replace those of the file.
        self.succeed("convert", "s.json", "--radius", "2", "-o", "a.csv")
        self.assertNotEqual(self.read("a.csv"), self.read("b.csv"))
        before = self.read("s.json")
        self.assertIn("s.json", self.fail_input("convert", "s.json", "-o", "s.json"))
        self.assertEqual(self.read("s.json"), before)

    def test_films(self):
        self.write("m.xyz", MOLECULE + MOLECULE.replace("1.2", "2.4"))
        options = [*SMALL, "--style", "flat", "--select", "element O", "--colour", "red"]
        self.succeed("scene", "save", "s.json", "m.xyz", "--frame", "1", *options)
        self.succeed("film", "s.json", "-o", "a.y4m", "--samples", "1")
        self.succeed("film", "m.xyz", "-o", "b.y4m", *options, "--samples", "1")
        self.assertEqual(self.read("a.y4m"), self.read("b.y4m"))
        # A picture of the film is drawn from its description.
        self.succeed("film", "s.json", "-o", "p%d.png", "--samples", "1")
        film = next(name for name in os.listdir(self.folder) if name.startswith("p") and name.endswith(".json"))
        self.succeed("render", "m.xyz", "--film", film, "--picture", "1", "-o", "one.png")
        self.assertEqual(self.read("one.png"), self.read("p1.png"))

    def test_scenes_of_scenes_and_faults(self):
        self.succeed("scene", "save", "s.json", "demo", *SMALL)
        self.write("t.json", json.dumps({"bihive_scene": 2, "input": "s.json", "options": [["ao"]]}))
        self.succeed("render", "t.json", "-o", "a.png")
        self.succeed("render", "demo", *SMALL, "--ao", "-o", "b.png")
        self.assertEqual(self.read("a.png"), self.read("b.png"))
        for document, fault in (
            ({"input": "t.json"}, "again and again"),
            ({"input": "demo", "options": [["vieuw", "id"]]}, "there is no option"),
            ({"input": "demo", "options": [["fit", "chain ("]]}, "column"),
            ({"input": "demo", "options": [["ao", "", ""]]}, "/options/0"),
            ({"input": "demo", "options": [["colour_by", "x:map.txt"]]}, "map.txt"),
            ({"input": "demo", "spheres": []}, "spheres"),
            ({"input": ""}, "/input"),
        ):
            self.write("map.txt", "#000000\n#ff0000\n")
            self.write("t.json", json.dumps({"bihive_scene": 2, **document}))
            done = self.run_bihive("render", "t.json", "-o", "c.png")
            self.assertIn(done.returncode, (1, 2), document)
            self.assertIn(fault, done.stderr)
        self.assertIn(".json", self.fail_usage("scene", "save", "s.txt", "demo"))
        self.assertIn("--layers", self.fail_usage("scene", "save", "s.json", "demo", "--layers", "id"))
        self.assertIn("standard input", self.fail_usage("scene", "save", "s.json", "-"))


main()
