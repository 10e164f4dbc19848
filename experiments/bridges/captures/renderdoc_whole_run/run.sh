#!/bin/sh
# Captures a Vulkan program that presents nothing, from its first submission to the end of its device.
# usage: run.sh OUT.rdc PROGRAM [ARGUMENT...]      Needs gcc, libvulkan-dev and librenderdoc-dev.
set -e
here=$(cd "$(dirname "$0")" && pwd)
out=$(realpath "$1")
shift
layers=$(mktemp -d)
trap 'rm -rf "$layers"' EXIT
mkdir "$layers/above" "$layers/renderdoc"
gcc -O1 -Wall -shared -fPIC -o "$layers/above/libwhole_run.so" "$here/whole_run.c" -ldl
cp "$here/whole_run.json" "$layers/above"
# RenderDoc's own layer is implicit, which the loader puts above all that are asked for: it must lie below.
python3 - "$layers/renderdoc/renderdoc.json" <<'EOF'
import json, sys
layer = json.load(open("/usr/share/vulkan/implicit_layer.d/renderdoc_capture.json"))
for key in ("enable_environment", "disable_environment"):
    layer["layer"].pop(key)
json.dump(layer, open(sys.argv[1], "w"))
EOF
VK_LAYER_PATH="$layers/above:$layers/renderdoc" WHOLE_RUN_FILE="$layers/frame" \
    VK_INSTANCE_LAYERS=VK_LAYER_SSRLAB_whole_run:VK_LAYER_RENDERDOC_Capture "$@"
set -- "$layers"/frame*.rdc
[ -e "$1" ] || { echo "error: RenderDoc wrote no capture" >&2; exit 1; }
mv "$1" "$out"
