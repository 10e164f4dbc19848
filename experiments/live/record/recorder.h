#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/spirv/shader_reads.h"
#include "variants/common/technique.h"

#include <map>
#include <nlohmann/json.hpp>

/// Texels for a page: described in its recording, encoded in elements of their own. What comes twice is kept once.
class RecordedTexels {
public:
    /// Without loss; its place.
    size_t add(const HostImage& image);
    /// RGB as halves with so many bits of significand (encode_halves()); its place.
    size_t add_rounded(const HostImage& rgb, unsigned significand_bits);

    const nlohmann::json& descriptions() const { return descriptions_; }
    const std::vector<std::string>& texts() const { return texts_; }  ///< base64, by their places

private:
    size_t keep(nlohmann::json description, const std::vector<unsigned char>& bytes);

    nlohmann::json descriptions_ = nlohmann::json::array();
    std::vector<std::string> texts_;
    std::map<std::string, size_t> places_;  ///< by description and bytes
};

/// What shaders look at, by their texts: it takes a while to find out.
using KnownReads = std::map<std::string, ShaderReads>;

/// Writes down what a technique does to the images of a pass_list, frame by frame, as page/record/replay.js does it
/// again: its images, programs in GLSL ES 3.00, and lists of commands. A compute pass or a draw of meshes fails with
/// Error (Limits::webgl2 refuses them before they run), and so does a pass while constants are set.
class Recorder : private PassWatcher {
public:
    /// `keeps_passes`: also what each pass has written, as commands {"check": [image, mip], "stage", "texels"} behind
    /// it, so that each can be compared by itself.
    Recorder(PassList& pass_list, RecordedTexels& texels, KnownReads& reads, bool keeps_passes = false);
    ~Recorder() override;
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// What is read of `gbuffer` from now on is a frame's own.
    void begin_frame(const GBuffer& gbuffer);
    /// The frame's description: {"commands": place of its list, "inputs": {image: texels}, "radiance", "confidence":
    /// images, "confidence_channel"}. Nothing is recorded until the next one begins.
    nlohmann::json end_frame(const Reflections& reflections);

    nlohmann::json images() const { return images_; }
    nlohmann::json programs() const { return programs_; }
    const std::string& vertex() const { return vertex_; }  ///< the vertex shader of all of them
    nlohmann::json command_lists() const { return lists_; }
    /// Places among the parameters with Use::uniform that some program reads.
    const std::set<unsigned>& params_read() const { return params_read_; }

private:
    void stop();
    std::optional<InstrumentedPipeline> before(const PassRun& pass) override;
    void cleared(const Image& image, glm::vec4 value) override;
    void uploaded(const Image& image) override;
    size_t program_of(const PassRun& pass);
    size_t image_of(const Image& image);    ///< that a pass writes, a clear or an upload
    size_t texture_of(const Image& image);  ///< that a pass reads
    size_t described(const Image& image, const std::string& name);

    PassList& pass_list_;
    RecordedTexels& texels_;
    KnownReads& known_reads_;
    const bool keeps_passes_;
    nlohmann::json images_ = nlohmann::json::array(), programs_ = nlohmann::json::array();
    nlohmann::json lists_ = nlohmann::json::array(), commands_, inputs_;
    std::string vertex_;
    std::map<std::string, size_t> program_places_, list_places_;
    std::vector<const ShaderReads*> reads_;  ///< by program
    std::set<unsigned> params_read_;
    std::map<const ImageStorage*, size_t> known_;
    std::vector<Image> kept_;  ///< so that no other image comes to lie where one of `known_` was
    std::map<std::string, size_t> input_places_;
    std::map<const ImageStorage*, std::string> inputs_now_;
};
