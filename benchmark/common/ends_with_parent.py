# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has started ends with it, however it ends: of two runs one after the other in a folder, nothing of the first
works beside the second."""
import ctypes
import os
import signal

PR_SET_PDEATHSIG = 1  # of <linux/prctl.h>
LIBC = ctypes.CDLL(None, use_errno=True)


def begin():
    """Of this process, from now on; for `preexec_fn`, too."""
    if LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl: " + os.strerror(ctypes.get_errno()))
