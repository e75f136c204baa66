#include "base/read_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <set>
#include <utility>

#include "base/alarm.h"
#include "base/file_handle.h"
#include "base/sha256.h"
#include "base/waiting.h"

namespace trunnion::inline base {
namespace {

/// What the living ReadRecord holds.
struct Noted {
    std::mutex mutex;
    bool alive = false;
    std::set<std::pair<std::string, std::string>> files;  ///< path, hash
};

Noted& noted() {
    static Noted one;
    return one;
}

std::string with_note(const std::string& path, std::string text) {
    Noted& n = noted();
    std::unique_lock lock(n.mutex);
    if (!n.alive) return text;
    lock.unlock();
    std::string hash = sha256(text);
    lock.lock();
    n.files.emplace(path, std::move(hash));
    return text;
}

constexpr std::size_t most_streamed = std::size_t{1} << 30;  ///< from what has no end of its own

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

/// What is read, and how it is waited for.
struct Source {
    int file;
    const std::string& path;
    bool polled = false;      ///< a read of this descriptor may block
    bool named_pipe = false;  ///< without a writer it reads as if it had ended
    bool limited = false;     ///< silence is no reason to wait for long
};

/// An anonymous pipe whose writers are gone has ended; a named one may wait for its first.
bool is_named_pipe(int file, const struct stat& state) {
    struct statfs system {};
    return S_ISFIFO(state.st_mode) && ::fstatfs(file, &system) == 0 &&
           system.f_type != PIPEFS_MAGIC;
}

bool is_standard_input(const struct stat& state) {
    struct stat in {};
    return ::fstat(STDIN_FILENO, &in) == 0 && in.st_dev == state.st_dev &&
           in.st_ino == state.st_ino;
}

/// True at the end of a source that just gave nothing.
bool has_ended(const Source& source, bool at_start) {
    if (!at_start || !source.named_pipe) return true;
    const int events = events_now(source.file, POLLIN);
    return (events & POLLHUP) != 0 && (events & POLLIN) == 0;  // a writer came and went
}

[[noreturn]] void refuse_silence(const Source& source, bool nobody_writes, const Wait& wait) {
    const char* const what = nobody_writes ? "cannot be read: nobody writes to this pipe ("
                                           : "cannot be read: it gives neither data nor an end (";
    refuse(source.path, what + wait.reason() + ")");
}

/// Reads at least one byte; 0 at the end.
std::size_t read_next(const Source& source, char* data, std::size_t size, bool at_start) {
    constexpr std::size_t most_at_once = std::size_t{1} << 30;
    for (Wait wait;;) {
        while (source.polled && events_now(source.file, POLLIN) == 0)
            if (!wait.step(source.file, POLLIN, source.limited))
                refuse_silence(source, false, wait);
        const ssize_t got = ::read(source.file, data, std::min(size, most_at_once));
        if (got > 0) return static_cast<std::size_t>(got);
        if (got == 0 && has_ended(source, at_start)) return 0;
        if (got < 0 && errno == EINTR) continue;
        if (got < 0 && errno != EAGAIN) refuse_with_reason(source.path);
        const bool nobody = got == 0;
        if (!wait.step(source.file, POLLIN, nobody || source.limited))
            refuse_silence(source, nobody, wait);
    }
}

/// Reads to the end. `expected`: the size of a file.
std::string read_to_end(const Source& source, std::size_t expected) {
    std::string text(expected + 1, '\0');
    for (std::size_t size = 0;;) {
        if (size == text.size()) text.resize(size + (1 << 16));
        const std::size_t got =
            read_next(source, text.data() + size, text.size() - size, size == 0);
        size += got;
        if (got == 0) {
            text.resize(size);
            return text;
        }
        if (size > most_streamed && size > expected) refuse(source.path, "gives more than 1 GiB");
    }
}

std::string read_open(int file, const std::string& path) {
    const struct stat before = state_of(file, path);
    if (S_ISDIR(before.st_mode)) refuse(path, "is a folder, not a file");
    const bool sized = S_ISREG(before.st_mode) && before.st_size > 0;
    const bool flows = S_ISFIFO(before.st_mode) || S_ISSOCK(before.st_mode);
    Source source{file, path};
    source.polled = file == STDIN_FILENO && !S_ISREG(before.st_mode);
    source.named_pipe = is_named_pipe(file, before);
    source.limited = !flows && !is_standard_input(before);
    std::string text = read_to_end(source, sized ? static_cast<std::size_t>(before.st_size) : 0);
    if (sized && !same_state(before, state_of(file, path)))
        refuse(path, "changed while it was read: start again when it is complete");
    return text;
}

/// Opens without waiting for a pipe's writer. A file that another program has on lease (a file
/// server) is waited for.
FileHandle open_to_read(const std::string& path) {
    for (Wait wait;;) {
        FileHandle file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
        if (file.is_open()) return file;
        struct stat state {};
        if (errno == ENXIO && ::stat(path.c_str(), &state) == 0 && S_ISSOCK(state.st_mode))
            refuse(path, "is a socket, not a file");
        if (errno != EAGAIN) refuse_with_reason(path);
        if (!wait.step(-1, 0, true))
            refuse(path, "cannot be read: another program holds it (" + wait.reason() + ")");
    }
}

}  // namespace

std::string read_file(const std::string& path) {
    const FileHandle file = open_to_read(path);
    return with_note(path, read_open(file.descriptor(), path));
}

std::string read_file_or_input(const std::string& path) {
    constexpr const char* input = "standard input";
    return path == "-" ? with_note(input, read_open(STDIN_FILENO, input)) : read_file(path);
}

ReadRecord::ReadRecord() {
    const std::lock_guard lock(noted().mutex);
    noted().alive = true;
    noted().files.clear();
}

ReadRecord::~ReadRecord() {
    const std::lock_guard lock(noted().mutex);
    noted().alive = false;
}

std::vector<FileRead> ReadRecord::files() {
    const std::lock_guard lock(noted().mutex);
    std::vector<FileRead> list;
    if (noted().alive)
        for (const auto& [path, hash] : noted().files) list.push_back({path, hash});
    return list;
}

}  // namespace trunnion::inline base
