#include "core/image_format.h"

#include <gtest/gtest.h>

using namespace std::string_literals;

namespace {

std::string why(const std::string& bytes, ImageUse use, const std::string& file = "a.img") {
    return why_unreadable({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, file, use);
}

}  // namespace

TEST(ImageFormat, IsThatOfTheFirstBytes) {
    const auto format = [](const std::string& bytes) {
        return image_format({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
    };
    EXPECT_EQ(format("\x89PNG\r\n\x1A\n...."s), ImageFormat::png);
    EXPECT_EQ(format("\xFF\xD8\xFF\xE0...."s), ImageFormat::jpeg);
    EXPECT_EQ(format("\x76\x2F\x31\x01...."s), ImageFormat::exr);
    EXPECT_EQ(format("RIFF\x24\0\0\0WEBPVP8 "s), ImageFormat::webp);
    EXPECT_EQ(format("#?RGBE\n"s), ImageFormat::radiance);
    for (const std::string& other : {""s, "\x89PNG\n\x1A\n"s, "\xFF\xD8"s, "GIF89a"s})
        EXPECT_EQ(format(other), ImageFormat::none);
}

/// Marks as the formats' specifications have them, the name, and the one command.
TEST(ImageFormat, OfWhatIsNotReadIsNamedWithACommand) {
    const std::string by_oiiotool = "; convert it: oiiotool a.img -o a.png";
    for (const auto& [bytes, expected] : std::vector<std::pair<std::string, std::string>>{
             {"II*\0\x08\0\0\0"s, "is a TIFF" + by_oiiotool},
             {"MM\0+\0\x08\0\0"s, "is a BigTIFF" + by_oiiotool},
             {"\xABKTX 20\xBB\r\n\x1A\n"s, "is a KTX 2 texture; convert it: ktx extract --transcode rgba8 a.img a.png"},
             {"DDS |\0\0\0"s, "is a DDS texture" + by_oiiotool},
             {"\0\0\0\x1C"
              "ftypavif\0\0\0\0"s,
              "is an AVIF image; convert it: avifdec a.img a.png"},
             {"\0\0\0\x1C"
              "ftypheic\0\0\0\0"s,
              "is a HEIC image; convert it: heif-convert a.img a.png"},
             {"\0\0\0\x1C"
              "ftypisom\0\0\0\0"s,
              "is a video; convert it: ffmpeg -i a.img -frames:v 1 a.png"},
             {"\0\0\0\x0CjP  \r\n\x87\n"s, "is a JPEG 2000 image" + by_oiiotool},
             {"\0\0\0\x0CJXL \r\n\x87\n"s, "is a JPEG XL image; convert it: djxl a.img a.png"},
             {"\xFF\x0A\x18\x70"s, "is a JPEG XL image; convert it: djxl a.img a.png"},
             {"8BPS\0\x01"s, "is a Photoshop file" + by_oiiotool},
             {"GIF89a"s, "is a GIF" + by_oiiotool},
             {"BM\x36\0\0\0"s, "is a BMP" + by_oiiotool},
             {"PF\n8 4\n-1.0\n"s, "is a PFM" + by_oiiotool},
             {"P6\n2 2\n255\n"s, "is a PPM" + by_oiiotool},
             {"PK\3\4"s, "is a ZIP archive; convert it: unzip a.img"},
             {"version https://git-lfs.github.com/spec/v1\noid sha256:"s,
              "is a pointer of Git LFS; fetch the file itself: git lfs pull"},
             {"\xEF\xBB\xBF\n <!DOCTYPE HTML><html>"s,
              "is an HTML page, which servers send where they have no such file; download it anew"},
             {"<svg xmlns='http://www.w3.org/2000/svg'/>"s,
              "is an SVG drawing; convert it: rsvg-convert a.img -o a.png"},
             {""s, "is empty"},
             {"abcdefgh"s, ""}})
        EXPECT_EQ(why(bytes, ImageUse::codes), expected);
    const std::string tga = "\0\0\2\0\0\0\0\0\0\0\0\0\x08\0\x04\0\x18\0"s;
    EXPECT_EQ(why(tga, ImageUse::codes, "a.tga"), "is a TGA; convert it: oiiotool a.tga -o a.png");
    EXPECT_EQ(why(tga, ImageUse::codes), "");
}

/// Display codes become linear on their way, and what holds radiance is kept as it is.
TEST(ImageFormat, BecomesRadianceByItsCommand) {
    const std::string linear = "-d float --colorconvert sRGB linear -o sky.exr";
    EXPECT_EQ(why("II*\0\x08\0\0\0"s, ImageUse::radiance, "sky.tif"),
              "is a TIFF; convert it: oiiotool sky.tif -o sky.exr");
    EXPECT_EQ(why("BM\x36\0\0\0"s, ImageUse::radiance, "sky.bmp"), "is a BMP; convert it: oiiotool sky.bmp " + linear);
    EXPECT_EQ(why("\xFF\x0A\x18"s, ImageUse::radiance, "sky.jxl"),
              "is a JPEG XL image; convert it: djxl sky.jxl sky.png && oiiotool sky.png " + linear);
    EXPECT_NE(
        why("\x89PNG\r\n\x1A\n"s, ImageUse::radiance, "sky.png").find("is a PNG, whose display codes are no radiance"),
        std::string::npos);
    EXPECT_EQ(why("#?RADIANCE\n"s, ImageUse::radiance), "");
    EXPECT_EQ(why("#?RADIANCE\n"s, ImageUse::codes, "sky.hdr"),
              "is a Radiance image; convert it: oiiotool sky.hdr --colorconvert linear sRGB -d uint16 -o sky.png");
}

/// What is compared may be either, so that each format becomes what keeps it.
TEST(ImageFormat, BecomesWhatCanBeCompared) {
    EXPECT_EQ(why("II*\0\x08\0\0\0"s, ImageUse::comparison),
              "is a TIFF; convert it: oiiotool a.img -o a.exr (if it holds display codes: -o a.png)");
    EXPECT_EQ(why("BM\x36\0\0\0"s, ImageUse::comparison), "is a BMP; convert it: oiiotool a.img -o a.png");
    EXPECT_EQ(
        why("\xFF\xD8\xFF\xE0"s, ImageUse::comparison, "a.jpg"),
        "is a JPEG, whose losses would count as errors; if they are to count, convert it: oiiotool a.jpg -o a.png");
    EXPECT_NE(why("RIFF\x24\0\0\0WEBPVP8 "s, ImageUse::comparison).find("is a WebP, whose losses"), std::string::npos);
    for (const std::string& read : {"\x89PNG\r\n\x1A\n"s, "\x76\x2F\x31\x01"s, "#?RADIANCE\n"s})
        EXPECT_EQ(why(read, ImageUse::comparison), "");
}

/// Names come from files of strangers, and commands are copied.
TEST(ImageFormat, CommandsQuoteTheNamesInThem) {
    EXPECT_EQ(why("GIF89a", ImageUse::codes, "a b'; rm c.gif"),
              "is a GIF; convert it: oiiotool 'a b'\\''; rm c.gif' -o 'a b'\\''; rm c.png'");
    EXPECT_EQ(why("GIF89a", ImageUse::codes, "-o.gif"), "is a GIF; convert it: oiiotool ./-o.gif -o ./-o.png");
    EXPECT_EQ(why("GIF89a", ImageUse::codes, "{png}.gif"), "is a GIF; convert it: oiiotool '{png}.gif' -o '{png}.png'");
}
