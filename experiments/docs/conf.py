"""Sphinx's configuration of the site that experiments/docs.sh makes of all Markdown files of the repository.

The files stay as their host shows them: what only the site needs, its navigation, is added while they are read.
"""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# The navigation: a group's title, and its pages with their titles there. A page that is not named is listed under "More".
PAGES = {
    "Running studies": {
        "experiments/studies/findings/README": "Findings",
        "experiments/README": "Studies and their keys",
        "experiments/RESULTS": "A results folder",
        "experiments/bridges/captures/README": "Captures of engines",
        "experiments/studies/cluster/README": "Many machines",
        "scenes/README": "Scenes",
        "metrics/README": "Metrics",
        "groundtruth/README": "Ground truth",
        "experiments/results/tradeoff/README": "Error against run time",
        "experiments/study/stability/README": "Stability and precision",
    },
    "Techniques": {
        "variants/README": "Adding one",
        "variants/tracers/README": "Tracers",
        "variants/amd_sssr/README": "AMD FidelityFX SSSR",
        "variants/diligent_ssr/README": "DiligentFX",
        "variants/frostbite_sssr/README": "Frostbite",
        "variants/simple_ssr/README": "The simple techniques",
        "variants/four_mode_ssr/README": "An engine's four modes",
    },
    "Origins of data": {
        "variants/common/blue_noise_table": "Blue noise",
        "tests/data/vectors/README": "Test vectors",
    },
}

project = html_title = "ssrlab"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "README"
include_patterns = ["**.md"]
exclude_patterns = ["build", "build-*", "results"]
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
    lines = [f"{title} <{page}>" for page, title in pages.items()]
    return "\n".join(["", "```{toctree}", ":hidden:", f":caption: {caption}", "", *lines, "```", ""])


def add_navigation(app, page, source):
    if page != root_doc:
        return
    named = {name: pages for name, pages in PAGES.items()}
    rest = app.env.found_docs - {root_doc}.union(*PAGES.values())
    if rest:
        named["More"] = {name: name.removesuffix("/README") for name in sorted(rest)}
    source[0] += "".join(toctree(caption, pages) for caption, pages in named.items())


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
    app.connect("build-finished", mend_debian_theme)
