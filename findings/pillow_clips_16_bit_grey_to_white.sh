#!/usr/bin/env bash
# Pillow's convert("L") and convert("RGB") of a grey PNG of 16 bits take each code above 255 of 65535 for white, without a
# warning: 99.6 % of all codes. A colour PNG of 16 bits loses its low byte as soon as it is opened, again without a word, so that
# the same grey picture is 1 or 255, by whether it was written in grey or in colour.
# For whom: who scales depth, roughness or height maps to 8 bits, or looks at them, by Image.open(file).convert("L").
# Version: python3-pil 9.4.0 (Debian 12, 9.4.0-1.1+deb12u1).
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
if [ "$(dpkg-query -W -f='${Version}' python3-pil 2>/dev/null)" != 9.4.0-1.1+deb12u1 ]; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends python3-pil=9.4.0-1.1+deb12u1 >/dev/null
fi

cat >"$tmp/look.py" <<'PY'
import io, struct, sys, zlib
import PIL
from PIL import Image

CODES = (0, 255, 256, 300, 32768, 65535)  # of 65535

def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

def picture(color_type, channels):
    """A row of greys, as a PNG of 16 bits (color type 0: grey, 2: colour)."""
    row = b"\0" + b"".join(struct.pack(">H", code) * channels for code in CODES)
    data = chunk(b"IHDR", struct.pack(">IIBBBBB", len(CODES), 1, 16, color_type, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(row))
    return Image.open(io.BytesIO(b"\x89PNG\r\n\x1a\n" + data + chunk(b"IEND", b"")))

grey, color = picture(0, 1), picture(2, 3)
found = {"codes": CODES, "grey as L": tuple(grey.convert("L").getdata()), "colour as L": tuple(color.convert("L").getdata()),
         "grey as RGB": tuple(pixel[0] for pixel in grey.convert("RGB").getdata())}
print("Pillow", PIL.__version__, "opens them as", grey.mode, "and", color.mode)
for name, values in found.items():
    print(f"{name:12}", *(f"{value:6}" for value in values))
same = found["grey as L"] == found["grey as RGB"] == tuple(min(code, 255) for code in CODES)
same = same and found["colour as L"] == tuple(code >> 8 for code in CODES)
print("as described" if same else "BEHAVIOUR CHANGED")
sys.exit(not same)
PY
/usr/bin/python3 "$tmp/look.py"
