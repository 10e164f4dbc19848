#pragma once
#include "experiments/study/measuring/rays/exact_rays.h"
#include "experiments/study/stability/precision/precision.h"

/// A drawn case whose scene answers where rays truly end.
class PrecisionShot {
public:
    explicit PrecisionShot(CaseFrames frames);

    const CaseFrames& frames() const { return frames_; }
    /// Share of the last frame's rays that end elsewhere than in the scene, by the rules of JudgedHits: a wrong place,
    /// a false hit, or a miss of a visible point. None without rays.
    std::optional<double> wrong_share(const RecordedRays& recorded) const;

private:
    CaseFrames frames_;
    ExactRays exact_;
};

/// Judges one technique in one case: each image in other formats, each stage in double.
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
    PrecisionRun floats_;  ///< the run with all in float
    double error_ = 0;     ///< error of `floats_`
    std::vector<PrecisionRow> rows_;
};
