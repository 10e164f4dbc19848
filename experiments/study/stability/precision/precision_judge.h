#pragma once
#include "experiments/study/measuring/rays/exact_rays.h"
#include "experiments/study/stability/precision/precision.h"

/// A case as drawn, whose scene is asked where rays truly end.
class PrecisionShot {
public:
    explicit PrecisionShot(CaseFrames frames);

    const CaseFrames& frames() const { return frames_; }
    /// Share of the rays of the last frame that end elsewhere than they do in the scene, by JudgedHits' rules: a wrong
    /// place, a false hit, or a miss of what is shown. None without rays.
    std::optional<double> wrong_share(const RecordedRays& recorded) const;

private:
    CaseFrames frames_;
    ExactRays exact_;
};

/// One technique in one case: each image in other formats, each stage in double.
class PrecisionJudge {
public:
    PrecisionJudge(Device& device, const PrecisionShot& shot, PointConfig point)
        : device_(device), shot_(shot), point_(std::move(point)) {}

    std::vector<PrecisionRow> rows();

private:
    /// An image that passes write.
    struct Written {
        std::string image, stages;
        Format format{};  ///< the technique's own
    };
    static std::vector<Written> written_of(const PrecisionRun& run);

    std::optional<PrecisionRun> run(const PrecisionWish& wish, PrecisionRow& row);
    void add(PrecisionRow row) { rows_.push_back(std::move(row)); }
    PrecisionRow changed(PrecisionRow row, const PrecisionRun& run) const;
    void judge_format(const Written& what, PrecisionKind kind);
    void judge_formats(const std::vector<Written>& written, const PrecisionRun& own);
    void judge_inputs();
    void judge_stage(const std::string& stage);
    void judge_rays(const std::string& stage, const PrecisionRun& run);
    void judge_march(const std::string& stage, const RecordedRays& rays);

    Device& device_;
    const PrecisionShot& shot_;
    PointConfig point_;
    PrecisionRun floats_;  ///< all in float
    double error_ = 0;     ///< of it
    std::vector<PrecisionRow> rows_;
};
