#pragma once
#include "experiments/run/run.h"
#include "groundtruth/reference/reference.h"

#include <filesystem>
#include <string>
#include <vector>

/// The commands of `ssrlab`, as main.cpp parses them. Each throws Error for mistakes and MachineError for faults.

struct CommonOptions {
    std::vector<std::filesystem::path> scene_path;
    std::string device;           ///< "": the default one
    std::filesystem::path cache;  ///< "": the default folder
};

/// One frame of one camera.
struct ShotOptions {
    std::string scene, camera;
    std::string planes = "camera";  ///< or "scene": derive_planes()
    std::vector<unsigned> size{480, 270};
    unsigned frame = 0;
    std::string animation;  ///< "": the scene's

    bool has_planes_of_scene() const { return planes == "scene"; }
};

/// A study, by its config. Fails with Error where it is none, where it is `ssrlab tune`'s, and where its tables name
/// what results do not have.
struct Config config_of_study(const std::filesystem::path& file);
std::filesystem::path default_results(const std::filesystem::path& config);

struct RunOptions {
    std::filesystem::path config, out;
    bool keep_all = false, replaces = false, prunes = false, takes_times_here = false, takes_times_again = false;
    bool has_no_report = false;
    double report_after = RunSettings{}.report_after;
    std::vector<std::string> cells;  ///< as CellSelection takes them; empty: all
};
void run_study_command(const RunOptions& options, const CommonOptions& common);

struct PlanOptions {
    std::filesystem::path config, out;
    std::filesystem::path json;      ///< file that gets all cells with their estimates; "": none
    std::vector<std::string> cells;  ///< as CellSelection takes them; empty: all
    bool has_list = false, keep_all = false;
};
void plan_command(const PlanOptions& options, const CommonOptions& common);

struct MergeOptions {
    std::filesystem::path config, out;
    std::vector<std::filesystem::path> folders;
    bool keep_all = false, replaces = false;
};
int merge_command(const MergeOptions& options, const CommonOptions& common);  ///< 1 if cells are missing, else 0

struct NewOptions {
    std::filesystem::path folder;      ///< that is to be made
    std::string from = "mcguire_dda";  ///< a technique's name, or its folder
};
/// Writes a technique's folder and a first study of it, and says how to run that.
void new_command(const NewOptions& options);

/// Writes a folder's report.html again and says where it is.
void report_command(const std::filesystem::path& folder, bool links_images);

/// The commands that are Python scripts, which parse the arguments. Each returns the exit code: 0, 2 or 3.
int figures_command(const std::vector<std::string>& arguments);
int tables_command(const std::vector<std::string>& arguments);

struct DiffOptions {
    std::filesystem::path before, after, csv, page;
    bool judges_times = false, shows_all = false;
    double margin = 0;  ///< 0: that of the new study
};
int diff_command(const DiffOptions& options);  ///< the exit code: 0, or 1 if a number changed

struct JudgeOptions {
    std::filesystem::path frames, against, capture, reference, out = "results/judge";  ///< "": none
    std::string scene;                                                                 ///< "": by the views' names
    unsigned samples = 256;
    double margin = 0;  ///< 0: PrimaryComparisons'
    bool fails_if_worse = false;
};
int judge_command(const JudgeOptions& options, const CommonOptions& common);  ///< the exit code: 0, or 1 if worse

struct SceneForOptions {
    std::string engine, scene;
    std::string animation;             ///< "": the scene's
    std::vector<std::string> cameras;  ///< empty: the scene's first
    std::vector<unsigned> size{480, 270};
    std::vector<std::string> frames{"0"};                                    ///< each one's number, or "0-63"
    unsigned samples = ReferenceSettings::default_samples, lit_samples = 0;  ///< of the light, as a study has them
    bool has_ladder = false;
    std::string fallback = "environment";  ///< or "probe"
    std::filesystem::path out;
};
void scene_for_command(const SceneForOptions& options, const CommonOptions& common);

struct TradeoffOptions {
    std::filesystem::path results, out;
    std::string baseline, metric, mask, target, cost;                   ///< empty: the study's own, and time
    std::vector<double> times{5, 10, 20, 40}, factors{0.5, 0.25, 0.1};  ///< ms or counts; of the baseline's error
    std::vector<std::string> left_out;                                  ///< scenes or shots
    double margin = 0;                                                  ///< 0: the study's own
};
int tradeoff_command(const TradeoffOptions& options);  ///< the exit code: 0, 2 or 3

/// Answers what scripts ask for, a JSON object a line, until its input ends (python/ssrlab/statistics.py).
void statistics_command();

struct TuneOptions {
    std::filesystem::path config, out;
};
/// `run_options`: as the command line of `ssrlab run` takes them, for every study of the search. Returns the exit code.
int tune_command(const TuneOptions& options, const std::vector<std::string>& run_options);

struct CompareCommandOptions {
    std::filesystem::path reference, test, map;
    std::string layer;
    std::vector<std::string> metrics;
    bool as_json = false, fail_on_non_finite = false;
    float exposure_ev = 0.0f, map_max = 1.0f;
    std::string tone_map = "none";
};
void compare_images_command(const CompareCommandOptions& options);

struct ReferenceCommandOptions {
    ShotOptions shot;
    ReferenceSettings settings;
    std::filesystem::path out;
};
void reference_command(const ReferenceCommandOptions& options, const CommonOptions& common);

struct GBufferCommandOptions {
    ShotOptions shot;
    std::vector<unsigned> frames;  ///< first and last, each into a folder of its own; empty: shot.frame alone
    std::filesystem::path out;
    std::string depth_format = "d32f";
    bool is_reversed = false;
};
void gbuffer_command(const GBufferCommandOptions& options, const CommonOptions& common);

struct CaptureCommandOptions {
    std::filesystem::path folder;
};
void capture_command(const CaptureCommandOptions& options);

struct InspectOptions {
    std::string file;               ///< or a folder, or a scene's name
    bool has_all = false;           ///< lists are not cut
    std::filesystem::path json;     ///< "-": in place of the page; "": none
    std::filesystem::path picture;  ///< a PNG of the first view; "": none
};
/// Prints what is understood of a file or folder of anybody's (experiments/inspect/describe.h).
void inspect_command(const InspectOptions& options, const CommonOptions& common);

struct ShadersOptions {
    std::string variant, preset;
    nlohmann::json parameters = nlohmann::json::object();
    std::vector<std::string> chips;  ///< names that radv has for them
    std::string against;             ///< another preset, or a results folder; "": nothing
    ShotOptions shot;
    bool leaves_out = false;              ///< what the scene does not need
    std::filesystem::path assembly, csv;  ///< a folder, and a file; "": none
};
void shaders_command(const ShadersOptions& options, const CommonOptions& common);

struct NeedsOptions {
    ShotOptions shot;
    unsigned frames = 1;                ///< of the shot, from shot.frame on
    std::vector<std::string> variants;  ///< empty: all
    bool is_measured = false;
    unsigned timed_frames = 15;
    std::filesystem::path csv;  ///< "": none
};
/// The exit code: 0, or 1 if skipped work changed an image by more than stated.
int needs_command(const NeedsOptions& options, const CommonOptions& common);

struct RaysOptions {
    std::vector<std::string> scenes;  ///< names, of which `room:*` stands for `count` from `first` on
    unsigned count = 100, first = 0;
    std::vector<unsigned> size{160, 90};
};
/// Prints where mirror rays end, of each scene's first camera in frame 0, as rows of Markdown: one for each scene, of
/// `room:*` quantiles over scenes.
void rays_command(const RaysOptions& options, const CommonOptions& common);

struct RecordOptions {
    ShotOptions shot{.size = {192, 108}};         ///< its frame is not looked at
    std::string variant, preset, frames = "0-7";  ///< a frame, or a range with both ends
    nlohmann::json parameters = nlohmann::json::object();
    unsigned samples = 256;
    bool is_packed = false, has_results = false, has_passes = false;
    std::filesystem::path out;
};
/// Writes a page that does a technique's passes again in WebGL 2 (experiments/record/record.h).
void record_command(const RecordOptions& options, const CommonOptions& common);

struct WatchOptions {
    std::filesystem::path folder, out;
    std::vector<std::string> scenes;
    std::string against, camera, preset, frames = "0";  ///< a frame, or a range with both ends
    std::vector<unsigned> size{480, 270};
    unsigned samples = 256, seeds = 0;  ///< seeds 0: as studies have them
    double patience = 30;
};
/// Until Ctrl-C. `run_options`: as of tune_command().
void watch_command(const WatchOptions& options, const std::vector<std::string>& run_options);

struct StabilityOptions {
    std::vector<std::string> variants, cases;  ///< empty: all
    bool has_all_stages = false, is_of_precision = false;
    std::filesystem::path table, out, figure;  ///< table "": ssrlab's own; figure "": none
};
int precision_command(const StabilityOptions& options, const CommonOptions& common);  ///< of its --precision: 0
int stability_command(const StabilityOptions& options, const CommonOptions& common);  ///< the exit code: 0, 2 or 3
/// The figure of a stability.csv: PDF, PNG or SVG by its name. The exit code: 0, 2 or 3.
int stability_figure(const std::filesystem::path& csv, const std::filesystem::path& figure);

struct DescribeOptions {
    std::string variant;  ///< "": all
    bool as_schema = false;
    std::filesystem::path document;  ///< whose tables of config keys are made anew; "": none
};
void describe_command(const DescribeOptions& options);

void list_command(const std::string& what, const CommonOptions& common);
