#!/usr/bin/env python3
"""Runs a command, and adds its largest memory in bytes to a file, a line for each process: peak.py FILE COMMAND..."""

import resource
import subprocess
import sys

done = subprocess.run(sys.argv[2:])
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
with open(sys.argv[1], "a", encoding="ascii") as file:
    file.write(f"{peak}\n")
sys.exit(done.returncode)
