#!/usr/bin/env bash
# OpenImageIO's iconvert writes an EXR's data window as the whole picture where the other format knows no windows (.hdr, .png):
# a picture of 8 x 4 whose data window is 4 x 2 becomes 4 x 2, one with 2 pixels of overscan 12 x 6. oiiotool, of the same package,
# writes 8 x 4 of both. Neither says a word.
# For whom: who converts renders in a script: crops and overscan are usual in compositing, and an environment of another size is
# turned and stretched.
# Version: openimageio-tools 2.4.7.1 (Debian 12, 2.4.7.1+dfsg-2).
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
if [ "$(dpkg-query -W -f='${Version}' openimageio-tools 2>/dev/null)" != 2.4.7.1+dfsg-2 ]; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends openimageio-tools=2.4.7.1+dfsg-2 >/dev/null
fi

size() { oiiotool --info "$1" | sed -E 's/.*: +([0-9]+) x +([0-9]+),.*/\1x\2/'; }
is_same=true
expect() {  # WHAT FILE SIZE
    printf '%-44s %s\n' "$1" "$(size "$2")"
    [ "$(size "$2")" = "$3" ] || is_same=false
}
oiiotool --pattern constant:color=1,0.5,0.25 4x2+2+1 3 --fullsize 8x4+0+0 -o "$tmp/crop.exr"
oiiotool --pattern constant:color=1,0.5,0.25 12x6-2-1 3 --fullsize 8x4+0+0 -o "$tmp/overscan.exr"
for kind in hdr png; do
    for name in crop overscan; do
        iconvert "$tmp/$name.exr" "$tmp/$name.iconvert.$kind"
        oiiotool "$tmp/$name.exr" -o "$tmp/$name.oiiotool.$kind"
    done
    expect "crop of an 8x4 picture, iconvert, .$kind:" "$tmp/crop.iconvert.$kind" 4x2
    expect "crop of an 8x4 picture, oiiotool, .$kind:" "$tmp/crop.oiiotool.$kind" 8x4
    expect "8x4 with overscan, iconvert, .$kind:" "$tmp/overscan.iconvert.$kind" 12x6
    expect "8x4 with overscan, oiiotool, .$kind:" "$tmp/overscan.oiiotool.$kind" 8x4
done
if $is_same; then echo "as described"; else
    echo "BEHAVIOUR CHANGED"
    exit 1
fi
