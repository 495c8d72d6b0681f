"""Tables, numbers and blocks of commands in Markdown."""


def table(heads, rows):
    """Lines of a table; the first column to the left, the others to the right."""
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" + "---:|" * (len(heads) - 1)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return [*lines, ""]


def number(value):
    """Three significant digits, without an exponent."""
    if value is None:
        return ""
    if value >= 100:
        return f"{value:,.0f}"
    if value >= 10:
        return f"{value:.1f}"
    return f"{value:.2f}"


def times(value):
    return "" if value is None else number(value) + "x"


def picture(name, words):
    return [f"![{words}](performance/{name})", ""]


def commands_block(report):
    """The programs that a section's command ran, collapsed."""
    commands = list(dict.fromkeys(run["command"] for run in report["runs"]))
    words = "The program that this command ran" if len(commands) == 1 else f"The {len(commands)} programs that this command ran"
    return [f"<details><summary>{words}</summary>", "", "```sh notest", *commands, "```", "", "</details>", ""]


def verdict(value, floor, at_most=False):
    """Met, or missed by how much of the floor (or, at most, above the ceiling)."""
    if value is None:
        return "not measured"
    good = value <= floor if at_most else value >= floor
    if good:
        return "met"
    return f"missed by {abs(value / floor - 1) * 100:.0f} %"
