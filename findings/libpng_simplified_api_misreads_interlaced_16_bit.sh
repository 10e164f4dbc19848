#!/usr/bin/env bash
# libpng's simplified API (png_image_finish_read) gives wrong pixels for an interlaced PNG of 16 bits that is read as 8-bit
# RGB: a third of the values of a ramp, by up to 191 of 255 codes. The same picture without interlacing is right, and so are
# both by libpng's full interface, and as 16-bit linear light. No warning, no error (libpng issue 853).
# For whom: who reads pictures by that API, whose documentation promises every PNG, and compares or measures them.
# Version: libpng 1.6.39 (Debian 12, 1.6.39-2+deb12u6).
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
apt-get update -qq
(cd "$tmp" && apt-get -o APT::Sandbox::User=root download -qq libpng-dev=1.6.39-2+deb12u6 libpng16-16=1.6.39-2+deb12u6 >/dev/null)
for package in "$tmp"/*.deb; do dpkg -x "$package" "$tmp/root"; done
lib="$tmp/root/usr/lib/x86_64-linux-gnu"

# A ramp of 16 x 8 pixels, in order and interlaced (Adam7: PNG, third edition, section 8), both with an sRGB chunk.
/usr/bin/python3 - "$tmp" <<'PY'
import struct, sys, zlib

WIDTH, HEIGHT = 16, 8
PASSES = {"plain": [(0, 0, 1, 1)], "interlaced": [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]}

def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

for name, passes in PASSES.items():
    rows = b""
    for left, top, dx, dy in passes:
        for y in range(top, HEIGHT, dy):
            rows += b"\0" + b"".join(struct.pack(">3H", 4096 * x, 8191 * y, 2849 * (x + y)) for x in range(left, WIDTH, dx))
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 2, 0, 0, name == "interlaced")
    with open(f"{sys.argv[1]}/{name}.png", "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
PY

cat >"$tmp/read.c" <<'C'
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
enum { width = 16, height = 8, count = width * height * 3 };
static void simply(const char* file, png_uint_32 format, void* pixels) {
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, file)) exit(2);
    image.format = format;
    if (!png_image_finish_read(&image, NULL, pixels, 0, NULL) || image.warning_or_error) exit(2);
}
static void fully(const char* file, png_uint_16* pixels) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE* in = fopen(file, "rb");
    if (!in || setjmp(png_jmpbuf(png))) exit(2);
    png_init_io(png, in);
    png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, NULL);
    for (int y = 0; y < height; ++y) memcpy(pixels + y * width * 3, png_get_rows(png, info)[y], width * 6);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(in);
}
int main(int argument_count, char** files) {
    (void)argument_count;
    png_uint_16 full[2][count], linear[2][count];
    png_byte codes[2][count];
    int differ[3] = {0}, most = 0;
    for (int i = 0; i < 2; ++i) {
        fully(files[i + 1], full[i]);
        simply(files[i + 1], PNG_FORMAT_LINEAR_RGB, linear[i]);
        simply(files[i + 1], PNG_FORMAT_RGB, codes[i]);
    }
    for (int i = 0; i < count; ++i) {
        const int off = abs(codes[0][i] - codes[1][i]);
        most = off > most ? off : most;
        differ[0] += full[0][i] != full[1][i], differ[1] += linear[0][i] != linear[1][i], differ[2] += off > 0;
    }
    printf("libpng %s: of %d values of a picture, interlaced and not, differ: %d by the full interface, %d as linear, %d as 8-bit RGB (by up to %d)\n",
           png_get_libpng_ver(NULL), count, differ[0], differ[1], differ[2], most);
    const int same = differ[0] == 0 && differ[1] == 0 && differ[2] == 128;
    puts(same ? "as described" : "BEHAVIOUR CHANGED");
    return !same;
}
C
gcc -O1 -I"$tmp/root/usr/include" -I"$tmp/root/usr/include/libpng16" "$tmp/read.c" -o "$tmp/read" "$lib/libpng16.so.16" -Wl,-rpath-link,"$lib" -Wno-clobbered
LD_LIBRARY_PATH="$lib" "$tmp/read" "$tmp/plain.png" "$tmp/interlaced.png"
