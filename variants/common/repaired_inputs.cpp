#include "variants/common/repaired_inputs.h"

namespace {

// As repair_image.frag has them.
enum class Kind : unsigned { value, depth, direction };

struct RepairedImage {
    Image GBuffer::*member;
    Kind kind;
};

/// All but the material's index, which is no number.
constexpr RepairedImage images[] = {{&GBuffer::depth, Kind::depth},
                                    {&GBuffer::previous_depth, Kind::depth},
                                    {&GBuffer::second_depth, Kind::depth},
                                    {&GBuffer::back_depth, Kind::depth},
                                    {&GBuffer::normal, Kind::direction},
                                    {&GBuffer::previous_normal, Kind::direction},
                                    {&GBuffer::geometric_normal, Kind::direction},
                                    {&GBuffer::base_color, Kind::value},
                                    {&GBuffer::emission, Kind::value},
                                    {&GBuffer::dielectric_f0, Kind::value},
                                    {&GBuffer::motion, Kind::value},
                                    {&GBuffer::lit, Kind::value},
                                    {&GBuffer::fallback, Kind::value}};

}  // namespace

RepairedInputs::RepairedInputs(PassList& pass_list, const GBuffer& gbuffer, bool is_wanted)
    : pass_list_(pass_list), is_wanted_(is_wanted), given_(gbuffer), repaired_(gbuffer) {
    if (!is_wanted) return;
    for (const auto& [member, kind] : images) {
        const Image& given = gbuffer.*member;
        if (!given.storage || (member == &GBuffer::dielectric_f0 && !gbuffer.has_dielectric_f0)) continue;
        const Image repaired = pass_list.image("repaired_" + given.name, given.format);
        pass_list.fragment("common/repair_image.frag")
            .read(given.as("given"))
            .read((member == &GBuffer::previous_normal ? gbuffer.previous_depth : gbuffer.depth).as("surface_depth"))
            .write(repaired.as("repaired"))
            .set("kind", unsigned(kind))
            .label(stage)
            .run();
        repaired_.*member = repaired.as(given.name);
    }
    pass_list.set_inputs(repaired_.images());
}

RepairedInputs::~RepairedInputs() {
    if (is_wanted_) pass_list_.set_inputs(given_.images());
}
