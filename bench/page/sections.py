"""The sections of docs/performance.md: each makes lines of Markdown and charts of one part's report."""

import re

import svg
import targets
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
    """The scene, and of a molecule the file, without its folders."""
    return re.sub(r"\(.*/(.*)\)", r"(\1)", result["input"])


def worst(results, scenes, kinds):
    """The lowest ratio, and where: (ratio, scene, kind)."""
    found = [(ratio(results[s], k), s, k) for s in scenes if s in results for k in kinds if ratio(results[s], k)]
    return min(found, default=(None, "", ""))


def lowest_cell(value, scene, kind):
    return "" if value is None else f"{times(value)} ({scene}, {targets.TITLES[kind]})"


def summary(report):
    """Every target of the engine against the worst that was measured."""
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
        rows.append([" ".join(scenes), "bytes a sphere, at most", f"{ceiling} ({aim})", cell, cell, said])
    return rows


def scene_rows(results, kinds):
    """A line a scene: ours and, in brackets, Embree's, with the ratio; what misses its floor is marked."""
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


BUILD_HEADS = ["scene", "again", "from nothing", "bytes a sphere", "peak MB", "nodes", "levels", "picture ms"]


def build_section(title, results):
    """Build times, memory and a whole picture of each scene."""
    lines = [
        f"### {title}",
        "",
        "Milliseconds, in brackets Embree's: again in the memory of the tree before (Embree's faster way of both is in",
        "brackets), and from nothing. Bytes a sphere are all that tracing needs; the peak is what the first build added to the",
        "process's memory at most (below a megabyte it is not seen). The picture: 1024 x 1024 pixels with what the scene says of",
        "mirrors and plane, shadows, recursion 5 (where empty, it was not measured).",
        "",
    ]
    return lines + table(BUILD_HEADS, build_rows(results))


def rays_of_calls(results):
    """How many rays a call had, in words."""
    tiles = [result["tile"] for result in results]
    if not isinstance(tiles[0], dict):
        return f"A call has up to {max(tiles):,} rays."
    most = {kind: max(tile.get(kind, 0) for tile in tiles) for kind in targets.KINDS}
    others = max(most[kind] for kind in targets.KINDS if kind != "random")
    return f"A call has up to {others:,} rays, of random ones up to {most['random']:,}: those are sorted first where it pays."


def ratio_chart(results, title, kinds, target_of):
    panels = []
    for kind in kinds:
        bars = [(scene, ratio(result, kind), *target_of(scene, kind)) for scene, result in results.items()]
        panels.append((targets.TITLES[kind], bars))
    return svg.bar_panels(title, panels)


def scenes(report, _reports):
    lines = ["## Against Embree", ""]
    first = report["runs"][0]["result"]
    lines += [
        f"The nine scenes, with one thread and two, against Embree {first['peer']['version']} in the same process. Its spheres are",
        "points with radii; each kind of ray is tried one at a time and in packets of 4, 8 and 16, each with and without its",
        "flag for coherent rays, and the fastest counts. Its rays lie ready in its own layout, packets as squares of pixels;",
        "ours are set up, sorted and written out within the time. Where a ray leaves a sphere, ours skip that sphere, and",
        "Embree's start 0.001 radii later.",
        "",
        "s1 s2 s3: 4096 spheres of radius 1 (grid, corners, both). mol: PDB entry 1TII; mol5: 5 x 5 x 5 copies. u1e5 u1e6 u1e7:",
        "uniform, a tenth of the cube filled. c1e6: a million spheres in eight corners. Rays: 1024 x 1024 primary in blocks of 8 x 8",
        "pixels; as many random ones; from what the primary rays hit to the light; mirrored one to three times; from what those of",
        "bounce 2 and 3 hit to the light.",
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
        lines += ['Floor and aim, and the worst of each group of scenes. "Floors missed" below says why.', ""]
        lines += table(["scenes", "what", "floor (aim)", "lowest, 1 thread", "lowest, 2 threads", ""], summary(report))
    charts = {}
    for threads in (1, 2):
        found = by_scene(report, threads)
        if not found:
            continue
        words = f"{threads} thread" + ("s" if threads > 1 else "")
        lines += [f"### Rays, {words}", "", "Million rays a second, in brackets Embree's, and the ratio.", ""]
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


def avx2(report, _reports):
    lines = ["## AVX2", "", "Both restricted to AVX2. The floors are for all nine scenes; the shadows of mirrors have none."]
    lines += ['"Floors missed" below says which are not met, and why.', ""]
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


def pictures(report, _reports):
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
        "(Tachyon: ray depth 5). Milliseconds: the picture as radiance; with its bytes; what Tachyon says of its tracing.",
        f"The floor is {floor}x, the aim {aim}x.",
        "",
    ]
    heads = ["scene", "primary", "shadow", "reflected", "radiance", "bytes too", "Tachyon", "ratio", ""]
    title = "Whole pictures, times as fast as Tachyon: floor as a stroke, aim dashed"
    charts = {"pictures.svg": svg.bar_panels(title, [("whole pictures", bars)], 1)}
    return lines + table(heads, rows) + picture("pictures.svg", title), charts


def thesis(report, _reports):
    result = report["runs"][0]["result"]
    floor, aim = targets.THESIS_FPS
    rows, bars = [], []
    for found in result["configurations"]:
        said = "aim met" if found["fps"] >= aim else verdict(found["fps"], floor)
        name = f"scenario {found['scenario']}, {found['spheres']} spheres"
        rows.append([name, number(found["render_ms"]), number(found["fps"]), number(found["fps_with_bytes"]), said])
        bars.append((f"{found['scenario']}: {found['spheres']}", found["fps"], floor, aim))
    lines = [
        "## The thesis's nine configurations",
        "",
        f"1136 x 640 pixels, primary rays, shaded, {result['threads']} threads; the thesis's best was 60 frames a second. The floor is",
        f"{floor}, the aim {aim}. A frame is the picture as radiance; the last column turns it into bytes too.",
        "",
    ]
    lines += table(["configuration", "ms", "frames a second", "with bytes", ""], rows)
    title = "Frames a second by scenario and spheres: floor as a stroke, aim dashed"
    charts = {"thesis_frames.svg": svg.bar_panels(title, [("frames a second", bars)], 1)}
    return lines + picture("thesis_frames.svg", title), charts


def growth(report, reports):
    runs = [run["result"] for run in report["runs"]]
    if "huge" in reports:
        runs += [run["result"] for run in reports["huge"]["runs"]]
    rows = []
    for r in runs:
        rows.append(
            [
                f"{r['spheres']:,}",
                number(r["build_ms"]),
                number(r["build_ms"] * 1e6 / r["spheres"]),
                number(r["bytes_per_sphere"]),
                number(r["build_peak_bytes"] / 1e6),
                number(r["mray_per_s"]["primary"]),
                number(r["mray_per_s"]["random"]),
            ]
        )
    n_log_n = [(r["spheres"], r["build_ms"]) for r in runs]
    first = runs[0]
    scale = first["build_ms"] / (first["spheres"] * len(str(first["spheres"])))
    guide = [(n, scale * n * len(str(n))) for n, _ in n_log_n]
    lines = [
        "## Growth",
        "",
        f"Uniform spheres that fill a tenth of the cube, {first['threads']} threads. The peak is what the first build of the process added to",
        "its memory at most (tree and working memory, not the set itself; below a megabyte it is not seen). Rays in millions a second.",
        "",
    ]
    heads = ["spheres", "build ms", "ns a sphere", "bytes a sphere", "peak MB", "primary", "random"]
    charts = {
        "growth_build.svg": svg.log_lines(
            "Build time", "spheres", "ms", [("build", n_log_n, False), ("n log n", guide, True)]
        ),
        "growth_rays.svg": svg.log_lines(
            "Rays",
            "spheres",
            "million a second",
            [(k, [(r["spheres"], r["mray_per_s"][k]) for r in runs], False) for k in ("primary", "random")],
        ),
    }
    lines += table(heads, rows)
    return lines + picture("growth_build.svg", "Build time") + picture("growth_rays.svg", "Rays by spheres"), charts


def rebuild(report, _reports):
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
        f"Every sphere moves a little in each frame; {result['threads']} threads. Milliseconds of the first build, of the new sphere set, and",
        "of a build in the memory of the tree before; bytes a sphere of tree and working memory together.",
        "",
    ]
    heads = ["scene", "spheres", "first build", "set", "build", "builds a second", "bytes held"]
    return lines + table(heads, rows), {}


def wasm(report, _reports):
    runs = report["runs"]
    native = [run["result"] for run in runs if not run["command"].startswith("node ")]
    web = [run["result"] for run in runs if run["command"].startswith("node ")]
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
        f"The whole pictures above, natively and under node, two threads, in turn. At most {targets.WASM}x the native time is allowed.",
        "",
    ]
    return lines + table(["scene", "native ms", "WebAssembly ms", "times as long", "", "same picture"], rows), {}


def gpu(report, _reports):
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
        f"One frame of 640 x 360 pixels, one sample each, with what the scene says of recursion and shadows, by {', '.join(sorted(devices))}.",
        "With `llvmpipe` the graphics processor is this machine's CPU, pretending: what is seen is that the shader works and what it costs",
        "there. Beside it the CPU engine on the same cores.",
        "",
    ]
    heads = ["scene", "spheres", "GPU ms", "frames a second", "Mray/s of all kinds", "CPU ms"]
    return lines + table(heads, rows), {}


def page(report, _reports):
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
        f"What a visitor downloads, in MB, molecule and all; at most {targets.PAGE_MB} compressed.",
        "",
        *table(["module", "raw", "gzip", "brotli", ""], rows),
        f"The first picture of the molecule is on the screen of Chromium {measured['chromium']} after {number(first)} ms, the median of",
        f"{len(measured['first_picture_ms'])} visits with nothing cached ({targets.FIRST_PICTURE_MS} allowed: {verdict(first, targets.FIRST_PICTURE_MS, at_most=True)}).",
        "",
        "After a key press the scene turns. How long until every pixel is drawn again, with one sample, and what the page says while keys",
        "are pressed all the time (it then draws fewer pixels, so that a frame keeps to its budget). WebGL2 is SwiftShader's: drawn by the",
        "CPU, and the GPU engine works as it would on a graphics processor.",
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
    ("pictures", pictures),
    ("thesis", thesis),
    ("growth", growth),
    ("rebuild", rebuild),
    ("wasm", wasm),
    ("gpu", gpu),
    ("page", page),
]
