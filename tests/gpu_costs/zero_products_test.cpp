#include "experiments/gpu_costs/spirv/zero_products.h"
#include "core/gpu/device.h"
#include "core/gpu/passes/pass_watcher.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

namespace {

struct ProductsOfPasses : PassWatcher {
    unsigned count = 0;
    std::optional<InstrumentedPipeline> before(const PassRun& run) override {
        count += zero_products(run.recipe);
        return {};
    }
};

struct ZeroProducts : testing::Test {
    Device device;
    ParameterSet no_parameters;
    PassList pass_list{device, {1, 1}};
    ProductsOfPasses watcher;
    Image plain = pass_list.image("plain", Format::rgba32f), functions = pass_list.image("functions", Format::rgba32f),
          seen = pass_list.image("seen", Format::rgba32f);

    void run(Constants constants = {}) {
        const Image source = pass_list.image_of("source", Format::r32f, {2, 1});
        HostImage numbers({2, 1}, 1);
        numbers.values = {std::numeric_limits<float>::quiet_NaN(), 0.0f};
        pass_list.upload(source, numbers);
        pass_list.begin_frame(CameraData{}, no_parameters, {});
        pass_list.set_constants(std::move(constants));
        pass_list.watch(&watcher);
        pass_list.compute("zero_products.comp").read(source).write(plain).write(functions).write(seen).run();
        pass_list.watch(nullptr);
    }
};

}  // namespace

/// The numbers in the shader's comment; where a constant of the scene decides, one product less.
TEST_F(ZeroProducts, AreThoseOfTheShaderByHand) {
    run();
    EXPECT_EQ(watcher.count, 7u);
    watcher.count = 0;
    run({{"scene_is_still", 1}});
    EXPECT_EQ(watcher.count, 6u);
}

/// Why they count: a picture without NaN does not show that there is none. The others must show it.
TEST_F(ZeroProducts, HideWhatIsNoNumberOnLavapipe) {
    run();
    for (const float value : pass_list.download(seen).values) EXPECT_TRUE(std::isnan(value));
    if (!device.info().is_cpu()) return;
    for (const Image& image : {plain, functions})
        for (const float value : pass_list.download(image).values) EXPECT_TRUE(std::isfinite(value)) << image.name;
}
