#include "cli/long_work.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>

namespace trunnion {
namespace {

/// The one thing that a signal handler can reach.
volatile std::sig_atomic_t interruption_asked = 0;

void ask_once(int signal) {
    interruption_asked = 1;
    std::signal(signal, SIG_DFL);
}

constexpr const char* wipe_line = "\r\033[K";

}  // namespace

Interruption::Interruption()
    : interrupt_before_(std::signal(SIGINT, ask_once)),
      terminate_before_(std::signal(SIGTERM, ask_once)) {
    interruption_asked = 0;
    // A parent that ignores Ctrl-C (nohup, a background job) wants it ignored here as well.
    if (interrupt_before_ == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

Interruption::~Interruption() {
    std::signal(SIGINT, interrupt_before_);
    std::signal(SIGTERM, terminate_before_);
}

bool Interruption::asked() {
    return interruption_asked != 0;
}

Progress::Progress()
    : terminal_(::isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + std::chrono::milliseconds(500)) {}

Progress::~Progress() {
    if (shown_) fmt::print(stderr, "{}", wipe_line);
}

void Progress::show(const std::function<std::string()>& text) {
    if (!terminal_) return;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    stage(text());
}

void Progress::stage(const std::string& text) {
    if (!terminal_) return;
    shown_ = true;
    fmt::print(stderr, "{}{}", wipe_line, text);
    std::fflush(stderr);
}

}  // namespace trunnion
