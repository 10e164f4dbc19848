// Cells on disk: what is damaged is not believed, what is claimed is done once, what is stale is known.
#include "experiments/results/cells/cell_store.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/results/cells/image_path.h"
#include "experiments/results/cells/provenance.h"
#include "experiments/results/cells/stale_files.h"

#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {

struct CellStoreTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / "cells";
    std::vector<std::string> notices;
    CellStore store{folder, [this](const std::string& text) { notices.push_back(text); }};

    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }

    nlohmann::json image(const std::string& stem) {
        nlohmann::json entry = {
            {"shot", "s"}, {"frame", 0}, {"technique", "v"}, {"kind", "result"}, {"target", "image"}};
        for (const std::string kind : {"exr", "png"}) {
            const std::string name = "images/s/" + stem + "." + kind;
            write_text(folder / name, stem + kind);
            entry[kind] = name, entry[kind + "_hash"] = file_hash(folder / name);
        }
        return entry;
    }
    /// A cell whose numbers are hard to keep.
    Cell cell() {
        Cell cell;
        cell.results.push_back(
            {.shot = "s", .metric = "psnr", .value = {}, .low = -0.0, .high = 0.1 + 0.2, .pixels = 7});
        cell.times.push_back({.stage = "x", .milliseconds = 1e-300, .foreign_load = 1.0 / 3, .disturbed = true});
        cell.images.push_back(image("a"));
        cell.provenance = nlohmann::json::parse(R"({
            "what": "", "started": "", "finished": "",
            "ssrlab": {"version": "", "commit": "", "dirty": false, "code": "", "compiler": "", "build": "", "estimators": 1},
            "device": {"name": "", "driver": "", "api": "", "type": "", "memory_mib": 1.5},
            "host": {"name": "", "cpu": "", "cores": 1, "memory_gib": 1.5, "kernel": ""}})");
        return cell;
    }
};

}  // namespace

TEST_F(CellStoreTest, KeepsCells) {
    EXPECT_FALSE(store.load("abc"));
    store.save("abc", cell());
    const auto back = store.load("abc");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->name, "abc");
    EXPECT_EQ(back->results.front().metric, "psnr");
    EXPECT_FALSE(back->results.front().value);
    EXPECT_TRUE(std::signbit(*back->results.front().low));
    EXPECT_EQ(back->results.front().high, 0.1 + 0.2);
    EXPECT_EQ(back->times.front().milliseconds, 1e-300);
    EXPECT_EQ(back->times.front().foreign_load, 1.0 / 3);
    EXPECT_TRUE(back->times.front().disturbed);
    EXPECT_TRUE(notices.empty());
}

TEST_F(CellStoreTest, BelievesNothingDamaged) {
    store.save("abc", cell());
    const std::string whole = read_text(store.file("abc"));
    const auto refused = [&](const std::string& text) {
        write_text(store.file("abc"), text);
        notices.clear();
        return !store.load("abc") && notices.size() == 1;
    };
    EXPECT_TRUE(refused(whole.substr(0, 20)));
    std::string other = whole;  // still JSON, still a cell
    other.replace(other.find("\"pixels\":7"), 10, "\"pixels\":8");
    EXPECT_TRUE(refused(other));
    EXPECT_TRUE(refused("{}"));
    write_text(store.file("abc"), whole);
    EXPECT_TRUE(store.load("abc"));
    fs::rename(store.file("abc"), store.file("def"));
    EXPECT_FALSE(store.load("def")) << "another cell's numbers under this name";
}

TEST_F(CellStoreTest, DoesACellAgainWhoseImagesAreNotThere) {
    store.save("abc", cell());
    write_text(folder / "images/s/a.png", "of another program");
    EXPECT_FALSE(store.load("abc"));
    EXPECT_NE(notices.back().find("images/s/a.png is not the one that it made"), std::string::npos);
    fs::remove_all(folder / "images");
    EXPECT_FALSE(store.load("abc"));
    EXPECT_NE(notices.back().find("images/s/a.exr is missing"), std::string::npos);
    EXPECT_TRUE(store.read("abc"));
}

TEST_F(CellStoreTest, GivesACellToOneAtATime) {
    const CellStore other(folder, [](const std::string&) {});
    {
        const auto mine = store.claim("abc", false);
        ASSERT_TRUE(mine);
        EXPECT_FALSE(other.claim("abc", false));
        EXPECT_TRUE(other.claim("def", false)) << "another cell is free";
    }
    EXPECT_TRUE(other.claim("abc", true)) << "given back";
    EXPECT_TRUE(fs::is_empty(folder / "cells")) << "claims leave nothing behind";
}

TEST_F(CellStoreTest, KnowsWhatIsStaleAndTouchesNothingElse) {
    Cell used = cell(), old = cell();
    old.images = nlohmann::json::array({image("old")});
    store.save("used", used), store.save("old", old);
    write_text(folder / "cells/notes.json", "{}");  // a user's own
    write_text(folder / "images/s/mine.png", "a user's own");
    write_text(folder / "outside.png", "a user's own");
    fs::create_symlink(folder / "outside.png", folder / "images/s/link.png");
    EXPECT_EQ(store.names(), (std::vector<std::string>{"notes", "old", "used"})) << "unread";
    const nlohmann::json reference = image("reference"), older = image("older");
    const nlohmann::json before = {{"images",
                                    {used.images[0],
                                     reference,
                                     {{"exr", "../outside.png"}, {"png", "images/../outside.png"}},
                                     {{"exr", (folder / "outside.png").string()}, {"png", "images/s/link.png"}},
                                     {{"exr", "images/s/gone.exr"}},
                                     7}},
                                   {"stale", {{"images", {older["exr"], older["png"]}}}}};
    const nlohmann::json now = {{"images", {used.images[0]}}};

    const StaleFiles stale = find_stale_files(folder, store, {"used"}, now, before);
    EXPECT_EQ(stale.cells, (std::vector<std::string>{"old"}));
    EXPECT_EQ(stale.images,
              (std::vector<std::string>{"images/s/old.exr", "images/s/old.png", "images/s/older.exr",
                                        "images/s/older.png", "images/s/reference.exr", "images/s/reference.png"}));
    remove_stale_files(folder, store, stale);
    EXPECT_TRUE(store.load("used"));
    EXPECT_FALSE(fs::exists(store.file("old")));
    for (const char* kept : {"cells/notes.json", "images/s/mine.png", "outside.png", "images/s/link.png"})
        EXPECT_TRUE(fs::exists(folder / kept)) << kept;
    EXPECT_TRUE(find_stale_files(folder, store, {"used"}, now, nullptr).is_empty());
}

TEST(Provenance, ListsEachMakerOnceWithItsCells) {
    const auto made = [](const char* name, const char* host, const char* started, const char* finished) {
        Cell cell;
        cell.name = name;
        cell.provenance = {{"ssrlab", {{"commit", "c"}}}, {"device", {{"name", "d"}}},
                           {"host", {{"name", host}}},    {"what", std::string("cell ") + name},
                           {"started", started},          {"finished", finished}};
        return cell;
    };
    const std::vector<Cell> cells = {made("1", "a", "2026-01-02", "2026-01-03"),
                                     made("2", "b", "2026-01-05", "2026-01-06"),
                                     made("3", "a", "2026-01-01", "2026-01-04")};
    const nlohmann::json entries = provenance_entries(cells);
    ASSERT_EQ(entries.size(), 2u);
    EXPECT_EQ(entries[0]["host"]["name"], "a");
    EXPECT_EQ(entries[0]["started"], "2026-01-01");
    EXPECT_EQ(entries[0]["finished"], "2026-01-04");
    ASSERT_EQ(entries[0]["cells"].size(), 2u);
    EXPECT_EQ(entries[0]["cells"][1]["cell"], "3");
    EXPECT_EQ(entries[0]["cells"][1]["what"], "cell 3");
    EXPECT_EQ(entries[1]["cells"][0]["started"], "2026-01-05");
}
