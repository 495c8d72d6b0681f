"""The programs of a moved installation: help, and all files that they look for beside themselves.

Usage: installed_programs.py PREFIX

The page is looked at where `make web` had built it; elsewhere a stand-in takes its place, so that at least the place
is right.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import urllib.request
import xml.etree.ElementTree

PREFIX = pathlib.Path(sys.argv[1]).resolve()
PAGE = PREFIX / "share/bihive/web"
# Without the user's own settings.
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "LC_ALL": "C.UTF-8"}


def bihive(*arguments, code=0):
    program = [PREFIX / "bin/bihive", *arguments]
    done = subprocess.run(program, cwd="/", env=ENVIRONMENT, capture_output=True, text=True, timeout=600)
    assert done.returncode == code, (arguments, done.returncode, done.stderr)
    return done.stdout + done.stderr


def fetch(address):
    with urllib.request.urlopen(address, timeout=600) as answer:
        return answer.headers, answer.read()


def test_help():
    for command in ("", "render", "film", "view", "stats", "trace", "scene", "info", "styles", "thesis", "web"):
        text = bihive(*command.split(), "--help")
        assert "Usage:" in text or "usage:" in text, (command, text)


def test_window():
    """Without a screen the window cannot open. A missing window program would give another message."""
    text = bihive("view", "demo", code=3)
    if (PREFIX / "bin/bihive-view").exists():
        assert "no window can be opened here" in text, text
    else:
        assert "the program bihive-view is not installed" in text, text


def test_page():
    real = (PAGE / "index.html").exists()
    print("page:", "as it was built" if real else "a stand-in, for none was built")
    if not real:
        assert "scripts/build_web" in bihive("web", code=3) or "make web" in bihive("web", code=3)
        PAGE.mkdir(parents=True)
        (PAGE / "index.html").write_text("<!doctype html><title>a stand-in</title>")
    server = subprocess.Popen(
        [PREFIX / "bin/bihive", "web", "demo", "--port", "0", "--no-browser", "--json"],
        cwd="/",
        env=ENVIRONMENT,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        url = json.loads(server.stdout.readline())["url"]
        headers, index = fetch(url)
        assert headers["Cross-Origin-Embedder-Policy"] == "require-corp", headers
        assert index == (PAGE / "index.html").read_bytes()
        files = [path for path in sorted(PAGE.rglob("*")) if path.is_file() and path.name != "start.json"]
        assert not real or {"bihive.wasm", "bihive.js"} <= {path.name for path in files}, files
        for path in files:
            _, body = fetch(f"{url.rstrip('/')}/{path.relative_to(PAGE).as_posix()}")
            assert body == path.read_bytes(), path
    finally:
        server.terminate()
        server.wait()


def test_manual_and_completion():
    """Manual pages for every command, completions, and what a desktop wants to know."""
    share = PREFIX / "share"
    for command in bihive("describe", "commands").split():
        page = (share / f"man/man1/bihive-{command}.1").read_text()
        assert page == bihive("describe", "man", command), command
    assert (share / "man/man1/bihive.1").read_text() == bihive("describe", "man")
    for shell, place in (
        ("bash", "bash-completion/completions/bihive"),
        ("zsh", "zsh/site-functions/_bihive"),
        ("fish", "fish/vendor_completions.d/bihive.fish"),
    ):
        assert (share / place).read_text() == bihive("describe", shell), shell


def test_desktop():
    """The desktop file starts the window, and each type that it names is a type of the database's."""
    share = PREFIX / "share"
    if not (PREFIX / "bin/bihive-view").exists():
        return
    desktop = share / "applications/bihive.desktop"
    values = dict(line.split("=", 1) for line in desktop.read_text().splitlines() if "=" in line)
    assert values["Exec"] == "bihive view %f", values
    types = xml.etree.ElementTree.parse(share / "mime/packages/bihive-types.xml").getroot()
    named = {element.get("type") for element in types}
    assert set(values["MimeType"].rstrip(";").split(";")) == named, named
    assert (share / f"icons/hicolor/scalable/apps/{values['Icon']}.svg").exists()
    if shutil.which("desktop-file-validate"):
        said = subprocess.run(["desktop-file-validate", desktop], capture_output=True, text=True)
        assert (said.returncode, said.stdout + said.stderr) == (0, ""), said
    if shutil.which("update-mime-database"):
        said = subprocess.run(["update-mime-database", share / "mime"], capture_output=True, text=True)
        assert said.returncode == 0 and "rror" not in said.stderr, said
        globs = (share / "mime/globs2").read_text()
        assert ":chemical/x-pdb:*.pdb" in globs and ":application/x-gsd:*.gsd" in globs, globs


for test in (test_help, test_window, test_page, test_manual_and_completion, test_desktop):
    test()
    print(f"{test.__name__}: passed")
