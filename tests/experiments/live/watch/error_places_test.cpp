// Errors as the page shows them: the lines that they name, of a technique's own files and of ssrlab's shaders alone.
#include "experiments/live/watch/error_places.h"
#include "core/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace fs = std::filesystem;

TEST(ErrorPlaces, ShowLinesOfTheFilesThatAreNamed) {
    const fs::path root = fs::temp_directory_path() / "error_places";
    const fs::path copy = root / "out/technique/my_ssr", folder = root / "my_ssr";
    write_text(copy / "shade.comp", "one\ntwo\nthree\nfour\nfive\n");
    write_text(root / "out/technique/secret.glsl", "secret\n");
    write_text(root / "secret.glsl", "secret\n");
    fs::create_symlink(root / "secret.glsl", copy / "link.glsl");

    const auto places = [&](const std::string& text) { return error_with_places(text, copy, folder)["places"]; };
    const nlohmann::json found = places(
        "cannot compile my_ssr/shade.comp:\nmy_ssr/shade.comp:2: 'x' : undeclared\n"
        "shade.comp:2: again\ncommon/mirror_ray.glsl:1: there\nshade.comp:9: too far");
    ASSERT_EQ(found.size(), 2u) << found;
    EXPECT_EQ(found[0]["file"], (folder / "shade.comp").string());
    EXPECT_EQ(found[0]["line"], 2);
    EXPECT_EQ(found[0]["lines"].size(), 4u) << "two lines around it, as far as there are";
    EXPECT_EQ(found[0]["lines"][1]["text"], "two");
    EXPECT_TRUE(found[1]["file"].get<std::string>().ends_with("variants/common/mirror_ray.glsl"));

    for (const char* hostile : {"../secret.glsl:1: a", "../../../secret.glsl:1: a", "link.glsl:1: a",
                                "/etc/passwd:1: a", "../../../../../../etc/passwd:1: a", "my_ssr/../secret.glsl:1: a"})
        EXPECT_TRUE(places(hostile).empty()) << hostile;
    EXPECT_EQ(error_with_places((copy / "technique.json").string() + ":3:1: wrong", copy, folder)["text"],
              (folder / "technique.json").string() + ":3:1: wrong");
    fs::remove_all(root);
}
