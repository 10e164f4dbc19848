#!/usr/bin/env bash
# Installs what is missing (Debian 12, and the engines of package.json from npm into build/engines), renders what engines.json
# names as `external`, as far as it is not there yet, and compares: results/engines/results/report.html.
set -euo pipefail
cd "$(dirname "$0")/../../.."
source experiments/setup.sh

install_only=
engines=()
for word in "$@"; do
    case $word in
    -h | --help)
        echo "usage: experiments/bridges/engines/run.sh [--install | ENGINE ...]"
        echo "--install: installs alone. ENGINE: renders those alone, and compares nothing; default: all."
        echo "Engines: $(cd experiments/bridges/engines && printf '%s ' */engine.json | sed 's,/engine.json,,g')"
        exit ;;
    --install) install_only=1 ;;
    -*) echo "error: unknown option $word; see --help" >&2; exit 2 ;;
    *) engines+=("$word") ;;
    esac
done

command -v npm >/dev/null || engine_packages+=(npm)  # some packages of nodejs bring it
for file in experiments/bridges/engines/*/engine.json; do
    package=$(sed -n 's/^ "debian": "\(.*\)",$/\1/p' "$file")
    [ -z "$package" ] || engine_packages+=("$package")
done
install_packages "${build_packages[@]}" "${engine_packages[@]}"
say "Engines of experiments/bridges/engines/package.json"
mkdir -p build/engines
cp experiments/bridges/engines/package.json experiments/bridges/engines/package-lock.json build/engines/
npm ci --prefix build/engines --no-audit --no-fund --ignore-scripts || die "npm could not install the engines: is there a network connection?"
[ -z "$install_only" ] || exit 0
build release ssrlab

out=results/engines
experiments/bridges/engines/render_study.py build/release/ssrlab experiments/bridges/engines/engines.json "$out" "${engines[@]}"
[ ${#engines[@]} -gt 0 ] || build/release/ssrlab run experiments/bridges/engines/engines.json --out "$out/results"
