"""The most memory that a file may take, as in `ssrlab run --max-memory`: SSRLAB_MAX_MEMORY, else half of this machine's memory."""

import argparse
import os
import re
import sys

VARIABLE = "SSRLAB_MAX_MEMORY"


def size_in_bytes(text):
    """The bytes of "500MB" (1000^2 each) or "8GiB" (1024^3 each), for argparse."""
    match = re.fullmatch(r"(\d+) *(?:([kmgtpe])(i?))?b?", text.strip().lower())
    if not match:
        raise argparse.ArgumentTypeError(f"'{text}' is no size such as 8GB")
    number, unit, is_binary = match.groups()
    return int(number) * (1024 if is_binary else 1000) ** (" kmgtpe".index(unit) if unit else 0)


def limit():
    """Bytes that one file may take. Ends the program with exit code 2 if the variable holds no size."""
    asked = os.environ.get(VARIABLE)
    if not asked:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    try:
        return size_in_bytes(asked)
    except argparse.ArgumentTypeError as e:
        print(f"error: {VARIABLE}: {e}", file=sys.stderr)
        raise SystemExit(2) from e
