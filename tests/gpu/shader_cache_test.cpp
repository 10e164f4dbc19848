#include "core/gpu/pipelines/shader_cache.h"

#include "core/files.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace fs = std::filesystem;

namespace {

struct ShaderCacheTest : testing::Test {
    ShaderCacheTest() { setenv("SSRLAB_SHADER_CACHE", folder.c_str(), 1); }
    ~ShaderCacheTest() override {
        if (before.empty())
            unsetenv("SSRLAB_SHADER_CACHE");
        else
            setenv("SSRLAB_SHADER_CACHE", before.c_str(), 1);
        fs::remove_all(folder);
    }

    std::set<fs::path> kept() const {
        std::set<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder)) files.insert(entry.path());
        return files;
    }
    /// The file that `compiling` adds.
    fs::path added_by(const std::function<void()>& compiling) const {
        const std::set<fs::path> old = fs::exists(folder) ? kept() : std::set<fs::path>{};
        compiling();
        std::set<fs::path> added = kept();
        for (const fs::path& file : old) added.erase(file);
        EXPECT_EQ(added.size(), 1u);
        return added.empty() ? fs::path() : *added.begin();
    }

    const char* const set = std::getenv("SSRLAB_SHADER_CACHE");
    std::string before = set ? set : "";
    fs::path folder = fs::temp_directory_path() / "shader_cache";
};

/// A text of its own.
const GlslChange changed{"changed", [](const std::string& glsl) { return "const int changed = 1;\n" + glsl; }};

Shader counted() {
    ShaderChanges changes;
    changes.glsl = {changed};
    return compile("counted.comp", "", "layout(constant_id = 7) const bool unused = true;\n", {},
                   ShaderLanguage::vulkan, changes);
}

Shader storing(const std::string& prelude = "") { return compile("store_value.comp", "", prelude); }

void expect_equal(const Shader& a, const Shader& b) {
    EXPECT_EQ(a.spirv, b.spirv);
    ASSERT_EQ(a.interface.resources.size(), b.interface.resources.size());
    for (size_t i = 0; i < a.interface.resources.size(); ++i) {
        const ShaderInterface::Resource &left = a.interface.resources[i], &right = b.interface.resources[i];
        EXPECT_EQ(std::tie(left.name, left.binding, left.kind, left.is_vertex),
                  std::tie(right.name, right.binding, right.kind, right.is_vertex));
    }
    EXPECT_EQ(a.interface.formatted_images, b.interface.formatted_images);
    EXPECT_EQ(a.interface.push_offsets, b.interface.push_offsets);
    EXPECT_EQ(a.interface.push_size, b.interface.push_size);
    EXPECT_EQ(a.interface.outputs, b.interface.outputs);
    EXPECT_EQ(a.interface.constants, b.interface.constants);
    EXPECT_EQ(a.interface.local_size, b.interface.local_size);
}

}  // namespace

TEST_F(ShaderCacheTest, GivesWhatTheCompilerGave) {
    const Shader first = counted();
    EXPECT_FALSE(first.interface.resources.empty());
    expect_equal(counted(), first);
    expect_equal(storing(), storing());
    const auto drawn = [] { return compile("four_targets.frag", "", ""); };
    const Shader fragment = drawn();
    EXPECT_EQ(fragment.spirv.size(), 2u);
    EXPECT_EQ(fragment.interface.outputs.size(), 4u);
    expect_equal(drawn(), fragment);
    EXPECT_EQ(kept().size(), 3u);
}

/// What lies under a shader's key is taken for it: nothing is compiled.
TEST_F(ShaderCacheTest, DoesNotCompileWhatItHas) {
    const fs::path of_counted = added_by(counted), of_storing = added_by([] { storing(); });
    fs::copy_file(of_counted, of_storing, fs::copy_options::overwrite_existing);
    expect_equal(storing(), counted());
}

TEST_F(ShaderCacheTest, KeepsApartWhatTheCompilerIsGiven) {
    added_by([] { storing(); });
    added_by([] { storing("const int unread = 1;\n"); });
    added_by([] {
        ShaderChanges changes;
        changes.glsl = {changed};
        compile("store_value.comp", "", "", {}, ShaderLanguage::vulkan, changes);
    });
    const auto including = [](const std::string& text) {
        compile("missing_include.comp", "", "", {{"no_such_part.glsl", text}});
    };
    added_by([&] { including("const int a = 1;\n"); });
    added_by([&] { including("const int a = 2;\n"); });
    added_by([] { compile("plain_webgl2.frag", "", "", {}, ShaderLanguage::webgl2); });
    added_by([] { compile("plain_webgl2.frag", "", "", {}, ShaderLanguage::vulkan); });
}

TEST_F(ShaderCacheTest, CompilesAgainWhereAFileIsBroken) {
    const Shader right = counted();
    const fs::path file = *kept().begin();
    const std::string whole = read_text(file);
    for (const std::string& broken : {whole.substr(0, whole.size() / 2), std::string("{}"), std::string()}) {
        write_text(file, broken);
        expect_equal(counted(), right);
        EXPECT_EQ(read_text(file), whole) << "kept anew";
    }
    std::string flipped = whole;
    flipped[flipped.size() / 2] ^= 1;
    write_text(file, flipped);
    expect_equal(counted(), right);
}

TEST_F(ShaderCacheTest, IsNotNeeded) {
    std::ofstream(folder) << "no folder";
    expect_equal(storing(), storing());
}

/// Of files that are larger than all may be together, those that were written last stay, and what is none of ours.
TEST_F(ShaderCacheTest, DeletesTheOldestWhereItIsFull) {
    fs::create_directories(folder);
    const auto now = fs::file_time_type::clock::now();
    const auto kept_as = [&](int age) { return folder / (std::string(31, 'a') + std::to_string(age)); };
    std::ofstream(folder / "somebodys").put('x');
    fs::resize_file(folder / "somebodys", 2 * ShaderCache::most_bytes);
    for (int age = 0; age < 4; ++age) {
        const fs::path file = kept_as(age);
        std::ofstream(file).put('x');
        fs::resize_file(file, ShaderCache::most_bytes / 5);  // without contents: takes no room on the disk
        fs::last_write_time(file, now - std::chrono::hours(age));
    }
    ShaderCache::make_room();
    EXPECT_EQ(kept().size(), 5u) << "not yet";
    fs::resize_file(kept_as(3), ShaderCache::most_bytes);
    fs::last_write_time(kept_as(3), now - std::chrono::hours(3));
    ShaderCache::make_room();
    EXPECT_EQ(kept(), (std::set<fs::path>{kept_as(0), kept_as(1), folder / "somebodys"}));
}
