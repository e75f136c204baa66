#include "base/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>

#include "base/alarm.h"
#include "base/file_handle.h"
#include "base/screen.h"

namespace trunnion::inline base {
namespace {

[[noreturn]] void refuse_out() {
    throw InputError("standard output cannot be written: " + system_reason(errno));
}

/// Opens the null device in the opposite mode, so that any use of this descriptor fails as if it
/// were closed.
void occupy(int descriptor, int flags) {
    if (::fcntl(descriptor, F_GETFD) != -1) return;
    const int null = ::open("/dev/null", flags);
    if (null < 0 || null == descriptor) return;
    ::dup2(null, descriptor);
    ::close(null);
}

}  // namespace

void write_out(std::string_view text) {
    static const std::optional<Screen> screen = screen_of(STDOUT_FILENO);
    const std::string shown = screen ? for_screen(text, *screen) : std::string();
    if (screen) text = shown;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) refuse_out();
}

void finish_out() {
    std::fflush(stdout);  // where it fails, the stream has an error
    if (std::ferror(stdout) != 0) refuse_out();
}

void write_error(std::string_view text) noexcept {
    static const std::optional<Screen> screen = screen_of(STDERR_FILENO);
    write_all(STDERR_FILENO, screen ? for_screen(text, *screen) : text);
}

void prepare_streams() {
    occupy(STDIN_FILENO, O_WRONLY);
    occupy(STDOUT_FILENO, O_RDONLY);
    occupy(STDERR_FILENO, O_RDONLY);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace trunnion::inline base
