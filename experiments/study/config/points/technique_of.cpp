#include "experiments/study/config/points/technique_of.h"

#include "core/error.h"
#include "experiments/study/config/points/external_images.h"
#include "variants/registry.h"

namespace {

class ExternalTechnique final : public Technique {
public:
    explicit ExternalTechnique(const ExternalImages& images) : images_(images) {}

    Reflections render(PassList&, const GBuffer&) override {
        fail("'", images_.name, "' is rendered by ", images_.engine, ", not by ssrlab");
    }
    bool depends_on_seed() const override { return images_.seeds > 1; }

private:
    const ExternalImages& images_;
};

}  // namespace

std::unique_ptr<Technique> technique_of(const PointConfig& point, const nlohmann::json& parameters) {
    if (point.external) return std::make_unique<ExternalTechnique>(*point.external);
    return make_technique(point.technique, parameters, point.preset);
}

std::unique_ptr<Technique> technique_of(const PointConfig& point) { return technique_of(point, point.parameters); }

std::unique_ptr<Technique> plain_technique_of(const PointConfig& point) {
    return point.external ? technique_of(point) : make_technique(point.technique);
}
