// Standard streams of a process of its own: open, closed, full.
#include "base/console.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "base/alarm.h"
#include "base/read_file.h"

using namespace trunnion;
namespace fs = std::filesystem;

namespace {

/// Runs `child` in a process whose standard output is `out` (-1: closed); its exit code.
int in_child(int out, const std::function<int()>& child) {
    std::fflush(stdout);
    const pid_t id = ::fork();
    if (id == 0) {
        ::close(STDOUT_FILENO);
        if (out >= 0) ::dup2(out, STDOUT_FILENO);
        ::_exit(child());
    }
    int state = 0;
    ::waitpid(id, &state, 0);
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

/// 0: written, 1: refused.
int written(const std::string& text) {
    try {
        print_out("{}", text);
        finish_out();
    } catch (const InputError&) {
        return 1;
    }
    return 0;
}

}  // namespace

TEST_CASE("what is printed arrives, and what cannot be written is an error") {
    const std::string path = fs::temp_directory_path() / ("o" + std::to_string(::getpid()));
    const int file = ::open(path.c_str(), O_CREAT | O_RDWR | O_TRUNC, 0600);
    REQUIRE(file >= 0);
    const std::string text(100000, 'x');
    CHECK(in_child(file, [&] { return written(text); }) == 0);
    CHECK(read_file(path) == text);
    const int full = ::open("/dev/full", O_WRONLY);
    REQUIRE(full >= 0);
    CHECK(in_child(full, [&] { return written("x"); }) == 1);
    CHECK(in_child(full, [&] { return written(text); }) == 1);
    ::close(full);
    ::close(file);
    fs::remove(path);
}

TEST_CASE("a closed stream is not taken by the next file that is opened") {
    const auto descriptor = [](bool prepared) {
        return in_child(-1, [prepared] {
            if (prepared) prepare_streams();
            return ::open("/dev/null", O_RDWR);
        });
    };
    CHECK(descriptor(false) == STDOUT_FILENO);
    CHECK(descriptor(true) > STDERR_FILENO);
    CHECK(in_child(-1, [] {
              prepare_streams();
              return written("x");
          }) == 1);
    // Both input and output: each has a stream that fails.
    CHECK(in_child(-1, [] {
              ::close(STDIN_FILENO);
              prepare_streams();
              char byte = 0;
              return ::read(STDIN_FILENO, &byte, 1) < 0 ? written("x") : 2;
          }) == 1);
}
