// Work that takes long: a line of progress on a terminal, and Ctrl-C that ends it in order.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace trunnion::cli {

/// While it lives, the first Ctrl-C (or SIGTERM, SIGHUP) only sets `asked`; the second ends the
/// program as usual. One at a time.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    static bool asked();

  private:
    void (*before_[3])(int);  ///< handlers of the three signals
};

/// One line on stderr, written over and over and wiped at the end; nothing with --quiet or where
/// stderr is no terminal, and no counts in the first half second.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `text` is asked for only when it is time to show it.
    void show(const std::function<std::string()>& text);
    /// "30 of 200 repetitions, 12 a second, 14 s left"; the rate counts from the construction.
    void count(std::uint64_t done, std::uint64_t total, const char* things);
    /// The same for work that tells seldom where it is: shown at once.
    void stage(const std::string& text);

  private:
    using Clock = std::chrono::steady_clock;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point begin_, next_;
};

}  // namespace trunnion::cli
