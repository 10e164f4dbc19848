"""Compiles and links every shader of the techniques that keep to WebGL 2 in headless Chromium, as a page would.

usage: webgl2_in_browser.py WEBGL2_SHADERS_PROGRAM
"""

import json
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "experiments", "report"))
from report_browser import open_browser

# On the CPU, whatever the machine has: what compiles is decided by ANGLE, not by the driver behind it.
SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

# All are started before the first is asked for, so that the browser may compile them side by side.
COMPILE = """
const gl = document.createElement('canvas').getContext('webgl2');
if (!gl) return {error: 'the browser has no WebGL 2'};
const shader = (type, source) => {
    const made = gl.createShader(type);
    gl.shaderSource(made, source);
    gl.compileShader(made);
    return made;
};
const made = arguments[0].map(source => {
    const vertex = shader(gl.VERTEX_SHADER, source.vertex), fragment = shader(gl.FRAGMENT_SHADER, source.fragment);
    const program = gl.createProgram();
    gl.attachShader(program, vertex);
    gl.attachShader(program, fragment);
    gl.linkProgram(program);
    return {vertex, fragment, program};
});
const logs = made.map(m => {
    for (const [stage, shader] of [['vertex', m.vertex], ['fragment', m.fragment]])
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
            return `${stage} shader does not compile: ${gl.getShaderInfoLog(shader)}`;
    return gl.getProgramParameter(m.program, gl.LINK_STATUS) ? null : `does not link: ${gl.getProgramInfoLog(m.program)}`;
});
return {logs, lost: gl.isContextLost()};
"""

BROKEN = {  # what glslang takes for GLSL ES 3.00 and browsers do not
    "name": "a ternary of structures",
    "files": ["prelude"],
    "vertex": "#version 300 es\nvoid main() { gl_Position = vec4(0.0); }\n",
    "fragment": "#version 300 es\nprecision highp float;\nstruct S { float x; };\nuniform bool b;\nout vec4 color;\n"
    "void main() { S s = b ? S(1.0) : S(2.0); color = vec4(s.x); }\n",
}


def with_file_names(log, files):
    """ANGLE writes "ERROR: 3:17: ..." for line 17 of file 3."""
    return re.sub(r"ERROR: (\d+):", lambda m: files[int(m[1])] + ":" if int(m[1]) < len(files) else m[0], log)


def failures(browser, sources):
    """Name and log of what the browser refuses."""
    found = browser.execute_script(COMPILE, sources)
    if "error" in found or found["lost"]:
        sys.exit(f"webgl2_in_browser: {found.get('error', 'the browser lost its WebGL context')}")
    return [f"{s['name']}: {with_file_names(log, s['files'])}" for s, log in zip(sources, found["logs"]) if log]


def main():
    sources = json.loads(subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout)
    with tempfile.TemporaryDirectory() as profile:
        browser = open_browser(profile, SOFTWARE)
        try:
            if len(failures(browser, [BROKEN])) != 1:
                sys.exit("webgl2_in_browser: the browser compiles what WebGL 2 forbids, so this test is not valid")
            batch = 64  # a message to the browser stays below 2 MB
            refused = [f for i in range(0, len(sources), batch) for f in failures(browser, sources[i : i + batch])]
        finally:
            browser.quit()
    if refused or not sources:
        sys.exit(f"webgl2_in_browser: {len(refused)} of {len(sources)} shaders fail in WebGL 2\n" + "\n".join(refused))
    print(f"{len(sources)} shaders compile and link in WebGL 2")


if __name__ == "__main__":
    main()
