"""The origin of a table's numbers: one machine and one commit, with date and command.

A report of scripts/bench names its machine and its commit, and so does the output of the measured programs. A report merged
from several machines, commits or instruction sets is refused.
"""

VECTORS = {"avx512f": "AVX-512", "avx2": "AVX2", "sse4_1": "SSE4"}
TARGETS = {"avx512": "AVX-512", "avx2": "AVX2", "sse4": "SSE4", "neon": "NEON", "scalar": "plain C++"}


class Mixed(Exception):
    """A report whose runs do not belong in one table."""


def values_of(report, key):
    """The values of the report and its runs under `key`, where present."""
    said = [report.get(key), *(run.get(key) for run in report["runs"])]
    return [value for value in said if value]


def results_of(report, key):
    """The values that the measured programs printed under `key`; not every program prints it."""
    results = [run["result"] for run in report["runs"]]
    return [result[key] for result in results if isinstance(result, dict) and result.get(key)]


def only(values, name, what):
    """The one value; an error that names them all where there are several."""
    different = sorted({str(value) for value in values})
    if len(different) > 1:
        raise Mixed(f"{name}: its runs come from more than one {what}: {', '.join(different)}; measure it again in one go")
    return different[0] if different else ""


def check(name, report):
    """Raises Mixed unless the whole report comes from one machine, one commit and one instruction set."""
    commit = only([*values_of(report, "commit"), *results_of(report, "commit")], name, "commit")
    if commit.endswith("-dirty"):
        raise Mixed(f"{name}: measured at {commit}, which is no commit; commit the changes and measure it again")
    only(values_of(report, "machine"), name, "machine")
    only([report["machine"]["processor"], *results_of(report, "machine")], name, "machine")
    only(results_of(report, "target"), name, "instruction set")


def target_of(report):
    """The instruction set that ran, or an empty text if the programs do not state it."""
    targets = results_of(report, "target")
    return targets[0] if targets else ""


def lines_of(report):
    """Lines below a section's title: machine, commit, date, command."""
    machine = report["machine"]
    caches = ", ".join(f"{name} {machine[key]}" for name, key in (("L1d", "l1d"), ("L2", "l2"), ("L3", "l3")) if key in machine)
    vectors = VECTORS.get(machine["vectors"], machine["vectors"])
    target = target_of(report)
    seconds = sum(run["seconds"] for run in report["runs"])
    lines = [
        f"- Machine: {machine['processor']}, {machine['cpus']} cores with {vectors}; caches: {caches}; {machine['memory_gb']} GB; "
        f"{machine['system']}; {machine['compiler']}"
    ]
    if target:
        lines.append(f"- Instruction set of this run: {TARGETS.get(target, target)}")
    return [
        *lines,
        f"- Commit: {report['commit']}",
        f"- Date: {report['date']}",
        f"- Command: `{report.get('command', 'scripts/bench ' + report['part'])}` ({seconds:.0f} s)",
        "",
    ]
