"""Reads files that somebody else may have written."""

import os
import stat

from ssrlab.mistakes import ResultsError


def read_text(file):
    """The UTF-8 of a regular file: pipes and devices, which may never end, are refused."""
    data = read_bytes(file)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as e:
        line = data[: e.start].count(b"\n") + 1
        raise ResultsError(f"{file}:{line}: not UTF-8: the byte 0x{data[e.start]:02x}") from e


def read_bytes(file):
    try:
        with open(os.open(file, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK), "rb") as stream:
            if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
                raise ResultsError(f"cannot read {file}: it is no regular file")
            return stream.read()
    except OSError as e:
        raise ResultsError(f"cannot read {file}: {e.strerror}") from e

