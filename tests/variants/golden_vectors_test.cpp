#include "tests/variants/diligent_golden.h"

#include <gtest/gtest.h>
#include <map>
#include <regex>

// That a folder of golden vectors holds what the golden tests read, so that none of them passes by comparing nothing.

namespace {

/// How many files of the index have names of each form.
std::map<std::string, size_t> counts(const std::vector<std::string>& forms) {
    std::map<std::string, size_t> found;
    for (const std::string& form : forms)
        for (const std::string& file : golden_files("")) found[form] += std::regex_match(file, std::regex(form));
    return found;
}

const std::string still_set = "S[12]_640x384/", frame = "S[12]_(denoise|seq)_[^/]*/f[0-9]/";

}  // namespace

TEST(GoldenVectors, OfMostKindsAreInEveryFolder) {
    const std::vector<std::string> forms = {
        "amd/" + still_set + "classify(_spq[12])?.exr",
        "amd/" + still_set + "hit_p[14].exr",
        "amd/" + still_set + "hiz_mip[1-6].exr",
        "amd/" + still_set + "tiles.exr",
        "amd/" + frame + "(average|gbuffer|intersect|prefilter|reproject|resolve|tiles).exr",
        "diligent/" + still_set + "color_p1.exr",
        "diligent/" + still_set + "hit_p[123].exr",
        "diligent/" + still_set + "hiz_mip[1-6].exr",
        "diligent/" + still_set + "mask_rthr0.(2|65).exr",
        "diligent/" + still_set + "spatial_p1_(head|seed).exr",
        "diligent/" + still_set + "spatial_p1_rthr0.2_(head|seed).exr",
        "diligent/" + still_set + "spatial_p3_head.exr",
        "diligent/" + frame + "aux.exr",
        "diligent/" + frame + "spatial_(head|seed).exr",
        "diligent/" + frame + "temporal_(head|seed)_(0.9|1).exr",
        "diligent/" + frame + "bilateral_(head|seed)_(0.9|1).exr"};
    for (const auto& [form, count] : counts(forms)) EXPECT_GE(count, 2u) << form << " in " << golden_folder();
}

TEST(GoldenVectors, OfAllKindsAreInAFolderThatIsNamed) {
    if (!has_all_golden_kinds()) GTEST_SKIP() << "the repository's copy has no random numbers";
    const std::vector<std::string> forms = {"amd/" + still_set + "(color|hit)_(p[1-4]|pdef).exr",
                                            "amd/" + still_set + "noise.exr", "amd/" + frame + "noise.exr",
                                            "diligent/" + still_set + "noise.exr", "diligent/" + frame + "noise.exr"};
    for (const auto& [form, count] : counts(forms)) EXPECT_GE(count, 2u) << form << " in " << golden_folder();
}
