"""docs/performance.md and its charts, made of docs/performance/*.json alone."""

import json

import sections
from markdown import commands_block


def load(folder):
    """What scripts/bench measured: part -> report."""
    reports = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))}
    return {name: report for name, report in reports.items() if report.get("part") == name}


def head(reports):
    lines = ["# Performance: what was measured", ""]
    lines += ["Every number on this page was measured by", "", "```sh"]
    lines += ["make bench                             # writes out/bench/*.json"]
    lines += ["scripts/performance_page out/bench     # writes this page, its charts and docs/performance/*.json"]
    lines += ["```", ""]
    machines = {json.dumps(report["machine"], sort_keys=True): report["machine"] for report in reports.values()}
    for machine in machines.values():
        vectors = {"avx512f": "AVX-512", "avx2": "AVX2", "sse4_1": "SSE4"}.get(machine["vectors"], machine["vectors"])
        lines.append(
            f"on {machine['processor']}, {machine['cpus']} cores, {vectors}, caches {machine['l1d']}, {machine['l2']}, "
            f"{machine['l3']}; {machine['memory_gb']} GB; {machine['system']}; {machine['compiler']}."
        )
    dates = sorted({f"{report['date']} at commit {report['commit']}" for report in reports.values()})
    lines += [f"Measured {', '.join(dates)}.", ""]
    lines += [
        "Timings of two runs differ by ten percent and more; what counts are the ratios, of jobs that took turns in one",
        "process (Tachyon: one after the other). Each number is a median. Every answer has the bits of the scalar",
        "reference ([precision.md](precision.md)); Embree and Tachyon calculate in binary32.",
        "",
    ]
    return lines


def files_of(kept, notes):
    """Name below docs -> content."""
    reports = load(kept)
    files = {}
    lines = head(reports)
    for name, make in sections.SECTIONS:
        if name not in reports:
            continue
        section, charts = make(reports[name], reports)
        files.update({f"performance/{chart}": content for chart, content in charts.items()})
        lines += [*section, *commands_block(reports[name])]
    if notes.is_file():
        lines += [notes.read_text(encoding="utf-8").rstrip(), ""]
    files["performance.md"] = "\n".join(lines).rstrip() + "\n"
    return files
