// Long work: a progress line on a terminal, and Ctrl-C for an orderly end.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace trunnion::cli {

/// While it exists, the first Ctrl-C (or SIGTERM, SIGHUP) only sets `asked`; the second one ends
/// the program as usual. Only one object at a time.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    static bool asked();

  private:
    void (*before_[3])(int);  ///< previous handlers of the three signals
};

/// One line on stderr, overwritten repeatedly and erased at the end. Nothing with --quiet or if
/// stderr is not a terminal, and no counts during the first half second.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `text` is called only when it is time to show it.
    void show(const std::function<std::string()>& text);
    /// "30 of 200 repetitions, 12 a second, 14 s left"; the rate counts from construction.
    void count(std::uint64_t done, std::uint64_t total, const char* things);
    /// The same for work with rare progress reports: shown at once.
    void stage(const std::string& text);
    /// "step 3 of 4: second run, 0.5 a second, 2 s left": what begins after `done` steps.
    void step(int done, int total, const char* what);

    /// "search among models, 3 s so far": work whose number of steps nobody knows beforehand.
    void lasting(const std::string& text);

  private:
    using Clock = std::chrono::steady_clock;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point begin_, next_;
};

}  // namespace trunnion::cli
