#pragma once
#include "core/exr/exr.h"
#include "core/json.h"
#include "tests/experiments/study/study_fixture.h"

/// What ssrlab rendered of a scene, with the light that reflections are added to.
struct RenderedFrame {
    HostImage image, specular;

    HostImage without_reflections() const {
        HostImage off = image;
        for (size_t i = 0; i < off.values.size(); ++i) off.values[i] -= specular.values[i];
        return off;
    }
};

/// The images of a technique in a results folder of one shot and one seed, kept as half floats.
inline RenderedFrame rendered_frame(const fs::path& results, const std::string& technique) {
    RenderedFrame frame;
    const nlohmann::json manifest = read_json(results / "manifest.json");
    for (const nlohmann::json& entry : manifest["images"]) {
        if (entry["technique"] != technique || entry["kind"] != "result") continue;
        if (entry["target"] == "image") frame.image = read_exr_rgb(results / entry["exr"].get<std::string>());
        if (entry["target"] == "specular") frame.specular = read_exr_rgb(results / entry["exr"].get<std::string>());
    }
    return frame;
}

/// Writes external.json; `more` begins with a comma.
inline void describe_frames(const fs::path& folder, const std::string& more = "") {
    write_text(folder / "external.json",
               R"({"name": "three_ssr", "engine": "three.js SSRPass", "version": "r187")" + more + "}");
}
