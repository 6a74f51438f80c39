# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run has started ends with it, however it ends: of two runs one after the other in a folder, nothing of the
first works beside the second."""
import ctypes
import os
import signal

PR_SET_PDEATHSIG = 1  # of <linux/prctl.h>
LIBC = ctypes.CDLL(None, use_errno=True)


def begin(parent):
    """Of this process, from now on, or at once where that parent has ended already. \\param parent its number"""
    if LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl: " + os.strerror(ctypes.get_errno()))
    if os.getppid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)


def of_this_process():
    """For `preexec_fn`: a child ends with the process that asks here."""
    parent = os.getpid()
    return lambda: begin(parent)
