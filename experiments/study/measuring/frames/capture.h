#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/prefiltered_environment.h"
#include "experiments/study/config/shots/shot.h"
#include "groundtruth/reference/reference.h"

#include <memory>
#include <optional>

/// G-buffers from files in place of a scene: a folder with one (gbuffer_file.h), or with several in a row, in folders
/// frame_<number> of their own. An environment.json beside them is for rays that hit nothing.
///
/// The previous frame is the one played before: after the one that it follows in the capture,
/// the file's motion vectors are used (without any, those of still objects are derived from depth and cameras); after
/// itself, where a pose is held, nothing moves; after any other, which timing plays on its way back, objects stand
/// still. Camera, depth and normal of before are always those of the frame played before.
class Capture {
public:
    /// Lists the frames. Fails with Error if there are none, or both kinds.
    explicit Capture(const std::filesystem::path& folder);

    const std::vector<unsigned>& frames() const { return frames_; }  ///< ascending; {0} of one without a number
    const std::optional<Environment>& environment() const { return environment_; }
    const std::vector<std::string>& environment_notes() const { return environment_notes_; }  ///< what was converted
    const std::filesystem::path& folder_of(unsigned frame) const { return folders_.at(frame); }

    /// From its files; valid until the next call, with an empty `fallback` layer filled from the environment.
    const LoadedGBuffer& load(unsigned frame);
    HostGBuffer played(unsigned frame, std::optional<unsigned> previous);

private:
    std::optional<unsigned> recorded_before(unsigned frame) const;

    std::map<unsigned, std::filesystem::path> folders_;  ///< by frame
    std::vector<unsigned> frames_;
    std::optional<Environment> environment_;
    std::vector<std::string> environment_notes_;
    std::optional<PrefilteredEnvironment> prefiltered_;  ///< made when first needed
    std::map<unsigned, std::unique_ptr<LoadedGBuffer>> loaded_;
    std::vector<unsigned> loaded_order_;  ///< the oldest first
};

/// The shot of a capture without its facts: named by its folder; its content hash is that of the files. Reads no
/// pixels. Fails with Error if frames are asked for that are not there, or that do not follow each other.
Shot capture_shot(const ShotConfig& config, const Capture& capture);

/// What all frames of a shot hold.
struct CaptureContents {
    SceneFacts facts;                 ///< what is unknown counts as present, so that nothing is skipped for lack of it
    bool has_lit = false;             ///< a lit colour of its own
    std::vector<std::string> layers;  ///< of the first frame
    std::vector<std::string> notes;   ///< sentences for the user, with the frames that they are about
};

/// Reads and checks all frames of a shot (gbuffer_checks.h). Fails with Error, naming the file, where a frame has
/// another size, depth or projection than the first, a lit colour where another has none, or a camera or depth of
/// before that are not those of the frame before it.
CaptureContents inspect_capture(const Shot& shot, Capture& capture);

/// The reference of a frame: the last run of # in what the config says stands for its number, with leading zeros. A
/// file whose name has these signs serves all frames: who has folders like "take#2" means no number.
std::filesystem::path capture_reference_file(const ShotConfig& config, unsigned frame);

/// Fails if the reference has another size than the frame, was evidently made from another camera (its first hits must
/// lie at the G-buffer's depths but for a few pixels at edges), or lacks the truth ladder that is needed.
Reference read_capture_reference(const Shot& shot, Capture& capture, unsigned frame, bool needs_ladder);
