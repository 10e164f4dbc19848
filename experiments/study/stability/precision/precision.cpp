#include "experiments/study/stability/precision/precision.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/own_files.h"
#include "core/shared/brdf.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/stability/precision/double_shader.h"
#include "experiments/study/stability/precision/precision_judge.h"

namespace {

/// The passes of the lobe's functions in one precision.
class LobePasses {
public:
    LobePasses(Device& device, float roughness, bool is_double)
        : pass_list_(device, {256, 256}), alpha_(ggx_alpha(roughness)) {
        pass_list_.begin_frame(CameraData{}, no_parameters_, {});
        pass_list_.set_changes(
            {.format_of = {}, .glsl_of = double_where([=](const std::string&) { return is_double; })});
    }
    HostImage drawn_directions() {
        pass_list_.compute("experiments/study/stability/precision/lobe_draws.comp")
            .write(image("direction"))
            .set("alpha", alpha_)
            .run();
        return pass_list_.download(image("direction"));
    }
    /// Density, weight and BRDF.
    std::vector<HostImage> values(const HostImage& directions) {
        pass_list_.upload(image("direction"), directions);
        PassList::Pass pass = pass_list_.compute("experiments/study/stability/precision/lobe_values.comp");
        pass.read(image("direction")).set("alpha", alpha_);
        for (const char* name : value_names) pass.write(image(name));
        pass.run({256, 256});
        std::vector<HostImage> values;
        for (const char* name : value_names) values.push_back(channels_of(pass_list_.download(image(name)), 0, 1));
        return values;
    }
    static constexpr const char* value_names[] = {"density", "weight", "brdf"};

private:
    Image image(const std::string& name) { return pass_list_.image(name, Format::rgba32f); }

    const ParameterSet no_parameters_;
    PassList pass_list_;
    float alpha_;
};

}  // namespace

const char* name_of(PrecisionKind kind) {
    constexpr const char* names[] = {"method", "own", "half", "input", "arithmetic", "rays", "march"};
    return names[size_t(kind)];
}

std::vector<PointConfig> precision_points() {
    const auto with = [](const char* tracer) { return single_point("mcguire_dda", "", {{"tracer", tracer}}); };
    return {single_point("mcguire_dda"),
            with("hierarchy"),
            with("cells"),
            with("fixed_stride"),
            with("view_space"),
            single_point("simple_ssr", "corrected"),
            single_point("four_mode_ssr", "custom"),
            single_point("amd_sssr", "repeatable"),
            single_point("diligent_ssr", "current"),
            single_point("frostbite_sssr", "frostbite_2015")};
}

std::filesystem::path precision_case_table() {
    return own_files() / "experiments/study/stability/precision/precision_cases.json";
}

std::vector<PrecisionRow> run_precision(Device& device, const StabilitySelection& selection,
                                        const StabilityFolders& folders,
                                        const std::function<void(const std::vector<PrecisionRow>&, double)>& done) {
    if (!device.has_doubles()) fail_machine("the Vulkan device '", device.info().name, "' has no doubles in shaders");
    const std::vector<StabilityCase> cases = chosen_cases(selection);
    const std::vector<PointConfig> points =
        selection.techniques.empty() ? precision_points() : all_points(selection.techniques);
    CaseDrawer drawer(device, folders.search_path, folders.cache, points);
    std::vector<PrecisionRow> rows = lobe_rows(device);
    for (size_t c = 0; c < cases.size(); ++c) {
        const PrecisionShot shot(drawer.draw(cases[c].scene, cases[c].faults));
        for (size_t p = 0; p < points.size(); ++p) {
            for (PrecisionRow& row : PrecisionJudge(device, shot, points[p]).rows()) {
                row.case_name = cases[c].name, row.technique = points[p].technique, row.point = points[p].point;
                rows.push_back(std::move(row));
            }
            done(rows, (double(c) + double(p + 1) / double(points.size())) / double(cases.size()));
        }
    }
    return rows;
}

std::vector<PrecisionRow> lobe_rows(Device& device) {
    std::vector<PrecisionRow> rows;
    for (const float roughness : {0.0f, 0.1f, 0.3f, 1.0f}) {
        const auto add = [&](const std::string& function, std::vector<double> differences) {
            PrecisionRow row{.technique = "ggx_lobe",
                             .point = "roughness=" + shortest_digits(roughness),
                             .kind = PrecisionKind::arithmetic,
                             .stage = "lobe",
                             .image = function};
            row.set(value_change(std::move(differences)));
            rows.push_back(row);
        };
        LobePasses narrow(device, roughness, false), wide(device, roughness, true);
        const HostImage directions = narrow.drawn_directions(), exact = wide.drawn_directions();
        std::vector<double> turns;
        for (size_t i = 0; i < directions.pixel_count(); ++i)
            turns.push_back(double(glm::distance(directions.rgb(i), exact.rgb(i))));
        add("direction", std::move(turns));
        const std::vector<HostImage> a = narrow.values(directions), b = wide.values(directions);
        for (size_t i = 0; i < a.size(); ++i) {
            std::vector<double> differences;
            add_differences(a[i], b[i], differences);
            add(LobePasses::value_names[i], std::move(differences));
        }
    }
    return rows;
}
