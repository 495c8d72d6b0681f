"""The table of parameters: what is generated from it is up to date, and each parameter works in every front end."""

import itertools
import json
import os
import subprocess
import sys

from program import BIHIVE, ProgramTest, main

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Table(ProgramTest):
    def table(self):
        return json.loads(self.succeed("describe", "settings"))

    def test_generated_files_are_up_to_date(self):
        environment = {**os.environ, "BIHIVE": BIHIVE}
        script = os.path.join(SOURCE, "scripts/settings_tables")
        done = subprocess.run([sys.executable, script, "--check"], env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_each_option_is_in_the_help(self):
        text = self.succeed("render", "--help-all")
        for row in self.table():
            if "option" in row:
                self.assertIn(row["option"] + " ", text + " ", row["id"])

    def test_a_value_means_the_same_as_an_option_and_in_a_scene_file(self):
        values = {
            "flag": lambda row: not row["default"],
            "whole": lambda row: row["default"] + 1,
            "number": lambda row: min(row["most"], 0.75),
            # Points need the pixels per inch of a print.
            "choice": lambda row: row["names"][-1 if row["id"] != "line_unit" else 1],
            "text": lambda row: "A title",
            "colour": lambda row: "#204060",
        }
        # What these spheres cannot show, and a curve that the text of a colour depends on.
        left_out = ("legend", "legend_title", "length_unit", "matte", "eye_distance", "cell", "cell_width", "cell_colour", "transfer")
        size = ["--size", "48x36", "--samples", "1", "--projection", "orthographic"]
        with open(self.path("spheres.csv"), "w") as file:
            file.write("x,y,z,r,mol\n0,0,0,1,1\n1,0,-3,1,1\n0,1,1,0.5,1\n")
        with open(self.path("hollow.csv"), "w") as file:
            places = [p for p in itertools.product((-1, 0, 1), repeat=3) if any(p)]
            file.write("x,y,z,r\n" + "".join(f"{x},{y},{z},0.5\n" for x, y, z in places))
        with open(self.path("atoms.xyz"), "w") as file:
            file.write("5\n\nC 0 0 0\nO 1.2 0 0\nH -0.6 0.9 0\nO 4 0 0\nH 3.05 0 0\n")
        with open(self.path("run.xyz"), "w") as file:
            file.write("".join(f"2\n\nAr {i} 0 0\nAr 0 {3 + i} 0\n" for i in range(3)))
        for row in self.table():
            if "option" not in row or "path" not in row or row["id"] in left_out:
                continue
            with self.subTest(row["id"]):
                value = {"bond_reach": 1.4, "arrows": "x,y,r", "arrow_select": "index 1", "arrow_colour": "x:magma", "trace_select": "index 0 2",
                         "trace_radius": "r/2", "trace_atoms": "shown", "trail": 2, "trail_select": "index 1", "show_cavities": 0.25, "show_contacts": 0.5, "link_radius": "area:0.1", "link_colour": "area:magma"}.get(row["id"]) or values[row["kind"]](row)
                whole, _, key = row["path"].partition(".")
                picture = {whole: {key: value} if key else {} if whole == "ambient_occlusion" else value}
                # A part of something whose presence has a number of its own is set with it.
                extra = {"fog": ["--fog", "0.5"], "outline": ["--outline", "1", "--line-unit", "px"]}.get(whole, []) if key and row["id"] not in ("fog",) else []
                # Bonds are between atoms, and what is theirs is set with them.
                of_bonds = row["id"] in ("bonds", "bond_reach", "bond_orders", "stick_radius", "ball_scale")
                of_atoms = of_bonds or row["id"].startswith("hbond")
                spheres = self.path("atoms.xyz" if of_atoms else "run.xyz" if row["id"].startswith("trail") else "hollow.csv" if row["id"] == "show_cavities" else "spheres.csv")
                if of_bonds and row["id"] != "bonds":
                    bonds = "auto" if row["id"] == "bond_orders" else "distance"
                    picture["bonds"] = bonds
                    extra = ["--bonds", bonds]
                # The same for arrows, tubes, trails and hydrogen bonds.
                for kind, on in (("arrows", "x,y,r"), ("trace", "mol"), ("trail", 1), ("hbonds", True), ("show_contacts", 0.5)):
                    if row["id"].startswith("link_" if kind == "show_contacts" else kind.rstrip("s") + "_"):
                        picture[kind] = on
                        extra = ["--" + kind.replace("_", "-"), *([] if on is True else [str(on)])]
                of_frame = {"frame": 2} if row["id"].startswith("trail") else {}
                if of_frame:
                    extra = [*extra, "--frame", "2"]
                with open(self.path("scene.json"), "w") as file:
                    json.dump({"bihive_scene": 2, "picture": picture, "spheres": {"file": spheres, **of_frame}}, file)
                by_file = self.hash(self.path("scene.json"), *size)
                option = row["option"] if value is not False else row["option"].replace("--", "--no-", 1)
                words = [option] if row["kind"] == "flag" else [f"{option}={value}"]
                by_option = self.hash(spheres, *size, "--style", "plain", *extra, *words)
                self.assertEqual(by_option, by_file, row["id"])

    def hash(self, source, *words):
        return json.loads(self.succeed("render", source, "-o", self.path("a.png"), "--json", *words))["picture_hash"]


if __name__ == "__main__":
    main()
