"""Names beside the marks of a panel that cover neither each other nor marks nor whiskers: each takes the nearest free place
around its mark, and a thin line leads to those that are not close."""

import math

import numpy as np

from ssrlab.figures import style

DISTANCES = (3, 6, 10, 15, 21, 28, 36, 45, 55, 70, 90)  # pt from the mark's middle to the label's nearest side, beyond the mark
DIRECTIONS = 24
RETRIES = 10
NEAR = 4  # pt up to which a label needs no line
GAP = 1.2  # pt that stay free around each label
MARK = 3.2  # pt, half of a mark's size with its edge, on a page


def _overlaps(box, boxes):
    """Whether box [x0, y0, x1, y1] meets any of the rows of `boxes`."""
    b = np.asarray(boxes).reshape(-1, 4)
    return bool(((box[0] < b[:, 2]) & (box[2] > b[:, 0]) & (box[1] < b[:, 3]) & (box[3] > b[:, 1])).any())


def _is_inside(box, frame):
    return box[0] >= frame[0] and box[1] >= frame[1] and box[2] <= frame[2] and box[3] <= frame[3]


def _leader(anchor, box):
    """Small boxes along the line from a mark to the nearest place of its label."""
    end = (min(max(anchor[0], box[0]), box[2]), min(max(anchor[1], box[1]), box[3]))
    length = math.dist(anchor, end)
    steps = np.linspace(MARK, max(length - 1, MARK), max(int(length / 2), 1))
    points = np.array(anchor) + np.outer(steps / max(length, 1e-9), np.subtract(end, anchor))
    return np.hstack([points - 0.3, points + 0.3])


def _candidates(anchor, size):
    """(distance, box) around a mark, the nearest first, right and above before left and below."""
    half_w, half_h = size[0] / 2, size[1] / 2
    for distance in DISTANCES:
        for step in range(DIRECTIONS):
            angle = 2 * math.pi * ((step + 1) // 2 * (-1) ** step) / DIRECTIONS + math.pi / 6
            x = anchor[0] + math.cos(angle) * (MARK + distance + half_w)
            y = anchor[1] + math.sin(angle) * (MARK + distance + half_h)
            yield distance, np.array([x - half_w, y - half_h, x + half_w, y + half_h])


def _arranged(order, anchors, sizes, obstacles, frame):
    """(cost, {index: box}) of the labels in this order; the index of the first that finds no place, where there is one."""
    taken, places, cost = np.asarray(obstacles, float).reshape(-1, 4), {}, 0.0
    for index in order:
        for distance, box in _candidates(anchors[index], sizes[index]):
            wide = box + np.array([-GAP, -GAP, GAP, GAP])
            if not _is_inside(wide, frame) or _overlaps(wide, taken):
                continue
            line = _leader(anchors[index], box) if distance > NEAR else np.empty((0, 4))
            others = list(places.values())
            if len(line) and others and any(_overlaps(small, others) for small in line):
                continue
            taken = np.vstack([taken, wide, line])
            places[index] = box
            cost += distance
            break
        else:
            return index
    return cost, places


def _arranged_somehow(order, *what):
    """_arranged(), with labels that found no place before all others in the next attempt; None after RETRIES of them."""
    for _ in range(RETRIES):
        found = _arranged(order, *what)
        if not isinstance(found, int):
            return found
        order = [found, *(i for i in order if i != found)]
    return None


def _pixels(axes, xs, ys):
    return axes.transData.transform(np.column_stack([xs, ys]).astype(float))


def place_labels(axes, items, whiskers=()):
    """`items`: (x, y, text, colour), the place in data units; `whiskers`: (x0, y0, x1, y1) there that no label may cover. Draws the labels and
    returns True, or draws none and returns False where they do not all find a place. The layout must be final."""
    if not items:
        return True
    figure = axes.figure
    figure.draw_without_rendering()
    scale = style.scale()
    unit = figure.dpi / 72 * scale  # pixels of what is a point on a page
    anchors = _pixels(axes, [i[0] for i in items], [i[1] for i in items]) / unit
    renderer = figure.canvas.get_renderer()
    sizes = []
    for _, _, text, _ in items:
        drawn = axes.text(0, 0, text)
        box = drawn.get_window_extent(renderer)
        drawn.remove()
        sizes.append((box.width / unit, box.height / unit))
    obstacles = [[x - MARK, y - MARK, x + MARK, y + MARK] for x, y in anchors]
    for x0, y0, x1, y1 in whiskers:
        (a, b), (c, d) = _pixels(axes, [x0, x1], [y0, y1]) / unit
        obstacles.append([min(a, c) - 0.5, min(b, d) - 0.5, max(a, c) + 0.5, max(b, d) + 0.5])
    window = axes.get_window_extent(renderer)
    frame = np.array([window.x0, window.y0, window.x1, window.y1]) / unit
    near = [sum(math.dist(a, b) < 30 for b in anchors) for a in anchors]
    every = range(len(items))
    orders = [sorted(every, key=key) for key in (lambda i: -near[i], lambda i: anchors[i][0], lambda i: -anchors[i][0],
                                                lambda i: anchors[i][1], lambda i: -anchors[i][1])]
    found = [a for a in (_arranged_somehow(o, anchors, sizes, obstacles, frame) for o in orders) if a is not None]
    if not found:
        return False
    _, places = min(found, key=lambda a: a[0])
    for index, (x, y, text, color) in enumerate(items):
        box, anchor = places[index], anchors[index]
        middle = (scale * ((box[0] + box[2]) / 2 - anchor[0]), scale * ((box[1] + box[3]) / 2 - anchor[1]))
        end = (min(max(anchor[0], box[0]), box[2]), min(max(anchor[1], box[1]), box[3]))
        is_far = math.dist(anchor, end) > MARK + NEAR
        axes.annotate(
            text,
            (x, y),
            middle,
            textcoords="offset points",
            ha="center",
            va="center",
            color=color,
            arrowprops={"arrowstyle": "-", "linewidth": 0.4 * scale, "color": "#888888", "shrinkA": 0, "shrinkB": scale * MARK} if is_far else None,
        ).set_in_layout(False)
    return True
