#!/usr/bin/env bash
# Fuzzes every reader of strangers' files (tests/fuzz) with libFuzzer under AddressSanitizer and UndefinedBehaviorSanitizer.
# Findings are kept in build/fuzz/findings; put what was found, cut small, into tests/data/fuzz/TARGET, whose inputs the
# test command replays.
set -euo pipefail
cd "$(dirname "$0")/.."
source experiments/setup.sh

case "${1:-}" in -h | --help)
    echo "usage: tests/fuzz.sh [SECONDS [TARGET...]]; default: 600 seconds of each target of tests/data/fuzz"
    exit ;;
esac
seconds=${1:-600}
shift || true

install_packages "${build_packages[@]}" clang-19 libclang-rt-19-dev  # Debian's default, clang 14, knows too little of C++20
build fuzz fuzz_core fuzz_experiments
cd build/fuzz
mkdir -p findings
[ $# -gt 0 ] || set -- scene gltf glb texture exr png radiance spirv camera environment config technique cases cell manifest inspect results
status=0
for target in "$@"; do
    program=fuzz_core
    case $target in config | technique | cases | cell | manifest | inspect | results) program=fuzz_experiments ;; esac
    say "$target for $seconds s"
    mkdir -p "corpus/$target"
    # A reader may take half a second; what takes longer than ten, or 1.5 GB in place of the 256 MB it is allowed, is a finding.
    SSRLAB_FUZZ_TARGET=$target ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS=suppressions=$PWD/../../tests/sanitizers/leaks.supp:print_suppressions=0 \
        "./$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1536 -max_len=65536 -print_final_stats=1 \
        -artifact_prefix="findings/$target-" "corpus/$target" "../../tests/data/fuzz/$target" 2>"$target.log" ||
        { status=1; tail -40 "$target.log"; }
    grep -E 'cov: ' "$target.log" | tail -1 || true  # none if an input that is kept fails at once
    grep -E 'number_of_executed_units' "$target.log" || true
done
exit $status
