"""Sphinx's configuration of the site that experiments/docs.sh makes of all Markdown files of the repository.

The files stay as their host shows them: what only the site needs, its navigation, is added while they are read.
"""

import re
from pathlib import Path

from docutils import nodes

ROOT = Path(__file__).resolve().parents[2]

# The navigation: a group's title, and its pages with their titles there, or folders, whose pages have their own titles. A page that
# no group has is listed under "More".
GROUPS = {
    "Guides": {
        "experiments/docs/quickstart": "Quickstart",
        "experiments/docs/compare": "Compare techniques in your scene",
        "experiments/docs/advise": "Which technique should I use?",
        "experiments/docs/tune": "Find the best parameters",
        "experiments/docs/write_a_technique": "Write a technique",
        "experiments/docs/judge": "Judge your engine's frames",
        "experiments/docs/gate": "What judge detects",
        "experiments/docs/figures": "Figures and tables",
        "experiments/docs/results_folder": "What a run writes",
        "experiments/docs/numbers": "How the numbers are made",
        "experiments/docs/glossary": "Glossary",
        "experiments/studies/cluster/README": "Many machines",
        "experiments/bridges/captures/README": "Captures of engines",
        "experiments/bridges/engines/README": "Adapters of engines",
    },
    "Reference": {
        "experiments/docs/reference/commands": "Commands",
        "experiments/docs/reference/study_keys": "Keys of a config",
        "experiments/docs/reference/result_columns": "Columns of the results",
        "experiments/docs/reference/shaders": "What shaders read and call",
        "experiments/docs/reference/image_files": "Layers of image files",
        "experiments/docs/reference/techniques/README": "Techniques",
        "experiments/docs/reference/tracers": "Marches",
        "experiments/docs/reference/denoisers": "Denoisers",
        "experiments/docs/reference/metrics": "Metrics",
        "experiments/docs/reference/scenes": "Scenes",
        "experiments/docs/reference/studies": "Studies",
        "experiments/docs/reference/": None,
    },
    "Questions": {
        "experiments/studies/questions/README": "All questions",
        "experiments/studies/questions/": None,
    },
    "Techniques": {
        "variants/README": "Techniques in the source tree",
        "variants/tracers/README": "Marches compared",
        "variants/denoisers/README": "Denoisers compared",
        "variants/composed_ssr/README": "Our own technique",
        "variants/amd_sssr/README": "AMD FidelityFX SSSR",
        "variants/diligent_ssr/README": "DiligentFX",
        "variants/frostbite_sssr/README": "Frostbite",
        "variants/simple_ssr/README": "The simple techniques",
        "variants/four_mode_ssr/README": "An engine's four modes",
        "variants/": None,
    },
    "Inside": {
        "experiments/docs/architecture": "Architecture",
        "experiments/docs/limits": "Limits",
        "metrics/README": "Metrics and intervals",
        "groundtruth/README": "Ground truth",
        "scenes/README": "Scenes",
        "experiments/results/tradeoff/README": "Error against time",
        "experiments/study/stability/README": "Stability and precision",
        "CONTRIBUTING": "Contributing",
    },
}

project = html_title = "ssrlab"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "README"
include_patterns = ["**.md"]
exclude_patterns = ["build", "build-*", "results"]
myst_enable_extensions = ["html_image"]  # <img> with a width, which Markdown images lack
myst_heading_anchors = 4  # levels of headings that links may point to, by the host's names
highlight_language = "none"

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_extra_path = ["index.html"]
html_copy_source = False
html_use_index = False
html_show_copyright = False
html_show_search_summary = False  # browsers let no page from the disk read another, of which it would show the text


def toctree(caption, pages):
    lines = [f"{title} <{page}>" if title else page for page, title in pages.items()]
    return "\n".join(["", "```{toctree}", ":hidden:", f":caption: {caption}", "", *lines, "```", ""])


def add_navigation(app, page, source):
    if page != root_doc:
        return
    rest, groups = app.env.found_docs - {root_doc}.union(*GROUPS.values()), {}
    for caption, entries in GROUPS.items():
        groups[caption] = {name: title for name, title in entries.items() if name in app.env.found_docs}
        for folder in [name for name in entries if name.endswith("/")]:
            inside = sorted(name for name in rest if name.startswith(folder))
            groups[caption] |= dict.fromkeys(inside)
            rest = rest.difference(inside)
    if rest:
        groups["More"] = {name: name.removesuffix("/README") for name in sorted(rest)}
    source[0] += "".join(toctree(caption, pages) for caption, pages in groups.items())


def add_anchors(app, page):
    """`<a id="term"></a>` of a table is a target of links, as headings are."""
    name, labels = app.env.docname, app.env.get_domain("std")
    for raw in page.findall(nodes.raw):
        for anchor in re.findall(r'<a id="([\w-]+)">', raw.astext()):
            target = app.env.doc2path(name, base=False) + "#" + anchor
            labels.anonlabels[target] = name, anchor
            labels.labels[target] = name, anchor, anchor


def mend_debian_theme(app, failure):
    """Debian's furo is not bundled as its authors' is: its script imports another, which browsers do not allow of a classic
    script, and its style sheet imports normalize.css by a path of Debian's web servers."""
    if failure:
        return
    static = Path(app.outdir) / "_static"
    script, spy = static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    code = script.read_text()
    if code.startswith("import Gumshoe"):
        script.write_text(spy.read_text() + code.split("\n", 1)[1])
    sheet, normalize = static / "styles/furo.css", Path("/usr/share/javascript/normalize.css/normalize.css")
    line, rest = sheet.read_text().split("\n", 1)
    if line.startswith("@import url(/javascript/"):
        sheet.write_text(normalize.read_text() + rest)


def setup(app):
    app.connect("source-read", add_navigation)
    app.connect("doctree-read", add_anchors)
    app.connect("build-finished", mend_debian_theme)
