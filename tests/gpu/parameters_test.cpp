#include "core/parameters.h"
#include "core/error.h"
#include "tests/declared_parameter.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <bit>
#include <functional>

namespace {

struct Demo {
    ParameterSet params;

    Demo() {
        params.add(
            declared_number("thickness", "float", 0.05, 0, 1, {"m", "depth assumed behind each sample", "a paper"}));
        params.add(declared_number("max_steps", "uint", 64, 1, 512, {"", "steps before a ray is given up", "a paper"},
                                   Use::constant));
        params.add(declared_number("offset", "int", -1, -4, 4, {"pixels", "where to begin", "ssrlab"}));
        params.add(declared_switch("refine"));
        params.add(choice_of("filter", "bilinear", {"nearest", "bilinear"}, "how colours are read", "ssrlab"));
    }
    nlohmann::json operator[](const char* name) const { return params.values().at(name); }
};

const Parameter& named(const ParameterSet& params, const std::string& name) {
    return *std::ranges::find(params, name, &Parameter::name);
}

}  // namespace

TEST(Parameters, HoldTheValuesThatAreAssigned) {
    Demo demo;
    demo.params.assign({{"thickness", 0.25}, {"refine", true}, {"filter", "nearest"}});
    EXPECT_EQ(demo["thickness"], 0.25);
    EXPECT_EQ(demo["max_steps"], 64);
    EXPECT_EQ(demo["offset"], -1);
    EXPECT_EQ(demo["refine"], true);
    EXPECT_EQ(demo["filter"], "nearest");
    EXPECT_EQ(demo.params.values().dump(),
              R"({"filter":"nearest","max_steps":64,"offset":-1,"refine":true,"thickness":0.25})");
}

TEST(Parameters, HoldWholeNumbersWrittenWithAPoint) {
    Demo demo;
    demo.params.assign({{"max_steps", 8.0}, {"offset", -2.0}});
    EXPECT_EQ(demo["max_steps"], 8);
    EXPECT_EQ(demo.params.values().at("max_steps").dump(), "8");
    EXPECT_EQ(demo.params.values().at("offset").dump(), "-2");
}

TEST(Parameters, KeepShortDecimals) { EXPECT_EQ(Demo{}.params.values().at("thickness").dump(), "0.05"); }

TEST(Parameters, RejectMistakesBySayingWhatIsAllowed) {
    const auto assign = [](const nlohmann::json& values) {
        return error_message([&] { Demo{}.params.assign(values); });
    };
    EXPECT_EQ(assign({{"thicknes", 0.1}}), "unknown parameter 'thicknes'; did you mean 'thickness'?");
    EXPECT_EQ(assign({{"speed", 1}}),
              "unknown parameter 'speed'; known are: thickness, max_steps, offset, refine, filter");
    EXPECT_EQ(assign({{"thickness", 2.0}}), "parameter 'thickness' = 2.0 is outside of its range: [0, 1]");
    EXPECT_EQ(assign({{"thickness", "big"}}), "parameter 'thickness' is a number, not \"big\"");
    EXPECT_EQ(assign({{"max_steps", 1.5}}), "parameter 'max_steps' is a whole number, not 1.5");
    EXPECT_EQ(assign({{"max_steps", -1}}), "parameter 'max_steps' = -1 is outside of its range: [1, 512]");
    EXPECT_EQ(assign({{"refine", 1}}), "parameter 'refine' is a switch (true or false), not 1");
    EXPECT_EQ(assign({{"filter", "cubic"}}),
              "parameter 'filter' = \"cubic\" is outside of its range: nearest, bilinear");
    EXPECT_EQ(assign(nlohmann::json::array()), "parameters must be an object of names and values, not []");
}

TEST(Parameters, AreUnchangedByARejectedAssignment) {
    Demo demo;
    EXPECT_THROW(demo.params.assign({{"refine", true}, {"thickness", 5}}), Error);
    EXPECT_EQ(demo["refine"], false);
}

TEST(Parameters, DeclareThemselvesInGlsl) {
    EXPECT_EQ(Demo{}.params.glsl(),
              "layout(constant_id = 0) const uint max_steps = uint(64);\n"
              "layout(constant_id = 1) const bool refine = bool(false);\n"
              "layout(constant_id = 2) const uint filter = uint(1);\n"
              "layout(std140) uniform Params {\n    float thickness;\n    int offset;\n};\n");
    EXPECT_EQ(ParameterSet{}.glsl(), "");
}

TEST(Parameters, DeclareVariablesThatAreCopiesOfTheirBlock) {
    EXPECT_EQ(Demo{}.params.glsl_with_copies(),
              "layout(constant_id = 0) const uint max_steps = uint(64);\n"
              "layout(constant_id = 1) const bool refine = bool(false);\n"
              "layout(constant_id = 2) const uint filter = uint(1);\n"
              "layout(std140) uniform Params {\n    float thickness;\n    int offset;\n} params_block;\n"
              "    float thickness;\n    int offset;\n"
              "void copy_params() {\n    thickness = params_block.thickness;\n    offset = params_block.offset;\n}\n");
    EXPECT_EQ(ParameterSet{}.glsl_with_copies(), "void copy_params() {\n}\n");
}

/// Of parts that techniques share: GLSL's names have no dots.
TEST(Parameters, OfAPartBeginWithItsName) {
    ParameterSet params;
    params.add(declared_number("dda.thickness", "float", 0.5, 0, 1));
    params.add(declared_switch("dda.refine"));
    params.assign({{"dda.thickness", 0.25}, {"dda.refine", true}});
    EXPECT_EQ(params.values().dump(), R"({"dda.refine":true,"dda.thickness":0.25})");
    EXPECT_EQ(params.glsl(),
              "layout(constant_id = 0) const bool dda_refine = bool(false);\n"
              "layout(std140) uniform Params {\n    float dda_thickness;\n};\n");
    EXPECT_EQ(params.glsl(true),
              "const bool dda_refine = bool(true);\n"
              "layout(std140) uniform Params {\n    float dda_thickness;\n};\n");
    EXPECT_EQ(error_message([&] {
                  params.assign({{"thickness", 0.1}});
              }),
              "unknown parameter 'thickness'; did you mean 'dda.thickness'?");
    EXPECT_EQ(error_message([&] {
                  params.assign({{"dda_thickness", 0.1}});
              }),
              "unknown parameter 'dda_thickness'; did you mean 'dda.thickness'?");
}

TEST(Parameters, HaveDefaultsThatATechniqueChanges) {
    Demo demo;
    demo.params.change_defaults({{"thickness", 0.25}, {"max_steps", 128}, {"filter", "nearest"}});
    EXPECT_EQ(demo["thickness"], 0.25);
    EXPECT_EQ(demo["max_steps"], 128);
    EXPECT_EQ(demo["filter"], "nearest");
    EXPECT_EQ(demo["refine"], false);
    const nlohmann::json members = demo.params.schema().at("properties");
    EXPECT_EQ(members.at("thickness").at("default"), 0.25);
    EXPECT_EQ(members.at("offset").at("default"), -1);
    EXPECT_NE(demo.params.glsl().find("max_steps = uint(128)"), std::string::npos);
    demo.params.assign({{"thickness", 0.5}});
    EXPECT_EQ(demo.params.schema().at("properties").at("thickness").at("default"), 0.25) << "of values alone";

    EXPECT_THROW(demo.params.change_defaults({{"offset", 2}, {"thickness", 5}}), Error);
    EXPECT_EQ(demo["offset"], -1);
    EXPECT_EQ(error_message([&] {
                  demo.params.change_defaults({{"thicknes", 0.1}});
              }),
              "unknown parameter 'thicknes'; did you mean 'thickness'?");
}

TEST(Parameters, HaveTheBitsThatTheGpuReads) {
    Demo demo;
    EXPECT_EQ(named(demo.params, "thickness").bits(), std::bit_cast<uint32_t>(0.05f));
    EXPECT_EQ(named(demo.params, "offset").bits(), 0xffffffffu);
    EXPECT_EQ(named(demo.params, "filter").bits(), 1u);
    EXPECT_EQ(named(demo.params, "refine").bits(), 0u);
}

TEST(Parameters, DescribeThemselves) {
    const std::string help = Demo{}.params.help();
    for (const char* part : {"thickness", "0.05", "[0, 1]", "unit m", "depth assumed behind each sample", "a paper",
                             "nearest, bilinear", "true, false"})
        EXPECT_NE(help.find(part), std::string::npos) << part << " in\n" << help;
}

TEST(Parameters, HaveAJsonSchema) {
    const nlohmann::json schema = Demo{}.params.schema();
    EXPECT_EQ(schema.at("additionalProperties"), false);
    const nlohmann::json& members = schema.at("properties");
    EXPECT_EQ(members.size(), 5u);
    EXPECT_EQ(members.at("thickness").at("type"), "number");
    EXPECT_EQ(members.at("thickness").at("maximum"), 1.0);
    EXPECT_EQ(members.at("max_steps").at("type"), "integer");
    EXPECT_EQ(members.at("refine").at("type"), "boolean");
    EXPECT_EQ(members.at("filter").at("enum"), (nlohmann::json{"nearest", "bilinear"}));
    EXPECT_EQ(members.at("filter").at("default"), "bilinear");
}
