"""Sphinx's settings for `scripts/docs`: the project's own Markdown pages as one static site."""

import os
import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]

project = "bihive"
author = "the authors of bihive"
copyright = "the authors of bihive; MIT licence"  # noqa: A001
extensions = ["myst_parser", "sphinx.ext.autodoc"]
root_doc = "docs/site/index"
html_theme = "furo"
html_title = "bihive"
html_static_path = []
html_copy_source = False
html_show_sphinx = False
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page may begin with a second-level heading

# The pages; everything else of the project is left alone.
PAGES = ["README.md", "HACKING.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "data/README.md", "bench/README.md", "web/viewer/README.md", "src/bihive/wide/README.md"]
include_patterns = [*PAGES, "docs/*.md", "docs/decisions/*.md", "docs/gallery/README.md", "docs/cookbook/README.md", "docs/thesis/README.md", "thesis/README.md"]
include_patterns += ["docs/tutorial/*.md", "docs/site/*.md", "docs/site/*.rst"]

# The reference of Python comes from the built package's docstrings, where scripts/docs found one.
NAMES = TOP / "docs/site/names"


def write_pages_of_names():
    """A page for each public name of the package; those of former names go."""
    import bihive

    names = [name for name in bihive.__all__ if not name.startswith("_")]
    NAMES.mkdir(exist_ok=True)
    for page in NAMES.glob("*.rst"):
        if page.stem not in names:
            page.unlink()
    for name in names:
        is_class = isinstance(getattr(bihive, name), type)
        lines = [name, "=" * len(name), "", f".. {'autoclass' if is_class else 'autofunction'}:: bihive.{name}"]
        lines += ["   :members:", "   :show-inheritance:"] if is_class else []
        text = "\n".join([*lines, ""])
        page = NAMES / f"{name}.rst"
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")


sys.path.insert(0, str(TOP / "docs/site"))
import c_reference  # noqa: E402

c_reference.write_pages(TOP / "bindings/c/bihive.h", TOP / "docs/site/c_names")
include_patterns.append("docs/site/c_names/*.rst")

package = os.environ.get("BIHIVE_PYTHON_PACKAGE", "")
if package:
    sys.path.insert(0, package)
    write_pages_of_names()
    include_patterns.append("docs/site/names/*.rst")
else:
    exclude_patterns = ["docs/site/python_reference.rst"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"


def mend_links(_app, _name, source):
    """Links to folders become plain code, since a site has no page for them; but the decisions have one."""
    source[0] = re.sub(r"\]\(((?:[./\w-]*/)?decisions)/?\)", r"](\1/README.md)", source[0])
    source[0] = re.sub(r"\[([^\]]+)\]\(([./\w-]*/)?(data|scripts|tests|web|apps)(/[\w-]+)?/?\)", r"`\3\4`", source[0])


def as_plain_text(_app, _what, _name, _obj, _options, lines):
    """Docstrings are plain text, made for help(): the first paragraph stays text, the rest keeps its lines."""
    end = next((i for i, line in enumerate(lines) if not line.strip()), len(lines))
    rest = lines[end:]
    if any(line.strip() for line in rest):
        lines[end:] = ["", ".. code-block:: text", "", *("   " + line for line in rest), ""]


def setup(app):
    app.connect("autodoc-process-docstring", as_plain_text)
    app.connect("source-read", mend_links)
