"""Pages of bihive.h for the site: one for each function or type, and one that lists them by groups."""

import pathlib
import re


def text_of(comment):
    """The lines of a comment without its stars."""
    inner = comment.strip()[2:-2]
    return "\n".join(re.sub(r"^\s*\* ?", "", line).rstrip() for line in inner.splitlines()).strip()


def marked_up(text):
    """Paragraphs and items stay what they are; names of the header become code."""
    blocks = []
    for line in text.splitlines():
        bare = line.strip()
        if not bare:
            blocks.append("")
        elif bare.startswith("- "):
            blocks += ["", bare]
        elif blocks and blocks[-1]:
            indent = "  " if any(one.startswith("- ") for one in last_paragraph(blocks)) else ""
            blocks.append(indent + bare)
        else:
            blocks.append(bare)
    made = re.sub(r"(?<!\w)\*(?=\w)", r"\\*", "\n".join(blocks).strip())
    made = re.sub(r"`([^`\n]+)`", r"``\1``", made)
    made = re.sub(r"(?<![`\w])((?:bihive_\w+|BIHIVE_\w+)\*?(?:\(\))?)", r"``\1``", made)
    return made


def last_paragraph(blocks):
    found = []
    for line in reversed(blocks):
        if not line:
            break
        found.append(line)
    return found


def declarations(text):
    """(name, declaration, comment) for each, and in between ("", title, ""): a group begins. A declaration without a comment of
    its own has that of the one before."""
    comment = ""
    at = 0
    while at < len(text):
        rest = text[at:]
        if match := re.match(r"\s+", rest):
            at += match.end()
        elif match := re.match(r"/\* -+ (.*?) -+ \*/", rest):
            yield "", match[1], ""
            comment = ""
            at += match.end()
        elif match := re.match(r"/\*.*?\*/", rest, re.S):
            comment = text_of(match[0])
            at += match.end()
        elif match := re.match(r"#.*|extern \"C\" \{|\}", rest):
            at += match.end()
        else:
            # Up to the semicolon outside of braces, and the comment behind it on its line.
            depth = end = 0
            for end, letter in enumerate(rest):
                depth += {"{": 1, "}": -1}.get(letter, 0)
                if letter == ";" and depth == 0:
                    break
            end += 1 + len(re.match(r"[ \t]*(/\*[^\n]*\*/)?", rest[end + 1 :])[0])
            declaration = rest[:end].strip()
            shown = declaration.replace("BIHIVE_API ", "")
            before = shown.split("{")[0]
            if match := re.match(r"typedef int \(\*(\w+)\)", shown):
                name = match[1]
            elif shown.startswith("typedef struct"):
                name = re.search(r"(\w+);$", shown.split("/*")[0] if "{" not in shown else shown)[1]
            elif shown.startswith("enum"):
                name = re.search(r"BIHIVE_\w+", shown)[0]
            else:
                name = re.search(r"(bihive_\w+)\(", before)[1]
            yield name, shown, comment
            at += end


def write_pages(header, folder):
    """Returns the names. Pages of former names go."""
    whole = header.read_text(encoding="utf-8")
    contract, rest = whole.split("#ifndef BIHIVE_H", 1)
    pages = {}
    groups = [("Version and errors", [])]
    for name, shown, comment in declarations(rest.split('extern "C" {', 1)[1]):
        if not name:
            groups.append((shown, []))
            continue
        groups[-1][1].append(name)
        code = "\n".join("   " + line for line in shown.splitlines())
        pages[name] = f"{name}\n{'=' * len(name)}\n\n.. code-block:: c\n\n{code}\n\n{marked_up(comment)}\n\nIn ``bihive.h``, :doc:`{groups[-1][0].lower()} <index>`.\n"
    lines = ["The C library, name by name", "===========================", "", marked_up(text_of(contract)), ""]
    for title, names in groups:
        lines += [title, "-" * len(title), "", ".. toctree::", "   :maxdepth: 1", "", *("   " + name for name in names), ""]
    pages["index"] = "\n".join(lines)
    folder.mkdir(exist_ok=True)
    for page in folder.glob("*.rst"):
        if page.stem not in pages:
            page.unlink()
    for name, text in pages.items():
        page = folder / f"{name}.rst"
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")
    return [name for name in pages if name != "index"]


if __name__ == "__main__":
    top = pathlib.Path(__file__).resolve().parents[2]
    print("\n".join(write_pages(top / "bindings/c/bihive.h", top / "docs/site/c_names")))
