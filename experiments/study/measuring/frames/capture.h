#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/prefiltered_environment.h"
#include "experiments/study/config/shots/shot.h"
#include "groundtruth/reference/reference.h"

#include <memory>
#include <optional>

/// G-buffers from files instead of a scene. A capture is a folder with one G-buffer (gbuffer_file.h), or with several
/// consecutive ones in folders frame_<number>. An environment.json beside them gives the light of rays that hit
/// nothing.
///
/// Motion vectors depend on the frame played before:
///
/// - the frame that precedes it in the capture: the file's motion vectors; without any, those of still objects, derived
///   from depth and cameras;
/// - the same frame, where a pose is held: nothing moves;
/// - any other frame, which timing plays on its way back: objects stand still.
///
/// The previous camera, depth and normal are always those of the frame played before.
class Capture {
public:
    /// Lists the frames. Fails with Error if there are none, or if both kinds of folders exist.
    explicit Capture(const std::filesystem::path& folder);

    const std::vector<unsigned>& frames() const { return frames_; }  ///< ascending; {0} for a single unnumbered frame
    const std::optional<Environment>& environment() const { return environment_; }
    const std::vector<std::string>& environment_notes() const { return environment_notes_; }  ///< what was converted
    const std::filesystem::path& folder_of(unsigned frame) const { return folders_.at(frame); }

    /// The frame as read from its files; an empty `fallback` layer is filled from the environment. Valid until the next
    /// call.
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

/// The shot of a capture, named by its folder, without its facts. The content hash is that of the files. Reads no
/// pixels. Fails with Error if frames are asked for that are missing or not consecutive.
Shot capture_shot(const ShotConfig& config, const Capture& capture);

/// What all frames of a shot hold.
struct CaptureContents {
    SceneFacts facts;                 ///< unknown facts count as present, so that nothing is wrongly skipped
    bool has_lit = false;             ///< a lit colour of its own
    std::vector<std::string> layers;  ///< layers of the first frame
    std::vector<std::string> notes;   ///< sentences for the user that name the frames
};

/// Reads and checks all frames of a shot (gbuffer_checks.h). All must agree with the first frame in size, depth format,
/// projection and the presence of a lit colour. Previous cameras and depths must be those of the frame before. Fails
/// with Error that names the file.
CaptureContents inspect_capture(const Shot& shot, Capture& capture);

/// The reference file of a frame: the last run of # in the config's text stands for the frame number, with leading
/// zeros. If a file has these signs in its own name, it serves all frames: a folder "take#2" means no number.
std::filesystem::path capture_reference_file(const ShotConfig& config, unsigned frame);

/// Reads the reference of a frame. Fails with Error if its size differs from the frame's, if it lacks a needed truth
/// ladder, or if it shows another camera: first hits must lie at the G-buffer's depths, except for a few pixels at
/// edges.
Reference read_capture_reference(const Shot& shot, Capture& capture, unsigned frame, bool needs_ladder);
