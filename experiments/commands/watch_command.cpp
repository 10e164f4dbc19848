// ssrlab watch: a technique's folder, rendered and judged on every save.
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/frame_numbers.h"
#include "experiments/watch/watch_session.h"

#include <csignal>
#include <cstdio>

namespace {

volatile std::sig_atomic_t is_ended = 0;

/// While it lives, Ctrl-C and SIGTERM set is_ended.
class EndingSignals {
public:
    EndingSignals() {
        struct sigaction end {};
        end.sa_handler = [](int) { is_ended = 1; };
        for (size_t i = 0; i < 2; ++i) sigaction(signals[i], &end, &before_[i]);
    }
    ~EndingSignals() {
        for (size_t i = 0; i < 2; ++i) sigaction(signals[i], &before_[i], nullptr);
    }
    EndingSignals(const EndingSignals&) = delete;
    EndingSignals& operator=(const EndingSignals&) = delete;

private:
    static constexpr int signals[] = {SIGINT, SIGTERM};
    struct sigaction before_[2];
};

}  // namespace

void watch_command(const WatchOptions& options, const std::vector<std::string>& run_options) {
    constexpr size_t most_frames = 1000;
    const std::filesystem::path folder =
        std::filesystem::weakly_canonical(std::filesystem::absolute(options.folder));  // "my_ssr/", ".", a link
    const EndingSignals signals;
    WatchSession session(
        {.folder = folder,
         .preset = options.preset,
         .scenes = options.scenes,
         .camera = options.camera,
         .extent = {options.size[0], options.size[1]},
         .frames = frame_numbers({&options.frames, 1}, most_frames, "a watch"),
         .against = options.against,
         .samples = options.samples,
         .seeds = options.seeds,
         .patience = options.patience,
         .out = options.out.empty() ? std::filesystem::path("results/watch") / folder.filename() : options.out,
         .run_options = run_options});
    session.run([] { return is_ended != 0; },
                [](const std::string& text) {
                    std::printf("%s\n", shown_text(text).c_str());
                    std::fflush(stdout);
                });
}
