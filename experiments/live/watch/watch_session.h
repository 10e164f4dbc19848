#pragma once
#include "experiments/live/watch/kept_versions.h"
#include "experiments/live/watch/page_images.h"
#include "experiments/live/watch/watch_job.h"
#include "experiments/live/watch/watch_lock.h"
#include "experiments/live/watch/watched_files.h"

#include <functional>
#include <future>
#include <optional>
#include <vector>

/// Renders and judges a technique after every save, and serves the page that shows it.
class WatchSession {
public:
    /// Fails with Error if the folder is not a technique's, if what it is compared with does not exist, or if
    /// WatchSettings::out is that of another watch.
    explicit WatchSession(const WatchSettings& settings);
    ~WatchSession();
    WatchSession(const WatchSession&) = delete;
    WatchSession& operator=(const WatchSession&) = delete;

    /// Runs until `is_over` returns true. `say` gets sentences for the user. Fails with Error if a scene cannot be path
    /// traced.
    void run(const std::function<bool()>& is_over, const std::function<void(const std::string&)>& say);

private:
    using Clock = std::chrono::system_clock;

    std::string ask(const std::string& what, const nlohmann::json& value);  ///< called by a thread of the server

    // What there is to do, in the order of run().
    void answer_requests();
    std::string answer(const std::string& what, const nlohmann::json& value);
    std::string ask_to_keep();
    bool is_measured() const;
    void keep_when_measured();
    void keep();
    std::string set_values(const nlohmann::json& values);
    void begin(Clock::time_point since);
    void look_for_picture();
    void follow_truth();
    void follow_job();
    void finish_job();
    std::optional<JobKind> next_job() const;
    void start_job(JobKind kind);
    void refuse(const std::string& error);
    void give_up(const std::string& error);

    // What studies are made of.
    WatchedPoint point() const;
    std::vector<WatchedPoint> compared() const;
    bool has_truth() const { return truths_ > 0; }

    void publish();
    nlohmann::json news() const;

    const WatchSettings settings_;
    const WatchLock lock_;
    const std::filesystem::path copy_;  ///< copy of the folder, which is rendered
    const std::optional<WatchedPoint> against_;
    KeptVersions versions_;
    WatchedFiles files_;

    nlohmann::json values_ = nlohmann::json::object();  ///< parameter values from the page's sliders
    nlohmann::json parameters_ = nlohmann::json::array();
    bool is_valid_ = false;       ///< whether the copy declares a technique
    bool is_to_be_kept_ = false;  ///< the present state, once it is measured
    std::string keep_note_;       ///< why it was not kept

    // How far the present state of the technique is.
    unsigned state_ = 0;  ///< number of saves and changes of values so far
    Clock::time_point since_, measured_;
    size_t scenes_ = 0;  ///< scenes measured with the full truth
    bool is_coarse_done_ = false, is_why_done_ = false, are_times_done_ = false, is_kept_done_ = true,
         has_picture_ = false;
    std::unique_ptr<WatchJob> job_;

    std::unique_ptr<WatchJob> truth_job_;
    size_t truths_ = 0;  ///< scenes with a truth
    Clock::time_point opened_;

    /// What the page shows.
    nlohmann::json problem_, result_, picture_, why_, times_, seconds_ = nlohmann::json::object();
    bool has_news_ = true;

    struct Request {
        std::string what;
        nlohmann::json value;
        std::promise<std::string> answer;
    };
    std::mutex mutex_;  ///< guards the members below
    bool is_closed_ = false;
    std::vector<std::unique_ptr<Request>> requests_;

    PageImages images_;
    WatchServer server_;  ///< declared last: it uses the others
};
