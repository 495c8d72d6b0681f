"""Makes docs/performance.md and its charts from docs/performance/*.json."""

import json

import origin
import sections
from markdown import commands_block


def load(folder):
    """The reports of scripts/bench: part -> report. Raises origin.Mixed where a report is not of one machine and commit."""
    reports = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))}
    names = dict(sections.SECTIONS)
    reports = {name: report for name, report in reports.items() if report.get("part") == name and name in names}
    for name, report in reports.items():
        origin.check(f"{name}.json", report)
    return reports


HEAD = """\
# Performance: what was measured

This page is generated; nothing in it is written by hand. Two commands make it:

```sh
make bench                             # measures; writes out/bench/*.json
scripts/performance_page out/bench     # writes this page, its charts and docs/performance/*.json
```

Each section states its machine, commit, date and command.
[performance_findings.md](performance_findings.md) says what was tried, where the time goes and why a floor is missed.

Timings of two runs differ by ten percent and more. The ratios count: both programs took turns in one process (Tachyon: one
program after the other). Each number is a median. Every answer has the bits of the scalar reference
([precision.md](precision.md)); Embree and Tachyon calculate in binary32.
"""


def files_of(reports):
    """Name below docs -> content."""
    files = {}
    lines = HEAD.splitlines() + [""]
    for name, make in sections.SECTIONS:
        if name not in reports:
            continue
        section, charts = make(reports[name])
        files.update({f"performance/{chart}": content for chart, content in charts.items()})
        title, *body = section
        lines += [title, "", *origin.lines_of(reports[name]), *body[1:], *commands_block(reports[name])]
    files["performance.md"] = "\n".join(lines).rstrip() + "\n"
    return files
