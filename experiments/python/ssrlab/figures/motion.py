"""A shot in motion as an animated GIF: the truth beside techniques, frame by frame."""


import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from ssrlab.figures import numbers, style
from ssrlab.figures.crops import REFERENCE, auto_exposure, best_of_each, display
from ssrlab.mistakes import ResultsError
from ssrlab.text_files import path_inside, whole_file

MOST_POINTS = 5  # beside the truth: two rows of three
COLUMNS = 3
MOST_WIDTH = 1000  # pixels of a row: smaller images are magnified, larger ones reduced
DPI = 110  # of letters
GAP, LINE = 8, 14  # pixels: between pictures, and of a line of text
FRAME_MS, LAST_MS = 150, 600  # the last stays, so that the jump to the first is seen as such


class Animation:
    """Frames as RGB arrays of one size, and a sentence on what they show."""

    def __init__(self, frames, caption):
        self.frames, self.caption = frames, caption

    def save(self, folder, name):
        """Writes name.gif. All frames share 256 colours, median cut's, improved by k-means, between
        which errors are diffused (Floyd and Steinberg 1976)."""
        file = path_inside(folder, style.file_name(name) + ".gif")
        every = np.concatenate(self.frames)[:, :: max(1, len(self.frames) // 2)].copy()  # of the columns: k-means takes seconds
        palette = Image.fromarray(every).quantize(256, method=Image.Quantize.MEDIANCUT, kmeans=1)
        pictures = [Image.fromarray(f).quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG) for f in self.frames]
        times = [FRAME_MS] * (len(pictures) - 1) + [LAST_MS]
        with whole_file(file) as temporary:
            pictures[0].save(
                temporary,
                format="GIF",
                save_all=True,
                append_images=pictures[1:],
                duration=times,
                loop=0,
                comment=self.caption.encode(),
            )
        return [file]


def _reduced(image, factor):
    """The mean radiance of blocks of `factor` x `factor` pixels; incomplete blocks at the right and below are cut off."""
    height, width = image.shape[0] // factor, image.shape[1] // factor
    return image[: height * factor, : width * factor].reshape(height, factor, width, factor, 3).mean(axis=(1, 3))


def _magnified(codes, scale):
    return np.repeat(np.repeat(np.uint8(np.rint(255 * codes)), scale, axis=0), scale, axis=1)


def _row_width(count, size):
    """Pixels of a row of the pictures and what stands beside them."""
    return min(COLUMNS, count) * (size[0] + GAP) + GAP


def _height_of(texts):
    """Pixels of the text with most lines."""
    return round(LINE * style.scale()) * (1 + max(text.count("\n") for text in texts)) + GAP


def _drawn(pictures, titles, caption, below, size):
    """One frame: `pictures` (RGB arrays or None, of `size` width, height) below their titles. `below`: pixels of its caption."""
    columns = min(COLUMNS, len(titles))
    rows = -(-len(titles) // columns)
    width, above = _row_width(len(titles), size), _height_of(titles)
    height = rows * (size[1] + above + GAP) + below + GAP
    figure = plt.figure(figsize=(width / DPI, height / DPI), dpi=DPI)
    for index, (picture, title) in enumerate(zip(pictures, titles)):
        left = GAP + index % columns * (size[0] + GAP)
        top = height - index // columns * (size[1] + above + GAP) - above
        figure.text(left / width, (top + 4) / height, title, va="bottom")
        if picture is None:
            figure.text(left / width, (top - 4) / height, "no reference of this frame", va="top")
        else:
            figure.figimage(picture, left, top - size[1], origin="upper")
    figure.text(GAP / width, below / height, caption, va="top")
    figure.canvas.draw()
    array = np.asarray(figure.canvas.buffer_rgba())[..., :3].copy()
    plt.close(figure)
    return array


def draw(results, shot, chosen):
    """The animation of the frames with kept images; None if there are fewer than two. Points: as asked for, else `none` and the best of
    each technique."""
    target = "incident" if chosen.target in ("camera_radiance", "on_screen") else chosen.target
    frames = results.frames_with_images(shot, target)
    if len(frames) < 2:
        return None
    errors = results.errors_of(chosen.target, chosen.metric, chosen.mask, with_hidden=True)
    wanted = [REFERENCE, *chosen.points] if chosen.points else None
    of_frames = {frame: results.images_of(shot, target, frame, wanted) for frame in frames}
    keys = chosen.points or best_of_each(results, of_frames[frames[-1]], errors, shot, chosen.metric)[:MOST_POINTS]
    for key in keys:
        if any(key not in images for images in of_frames.values()):
            raise ResultsError(f"{chosen.where or shot}: some frames have no image of '{results.point_label(*key)}' for 'target' {target}")
    truths = [images[REFERENCE] for images in of_frames.values() if REFERENCE in images]
    columns = min(COLUMNS, len(keys) + 1)
    factor = -(-columns * of_frames[frames[-1]][keys[0]].shape[1] // MOST_WIDTH)
    of_frames = {frame: {key: _reduced(image, factor) for key, image in images.items()} for frame, images in of_frames.items()}
    shape = of_frames[frames[-1]][keys[0]].shape
    exposure = auto_exposure(truths[-1]) if truths else results.exposure(shot)
    scale = max(1, MOST_WIDTH // (columns * shape[1]))
    size = (scale * shape[1], scale * shape[0])
    titles = ["truth"]
    for key in keys:
        error = errors.get((shot, *key))
        value = f", {chosen.metric} {numbers.short(error.value)}" if error else ""
        titles.append(style.fitted(results.point_label(*key) + value, size[0] / DPI * 2.54))
    caption = f"{results.shot_label(shot)}, {target}, {exposure:+g} EV, first seed; errors of {chosen.mask} pixels over the shot"
    row = (_row_width(len(titles), size) - 2 * GAP) / DPI * 2.54
    captions = {frame: style.fitted(f"{caption}. Frame {frame} of {frames[0]} to {frames[-1]}.", row) for frame in frames}
    below = _height_of(captions.values())  # the same in all frames, which have one size
    drawn = []
    for frame, images in of_frames.items():
        pictures = [_magnified(display(images[k], exposure), scale) if k in images else None for k in (REFERENCE, *keys)]
        drawn.append(_drawn(pictures, titles, captions[frame], below, size))
    return Animation(drawn, caption)
