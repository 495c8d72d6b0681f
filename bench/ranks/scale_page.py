"""Makes docs/scale.md and its charts from docs/scale/ranks.json."""

import math

import markdown
import origin
import svg
from model import Model

RANKS = [16, 64, 256, 1024, 4096]
SPHERES = {1e9: "10^9", 1e10: "10^10", 1e12: "10^12"}
LOOKS = ["primary", "shadow", "mirrors", "default"]
SCENES = {"cloud": "10 million spheres at random", "melt": "a melt of a million atoms", "molecule": "a molecule of 5,684 atoms"}

HEAD = """\
# Beyond this machine: a model of many ranks

This page is generated; nothing in it is written by hand. Two commands make it:

```sh
scripts/bench ranks            # measures; needs mpirun, and the right to make network namespaces for the two hosts
scripts/scale_page out/bench   # writes this page, its charts and docs/scale/ranks.json
```

It says what pictures of distributed spheres (`bihive-mpi render --distribute`, [many_machines.md](many_machines.md)) would take on up to 4,096 ranks. Nobody here has so
many: points are measured or simulated, lines are the model, and the page says which is which. A rank has one core; one with more does its work on all of them, and its network is
the same. Timings of two runs differ by ten percent and more.
"""

SIMULATION = """\
All ranks of a simulation are in one process, which takes their parts in turn: it distributes the spheres, draws each tile by the code of its rank, and lets the others
answer. So rays, messages and bytes are counted, not estimated, and each picture has the bits of one process. The clock of a rank goes on by the time of its work here; a question takes
the latency of the network, its bytes at the rate, and the work of the answer. The next tile goes to the thread that is free first; a rank has two. Many ranks may write to
one at the same time; the simulation adds up the bytes of that one, and the picture takes at least as long as they take.
"""

MEMORY = (
    "Leave a third free: arrays grow by doubling, so memory grows in steps. 200 million spheres on 4 ranks took up to 4.35 GB per rank ([many_machines.md](many_machines.md)), where the line says @LINE@."
)

LIMITS = """\
- The rank nearest to the eye gets most rays: beyond some hundred ranks it sets the time, and more ranks make memory smaller but hardly the picture faster. A larger picture, or
  ambient occlusion, has more work to share.
- Tiles have 64 x 16 pixels at least, so a picture of 1920 x 1080 has 2,040, and no more threads draw than that.
- The set-up supposes a file system that gives each rank its part as fast as this machine's memory does, and a network between all ranks at the full rate.
- The work of a ray in a tree of more spheres than were measured goes on as the last two points do.
"""


def number_of(value):
    return f"{round(value):,}"


def memory_section(model):
    measured = [(run["ranks"], max(run["peak_bytes"]) / 1e9) for run in model.of("memory")]
    rows = [
        [run["ranks"], f"{max(run['peak_bytes']) / 1e9:.2f}", f"{model.memory(model.spheres, run['ranks']) / 1e9:.2f}"]
        for run in model.of("memory")
    ]
    lines = [
        "## Memory of a rank",
        "",
        f"{number_of(model.spheres)} spheres at random, an NPY file of binary32; the peak of the largest rank, measured (`ru_maxrss`) and by the line through these points: "
        f"{model.memory_base / 1e6:.0f} MB and {model.memory_of_sphere:.0f} bytes for each sphere of the rank.",
        "",
        *markdown.table(["ranks", "measured, GB", "line, GB"], rows),
        MEMORY.replace("@LINE@", f"{model.memory(2e8, 4) / 1e9:.1f}"),
        "",
        "The model, in GB per rank:",
        "",
        *markdown.table(
            ["spheres", *(f"{ranks:,} ranks" for ranks in RANKS)],
            [[name, *(f"{model.memory(spheres, ranks) / 1e9:,.1f}" for ranks in RANKS)] for spheres, name in SPHERES.items()],
        ),
    ]
    series = [(f"{model.spheres:.0e}".replace("e+0", "e") + " measured", measured, False)]
    series += [
        (f"{spheres:.0e}".replace("e+", "e").replace("e0", "e"), [(ranks, model.memory(spheres, ranks) / 1e9) for ranks in RANKS], True)
        for spheres in SPHERES
    ]
    series.append(("", [(ranks, model.memory(model.spheres, ranks) / 1e9) for ranks in [1, 2, 4, 8, 16]], True))
    return lines + chart("memory.svg", "Memory of a rank"), {"memory.svg": svg.log_lines("Memory of a rank, model dashed", "ranks", "GB", series)}


def chart(name, words):
    return [f"![{words}](scale/{name})", ""]


def hosts_section(model):
    runs = model.of("hosts")
    if not runs:
        return ["## Two hosts", "", "Not measured: the user could not make network namespaces.", ""], {}
    rows, series = [], []
    for look in dict.fromkeys(run["look"] for run in runs):
        points = []
        for run in [run for run in runs if run["look"] == look]:
            rate, result = run["gbit_per_s"], run["result"]
            simulated = dict(model.simulated("cloud", look, rate)).get(2) if rate else None
            rows.append(
                [
                    look,
                    f"{rate:g}" if rate else "no limit",
                    number_of(result["render_ms"]),
                    number_of(simulated) if simulated else "",
                    number_of(result["exchange"]["messages"]),
                    f"{result['exchange']['bytes'] / 1e6:,.0f}",
                ]
            )
            if rate:
                points.append((rate, result["render_ms"]))
        series.append((look, sorted(points), False))
        series.append(("", sorted((rate, ms) for rate, _ in points for n, ms in model.simulated("cloud", look, rate) if n == 2), True))
    lines = [
        "## Two hosts, and a network with a limit",
        "",
        "Two network namespaces of this machine are the hosts, with an Ethernet between them whose rate `tc` limits; one rank of one thread on each. The simulation of two ranks takes the "
        "same rate, with a latency of 50 us.",
        "",
        *markdown.table(["rays", "Gbit/s", "measured, ms", "simulated, ms", "messages", "MB"], rows),
        *ratios(model, runs),
    ]
    series = [one for one in series if one[1]]
    return lines + chart("hosts.svg", "Two hosts"), {"hosts.svg": svg.log_lines("Two hosts, simulation dashed", "Gbit/s", "ms", series)}


def ratios(model, runs):
    """What the simulation leaves out, in numbers."""
    quick, slow = [], []
    for run in runs:
        rate = run["gbit_per_s"]
        simulated = dict(model.simulated("cloud", run["look"], rate)).get(2) if rate else None
        if simulated:
            (quick if rate >= 1 else slow).append(run["result"]["render_ms"] / simulated)
    if not quick:
        return []
    words = f"Measured times are {min(quick):.2f} to {max(quick):.2f} of the simulated ones with 1 Gbit/s and more: the simulation has no threads that change places on a core, and no work of MPI."
    if slow:
        words += f" With less they are {min(slow):.2f} to {max(slow):.2f}: the rank that waits least draws most tiles, and the simulation cannot know the waiting before it has drawn a tile."
    return [words, ""]


def simulation_section(model):
    most_rows, growth_rows, series = [], [], []
    for run in sorted(model.of("simulated"), key=lambda run: (list(SCENES).index(run["scene"]), list(LOOKS).index(run["look"]))):
        result = run["result"]
        most = max(result["simulated"], key=lambda one: one["ranks"])
        if most["ranks"] < 16:
            continue
        name = run["scene"], run["look"]
        most_rows.append(
            [
                f"{name[0]}, {name[1]}",
                f"{most['rays'] / 1e6:.1f} M",
                f"{most['asked'] / most['rays']:.2f}",
                f"{most['bytes'] / most['rays']:.1f}",
                number_of(most["messages"]),
                f"{number_of(most['messages_of_rank']['mean'])}; {number_of(most['messages_of_rank']['largest'])}",
                f"{most['bytes_of_rank']['mean'] / 1e6:.1f}; {most['bytes_of_rank']['largest'] / 1e6:.0f}",
            ]
        )
        growth_rows.append([f"{name[0]}, {name[1]}", number_of(result["render_ms"]), *(number_of(one["simulated_ms"]) for one in result["simulated"])])
        if name[1] == "default":
            series.append((name[0], [(one["ranks"], one["simulated_ms"]) for one in result["simulated"]], False))
    ranks = [one["ranks"] for one in model.of("simulated", scene="cloud")[0]["result"]["simulated"]]
    scenes = "; ".join(f"*{name}* is {words}" for name, words in SCENES.items())
    lines = [
        f"## {ranks[-1]:,} simulated ranks",
        "",
        *SIMULATION.splitlines(),
        "",
        f"{scenes}. *primary*: `--style plain --no-shadows --recursion 1`; *shadow* has the shadow rays too, *mirrors* is metal with `--recursion 4`; *default* is the default style, "
        "with 64 directions of ambient occlusion. 1920 x 1080.",
        "",
        f"Counted with {ranks[-1]:,} ranks; of a rank the mean and the largest:",
        "",
        *markdown.table(["scene, rays", "rays", "ranks per ray", "bytes per ray", "messages", "messages of a rank", "MB of a rank"], most_rows),
        "Milliseconds of the picture, with 10 Gbit/s and 50 us; the first column is one process with all spheres, on one core:",
        "",
        *markdown.table(["scene, rays", "one process", *(f"{count:,} ranks" if count > 1 else "1 rank" for count in ranks)], growth_rows),
    ]
    for spheres in SPHERES:
        series.append((f"{spheres:.0e}".replace("e+", "e").replace("e0", "e"), [(n, model.picture_ms("default", spheres, n)) for n in RANKS], True))
    for run in model.of("hosts", look="default", gbit_per_s=10):
        series.append(("two hosts", [(2, run["result"]["render_ms"])], False))
    return lines + chart("picture.svg", "Time of a picture"), {"picture.svg": svg.log_lines("Picture, default style; model dashed", "ranks", "ms", series)}


def model_section(model):
    def rows(of):
        return [[name, *(of(spheres, ranks) for ranks in RANKS)] for spheres, name in SPHERES.items()]

    heads = ["spheres", *(f"{ranks:,} ranks" for ranks in RANKS)]
    lines = [
        "## The model's times",
        "",
        f"Until the picture begins (read, exchange, tree): {model.setup_of_sphere_s * 1e9:.0f} ns of a core for each sphere of a rank, as one rank has it with {number_of(model.spheres)} "
        f"spheres, and {model.sent_of_sphere:.0f} bytes for each sphere at 10 Gbit/s. In seconds:",
        "",
        *markdown.table(heads, rows(lambda spheres, ranks: f"{model.setup_s(spheres, ranks):,.1f}")),
    ]
    for look in ("primary", "default"):
        lines += [
            f"The picture (*{look}*), in seconds: the simulation with {number_of(model.spheres)} spheres, times the work of a ray in a tree of a rank's number of spheres, over that in the "
            "smaller tree, both by one process. Beyond the simulated ranks it goes on as the last two points do.",
            "",
            *markdown.table(heads, rows(lambda spheres, ranks, look=look: f"{model.picture_ms(look, spheres, ranks) / 1000:,.2f}")),
        ]
    work = [
        [f"{run['result']['spheres']:,}", run["look"], number_of(run["result"]["render_ms"])] for run in sorted(model.of("tree"), key=lambda run: run["look"])
    ]
    lines += ["The work of a picture by the spheres of a tree, in milliseconds of one core:", "", *markdown.table(["spheres", "rays", "ms"], work)]
    return [*lines, "## Limits", "", *LIMITS.splitlines(), ""], {}


def summary(model):
    """How many ranks a set needs."""
    fits = (16e9 * 2 / 3 - model.memory_base) / model.memory_of_sphere
    return (
        f"**In short**: take enough ranks for the set to fit into their memory. A rank with 16 GB takes some {fits / 1e6:,.0f} million spheres, with a third left free; so 10^9 spheres need "
        f"{math.ceil(1e9 / fits)} such ranks, 10^10 {math.ceil(1e10 / fits)}, 10^12 {math.ceil(1e12 / fits):,}. More ranks make the picture faster up to some hundred ranks."
    )


def files_of(report):
    """Name below docs -> content."""
    model = Model(report)
    lines = [*HEAD.splitlines(), "", summary(model), "", *origin.lines_of(report)]
    files = {}
    for section in (memory_section, hosts_section, simulation_section, model_section):
        body, charts = section(model)
        lines += body
        files.update({f"scale/{name}": content for name, content in charts.items()})
    lines += markdown.commands_block(report)
    files["scale.md"] = "\n".join(lines).rstrip() + "\n"
    return files
