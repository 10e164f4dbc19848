#!/bin/bash
# render.sh ENGINE SCENE_FOLDER OUT [--point NAME] [--set KEY=VALUE ...] [--seeds N]
# Renders what `ssrlab scene-for ENGINE SCENE --out SCENE_FOLDER` wrote; OUT can be judged: `ssrlab judge OUT`.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
command -v node >/dev/null || { echo "error: node is missing; experiments/bridges/engines/run.sh installs it" >&2; exit 3; }
adapter=${1:-}; [[ $adapter == */* ]] || adapter=$here/$adapter
grep -qs '"program"' "$adapter/engine.json" || [ -d "$here/../../../build/engines/node_modules" ] || { echo "error: the engines are not here; experiments/bridges/engines/run.sh installs them" >&2; exit 3; }
exec node "$here/shared/render.js" "$@"
