"""Ranks on two machines: network namespaces with an Ethernet between them. For `make test-all`."""

import json
import os
import shutil
import subprocess
import unittest

from program import PATIENCE_S, main
from ranks import BIHIVE_MPI, MPIRUN, OnRanks, is_open_mpi

IP = shutil.which("ip", path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")
HOSTS = {"bihive-a": "10.211.7.1", "bihive-b": "10.211.7.2"}

# mpirun calls this as it would call ssh: HOST COMMAND...
AGENT = """#!/bin/sh
case $1 in {address}) name={first} ;; *) name={second} ;; esac
shift
exec {ip} netns exec $name unshare -u sh -c "hostname $name; $*"
"""


def ip(*words):
    return subprocess.run([IP, *words], capture_output=True, text=True, timeout=PATIENCE_S)


def can_make_hosts():
    if IP is None or os.geteuid() != 0 or ip("netns", "add", "bihive-try").returncode != 0:
        return False
    ip("netns", "del", "bihive-try")
    return True


@unittest.skipUnless(BIHIVE_MPI and is_open_mpi() and can_make_hosts(),
                     "needs bihive-mpi, Open MPI, ip (Debian: iproute2) and the right to make network namespaces")
class TwoHosts(OnRanks):
    def setUp(self):
        super().setUp()
        for host in HOSTS:
            ip("netns", "del", host)
            self.assertEqual(ip("netns", "add", host).returncode, 0)
            self.addCleanup(ip, "netns", "del", host)
        first, second = HOSTS
        ip("link", "add", "eth0", "netns", first, "type", "veth", "peer", "name", "eth0", "netns", second)
        for host, address in HOSTS.items():
            ip("-n", host, "addr", "add", address + "/24", "dev", "eth0")
            ip("-n", host, "link", "set", "eth0", "up")
            ip("-n", host, "link", "set", "lo", "up")
        self.write("agent", AGENT.format(address=HOSTS[first], first=first, second=second, ip=IP))
        os.chmod(self.path("agent"), 0o755)

    def on_hosts(self, of_each, *words):
        network = HOSTS["bihive-a"].rsplit(".", 1)[0] + ".0/24"
        options = ["--mca", "plm_rsh_agent", self.path("agent"), "--mca", "btl_tcp_if_include", network, "--mca",
                   "oob_tcp_if_include", network, "--host", ",".join(f"{place}:{of_each}" for place in HOSTS.values())]
        command = [IP, "netns", "exec", "bihive-a", "unshare", "-u", "sh", "-c", 'hostname bihive-a; exec "$@"', "sh",
                   *self.mpirun(2 * of_each, BIHIVE_MPI, *words)]
        at = command.index(MPIRUN) + 1
        return subprocess.run(command[:at] + options + command[at:], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=PATIENCE_S)

    def test_the_picture_of_one_process(self):
        words = ["render", "demo", "--json", "--size", "320x240", "--threads", "1"]
        alone = json.loads(self.run_bihive(*words, "-o", "alone.png").stdout)
        for of_each in (1, 2):
            for more in ([], ["--distribute"]):
                with self.subTest(of_each=of_each, more=more):
                    done = self.on_hosts(of_each, *words, "-o", "hosts.png", *more)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    report = json.loads(done.stdout)
                    self.assertEqual(report["picture_hash"], alone["picture_hash"])
                    self.assertEqual(report["rays"], alone["rays"])

    def test_a_film_with_more_ranks_than_pictures(self):
        film = ["film", "run.xyz", "--frames", "0:3", "--size", "64x48", "--threads", "1"]
        self.succeed(*film, "-o", "alone/%d.png")
        done = self.on_hosts(2, *film, "-o", "hosts/%d.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        for i in range(3):
            self.assertEqual(self.read(f"hosts/{i}.png"), self.read(f"alone/{i}.png"))


if __name__ == "__main__":
    main()
