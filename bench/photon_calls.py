#!/usr/bin/python3
"""Photons beside Embree, by the number of rays per call: mirrored rays, as a program traces them that has few at a time.

usage: bench/photon_calls.py [BUILD [SCENE...]]        BUILD holds bihive-bench, which needs Embree (scripts/setup bench)

Calls of 1, 64, 1,024 and 32,768 rays, mirrored once to three times in each scene (scenario1, scenario3 and the bundled molecule),
one thread, both programs in one process in turn. For each number of rays the ratio to Embree's fastest way: the lowest, the median and
the highest of all.
"""

import json
import pathlib
import statistics
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[1]
KINDS = ["mirror1", "mirror2", "mirror3"]
CALLS = [1, 64, 1024, 32768]

build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build-release")
scenes = sys.argv[2:] or ["scenario1", "scenario3", str(TOP / "data/1hpv.pdb")]
for rays in CALLS:
    ratios = {}
    for scene in scenes:
        command = [build / "bihive-bench", scene, "--peer", "embree", "--threads", "1", "--only", ",".join(KINDS), "--call", str(rays), "--json"]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
        for kind, ratio in json.loads(done.stdout)["ratio"].items():
            if kind in KINDS and ratio is not None:
                ratios[f"{pathlib.Path(scene).stem} {kind}"] = ratio
    low, high = min(ratios, key=ratios.get), max(ratios, key=ratios.get)
    median = statistics.median(ratios.values())
    print(f"{rays} rays per call: {median:.2f} times Embree ({ratios[low]:.2f} {low}, {ratios[high]:.2f} {high})", flush=True)
