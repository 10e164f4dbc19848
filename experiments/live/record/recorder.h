#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/spirv/shader_reads.h"
#include "variants/common/technique.h"

#include <map>
#include <nlohmann/json.hpp>

/// Texels of a page: described in its recording, encoded in elements of their own. Equal texels are kept once.
class RecordedTexels {
public:
    /// Adds an image without loss; returns its index.
    size_t add(const HostImage& image);
    /// Adds RGB as halves with this many bits of significand (encode_halves()); returns its index.
    size_t add_rounded(const HostImage& rgb, unsigned significand_bits);

    const nlohmann::json& descriptions() const { return descriptions_; }
    const std::vector<std::string>& texts() const { return texts_; }  ///< base64, by index

private:
    size_t keep(nlohmann::json description, const std::vector<unsigned char>& bytes);

    nlohmann::json descriptions_ = nlohmann::json::array();
    std::vector<std::string> texts_;
    std::map<std::string, size_t> places_;  ///< by description and bytes
};

/// What shaders read, by shader text; kept because finding out takes a while.
using KnownReads = std::map<std::string, ShaderReads>;

/// Records what a technique does to the images of a pass list, frame by frame, as page/record/replay.js repeats it:
/// images, programs in GLSL ES 3.00, and lists of commands. Fails with Error on compute passes and draws of meshes
/// (Limits::webgl2 refuses them before they run), and on passes that run while constants are set.
class Recorder : private PassWatcher {
public:
    /// `keeps_passes`: also records what each pass wrote, as a command {"check": [image, mip], "stage", "texels"} after
    /// the pass, so that each pass can be compared by itself.
    Recorder(PassList& pass_list, RecordedTexels& texels, KnownReads& reads, bool keeps_passes = false);
    ~Recorder() override;
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Begins a frame: what is read of `gbuffer` from here on is the frame's own.
    void begin_frame(const GBuffer& gbuffer);
    /// Ends a frame, until the next one begins. Returns {"commands": index of its list, "inputs": {image: texels},
    /// "radiance", "confidence": images, "confidence_channel"}.
    nlohmann::json end_frame(const Reflections& reflections);

    nlohmann::json images() const { return images_; }
    nlohmann::json programs() const { return programs_; }
    const std::string& vertex() const { return vertex_; }  ///< vertex shader of all programs
    nlohmann::json command_lists() const { return lists_; }
    /// Indices among the parameters with Use::uniform of those that some program reads.
    const std::set<unsigned>& params_read() const { return params_read_; }

private:
    void stop();
    std::optional<InstrumentedPipeline> before(const PassRun& pass) override;
    void cleared(const Image& image, glm::vec4 value) override;
    void uploaded(const Image& image) override;
    size_t program_of(const PassRun& pass);
    size_t image_of(const Image& image);    ///< image that a pass, a clear or an upload writes
    size_t texture_of(const Image& image);  ///< image that a pass reads
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
    std::vector<Image> kept_;  ///< keeps addresses in `known_` unique
    std::map<std::string, size_t> input_places_;
    std::map<const ImageStorage*, std::string> inputs_now_;
};
