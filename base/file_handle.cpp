#include "base/file_handle.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace trunnion::inline base {

FileHandle::~FileHandle() {
    close();
}

bool FileHandle::close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor < 0 || ::close(descriptor) == 0;
}

bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = EIO;
        if (written <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::ptrdiff_t read_some(int descriptor, char* data, std::size_t size) {
    constexpr std::size_t most_at_once = std::size_t{1} << 30;
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::read(descriptor, data + done, std::min(size - done, most_at_once));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return static_cast<std::ptrdiff_t>(done);
}

std::string system_reason(int error) {
    return std::generic_category().message(error);
}

}  // namespace trunnion::inline base
