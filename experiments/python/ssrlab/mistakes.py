"""Messages of scripts: one sentence for each mistake or fault, with names from files made safe for terminals."""

import difflib
import os
import re
import sys
import traceback

from ssrlab import interrupts

# What a terminal obeys or shows elsewhere than it stands: control characters, marks that turn the direction of writing, separators of
# lines; and halves of surrogates, in which Python keeps bytes that are no UTF-8. As core/shown_text.cpp has them.
OBEYED = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
NAMED = {"\n": r"\n", "\r": r"\r", "\t": r"\t"}


class ResultsError(Exception):
    """A mistake in files or in the request: one sentence."""


class Fault(Exception):
    """A fault of the machine: one sentence that says what to do."""


def _escaped(match):
    letter = match.group()
    code = ord(letter)
    if 0xDC80 <= code <= 0xDCFF:
        return f"\\x{code - 0xDC00:02x}"  # a byte, as os.fsdecode() keeps it
    return NAMED.get(letter) or (f"\\x{code:02x}" if code < 0x80 else f"\\u{code:04x}")


def shown(text):
    """A text of an unknown author, in one line without control sequences."""
    return OBEYED.sub(_escaped, str(text))


def known(name, choices):
    """"known are: a, b", or of more than 30 choices the nearest, as core/near_miss.cpp has it."""
    if len(choices) <= 30:
        return f"known are: {', '.join(choices)}"
    return f"the nearest of {len(choices)} names are: {', '.join(difflib.get_close_matches(name, choices, 5, 0))}"


def counted(count, what):
    """"1 table", "2 tables", as core/list_text.h has it."""
    return f"{count} {what}{'s' * (count != 1)}"


def say(text):
    """Prints a line that may hold names from files."""
    print(shown(text), flush=True)


def start_of_error():
    """"error:", red on a terminal unless NO_COLOR is set, as core/terminal.cpp has it."""
    has_colors = sys.stderr.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
    return "\x1b[1;31merror:\x1b[0m" if has_colors else "error:"


def stop(text):
    """Ends the script at a fault of the machine."""
    print(f"{start_of_error()} {shown(text)}", file=sys.stderr)
    sys.exit(3)


def exit_code(work, what):
    """Runs `work()` and returns the exit code: its result or 0; 2 for a mistake in files or the request; 3 if `what` cannot be written, or
    for a fault of the machine or of ssrlab. Each is one line of text; with SSRLAB_TRACEBACK=1 it has its traceback."""
    with interrupts.taken_once():
        return _exit_code(work, what)


def _exit_code(work, what):
    try:
        return work() or 0
    except ResultsError as mistake:
        code, said = 2, str(mistake)
    except Fault as fault:
        code, said = 3, str(fault)
    except OSError as fault:
        code, said = 3, f"cannot write {what}: {fault}; is the disk full, or the folder read-only?"
    except MemoryError:
        code, said = 3, f"not enough memory for {what}; close other programs, or ask for less"
    except KeyboardInterrupt:
        code, said = 3, f"stopped before {what} were written"
    except Exception as fault:  # noqa: BLE001  (whatever it is, no user is helped by a traceback)
        place = traceback.extract_tb(fault.__traceback__)[-1]
        code, said = 3, f"{what} cannot be made: {type(fault).__name__}: {fault} ({os.path.basename(place.filename)}:{place.lineno}); a fault of ssrlab: report it with the files that were read"
    if os.environ.get("SSRLAB_TRACEBACK") == "1":
        traceback.print_exc()
    print(f"{start_of_error()} {shown(said)}", file=sys.stderr)
    return code
