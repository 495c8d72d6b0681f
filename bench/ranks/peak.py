#!/usr/bin/env python3
"""Runs a command, and appends its peak memory in bytes to a file, a line per process: peak.py FILE COMMAND..."""

import resource
import subprocess
import sys

done = subprocess.run(sys.argv[2:])
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
with open(sys.argv[1], "a", encoding="ascii") as file:
    file.write(f"{peak}\n")
sys.exit(done.returncode)
