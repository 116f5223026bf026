"""Measuring one process. Linux only."""

import ctypes
import os
import subprocess
import sys
import time

# Linux counts the memory of the process that forks as the child's first peak, so whoever starts what is measured has to
# be tiny, which Python is not: a shell is. It leaves the child behind, to be adopted by this process, and the child
# waits for a line before it becomes the command, so that the clock does not see the shell.
SPAWN = 'exec 3<&0; { read -r go <&3; exec "$@" </dev/null 2>/dev/null 3<&-; } & echo $! >&2'
PR_SET_CHILD_SUBREAPER = 36  # prctl(2)


def measure(command, output=subprocess.DEVNULL):
    """One whole process: wall clock and processor seconds, and its peak memory in MB."""
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1)
    with subprocess.Popen(["sh", "-c", SPAWN, "sh", *command], stdin=subprocess.PIPE, stdout=output,
                          stderr=subprocess.PIPE) as shell:
        process = int(shell.stderr.readline())
        shell.wait()
        start = time.perf_counter()
        shell.stdin.write(b"\n")
        shell.stdin.flush()
        _, status, usage = os.wait4(process, 0)
        wall = time.perf_counter() - start
    if (code := os.waitstatus_to_exitcode(status)) != 0:
        sys.exit(f"failed with {code}: {' '.join(map(str, command))}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak_mb": usage.ru_maxrss / 1024}
