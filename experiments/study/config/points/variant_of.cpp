#include "experiments/study/config/points/variant_of.h"

#include "core/error.h"
#include "experiments/study/config/points/external_images.h"
#include "variants/registry.h"

namespace {

class ExternalVariant final : public Variant {
public:
    explicit ExternalVariant(const ExternalImages& images) : images_(images) {}

    Reflections render(PassGraph&, const GBuffer&) override {
        fail("'", images_.name, "' is rendered by ", images_.engine, ", not by ssrlab");
    }
    bool depends_on_seed() const override { return images_.seeds > 1; }

private:
    const ExternalImages& images_;
};

}  // namespace

std::unique_ptr<Variant> variant_of(const VariantConfig& point, const nlohmann::json& parameters) {
    if (point.external) return std::make_unique<ExternalVariant>(*point.external);
    return make_variant(point.variant, parameters, point.preset);
}

std::unique_ptr<Variant> variant_of(const VariantConfig& point) { return variant_of(point, point.parameters); }

std::unique_ptr<Variant> plain_variant_of(const VariantConfig& point) {
    return point.external ? variant_of(point) : make_variant(point.variant);
}
