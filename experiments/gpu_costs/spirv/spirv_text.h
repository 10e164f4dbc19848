#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

/// SPIR-V of one function as lines of assembly, to which lines can be added. The module's ids are numbers ("%17") and
/// stay; added lines may use names ("%count").
class SpirvText {
public:
    /// Fails with Error if it is not valid SPIR-V.
    explicit SpirvText(const std::vector<unsigned>& spirv);

    /// Declares "%name" for added lines as a type or constant (`definition`: "OpTypeInt 32 0"): the module's own if it
    /// has the same, else a new one.
    void declare(const std::string& name, const std::string& definition);
    /// Declares "%name" as "buffer { uint numbers[]; }", and "%pointer" as the type of a pointer to one of its numbers.
    void declare_storage_buffer(const std::string& name, const std::string& pointer, const std::string& uint_type,
                                unsigned binding);
    void declare_variable(const std::string& name, const std::string& definition);
    /// The variable of a built-in input ("FragCoord") of the type "%name": the module's own if it has one.
    std::string built_in(const std::string& what, const std::string& type);
    void add_functions(const std::string& lines);
    /// Adds a copy of the function as it is now, which later edits leave alone; returns its id.
    std::string add_copy();
    /// Makes the added function "%name" the entry point; returns the id of the former one.
    std::string replace_entry_point(const std::string& name);
    /// Makes tests of depth and stencil come before the shader if is_tested_early() allows it.
    void test_early_where_possible();

    struct Block {
        unsigned label = 0;
        std::vector<std::string> at_start, at_end;  ///< added lines: after variables and phis; before the branch
        std::vector<std::string> terminator;        ///< words of the terminator
    };
    void edit_blocks(const std::function<void(Block&)>& edit);

    std::string type_of(const std::string& id) const;  ///< of a value
    std::vector<unsigned> assembled() const;           ///< fails with Error on invalid lines

private:
    using Words = std::vector<std::string>;

    std::vector<Words> header_, decorations_, declarations_, function_;
    std::map<std::string, std::string> names_;    ///< names in added lines for ids of the module
    std::map<std::string, std::string> results_;  ///< ids of declarations by the rest of the line
    std::string added_functions_;
    void add_to_interface(const std::string& variable);
};
