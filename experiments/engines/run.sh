#!/usr/bin/env bash
# Installs what is missing (Debian 12, and the engines of package.json from npm into build/engines), renders scenes with
# each engine's points, and compares all in one study: results/engines/report.html. Renders what is not there yet.
set -euo pipefail
cd "$(dirname "$0")/../.."
source experiments/setup.sh

scenes=(mirror_pillars roughness_gradient metal_corner fence normal_mapped glossy_stretch offscreen_mirror curved_metal room:17)
points=(default)
engines=()
case "${1:-}" in -h | --help)
    echo "usage: experiments/engines/run.sh [--install] [--scenes 'NAME ...'] [--points 'NAME ...'] [ENGINE ...]"
    echo "Engines: $(cd experiments/engines && printf '%s ' */engine.json | sed 's,/engine.json,,g')"
    echo "Default: all engines, the point 'default', scenes ${scenes[*]}"
    exit ;;
esac
install_only=
while [ $# -gt 0 ]; do
    case $1 in
    --install) install_only=1 ;;
    --scenes) read -ra scenes <<<"$2"; shift ;;
    --points) read -ra points <<<"$2"; shift ;;
    -*) echo "error: unknown option $1; see --help" >&2; exit 2 ;;
    *) engines+=("$1") ;;
    esac
    shift
done

command -v npm >/dev/null || engine_packages+=(npm)  # some packages of nodejs bring it
for file in experiments/engines/*/engine.json; do
    package=$(sed -n 's/^ "debian": "\(.*\)",$/\1/p' "$file")
    [ -z "$package" ] || engine_packages+=("$package")
done
install_packages "${build_packages[@]}" "${engine_packages[@]}"
say "Engines of experiments/engines/package.json"
mkdir -p build/engines
cp experiments/engines/package.json experiments/engines/package-lock.json build/engines/
npm ci --prefix build/engines --no-audit --no-fund --ignore-scripts || die "npm could not install the engines: is there a network connection?"
[ -z "$install_only" ] || exit 0
build release ssrlab

out=results/engines
[ ${#engines[@]} -gt 0 ] || for file in experiments/engines/*/engine.json; do engines+=("$(basename "$(dirname "$file")")"); done
for scene in "${scenes[@]}"; do
    [ -f "$out/scenes/${scene/:/_}/scene.json" ] ||
        build/release/ssrlab scene-for any "$scene" --out "$out/scenes/${scene/:/_}"
done
variants='{"variant": "none", "baseline": true}, {"variant": "mcguire_dda"}'
for engine in "${engines[@]}"; do
    for point in "${points[@]}"; do
        frames=$out/frames/$engine.$point
        for scene in "${scenes[@]}"; do
            view=("$out/scenes/${scene/:/_}/${scene/:/_}".*/)
            [ ! -f "$frames/$(basename "${view[0]}")/f0.s0.exr" ] || continue
            say "$engine, $point, $scene"
            experiments/engines/render.sh "$engine" "$out/scenes/${scene/:/_}" "$frames" --point "$point" ||
                echo "$engine cannot be compared in $scene, for the reason above: it is left out there"
        done
        [ ! -f "$frames/external.json" ] || variants+=", {\"external\": \"frames/$engine.$point\"}"
    done
done
shots=$(printf ', {"scene": "%s"}' "${scenes[@]}")
cat >"$out/study.json" <<END
{"title": "Engines as they ship", "shots": [${shots:2}], "reference": {"samples": 256}, "metrics": ["mse", "relmse", "flip"],
 "masks": ["all", "reflective", "roughness_0_0.1", "roughness_0.1_0.3", "roughness_0.3_0.6"], "targets": ["specular", "image"],
 "timing": {"frames": 0}, "seeds": 1, "variants": [$variants]}
END
build/release/ssrlab run "$out/study.json" --out "$out/results" --replace
