#include "base/file_handle.h"

#include <unistd.h>

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

std::string system_reason(int error) {
    return std::generic_category().message(error);
}

}  // namespace trunnion::inline base
