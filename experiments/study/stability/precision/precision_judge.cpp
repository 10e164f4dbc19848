#include "experiments/study/stability/precision/precision_judge.h"

#include "core/error.h"
#include "experiments/study/measuring/rays/judged_hits.h"
#include "experiments/study/stability/precision/double_shader.h"
#include "variants/common/repaired_inputs.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr float largest_half = 65504.0f, least_normal_half = 6.103515625e-5f;  // below it digits are lost

Format in_float(const std::string&, Format asked) { return as_float32(asked); }

/// All images in float but `image`, which is in half or as the technique asks for it.
PassChanges formats_with(const std::string& image, PrecisionKind kind) {
    return {.format_of =
                [image, kind](const std::string& name, Format asked) {
                    if (name != image) return as_float32(asked);
                    return kind == PrecisionKind::half ? as_float16(asked) : asked;
                },
            .glsl_of = {}};
}

PassChanges double_in(std::function<bool(const std::string&)> is_double) {
    return {.format_of = in_float, .glsl_of = double_where(std::move(is_double))};
}

size_t non_finite_pixels(const HostImage& image) {
    size_t count = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) count += !is_finite(image.rgb(i));
    return count;
}

template <class IsMeant>
ValueChange change_of_values(const PrecisionRun& a, PrecisionRun& b, const IsMeant& is_meant) {
    std::vector<double> differences;
    for (const StageValue& value : a.values)
        if (is_meant(value))
            if (const StageValue* other = b.find(value)) add_differences(value.values, other->values, differences);
    return value_change(std::move(differences));
}

const RecordedRays* rays_of(const PrecisionRun& run, const std::string& stage) {
    const auto found = std::ranges::find(run.rays, stage, &RecordedRays::stage);
    return found == run.rays.end() ? nullptr : &*found;
}

bool is_hit(const RayRecord& ray) { return ray.outcome == outcome_hit; }

bool ends_elsewhere(const RayRecord& a, const RayRecord& b) {
    return is_hit(a) != is_hit(b) || (is_hit(a) && a.pixel != b.pixel);
}

}  // namespace

PrecisionShot::PrecisionShot(CaseFrames frames)
    : frames_(std::move(frames)),
      exact_(*frames_.shot, frames_.shot->steps.back().frame, frames_.steps.back().camera) {}

std::optional<double> PrecisionShot::wrong_share(const RecordedRays& recorded) const {
    const std::vector<ExactHit> truth = exact_.hits(recorded);
    double rays = 0, wrong = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
        const RayRecord& ray = recorded.rays[i];
        if (ray.is_traced <= 0) continue;
        const RayVerdict hit = verdict_of_hit(ray, truth[i]), miss = verdict_of_miss(truth[i]);
        const double confidence = double(ray.confidence);
        if (hit == RayVerdict::wrong_place || hit == RayVerdict::false_hit) wrong += confidence;
        if (miss == RayVerdict::avoidable_miss) wrong += 1 - confidence;
        ++rays;
    }
    if (rays == 0) return std::nullopt;
    return wrong / rays;
}

std::vector<PrecisionJudge::Written> PrecisionJudge::written_of(const PrecisionRun& run) {
    std::vector<Written> images;
    for (const StageValue& value : run.values) {
        if (value.stage == RepairedInputs::stage) continue;  // the G-buffer's own, which judge_inputs() looks at
        auto known = std::ranges::find(images, value.image, &Written::image);
        if (known == images.end() && value.values.pixel_count() == 1) continue;  // stands for one that is not there
        if (known == images.end()) known = images.insert(images.end(), {value.image, value.stage, value.format});
        if (("; " + known->stages + ";").find("; " + value.stage + ";") == std::string::npos)
            known->stages += "; " + value.stage;
    }
    return images;
}

/// Nothing, with the reason in `row`, where that cannot be rendered; else `row` gets what it changed of the method,
/// once that is known.
std::optional<PrecisionRun> PrecisionJudge::run(const PrecisionWish& wish, PrecisionRow& row) {
    try {
        PrecisionRun run = run_precisely(device_, point_, shot_.frames(), wish);
        if (!floats_.specular.values.empty()) row = changed(row, run);
        return run;
    } catch (const Error& error) {
        row.refusal = error.what();
        return std::nullopt;
    }
}

PrecisionRow PrecisionJudge::changed(PrecisionRow row, const PrecisionRun& run) const {
    row.error = relative_error(shot_.frames(), run.specular);
    row.change = relative_difference(shot_.frames(), floats_.specular, run.specular);
    if (row.change && error_ > 0) row.share = *row.change / error_;
    row.non_finite = non_finite_pixels(run.specular);
    return row;
}

void PrecisionJudge::judge_format(const Written& what, PrecisionKind kind) {
    const Format format = kind == PrecisionKind::half ? as_float16(what.format) : what.format;
    PrecisionRow row{.kind = kind, .stage = what.stages, .image = what.image, .format = name_of(format)};
    const auto is_meant = [&](const StageValue& value) { return value.image == what.image; };
    size_t values = 0, above = 0, below = 0;
    for (const StageValue& value : floats_.values) {
        if (!is_meant(value)) continue;
        for (const float v : value.values.values) {
            const float size = std::abs(v);
            values += size > 0, above += size > largest_half, below += size > 0 && size < least_normal_half;
        }
    }
    if (values) row.above_half = double(above) / double(values), row.below_half = double(below) / double(values);
    if (auto run = this->run({.changes = formats_with(what.image, kind)}, row))
        row.set(change_of_values(floats_, *run, is_meant));
    add(row);
}

void PrecisionJudge::judge_formats(const std::vector<Written>& written, const PrecisionRun& own) {
    add(changed({.kind = PrecisionKind::own}, own));
    PrecisionRow all{.kind = PrecisionKind::half};
    const auto is_written = [&](const std::string& image) {
        return std::ranges::count(written, image, &Written::image) > 0;
    };
    const PassChanges halves{
        .format_of = [&](const std::string& image,
                         Format asked) { return is_written(image) ? as_float16(asked) : as_float32(asked); },
        .glsl_of = {}};
    run({.changes = halves}, all);
    add(all);
    for (const Written& what : written) {
        if (as_float32(what.format) == as_float16(what.format)) continue;  // holds no fractions
        if (what.format != as_float32(what.format)) judge_format(what, PrecisionKind::own);
        if (what.format != as_float16(what.format)) {
            judge_format(what, PrecisionKind::half);
        } else {
            add(rows_.back());
            rows_.back().kind = PrecisionKind::half;
        }
    }
}

void PrecisionJudge::judge_inputs() {
    const std::vector<std::pair<std::string, std::set<std::string>>> groups = {
        {"depth", {"depth", "previous_depth", "second_depth", "back_depth"}},
        {"normal", {"normal", "geometric_normal", "previous_normal"}},
        {"lit", {"lit", "fallback"}},
        {"motion", {"motion"}}};
    for (const auto& [name, images] : groups) {
        PrecisionRow row{.kind = PrecisionKind::input, .stage = "gbuffer", .image = name, .format = "half"};
        run({.changes = {in_float, {}}, .half_inputs = images}, row);
        add(row);
    }
}

void PrecisionJudge::judge_rays(const std::string& stage, const PrecisionRun& run) {
    const RecordedRays *a = rays_of(floats_, stage), *b = rays_of(run, stage);
    if (!a || !b) return;
    std::vector<double> directions, origins;
    for (size_t i = 0; i < a->rays.size(); ++i) {
        const RayRecord &x = a->rays[i], &y = b->rays[i];
        if (x.is_traced <= 0 && y.is_traced <= 0) continue;
        const bool both = x.is_traced > 0 && y.is_traced > 0;
        directions.push_back(both ? double(glm::distance(x.direction, y.direction)) : 1.0);
        origins.push_back(both ? double(glm::distance(x.origin, y.origin) / glm::length(x.origin)) : 1.0);
    }
    for (const auto& [image, differences] : {std::pair("direction", directions), std::pair("origin", origins)}) {
        PrecisionRow row{.kind = PrecisionKind::rays, .stage = stage, .image = image};
        row.set(value_change(differences));
        add(row);
    }
}

void PrecisionJudge::judge_march(const std::string& stage, const RecordedRays& rays) {
    PrecisionRow row{.kind = PrecisionKind::march, .stage = stage, .image = "distance"};
    const auto run = this->run({.changes = double_in([&](const std::string& s) { return s == stage; }),
                                .is_recording = true,
                                .replayed = {rays}},
                               row);
    if (run) {
        const RecordedRays& wide = *rays_of(*run, stage);
        std::vector<double> distances;
        double traced = 0, elsewhere = 0;
        for (size_t i = 0; i < rays.rays.size(); ++i) {
            const RayRecord &a = rays.rays[i], &b = wide.rays[i];
            if (a.is_traced <= 0) continue;
            ++traced;
            if (ends_elsewhere(a, b))
                ++elsewhere;
            else if (is_hit(a))
                distances.push_back(double(std::abs(a.distance - b.distance) / std::max(a.distance, b.distance)));
        }
        row.set(value_change(distances));
        row.differing = elsewhere / traced;
        row.wrong = shot_.wrong_share(rays), row.wrong_in_double = shot_.wrong_share(wide);
    }
    add(row);
}

void PrecisionJudge::judge_stage(const std::string& stage) {
    PrecisionRow row{.kind = PrecisionKind::arithmetic, .stage = stage};
    const RecordedRays* rays = rays_of(floats_, stage);
    auto run = this->run(
        {.changes = double_in([&](const std::string& s) { return s == stage; }), .is_recording = rays != nullptr}, row);
    if (!run) return add(row);
    std::vector<std::string> images;
    for (const StageValue& value : floats_.values)
        if (value.stage == stage && value.values.pixel_count() > 1 && !std::ranges::count(images, value.image))
            images.push_back(value.image);
    if (images.empty()) add(row);  // it writes buffers
    for (const std::string& image : images) {
        row.image = image;
        row.set(change_of_values(
            floats_, *run, [&](const StageValue& value) { return value.stage == stage && value.image == image; }));
        add(row);
    }
    const auto is_traced = [](const RayRecord& ray) { return ray.is_traced > 0; };
    if (!rays || std::ranges::none_of(rays->rays, is_traced)) return;
    judge_rays(stage, *run);
    judge_march(stage, *rays);
}

std::vector<PrecisionRow> PrecisionJudge::rows() {
    PrecisionRow method{.kind = PrecisionKind::method};
    const auto own = run({}, method);
    auto floats = own ? run({.changes = {in_float, {}}, .is_recording = true}, method) : std::nullopt;
    if (!floats) {
        add(method);
        return rows_;
    }
    floats_ = std::move(*floats);
    error_ = relative_error(shot_.frames(), floats_.specular).value_or(0.0);
    method = changed(method, floats_);
    add(method);
    judge_formats(written_of(*own), *own);
    judge_inputs();
    for (const std::string& stage : floats_.stages)
        if (stage != RepairedInputs::stage) judge_stage(stage);
    PrecisionRow all{.kind = PrecisionKind::arithmetic};
    run({.changes = double_in([](const std::string&) { return true; })}, all);
    add(all);
    return rows_;
}
