"""The part ranks of scripts/bench: ranks of mpirun, two hosts with a limited network, and simulated ranks."""

import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "films"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import hosts  # noqa: E402
import inputs  # noqa: E402

SIZE = "1920x1080"
LOOKS = {
    "primary": ["--style", "plain", "--no-shadows", "--recursion", "1"],
    "shadow": ["--style", "plain", "--shadows", "--recursion", "1"],
    "mirrors": ["--style", "plain", "--no-shadows", "--material", "metal", "--recursion", "4"],
    "default": [],
}
CLOUD = 10_000_000
TREES = [10_000, 100_000, 1_000_000, CLOUD]  # the work of a ray by the spheres of a tree
RANKS = [1, 2, 4, 8]
SIMULATED = [1, 2, 4, 16, 64, 256, 1024]
RATES = [None, 10, 1, 0.1]  # Gbit a second
LATENCY_US = 50


def marked(run, **marks):
    return {**run, **marks}


def of_ranks(bench, count, scene, words, enter=(), options=()):
    """One picture of distributed spheres, with the memory of each rank."""
    peaks = bench.out / "peaks"
    peaks.unlink(missing_ok=True)
    picture = os.path.relpath(bench.out / "ranks.png")
    command = [*enter, "mpirun", *options, "--oversubscribe", "--bind-to", "none", "-n", count, "bench/ranks/peak.py", peaks]
    if os.geteuid() == 0:
        os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    command += [bench.program("bihive-mpi"), "render", scene, "-o", picture, "--size", SIZE, "--threads", 1, "--json"]
    run = bench.run(*command, "--distribute", *words)
    return marked(run, ranks=count, peak_bytes=sorted(int(line) for line in peaks.read_text().split()))


def measure(bench):
    bench.fetch_molecule()
    data = bench.out / "data"
    quick = bench.quick
    cloud = inputs.cloud(data, 10_000 if quick else CLOUD)
    melt = inputs.melt(data, cells=10 if quick else 63, frames=1)
    looks = {"primary": LOOKS["primary"]} if quick else LOOKS
    runs = []

    # One process: how the work of rays grows with the tree.
    for count in [1000] if quick else TREES:
        scene = inputs.cloud(data, count)
        for look in ("primary", "default") if not quick else looks:
            words = ["render", scene, "-o", os.path.relpath(bench.out / "one.png"), "--size", SIZE, "--threads", 1, "--json"]
            runs.append(marked(bench.run(bench.program("bihive"), *words, *LOOKS[look]), what="tree", scene="cloud", look=look))

    # Ranks of this machine: memory and time.
    for count in [1, 2] if quick else RANKS:
        runs.append(marked(of_ranks(bench, count, cloud, LOOKS["primary"]), what="memory", scene="cloud", look="primary"))

    # Two hosts.
    if hosts.can_make():
        for rate in [1] if quick else RATES:
            with hosts.two(bench.out, rate) as (enter, options):
                for look, words in looks.items():
                    run = of_ranks(bench, 2, cloud, words, enter, options)
                    runs.append(marked(run, what="hosts", scene="cloud", look=look, gbit_per_s=rate))
    else:
        print("scripts/bench: no network namespaces for this user, so no two hosts", file=sys.stderr)

    # Simulated ranks.
    def simulate(scene, name, look, ranks, rate):
        words = [",".join(map(str, ranks)), "--rate", rate, "--latency", LATENCY_US, "render", scene, "-o", "no.png"]
        run = bench.run(bench.program("bihive-ranks"), *words, "--size", SIZE, *LOOKS[look])
        if not all(one["same_bits"] for one in run["result"]["simulated"]):
            sys.exit(f"scripts/bench: other bits than those of one process: {run['command']}")
        runs.append(marked(run, what="simulated", scene=name, look=look))

    for look in looks:
        simulate(cloud, "cloud", look, [1, 16] if quick else SIMULATED, 10)
    if quick:
        return runs
    for look in ("primary", "default"):
        simulate(melt, "melt", look, SIMULATED, 10)
        if bench.molecule:
            simulate(bench.molecule, "molecule", look, SIMULATED, 10)
    for rate in RATES[2:]:
        for look in looks:
            simulate(cloud, "cloud", look, [2], rate)
    return runs
