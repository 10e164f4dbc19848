#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// A source of ssrlab: C++, GLSL, or a table that is read when it runs.
struct SourceFile {
    std::string path;                   ///< from the project's root
    std::string hash;                   ///< of its bytes
    std::vector<std::string> includes;  ///< what it includes in quotes, as written
};

/// The sources below `root` of core, groundtruth, metrics, variants and experiments, ordered by path; benchmarks are
/// none of them. Fails with MachineError if one cannot be read.
std::vector<SourceFile> read_sources(const std::filesystem::path& root);

/// One line for each: its path, its hash, what it includes.
std::string source_table(const std::vector<SourceFile>& sources);
std::vector<SourceFile> parse_source_table(std::string_view table);

/// Which sources a number depends on, so that an edit of one redoes what may have changed and nothing else.
///
/// A source needs what it includes. Of core, groundtruth, metrics, variants and gpu_costs whatever needs one source
/// needs all that lie beside it in its folder: a class may be spread over several. So of a room within one some header
/// must be included from outside. In the rest of experiments a header needs the source of its name: each of them
/// implements its own header alone. Nothing depends on code that reads a config: cells hold what it read by value. No
/// technique and no single tracer is included by what runs them (they are declared by name, see variants/registry.cpp
/// and variants/tracers/tracers.cpp), so that they are asked for by their folders.
class SourceCode {
public:
    explicit SourceCode(std::vector<SourceFile> sources);

    /// All that these need, themselves included: sources, or folders by a name that ends in "/". Unknown names are
    /// errors of the program.
    std::set<std::string> needed_by(const std::vector<std::string>& roots) const;
    /// Of all that these need.
    std::string hash_of(const std::vector<std::string>& roots) const;

private:
    std::map<std::string, SourceFile> sources_;
};
