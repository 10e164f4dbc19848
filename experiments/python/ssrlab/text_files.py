"""Reads files of unknown authors, and writes files whole or not at all."""

import contextlib
import errno
import json
import os
import re
import stat

from ssrlab.mistakes import ResultsError


def read_text(file):
    """The UTF-8 text of a regular file. Pipes and devices, which may never end, are refused."""
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


def exists(path):
    """Whether there is such a file or folder. Where that may not be looked up, nobody knows: a mistake with its reason, not an absence."""
    try:
        os.stat(path)
    except (FileNotFoundError, NotADirectoryError):
        return False
    except OSError as e:
        raise ResultsError(f"cannot read {path}: {e.strerror}") from e
    return True


def path_inside(folder, name, where=""):
    """The path that a file or folder of an unknown author calls `name`, by the rule of core/path_inside.h. Fails with ResultsError if it
    leads out of `folder` or passes a symbolic link. `where`: file and key of the name, for the message."""
    where = where and where + ": "
    if not isinstance(name, str) or not name or name.startswith("/") or "\0" in name or ".." in name.split("/"):
        raise ResultsError(f"{where}{json.dumps(name)[:200]} is no path below {folder}: such a name is relative and has no '..'")
    path = folder
    for part in name.split("/"):
        path = os.path.join(path, part)
        if os.path.islink(path):
            raise ResultsError(f"{where}{path} is a symbolic link, which may lead out of {folder} and is not followed; put what it points to in its place, or remove it")
    return path


NOWHERE = "00000000"  # where the system does not say it


def word_here():
    """Of this boot and this namespace of process numbers, as core/leftovers.cpp makes it."""
    try:
        with open("/proc/sys/kernel/random/boot_id", encoding="ascii") as boot:
            bits = int(boot.read(8), 16)
        return f"{bits ^ os.stat('/proc/self/ns/pid').st_ino & 0xFFFFFFFF:08x}"
    except (OSError, ValueError):
        return NOWHERE


def is_leftover(name):
    """Whether a process that has ended left a file of this name. Those of processes that cannot be asked are left to core/leftovers.h."""
    found = re.search(r"\.partial-([0-9a-f]{8})-([1-9]\d{0,8})-\d{1,9}$", name)
    if not found or found[1] == NOWHERE or found[1] != word_here():
        return False
    try:
        os.kill(int(found[2]), 0)
    except OSError as e:
        return e.errno == errno.ESRCH
    return False


def remove_leftovers(folder):
    """What killed processes left in a folder of files that they had not finished."""
    for entry in os.scandir(folder):
        if is_leftover(entry.name) and not entry.is_dir(follow_symlinks=False):
            with contextlib.suppress(OSError):
                os.remove(entry.path)


@contextlib.contextmanager
def whole_file(file):
    """A name beside `file` to write to; it replaces `file` once the block has ended without an exception, never through a link. Makes
    missing folders, and removes leftovers."""
    folder = os.path.dirname(file) or "."
    os.makedirs(folder, exist_ok=True)
    remove_leftovers(folder)
    temporary = f"{file}.partial-{word_here()}-{os.getpid()}-0"
    try:
        if os.path.lexists(temporary):  # of a killed run, or a link
            os.remove(temporary)
        yield temporary
        os.replace(temporary, file)
    finally:
        if os.path.lexists(temporary):
            os.remove(temporary)


def write_text(file, text):
    with whole_file(file) as temporary, open(temporary, "w", newline="", encoding="utf-8") as stream:
        stream.write(text)
