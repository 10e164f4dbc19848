#include "experiments/live/watch/watch_session.h"

#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "core/path_inside.h"
#include "core/shown_text.h"
#include "experiments/live/watch/error_places.h"
#include "experiments/live/watch/fresh_images.h"
#include "experiments/live/watch/page_numbers.h"
#include "experiments/live/watch/page_parameters.h"
#include "experiments/report/page_template.h"
#include "variants/registry.h"

#include <algorithm>
#include <thread>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr auto turn = 30ms;                // between looks at files, requests and jobs
constexpr auto pause_before_why = 1000ms;  // who goes on typing has no use for it
constexpr auto wait_for_truth = 3000ms;    // in the beginning: on a quiet machine it comes from the cache by then

double seconds_between(std::chrono::system_clock::time_point a, std::chrono::system_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

/// When the folder was saved last; now, if it is gone.
std::chrono::system_clock::time_point saved_at(const fs::path& folder) {
    std::optional<std::chrono::system_clock::time_point> newest;
    for (const fs::path& file : technique_files(folder))
        if (const auto time = written_at(path_inside(folder, file.string())); time && (!newest || *time > *newest))
            newest = time;
    const auto now = std::chrono::system_clock::now();
    return newest && *newest < now && seconds_between(*newest, now) < 2 ? *newest : now;
}

std::string names_of_shaders(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::path& file : technique_files(folder))
        if (file.extension() == ".comp" || file.extension() == ".frag") names.push_back(file.string());
    return joined(names);
}

/// The page with its script and style, by the names that it asks for.
std::map<std::string, WatchReply> page_files() {
    return {{"", {"text/html; charset=utf-8", template_file("watch.html")}},
            {"watch.js", {"text/javascript; charset=utf-8", built_file("watch.js")}},
            {"watch.css", {"text/css; charset=utf-8", built_file("watch.css")}}};
}

}  // namespace

WatchSession::WatchSession(const WatchSettings& settings)
    : settings_(with_absolute_paths(settings)),
      lock_(settings_.out),
      copy_(path_inside(settings_.out, std::string(watch_folder::technique) + "/" + settings_.name())),
      against_(settings.against.empty() ? std::nullopt : std::optional(point_against(settings.against))),
      versions_(settings_),
      files_(settings_.folder),
      since_(Clock::now()),
      opened_(Clock::now()),
      server_({.files = page_files(),
               .image = [this](const std::string& name) { return images_.find(name); },
               .take = [this](const std::string& what, const json& value) { return ask(what, value); }}) {}

/// Nobody waits for an answer any more, so that the server can end.
WatchSession::~WatchSession() {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    for (const std::unique_ptr<Request>& request : requests_) request->answer.set_value("ssrlab ends");
}

std::string WatchSession::ask(const std::string& what, const json& value) {
    std::future<std::string> answer;
    {
        const std::lock_guard lock(mutex_);
        if (is_closed_) return "ssrlab ends";
        requests_.push_back(std::make_unique<Request>(Request{.what = what, .value = value, .answer = {}}));
        answer = requests_.back()->answer.get_future();
    }
    return answer.get();
}

void WatchSession::run(const std::function<bool()>& is_over, const std::function<void(const std::string&)>& say) {
    say(settings_.name() + " is watched; open this page (its address is secret):");
    say("  " + server_.address());
    begin(since_);
    while (!is_over()) {
        if (files_.have_changed()) begin(Clock::now());
        answer_requests();
        follow_truth();
        follow_job();
        keep_when_measured();
        if (std::exchange(has_news_, false)) publish();
        std::this_thread::sleep_for(turn);
    }
}

void WatchSession::answer_requests() {
    std::vector<std::unique_ptr<Request>> requests;
    {
        const std::lock_guard lock(mutex_);
        requests.swap(requests_);
    }
    for (const std::unique_ptr<Request>& request : requests) {
        std::string refusal;
        try {
            refusal = answer(request->what, request->value);
        } catch (const std::exception& e) {
            refusal = e.what();
        }
        request->answer.set_value(shown_text(refusal));
        has_news_ = true;
    }
}

std::string WatchSession::answer(const std::string& what, const json& value) {
    if (what == "keep") return ask_to_keep();
    if (what == "values") return set_values(value);
    return "the page asked for '" + what + "', which ssrlab does not know";
}

bool WatchSession::is_measured() const {
    return !result_.is_null() && result_["state"] == state_ && !result_["is_coarse"].get<bool>();
}

/// Kept at once, or when it is measured.
std::string WatchSession::ask_to_keep() {
    if (!is_valid_) return "this version has an error; a version can be kept once it renders";
    keep_note_.clear();
    if (is_measured())
        keep();
    else
        is_to_be_kept_ = true;
    return "";
}

void WatchSession::keep_when_measured() {
    if (!is_to_be_kept_ || !is_measured()) return;
    try {
        keep();
    } catch (const std::exception& e) {
        keep_note_ = shown_text(e.what());
        has_news_ = true;
    }
}

/// The present state, which is measured.
void WatchSession::keep() {
    is_to_be_kept_ = false;
    job_.reset();  // it writes where the numbers are copied from
    json numbers = result_;
    for (json& shot : numbers["shots"]) shot.erase("images"), shot.erase("others");
    versions_.keep(settings_.preset, values_, numbers);
    is_kept_done_ = false;
    begin(Clock::now());  // against this version from now on
}

std::string WatchSession::set_values(const json& values) {
    if (!values.is_object()) return "the page sent no values of parameters";
    if (values == values_) return "";
    if (is_valid_) make_technique(settings_.name(), values, settings_.preset);  // says what is wrong with one
    values_ = values;
    begin(Clock::now());
    return "";
}

/// What was rendered of an earlier state is of no interest any more.
void WatchSession::begin(Clock::time_point since) {
    job_.reset();
    keep_note_ = is_to_be_kept_ ? "The last version was not kept: it was changed before its errors were measured." : "";
    is_to_be_kept_ = false;
    ++state_;
    since_ = since;
    scenes_ = 0, is_coarse_done_ = is_why_done_ = are_times_done_ = has_picture_ = false;
    seconds_ = json::object();
    has_news_ = true;
    try {
        is_valid_ = false;
        since_ = std::min(since, saved_at(settings_.folder));
        copy_technique(settings_.folder, copy_);
        add_technique_folder(copy_);
        parameters_ = page_parameters(settings_.name(), settings_.preset, values_);
        is_valid_ = true;
    } catch (const MachineError&) {
        throw;
    } catch (const std::exception& e) {
        refuse(e.what());
    }
}

void WatchSession::refuse(const std::string& error) {
    problem_ = error_with_places(error, copy_, settings_.folder);
    has_news_ = true;
}

/// What the job was for is not tried again before the next save; without numbers all that follows them has no meaning.
void WatchSession::give_up(const std::string& error) {
    refuse(error);
    if (job_->kind == JobKind::why)
        is_why_done_ = true;
    else if (job_->kind == JobKind::times)
        are_times_done_ = true;
    else if (job_->kind == JobKind::kept)
        is_kept_done_ = true;
    else
        is_valid_ = false;
    if (!is_valid_ && std::exchange(is_to_be_kept_, false))
        keep_note_ = "This version was not kept: its errors could not be measured.";
}

WatchedPoint WatchSession::point() const {
    return {.technique = std::string("./") + watch_folder::technique + "/" + settings_.name(),
            .preset = settings_.preset,
            .label = settings_.name(),
            .parameters = values_,
            .is_baseline = false};
}

/// The last version that was kept, and what the command names.
std::vector<WatchedPoint> WatchSession::compared() const {
    std::vector<WatchedPoint> points;
    if (!versions_.all().empty()) points.push_back(versions_.all().back().point());
    if (against_) points.push_back(*against_);
    return points;
}

/// The truth of one scene after the other, beside everything else: a save must not stop it.
void WatchSession::follow_truth() {
    if (truth_job_) {
        const WatchJob::State state = truth_job_->state();
        if (state == WatchJob::State::running) return;
        if (state == WatchJob::State::failed) fail(settings_.scenes[truths_], ": ", truth_job_->error());
        truth_job_.reset();
        if (truths_++ == 0 && job_ && job_->kind == JobKind::coarse) job_.reset();
        has_news_ = true;
    }
    if (truths_ < settings_.scenes.size())
        truth_job_ = std::make_unique<WatchJob>(JobKind::truth, settings_,
                                                numbers_study(settings_, {}, truths_ + 1, settings_.samples, false));
}

void WatchSession::follow_job() {
    if (job_) {
        look_for_picture();
        switch (job_->state()) {
            case WatchJob::State::running:
                return;
            case WatchJob::State::hanging:
                give_up(settings_.folder.string() + ": rendering made no progress for " +
                        std::to_string(std::lround(settings_.patience)) + " s and was stopped; a loop in a shader (" +
                        names_of_shaders(copy_) + ") may have no end; --patience waits longer");
                break;
            case WatchJob::State::failed:
                give_up(job_->error());
                break;
            case WatchJob::State::done:
                finish_job();
        }
        job_.reset();
        has_news_ = true;
    }
    if (const auto kind = next_job()) start_job(*kind);
}

std::optional<JobKind> WatchSession::next_job() const {
    if (!is_valid_) return {};
    if (scenes_ < truths_) return JobKind::now;
    if (!has_truth()) {
        const bool is_due = Clock::now() - opened_ > wait_for_truth && !is_coarse_done_;
        return is_due ? std::optional(JobKind::coarse) : std::nullopt;
    }
    const bool is_quiet = Clock::now() - measured_ > pause_before_why;
    if (!is_why_done_ && is_quiet) return JobKind::why;
    if (!are_times_done_ && is_quiet) return JobKind::times;
    if (!is_kept_done_ && truths_ == settings_.scenes.size()) return JobKind::kept;
    return {};
}

void WatchSession::start_job(JobKind kind) {
    std::vector<WatchedPoint> points = compared();
    points.push_back(point());
    json study;
    if (kind == JobKind::coarse) study = numbers_study(settings_, points, 1, coarse_samples, false);
    if (kind == JobKind::now) study = numbers_study(settings_, points, scenes_ + 1, settings_.samples, false);
    if (kind == JobKind::why) study = why_study(settings_, point());
    if (kind == JobKind::times) study = times_study(settings_, points);
    if (kind == JobKind::kept) {
        points.clear();
        for (const KeptVersion& version : versions_.all()) points.push_back(version.point());
        if (against_) points.push_back(*against_);
        study = numbers_study(settings_, points, settings_.scenes.size(), settings_.samples, true);
    }
    // Without what earlier saves left: a day of saves would fill a disk.
    const bool is_last = kind == JobKind::why || kind == JobKind::times ||
                         (kind == JobKind::now && scenes_ + 1 == settings_.scenes.size());
    job_ = std::make_unique<WatchJob>(kind, settings_, study, is_last);
    if (!seconds_.contains("began")) seconds_["began"] = seconds_between(since_, Clock::now());
    has_news_ = true;
}

/// The results of a seed lie there before its errors are measured.
void WatchSession::look_for_picture() {
    if (has_picture_ || (job_->kind != JobKind::now && job_->kind != JobKind::coarse)) return;
    try {
        auto found = fresh_images(job_->results, settings_.name(), job_->started);
        if (found["now"].size() < 2) return;
        json images = json::object();
        for (const auto& [label, targets] : found)
            for (const auto& [target, exr] : targets) images[label][target] = images_.add(exr);
        picture_ = {{"state", state_}, {"images", images}};
    } catch (const Error&) {
        return;  // it is being written; the next look finds it
    }
    has_picture_ = true;
    problem_ = nullptr;
    seconds_["picture"] = seconds_between(since_, Clock::now());
    has_news_ = true;
}

void WatchSession::finish_job() {
    const JobKind kind = job_->kind;
    try {
        if (kind == JobKind::kept) {
            is_kept_done_ = true;
        } else if (kind == JobKind::why) {
            why_ = page_why(job_->results, point(), images_);
            why_["state"] = state_;
            is_why_done_ = true;
        } else if (kind == JobKind::times) {
            times_ = page_times(job_->results, point(), compared());
            times_["state"] = state_;
            are_times_done_ = true;
        } else {
            result_ = page_numbers(job_->results, point(), compared(), images_);
            result_["state"] = state_, result_["is_coarse"] = kind == JobKind::coarse;
            result_["samples"] = kind == JobKind::coarse ? coarse_samples : settings_.samples;
            if (kind == JobKind::coarse) is_coarse_done_ = true;
            if (kind == JobKind::now && scenes_++ == 0) seconds_["number"] = seconds_between(since_, Clock::now());
            problem_ = nullptr, has_picture_ = true;
            measured_ = Clock::now();
        }
    } catch (const MachineError&) {
        throw;
    } catch (const Error& e) {
        give_up(e.what());
    }
}

void WatchSession::publish() { server_.publish(news()); }

json WatchSession::news() const {
    const auto doing = [&]() -> std::string {
        if (!job_) return is_valid_ && !has_truth() ? "waiting for the truth" : "";
        const std::string texts[] = {"",  // in the order of JobKind
                                     "rendering, with a coarse truth",
                                     "rendering " + settings_.scenes[std::min(scenes_, settings_.scenes.size() - 1)],
                                     "finding out why pixels are wrong",
                                     "timing, and estimating a GPU's time",
                                     "measuring kept versions"};
        return texts[size_t(job_->kind)];
    };
    json kept = json::array();
    for (const KeptVersion& v : versions_.all())
        kept.push_back({{"name", v.name},
                        {"at", v.at},
                        {"parameters", v.parameters},
                        {"shots", v.numbers.value("shots", json::array())}});
    return {{"technique", settings_.name()},
            {"folder", settings_.folder.string()},
            {"out", settings_.out.string()},
            {"scenes", settings_.scenes},
            {"samples", settings_.samples},
            {"truths", truths_},
            {"state", state_},
            {"doing", doing()},
            {"problem", problem_},
            {"result", result_},
            {"picture", picture_},
            {"why", why_},
            {"times", times_},
            {"parameters", parameters_},
            {"values", values_},
            {"kept", kept},
            {"is_kept_done", is_kept_done_},
            {"is_to_be_kept", is_to_be_kept_},
            {"keep_note", keep_note_},
            {"size", std::to_string(settings_.extent.x) + "x" + std::to_string(settings_.extent.y)},
            {"seconds", seconds_}};
}
