#include "tests/reading_limits.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/json.h"
#include "core/png.h"
#include "tests/error_message.h"
#include "tests/exr_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <cstring>

namespace fs = std::filesystem;

namespace {

struct Reading : testing::Test {
    fs::path folder = fs::temp_directory_path() / "reading_test";
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder / "inside");
    }
    void TearDown() override { fs::remove_all(folder); }

    /// An EXR of 2 x 2 pixels whose header says that its last pixel is another one, in both windows.
    fs::path with_last_pixel(int32_t x, int32_t y) {
        const fs::path file = folder / "wide.exr";
        write_exr(file, HostImage({2, 2}, 3));
        std::string bytes = read_text(file);
        for (const std::string name : {"dataWindow", "displayWindow"}) {
            const size_t values = bytes.find(name) + name.size() + 1 + sizeof("box2i") + sizeof(int32_t);
            std::memcpy(&bytes[values + 8], &x, sizeof x), std::memcpy(&bytes[values + 12], &y, sizeof y);
        }
        write_text(file, bytes);
        return file;
    }
};

/// The message of what reads a file, which must name the option that would allow it.
std::string refused(const auto& action) {
    const std::string message = error_message(action);
    EXPECT_NE(message.find("--max-memory"), std::string::npos) << message;
    return message;
}

}  // namespace

TEST_F(Reading, TakesNoMemoryThatAnExrOnlyAnnounces) {
    const fs::path file = with_last_pixel(9999999, 99999);
    const LimitsOf limits({.memory = 1'000'000'000});
    EXPECT_EQ(error_message([&] { read_exr(file); }),
              file.string() +
                  ": its image of 10000000 x 100000 pixels with 3 channels needs 12 TB of memory, but files may take 1 "
                  "GB; if it is what you expect, allow more with --max-memory");
}

TEST_F(Reading, CountsTheChannelsOfAnExr) {
    LayeredImage image;
    for (int i = 0; i < 100; ++i)
        image.layers.push_back(
            {.name = "layer" + std::to_string(i), .channel_names = "RGBA", .image = HostImage({64, 64}, 4)});
    write_exr(folder / "a.exr", image);
    EXPECT_EQ(read_exr(folder / "a.exr").layers.size(), 100u);
    const LimitsOf limits({.memory = 6'000'000});  // its pixels take 6.6 MB
    EXPECT_NE(refused([&] { read_exr(folder / "a.exr"); }).find("400 channels"), std::string::npos);
}

TEST_F(Reading, RefusesCutHeadersOfExrs) {
    const fs::path file = with_last_pixel(1, 1);
    std::string bytes = read_text(file);
    for (const char flags : {0, 0x10}) {  // 0x10: several parts
        bytes[5] = flags;
        for (const size_t size : {0u, 3u, 8u, 20u, 100u}) {
            write_text(file, bytes.substr(0, size));
            const std::string said = error_message([&] { read_exr(file); });
            EXPECT_NE(said.find(size == 0 ? "it is empty" : "its header is truncated"), std::string::npos) << said;
        }
    }
    bytes[5] = 0, bytes[4] = 3;
    write_text(file, bytes);
    EXPECT_NE(error_message([&] { read_exr(file); }).find("it is of version 3"), std::string::npos);
}

/// Of each of several parts, too, and of one whose type OpenEXR does not know, which says itself how many blocks it
/// has.
TEST_F(Reading, TakesNoMemoryThatAPartOnlyAnnounces) {
    ExrContent small(2, 2), wide(2, 2);
    small.part = "small", wide.part = "wide";
    small.add("", "RGB", {1, 1, 1}), wide.add("Z", 1);
    const fs::path file = folder / "parts.exr";
    write_parts(file, {small, wide});
    const std::string whole = read_text(file);
    EXPECT_EQ(read_exr(file).layers.size(), 2u);
    std::string bytes = whole;
    const size_t window = bytes.rfind("dataWindow") + sizeof("dataWindow") + sizeof("box2i") + sizeof(int32_t);
    const int32_t last = 999'999'999;
    std::memcpy(&bytes[window + 12], &last, sizeof last);
    write_text(file, bytes);
    const LimitsOf limits({.memory = 1'000'000'000});
    EXPECT_NE(refused([&] { read_exr_rgb(file, "small"); }).find("parts.exr: its image of 2 x 2 pixels"),
              std::string::npos);
    bytes = whole;
    const size_t type = bytes.rfind("scanlineimage"),
                 chunks = bytes.rfind("chunkCount") + sizeof("chunkCount") + sizeof("int") + sizeof(int32_t);
    bytes[type] = 'S';
    std::memcpy(&bytes[chunks], &last, sizeof last);
    write_text(file, bytes);
    EXPECT_NE(refused([&] { read_exr_rgb(file, "small"); }).find("parts.exr: its image of 2 x 2 pixels"),
              std::string::npos);
}

/// OpenEXR would set memory aside for lengths that it finds where the attribute does not end for it.
TEST_F(Reading, RefusesAnExrWithAnAttributeOfAnotherLengthThanItsType) {
    const fs::path file = with_last_pixel(1, 1);
    const std::string whole = read_text(file);
    const auto is_malformed = [&](const std::string& type, const std::string& value) {
        constexpr size_t before_attributes = 8;
        std::string attribute = "extra" + std::string(1, '\0') + type + std::string(1, '\0');
        for (int i = 0; i < 4; ++i) attribute += char(value.size() >> 8 * i);
        write_text(file, std::string(whole).insert(before_attributes, attribute + value));
        return error_message([&] { read_exr(file); }).find("truncated or malformed") != std::string::npos;
    };
    const std::string one_channel = std::string("R\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 18), huge = "\xff\xff\xff\x7f";
    EXPECT_TRUE(is_malformed("int", "12345"));
    EXPECT_TRUE(is_malformed("floatvector", "12345"));
    EXPECT_TRUE(is_malformed("stringvector", huge));
    EXPECT_TRUE(is_malformed("preview", huge + huge));
    EXPECT_TRUE(is_malformed("chlist", one_channel));
    EXPECT_TRUE(is_malformed("chlist", one_channel + std::string(9, '\0')));
    EXPECT_FALSE(is_malformed("floatvector", "12345678"));
    EXPECT_FALSE(is_malformed("stringvector", std::string("\2\0\0\0ab", 6)));
    EXPECT_FALSE(is_malformed("unknown", "12345"));
}

TEST_F(Reading, TakesNoMemoryThatAPngOnlyAnnounces) {
    const fs::path file = folder / "a.png";
    write_png(file, HostImage({300, 300}, 3));  // 0.36 MB as RGBA, 1.08 MB as floats
    EXPECT_EQ(read_png_codes(file).extent, glm::uvec2(300));
    {
        const LimitsOf limits({.memory = 1'400'000});
        EXPECT_NE(refused([&] { read_png_codes(file); }).find("a.png: the image of its colours needs 1.44 MB"),
                  std::string::npos);
    }
    const LimitsOf limits({.memory = 350'000});
    EXPECT_NE(refused([&] { read_png_codes(file); }).find("a.png of 300 x 300 pixels needs"), std::string::npos);
}

TEST_F(Reading, CountsTheValuesOfJson) {
    std::string zeros = "[0";
    for (int i = 0; i < 50'000; ++i) zeros += ",0";
    write_text(folder / "flat.json", zeros + "]");
    EXPECT_EQ(read_json(folder / "flat.json").size(), 50'001u);
    // Each value's place has the names of all that encloses it.
    write_text(folder / "named.json", "{\"" + std::string(10'000, 'k') + "\": " + zeros.substr(0, 20'000) + "]}");
    {
        const LimitsOf limits({.memory = 1'500'000});
        EXPECT_NE(refused([&] { read_json(folder / "flat.json"); }).find("flat.json: its JSON"), std::string::npos);
        EXPECT_EQ(read_json(folder / "named.json").size(), 1u);
    }
    const LimitsOf limits({.memory = 50'000'000});
    EXPECT_EQ(read_json(folder / "flat.json").size(), 50'001u);
    EXPECT_NE(refused([&] { read_json_document(folder / "named.json"); }).find("its JSON"), std::string::npos);
}

TEST_F(Reading, SizesOfFilesCount) {
    write_text(folder / "sparse.json", "{}");
    fs::resize_file(folder / "sparse.json", uintmax_t(1) << 40);
    EXPECT_NE(refused([&] { read_json(folder / "sparse.json"); }).find("1099511627776 bytes"), std::string::npos);
}

TEST_F(Reading, MemoryIsGivenBack) {
    const LimitsOf limits({.memory = 1000});
    for (int i = 0; i < 3; ++i) {
        MemoryShare first, second;
        first.add(600, "a");
        const MemoryShare same = first;
        second.add(400, "b");
        EXPECT_NE(refused([&] { first.add(1, "c"); }).find("c needs 1 kB of memory together with what was read"),
                  std::string::npos);
        first.take(second);
        EXPECT_NE(refused([&] { second.add(1, "d"); }).find("d needs"), std::string::npos);
    }
    MemoryShare all;
    all.add(1000, "e");
    EXPECT_NE(refused([] { MemoryShare().add(std::numeric_limits<double>::quiet_NaN(), "f"); }), "");
}

TEST_F(Reading, OnlyRegularFilesAreRead) {
    ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
    const auto readers = {+[](const fs::path& file) { read_text(file); },
                          +[](const fs::path& file) { read_json(file); }, +[](const fs::path& file) { read_exr(file); },
                          +[](const fs::path& file) { read_png_codes(file); }};
    for (const auto& read : readers)
        for (const auto& [file, kind] :
             std::vector<std::pair<fs::path, std::string>>{{folder / "fifo", "it is a FIFO"},
                                                           {"/dev/zero", "it is a device"},
                                                           {folder, "it is a folder"},
                                                           {folder / "none", "no such file"},
                                                           {folder / "fifo" / "x", "no such file"}})
            EXPECT_NE(error_message([&] { read(file); }).find("cannot read " + file.string() + ": " + kind),
                      std::string::npos)
                << error_message([&] { read(file); });
}

/// A process may open so many files. The file is then not empty, and nobody's mistake.
TEST_F(Reading, AFileThatCannotBeOpenedIsAFaultOfTheMachine) {
    const fs::path file = folder / "image.exr", png = folder / "image.png";
    write_exr(file, HostImage({4, 4}, 3, 0.5f));
    write_png(png, HostImage({4, 4}, 3, 0.5f));
    const auto readers = {+[](const fs::path& f, const fs::path&) { read_text(f); },
                          +[](const fs::path& f, const fs::path&) { read_exr(f); },
                          +[](const fs::path&, const fs::path& p) { read_png_codes(p); }};
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    for (const auto& read : readers) {
        const rlimit none{0, before.rlim_max};
        setrlimit(RLIMIT_NOFILE, &none);
        std::string said = "it was read";
        bool is_machine = false;
        try {
            read(file, png);
        } catch (const Error& error) {
            said = error.what(), is_machine = dynamic_cast<const MachineError*>(&error) != nullptr;
        }
        setrlimit(RLIMIT_NOFILE, &before);
        EXPECT_TRUE(is_machine) << said;
        EXPECT_NE(said.find("Too many open files"), std::string::npos) << said;
    }
}

TEST_F(Reading, NamesStayBelowTheFolderOfTheirFile) {
    write_text(folder / "secret", ""), write_text(folder / "inside/own", "");
    fs::create_symlink("own", folder / "inside/link"), fs::create_symlink("../secret", folder / "inside/way_out");
    fs::create_symlink(folder, folder / "inside/folder");
    const auto below = [&](const std::string& name) { return file_below(folder / "inside", name, "a.gltf"); };
    for (const std::string name : {"own", "./own", "sub/../own", "link", "not_yet", "..own"})
        EXPECT_EQ(below(name), folder / "inside" / name);
    for (const std::string name : {"../secret", "sub/../../secret", "way_out", "folder/secret", "..", "/etc/passwd"}) {
        EXPECT_NE(error_message([&] {
                      below(name);
                  }).find("a.gltf: '" + name + "' is not below the folder of the file that names it"),
                  std::string::npos);
        const LimitsOf limits({.memory = 1000, .allows_outside = true});
        EXPECT_EQ(below(name), folder / "inside" / name);
    }
}
