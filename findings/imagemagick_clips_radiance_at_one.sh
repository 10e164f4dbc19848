#!/usr/bin/env bash
# Debian's ImageMagick is built with integers of 16 bits (Q16 without HDRI): it reads Radiance and PFM pictures, clips all light to
# 1 and writes the result as Radiance again, without a warning. A sun of 64 32 16 becomes 1 1 1: white, and a 64th as bright.
# For whom: who resizes, turns or converts environment maps (.hdr, .pfm, .exr) by `convert`. `oiiotool` keeps them.
# Version: ImageMagick 6.9.11-60 Q16 (Debian 12, 8:6.9.11.60+dfsg-1.6+deb12u15); `convert -version` names HDRI where it is built in.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
version=8:6.9.11.60+dfsg-1.6+deb12u15
apt-get update -qq
(cd "$tmp" && apt-get -o APT::Sandbox::User=root download -qq imagemagick-6-common=$version imagemagick-6.q16=$version libmagickcore-6.q16-6=$version \
    libmagickwand-6.q16-6=$version liblqr-1-0 libfftw3-double3 libltdl7 liblcms2-2 libheif1 libde265-0 >/dev/null)
for package in "$tmp"/*.deb; do dpkg -x "$package" "$tmp/root"; done
lib="$tmp/root/usr/lib/x86_64-linux-gnu"
export LD_LIBRARY_PATH="$lib" MAGICK_CONFIGURE_PATH="$tmp/root/etc/ImageMagick-6"
export MAGICK_CODER_MODULE_PATH="$lib/ImageMagick-6.9.11/modules-Q16/coders"

# One pixel: mantissas 128 64 32 with the exponent 135, which are 128 * 2^(135 - 136) = 64, 32 and 16.
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x87' >"$tmp/sun.hdr"
"$tmp/root/usr/bin/convert-im6.q16" "$tmp/sun.hdr" "$tmp/copy.hdr" 2>"$tmp/warnings"

python3 - "$tmp" <<'PY'
import sys
folder = sys.argv[1]
value = lambda texel: [m * 2.0 ** (texel[3] - 136) for m in texel[:3]]
before, after = (value(open(f"{folder}/{name}.hdr", "rb").read()[-4:]) for name in ("sun", "copy"))
warnings = open(f"{folder}/warnings").read()
print("read", before, "wrote", after, "warnings:", warnings or "none")
same = before == [64, 32, 16] and after == [1, 1, 1] and not warnings
print("as described" if same else "BEHAVIOUR CHANGED")
sys.exit(not same)
PY
