"""The programs of a moved installation: help, and all files that they look for beside themselves.

Usage: installed_programs.py PREFIX

The page is looked at where `make web` had built it; elsewhere a stand-in takes its place, so that at least the place
is right.
"""

import json
import os
import pathlib
import subprocess
import sys
import urllib.request

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
        assert "bihive-view, is not installed" in text, text


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


for test in (test_help, test_window, test_page):
    test()
    print(f"{test.__name__}: passed")
