"""bihive scene and bihive info."""

import json
import os
import re

import numpy
from program import ProgramTest, main, png_numbers


class Scene(ProgramTest):
    def test_npy_has_four_columns(self):
        said = self.succeed("scene", "scenario2", "--count", "100", "--radius", "0.5", "--seed", "3", "-o", "s.npy")
        self.assertEqual(said, "s.npy: scenario2, 100 spheres, seed 3\n")
        spheres = numpy.load(self.path("s.npy"))
        self.assertEqual((spheres.shape, spheres.dtype), ((100, 4), numpy.float32))
        self.assertTrue((spheres[:, 3] == 0.5).all())
        self.assertTrue((abs(spheres[:, :3]) >= 12).all() and (abs(spheres[:, :3]) <= 19.5).all())

    def test_defaults(self):
        self.succeed("scene", "scenario1", "-o", "s.npy")
        spheres = numpy.load(self.path("s.npy"))
        self.assertEqual(spheres.shape, (4096, 4))
        self.assertTrue((spheres[:, 3] == 1).all())
        self.assertEqual(spheres[0].tolist(), [-19, -19, -19, 1])

    def test_seeds_matter_where_there_is_chance(self):
        for name, differ in [("scenario1", False), ("scenario2", True), ("scenario3", True)]:
            self.succeed("scene", name, "-o", "default.npy")
            self.succeed("scene", name, "--seed", "1", "-o", "one.npy")
            self.succeed("scene", name, "--seed", "2", "-o", "two.npy")
            self.assertEqual(self.read("default.npy"), self.read("one.npy"))
            self.assertEqual(self.read("one.npy") != self.read("two.npy"), differ, name)

    def test_a_written_scene_is_the_same_scene(self):
        for name in ["scenario1", "scenario2", "scenario3", "four-spheres"]:
            self.succeed("scene", name, "-o", "s.json")
            size = ["--size", "64x36"]
            from_file = self.succeed_json("render", "s.json", "-o", "file.png", *size)
            built_in = self.succeed_json("render", name, "-o", "name.png", *size)
            self.assertEqual(from_file["picture_hash"], built_in["picture_hash"], name)
            self.assertEqual(from_file["settings"], built_in["settings"], name)
            self.assertEqual(png_numbers(self.read("file.png")), png_numbers(self.read("name.png")), name)

    def test_json_is_json(self):
        self.succeed("scene", "scenario3", "--count", "9", "-o", "s.json")
        document = json.loads(self.read("s.json"))
        self.assertEqual(document["bihive_scene"], 1)
        self.assertEqual(document["seed"], 1)
        self.assertEqual(len(document["spheres"]), 9)

    def test_spheres_alone_have_the_same_tree(self):
        self.succeed("scene", "scenario3", "-o", "s.npy")
        from_file, built_in = self.succeed_json("stats", "s.npy"), self.succeed_json("stats", "scenario3")
        for varying in ["build_ms", "seed"]:
            del from_file[varying], built_in[varying]
        del from_file["wide"]["build_ms"], built_in["wide"]["build_ms"]
        self.assertEqual(from_file, built_in)

    def test_the_documents_of_the_documentation_are_scenes(self):
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "docs", "scene_format.md"), encoding="utf-8") as file:
            documents = re.findall(r"```json\n(.*?)```", file.read(), re.DOTALL)
        self.assertEqual(len(documents), 7)
        self.write("molecule.pdb", "HETATM    1  O   HOH A   1       1.000   2.000   3.000  1.00  0.00           O  \n"
                   "HETATM    2  O   LIG B   2       4.000   2.000   3.000  1.00  0.00           O  \n")
        for document in documents:
            self.write("s.json", document)
            self.succeed("render", "s.json", "--size", "32x24", "-o", "a.png")

    def test_an_old_file_is_replaced(self):
        self.write("s.npy", "old")
        self.succeed("scene", "four-spheres", "-o", "s.npy")
        self.assertEqual(numpy.load(self.path("s.npy")).shape, (4, 4))


class Info(ProgramTest):
    def test_of_a_molecule(self):
        info = self.succeed_json("info", "demo")
        self.assertEqual(info["format"], "PDB")
        self.assertEqual(info["frames"], 1)
        self.assertTrue(info["rules"])
        self.assertEqual(info["warnings"], [])
        self.assertIn("element", [attribute["name"] for attribute in info["attributes"]])
        for axis in range(3):
            self.assertLess(info["bounds"]["lo"][axis], info["bounds"]["hi"][axis])
        self.assertLess(0, info["radius"]["min"])
        predicted = info["predicted_tree"]
        held = self.succeed_json("stats", "demo")
        self.assertTrue(predicted["allocated_bytes"]["low"] <= held["allocated_bytes"])
        self.assertTrue(held["allocated_bytes"] <= predicted["allocated_bytes"]["high"])
        self.assertTrue(predicted["compact_bytes"]["low"] <= held["bytes"]["total"] <= predicted["compact_bytes"]["high"])

    def test_chains_residues_and_ligands(self):
        # Counted here by the columns of the format.
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "data", "1hpv.pdb"), encoding="ascii") as file:
            atoms = [line for line in file if line.startswith(("ATOM", "HETATM"))]
        residues = {(line[21], line[22:27], line[17:20].strip()) for line in atoms}
        water = {residue for residue in residues if residue[2] == "HOH"}
        ligand = {residue for residue in residues if residue[2] == "478"}
        info = self.succeed_json("info", "demo")
        of = {kind["name"]: kind["residues"] for kind in info["residues"]}
        self.assertEqual(of, {"protein": len(residues - water - ligand), "water": len(water), "ligand": len(ligand)})
        self.assertEqual([ligand["name"] for ligand in info["ligands"]], ["478"])
        self.assertEqual({chain["name"]: chain["residues"] for chain in info["chains"]},
                         {name.strip(): len({r for r in residues if r[0] == name}) for name in "AB "})
        self.assertEqual(sum(chain["spheres"] for chain in info["chains"]), len(atoms))
        said = self.succeed("info", "demo")
        self.assertIn("\n  residues          protein 198, water 80, ligand 1\n", said)
        for words in [["--trees"], ["--max-prims", "2"]]:
            with_trees = self.succeed("info", "demo", *words)
            self.assertTrue(with_trees.startswith(said), words)
            self.assertIn("reference tree", with_trees)
        self.assertNotIn("reference tree", said)

    def test_title_and_entry(self):
        head = ("HEADER    HYDROLASE                               18-NOV-94   1HPV\nTITLE     THE TITLE \x1b[31m OF\nTITLE    2 THE FILE\n")
        self.write("a.pdb", head + "HETATM    1  O   HOH A   1       1.000   2.000   3.000  1.00  0.00           O  \n")
        info = self.succeed_json("info", "a.pdb")
        self.assertEqual((info["title"], info["entry_id"]), ("THE TITLE [31m OF THE FILE", "1HPV"))
        self.assertIn("\n  title             THE TITLE [31m OF THE FILE\n  entry             1HPV\n", self.succeed("info", "a.pdb"))
        self.succeed("convert", "a.pdb", "-o", "a.extxyz")
        self.assertEqual(self.succeed_json("info", "a.extxyz")["title"], "THE TITLE [31m OF THE FILE")
        # A scene file has that of its spheres.
        self.write("a.json", '{"bihive_scene": 1, "spheres": {"file": "a.pdb"}}')
        self.assertEqual(self.succeed_json("info", "a.json")["title"], "THE TITLE [31m OF THE FILE")
        self.write("a.csv", "0 0 0 1\n")
        info = self.succeed_json("info", "a.csv")
        self.assertEqual((info["title"], info["entry_id"]), (None, None))

    def test_times_and_molecules(self):
        dump = "".join(f"ITEM: UNITS\nreal\nITEM: TIME\n{500 * k}\nITEM: TIMESTEP\n{k}\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n"
                       "0 9\n0 9\n0 9\nITEM: ATOMS id mol x y z radius\n3 8 1 1 1 1\n1 7 2 2 2 1\n2 7 3 3 3 1\n" for k in range(4))
        self.write("a.dump", dump)
        info = self.succeed_json("info", "a.dump", "--frame", "1")
        self.assertEqual((info["time_span_ps"], info["time_ps"], info["molecules"]), ([0, 1.5], 0.5, 2))
        said = self.run_bihive("info", "a.dump").stdout
        self.assertIn("\n  time span         0 to 1.5 ps in 4 frames\n", said)
        self.assertIn("\n  molecules         2\n", said)
        self.assertIn("order: by id", said)
        self.assertIn("\n  order: by id", self.run_bihive("convert", "a.dump", "-o", "a.csv").stdout)

    def test_of_a_file_with_everything(self):
        self.write("a.csv", "x,y,z,radius,charge\n0,0,0,1,-2\n10,0,0,0,3\n0,5,0,2,4\n")
        info = self.succeed_json("info", "a.csv")
        self.assertEqual(info["spheres"], 3)
        self.assertEqual(info["bounds"], {"lo": [-2, -1, -2], "hi": [10, 7, 2]})
        self.assertEqual(info["radius"], {"min": 0, "max": 2})
        self.assertEqual(info["zero_radii"], 1)
        self.assertIn({"name": "charge", "min": -2, "max": 4}, info["attributes"])

    def test_unknown_numbers_are_null(self):
        self.write("a.csv", "x,y,z,r,charge,mass\n0,0,0,1,nan,1\n9,0,0,1,nan,nan\n")
        done = self.run_bihive("info", "a.csv", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        attributes = json.loads(done.stdout)["attributes"]
        self.assertIn({"name": "charge", "min": None, "max": None}, attributes)
        self.assertIn({"name": "mass", "min": 1, "max": 1}, attributes)

    def test_speed_is_the_length_of_the_velocity(self):
        self.write("a.csv", "x,y,z,r,vx,vy,vz\n0,0,0,1,3,4,0\n9,0,0,1,0,0,-2\n")
        facts = self.succeed_json("info", "a.csv", "--attributes")["attributes"]
        self.assertIn({"name": "speed", "kind": "number", "min": 2, "max": 5, "nan": 0}, facts)
        self.write("a.csv", "x,y,z,r,vx,vy,vz,speed\n0,0,0,1,3,4,0,7\n")
        facts = self.succeed_json("info", "a.csv", "--attributes")["attributes"]
        self.assertEqual([(fact["min"], fact["max"]) for fact in facts if fact["name"] == "speed"], [(7, 7)])

    def test_attributes(self):
        # Counted here by the columns of the format.
        facts = self.succeed_json("info", "demo", "--attributes")
        by_name = {fact["name"]: fact for fact in facts["attributes"]}
        with open(os.path.join(os.environ["BIHIVE_SOURCE"], "data", "1hpv.pdb"), encoding="ascii") as file:
            atoms = [line for line in file if line.startswith(("ATOM", "HETATM"))]
        self.assertEqual(facts["spheres"], len(atoms))
        self.assertEqual(by_name["resname"]["distinct"], len({line[17:20] for line in atoms}))
        self.assertEqual(by_name["chain"]["first"], list(dict.fromkeys(line[21].strip() for line in atoms)))
        self.assertEqual(by_name["b_factor"]["max"], max(float(line[60:66]) for line in atoms))
        self.assertEqual((by_name["b_factor"]["kind"], by_name["b_factor"]["nan"]), ("number", 0))

    def test_attributes_with_gaps(self):
        self.write("a.csv", "x,y,z,r,charge,phase\n0,0,0,1,,wet\n9,0,0,1,nan,dry\n1,1,1,1,2,wet\n")
        facts = self.succeed_json("info", "a.csv", "--attributes")["attributes"]
        self.assertIn({"name": "charge", "kind": "number", "min": 2, "max": 2, "nan": 2}, facts)
        self.assertIn({"name": "phase", "kind": "text", "distinct": 2, "first": ["wet", "dry"]}, facts)
        self.assertRegex(self.succeed("info", "a.csv", "--attributes"), r"charge +number +2 to 2, 2 NaN")

    def test_reading_options(self):
        self.write("a.csv", "x,y,z,r\n10,0,0,1\n12,0,0,3\n")
        self.assertEqual(self.succeed_json("info", "a.csv", "--radius", "7")["radius"], {"min": 7, "max": 7})
        self.assertEqual(self.succeed_json("info", "a.csv", "--radius-scale", "2")["radius"], {"min": 2, "max": 6})
        moved = self.succeed_json("info", "a.csv", "--recenter")
        self.assertEqual(moved["recentred_by"], [11, 0, 0])
        self.assertEqual(moved["bounds"], {"lo": [-2, -3, -3], "hi": [4, 3, 3]})

    def test_frames(self):
        self.write("a.xyz", "1\n\nC 1 0 0\n1\n\nC 2 0 0\n1\n\nC 3 0 0\n")
        for frame in range(3):
            info = self.succeed_json("info", "a.xyz", "--frame", str(frame))
            self.assertEqual(info["frames"], 3)
            self.assertAlmostEqual((info["bounds"]["lo"][0] + info["bounds"]["hi"][0]) / 2, frame + 1, places=6)
        self.assertIn("3", self.fail_input("info", "a.xyz", "--frame", "3"))
        last = self.succeed_json("info", "a.xyz", "--frame", "-1")
        self.assertEqual(last["bounds"], self.succeed_json("info", "a.xyz", "--frame", "2")["bounds"])
        self.assertIn("there is no frame -4", self.fail_input("info", "a.xyz", "--frame", "-4"))

    def test_a_scene_file_says_what_it_has(self):
        self.write("s.json", '{"bihive_scene": 1, "lights": [], "spheres": [[0, 0, 0, 1]]}')
        info = self.succeed_json("info", "s.json")
        self.assertEqual((info["format"], info["camera"], info["lights"]), ("scene file", False, 0))

    def test_a_missing_radius_is_said_once_on_stderr(self):
        self.write("a.txt", "0 0 0\n1 1 1\n")
        done = self.run_bihive("info", "a.txt", "--json")  # the centres are sqrt(3) apart
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"\Abihive: warning: [^\n]*--radius[^\n]*\n\Z")
        info = json.loads(done.stdout)
        self.assertAlmostEqual(info["radius"]["min"], 3**0.5 / 2, places=6)
        self.assertEqual(info["radius"]["max"], info["radius"]["min"])
        self.assertIn("radii: 0.866025, half the middle distance to the nearest neighbour", info["rules"])
        self.assertEqual(len(info["warnings"]), 1)
        self.succeed("info", "a.txt", "--radius", "2")

    def test_text(self):
        text = self.succeed("info", "scenario1")
        self.assertIn("4,096 spheres", text)
        self.assertIn("-20 to 20", text)


if __name__ == "__main__":
    main()
