#!/usr/bin/env bash
# Checks the exporters of captures with the programs that they are for: Blender, and RenderDoc on ssrlab itself. Installs
# what is missing (Debian 12: 1.5 GB) and takes some minutes; what needs neither program is in the suite.
set -euo pipefail
cd "$(dirname "$0")/.."
source experiments/setup.sh

case "${1:-}" in -h | --help)
    echo "usage: tests/exporters.sh"
    exit ;;
esac

install_packages "${build_packages[@]}" "${exporter_packages[@]}"
build release ssrlab
say "Blender"
/usr/bin/python3 -B tests/experiments/bridges/captures/blender_check.py build/release/ssrlab
say "RenderDoc"
/usr/bin/python3 -B tests/experiments/bridges/captures/renderdoc_check.py build/release/ssrlab
