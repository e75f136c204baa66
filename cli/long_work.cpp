#include "cli/long_work.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "base/console.h"
#include "cli/notes.h"

namespace trunnion::cli {
namespace {

/// The only object accessible to a signal handler.
volatile std::sig_atomic_t interruption_asked = 0;

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};

void ask_once(int signal) {
    interruption_asked = 1;
    std::signal(signal, SIG_DFL);
}

/// Without a total (0) the remaining time is unknown.
std::string pace_text(std::uint64_t done, std::uint64_t total, const char* things,
                      double passed_s) {
    const double rate_per_s = double(done) / passed_s;
    const std::string count =
        total > 0 ? fmt::format("{} of {}", done, total) : fmt::format("{}", done);
    std::string text = fmt::format("{} {}, {:.3g} a second", count, things, rate_per_s);
    if (total > done && done > 0)
        text += fmt::format(", {:.0f} s left", double(total - done) / rate_per_s);
    return text;
}

constexpr const char* wipe_line = "\r\033[K";

}  // namespace

Interruption::Interruption() {
    interruption_asked = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        before_[i] = std::signal(signals[i], ask_once);
        // If the parent ignores Ctrl-C or the end of its terminal (nohup, a background job), it
        // remains ignored.
        if (before_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);
    }
}

Interruption::~Interruption() {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], before_[i]);
}

bool Interruption::asked() {
    return interruption_asked != 0;
}

Progress::Progress()
    : terminal_(::isatty(STDERR_FILENO) == 1 && talk() != Talk::quiet),
      begin_(Clock::now()),
      next_(begin_ + std::chrono::milliseconds(500)) {}

Progress::~Progress() {
    if (shown_) write_error(wipe_line);
}

void Progress::show(const std::function<std::string()>& text) {
    if (!terminal_) return;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    stage(text());
}

void Progress::count(std::uint64_t done, std::uint64_t total, const char* things) {
    show([&] {
        const std::chrono::duration<double> passed = Clock::now() - begin_;
        return pace_text(done, total, things, passed.count());
    });
}

void Progress::step(int done, int total, const char* what) {
    const std::chrono::duration<double> passed = Clock::now() - begin_;
    std::string text = fmt::format("step {} of {}: {}", done + 1, total, what);
    if (done > 0)
        text += fmt::format(", {:.2g} a second, {:.0f} s left", done / passed.count(),
                            (total - done) * passed.count() / done);
    stage(text);
}

void Progress::lasting(const std::string& text) {
    show([&] {
        const std::chrono::duration<double> passed = Clock::now() - begin_;
        return fmt::format("{}, {:.0f} s so far", text, passed.count());
    });
}

void Progress::stage(const std::string& text) {
    if (!terminal_) return;
    shown_ = true;
    print_error("{}{}", wipe_line, text);
    std::fflush(stderr);
}

}  // namespace trunnion::cli
