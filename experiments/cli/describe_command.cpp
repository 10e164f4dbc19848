// ssrlab describe: parameters, and the schema of configs.
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/scene/scene_family.h"
#include "core/shown_text.h"
#include "core/terminal.h"
#include "core/wrapped_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/declarations.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/study/config/config.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/denoisers/denoisers.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace {

struct DescribeOptions {
    std::string technique;  ///< "": all
    bool as_schema = false;
    bool as_json = false;
};

void describe_tracer(std::ostream& out, const TracerEntry& tracer, const ParameterSet& params) {
    out << tracer.name << ": " << tracer.title << "\n  " << tracer.description << "\n  Source: " << tracer.source
        << '\n';
    if (!tracer.fits_webgl2) out << "  Does not fit WebGL 2\n";
    out << params.help(tracer.part);
}

/// The tracers that a technique may use, each with its parameters, those of a shared part once.
void describe_tracers(std::ostream& out, const ParameterSet& params) {
    std::set<std::string> described;
    for (const TracerEntry& tracer : tracer_table()) {
        if (!described.insert(tracer.part).second || params.help(tracer.part).empty()) continue;
        out << "\nParameters of the tracer " << tracer.name << ":\n" << params.help(tracer.part);
    }
}

ParameterSet set_of(const std::vector<Parameter>& parameters) {
    ParameterSet params;
    for (const Parameter& parameter : parameters) params.add(parameter);
    return params;
}

void describe_denoiser(std::ostream& out, const DenoiserEntry& denoiser) {
    out << denoiser.name << ": " << denoiser.title << "\n  " << denoiser.description
        << "\n  Source: " << denoiser.source << '\n';
    if (denoiser.needs_density) out << "  Needs the densities of rays, which mirror rays lack\n";
    out << set_of(denoiser.passes->parameters).help();
}

/// Of a technique that has them.
void describe_denoisers(std::ostream& out, const ParameterSet& params) {
    for (const DenoiserEntry& denoiser : denoiser_table())
        if (const std::string help = params.help(denoiser.name); !help.empty())
            out << "\nParameters of the denoiser " << denoiser.name << ":\n" << help;
}

bool is_denoiser(const std::string& name) {
    return std::ranges::count(denoiser_table(), name, &DenoiserEntry::name) > 0;
}

bool is_tracer(const std::string& name) {
    return std::ranges::any_of(tracer_table(), [&](const TracerEntry& tracer) { return tracer.name == name; });
}

}  // namespace

static void describe(const DescribeOptions& asked, std::ostream& out) {
    DescribeOptions options = asked;
    options.technique = technique_name(asked.technique);
    if (is_tracer(options.technique)) {
        ParameterSet params;
        for (const TracerEntry& tracer : tracer_table())
            if (tracer.part == find_tracer(options.technique).part)
                for (const Parameter& parameter : tracer.parameters) params.add(parameter);
        return describe_tracer(out, find_tracer(options.technique), params);
    }
    if (is_denoiser(options.technique)) return describe_denoiser(out, find_denoiser(options.technique));
    if (!options.technique.empty() &&
        !std::ranges::count(technique_table(), options.technique, &TechniqueEntry::name)) {
        refuse_folder_without_dot(options.technique);
        std::vector<std::string> names = names_of(technique_table(), &TechniqueEntry::name);
        std::ranges::move(names_of(tracer_table(), &TracerEntry::name), std::back_inserter(names));
        std::ranges::move(names_of(denoiser_table(), &DenoiserEntry::name), std::back_inserter(names));
        fail("unknown technique, tracer or denoiser '", shortened(options.technique), "'",
             suggestion(options.technique, names));
    }
    for (const TechniqueEntry& entry : technique_table()) {
        if (!options.technique.empty() && entry.name != options.technique) continue;
        out << entry.name << ": " << entry.title << "\n  " << entry.description << "\n  Source: " << entry.source
            << "\n";
        if (const std::string limits = limits_text(entry.limits); !limits.empty())
            out << "  Enforced limits: " << limits << '\n';
        const std::unique_ptr<Technique> technique = make_technique(entry.name);
        const std::string parameters = technique->params.help();
        out << (parameters.empty() ? "\nIt has no parameters.\n" : "\nParameters:\n" + parameters);
        describe_tracers(out, technique->params);
        describe_denoisers(out, technique->params);
        if (!entry.presets.empty()) out << "\nPresets:\n";
        for (const Preset& preset : entry.presets)
            out << "  " << preset.name << ": " << preset.meaning << " " << preset.parameters.dump() << '\n';
        out << '\n';
    }
}

static void describe_command(const DescribeOptions& options) {
    if (options.as_schema) {
        std::cout << config_schema(technique_name(options.technique)).dump(2) << '\n';
        return;
    }
    std::ostringstream out;
    describe(options, out);
    std::cout << fitted(out.str(), terminal_columns(stdout));
}

void add_describe(Commands& line) {
    DescribeOptions& describe = line.keep<DescribeOptions>();
    CLI::App& command = line.add(
        "describe", "Print the parameters of techniques, tracers and denoisers: default, range, unit, meaning, source",
        "ssrlab describe mcguire_dda");
    option(command, "technique NAME", describe.technique,
           "Technique or its folder, tracer or denoiser; default: all techniques");
    command.add_flag("--schema", describe.as_schema,
                     "Print a JSON Schema of studies, with which editors complete and check configs; with a technique, "
                     "that of its parameters");
    command.add_flag(
        "--json", describe.as_json,
        "Print everything that the program declares as JSON: commands, keys, columns, techniques and metrics");
    command.callback([&] {
        if (describe.as_json)
            std::cout << declarations(line.app).dump(1) << '\n';
        else
            describe_command(describe);
    });
}
