#include "base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <set>
#include <utility>

#include "base/alarm.h"
#include "base/file_handle.h"
#include "base/sha256.h"

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
