#include "experiments/study/merge.h"

#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "experiments/results/answers/answers.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/results/cells/image_path.h"
#include "experiments/study/folder_owner.h"
#include "experiments/study/measuring/times/timing.h"
#include "experiments/study/write_results.h"

#include <algorithm>
#include <map>

namespace fs = std::filesystem;

namespace {

/// A results folder, and all of its cells that can be read.
struct Part {
    fs::path folder;
    std::map<std::string, Cell> cells;  ///< by name; their images are not checked
};

/// Reads each cell once, which is most of the work of a merge.
std::vector<Part> read_parts(const std::vector<fs::path>& folders) {
    std::vector<Part> parts;
    for (const fs::path& folder : folders) {
        Part& part = parts.emplace_back(folder);
        const CellStore store(folder, [](const std::string&) {});
        for (const std::string& name : store.names())
            if (std::optional<Cell> cell = store.read(name)) part.cells.emplace(name, std::move(*cell));
    }
    return parts;
}

std::string text_of(const DeviceInfo& device) { return device.name + ", " + device.driver; }

/// The one that made the cell, by name and driver.
DeviceInfo device_of(const Cell& cell) {
    const nlohmann::json& device = cell.provenance.at("device");
    return {.name = device.at("name"), .driver = device.at("driver")};
}

/// The devices that made the cells of the parts, by name and driver.
std::map<std::string, DeviceInfo> devices_of(const std::vector<Part>& parts) {
    std::map<std::string, DeviceInfo> devices;
    for (const Part& part : parts)
        for (const auto& [name, cell] : part.cells) devices.emplace(text_of(device_of(cell)), device_of(cell));
    return devices;
}

/// Why a finished cell has no place in the plan for `device`. A cell's name is a hash, so only its provenance can tell:
/// the first difference that is found there. `code`: code_hash().
std::string why_not_of_the_plan(const Cell& cell, const DeviceInfo& device, const std::string& code) {
    if (const std::string made_on = text_of(device_of(cell)); made_on != text_of(device)) return "made on " + made_on;
    const nlohmann::json program = cell.provenance.value("ssrlab", nlohmann::json::object());
    if (program.value("code", "") != code) {
        const std::string commit = program.value("commit", "");
        return "made by another ssrlab" + (commit.empty() ? "" : " (commit " + commit.substr(0, 8) + ")") +
               ", or with other settings";
    }
    return "made with other settings or scenes";
}

/// Says how many cells were left over in each part, and why.
void say_what_does_not_count(const std::vector<Part>& parts, const DeviceInfo& device,
                             const std::function<void(const std::string&)>& say) {
    const std::string code = code_hash();
    for (const Part& part : parts) {
        std::map<std::string, size_t> reasons;
        for (const auto& [name, cell] : part.cells) ++reasons[why_not_of_the_plan(cell, device, code)];
        for (const auto& [reason, count] : reasons)
            say("note: " + counted(count, "finished cell") + " of " + part.folder.string() +
                (count == 1 ? " does" : " do") + " not count: " + reason);
    }
}

/// Cells are named by the device that made them, which need not be one of this machine: the only one of the parts, or
/// the one that `choice` names. Nothing if that is none of them, or several, or an index: then this machine's counts.
std::optional<DeviceInfo> device_of_parts(const std::map<std::string, DeviceInfo>& devices, const std::string& choice) {
    std::optional<DeviceInfo> found;
    if (is_device_index(choice)) return found;
    for (const auto& [shown, device] : devices)
        if (device.fits(choice)) {
            if (found) return {};
            found = device;
        }
    return found;
}

/// A cell of one of the folders.
struct FoundCell {
    Cell cell;
    fs::path folder;
};

/// Takes a cell out of a part. One that could not be read is tried again, which says what is wrong with it.
std::optional<Cell> take_cell(const std::string& name, Part& part, const std::function<void(const std::string&)>& say) {
    const CellStore store(part.folder, say);
    auto read = part.cells.extract(name);
    if (read.empty()) return store.load_strictly(name);
    if (!store.has_images(read.mapped())) return {};
    return std::move(read.mapped());
}

/// The best that any folder holds of a cell.
std::optional<FoundCell> find_cell(const PlannedCell& planned, std::vector<Part>& parts,
                                   const std::function<void(const std::string&)>& say) {
    std::optional<FoundCell> best;
    for (Part& part : parts)
        if (std::optional<Cell> cell = take_cell(planned.name, part, say)) {
            if (best && best->cell.truth != cell->truth)
                fail("the truth of ", planned.shot, " is not the same pixels in ", best->folder.string(), " and ",
                     part.folder.string(), " (cell ", planned.name, ", ", planned.what,
                     "): references differ between processors and libraries. Run them once, with `--cells references`, "
                     "and let all other processes use that --cache");
            if (!best || disturbed_share(cell->timing) < disturbed_share(best->cell.timing))
                best = {std::move(*cell), part.folder};
        }
    return best;
}

/// Puts a file of another folder into this one, as a hard link where the file system can.
void take_over(const fs::path& from, const fs::path& to) {
    std::error_code error;
    create_folder(to.parent_path());
    fs::remove(to, error);
    fs::create_hard_link(from, to, error);
    if (!error) return;
    error.clear();
    fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    if (error) fail_machine("cannot copy ", from.string(), " to ", to.string(), ": ", error.message());
}

void take_over(const FoundCell& found, const fs::path& out) {
    std::error_code error;
    if (fs::equivalent(found.folder, out, error)) return;
    for (const nlohmann::json& image : found.cell.images)
        for (const char* kind : {"exr", "png"}) {
            const std::string file = image.at(kind);
            take_over(image_path(found.folder, file), image_path(out, file));
        }
    const auto nowhere = [](const std::string&) {};
    take_over(CellStore(found.folder, nowhere).file(found.cell.name), CellStore(out, nowhere).file(found.cell.name));
}

}  // namespace

size_t merge_study(const Config& config, const RunSettings& settings, const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders) check_owner(folder, config, settings.keep_all);
    std::vector<Part> parts = read_parts(folders);
    const std::map<std::string, DeviceInfo> devices = devices_of(parts);
    const std::optional<DeviceInfo> of_parts = device_of_parts(devices, settings.device);
    RunSettings here = settings;
    if (of_parts) here.device = "";  // nothing is rendered
    StudySession study(config, here);
    const auto say = [&](const std::string& text) { study.progress.say(text); };
    const DeviceInfo device = of_parts.value_or(study.device.info());
    study.plan = plan_study(config, device, settings.search_path, settings.keep_all);
    const FolderOwner owner(settings.out, config, settings.keep_all, settings.replaces, say);
    std::vector<std::string> missing;
    for (const PlannedShot& shot : study.plan.shots) {
        std::optional<std::string> truth;  // of the shot's references, which come first: without them no cell counts
        bool lacks_references = false;
        for (const PlannedCell& planned : shot.cells) {
            std::optional<FoundCell> found = find_cell(planned, parts, say);
            if (found && planned.kind == CellKind::references) truth = found->cell.truth;
            if (found && truth && found->cell.truth != truth)
                say("note: " + planned.what + " in " + found->folder.string() +
                    " was measured against another truth than the shot's references are; it is not used");
            if (found && !truth && !lacks_references) {
                say("note: cells of " + planned.shot + " do not count: their references are missing");
                lacks_references = true;
            }
            if (!found || found->cell.truth != truth) {
                missing.push_back(planned.what);
                continue;
            }
            take_over(*found, settings.out);
            study.finished.push_back(std::move(found->cell));
        }
    }
    if (!missing.empty()) say_what_does_not_count(parts, device, say);
    if (study.finished.empty())
        fail("none of the ", study.plan.cell_count(), " cells of this study can be taken from ",
             folders.front().string(), folders.size() > 1 ? " or the folders beside it" : "", " for ", device.name, ".",
             devices.size() > 1 ? " They hold cells of several devices: --device NAME says whose are merged" : "");
    write_results(study, missing.empty(), {});
    say(counted(study.finished.size(), "cell") + " merged, " + std::to_string(missing.size()) + " missing");
    constexpr size_t most_named = 5;
    for (size_t i = 0; i < std::min(missing.size(), most_named); ++i) say("  missing: " + missing[i]);
    if (missing.size() > most_named) say("  and " + std::to_string(missing.size() - most_named) + " more");
    if (missing.empty() && settings.write_report) say("Report: " + (settings.out / "report.html").string());
    if (!missing.empty()) {
        say("They are done by:");
        say("  " + command_line("run", config, settings));
    }
    return missing.size();
}
