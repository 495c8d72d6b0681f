"""Two hosts on one machine: network namespaces with an Ethernet between them, whose rate may be limited (tc, tbf)."""

import contextlib
import os
import shutil
import subprocess

PLACES = {"bihive-a": "10.211.7.1", "bihive-b": "10.211.7.2"}
NETWORK = "10.211.7.0/24"

# mpirun calls this as it would call ssh: HOST COMMAND...
AGENT = """#!/bin/sh
case $1 in 10.211.7.1) name=bihive-a ;; *) name=bihive-b ;; esac
shift
exec {ip} netns exec $name unshare -u sh -c "hostname $name; $*"
"""


def tool(name):
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin") or name


def call(name, *words):
    return subprocess.run([tool(name), *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def can_make():
    """Whether this user may make network namespaces."""
    if not call("ip", "netns", "add", "bihive-try"):
        return False
    return call("ip", "netns", "del", "bihive-try")


@contextlib.contextmanager
def two(folder, gbit_per_s=None, ranks_of_each=1):
    """Yields the arguments before mpirun, and its options; removes the hosts afterwards."""
    for host in PLACES:
        call("ip", "netns", "del", host)
        call("ip", "netns", "add", host)
    try:
        first, second = PLACES
        call("ip", "link", "add", "eth0", "netns", first, "type", "veth", "peer", "name", "eth0", "netns", second)
        for host, place in PLACES.items():
            call("ip", "-n", host, "addr", "add", place + "/24", "dev", "eth0")
            call("ip", "-n", host, "link", "set", "eth0", "up")
            call("ip", "-n", host, "link", "set", "lo", "up")
            if gbit_per_s:
                limit = ["rate", f"{round(gbit_per_s * 1000)}mbit", "burst", "1mb", "latency", "50ms"]
                if not call("ip", "netns", "exec", host, tool("tc"), "qdisc", "add", "dev", "eth0", "root", "tbf", *limit):
                    raise SystemExit("bench/ranks: tc cannot limit the rate; its kind tbf is missing")
        agent = folder / "agent"
        agent.write_text(AGENT.format(ip=tool("ip")), encoding="ascii")
        agent.chmod(0o755)
        enter = [tool("ip"), "netns", "exec", first, "unshare", "-u", "sh", "-c", f'hostname {first}; exec "$@"', "sh"]
        options = ["--mca", "plm_rsh_agent", str(agent), "--host", ",".join(f"{place}:{ranks_of_each}" for place in PLACES.values())]
        for layer in ("btl", "oob"):
            options += ["--mca", f"{layer}_tcp_if_include", NETWORK]
        yield enter, options
    finally:
        for host in PLACES:
            call("ip", "netns", "del", host)
