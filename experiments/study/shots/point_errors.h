#pragma once
#include "experiments/study/measuring/frame_means.h"
#include "experiments/study/measuring/lit_noise.h"
#include "experiments/study/measuring/splits.h"
#include "experiments/study/shots/point_in_shot.h"
#include "metrics/flicker.h"
#include "metrics/frame_difference.h"
#include "metrics/ghost_share.h"
#include "metrics/video_jod.h"

#include <set>

/// One seed's errors while its frames are rendered.
struct SeedErrors {
    unsigned seed = 0;
    std::vector<ResultRow> frame_rows = {};
    FrameMeans means = {};
    FlickerMoments held = {};
    FrameDifference difference = {};
    GhostShare ghosts = {};
    std::optional<VideoJod> video = {};
    std::vector<HostImage> after_change = {};
    HostImage before = {};  ///< `specular` of the previous frame
};

/// The errors of a point in a shot, over all of its seeds.
class PointErrors {
public:
    /// `lit_noise`: what the noise of the lit colour adds to these errors.
    PointErrors(const PointInShot& point, LitNoiseOfErrors lit_noise)
        : point_(point), lit_noise_(std::move(lit_noise)) {}

    /// Adds one rendered frame, in the order of the shot's steps.
    void add(SeedErrors& seed, const FrameStep& step, const CompositedImages& images);
    /// Adds errors that need all frames of a seed.
    void add_whole(SeedErrors& seed);
    /// Moves everything into the cell once all seeds are complete: rows, splits, the reference's noise, and notes about
    /// missing values.
    void move_to(Cell& cell);

private:
    void measure_last(const FrameTruth& truth, const CompositedImages& images, const ResultRow& row,
                      std::span<const Mask> masks);
    void keep_growth(std::vector<ResultRow>& rows, const std::string& frame);
    void measure_in_passing(SeedErrors& seed, const PoseTruth& truth, const HostImage& specular,
                            std::span<const Mask> masks, const ResultRow& row);
    void keep_noise(const SeedErrors& seed);
    void add_to_video(SeedErrors& seed, const FrameStep& step, const HostImage& specular) const;
    void add_temporal_rows(unsigned seed, const std::vector<TemporalScore>& scores,
                           const std::string& target = "specular");
    std::vector<SplitRow> rows_of_splits() const;
    std::vector<std::string> notes() const;
    bool is_in_full_measure(const ResultRow& row) const;

    const PointInShot& point_;
    LitNoiseOfErrors lit_noise_;
    std::vector<ResultRow> rows_;
    std::map<std::string, SeedSplit> splits_;  ///< of the last frame, by target
    SumsOfErrors noise_;
    /// Masks under which a temporal metric has no value, by its name and the reason.
    std::map<std::pair<std::string, std::string>, std::set<std::string>> missing_;
};
