"""`bihive web` with more clients than it has room for: those who say or take nothing keep nobody waiting."""

import http.client
import resource
import socket
import unittest

from program import PATIENCE_S, main
from web_test import WebTest

# Far below the half minute after which a silent connection is dropped, far above what a busy machine needs. What the machine
# needs without a crowd counts five times besides.
SOON_S = 10
IDLE, READERS = 3000, 220
DESCRIPTORS = 4000
REQUEST = b"GET /file/large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n"


class Crowd(WebTest):
    def setUp(self):
        super().setUp()
        before = resource.getrlimit(resource.RLIMIT_NOFILE)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, before)
        if before[1] < DESCRIPTORS:
            raise unittest.SkipTest(f"needs {DESCRIPTORS} descriptors")
        resource.setrlimit(resource.RLIMIT_NOFILE, (DESCRIPTORS, before[1]))
        self.write("large.bin", b"")
        with open(self.path("large.bin"), "r+b") as file:
            file.truncate(1 << 28)

    def come(self, count, said=b""):
        """Clients that say this and take nothing."""
        clients = []
        self.addCleanup(lambda: [client.close() for client in clients])
        for _ in range(count):
            client = socket.socket()
            # Else the system takes megabytes of the answer for each of them.
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            client.setblocking(False)
            client.connect_ex(("127.0.0.1", self.port))
            clients.append(client)
        for client in clients if said else []:
            client.settimeout(PATIENCE_S)
            try:
                client.sendall(said)
            except OSError:
                pass  # others have come since
        return clients

    def start(self, *words, **options):
        process = super().start(*words, **options)
        self.alone_s = self.time_of_asking(1)
        return process

    def expect_soon(self):
        self.assertLess(self.time_of_asking(1), SOON_S + 5 * self.alone_s)

    def test_idle_connections(self):
        self.start("large.bin")
        for said in [b"", b"GET / HT"]:
            clients = self.come(IDLE, said)
            self.expect_soon()
            for client in clients:
                client.close()

    def test_readers_that_take_nothing(self):
        self.start("large.bin")
        first = self.come(READERS, REQUEST)
        self.expect_soon()
        # They are served on: the server has room for all of them.
        for client in first[:10]:
            self.assertEqual(client.recv(12), b"HTTP/1.1 200")
        self.come(1000, REQUEST)
        self.expect_soon()

    def test_a_client_that_works_outlives_those_that_are_silent(self):
        self.start("large.bin")
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        self.addCleanup(connection.close)
        for _ in range(3):
            connection.request("GET", "/start.json")
            self.assertEqual(connection.getresponse().read(), b'{"source":{"url":"file/large.bin"}}\n')
            self.come(IDLE // 3)
            self.expect_soon()

    def test_few_descriptors(self):
        self.start("large.bin", descriptors=64)
        for said in [b"", REQUEST]:
            self.come(100, said)
            self.expect_soon()


if __name__ == "__main__":
    main()
