"""Command lines of scripts: a mistake is one sentence that says what to do, as `ssrlab` says it."""

import argparse
import difflib
import os
import sys

from ssrlab.mistakes import shown, start_of_error


class CommandLine(argparse.ArgumentParser):
    """As argparse has it, but without abbreviated options, and with the nearest option for a misspelt one."""

    def __init__(self, **settings):
        super().__init__(allow_abbrev=False, **settings)

    def parse_known_args(self, args=None, namespace=None):
        words = sys.argv[1:] if args is None else list(args)
        if self._subparsers is not None:  # which are CommandLines themselves
            return super().parse_known_args(words, namespace)
        for word in words[: words.index("--") if "--" in words else None]:  # before argparse asks for what is missing
            if word.startswith("--") and word.partition("=")[0] not in self._option_string_actions:
                self.error(self._unknown_option(word.partition("=")[0]))
        arguments, left_over = super().parse_known_args(words, namespace)
        if left_over:
            self.error(self._refusal_of(left_over))
        return arguments, []

    def _refusal_of(self, left_over):
        for word in left_over:
            if word.startswith("-"):
                return self._unknown_option(word.partition("=")[0])
        word = left_over[0]
        for one in self._actions:  # `figures RESULTS figures.json` means --choice
            if one.option_strings and "." in (one.metavar or "") and one.metavar.endswith(os.path.splitext(word)[1] or " "):
                return f"'{word}' is one argument too many; did you mean '{one.option_strings[-1]} {word}'?"
        taken = [one.metavar or one.dest for one in self._actions if not one.option_strings]
        return f"'{word}' is one argument too many; `{self.prog}` takes {', '.join(taken) or 'none'}"

    def _unknown_option(self, option):
        options = [name for one in self._actions for name in one.option_strings if name.startswith("--") and one.help != argparse.SUPPRESS]
        near = difflib.get_close_matches(option, options, 1)
        return f"`{self.prog}` has no option '{option}'; " + (f"did you mean '{near[0]}'?" if near else f"known are: {', '.join(options)}")

    def error(self, message):
        see = " See" if message.endswith("?") else "; see"
        print(f"{start_of_error()} {shown(message)}{see} `{self.prog} --help`", file=sys.stderr)
        sys.exit(2)
