"""The sections of docs/performance.md: each makes lines of Markdown and charts of one report."""

import pathlib
import re
import statistics
import sys

import svg
import targets

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "cliffs"))

import worst as worst_sets  # noqa: E402
from markdown import number, picture, table, times, verdict


def by_scene(report, threads=None):
    """Scene -> result, in the order of the scenes."""
    found = {}
    for run in report["runs"]:
        result = run["result"]
        if threads is None or result["threads"] == threads:
            found[result["input"].split()[0]] = result
    return {scene: found[scene] for scene in targets.SCENES if scene in found}


def ratio(result, kind):
    return (result.get("ratio") or {}).get(kind)


def title_of(result):
    """The scene; for a molecule also the name of its file."""
    return re.sub(r"\(.*/(.*)\)", r"(\1)", result["input"])


def worst(results, scenes, kinds):
    """The lowest ratio, and where: (ratio, scene, kind)."""
    found = [(ratio(results[s], k), s, k) for s in scenes if s in results for k in kinds if ratio(results[s], k)]
    return min(found, default=(None, "", ""))


def lowest_cell(value, scene, kind):
    return "" if value is None else f"{times(value)} ({scene}, {targets.TITLES[kind]})"


def summary(report):
    """Every target of the engine beside the worst measured value."""
    columns = [
        ("primary", ["primary"]),
        ("random", ["random"]),
        ("first shadow", ["shadow"]),
        ("mirror 1 to 3", ["mirror1", "mirror2", "mirror3"]),
        ("their shadows", ["mirror_shadow2", "mirror_shadow3"]),
        ("build", ["build"]),
    ]
    one, two = by_scene(report, 1), by_scene(report, 2)
    rows = []
    for scenes in targets.GROUPS:
        for title, kinds in columns:
            floor, aim = targets.ratio_target(scenes[0], kinds[0])
            lows = [worst(results, scenes, kinds) for results in (one, two)]
            values = [low[0] for low in lows if low[0] is not None]
            said = verdict(min(values, default=None), floor)
            if said == "met" and min(values) >= aim:
                said = "aim met"
            rows.append([" ".join(scenes), title, f"{floor}x ({aim}x)", *(lowest_cell(*low) for low in lows), said])
        held = [(one[s]["bytes_per_sphere"], s) for s in scenes if s in one]
        most = max(held, default=(None, ""))
        ceiling, aim = targets.BYTES
        cell = "" if most[0] is None else f"{number(most[0])} ({most[1]})"
        said = verdict(most[0], ceiling, at_most=True)
        if most[0] is not None and most[0] <= aim:
            said = "aim met"
        rows.append([" ".join(scenes), "bytes per sphere, at most", f"{ceiling} ({aim})", cell, cell, said])
    return rows


def scene_rows(results, kinds):
    """A line for each scene: our rate, Embree's in brackets, and the ratio."""
    rows = []
    for result in results.values():
        row = [title_of(result), f"{result['spheres']:,}"]
        for kind in kinds:
            value = ratio(result, kind)
            if value is None:
                row.append("")
                continue
            ours, theirs = result["mray_per_s"][kind], result["peer"]["mray_per_s"][kind]
            row.append(f"{number(ours)} ({number(theirs)}) **{times(value)}**")
        rows.append(row)
    return rows


def build_rows(results):
    rows = []
    for result in results.values():
        peer = result["peer"]
        rows.append(
            [
                title_of(result),
                f"{number(result['build_ms'])} ({number(peer['build_ms'])}) **{times(ratio(result, 'build'))}**",
                f"{number(result['build_fresh_ms'])} ({number(peer['build_fresh_ms'])}) "
                f"**{times(ratio(result, 'build_fresh'))}**",
                f"{number(result['bytes_per_sphere'])} ({number(peer['bytes_per_sphere'])})",
                number(result["build_peak_bytes"] / 1e6),
                f"{result['nodes']:,}",
                result["levels"],
                number(result["frame_ms"]) if result.get("frame_ms") else "",
            ]
        )
    return rows


BUILD_HEADS = ["scene", "again", "from nothing", "bytes per sphere", "peak MB", "nodes", "levels", "picture ms"]


def build_section(title, results):
    """Build times, memory and a whole picture of each scene."""
    lines = [
        f"### {title}",
        "",
        "Milliseconds, with Embree's in brackets. \"Again\" builds in the memory of the previous tree (in brackets: Embree's faster",
        "way of both); \"from nothing\" takes new memory. Bytes per sphere are all that tracing needs. The peak is the memory that the",
        "first build added at most; a peak below a megabyte is not seen. The picture has 1024 x 1024 pixels, the scene's own mirrors",
        "and plane, shadows and recursion 5; an empty field was not measured.",
        "",
    ]
    return lines + table(BUILD_HEADS, build_rows(results))


def rays_of_calls(results):
    """A sentence about the number of rays per call."""
    tiles = [result["tile"] for result in results]
    if not isinstance(tiles[0], dict):
        return f"A call has up to {max(tiles):,} rays."
    most = {kind: max(tile.get(kind, 0) for tile in tiles) for kind in targets.KINDS}
    others = max(most[kind] for kind in targets.KINDS if kind != "random")
    return f"A call has up to {others:,} rays, of random ones up to {most['random']:,}."


def ratio_chart(results, title, kinds, target_of):
    panels = []
    for kind in kinds:
        bars = [(scene, ratio(result, kind), *target_of(scene, kind)) for scene, result in results.items()]
        panels.append((targets.TITLES[kind], bars))
    return svg.bar_panels(title, panels)


def scenes(report):
    lines = ["## Against Embree", ""]
    first = report["runs"][0]["result"]
    lines += [
        f"The nine scenes with one thread and with two, beside Embree {first['peer']['version']} in the same process. Embree's spheres are",
        "points with radii. Each kind of ray is given to Embree one at a time and in packets of 4, 8 and 16, each with and without",
        "the flag for coherent rays; the fastest way counts. Embree's rays lie ready in its own layout, packets as squares of pixels.",
        "Our time includes the set-up, the sorting and the output of the rays. A ray of ours that starts on a sphere skips that sphere;",
        "Embree's ray starts 0.001 radii later.",
        "",
        "Scenes: s1 s2 s3 have 4096 spheres of radius 1 (grid, corners, both): the thesis's scenarios, with 320 pairs of equal spheres in s3; in records",
        "from before 30 November 2026 the corners are larger and no spheres are equal. mol is PDB entry 1TII, mol5 is 5 x 5 x 5 copies of it.",
        "u1e5 u1e6 u1e7 are uniform and fill a tenth of the cube. c1e6 has a million spheres in eight corners.",
        "",
        "Rays: primary rays are those of 1024 x 1024 pixels, in blocks of 8 x 8 pixels; there are as many random rays. First shadow",
        "rays go to the light from what the primary rays hit. Mirror 1 to 3 are rays mirrored once to three times. Shadows of mirror",
        "2 and 3 go to the light from what those rays hit.",
        "",
    ]
    results = [r["result"] for r in report["runs"]]
    lines += [rays_of_calls(results), ""]
    compared = sum(sum(r["rays"].values()) for r in results)
    lines += [
        f"Of {compared:,} rays, {sum(r['mismatches'] for r in results)} answers of ours were wrong and "
        f"{sum(r['peer_wrong'] for r in results)} of Embree's, judged in binary64 where the two differ.",
        "",
    ]
    if first["target"] == "avx512":
        lines += ["### The targets", ""]
        lines += ["Floor and aim, and the lowest ratio in each group of scenes.", ""]
        lines += table(["scenes", "what", "floor (aim)", "lowest, 1 thread", "lowest, 2 threads", ""], summary(report))
    charts = {}
    for threads in (1, 2):
        found = by_scene(report, threads)
        if not found:
            continue
        words = f"{threads} thread" + ("s" if threads > 1 else "")
        lines += [f"### Rays, {words}", "", "Million rays per second, Embree's in brackets, and the ratio.", ""]
        lines += table(["scene", "spheres", *(targets.TITLES[k] for k in targets.KINDS)], scene_rows(found, targets.KINDS))
        name = f"ratios_{threads}.svg"
        title = f"Times as fast as Embree, {words}: floor as a stroke, aim dashed"
        charts[name] = ratio_chart(found, title, [*targets.KINDS, "build"], targets.ratio_target)
        lines += picture(name, title)
        lines += build_section(f"Build and memory, {words}", found)
        if threads == 1:
            rows = [[s, *(r["peer"]["mode"].get(k, "") for k in targets.KINDS)] for s, r in found.items()]
            lines += ["Embree's fastest mode, by rays in a packet:", ""]
            lines += table(["scene", *(targets.TITLES[k] for k in targets.KINDS)], rows)
    return lines, charts


def avx2(report):
    lines = ["## AVX2", "", "Both restricted to AVX2. The floors are for all nine scenes; the shadows of mirrors have none."]
    lines += [""]
    lines += [rays_of_calls([run["result"] for run in report["runs"]]), ""]
    by_threads = {n: by_scene(report, n) for n in (1, 2)}
    by_threads = {n: found for n, found in by_threads.items() if found}
    rows = []
    for kind, floor in targets.AVX2.items():
        lows = [worst(found, list(found), [kind]) for found in by_threads.values()]
        cells = [lowest_cell(*low) for low in lows]
        rows.append([targets.TITLES[kind], f"{floor}x", *cells, verdict(min((low[0] for low in lows if low[0]), default=None), floor)])
    words = [f"{n} thread" + ("s" if n > 1 else "") for n in by_threads]
    lines += table(["rays", "floor", *(f"lowest, {w}" for w in words), ""], rows)
    charts = {}
    for (n, found), word in zip(by_threads.items(), words):
        kinds = [kind for kind in targets.KINDS if any(ratio(result, kind) for result in found.values())]
        lines += [f"### AVX2, {word}", ""]
        lines += table(["scene", "spheres", *(targets.TITLES[k] for k in kinds)], scene_rows(found, kinds))
        title = f"Times as fast as Embree on AVX2, {word}: floor as a stroke"
        name = f"ratios_avx2_{n}.svg"
        charts[name] = ratio_chart(found, title, kinds, lambda _, kind: (targets.AVX2.get(kind), None))
        lines += picture(name, title)
        lines += build_section(f"AVX2: build and memory, {word}", found)
    return lines, charts


def light_rows(results):
    rows = []
    for result in results:
        ours, theirs = result["mray_per_s"], result["peer"]["mray_per_s"]
        floor_random, floor_shared = targets.AMBIENT[result["scene"]]
        beside_random, beside_shared = ours["ao"] / theirs["ao_random"], ours["ao"] / theirs["ao"]
        own = ratio(result, "ao_random")
        met = beside_random >= floor_random and beside_shared >= floor_shared and own >= targets.AMBIENT_OWN
        rows.append(
            [
                title_of(result),
                result["ao_distance"] or "any",
                result["threads"],
                number(ours["ao"]),
                f"{number(theirs['ao_random'])} **{times(beside_random)}** ({floor_random}x)",
                f"{number(theirs['ao'])} **{times(beside_shared)}** ({floor_shared}x)",
                f"{number(ours['ao_random'])} **{times(own)}** ({targets.AMBIENT_OWN}x)",
                "met" if met else "missed",
            ]
        )
    return rows


def light(report):
    results = [run["result"] for run in report["runs"]]
    lines = [
        "## Ambient occlusion",
        "",
        "Rays from the hits of 1024 x 1024 primary rays, in millions per second, by Embree's best mode each. bihive's renderer uses",
        "directions shared by all shading points: eight of its 64 are measured. Embree gets random directions, by cosine, different ones",
        "for each shading point, as in a path tracer; and the same shared ones. Floors in brackets.",
        "",
    ]
    heads = ["scene", "distance", "threads", "bihive, shared", "Embree, random", "Embree, shared", "bihive, random", ""]
    return lines + table(heads, light_rows(results)), {}


BOUND_TITLES = {**targets.TITLES, "ao": "ambient, shared", "ao_random": "ambient, random", "comb": "comb"}


def floor_of(scene, kind):
    own = {"ao": targets.AMBIENT_SHARED, "ao_random": targets.AMBIENT_OWN, "comb": targets.COMB}
    return own.get(kind) or targets.ratio_target(scene, kind)[0]


def bound(report):
    lines = [
        "## Rays beside a bound",
        "",
        "One thread. The bound is the rate of an engine that tests each ray by itself against this tree, sixteen boxes or spheres at a",
        "time, knows where to look, and whose vector ports never wait: for memory, for the next node's address, or for the schedule. \"Proof\"",
        "counts the nodes and leaves that an oracle which knows the answer must still open, by which the bound goes; \"in order\" counts those of a",
        "search from near to far. The rest of the time goes into the search, waiting and bookkeeping. Beams share tests among rays, so",
        "shadow rays and ambient occlusion along shared directions may exceed it. Bytes are those of nodes, spheres, rays and answers, per ray, each",
        "read once. Comb: parallel rays, row by row.",
        "",
    ]
    heads = ["scene", "rays", "bihive", "beside Embree", "floor", "bound", "reached", "nodes: proof", "in order", "leaves: proof", "in order", "bytes"]
    rows = []
    for run in report["runs"]:
        result = run["result"]
        scene = result["input"].split()[0]
        for kind, least in result["bound"].items():
            rate, beside, floor = result["mray_per_s"][kind], ratio(result, kind), floor_of(scene, kind)
            rows.append(
                [
                    scene,
                    BOUND_TITLES[kind],
                    number(rate),
                    f"**{times(beside)}**",
                    f"{floor}x: {verdict(beside, floor)}",
                    number(least["mray_per_s"]),
                    f"{100 * rate / least['mray_per_s']:.0f} %",
                    *(number(least[key]) for key in ("nodes", "nodes_in_order", "leaves", "leaves_in_order", "bytes")),
                ]
            )
    return lines + table(heads, rows), {}


def cliffs(report):
    results = [run["result"] for run in report["runs"]]
    rows = worst_sets.cliffs(results)
    kinds = list(dict.fromkeys(row[0] for row in rows))
    wrong = sum(result["mismatches"] for result in results)
    lines = [
        "## Hostile sets",
        "",
        f"{len(results)} sets of up to {max(result['spheres'] for result in results):,} spheres: hostile ones, and such as people have (`bench/cliffs/sets.py`), one thread, all kinds of rays beside",
        f"Embree. A kind is at a cliff where it is below {worst_sets.FLOOR} times Embree's speed, or below a quarter of the median of all sets;",
        f"[performance_findings.md](performance_findings.md) has the reasons. Wrong answers: {wrong}.",
        "",
    ]
    by_kind = []
    for kind in kinds:
        of_kind = [row for row in rows if row[0] == kind]
        lowest = min((row for row in of_kind if row[3] is not None), key=lambda row: row[3], default=None)
        median = statistics.median(row[2] for row in of_kind)
        by_kind.append(
            [
                BOUND_TITLES[kind],
                number(median),
                f"{of_kind[0][1]}: {number(of_kind[0][2])} ({of_kind[0][4]:.2f})",
                "" if lowest is None else f"{lowest[1]}: {times(lowest[3])}",
                sum(row[3] is not None and row[3] < worst_sets.FLOOR for row in of_kind),
                sum(row[4] < worst_sets.SHARE for row in of_kind),
            ]
        )
    lines += table(["rays", "median Mray/s", "slowest set (share of the median)", "lowest beside Embree", "below the floor", "below a quarter"], by_kind)
    lines += ["All sets: the lowest ratio to Embree and the lowest share of the median, each with its kind of rays.", ""]
    sets = []
    for result in results:
        of_set = [row for row in rows if row[1] == result["set"]]
        beside = min((row for row in of_set if row[3] is not None), key=lambda row: row[3], default=None)
        share = min(of_set, key=lambda row: row[4])
        sets.append(
            [
                result["set"],
                f"{result['spheres']:,}",
                number(result["bytes_per_sphere"]),
                number(1e6 * result["build_ms"] / result["spheres"]),
                times(ratio(result, "build")),
                "" if beside is None else f"{'**' * (beside[3] < worst_sets.FLOOR)}{times(beside[3])}{'**' * (beside[3] < worst_sets.FLOOR)} ({BOUND_TITLES[beside[0]]})",
                f"{'**' * (share[4] < worst_sets.SHARE)}{share[4]:.2f}{'**' * (share[4] < worst_sets.SHARE)} ({BOUND_TITLES[share[0]]})",
            ]
        )
    lines += table(["set", "spheres", "bytes per sphere", "build ns per sphere", "build beside Embree", "lowest beside Embree", "lowest share"], sets)
    return lines, {}


def pictures(report):
    result = report["runs"][0]["result"]
    floor, aim = targets.PICTURE
    rows, bars = [], []
    for scene, facts in result["scenes"].items():
        rays = facts["rays"]
        said = verdict(facts["ratio"], floor)
        said = "aim met" if facts["ratio"] >= aim else said
        rows.append(
            [
                scene,
                *(f"{rays[kind]:,}" for kind in ("primary", "shadow", "reflected")),
                number(facts["render_ms"]),
                number(facts["all_ms"]),
                number(facts["tachyon_ms"]),
                f"**{times(facts['ratio'])}**",
                said,
            ]
        )
        bars.append((scene, facts["ratio"], floor, aim))
    lines = [
        "## Whole pictures against Tachyon",
        "",
        f"1024 x 1024 pixels, {result['threads']} threads: spheres of reflection 0.3 over a plane, one light, shadows, recursion 5",
        "(Tachyon: ray depth 5). Columns 2 to 4 count rays. Columns 5 to 7 are milliseconds: the picture as radiance, the picture with",
        "its bytes, and the time that Tachyon prints for its tracing.",
        f"The floor is {floor}x, the aim {aim}x.",
        "",
    ]
    heads = ["scene", "primary", "shadow", "reflected", "radiance", "bytes too", "Tachyon", "ratio", ""]
    title = "Whole pictures, times as fast as Tachyon: floor as a stroke, aim dashed"
    charts = {"pictures.svg": svg.bar_panels(title, [("whole pictures", bars)], 1)}
    return lines + table(heads, rows) + picture("pictures.svg", title), charts


def occlusion(report):
    result, programs = report["runs"][0]["result"], report["runs"][1:]
    rows = []
    for scene, facts in result["scenes"].items():
        floor, aim = targets.OCCLUSION[scene]
        said = "aim met" if facts["ratio"] >= aim else verdict(facts["ratio"], floor)
        rays = (f"{facts['rays'][kind] / 1e6:.1f}" for kind in ("primary", "ambient", "shadow"))
        rows.append([scene, *rays, number(facts["all_ms"]), number(facts["tachyon_ms"]), f"**{times(facts['ratio'])}**", f"{floor}x", said])
    seconds = statistics.median(run["seconds"] for run in programs)
    rays = programs[0]["result"]["rays"]["ambient"] / 1e6
    lines = [
        "## Ambient occlusion against Tachyon",
        "",
        f"1280 x 720 pixels, 4 samples each, {result['threads']} threads, in the style `default`: ambient occlusion, soft shadows,",
        "outlines and fog. Tachyon uses 64 random directions per hit, bihive those of 128 shared ones that are in front of the",
        "surface. Columns 2 to 4 count millions of bihive's rays. Tachyon's light casts hard shadows: one shadow ray where bihive has",
        "six. Milliseconds are those of the picture with its bytes, and those that Tachyon prints for its tracing.",
        "",
        f"The whole program, `{programs[0]['command']}`, from file to PNG with {rays:.1f} million rays of ambient occlusion: {seconds:.2f} s,",
        f"median of {len(programs)} (aim {targets.FILE_TO_PNG_S} s).",
        "",
    ]
    heads = ["scene", "primary", "ambient", "shadow", "bihive", "Tachyon", "ratio", "floor", ""]
    return lines + table(heads, rows), {}


def thesis(report):
    result = report["runs"][0]["result"]
    floor = next((fps for name, fps in targets.THESIS_FLOORS.items() if result.get("target", "").startswith(name)), None)
    aim = targets.THESIS_AIM
    rows, bars = [], []
    for found in result["configurations"]:
        fps = found["fps_with_bytes"]
        said = "aim met" if fps >= aim else verdict(fps, floor) if floor else ""
        name = f"scenario {found['scenario']}, {found['spheres']} spheres"
        rows.append([name, number(found["render_ms"]), number(found["fps"]), number(fps), said])
        bars.append((f"{found['scenario']}: {found['spheres']}", fps, floor, aim))
    lines = [
        "## The thesis's nine configurations",
        "",
        f"1136 x 640 pixels, primary rays, shaded, {result['threads']} threads; the thesis's best was 60 frames per second, its",
        f"display's limit. The floor is {floor or 'not set'} with bytes on these vectors, the aim {aim}. A frame is the picture as radiance; \"with bytes\"",
        "turns it into those of a screen. `scripts/shown_frames` counts what a window and a page show.",
        "",
    ]
    lines += table(["configuration", "ms", "frames per second", "with bytes", ""], rows)
    title = "Frames per second with bytes, by scenario and spheres: floor as a stroke, aim dashed"
    charts = {"thesis_frames.svg": svg.bar_panels(title, [("frames per second with bytes", bars)], 1)}
    return lines + picture("thesis_frames.svg", title), charts


GROWTH_HEADS = ["spheres", "build ms", "ns per sphere", "bytes per sphere", "peak MB", "primary", "random"]


def growth_words(threads):
    return [
        f"Uniform spheres that fill a tenth of the cube, {threads} threads. The peak is the memory that the first build of the process",
        "added at most: tree and working memory, not the set itself. A peak below a megabyte is not seen. Rays in millions per second.",
        "",
    ]


def growth_rows(results):
    return [
        [
            f"{r['spheres']:,}",
            number(r["build_ms"]),
            number(r["build_ms"] * 1e6 / r["spheres"]),
            number(r["bytes_per_sphere"]),
            number(r["build_peak_bytes"] / 1e6),
            number(r["mray_per_s"]["primary"]),
            number(r["mray_per_s"]["random"]),
        ]
        for r in results
    ]


def growth(report):
    runs = [run["result"] for run in report["runs"]]
    n_log_n = [(r["spheres"], r["build_ms"]) for r in runs]
    first = runs[0]
    scale = first["build_ms"] / (first["spheres"] * len(str(first["spheres"])))
    guide = [(n, scale * n * len(str(n))) for n, _ in n_log_n]
    charts = {
        "growth_build.svg": svg.log_lines(
            "Build time", "spheres", "ms", [("build", n_log_n, False), ("n log n", guide, True)]
        ),
        "growth_rays.svg": svg.log_lines(
            "Rays",
            "spheres",
            "million per second",
            [(k, [(r["spheres"], r["mray_per_s"][k]) for r in runs], False) for k in ("primary", "random")],
        ),
    }
    lines = ["## Growth", "", *growth_words(first["threads"]), *table(GROWTH_HEADS, growth_rows(runs))]
    return lines + picture("growth_build.svg", "Build time") + picture("growth_rays.svg", "Rays by spheres"), charts


def huge(report):
    """A table of its own: it may be measured on another machine than the smaller sets."""
    runs = [run["result"] for run in report["runs"]]
    lines = ["## A hundred million spheres", "", *growth_words(runs[0]["threads"])]
    return lines + table(GROWTH_HEADS, growth_rows(runs)), {}


def rebuild(report):
    result = report["runs"][0]["result"]
    rows = [
        [
            scene,
            f"{facts['spheres']:,}",
            number(facts["first_build_ms"]),
            number(facts["set_ms"]),
            number(facts["build_ms"]),
            number(facts["builds_per_s"]),
            number(facts["held_bytes"] / facts["spheres"]),
        ]
        for scene, facts in result["scenes"].items()
    ]
    lines = [
        "## A new tree for every frame",
        "",
        f"Every sphere moves a little in each frame; {result['threads']} threads. The columns are milliseconds of the first build, of the new",
        "sphere set, and of a build in the memory of the previous tree; and bytes per sphere of tree and working memory together.",
        "",
    ]
    heads = ["scene", "spheres", "first build", "set", "build", "builds per second", "bytes held"]
    return lines + table(heads, rows), {}


def film_rows(runs):
    rows = []
    for run in runs:
        facts = run["result"]
        style = run["command"].split(" --style ")[1].split()[0]
        parts = [number(facts[f"{part}_ms"] / facts["drawn"]) for part in ("read", "build", "trace", "write")]
        rows.append([style, facts["drawn"], number(facts["pictures_per_s"]), *parts, number(facts["peak_memory_bytes"] / 1e6)])
    return rows


def film(report):
    runs = {"film": [], "memory": [], "frames": [], "render": []}
    for run in report["runs"]:
        kind = run["command"].split("bihive")[1].split()[0]
        if kind == "film":
            kind = "memory" if "--frames" in run["command"] else "film"
        runs["frames" if kind == "-frames" else kind].append(run)
    beside = runs["frames"][0]["result"]
    found = next(iter(beside["styles"].values()))
    lines = [
        "## Films",
        "",
        f"A Lennard-Jones melt of {found['spheres']:,} atoms, a LAMMPS dump with velocities, 1280 x 720 pixels, 4 samples each, to an MP4 file. Reading,",
        "building, tracing and writing overlap; their milliseconds per picture are listed separately. The last column is the peak of memory in MB.",
        "",
        *table(["style", "pictures", "pictures per second", "read", "build", "trace", "write", "MB"], film_rows(runs["film"])),
        f"One picture of the same beside Tachyon, {beside['threads']} threads: milliseconds with the picture's bytes, and those that Tachyon prints for its",
        "tracing. Tachyon casts hard shadows and draws neither outlines nor fog; with ambient occlusion it uses as many directions.",
        "",
    ]
    rows = [
        [style, number(facts["all_ms"]), number(facts["tachyon_ms"]), f"**{times(facts['ratio'])}**"]
        for style, facts in beside["styles"].items()
    ]
    lines += table(["style", "bihive", "Tachyon", "ratio"], rows)
    lines += ["Memory does not grow with the length of a film (small pictures of a small melt):", ""]
    rows = [[run["result"]["drawn"], number(run["result"]["peak_memory_bytes"] / 1e6)] for run in runs["memory"]]
    lines += table(["pictures", "peak MB"], rows)
    lines += [
        "Large files from disk to a PNG file, 1280 x 720 pixels, 4 samples each, in the style `plain`: seconds of the whole program, and",
        "milliseconds of its parts; medians. The last column is the peak of memory in bytes per sphere.",
        "",
    ]
    by_file = {}
    for run in runs["render"]:
        by_file.setdefault(run["result"]["scene"].rsplit("/", 1)[-1], []).append(run)
    rows = []
    for name, some in by_file.items():
        middle = sorted(some, key=lambda run: run["seconds"])[len(some) // 2]
        facts = middle["result"]
        parts = [number(facts[f"{part}_ms"]) for part in ("read", "build", "render", "write")]
        peak = number(facts["peak_memory_bytes"] / facts["spheres"])
        rows.append([f"`{name}`", f"{facts['spheres']:,}", number(middle["seconds"]), *parts, peak])
    return lines + table(["file", "spheres", "seconds", "read", "build", "render", "write", "bytes per sphere"], rows), {}


def is_node(run):
    return " node " in " " + run["command"]


def wasm(report):
    runs = report["runs"]
    native = [run["result"] for run in runs if not is_node(run)]
    web = [run["result"] for run in runs if is_node(run)]
    rows = []
    for scene in native[0]:
        ours = sorted(r[scene]["render_ms"] for r in native)[len(native) // 2]
        theirs = sorted(r[scene]["render_ms"] for r in web)[len(web) // 2]
        same = len({r[scene]["hash"] for r in native + web}) == 1
        said = verdict(theirs / ours, targets.WASM, at_most=True)
        rows.append([scene, number(ours), number(theirs), f"**{times(theirs / ours)}**", said, "yes" if same else "NO"])
    lines = [
        "## WebAssembly",
        "",
        "The scenes of the whole pictures, by the native program and by WebAssembly under node in turn, two threads. WebAssembly may",
        f"take at most {targets.WASM} times as long.",
        "",
    ]
    return lines + table(["scene", "native ms", "WebAssembly ms", "times as long", "", "same picture"], rows), {}


def gpu(report):
    found = {}
    for run in report["runs"]:
        scene = run["command"].split(" render ")[1].split(" --engine ")[0]
        found.setdefault(scene, {}).setdefault(run["result"]["engine"], []).append(run["result"])
    rows, devices = [], set()
    for scene, engines in found.items():
        ours = {name: sorted(results, key=lambda r: r["render_ms"])[len(results) // 2] for name, results in engines.items()}
        graphics, processor = ours["gpu"], ours["wide"]
        devices.add(graphics["gpu"])
        rows.append(
            [
                scene,
                f"{graphics['spheres']:,}",
                number(graphics["render_ms"]),
                number(1000 / graphics["render_ms"]),
                number(graphics["mray_per_s"]),
                number(processor["render_ms"]),
            ]
        )
    lines = [
        "## The graphics processor",
        "",
        f"One frame of 640 x 360 pixels, one sample per pixel, recursion and shadows as the scene has them, by {', '.join(sorted(devices))}.",
        "`llvmpipe` is a driver that runs shaders on this machine's CPU: its figures show that the shader works, not how fast a graphics",
        "processor is. The last column is the CPU engine on the same cores.",
        "",
    ]
    heads = ["scene", "spheres", "GPU ms", "frames per second", "Mray/s of all kinds", "CPU ms"]
    return lines + table(heads, rows), {}


def page(report):
    sizes, measured = (run["result"] for run in report["runs"])
    rows = []
    for variant, (raw, gzip, brotli) in sizes.items():
        name = "with threads" if variant == "threads" else "without threads"
        cells = [f"{size / 1e6:.2f}" for size in (raw, gzip, brotli)]
        rows.append([name, *cells, verdict(gzip / 1e6, targets.PAGE_MB, at_most=True)])
    first = sorted(measured["first_picture_ms"])[len(measured["first_picture_ms"]) // 2]
    lines = [
        "## The page",
        "",
        f"The download of a visitor in MB, with the molecule; at most {targets.PAGE_MB} compressed with gzip.",
        "",
        *table(["module", "raw", "gzip", "brotli", ""], rows),
        f"The first picture of the molecule is on the screen of Chromium {measured['chromium']} after {number(first)} ms, the median of",
        f"{len(measured['first_picture_ms'])} visits with nothing cached ({targets.FIRST_PICTURE_MS} allowed: {verdict(first, targets.FIRST_PICTURE_MS, at_most=True)}).",
        "",
        "A key press turns the scene. The third column is the time until every pixel is drawn again with one sample. The next columns are",
        "what the page shows while keys are pressed all the time; it then draws fewer pixels, so that a frame keeps to its budget. WebGL2",
        "is SwiftShader, which draws on the CPU.",
        "",
    ]
    rows = [
        [
            name.upper(),
            " x ".join(f"{side:g}" for side in facts["size"]),
            number(facts["at_rest_ms"]),
            facts["while_turning"]["rate"],
            facts["while_turning"]["size"].rsplit(" · ", 1)[0],
        ]
        for name, facts in measured["engines"].items()
    ]
    return lines + table(["engine", "pixels", "ms until at rest", "while turning", "with pixels"], rows), {}


SECTIONS = [
    ("scenes", scenes),
    ("avx2", avx2),
    ("light", light),
    ("bound", bound),
    ("cliffs", cliffs),
    ("pictures", pictures),
    ("occlusion", occlusion),
    ("thesis", thesis),
    ("growth", growth),
    ("huge", huge),
    ("rebuild", rebuild),
    ("film", film),
    ("wasm", wasm),
    ("gpu", gpu),
    ("page", page),
]
