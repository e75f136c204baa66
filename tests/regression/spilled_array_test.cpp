// Long arrays on disk: what was appended comes back, and a disk that takes nothing more is told.
#include "regression/spilled_array.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <string>

#include "base/alarm.h"

using namespace trunnion;

namespace {

using Numbers = regression::SpilledArray<std::uint64_t>;

/// TMPDIR for one test.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const char* folder) {
        if (const char* const set = std::getenv("TMPDIR")) before_ = set;
        folder != nullptr ? ::setenv("TMPDIR", folder, 1) : ::unsetenv("TMPDIR");
    }
    ~TemporaryFolder() {
        before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  private:
    std::string before_;
};

Numbers filled(std::uint64_t count) {
    Numbers numbers;
    for (std::uint64_t k = 0; k < count; ++k) numbers.append(k * k);
    return numbers;
}

/// A limit on the size of files, for one test; without it a signal would end the process.
class FileLimit {
  public:
    explicit FileLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, SIG_DFL);
    }
    FileLimit(const FileLimit&) = delete;
    FileLimit& operator=(const FileLimit&) = delete;

  private:
    rlimit before_{};
};

}  // namespace

TEST_CASE("what lies on disk is read as what lies in memory, wherever the folder is", "[spilled]") {
    const TemporaryFolder folder(GENERATE("/tmp", "", static_cast<const char*>(nullptr)));
    constexpr std::uint64_t count = 3 * Numbers::kept_in_memory / 2;
    Numbers numbers = filled(count);
    regression::SpilledWindow<std::uint64_t> window(numbers);
    for (std::uint64_t k = 0; k < count; k += 997) REQUIRE(window[k] == k * k);
    REQUIRE(window[count - 1] == (count - 1) * (count - 1));
    Numbers moved = std::move(numbers);
    CHECK(moved.size() == count);
    Numbers assigned;
    assigned = std::move(moved);
    regression::SpilledWindow<std::uint64_t> again(assigned);
    CHECK(again[0] == 0);
    CHECK(again[count - 1] == (count - 1) * (count - 1));
}

TEST_CASE("a folder that is not there, and a disk that is full, are errors with their reason",
          "[spilled]") {
    {
        const TemporaryFolder folder("/nowhere/at/all");
        CHECK_NOTHROW(filled(Numbers::kept_in_memory));
        CHECK_THROWS_WITH(filled(Numbers::kept_in_memory + 1),
                          Catch::Contains("/nowhere/at/all") && Catch::Contains("No such file"));
    }
    const FileLimit limit(Numbers::kept_in_memory * sizeof(std::uint64_t) / 2);
    CHECK_THROWS_WITH(filled(Numbers::kept_in_memory + 1), Catch::Contains("cannot be written"));
}

TEST_CASE("bytes that were never written cannot be read", "[spilled]") {
    regression::TemporaryFile file;
    file.append("abc", 3);
    std::string read(3, ' ');
    file.read(read.data(), 3, 0);
    CHECK(read == "abc");
    CHECK_THROWS_AS(file.read(read.data(), 3, 1), InputError);
}
