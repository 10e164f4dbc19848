#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds everything, and runs all tests. Arguments are handed on to ctest,
# e.g. tests/run.sh -R golden_. SSRLAB_PRESET=asan runs them under AddressSanitizer and UndefinedBehaviorSanitizer.
set -euo pipefail
cd "$(dirname "$0")/.."
source experiments/setup.sh

case "${1:-}" in -h | --help)
    echo "usage: [SSRLAB_PRESET=release|debug|asan] tests/run.sh [options of ctest]"
    exit ;;
esac

preset=${SSRLAB_PRESET:-release}
install_packages "${build_packages[@]}" "${test_packages[@]}"
build "$preset"
say "Testing ($preset)"
ctest --preset "$preset" --parallel "$(nproc)" "$@"
