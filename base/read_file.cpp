#include "base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "base/alarm.h"
#include "base/file_handle.h"

namespace trunnion::inline base {
namespace {

constexpr std::size_t most_streamed = std::size_t{1} << 30;  ///< limit for pipes and devices, which
                                                             ///< have no end of their own

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
    throw InputError(message, {path, 0, 0});
}

[[noreturn]] void refuse_with_reason(const std::string& path) {
    refuse(path, "cannot be read: " + system_reason(errno));
}

struct stat state_of(int file, const std::string& path) {
    struct stat state {};
    if (::fstat(file, &state) != 0) refuse_with_reason(path);
    return state;
}

bool same_state(const struct stat& a, const struct stat& b) {
    return a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
           a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

/// Reads to the end of the file. `expected`: its size.
std::string read_to_end(int file, std::size_t expected, const std::string& path) {
    std::string text;
    for (std::size_t size = 0, room = expected + 1;; room = size + (1 << 16)) {
        text.resize(room);
        const std::ptrdiff_t got = read_some(file, text.data() + size, room - size);
        if (got < 0) refuse_with_reason(path);
        size += static_cast<std::size_t>(got);
        if (size < room) {
            text.resize(size);
            return text;
        }
        if (size > most_streamed && size > expected) refuse(path, "gives more than 1 GiB");
    }
}

std::string read_open(int file, const std::string& path) {
    const struct stat before = state_of(file, path);
    if (S_ISDIR(before.st_mode)) refuse(path, "is a folder, not a file");
    const bool sized = S_ISREG(before.st_mode) && before.st_size > 0;
    std::string text =
        read_to_end(file, sized ? static_cast<std::size_t>(before.st_size) : 0, path);
    if (sized && !same_state(before, state_of(file, path)))
        refuse(path, "changed while it was read: start again when it is complete");
    return text;
}

}  // namespace

std::string read_file(const std::string& path) {
    const FileHandle file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
    if (!file.is_open()) refuse_with_reason(path);
    return read_open(file.descriptor(), path);
}

std::string read_file_or_input(const std::string& path) {
    return path == "-" ? read_open(STDIN_FILENO, "standard input") : read_file(path);
}

}  // namespace trunnion::inline base
