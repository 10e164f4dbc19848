#include "experiments/results/cells/cell_store.h"

#include "core/error.h"
#include "core/files.h"
#include "core/former_names.h"
#include "core/json.h"
#include "core/path_inside.h"
#include "experiments/results/cells/image_path.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

namespace {

/// JSON objects are ordered by key and numbers written by the shortest text that reads back, so that what was read is
/// written as it was.
std::string content_hash(const nlohmann::json& cell) {
    ContentHash hash;
    hash.add(cell.dump());
    return hash.hex();
}

}  // namespace

std::filesystem::path CellStore::file(const std::string& name) const {
    return path_inside(results_, "cells/" + name + ".json");
}

std::optional<Cell> CellStore::parse(const std::string& name) const {
    std::error_code error;
    const std::filesystem::path file = this->file(name);
    const bool is_there = std::filesystem::exists(file, error);
    if (error) fail_machine("cannot read ", file.string(), ": ", error.message());
    if (!is_there) return {};
    nlohmann::json json;
    try {
        json = read_json(file);
    } catch (const MachineError&) {
        throw;
    } catch (const Error&) {  // as good as none
    }
    const bool is_whole = json.is_object() && json.contains("cell") && json.value("name", nlohmann::json()) == name &&
                          json.value("content", nlohmann::json()) == content_hash(json["cell"]);
    if (!is_whole) {
        notice_("note: " + file.string() + " is damaged, or of another version; it is not used");
        return {};
    }
    JsonDocument content{.value = std::move(json["cell"]), .places = {}};
    take_former_names(content, FormerNames::of_study);
    Cell cell = read_cell(content.value, file.string() + ": cell");
    cell.name = name;
    return cell;
}

std::optional<Cell> CellStore::noting_mistakes(const std::function<std::optional<Cell>()>& read) const {
    try {
        return read();
    } catch (const MachineError&) {
        throw;
    } catch (const Error& mistake) {
        notice_("note: " + std::string(mistake.what()) + "; the cell is not used");
        return {};
    }
}

std::optional<Cell> CellStore::read(const std::string& name) const {
    file(name);  // whose own mistakes nothing makes good
    return noting_mistakes([&] { return parse(name); });
}

std::optional<Cell> CellStore::load(const std::string& name) const {
    file(name);
    return noting_mistakes([&] { return load_strictly(name); });
}

std::optional<Cell> CellStore::load_strictly(const std::string& name) const {
    std::optional<Cell> cell = parse(name);
    if (!cell || !has_images(*cell)) return {};
    return cell;
}

bool CellStore::has_images(const Cell& cell) const {
    const std::string file = this->file(cell.name).string();
    for (size_t i = 0; i < cell.images.size(); ++i)
        for (const std::string kind : {"exr", "png"}) {
            const nlohmann::json& image = cell.images[i];
            const std::string shown = image[kind], place = ": cell: images[" + std::to_string(i) + "]: " + kind,
                              hash = file_hash(image_path(results_, shown, file + place));
            if (image[kind + "_hash"].get<std::string>() == hash) continue;
            notice_("note: " + file + " is done again: its image " + shown +
                    (hash.empty() ? " is missing" : " is not the one that it made"));
            return false;
        }
    return true;
}

void CellStore::save(const std::string& name, const Cell& cell) const {
    const nlohmann::json content = cell;
    write_text(file(name),
               nlohmann::json{{"name", name}, {"content", content_hash(content)}, {"cell", content}}.dump() + "\n");
}

std::vector<std::string> CellStore::names() const {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(path_inside(results_, "cells"), error)) {
        if (entry.path().extension() == ".json" && entry.is_regular_file(error) && !entry.is_symlink(error))
            names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

CellStore::Claim::~Claim() {
    std::error_code ignored;  // another process may have removed it
    std::filesystem::remove(file_, ignored);
    close(descriptor_);
}

std::unique_ptr<CellStore::Claim> CellStore::claim(const std::string& name, bool waits) const {
    const std::filesystem::path file = path_inside(results_, "cells/" + name + ".claim");
    create_folder(file.parent_path());
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
        fail_machine("cannot write into the folder ", file.parent_path().string(), ": ", std::strerror(errno),
                     "; choose a folder that you may write to");
    while (flock(descriptor, waits ? LOCK_EX : LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) break;
        close(descriptor);
        return nullptr;
    }
    return std::make_unique<Claim>(file, descriptor);
}
