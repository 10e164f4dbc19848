#include "core/error.h"
#include "core/files.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "variants/common/names.h"
#include "variants/common/parameter_block.h"
#include "variants/tracers/tracer.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

/// The parameter of whole numbers that a key names; "" without the key.
std::string levels_of(JsonObject& reads, const std::string& key, const TracerEntry& tracer) {
    if (!reads.has(key)) return {};
    const std::string name = reads.text(key);
    const auto found = std::ranges::find(tracer.parameters, name, &Parameter::name);
    if (found == tracer.parameters.end() || found->glsl_type != "uint")
        fail(reads.at(key), ": '", name, "' is no parameter of whole numbers");
    return name;
}

}  // namespace

std::vector<NotRepeatable> read_reasons(JsonObject& owner, const KnownValues& known) {
    std::vector<NotRepeatable> reasons;
    for (JsonObject& object : owner.objects("not_repeatable")) {
        reasons.push_back({Condition(object, "when", known), object.text("because")});
        object.finish();
    }
    return reasons;
}

std::string because(const std::vector<NotRepeatable>& reasons, const KnownValues& known) {
    for (const NotRepeatable& reason : reasons)
        if (reason.when.holds(known)) return reason.because;
    return {};
}

TracerEntry read_tracer(const std::string& file) {
    const fs::path path = own_files() / "variants/tracers" / file;
    const JsonDocument document = read_json_document(path);
    JsonObject root(document, path.string());
    TracerEntry tracer{.name = path.stem().string()};
    tracer.title = root.text("title");
    tracer.source = root.text("source");
    tracer.description = root.text("description");
    tracer.shader = "tracers/" + fs::path(file).replace_filename(root.text("shader", tracer.name + ".glsl")).string();
    tracer.part = root.text("part", tracer.name);
    tracer.fits_webgl2 = root.boolean("fits_webgl2", true);
    ParameterReader reader;
    ParameterSet params;
    for (const DeclaredParameter& declared : reader.read(root, tracer.part))
        tracer.parameters.push_back(params.add(declared.parameter));
    const KnownValues known(params);
    if (root.has("reads")) {
        JsonObject reads = root.object("reads");
        tracer.nearest_mips = levels_of(reads, "nearest_depths", tracer);
        tracer.farthest_mips = levels_of(reads, "farthest_depths", tracer);
        tracer.depth_layers = Condition::or_truth(reads, "depth_layers", known);
        tracer.random = Condition::or_truth(reads, "random", known);
        tracer.exact_hits = reads.boolean("exact_hits", false);
        reads.finish();
    }
    tracer.not_repeatable = read_reasons(root, known);
    root.finish();
    ContentHash hash;
    hash.add(document.value.dump());
    for (const std::string& block : reader.of_ssrlab) hash.add(read_text(path_inside(own_files(), block)));
    tracer.content_hash = hash.hex();
    return tracer;
}
