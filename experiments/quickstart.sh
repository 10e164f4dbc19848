#!/usr/bin/env bash
# The main job in one command: installs what is missing (Debian 12), builds ssrlab, runs the quickstart study, and says
# where its report is. Arguments are handed on to `ssrlab run`, e.g. --device NAME or --out DIR.
set -euo pipefail
cd "$(dirname "$0")/.."
source experiments/setup.sh

case "${1:-}" in -h | --help)
    echo "usage: experiments/quickstart.sh [options of 'ssrlab run']"
    echo "Installs packages, builds build/release/ssrlab and runs experiments/studies/configs/quickstart.json."
    exit ;;
esac

install_packages "${build_packages[@]}"
build release ssrlab
say "Running experiments/studies/configs/quickstart.json"
build/release/ssrlab run experiments/studies/configs/quickstart.json "$@"
cat <<'END'

Where to go next:
  open the report above in a browser: the comparison, what lies behind each number, and the images
  build/release/ssrlab list scenes                 what each scene tests; also: techniques, presets, tracers, metrics
  build/release/ssrlab describe amd_sssr           a technique and its parameters, for studies of your own (experiments/docs/compare.md)
  build/release/ssrlab figures results/quickstart  figures for a paper
END
