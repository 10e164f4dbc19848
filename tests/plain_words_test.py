"""Documents, messages, comments and names use the field's standard English: none of the phrases that it replaced are left."""
import re
import unittest

from markdown_test import FILES, ROOT

REPLACED = re.compile(
    r"\bcannot be told\b|\btold (from|apart)\b|\btells?( \w+){0,2} apart\b"  # significant, not distinguishable, unknown
    r"|\bmend(s|ed|ing)?\b"  # fixed
    r"|\bbase line\b"  # baseline
    r"|\btechniques bear\b"  # stability under extreme inputs
    r"|\bspeaks? for\b"  # represents
    r"|\basks the scene\b"  # uses scene data
    r"|\bclock did not prove\b"  # timer validation failed
    r"|\beveryone leaves out\b"  # work that can be skipped
    r"|\bthose in the cache are found\b"  # cached ones are reused
    r"|\bfinds all that this one frame shows\b"  # lower bound for any single-frame technique
    r"|\bmay take( any)?\b.{0,12} a frame\b|\breflections may take\b",  # time budget per frame
    re.IGNORECASE,
)
TYPES = (".c", ".cmake", ".comp", ".cpp", ".frag", ".glsl", ".h", ".html", ".js", ".json", ".md", ".py", ".sh", ".txt")


class PlainWords(unittest.TestCase):
    def test_replaced_phrases_are_gone(self):
        found, count = [], 0
        for file in sorted(FILES):
            if not file.endswith(TYPES) or file.endswith("plain_words_test.py") or "/vendor/" in file:
                continue
            count += 1
            for number, line in enumerate((ROOT / file).read_text(encoding="utf-8").splitlines(), 1):
                found += [f"{file}:{number}: '{match[0]}'" for match in REPLACED.finditer(line)]
        self.assertEqual(found, [])
        self.assertGreater(count, 500)


if __name__ == "__main__":
    unittest.main()
