#!/usr/bin/env bash
# Makes a website of all Markdown files: build/docs/index.html, which opens offline. Installs what is missing (Debian 12);
# fails where a link between files, or to a heading, leads nowhere.
set -euo pipefail
cd "$(dirname "$0")/.."
source experiments/setup.sh

case "${1:-}" in -h | --help)
    echo "usage: experiments/docs.sh [FOLDER]"
    echo "Installs packages, and writes the website into FOLDER (default: build/docs)."
    exit ;;
esac
out=${1:-build/docs}

install_packages "${docs_packages[@]}"
say "Writing $out"
# With Debian's own Python, which has these packages, before any other on the PATH.
/usr/bin/python3 -B -m sphinx -q -W --keep-going -E -c experiments/docs -d "$out/.doctrees" . "$out" ||
    die "the website is not whole: the lines above name what leads nowhere"
rm -r "$out/.doctrees"
say "The website is at $out/index.html"
