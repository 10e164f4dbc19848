#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds everything, runs all tests, and says what took longest. Arguments are
# handed on to ctest, e.g. tests/run.sh -R golden_. SSRLAB_PRESET=asan runs them under AddressSanitizer and
# UndefinedBehaviorSanitizer.
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
results=$PWD/build/$preset/tests.xml
rm -f "$results"
status=0
# One more than there are cores: tests wait for browsers, clocks and the device.
ctest --preset "$preset" --parallel "$(($(nproc) + 1))" --output-junit "$results" "$@" || status=$?
python3 tests/slowest.py "build/$preset" "$results"
exit "$status"
