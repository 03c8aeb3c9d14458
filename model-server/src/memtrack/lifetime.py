# SPDX-License-Identifier: GPL-3.0-or-later
"""What ends a server: a signal, its parent's death, or the end of its standard input."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable

_POLL_SECONDS = 0.5


class Ending:
    """The wish that the server ends; the first reason counts."""

    def __init__(self) -> None:
        self._event = threading.Event()
        self.reason = ""
        self.at_once = False

    def wish(self, reason: str, *, at_once: bool) -> None:
        """Asks for the end; `at_once` when nobody is left who could want the films at work."""
        if not self._event.is_set():
            self.reason, self.at_once = reason, at_once
            self._event.set()

    def wait(self) -> None:
        """Returns when somebody has wished for the end."""
        # Windows delivers Ctrl-C only between waits.
        while not self._event.wait(_POLL_SECONDS):
            pass


def on_signals(ending: Ending) -> None:
    """SIGTERM, Ctrl-C and, on Windows, Ctrl-Break end the server after its grace; a second one at once."""
    names = [name for name in ("SIGTERM", "SIGINT", "SIGBREAK") if hasattr(signal, name)]

    def stop(number: int, _frame: object) -> None:
        if ending.reason:
            os._exit(1)
        ending.wish(f"signal {signal.Signals(number).name}", at_once=False)

    for name in names:
        signal.signal(getattr(signal, name), stop)


def on_end_of_input(ending: Ending) -> None:
    """Ends the server when the program that holds the other end of standard input closes it or dies."""
    descriptor = sys.stdin.fileno()

    def watch() -> None:
        try:
            while os.read(descriptor, 4096):
                pass
        except OSError:
            pass
        ending.wish("standard input was closed", at_once=True)

    threading.Thread(target=watch, name="watch-stdin", daemon=True).start()


def on_death_of(pid: int, ending: Ending) -> None:
    """Ends the server when process `pid` is gone."""
    alive = _watcher(pid)

    def watch() -> None:
        while alive():
            time.sleep(_POLL_SECONDS)
        ending.wish(f"parent process {pid} has ended", at_once=True)

    threading.Thread(target=watch, name="watch-parent", daemon=True).start()


def _watcher(pid: int) -> Callable[[], bool]:
    if sys.platform == "win32":
        return _windows_watcher(pid)
    if os.getppid() == pid:
        # A dead parent that nobody has waited for keeps its number, but its children get another parent.
        return lambda: os.getppid() == pid
    return lambda: _exists(pid)


def _exists(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


def _windows_watcher(pid: int) -> Callable[[], bool]:
    """Holds a handle to the process, so that its number cannot come to mean another one."""
    import ctypes

    synchronize, timed_out = 0x00100000, 0x102
    kernel = ctypes.WinDLL("kernel32", use_last_error=True)  # type: ignore[attr-defined,unused-ignore]
    kernel.OpenProcess.restype = ctypes.c_void_p
    kernel.WaitForSingleObject.argtypes = [ctypes.c_void_p, ctypes.c_uint32]
    handle = kernel.OpenProcess(synchronize, False, pid)
    if not handle:
        return lambda: False
    return lambda: bool(kernel.WaitForSingleObject(handle, 0) == timed_out)
