"""bihive measure: area and volume of the union of spheres, sums by a column, the area of each sphere, and what is refused."""

import csv
import math
import os
import re

from program import ProgramTest, main

BALL, LENS = 4 * math.pi, 2 * math.pi * 0.5  # of unit spheres at a distance of 1: what is left out of each


class Measure(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", "x,y,z,r,mol\n0,0,0,1,1\n1,0,0,1,1\n9,0,0,1,2\n9,0,0,1,2\n")

    def test_sums(self):
        found = self.succeed_json("measure", "a.csv")
        self.assertAlmostEqual(found["area"], 3 * BALL - 2 * LENS, delta=found["area_error"])
        self.assertAlmostEqual(found["volume"], BALL - 2 * math.pi / 3 * 0.25 * 2.5, delta=found["volume_error"])
        self.assertEqual((found["spheres"], found["exposed"], found["probe"]), (4, 3, 0))
        self.assertLess(found["area_error"], 1e-11 * found["area"])
        text = self.succeed("measure", "a.csv", "--by", "mol")
        self.assertEqual(
            text,
            "a.csv: 4 spheres, 3 exposed\n  area    31.4159265359\n  volume  11.2573736754\n  2 connected parts, no cavity\n"
            "area by mol:\n  1  18.8495559215, 2 of 2 exposed\n  2  12.5663706144, 1 of 2 exposed\n",
        )

    def test_probe_selection_and_groups(self):
        found = self.succeed_json("measure", "a.csv", "--probe", "0.5", "--select", "mol 2 and index < 3", "--by", "mol")
        self.assertAlmostEqual(found["area"], BALL * 2.25, places=12)
        self.assertEqual([(g["name"], g["spheres"]) for g in found["groups"]], [("2", 1)])
        chains = self.succeed_json("measure", "demo", "--probe", "1.4", "--by", "chain")
        self.assertEqual([g["name"] for g in chains["groups"]][:2], ["A", "B"])
        self.assertAlmostEqual(sum(g["area"] for g in chains["groups"]), chains["area"], places=6)
        # Of the same bits on any number of threads.
        for threads in ("1", "3"):
            again = self.succeed_json("measure", "demo", "--probe", "1.4", "--threads", threads)
            self.assertEqual((again["area"], again["volume"]), (chains["area"], chains["volume"]))

    def test_per_sphere(self):
        self.succeed("measure", "a.csv", "--per-sphere", "areas.csv", "--probe", "0.25")
        with open(self.path("areas.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["id"] for row in rows], ["0", "1", "2", "3"])
        self.assertEqual({row["radius"] for row in rows}, {"1.25"})
        self.assertAlmostEqual(float(rows[2]["area"]), BALL * 1.5625, places=12)
        self.assertEqual(float(rows[3]["area"]), 0)

    def test_progress(self):
        """As programs read it: the finished share."""
        rows = "".join(f"{x},{y},{z},0.6\n" for x in range(30) for y in range(30) for z in range(30))
        self.write("large.csv", "x,y,z,r\n" + rows)
        done = self.run_bihive("measure", "large.csv", env={**os.environ, "BIHIVE_PROGRESS": "shares"})
        self.assertEqual(done.returncode, 0, done.stderr)
        shares = [float(line.split()[-1]) for line in done.stderr.splitlines() if "progress: measuring " in line]
        self.assertTrue(shares)
        self.assertTrue(all(0 <= share <= 1 for share in shares))

    def areas_in(self, name, column):
        with open(self.path(name), encoding="utf-8") as file:
            return [float(row[column]) for row in csv.DictReader(file)]

    def test_areas_as_a_column(self):
        """Of what is read: colours, selections and tables know it, in each frame anew."""
        self.succeed("measure", "a.csv", "--per-sphere", "areas.csv", "--probe", "0.25")
        self.succeed("convert", "a.csv", "-o", "column.csv", "--exposed-area", "0.25")
        self.assertEqual(self.areas_in("column.csv", "exposed_area"), self.areas_in("areas.csv", "area"))
        self.assertEqual(self.succeed_json("select", "a.csv", "exposed_area = 0", "--exposed-area", "0")["ids"], [3])
        self.write("t.extxyz", "".join(f'2\nProperties=species:S:1:pos:R:3:radius:R:1\nC 0 0 0 1\nC {x} 0 0 1\n' for x in (1, 5)))
        for frame, area in ((0, BALL - LENS), (1, BALL)):
            self.succeed("convert", "t.extxyz", "--frame", str(frame), "-o", "frame.csv", "--exposed-area", "0")
            self.assertAlmostEqual(self.areas_in("frame.csv", "exposed_area")[0], area, places=12)
        # Images cover spheres too where they are asked for, as in bihive measure.
        box = ["cell.csv", "--cell-vectors", "2,0,0,0,2,0,0,0,2", "--exposed-area", "0"]
        self.write("cell.csv", "x,y,z,r\n0,0,0,1.25\n")
        for options, area in (([], BALL * 1.5625), (["--periodic"], BALL * 1.5625 - 6 * 2 * math.pi * 1.25 * 0.25)):
            self.succeed("convert", *box, *options, "-o", "one.csv")
            self.assertAlmostEqual(self.areas_in("one.csv", "exposed_area")[0], area, places=12)
        self.succeed("render", *box, "--replicate", "2x1x1", "--colour-by", "exposed_area", "--size", "8x8", "-o", "two.png")
        picture = ["a.csv", "--size", "8x8", "-o", "a.png", "--colour-by", "exposed_area"]
        self.succeed("render", *picture, "--exposed-area", "0.25")
        self.assertIn("--exposed-area measures it when a file is read", self.fail_usage("render", *picture))
        self.assertIn("there is a column exposed_area already", self.fail_input("info", "column.csv", "--exposed-area", "1"))

    def test_cavities(self):
        rows = [f"{x},{y},{z},1.5" for x in (0, 2) for y in (0, 2) for z in (0, 2)]
        self.write("cube.csv", "x,y,z,r\n" + "\n".join([*rows, "1,1,1,0.05\n"]))
        found = self.succeed_json("measure", "cube.csv", "--cavities", "cavities.csv")
        self.assertEqual((found["components"], found["cavities"]), (2, 1))
        with open(self.path("cavities.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(rows[0]["spheres"], "0 1 2 3 4 5 6 7")
        self.assertAlmostEqual(float(rows[0]["volume"]), found["cavity_volume"], places=12)
        self.assertIn("2 connected parts, 1 cavity of volume", self.succeed("measure", "cube.csv"))

    def test_residues_that_line_cavities(self):
        self.succeed("measure", "demo", "--select", "not water", "--probe", "1.4", "--cavities", "c.csv")
        rows = self.rows("c.csv")
        self.assertTrue(rows)
        self.assertEqual([float(row["volume"]) for row in rows], sorted((float(row["volume"]) for row in rows), reverse=True))
        self.assertNotIn("HOH", " ".join(row["residues"] for row in rows))
        # Residues of chains, as selections name them, have the spheres of the row.
        row = next(row for row in rows if all(":" in residue for residue in row["residues"].split()))
        residues = row["residues"].split()
        self.assertEqual(len(residues), len(set(residues)))
        words = [re.fullmatch(r"(\w):([A-Z]{3})(\d+)", residue).groups() for residue in residues]
        selection = " or ".join(f"(chain {chain} and resname {name} and resid {number})" for chain, name, number in words)
        ids = set(self.succeed_json("select", "demo", selection)["ids"])
        self.assertLessEqual(set(map(int, row["spheres"].split())), ids)

    def test_volume_per_sphere_and_contacts(self):
        self.succeed("measure", "a.csv", "--per-sphere", "spheres.csv", "--contacts", "contacts.csv")
        spheres, contacts = self.rows("spheres.csv"), self.rows("contacts.csv")
        whole = 4 * math.pi / 3
        for row, volume in zip(spheres, (whole - math.pi / 3 * 0.25 * 2.5,) * 2 + (whole, 0)):
            self.assertAlmostEqual(float(row["volume"]), volume, places=12)
        self.assertEqual([(row["first"], row["second"]) for row in contacts], [("0", "1")])
        self.assertAlmostEqual(float(contacts[0]["area"]), 0.75 * math.pi, places=12)

    def test_periodic(self):
        self.write("lattice.csv", "x,y,z,r\n0,0,0,1.25\n")
        cell = ("lattice.csv", "--cell-vectors", "2,0,0,0,2,0,0,0,2")
        found = self.succeed_json("measure", *cell, "--periodic", "--contacts", "contacts.csv")
        volume = 4 * math.pi / 3 * 1.25**3 - 6 * math.pi / 3 * 0.25**2 * 3.5
        self.assertAlmostEqual(found["porosity"], 1 - volume / 8, delta=found["porosity_error"])
        self.assertEqual((found["cell_volume"], found["components"], found["cavities"]), (8, 1, 0))
        self.assertEqual(found["channels"][0]["translations"], [[1, 0, 0], [0, 1, 0], [0, 0, 1]])
        images = [(row["image_a"], row["image_b"], row["image_c"]) for row in self.rows("contacts.csv")]
        self.assertEqual(images, [("0", "0", "1"), ("0", "1", "0"), ("1", "0", "0")])
        text = self.succeed("measure", *cell, "--periodic")
        self.assertIn("cell    8, porosity 0.149", text)
        self.assertIn("channel along (1 0 0), (0 1 0), (0 0 1)", text)
        alone = self.succeed_json("measure", *cell)
        self.assertNotIn("porosity", alone)
        self.assertAlmostEqual(alone["area"], BALL * 1.5625, places=12)
        self.assertIn("without --periodic", self.succeed("measure", *cell))
        self.assertIn("no periodic cell", self.fail_input("measure", "a.csv", "--periodic"))

    def test_buried_areas(self):
        groups = ("--group", "index 0", "--group", "index 1", "--group", "mol 2")
        found = self.succeed_json("measure", "a.csv", *groups)["buried"]
        self.assertEqual(found["groups"], ["index 0", "index 1", "mol 2"])
        self.assertAlmostEqual(found["area"][0][1], 2 * LENS, places=12)
        self.assertEqual((found["area"][0][2], found["area"][1][1]), (0, 0))
        self.assertAlmostEqual(found["alone"][2], BALL, places=12)
        self.assertIn("buried area, of both sides:\n  index 0 | index 1  6.28318530718\n", self.succeed("measure", "a.csv", *groups))
        # A matrix by a column.
        self.succeed("measure", "a.csv", "--by", "mol", "--probe", "3.5", "--buried", "matrix.csv")
        rows = self.rows("matrix.csv")
        self.assertEqual(list(rows[0]), ["group", "1", "2"])
        self.assertEqual(rows[0]["2"], rows[1]["1"])
        self.assertGreater(float(rows[0]["2"]), 0)
        self.assertIn("two groups or more", self.fail_usage("measure", "a.csv", "--group", "all"))
        self.assertIn("sphere 0 is in", self.fail_usage("measure", "a.csv", "--group", "all", "--group", "mol 1"))
        self.assertIn("no sphere is selected", self.fail_input("measure", "a.csv", "--group", "none", "--group", "mol 1"))
        self.assertIn("no groups", self.fail_usage("measure", "a.csv", "--buried", "matrix.csv"))

    def test_frames(self):
        frames = "".join(f"2\n\nC 0 0 0\nC {x} 0 0\n" for x in (1, 3))
        self.write("film.xyz", frames)
        text = self.succeed("measure", "film.xyz", "--radius", "1", "--frames")
        lines = text.splitlines()
        self.assertEqual(lines[0], "frame,time_ps,step,spheres,area,volume,components,cavities,cavity_volume")
        self.assertEqual([line.split(",")[0] for line in lines[1:]], ["0", "1"])
        self.assertAlmostEqual(float(lines[1].split(",")[4]), 2 * BALL - 2 * LENS, places=12)
        self.assertAlmostEqual(float(lines[2].split(",")[4]), 2 * BALL, places=12)
        found = self.succeed_json("measure", "film.xyz", "--radius", "1", "--frames", "--select", "index 1")
        self.assertEqual([frame["spheres"] for frame in found["frames"]], [1, 1])
        self.assertEqual(len(self.succeed("measure", "a.csv", "--frames").splitlines()), 2)
        self.fail_usage("measure", "film.xyz", "--frames", "--contacts", "contacts.csv")
        self.assertIn("(frame 0)", self.fail_input("measure", "film.xyz", "--frames", "--select", "chain"))

    def rows(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_refusals(self):
        self.assertIn("there is no column", self.fail_usage("measure", "a.csv", "--by", "chain"))
        self.assertIn("mol", self.fail_usage("measure", "a.csv", "--by", "chain"))
        self.assertIn("at least 0", self.fail_usage("measure", "a.csv", "--probe", "-1"))
        self.assertIn("at least 0", self.fail_usage("measure", "a.csv", "--probe", "nan"))
        self.assertIn("no sphere is selected", self.fail_input("measure", "a.csv", "--select", "none"))
        self.assertIn("extent", self.fail_input("measure", "a.csv", "--probe", "1e20"))
        self.assertIn("stored spheres", self.fail_usage("measure", "demo", "--replicate", "2x1x1"))
        self.fail_usage("measure", "a.csv", "--json", "--per-sphere", "-")
        self.fail_usage("measure", "a.csv", "--distribute")
        self.fail_input("measure", "a.csv", "--per-sphere", "a.csv")


if __name__ == "__main__":
    main()
