#!/usr/bin/env python3
"""Draws the rooms of the house and which includes which, from the includes: tests/house_map.svg, which experiments/docs/architecture.md shows.

usage: house_map.py [--check]    --check: fail where the picture is not of today's includes"""
import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ROOT = Path(__file__).resolve().parent.parent
PICTURE = ROOT / "tests/house_map.svg"
# A room is a folder, named as paths begin; the longest that fits counts. What it is for stands in its box.
ROOMS = {
    "core": "files, images, JSON, errors",
    "core/scene": "scenes, glTF, cameras",
    "core/gpu": "Vulkan: images, passes, times",
    "core/gbuffer": "what techniques read",
    "variants": "techniques and their parts",
    "groundtruth": "path tracer, references",
    "metrics": "errors of images, statistics",
    "experiments/results": "cells, tables, verdicts",
    "experiments/study": "config, plan; makes cells",
    "experiments/report": "the page of a results folder",
    "experiments/bridges": "other programs' data",
    "experiments/live": "watch and record",
    "experiments/cli": "one file per command",
}
WIDTH, HEIGHT, GAP_X, GAP_Y, MARGIN = 190, 52, 26, 46, 20  # px


def room_of(path):
    return max((room for room in ROOMS if path.startswith(room + "/")), key=len, default=None)


def includes():
    """(room, included room) of all sources."""
    arrows = set()
    for folder in sorted({room.split("/")[0] for room in ROOMS}):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            own = room_of(str(file.relative_to(ROOT)))
            for included in re.findall(r'(?m)^#include "([^"]+)"', file.read_text(encoding="utf-8")):
                other = room_of(included)
                if own and other and own != other:
                    arrows.add((own, other))
    return arrows


def levels(arrows):
    """The rooms of each level: a room stands above all that it includes."""
    level = dict.fromkeys(ROOMS, 0)
    for _ in ROOMS:
        for above, below in sorted(arrows):
            level[above] = max(level[above], level[below] + 1)
    if max(level.values()) >= len(ROOMS):
        cycle = sorted(f"{a} -> {b}" for a, b in arrows if (b, a) in arrows)
        sys.exit(f"rooms include each other in a circle: {', '.join(cycle) or 'of more than two'}")
    return [[room for room in ROOMS if level[room] == n] for n in range(max(level.values()) + 1)]


def without_detours(arrows):
    """Arrows that no way of others replaces."""
    def reaches(start, end, left_out):
        return any((start, via) in arrows and (start, via) != left_out and (via == end or reaches(via, end, left_out)) for via in ROOMS)
    return {arrow for arrow in arrows if not reaches(*arrow, arrow)}


def picture():
    arrows = includes()
    rows = levels(arrows)
    widest = max(map(len, rows))
    width = 2 * MARGIN + widest * WIDTH + (widest - 1) * GAP_X
    height = 2 * MARGIN + len(rows) * HEIGHT + (len(rows) - 1) * GAP_Y
    place = {}
    for n, row in enumerate(rows):
        left = (width - len(row) * WIDTH - (len(row) - 1) * GAP_X) / 2
        for i, room in enumerate(row):
            place[room] = (left + i * (WIDTH + GAP_X), height - MARGIN - HEIGHT - n * (HEIGHT + GAP_Y))
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
             '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
             '<path d="M0 0L8 4L0 8z" fill="#667"/></marker></defs>',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for above, below in sorted(without_detours(arrows)):
        (x1, y1), (x2, y2) = place[above], place[below]
        parts.append(f'<path d="M{x1 + WIDTH / 2:.0f} {y1 + HEIGHT}L{x2 + WIDTH / 2:.0f} {y2:.0f}" stroke="#667" fill="none" marker-end="url(#tip)"/>')
    for room, (x, y) in place.items():
        parts.append(f'<rect x="{x:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="6" fill="#eef3fa" stroke="#345"/>'
                     f'<text x="{x + WIDTH / 2:.0f}" y="{y + 21:.0f}" text-anchor="middle" font-weight="bold">{escape(room)}</text>'
                     f'<text x="{x + WIDTH / 2:.0f}" y="{y + 40:.0f}" text-anchor="middle" font-size="12">{escape(ROOMS[room])}</text>')
    return "\n".join(parts) + "\n</svg>\n"


if __name__ == "__main__":
    drawn = picture()
    if "--check" not in sys.argv[1:]:
        PICTURE.write_text(drawn, encoding="utf-8")
    elif not PICTURE.exists() or PICTURE.read_text(encoding="utf-8") != drawn:
        sys.exit("tests/house_map.svg is not of today's includes: run tests/house_map.py")
