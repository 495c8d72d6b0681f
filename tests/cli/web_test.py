"""`bihive web`: its answers, its refusals, and its end. A small page takes the place of the real one."""

import base64
import gzip
import http.client
import json
import os
import re
import signal
import socket
import struct
import stat
import subprocess
import time
import urllib.parse

from program import BIHIVE, PATIENCE_S, ProgramTest, main

SCRIPT = b"export const numbers = [" + b"1, 2, 3, " * 500 + b"];\n"
WASM = b"\0asm\1\0\0\0" + bytes(3000)
HEADERS = {
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Embedder-Policy": "require-corp",
    "Cross-Origin-Resource-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


class WebTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.page = self.path("page")
        os.makedirs(os.path.join(self.page, "assets"))
        self.write("page/index.html", "<!doctype html><title>page</title>")
        self.write("page/assets/page.js", SCRIPT)
        self.write("page/assets/page.wasm", WASM)
        self.write("page/picture.png", b"\x89PNG" + bytes(2000))
        self.write("page/.hidden", "hidden")
        self.write("secret.txt", "secret")
        os.symlink("../secret.txt", os.path.join(self.page, "link.txt"))
        os.symlink("..", os.path.join(self.page, "above"))
        self.environment = {**os.environ, "BIHIVE_PAGE": self.page}
        for name in ["DISPLAY", "WAYLAND_DISPLAY"]:
            self.environment.pop(name, None)

    def start(self, *arguments, port="0", browser=False, descriptors=None):
        """The running server; its port is in self.port, its output in self.said."""
        words = [*arguments, "--json"] + ([] if browser else ["--no-browser"]) + (["--port", port] if port else [])
        limit = ["prlimit", f"--nofile={descriptors}:{descriptors}"] if descriptors else []
        process = subprocess.Popen(
            [*limit, BIHIVE, "web", *words], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

        def end():
            process.kill()
            process.communicate()

        self.addCleanup(end)
        line = process.stdout.readline()
        self.assertTrue(line, process.stderr.read() if not line else "")
        self.said = json.loads(line)
        self.port = self.said["port"]
        return process

    def ask(self, path, method="GET", host=None, **headers):
        """(status, headers, body)."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        wanted = {name.replace("_", "-"): value for name, value in headers.items()}
        if host is not None:
            wanted["Host"] = host
        connection.request(method, path, headers=wanted)
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()

    def time_of_asking(self, times):
        """Seconds until the page was answered this many times."""
        begin = time.monotonic()
        for _ in range(times):
            self.assertEqual(self.ask("/")[0], 200)
        return time.monotonic() - begin

    def ask_raw(self, data):
        """The whole answer to these bytes, until the server closes the connection or is silent."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S) as client:
            client.sendall(data)
            client.shutdown(socket.SHUT_WR)
            found = b""
            while chunk := client.recv(65536):
                found += chunk
        return found

    def status_of(self, target, host="127.0.0.1"):
        """The status of a request whose target is sent as these bytes, and the whole answer."""
        answer = self.ask_raw(b"GET " + target + b" HTTP/1.1\r\nHost: " + host.encode() + b"\r\nConnection: close\r\n\r\n")
        self.assertTrue(answer.startswith(b"HTTP/1.1 "), answer[:100])
        return int(answer.split()[1]), answer


PLACES = "".join(f'<script id="page_{name}" type="text/plain"></script>\n' for name in ["state", "file", "trajectory"])


def dcd_of_one_atom(x_of_frames):
    """A trajectory in the format of CHARMM and NAMD: records of bytes between their lengths."""

    def record(content):
        return struct.pack("<i", len(content)) + content + struct.pack("<i", len(content))

    numbers = [0] * 20
    numbers[0], numbers[2], numbers[3], numbers[19] = len(x_of_frames), 1, len(x_of_frames), 24
    records = [record(b"CORD" + struct.pack("<20i", *numbers)), record(struct.pack("<i", 1) + b" " * 80), record(struct.pack("<i", 1))]
    return b"".join(records + [record(struct.pack("<f", value)) for x in x_of_frames for value in (x, 0, 0)])


class OneFile(WebTest):
    def made(self, *words):
        return self.run_bihive("web", *words, "--html", "out.html", env=self.environment)

    def test_the_page_and_its_input_are_written_and_nothing_is_served(self):
        self.write("page/one_file.html", f"<p>{PLACES}</p>")
        content = "2\n\nC 0 0 0\nC 2 0 0\n"
        self.write('a"b.xyz', content)
        done = self.made('a"b.xyz', "--eye", "1,2,9", "--style", "studio")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        state, file, rest = re.fullmatch(
            r'<p><script id="page_state" type="text/plain" data-name="" data-packing="gzip">(.*)</script>\n'
            r'<script id="page_file" type="text/plain" data-name="a&quot;b.xyz">(.*)</script>\n(.*)\n</p>',
            self.read("out.html").decode("ascii"),
        ).groups()
        self.assertEqual(base64.b64decode(file).decode(), content)
        self.assertEqual(rest, PLACES.split("\n")[2])
        state = json.loads(gzip.decompress(base64.b64decode(state)))
        self.assertEqual(state["source"], {"file": 'a"b.xyz'})
        self.assertEqual(state["settings"]["camera"]["eye"], [1, 2, 9])
        self.assertEqual(state["look"]["style"], "studio")

    def test_a_trajectory_is_in_it(self):
        self.write("page/one_file.html", PLACES)
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        moves = dcd_of_one_atom([0, 1, 2])
        self.write("moves.dcd", moves)
        done = self.made("a.xyz", "--trajectory", "moves.dcd", "--frame", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        places = re.findall(r'<script id="page_(\w+)" type="text/plain" data-name="([^"]*)"[^>]*>(.*)</script>', self.read("out.html").decode("ascii"))
        self.assertEqual([(name, file) for name, file, _ in places], [("state", ""), ("file", "a.xyz"), ("trajectory", "moves.dcd")])
        content = base64.b64decode(places[2][2])
        self.assertEqual((gzip.decompress(content) if content[:2] == b"\x1f\x8b" else content), moves)
        state = json.loads(gzip.decompress(base64.b64decode(places[0][2])))
        self.assertEqual(state["source"], {"file": "a.xyz", "trajectory": "moves.dcd", "reading": {"frame": "1"}})
        own = self.run_bihive("web", "a.xyz", "--trajectory", "moves.dcd", "--html", "moves.dcd", env=self.environment)
        self.assertIn("is the input", own.stderr)
        self.assertEqual(self.read("moves.dcd"), moves)

    def test_refusals(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        self.assertIn("without the page that is one file", self.fail_with(3, "web", "a.xyz", "--html", "out.html", env=self.environment))
        self.write("page/one_file.html", "<p></p>")
        self.assertIn("another version", self.fail_with(3, "web", "a.xyz", "--html", "out.html", env=self.environment))
        self.write("bad.xyz", "2\n\nC 0 0 0\n")
        self.assertIn("bad.xyz", self.fail_input("web", "bad.xyz", "--html", "out.html", env=self.environment))
        self.assertIn("--port", self.fail_usage("web", "a.xyz", "--html", "out.html", "--port", "0"))
        self.assertIn("name a file", self.fail_usage("web", "-", "--html", "out.html"))
        self.write("scene.json", '{"bihive_scene": 1, "spheres": {"file": "a.xyz"}}')
        self.assertIn("a.xyz beside it", self.fail_with(2, "web", "scene.json", "--html", "out.html", env=self.environment))
        self.assertFalse(os.path.exists(self.path("out.html")))


class Serves(WebTest):
    def test_the_page_with_the_headers_that_threads_need(self):
        self.start()
        self.assertEqual(self.said["url"], f"http://127.0.0.1:{self.port}/")
        for path, kind, body in [
            ("/", "text/html; charset=utf-8", b"<!doctype html><title>page</title>"),
            ("/index.html?a=b", "text/html; charset=utf-8", b"<!doctype html><title>page</title>"),
            ("/assets/page.js", "text/javascript; charset=utf-8", SCRIPT),
            ("/assets/page.wasm", "application/wasm", WASM),
            ("/picture.png", "image/png", b"\x89PNG" + bytes(2000)),
            ("/start.json", "application/json", b"{}\n"),
            ("/nothing", "text/plain; charset=utf-8", b"there is no such file\n"),
        ]:
            with self.subTest(path=path):
                status, headers, found = self.ask(path)
                self.assertEqual((status, found), (404 if path == "/nothing" else 200, body))
                self.assertEqual(headers["Content-Type"], kind)
                self.assertEqual({name: headers[name] for name in HEADERS}, HEADERS)
                self.assertIn("Date", headers)
                policy = headers["Content-Security-Policy"]
                self.assertIn("default-src 'none'", policy)
                self.assertIn("'wasm-unsafe-eval'", policy)
                self.assertNotIn("'unsafe-eval'", policy)
                self.assertNotIn("*", policy)
                self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_packed_where_the_browser_takes_it(self):
        self.start()
        for accepted in ["gzip", "deflate, gzip;q=0.5, br", "*", "br , gzip"]:
            status, headers, body = self.ask("/assets/page.js", Accept_Encoding=accepted)
            self.assertEqual((status, headers["Content-Encoding"], headers["Vary"]), (200, "gzip", "Accept-Encoding"))
            self.assertEqual(gzip.decompress(body), SCRIPT)
            self.assertLess(len(body), len(SCRIPT) / 10)
        for refused in ["identity", "br", "gzip;q=0", "gzip; q=0.000", "gzipped"]:
            status, headers, body = self.ask("/assets/page.js", Accept_Encoding=refused)
            self.assertEqual((status, headers["Content-Encoding"], body), (200, None, SCRIPT))
            self.assertEqual(headers["Vary"], "Accept-Encoding")
        # Pictures are already compressed.
        self.assertIsNone(self.ask("/picture.png", Accept_Encoding="gzip")[1]["Content-Encoding"])

    def test_a_browser_that_has_the_file_is_told_so(self):
        self.start()
        tags = set()
        for encoding in ["gzip", "identity"]:
            headers = self.ask("/assets/page.js", Accept_Encoding=encoding)[1]
            self.assertEqual(headers["Cache-Control"], "no-cache")
            tags.add(headers["ETag"])
            for known in [headers["ETag"], "W/" + headers["ETag"], '"other", ' + headers["ETag"], "*"]:
                status, again, body = self.ask("/assets/page.js", Accept_Encoding=encoding, If_None_Match=known)
                self.assertEqual((status, again["ETag"], body), (304, headers["ETag"], b""))
                self.assertEqual(again["Cross-Origin-Embedder-Policy"], "require-corp")
            self.assertEqual(self.ask("/assets/page.js", Accept_Encoding=encoding, If_None_Match='"other"')[0], 200)
        self.assertEqual(len(tags), 2)
        self.assertNotEqual(self.ask("/assets/page.wasm")[1]["ETag"], self.ask("/")[1]["ETag"])

    def test_head_is_get_without_a_body(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        self.start("a.xyz")
        for path in ["/", "/assets/page.wasm", "/file/a.xyz", "/nothing"]:
            got = self.ask(path)
            head = self.ask(path, method="HEAD")
            self.assertEqual((head[0], head[1]["Content-Length"], head[2]), (got[0], str(len(got[2])), b""))

    def test_parts(self):
        self.write("a.bin", bytes(range(256)))
        self.start("a.bin")
        data = bytes(range(256))
        for wanted, first, last in [("0-9", 0, 9), ("250-", 250, 255), ("-6", 250, 255), ("200-999", 200, 255), ("-999", 0, 255)]:
            status, headers, body = self.ask("/file/a.bin", Range="bytes=" + wanted)
            self.assertEqual((status, body), (206, data[first : last + 1]))
            self.assertEqual(headers["Content-Range"], f"bytes {first}-{last}/256")
        for outside in ["256-", "999-1000", "-0"]:
            status, headers, _ = self.ask("/file/a.bin", Range="bytes=" + outside)
            self.assertEqual((status, headers["Content-Range"]), (416, "bytes */256"))
        for ignored in ["bytes=5-2", "bytes=0-1,4-5", "bytes=", "bytes=-", "bytes=a-b", "lines=0-1", "bytes=-1-2",
                        "bytes=99999999999999999999-", "bytes=0x1-2"]:
            self.assertEqual(self.ask("/file/a.bin", Range=ignored)[::2], (200, data), ignored)
        tag = self.ask("/file/a.bin")[1]["ETag"]
        self.assertEqual(self.ask("/file/a.bin", Range="bytes=0-1", If_Range=tag)[0], 206)
        self.assertEqual(self.ask("/file/a.bin", Range="bytes=0-1", If_Range='"old"')[0], 200)
        # A part of a page's file is a part of its bytes, not of the packed ones.
        status, headers, body = self.ask("/assets/page.js", Range="bytes=7-11", Accept_Encoding="gzip")
        self.assertEqual((status, headers["Content-Encoding"], body), (206, None, SCRIPT[7:12]))

    def test_a_connection_takes_many_requests(self):
        self.start()
        one = b"GET /start.json HTTP/1.1\r\nHost: localhost\r\n\r\n"
        last = b"GET /start.json HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
        answer = self.ask_raw(one * 20 + last)
        self.assertEqual(answer.count(b"HTTP/1.1 200 OK\r\n"), 21)
        old = self.ask_raw(b"GET /start.json HTTP/1.0\r\nHost: localhost\r\n\r\n")
        self.assertTrue(old.startswith(b"HTTP/1.0 200 OK\r\n") and old.endswith(b"{}\n"), old)


class Source(WebTest):
    def source(self):
        return json.loads(self.ask("/start.json")[2]).get("source")

    def test_a_built_in_name(self):
        for name in ["demo", "scenario1", "scenario2", "scenario3", "four-spheres"]:
            process = self.start(name)
            self.assertEqual(self.source(), {"built_in": name})
            process.send_signal(signal.SIGINT)
            process.wait(timeout=PATIENCE_S)

    def test_a_first_state(self):
        self.write("two.xyz", "2\n\nC 0 0 0\nO 1.2 0 0\n")
        self.run_bihive("scene", "save", "s.json", "two.xyz", "--radius", "0.5", "--style", "flat", "--fit", "element O", "--crop", "0,0,2,2")
        self.start("s.json", "--fog", "0.5")
        state = json.loads(self.ask("/start.json")[2])
        self.assertEqual(state["source"], {"url": "file/two.xyz", "reading": {"radius": 0.5}})
        self.assertEqual((state["look"]["style"], state["settings"]["fog"]), ("flat", 0.5))
        self.assertAlmostEqual(state["settings"]["camera"]["look_at"][0], 1.2, 6)

    def test_a_file_of_any_name(self):
        os.mkdir(self.path("folder"))
        for name in ["a.xyz", "two words & 100% ?#+.xyz", "\u00e9\u6c34.pdb", '"><b>.html', "..odd", "a\\b.csv", "a\nb.xyz"]:
            with self.subTest(name=name):
                self.write("folder/" + name, name * 100000)
                process = self.start("folder/" + name)
                url = self.source()["url"]
                self.assertRegex(url, r"\Afile/[A-Za-z0-9_.~%-]+\Z")
                self.assertEqual(urllib.parse.unquote(url), "file/" + name)
                status, headers, body = self.ask("/" + url)
                self.assertEqual((status, body), (200, (name * 100000).encode()))
                # No browser shows or runs it, whatever its content.
                self.assertEqual(headers["Content-Type"], "application/octet-stream")
                process.kill()

    def test_the_file_is_fetched_as_it_is_now(self):
        self.write("a.xyz", "old")
        self.start("a.xyz")
        tag = self.ask("/file/a.xyz")[1]["ETag"]
        self.assertEqual(self.ask("/file/a.xyz", If_None_Match=tag)[0], 304)
        self.write("a.xyz", "newer")
        self.assertEqual(self.ask("/file/a.xyz", If_None_Match=tag)[::2], (200, b"newer"))
        os.remove(self.path("a.xyz"))
        self.assertEqual(self.ask("/file/a.xyz")[0], 404)
        self.write("a.xyz", "")
        self.assertEqual(self.ask("/file/a.xyz")[::2], (200, b""))
        os.remove(self.path("a.xyz"))
        os.mkdir(self.path("a.xyz"))
        self.assertEqual(self.ask("/file/a.xyz")[0], 404)

    def test_a_large_file_and_one_that_shrinks_on_the_way(self):
        data = os.urandom(1 << 20) * 24
        self.write("a.bin", data)
        self.start("a.bin")
        self.assertEqual(self.ask("/file/a.bin")[::2], (200, data))
        with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S) as client:
            client.sendall(b"GET /file/a.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")
            found = client.recv(1000)
            os.truncate(self.path("a.bin"), 10)
            while chunk := client.recv(1 << 20):
                found += chunk
        self.assertLess(len(found), len(data))
        self.assertEqual(self.ask("/file/a.bin")[::2], (200, data[:10]))

    def test_what_is_no_file_is_refused_at_once(self):
        os.mkdir(self.path("folder"))
        os.mkfifo(self.path("pipe"))
        for name, reason in [("missing.pdb", "No such file"), ("folder", "Is a directory"), ("pipe", "regular file"),
                             ("/dev/zero", "regular file"), ("a\nb", "No such file")]:
            self.assertIn(reason, self.fail_input("web", name, "--port", "0", env=self.environment))


class Refuses(WebTest):
    def test_everything_outside_of_the_page(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        self.write("b.xyz", "other")
        self.start("a.xyz")
        secret = self.path("secret.txt").encode()
        targets = [
            b"/../secret.txt", b"/assets/../../secret.txt", b"/./index.html", b"/%2e%2e/secret.txt", b"/%2e%2e%2fsecret.txt",
            b"/..%2fsecret.txt", b"/..%5csecret.txt", b"/..\\secret.txt", b"/%252e%252e/secret.txt", b"/assets/%2e%2e/index.html",
            b"/link.txt", b"/above/secret.txt", b"/above", b"/.hidden", b"/%2ehidden", b"//secret.txt", b"//index.html",
            b"//etc/passwd", b"/" + secret, secret, b"//" + secret, b"/etc/passwd", b"/file/../a.xyz", b"/file/b.xyz", b"/file/",
            b"/file", b"/file//a.xyz", b"/file/a.xyz/", b"/file/a.xyz%00", b"/file/a.xyz%00.js", b"/%00", b"/index.html%00",
            b"/index.html/", b"/assets", b"/assets/", b"/assets%2fpage.js", b"/INDEX.HTML", b"/index.html%20", b"/%", b"/%2",
            b"/%zz", b"/a%0d%0aX: y", b"index.html", b"http://localhost/", b"*", b"/\xff\xfe", b"/" + b"a" * 8000, b"/" + b"../" * 1000,
        ]
        for target in targets:
            with self.subTest(target=target[:60]):
                status, answer = self.status_of(target)
                self.assertIn(status, [400, 404])
                for content in [b"secret\n", b"hidden", b"root:", b"<!doctype", b"export", b"C 0 0 0", b"other"]:
                    self.assertNotIn(content, answer.split(b"\r\n\r\n", 1)[1])
        self.assertEqual(self.status_of(b"/file/a.xyz")[0], 200)
        self.assertEqual(self.status_of(b"/%69ndex.html")[0], 200)

    def test_what_is_no_request(self):
        self.start()
        host = b"Host: localhost\r\n"
        for data, status in [
            (b"GET / HTTP/1.1\r\n" + host + b"X: " + b"a" * 20000 + b"\r\n\r\n", 431),
            (b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n" + host + b"\r\n", 431),
            (b"GET /\0secret HTTP/1.1\r\n" + host + b"\r\n", 400),
            (b"GET /a b HTTP/1.1\r\n" + host + b"\r\n", 400),
            (b"GET / HTTP/9.9\r\n" + host + b"\r\n", 400),
            (b"GET / HTTP/1.1\r\n" + host + b"Bad Header: 1\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\n" + host + b"Content-Length: -1\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\n" + host + b"Content-Length: 5\r\n\r\n12345", 413),
            (b"GET / HTTP/1.1\r\n" + host + b"Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n", 413),
            (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(100), 400),
            (b"hello\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\n\r\n", 400),
            (b"GET / HTTP/1.0\r\n\r\n", 400),
            (b"GET / HTTP/1.1\r\n" + host + host + b"\r\n", 400),
        ]:
            with self.subTest(data=data[:50]):
                # The following bytes are not taken for a request.
                answer = self.ask_raw(data + b"GET /start.json HTTP/1.1\r\nHost: localhost\r\n\r\n")
                self.assertTrue(answer.startswith(b"HTTP/1.1 %d " % status) or
                                answer.startswith(b"HTTP/1.0 %d " % status), answer[:60])
                self.assertEqual(answer.count(b"HTTP/1."), 1, answer)
                self.assertIn(b"Connection: close", answer.replace(b"HTTP/1.0", b"Connection: close"))
        for cut in [b"", b"GET", b"GET / HTTP/1.1\r\nHost: loc"]:
            self.assertEqual(self.ask_raw(cut), b"")

    def test_every_other_method(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        self.start("a.xyz")
        for method in ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "PROPFIND", "get", "NONSENSE"]:
            body = b"GET /start.json HTTP/1.1\r\nHost: localhost\r\n\r\n"
            answer = self.ask_raw(f"{method} /file/a.xyz HTTP/1.1\r\nHost: localhost\r\nContent-Length: {len(body)}\r\n\r\n".encode() + body)
            self.assertTrue(answer.startswith(b"HTTP/1.1 405 "), (method, answer[:60]))
            self.assertIn(b"Allow: GET, HEAD\r\n", answer)
            self.assertEqual(answer.count(b"HTTP/1."), 1)
        self.assertEqual(self.ask_raw(b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999\r\n\r\n" + bytes(1 << 18))[9:12], b"405")
        self.assertEqual(self.read("a.xyz"), b"1\n\nC 0 0 0\n")

    def test_the_names_of_other_machines(self):
        self.start()
        for host in ["localhost", "LOCALHOST", f"localhost:{self.port}", "127.0.0.1", f"127.0.0.1:{self.port}", "127.0.0.2:1",
                     "[::1]:8017", "[0:0:0:0:0:0:0:1]"]:
            self.assertEqual(self.status_of(b"/", host)[0], 200, host)
        for host in ["evil.example", f"evil.example:{self.port}", "localhost.evil.example", "127.0.0.1.evil.example", "0.0.0.0",
                     "192.168.1.5", "[::2]", "[fe80::1]:80", "127.evil.example", "localhost."]:
            self.assertEqual(self.status_of(b"/", host)[0], 403, host)
        for host in ["", ":80", "[::1", "[localhost]", "localhost:", "localhost:http", "localhost:999999", "user@localhost",
                     "localhost/", "localhost evil", "::1", "loc\u00e4l"]:
            self.assertIn(self.status_of(b"/", host)[0], [400, 403], host)

    def test_head_never_has_a_body(self):
        self.start()
        for head in ["HEAD / HTTP/1.1\r\n\r\n", "HEAD / HTTP/1.1\r\nHost: evil.example\r\n\r\n", "HEAD /none HTTP/1.1\r\nHost: localhost\r\n\r\n",
                     "HEAD / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\n", "HEAD /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n",
                     "HEAD / HTTP/9.9\r\nHost: localhost\r\n\r\n", "HEAD /\r\n\r\n",
                     "HEAD / HTTP/1.1\r\nHost: localhost\r\nX: " + "x" * 20000 + "\r\n\r\n"]:
            with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S) as connection:
                connection.sendall(head.encode())
                connection.shutdown(socket.SHUT_WR)
                answer = b""
                while chunk := connection.recv(65536):
                    answer += chunk
            self.assertRegex(answer, rb"\AHTTP/1.1 4\d\d ", head[:60])
            self.assertTrue(answer.endswith(b"\r\n\r\n"), (head[:60], answer[-60:]))

    def test_idle_connections_keep_nobody_out(self):
        self.start()
        alone_s = self.time_of_asking(20)
        idle = [socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S) for _ in range(260)]
        self.addCleanup(lambda: [connection.close() for connection in idle])
        idle[0].sendall(b"GET / HT")
        # It would take half a minute to drop them; a slow or busy machine needs longer without them too.
        self.assertLess(self.time_of_asking(20), 10 + 5 * alone_s)


class Addresses(WebTest):
    def test_ipv6(self):
        try:
            with socket.socket(socket.AF_INET6) as probe:
                probe.bind(("::1", 0))
        except OSError as error:
            self.skipTest(f"no IPv6 here: {error}")
        self.start("--bind", "0:0:0:0:0:0:0:1")
        self.assertEqual(self.said["url"], f"http://[::1]:{self.port}/")
        connection = http.client.HTTPConnection("::1", self.port, timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        connection.request("GET", "/start.json")
        self.assertEqual(connection.getresponse().read(), b"{}\n")
        # All addresses of both kinds by one socket.
        self.start("--bind", "::")
        self.assertEqual(self.ask("/")[0], 200)

    def taken(self, port=0):
        """A socket that listens at the port."""
        holder = socket.socket()
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind(("127.0.0.1", port))
        holder.listen()
        self.addCleanup(holder.close)
        return holder

    def test_a_port_that_is_taken(self):
        port = self.taken().getsockname()[1]
        message = self.fail_input("web", "--port", str(port), env=self.environment)
        self.assertIn(str(port), message)
        self.assertIn("in use", message)

    def test_the_next_port_that_is_free(self):
        # The second server finds the port that the first has taken, whatever else runs on this machine.
        self.start(port=None)
        first = self.port
        self.start(port=None)
        self.assertGreaterEqual(first, 8017)
        self.assertGreater(self.port, first)
        self.assertLess(self.port, 8037)
        self.assertEqual(self.ask("/")[0], 200)

    def test_this_machine_only_unless_asked(self):
        self.start()
        with open("/proc/net/tcp", encoding="ascii") as table:
            listening = [line.split()[1] for line in table if line.split()[3] == "0A"]
        self.assertIn(f"0100007F:{self.port:04X}", listening)
        self.assertNotIn(f"00000000:{self.port:04X}", listening)

    def test_all_addresses_with_a_warning(self):
        self.write("a.xyz", "1\n\nC 0 0 0\n")
        process = self.start("a.xyz", "--bind", "0.0.0.0")
        self.assertEqual(self.said["url"], f"http://127.0.0.1:{self.port}/")
        self.assertEqual(self.said["urls"][0], self.said["url"])
        for url in self.said["urls"][1:]:
            own = urllib.parse.urlsplit(url).hostname
            self.assertEqual(self.status_of(b"/", f"{own}:{self.port}")[0], 200)
        self.assertEqual(self.status_of(b"/", "evil.example")[0], 403)
        self.assertEqual(self.status_of(b"/", "8.8.8.8")[0], 403)
        process.send_signal(signal.SIGINT)
        self.assertRegex(process.communicate(timeout=PATIENCE_S)[1], r"\Abihive: warning: everyone [^\n]*fetch the file[^\n]*https[^\n]*\n\Z")

    def test_addresses_that_cannot_be(self):
        self.assertIn("--bind", self.fail_usage("web", "--bind", "everywhere"))
        self.assertIn("--bind", self.fail_usage("web", "--bind", ""))
        self.assertIn("--port", self.fail_usage("web", "--port", "65536"))
        self.assertIn("--port", self.fail_usage("web", "--port", "-1"))
        # A documentation address (RFC 5737): no machine has it.
        self.assertIn("192.0.2.1", self.fail_with(1, "web", "--bind", "192.0.2.1", "--port", "0", env=self.environment))


class Words(WebTest):
    def test_help(self):
        text = self.succeed("web", "--help")
        for word in ["--port", "--bind", "--no-browser", "bihive web molecule.pdb"]:
            self.assertIn(word, text)
        self.assertIn("--json", self.succeed("web", "--help-all"))
        self.assertIn("web", self.succeed("--help"))

    def test_people_get_the_address_alone_in_a_line(self):
        process = subprocess.Popen([BIHIVE, "web", "--port", "0", "--no-browser"], env=self.environment, stdout=subprocess.PIPE, text=True)
        self.assertRegex(process.stdout.readline(), r"\Ahttp://127\.0\.0\.1:\d+/\n\Z")
        self.assertRegex(process.stdout.readline(), "Ctrl-C")
        process.send_signal(signal.SIGINT)
        self.assertEqual((process.communicate(timeout=PATIENCE_S)[0], process.returncode), ("", 0))

    def test_nobody_listens_to_the_address(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = self.run_bihive("web", "--port", "0", env=self.environment, stdout=full)
        self.assertEqual(done.returncode, 1)
        self.assertIn("No space left", done.stderr)


class Page(WebTest):
    def test_no_page(self):
        for folder in [self.path("missing"), self.path("page/assets")]:
            environment = {**self.environment, "BIHIVE_PAGE": folder}
            self.assertIn(folder, self.fail_with(3, "web", "--port", "0", env=environment))

    def test_a_program_without_its_page(self):
        os.makedirs(self.path("bin"))
        program = self.path("bin/bihive")
        with open(BIHIVE, "rb") as source, open(program, "wb") as copy:
            copy.write(source.read())
        os.chmod(program, 0o755)
        environment = {name: value for name, value in self.environment.items() if name != "BIHIVE_PAGE"}
        done = subprocess.run([program, "web", "--port", "0"], env=environment, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual((done.returncode, done.stdout), (3, ""))
        self.assertIn("make web", done.stderr)
        # An installed page is found from any folder of the program.
        os.makedirs(self.path("share/bihive"))
        os.rename(self.page, self.path("share/bihive/web"))
        process = subprocess.Popen([program, "web", "--port", "0", "--json", "--no-browser"], env=environment, stdout=subprocess.PIPE, text=True)
        self.port = json.loads(process.stdout.readline())["port"]
        self.assertEqual(self.ask("/assets/page.js")[2], SCRIPT)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.communicate(timeout=PATIENCE_S)[0], "")
        self.assertEqual(process.returncode, 0)

    def test_a_folder_that_is_no_page(self):
        for i in range(1001):
            self.write(f"page/{i}.txt", "")
        self.assertIn("far more", self.fail_with(3, "web", "--port", "0", env=self.environment))


class End(WebTest):
    def test_signals_end_it_at_once_with_open_connections(self):
        self.write("large.bin", bytes(1 << 26))
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            begin = time.monotonic()
            process = self.start("large.bin")
            start_s = time.monotonic() - begin
            idle = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)
            half = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)
            half.sendall(b"GET / HTTP/1.1\r\n")
            slow = socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S)
            slow.sendall(b"GET /file/large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.assertTrue(slow.recv(1000))
            begin = time.monotonic()
            process.send_signal(number)
            out, err = process.communicate(timeout=PATIENCE_S)
            # A server that waited for one of them would take 30 s; a busy machine may take a few to end it, and a slow one
            # as much longer as it took to start it.
            self.assertLess(time.monotonic() - begin, 15 + 5 * start_s)
            self.assertEqual((process.returncode, out, err), (0, "", ""))
            for client in [idle, half, slow]:
                client.close()

    def test_many_connections_at_once(self):
        self.start()
        clients = [socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S) for _ in range(230)]
        for client in clients:
            client.sendall(b"GET /start.json HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        for client in clients:
            self.assertEqual(client.recv(100)[:12], b"HTTP/1.1 200")
            client.close()
        self.assertEqual(self.ask("/")[0], 200)

    def test_clients_that_leave_early(self):
        self.write("large.bin", bytes(1 << 24))
        self.start("large.bin")
        for _ in range(20):
            with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE_S) as client:
                client.sendall(b"GET /file/large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n")
                client.recv(10)
        self.assertEqual(self.ask("/")[0], 200)


class Browser(WebTest):
    def fake_desktop(self):
        """A desktop whose browser records the requested address."""
        os.mkdir(self.path("desktop"))
        self.write("desktop/xdg-open", f'#!/bin/sh\necho "$*" > {self.path("opened")}.new && mv {self.path("opened")}.new {self.path("opened")}\n')
        os.chmod(self.path("desktop/xdg-open"), stat.S_IRWXU)
        self.environment["PATH"] = self.path("desktop") + ":" + self.environment["PATH"]

    def test_it_is_opened_on_a_desktop(self):
        self.fake_desktop()
        self.environment["DISPLAY"] = ":99"
        self.start(browser=True)
        deadline = time.monotonic() + PATIENCE_S
        while not os.path.exists(self.path("opened")) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(self.read("opened").decode(), self.said["url"] + "\n")

    def test_it_is_not_opened_elsewhere(self):
        self.fake_desktop()
        self.start(browser=True)
        self.environment["WAYLAND_DISPLAY"] = "wayland-0"
        self.start(browser=False)
        self.assertEqual(self.ask("/")[0], 200)
        time.sleep(0.3)
        self.assertFalse(os.path.exists(self.path("opened")))

    def test_a_desktop_without_one_does_not_matter(self):
        self.environment.update(DISPLAY=":99", PATH=self.path("nowhere"))
        self.start(browser=True)
        self.assertEqual(self.ask("/")[0], 200)

if __name__ == "__main__":
    main()
