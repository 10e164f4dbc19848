#include "variants/passes/check_frames.h"

#include "core/error.h"
#include "core/gpu/format.h"
#include "core/near_miss.h"
#include "variants/passes/frame_values.h"
#include "variants/passes/provided_images.h"

#include <algorithm>
#include <set>

namespace {

const std::string previous = "previous_";

using Uses = std::vector<const DeclaredUse*>;

/// One frame, of the passes and images that its values leave.
class FrameCheck {
public:
    FrameCheck(const Declaration& declaration, const FrameValues& values)
        : declaration_(declaration), values_(values) {}

    void run() {
        for (const DeclaredImage* image : in_use(declaration_.images, &DeclaredImage::name, values_.known()))
            images_.emplace(image->name, image);
        for (const DeclaredBuffer* buffer : in_use(declaration_.buffers, &DeclaredBuffer::name, values_.known()))
            buffers_.insert(buffer->name);
        if (declaration_.denoiser || declaration_.is_denoiser) buffers_.insert(ray_buffers.begin(), ray_buffers.end());
        if (declaration_.is_denoiser) buffers_.insert(seen_rays_buffer);
        for (const DeclaredPass* pass : declaration_.passes_in_use(values_.known())) check(*pass);
        for (const auto& [name, place] : read_of_last_frame_)
            if (!written_.contains(name) && !written_.contains(previous + name))
                fail_here(place, "reads '" + previous + name + "', but no pass writes '" + name + "'");
        if (declaration_.denoiser)
            check_rays(*declaration_.denoiser);
        else
            check_results();
    }
    const std::set<std::string>& written() const { return written_; }

private:
    bool holds(const Condition& condition) const { return condition.holds(values_.known()); }

    [[noreturn]] void fail_here(const std::string& place, const std::string& what) const {
        fail(place, ": ", what, values_.text());
    }

    bool is_given(const std::string& name) const {
        return !images_.contains(name) &&
               (ProvidedImages::has(name) || (declaration_.is_denoiser && std::ranges::count(denoiser_images, name)));
    }

    /// The name of what is behind names that are others'.
    std::string behind(const std::string& name) const {
        const auto found = images_.find(name);
        return found == images_.end() || found->second->same_as.empty() ? name : behind(found->second->same_as);
    }

    /// Of this frame; fails with a near miss if it is not there.
    const DeclaredImage& image(const std::string& name, const std::string& place) const {
        if (const auto found = images_.find(name); found != images_.end()) return *found->second;
        std::vector<std::string> names = ProvidedImages::names();
        for (const DeclaredImage& known : declaration_.images) {
            if (known.name == name) fail_here(place, "there is no image '" + name + "'");
            names.push_back(known.name);
            if (known.has_history) names.push_back(previous + known.name);
        }
        fail(place, ": there is no image '", shortened(name), "'", suggestion(name, names));
    }

    [[noreturn]] void refuse_feedback(const DeclaredUse& read) const {
        fail_here(read.place, "the pass reads '" + read.image + "' and writes it, too; write another image");
    }

    void check(const DeclaredPass& pass) {
        if (!pass.cleared.empty()) {
            if (!buffers_.contains(pass.cleared)) written_.insert(image(pass.cleared, pass.place).name);
            return;
        }
        const Uses reads = in_use(pass.reads, &DeclaredUse::as, values_.known()),
                   writes = in_use(pass.writes, &DeclaredUse::as, values_.known());
        for (const DeclaredUse* read : reads) check_read(*read, writes);
        for (const DeclaredUse* write : writes) check_write(*write);
        for (const std::string& buffer : pass.buffers)
            if (!buffers_.contains(buffer)) fail_here(pass.place, "there is no buffer '" + buffer + "'");
        const std::vector<std::string> tested = check_tests(pass, reads, writes);
        if (writes.empty() && pass.buffers.empty() && tested.empty()) fail_here(pass.place, "the pass writes nothing");
        written_.insert(tested.begin(), tested.end());
        if (!pass.each_mip_of.empty()) image(pass.each_mip_of, pass.place);
        if (const DeclaredExtent* over = first_that_holds(pass.over, values_.known()); over && !over->image.empty())
            if (!(declaration_.denoiser && over->image == traced_pixels)) image(over->image, pass.place);
        for (const DeclaredUse* write : writes) written_.insert(write->image);
        used_buffers_.insert(pass.buffers.begin(), pass.buffers.end());
    }

    /// "radiance" of "previous_radiance", if that has a history; else "".
    std::string history_of(const std::string& name) const {
        const std::string of = name.starts_with(previous) ? name.substr(previous.size()) : "";
        const auto found = images_.find(of);
        return found != images_.end() && found->second->has_history ? of : "";
    }

    static bool do_mips_meet(const DeclaredUse& write, const DeclaredUse& read) {
        using enum DeclaredUse::Mips;
        if (write.mips == all || read.mips == all) return true;
        return write.mips == read.mips && write.mip == read.mip;
    }

    void check_read(const DeclaredUse& read, const Uses& writes) {
        for (const DeclaredUse* write : writes)
            if (write->as == read.as)
                fail_here(read.place, "the pass reads and writes an image of the name '" + read.as +
                                          "'; \"as\" gives one of them another name in the shader");
        const std::string name = behind(read.image), of = history_of(name);
        for (const DeclaredUse* write : writes)
            if (write->image == name && !write->is_in_place && do_mips_meet(*write, read)) refuse_feedback(read);
        if (!of.empty()) {
            if (!written_.contains(name) && !images_.at(of)->is_kept) read_of_last_frame_[of] = read.place;
            return;
        }
        if (is_given(name)) {
            if (read.mips != DeclaredUse::Mips::all)
                fail_here(read.place, "'mip' is for images of the technique, not for '" + name + "'");
            return;
        }
        check_mip(image(name, read.place), read);
        if (!written_.contains(name))
            fail_here(read.place, "the pass reads '" + read.image +
                                      "', which no pass before it writes; what the frame before wrote is 'previous_" +
                                      read.image + "' of an image with \"history\": true");
    }

    void check_write(const DeclaredUse& write) {
        if (!history_of(write.image).empty()) return;
        if (is_given(write.image) || behind(write.image) != write.image)
            fail_here(write.place, "no pass can write '" + write.image + "', which all techniques read");
        check_mip(image(write.image, write.place), write);
    }

    /// The depth and stencil buffers that the pass writes.
    std::vector<std::string> check_tests(const DeclaredPass& pass, const Uses& reads, const Uses& writes) const {
        std::vector<std::string> names;
        for (const auto& [tests, is_depth] : {std::pair(&pass.depth, true), std::pair(&pass.stencil, false)}) {
            const DeclaredTest* test = first_that_holds(*tests, values_.known());
            if (!test) continue;
            const auto& [name, place] = std::tie(test->image, test->place);
            const DeclaredImage& buffer = image(name, place);
            if (!(is_depth ? has_depth(buffer.format) : has_stencil(buffer.format)))
                fail_here(place, "'" + name + "' is " + name_of(buffer.format) +
                                     (is_depth ? ", which is no format of depth: d32f, d24, d16 or d32f_s8 are"
                                               : ", which has no stencil: d32f_s8 has one"));
            for (const DeclaredUse* write : writes)
                if (image(write->image, write->place).share != buffer.share)
                    fail_here(place,
                              "'" + name + "' must have the size of '" + write->image + "', which the pass writes");
            const bool is_only_written = test->is_written && (!is_depth || test->compare == DepthTest::Compare::always);
            if (!is_only_written && !written_.contains(name))
                fail_here(place, "the pass is tested by '" + name + "', which no pass before it writes or clears");
            if (!test->is_written) continue;
            for (const DeclaredUse* read : reads)
                if (read->image == name) refuse_feedback(*read);
            names.push_back(name);
        }
        return names;
    }

    void check_mip(const DeclaredImage& image, const DeclaredUse& use) const {
        const bool has_all = image.mips_until != DeclaredImage::Mips::count;
        if (use.mips == DeclaredUse::Mips::one && !has_all && use.mip >= image.mips)
            fail_here(use.place, "'mip' = " + std::to_string(use.mip) + " is not there: '" + image.name + "' has " +
                                     std::to_string(image.mips) + ", counted from 0");
    }

    void check_rays(const DeclaredDenoiser& denoiser) const {
        for (const std::string& buffer : ray_buffers)
            if (!used_buffers_.contains(buffer))
                fail_here(denoiser.place,
                          "no pass has '" + buffer + "' among its 'buffers', for rays that the denoiser reads");
    }

    void check_results() const {
        const auto found =
            std::ranges::find_if(declaration_.results, [&](const DeclaredResult& r) { return holds(r.when); });
        if (found == declaration_.results.end()) fail_here(declaration_.results.front().place, "there is no result");
        for (const std::string& name : {found->radiance, found->confidence}) {
            if (is_given(name)) continue;
            const DeclaredImage& shown = image(name, found->place);
            if (!written_.contains(name)) fail_here(found->place, "no pass writes the result '" + name + "'");
            if (shown.share != ScreenShare() || shown.mips > 1 || shown.mips_until != DeclaredImage::Mips::count)
                fail_here(found->place, "the result '" + name + "' must be of the screen's size, without mips");
        }
        if (is_given(found->confidence)) return;
        const FormatFacts& confidence = facts_of(image(found->confidence, found->place).format);
        if (found->channel >= confidence.channels)
            fail_here(found->place, "'channel' of the confidence: '" + found->confidence + "' is " + confidence.name +
                                        ", which lacks it");
    }

    const Declaration& declaration_;
    const FrameValues& values_;
    std::map<std::string, const DeclaredImage*> images_;  // that there are, by name
    std::set<std::string> buffers_, used_buffers_, written_;
    std::map<std::string, std::string> read_of_last_frame_;  // names, and who reads them
};

}  // namespace

void check_frames(const Declaration& declaration, const ParameterSet& params) {
    if (declaration.denoiser) {
        for (const DeclaredBuffer& buffer : declaration.buffers)
            if (std::ranges::count(ray_buffers, buffer.name))
                fail(buffer.place, ": a technique with a denoiser has a buffer '", buffer.name,
                     "' already; call yours otherwise");
        for (const DeclaredImage& image : declaration.images)
            if (image.name == traced_pixels)
                fail(image.place, ": a technique with a denoiser has '", image.name, "' already; call yours otherwise");
    }
    std::set<std::string> written;
    for (const FrameValues& values : representative_frames(declaration, params)) {
        FrameCheck frame(declaration, values);
        frame.run();
        written.insert(frame.written().begin(), frame.written().end());
    }
    for (const DeclaredImage& image : declaration.images)
        if (image.same_as.empty() && !written.contains(image.name))
            fail(image.place, ": no pass writes the image '", image.name, "'");
}
