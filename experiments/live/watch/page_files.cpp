#include "experiments/live/watch/page_files.h"

#include "core/files.h"
#include "experiments/report/page_template.h"

namespace {

/// In the order in which they build on each other.
constexpr const char* report_scripts[] = {"viewer/image_data.js", "viewer/image_colors.js"};
constexpr const char* own_scripts[] = {"pictures.js", "numbers.js", "sliders.js", "watch.js"};

std::string part_of(const char* room, const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments" / room / "page" / name);
}

}  // namespace

std::map<std::string, WatchAnswer> page_files() {
    std::string script = "\"use strict\";\n";
    for (const char* name : report_scripts) script += page_part(name);
    script += part_of("record", "controls.js");
    for (const char* name : own_scripts) script += part_of("watch", name);
    return {{"", {"text/html; charset=utf-8", part_of("watch", "watch.html")}},
            {"watch.js", {"text/javascript; charset=utf-8", script}},
            {"watch.css", {"text/css; charset=utf-8", page_part("style.css") + part_of("watch", "watch.css")}}};
}
