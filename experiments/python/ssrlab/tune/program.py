"""Points that another program renders, instead of one of ssrlab's techniques.

A point's images lie in a folder of their own, which a study names as `external`. The program is called once for each point and shot as

    PROGRAM SCENE_FOLDER OUT [--point NAME --set KEY=VALUE ...]

SCENE_FOLDER is what `ssrlab scene-for any` wrote of the shot. OUT collects the images of all shots (experiments/docs/judge.md); its
external.json states the `settings` with all their values. Without options the program renders at its defaults."""

import json
import os

from ssrlab import interrupts
from ssrlab.json_files import read_json
from ssrlab.mistakes import ResultsError
from ssrlab.shots import scene_folder_name, scene_for_words
from ssrlab.text_files import exists, path_inside, write_text

OF_SCENES = ("--scene-path", "--cache", "--max-memory", "--allow-outside")  # options of `ssrlab run` that `scene-for` has, too


class ProgramFailed(Exception):
    """The program, or `ssrlab scene-for`, ended with an exit code other than 0."""

    def __init__(self, command, code, log):
        with open(log, encoding="utf-8", errors="surrogateescape") as stream:
            self.said = stream.read().splitlines()[-3:]
        super().__init__(f"{' '.join(command[:2])} ended with exit code {code}; {log} ends with")
        self.code = code


def setting(value):
    """A value on the command line: texts unquoted, else JSON."""
    return value if isinstance(value, str) else json.dumps(value)


def declared_by(settings, axes):
    """JSON schemas of an external.json's settings, with their values as defaults. A program may write 1.0 as 1: a number is whole only if
    the ends of its axis are also written without a point."""
    types = {bool: "boolean", int: "integer", float: "number", str: "string"}
    declared = {name: {"type": types[type(value)], "default": value} for name, value in settings.items()}
    for name, axis in axes.items():
        ends = (axis.get("lin") or axis.get("log")) if isinstance(axis, dict) else None
        if ends and any(isinstance(end, float) for end in ends):
            declared[name]["type"] = "number"
    return declared


class Program:
    def __init__(self, words, folder, out, command, study):
        """`words`: the program and its first arguments; a path is relative to `folder`, which holds the config. `command`: ssrlab and the
        options of `ssrlab run`. `study`: the config."""
        self.words = [os.path.normpath(os.path.join(folder, words[0])) if "/" in words[0] else words[0], *words[1:]]
        self.out = os.path.abspath(out)
        self.ssrlab, self.options = command[0], [word for word in command[1:] if word.split("=")[0] in OF_SCENES]
        self.study = study

    def images(self, name):
        """The folder with a point's images."""
        return path_inside(self.out, f"images/{self.point(name)}")

    @staticmethod
    def point(name):
        """The point's name in the program and in results."""
        return name.replace(" ", "_")

    def render(self, name, values, shots):
        """Renders a point's images of some shots, unless an earlier search did. `values`: settings that differ from the defaults."""
        file = path_inside(self.out, f"images/{self.point(name)}.json")
        done = read_json(file, {"rendered": [str]})["rendered"] if exists(file) else []
        for shot in shots:
            scene = self._scene(shot)
            if scene in done:
                continue
            words = [*self.words, path_inside(self.out, scene), self.images(name), *(["--point", self.point(name)] if values else [])]
            for key, value in values.items():
                words += ["--set", f"{key}={setting(value)}"]
            self._call(words, f"images/{self.point(name)}.log")
            done.append(scene)
            write_text(file, json.dumps({"rendered": done}))

    def _scene(self, shot):
        """The folder of a shot's scene, within the search's folder; written if missing."""
        words = scene_for_words(shot, self.study)
        folder = f"scenes/{scene_folder_name(words)}"
        written = path_inside(self.out, folder)
        if not exists(path_inside(written, "scene.json")):
            self._call([self.ssrlab, "scene-for", "any", *words, "--out", written, *self.options], f"{folder}.log")
        return folder

    def _call(self, words, log):
        log = path_inside(self.out, log)
        os.makedirs(os.path.dirname(log), exist_ok=True)
        with open(log, "a", encoding="utf-8") as stream:
            try:
                code = interrupts.run(words, stdout=stream, stderr=stream)
            except OSError as error:
                raise ResultsError(f"tune: 'program': {words[0]} cannot be run: {error.strerror}") from error
        if code != 0:
            raise ProgramFailed(words, code, log)
