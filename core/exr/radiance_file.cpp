#include "core/exr/radiance_file.h"

#include "core/error.h"
#include "core/exr/exr_picture.h"
#include "core/image_format.h"
#include "core/radiance_hdr.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <iterator>

HostImage read_radiance(const std::filesystem::path& file, const std::string& layer, std::vector<std::string>& notes) {
    check_regular_file(file);
    const std::vector<uint8_t> bytes = first_bytes(file);
    if (const std::string why = why_unreadable(bytes, file.string(), ImageUse::radiance); !why.empty())
        fail("cannot read ", file.string(), ": it ", why);
    if (image_format(bytes) == ImageFormat::radiance) return read_radiance_hdr(file, notes);
    ExrPicture picture = read_exr_picture(file, layer);
    std::ranges::move(picture.notes, std::back_inserter(notes));
    return std::move(picture.rgb);
}
