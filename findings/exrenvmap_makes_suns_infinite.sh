#!/usr/bin/env bash
# exrenvmap, OpenEXR's own converter of environment maps, holds all pixels as half floats. A sun of 1e6 in a float32 cube map,
# which the file holds exactly, becomes infinite (halves end at 65504), and the antialiasing filter makes dozens of texels
# around it infinite, too. The program says nothing and exits with 0. The same map with a sun of 6e4 comes out finite.
# For whom: who converts environments between cube and latitude-longitude maps for a renderer: with suns above 65504 first
# scale the map down (`oiiotool sky.exr --mulc 0.01 -o dim.exr`), and scale the light up again in the scene.
# Version: exrenvmap of OpenEXR 3.1.5 (Debian 12). The reason is in its EnvmapImage.h, whose pixels are Imf::Rgba.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
apt-get update -qq
(cd "$tmp" && apt-get -o APT::Sandbox::User=root download -qq \
    openexr=3.1.5-5 libopenexr-3-1-30=3.1.5-5 libimath-3-1-29=3.1.6-1 >/dev/null)
for package in "$tmp"/*.deb; do dpkg -x "$package" "$tmp/root"; done
export LD_LIBRARY_PATH="$tmp/root/usr/lib/x86_64-linux-gnu"
exrenvmap="$tmp/root/usr/bin/exrenvmap"

cat >"$tmp/exr.py" <<'PY'
"""Writes a cube map with a sun, without compression, and counts the texels of a half-float panorama that are infinite."""
import math, struct, sys, zlib

def text(s):
    return s.encode() + b"\0"

def attribute(name, kind, value):
    return text(name) + text(kind) + struct.pack("<i", len(value)) + value

def write_cube(path, side, sun):
    height = 6 * side
    channels = b"".join(text(n) + struct.pack("<iiii", 2, 0, 1, 1) for n in "BGR") + b"\0"
    window = struct.pack("<4i", 0, 0, side - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels)
    header += attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window) + attribute("envmap", "envmap", b"\1")
    header += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", bytes(8))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    size = 8 + 4 * 3 * side
    table = b"".join(struct.pack("<Q", len(header) + 8 * height + size * y) for y in range(height))
    body = b""
    for y in range(height):
        row = [sun if (x, y) == (side // 2, 2 * side + side // 2) else 1.0 for x in range(side)]
        body += struct.pack("<ii", y, size - 8) + struct.pack("<%df" % (3 * side), *row, *row, *row)
    open(path, "wb").write(header + table + body)

def infinite_texels(path):
    """Of a tiled ZIP file whose tiles hold half floats: how many values are infinite, in one channel."""
    data = open(path, "rb").read()
    at, attributes = 8, {}
    while data[at]:
        name_end = data.index(b"\0", at)
        kind_end = data.index(b"\0", name_end + 1)
        size = struct.unpack_from("<i", data, kind_end + 1)[0]
        attributes[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    tile = struct.unpack_from("<II", attributes["tiles"])
    channels = attributes["channels"].count(b"\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0")  # half, not subsampled
    assert attributes["compression"] == b"\3" and channels == 3, "not as exrenvmap writes"
    tiles = -(-(x1 - x0 + 1) // tile[0]) * -(-(y1 - y0 + 1) // tile[1])
    infinite = total = 0
    for i in range(tiles):
        place = struct.unpack_from("<Q", data, at + 1 + 8 * i)[0]
        size = struct.unpack_from("<i", data, place + 16)[0]
        raw = data[place + 20:place + 20 + size]
        width = min(tile[0], x1 - x0 + 1 - tile[0] * struct.unpack_from("<i", data, place)[0])
        height = min(tile[1], y1 - y0 + 1 - tile[1] * struct.unpack_from("<i", data, place + 4)[0])
        if size < 2 * channels * width * height:  # ZIP: differences of bytes, of which the even ones come first
            packed = bytearray(zlib.decompress(raw))
            for k in range(1, len(packed)):
                packed[k] = (packed[k - 1] + packed[k] - 128) & 255
            half = (len(packed) + 1) // 2
            raw = bytes(packed[k // 2 + half * (k % 2)] for k in range(len(packed)))
        values = struct.unpack("<%de" % (len(raw) // 2), raw)
        infinite += sum(map(math.isinf, values))
        total += len(values)
    return infinite // channels, total // channels

if sys.argv[1] == "write":
    write_cube(sys.argv[2], 16, float(sys.argv[3]))
else:
    print(*infinite_texels(sys.argv[2]))
PY
same=1
for sun in 6e4 1e6; do
    python3 "$tmp/exr.py" write "$tmp/cube.exr" $sun
    "$exrenvmap" -l -w 64 "$tmp/cube.exr" "$tmp/latlong.exr"
    read -r infinite all < <(python3 "$tmp/exr.py" count "$tmp/latlong.exr")
    echo "one texel of $sun among 1536 of 1: $infinite of $all texels of the panorama are infinite"
    if [ $sun = 6e4 ]; then [ "$infinite" = 0 ] || same=0; else [ "$infinite" -gt 20 ] || same=0; fi
done
[ $same = 1 ] && echo "as described" || { echo "BEHAVIOUR CHANGED"; exit 1; }
