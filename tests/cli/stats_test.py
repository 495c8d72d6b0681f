"""bihive stats: the keys of its JSON, and their values for known trees."""

from program import ProgramTest, main



class Stats(ProgramTest):
    def test_keys(self):
        json = self.succeed_json("stats", "scenario2")
        for key in (
            "spheres inner_nodes leaves optimized_nodes one_sided_nodes forced_leaves spheres_per_leaf depth "
            "leaves_with bytes allocated_bytes build_ms max_prims max_depth seed wide"
        ).split():
            self.assertIn(key, json)
        self.assertEqual(set(json["spheres_per_leaf"]), {"min", "avg", "max"})
        self.assertEqual(set(json["depth"]), {"min", "avg", "max"})
        self.assertEqual(set(json["leaves_with"]), {"0", "1", "2", "3", "4", "more"})
        self.assertEqual(set(json["bytes"]), {"nodes", "indices", "aabb", "total"})
        self.assertEqual((json["max_prims"], json["max_depth"], json["seed"]), (8, None, 1))
        self.assertGreater(json["build_ms"], 0)

    def test_keys_of_the_wide_tree(self):
        wide = self.succeed_json("stats", "scenario2")["wide"]
        self.assertEqual(
            set(wide),
            set(
                "nodes leaves levels children spheres_per_leaf nodes_above_leaf node_fill leaf_fill overlap expected_cost "
                "bytes bytes_per_sphere allocated_bytes predicted_bytes peak_bytes build_ms target max_prims max_depth".split()
            ),
        )
        self.assertEqual(set(wide["expected_cost"]), {"nodes", "leaves", "spheres"})
        self.assertEqual(set(wide["bytes"]), {"nodes", "spheres", "other", "total"})
        self.assertEqual((wide["max_prims"], wide["max_depth"]), (None, None))
        self.assertGreater(wide["build_ms"], 0)

    def test_the_wide_tree_adds_up_and_was_predicted(self):
        for given in [["demo"], ["scenario1", "--count", "64"], ["scenario2"], ["scenario3", "--count", "50000"]]:
            json = self.succeed_json("stats", *given)
            wide = json["wide"]
            self.assertAlmostEqual(wide["spheres_per_leaf"]["avg"] * wide["leaves"], json["spheres"])
            self.assertAlmostEqual(wide["children"]["avg"] * wide["nodes"], wide["leaves"] + wide["nodes"] - 1)
            self.assertAlmostEqual(wide["node_fill"] * 16, wide["children"]["avg"])
            self.assertLessEqual(wide["children"]["max"], 16)
            self.assertLessEqual(wide["spheres_per_leaf"]["max"], 16)
            self.assertEqual(wide["nodes_above_leaf"]["max"], wide["levels"])
            parts = wide["bytes"]
            self.assertEqual(parts["nodes"], 512 * wide["nodes"])
            self.assertEqual(parts["total"], parts["nodes"] + parts["spheres"] + parts["other"])
            self.assertAlmostEqual(wide["bytes_per_sphere"], parts["total"] / json["spheres"])
            self.assertLessEqual(parts["total"], wide["allocated_bytes"])
            predicted = wide["predicted_bytes"]
            self.assertTrue(predicted["low"] <= parts["total"] <= predicted["high"], (given, predicted, parts))
            self.assertLessEqual(wide["peak_bytes"]["measured"], 1.5 * wide["peak_bytes"]["predicted"])
            foretold = self.succeed_json("info", *given)["predicted_wide_tree"]
            self.assertEqual(foretold, {"used_bytes": predicted, "peak_bytes": wide["peak_bytes"]["predicted"]})
            self.assertGreaterEqual(wide["expected_cost"]["nodes"], 1)
            self.assertLessEqual(wide["expected_cost"]["spheres"], json["spheres"])

    def test_limits_of_the_wide_tree(self):
        def wide(*limits):
            return self.succeed_json("stats", "scenario3", "--count", "2000", *limits)["wide"]

        few = wide("--max-prims", "3")
        self.assertLessEqual(few["spheres_per_leaf"]["max"], 3)
        self.assertEqual((few["max_prims"], few["max_depth"]), (3, None))
        root = wide("--max-depth", "1")
        self.assertEqual((root["nodes"], root["leaves"], root["spheres_per_leaf"]["max"]), (1, 1, 2000))
        self.assertEqual(root["max_depth"], 1)
        flat = wide("--max-depth", "2")
        self.assertEqual((flat["nodes"], flat["levels"]), (1, 1))
        self.assertLessEqual(flat["leaves"], 16)
        self.assertEqual(wide("--max-prims", "unlimited")["leaves"], 1)
        self.assertIsNone(wide("--max-depth", "unlimited")["max_depth"])

    def test_scenario_1_as_the_thesis_has_it(self):
        one = self.succeed_json("stats", "scenario1", "--max-prims", "1")
        self.assertEqual((one["inner_nodes"], one["leaves"], one["optimized_nodes"]), (4095, 4096, 0))
        self.assertEqual(one["depth"], {"min": 13, "avg": 13, "max": 13})
        self.assertEqual(one["leaves_with"], {"0": 0, "1": 4096, "2": 0, "3": 0, "4": 0, "more": 0})
        self.assertEqual(one["bytes"], {"nodes": 98292, "indices": 16384, "aabb": 24, "total": 114700})
        eight = self.succeed_json("stats", "scenario1", "--max-prims", "8")
        self.assertEqual((eight["inner_nodes"], eight["leaves"], eight["optimized_nodes"]), (511, 512, 0))
        self.assertEqual(eight["spheres_per_leaf"], {"min": 8, "avg": 8, "max": 8})
        self.assertEqual(eight["bytes"]["total"], 28684)

    def test_the_parts_add_up(self):
        for seed in range(1, 4):
            json = self.succeed_json("stats", "scenario3", "--seed", str(seed), "--max-prims", "2")
            self.assertEqual(json["seed"], seed)
            self.assertEqual(json["inner_nodes"], json["leaves"] - 1 + json["optimized_nodes"])
            self.assertEqual(sum(json["leaves_with"].values()), json["leaves"])
            self.assertAlmostEqual(json["spheres_per_leaf"]["avg"] * json["leaves"], 4096)
            parts = json["bytes"]
            self.assertEqual(parts["nodes"], 12 * (json["inner_nodes"] + json["leaves"]))
            self.assertEqual(parts["total"], parts["nodes"] + parts["indices"] + parts["aabb"])

    def test_limits(self):
        root = self.succeed_json("stats", "scenario1", "--count", "64", "--max-depth", "1")
        self.assertEqual((root["inner_nodes"], root["leaves"], root["max_depth"]), (0, 1, 1))
        root = self.succeed_json("stats", "scenario1", "--count", "64", "--max-prims", "unlimited")
        self.assertEqual((root["inner_nodes"], root["leaves"], root["max_prims"]), (0, 1, None))
        full = self.succeed_json("stats", "scenario1", "--count", "64", "--max-prims", "1", "--max-depth", "unlimited")
        self.assertEqual((full["inner_nodes"], full["leaves"]), (63, 64))

    def test_files_have_no_seed(self):
        self.assertIsNone(self.succeed_json("stats", "demo")["seed"])
        self.assertIsNone(self.succeed_json("stats", "four-spheres")["seed"])

    def test_a_built_in_name_goes_before_a_file(self):
        self.write("scenario1", "1\n\nC 0 0 0\n")
        self.assertEqual(self.succeed_json("stats", "scenario1")["spheres"], 4096)
        self.assertEqual(self.succeed_json("stats", "./scenario1")["spheres"], 1)
        self.write("demo", "1\n\nC 0 0 0\n")
        self.assertGreater(self.succeed_json("stats", "demo")["spheres"], 1000)
        self.assertEqual(self.succeed_json("stats", "./demo")["spheres"], 1)

    def test_text_has_the_rows_of_the_table_in_order(self):
        lines = self.succeed("stats", "scenario1", "--max-prims", "1").splitlines()
        self.assertIn("4,096 spheres", lines[0])
        names = [line[:26].strip() for line in lines[1:]]
        rows = ["inner nodes", "leaves"]
        rows += [f"{what} {which}" for what in ["spheres per leaf", "depth"] for which in ["min", "avg", "max"]]
        rows += [f"leaves with N = {n}" for n in range(5)] + ["leaves with N > 4", "optimized nodes"]
        self.assertEqual(names[: len(rows)], rows)
        second = next(number for number, line in enumerate(lines) if line.startswith("wide tree"))
        reference, wide = lines[:second], lines[second:]
        self.assertIn("the engine's choice", wide[0])
        rows = "nodes leaves levels".split() + ["fill of nodes", "fill of leaves", "overlap of siblings", "bytes per sphere"]
        for name in rows:
            self.assertIn(name, [line[:26].strip() for line in wide])
        values = {line[:26].strip(): line[26:].strip() for line in reference[1:]}
        self.assertEqual(values["inner nodes"], "4,095")
        self.assertEqual(values["leaves with N = 1"], "100.00 %")
        self.assertEqual(values["bytes, total"], "114,700")


if __name__ == "__main__":
    main()
