#include "groundtruth/reference/reference_pixel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace {

/// A sum and the number of samples that it is to be divided by, per batch.
struct Batches {
    std::array<glm::dvec3, batch_count> sums{};
    std::array<double, batch_count> weights{};
};

/// Both halves of one output of one pass.
struct PassMeans {
    glm::dvec3 half[2] = {glm::dvec3(0.0), glm::dvec3(0.0)};
    double weight[2] = {0, 0};
    glm::dvec3 variance{0.0};  ///< of the mean of the halves
};

/// The variance of a half is that of a ratio of sums, linearised (Cochran, "Sampling Techniques", 6.4); where all
/// weights are equal it is the variance of the batch means over their number. Deviations are taken within a half: so
/// the difference of the halves is independent of the stated variance, and audits it.
PassMeans means(const Batches& batches) {
    constexpr double batches_per_half = batch_count / 2;
    PassMeans pass;
    for (unsigned h = 0; h < 2; ++h) {
        glm::dvec3 sum(0.0);
        for (unsigned b = h; b < batch_count; b += 2) {
            sum += batches.sums[b];
            pass.weight[h] += batches.weights[b];
        }
        if (pass.weight[h] == 0) continue;
        pass.half[h] = sum / pass.weight[h];
        glm::dvec3 squares(0.0);
        for (unsigned b = h; b < batch_count; b += 2) {
            const glm::dvec3 deviation = batches.sums[b] - pass.half[h] * batches.weights[b];
            squares += deviation * deviation;
        }
        const double scale = batches_per_half / (batches_per_half - 1) / (pass.weight[h] * pass.weight[h]);
        pass.variance += 0.25 * scale * squares;
    }
    return pass;
}

/// Of the mean over both halves of scale * x - y, from batches that share their samples, as means() has each alone.
glm::dvec3 variance_of_difference(const Batches& x, glm::dvec3 scale, const Batches& y) {
    constexpr double batches_per_half = batch_count / 2;
    const PassMeans of_x = means(x), of_y = means(y);
    glm::dvec3 variance(0.0);
    for (unsigned h = 0; h < 2; ++h) {
        if (of_x.weight[h] == 0 || of_y.weight[h] == 0) continue;
        for (unsigned b = h; b < batch_count; b += 2) {
            const glm::dvec3 deviation = scale * (x.sums[b] - of_x.half[h] * x.weights[b]) / of_x.weight[h] -
                                         (y.sums[b] - of_y.half[h] * y.weights[b]) / of_y.weight[h];
            variance += 0.25 * batches_per_half / (batches_per_half - 1) * deviation * deviation;
        }
    }
    return variance;
}

/// The variance of a mean over old and new samples; the shares of both are of their weights.
void merge_variance(HostImage& image, size_t pixel, glm::dvec3 added, double old_weight, double added_weight) {
    const double total = old_weight + added_weight;
    if (total == 0) return;
    const double rest = old_weight / total, share = added_weight / total;
    image.set_rgb(pixel, glm::vec3(rest * rest * glm::dvec3(image.rgb(pixel)) + share * share * added));
}

/// Weighs old and new by their samples. Means are kept as float32: each merge rounds once, and passes are few.
void merge(ReferenceOutput& output, size_t pixel, const PassMeans& pass, const double (&old_weight)[2]) {
    HostImage* halves[2] = {&output.half_a, &output.half_b};
    for (unsigned h = 0; h < 2; ++h) {
        const double total = old_weight[h] + pass.weight[h];
        if (total == 0) continue;
        const glm::dvec3 old = halves[h]->rgb(pixel);
        halves[h]->set_rgb(pixel, glm::vec3(old + (pass.half[h] - old) * (pass.weight[h] / total)));
    }
    output.mean.set_rgb(pixel, 0.5f * (output.half_a.rgb(pixel) + output.half_b.rgb(pixel)));

    merge_variance(output.variance, pixel, pass.variance, old_weight[0] + old_weight[1],
                   pass.weight[0] + pass.weight[1]);
}

/// The mean of `throughput` over RGB, weighted by `radiance`.
double share_of_light(glm::dvec3 throughput, glm::dvec3 radiance) {
    const double all = radiance.x + radiance.y + radiance.z;
    return all > 0 ? glm::dot(throughput, radiance) / all : 0.0;
}

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators").
uint64_t mix(uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

void write_first_hit(Reference& reference, size_t pixel, const FirstHit& hit) {
    if (!hit.is_hit) return;
    reference.depth.values[pixel] = hit.depth;
    reference.geometric_normal.set_rgb(pixel, hit.geometric_normal);
    reference.normal.set_rgb(pixel, hit.normal);
    reference.material_id.values[pixel] = float(hit.material + 1);
    reference.highlights.set_rgb(pixel, hit.highlight);
    if (reference.ladder.is_empty()) return;
    reference.ladder.reflectance.set_rgb(pixel, hit.reflectance);
    reference.ladder.fallback.set_rgb(pixel, hit.fallback);
}

/// Adds samples of the specular light alone. The image stays the sum of both parts, whose means depend on each other as
/// far as they share samples: of the specular mean those weigh less now.
void merge_specular_alone(Reference& reference, size_t pixel, const PassMeans& pass, const double (&old_weight)[2]) {
    ReferenceOutput& image = reference.image;
    const ReferenceOutput &diffuse = reference.diffuse, &specular = reference.specular;
    const auto of_both = [&] {
        return glm::dvec3(diffuse.variance.rgb(pixel)) + glm::dvec3(specular.variance.rgb(pixel));
    };
    const double before = old_weight[0] + old_weight[1], added = pass.weight[0] + pass.weight[1];
    const glm::dvec3 covariances = (glm::dvec3(image.variance.rgb(pixel)) - of_both()) * (before / (before + added));
    merge(reference.specular, pixel, pass, old_weight);
    image.variance.set_rgb(pixel, glm::vec3(max(of_both() + covariances, glm::dvec3(0.0))));
    for (const auto half : {&ReferenceOutput::half_a, &ReferenceOutput::half_b, &ReferenceOutput::mean})
        (image.*half)
            .set_rgb(pixel, (diffuse.*half).rgb(pixel) + (specular.*half).rgb(pixel) + reference.highlights.rgb(pixel));
}

/// `batch_samples` in each batch, all with the same directions.
PixelCost add_alike(Reference& reference, const PixelTracer& tracer, glm::uvec2 at, const SampleRequest& request,
                    unsigned batch_samples, Directions directions) {
    const bool has_diffuse = directions.diffuse > 0;
    const auto [x, y] = std::pair(at.x, at.y);
    const size_t pixel = size_t(y) * reference.extent.x + x;
    const FirstHit hit = tracer.first_hit(x, y);
    write_first_hit(reference, pixel, hit);

    const double samples_before = reference.sample_count.values[pixel];
    const uint64_t pass_seed = mix(mix(request.seed) ^ mix(uint64_t(request.set) + 1) ^ uint64_t(samples_before));
    PixelCost cost{.rays = 1 + hit.shadow_rays, .non_finite = !hit.is_highlight_finite};
    Batches diffuse, specular, image, incident, camera_radiance, on_screen;
    double on_screen_samples = 0;
    glm::dvec3 cut(0.0);
    std::array<SampleBatch, batch_count> batches;
    for (unsigned b = 0; b < batch_count; ++b) batches[b] = {.seed = mix(pass_seed + b), .estimate = {}};
    if (hit.is_hit && !hit.is_unlit) tracer.trace(x, y, hit, 0, batch_samples, batches, directions);
    for (unsigned b = 0; b < batch_count; ++b) {
        const PixelEstimate& estimate = batches[b].estimate;
        diffuse.sums[b] = estimate.diffuse + glm::dvec3(hit.emitted) * double(batch_samples);
        specular.sums[b] = estimate.specular;
        image.sums[b] = diffuse.sums[b] + specular.sums[b] + glm::dvec3(hit.highlight) * double(batch_samples);
        incident.sums[b] = estimate.incident;
        diffuse.weights[b] = specular.weights[b] = image.weights[b] = batch_samples;
        incident.weights[b] = camera_radiance.weights[b] = on_screen.weights[b] = double(estimate.lobe_samples);
        camera_radiance.sums[b] = estimate.camera_radiance;
        const double off_screen_samples = double(estimate.lobe_samples - estimate.on_screen_samples);
        on_screen.sums[b] = estimate.on_screen + glm::dvec3(hit.fallback) * off_screen_samples;
        on_screen_samples += double(estimate.on_screen_samples);
        cut += estimate.cut;
        cost.rays += estimate.rays;
        cost.non_finite += estimate.non_finite;
    }

    const double old_weight[2] = {samples_before / 2, samples_before / 2};
    const double samples = double(batch_samples) * batch_count;
    const bool is_lit_only = reference.is_lit_only();
    if (has_diffuse) {
        const PassMeans diffuse_means = means(diffuse), image_means = is_lit_only ? diffuse_means : means(image);
        merge(reference.diffuse, pixel, diffuse_means, old_weight);
        if (!is_lit_only) merge(reference.image, pixel, image_means, old_weight);
        float& cut_share = reference.cut_share.values[pixel];
        const double its_share = share_of_light(cut / samples, 0.5 * (image_means.half[0] + image_means.half[1]));
        cut_share = float((cut_share * samples_before + its_share * samples) / (samples_before + samples));
    }
    reference.sample_count.values[pixel] += float(samples);
    if (is_lit_only) return cost;
    if (has_diffuse)
        merge(reference.specular, pixel, means(specular), old_weight);
    else
        merge_specular_alone(reference, pixel, means(specular), old_weight);

    float* lobe_samples = &reference.lobe_samples.values[pixel * 2];
    const double old_lobe_weight[2] = {lobe_samples[0], lobe_samples[1]};
    const PassMeans incident_means = means(incident);
    merge(reference.incident, pixel, incident_means, old_lobe_weight);
    if (!reference.ladder.is_empty()) {
        merge(reference.ladder.camera_radiance, pixel, means(camera_radiance), old_lobe_weight);
        merge(reference.ladder.on_screen, pixel, means(on_screen), old_lobe_weight);
        const double before = old_lobe_weight[0] + old_lobe_weight[1],
                     added = incident_means.weight[0] + incident_means.weight[1], total = before + added;
        for (const auto& [rung, error] : {std::pair(&camera_radiance, &reference.ladder.camera_radiance_error),
                                          {&on_screen, &reference.ladder.on_screen_error}}) {
            merge_variance(error->incident, pixel, variance_of_difference(*rung, glm::dvec3(1.0), incident), before,
                           added);
            merge_variance(error->specular, pixel, variance_of_difference(*rung, glm::dvec3(hit.reflectance), specular),
                           before, added);
        }
        float& share = reference.ladder.on_screen_share.values[pixel];
        if (total > 0) share = float((share * before + on_screen_samples) / total);
    }
    for (unsigned h = 0; h < 2; ++h) lobe_samples[h] += float(incident_means.weight[h]);
    return cost;
}

}  // namespace

PixelTracer pixel_tracer(PathTracer& path_tracer) {
    return {
        .first_hit = [&](unsigned x, unsigned y) { return path_tracer.first_hit(x, y); },
        .trace = [&](unsigned x, unsigned y, const FirstHit& hit, unsigned first, unsigned count,
                     std::span<SampleBatch> batches,
                     Directions directions) { path_tracer.trace(x, y, hit, first, count, batches, directions); },
        .expect = [&](const HostImage& diffuse, const HostImage& specular) { path_tracer.expect(diffuse, specular); }};
}

PixelCost add_samples(Reference& reference, const PixelTracer& tracer, unsigned x, unsigned y,
                      const SampleRequest& request) {
    const auto held = uint64_t(reference.sample_count.values[size_t(y) * reference.extent.x + x]);
    const uint64_t lit = request.most_lit > 0 ? std::max(request.most_lit, held) - held : ~uint64_t(0);
    const unsigned with_diffuse = unsigned(std::min<uint64_t>(request.batch_samples, lit / batch_count));
    const Directions of_both = request.directions, of_specular{.diffuse = 0, .specular = of_both.specular};
    PixelCost cost;
    for (const auto& [samples, directions] :
         {std::pair(with_diffuse, of_both), {request.batch_samples - with_diffuse, of_specular}}) {
        if (samples == 0) continue;
        const PixelCost added = add_alike(reference, tracer, {x, y}, request, samples, directions);
        cost.rays += added.rays, cost.non_finite += added.non_finite;
    }
    return cost;
}
