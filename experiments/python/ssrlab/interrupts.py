"""Handles Ctrl-C and requests to end (SIGTERM) alike: both are one KeyboardInterrupt, which also ends the programs that the script runs."""

import contextlib
import os
import signal
import subprocess
import threading

STOPS = (signal.SIGINT, signal.SIGTERM)
SECONDS_TO_END = 5  # a renderer ends its engine and removes its files


class _State:
    is_stopped = False  # a second stop is ignored
    is_starting = False  # of a program, which nobody could end before it is known: run() raises what came meanwhile


def _stop(_number, _frame):
    if _State.is_stopped:
        return
    _State.is_stopped = True
    if not _State.is_starting:
        raise KeyboardInterrupt


@contextlib.contextmanager
def taken_once():
    """Ignores a second interrupt within the block: on Ctrl-C a terminal also stops ssrlab, which then asks its script to end."""
    if threading.current_thread() is not threading.main_thread():  # which alone may say what signals do
        yield
        return
    before = {number: signal.getsignal(number) for number in STOPS}
    taken = {number: handler for number, handler in before.items() if handler in (signal.SIG_DFL, signal.default_int_handler)}
    _State.is_stopped = False
    for number in taken:
        signal.signal(number, _stop)
    try:
        yield
    finally:
        if not _State.is_stopped:  # else another may be on its way
            for number, handler in taken.items():
                signal.signal(number, handler)


def _signal_all(process, number):
    """Sends a signal to a program and all that it started, which are in a session of their own."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, number)


def run(words, **streams):
    """Runs a program, the first of `words`, with its arguments, and returns its exit code. `streams`: as subprocess.Popen() takes them. If
    the script is stopped, the program and all that it started are asked to end, and killed if they do not."""
    _State.is_starting = True
    try:
        process = subprocess.Popen(words, start_new_session=True, **streams)
    finally:
        _State.is_starting = False
    with process:
        try:
            if _State.is_stopped:
                raise KeyboardInterrupt
            return process.wait()
        except BaseException:
            _signal_all(process, signal.SIGTERM)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(SECONDS_TO_END)
            _signal_all(process, signal.SIGKILL)  # what the program started may outlive it
            raise
