#include "regression/spilled_array.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <utility>

#include "base/alarm.h"
#include "base/file_handle.h"

namespace trunnion::regression {

namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw InputError(what + ": " + system_reason(errno));
}

int open_temporary() {
    const char* const wanted = std::getenv("TMPDIR");
    const std::string folder = wanted != nullptr && *wanted != '\0' ? wanted : "/tmp";
    std::string path = folder + "/trunnion_XXXXXX";
    const int file = ::mkostemp(path.data(), O_CLOEXEC);
    if (file < 0) refuse("no temporary file can be made in " + folder + " ($TMPDIR)");
    ::unlink(path.c_str());
    return file;
}

}  // namespace

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)), size_(std::exchange(other.size_, 0)) {}

TemporaryFile& TemporaryFile::operator=(TemporaryFile&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(size_, other.size_);
    return *this;
}

TemporaryFile::~TemporaryFile() {
    if (file_ >= 0) ::close(file_);
}

void TemporaryFile::append(const void* data, std::size_t bytes) {
    if (file_ < 0) file_ = open_temporary();
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = ::pwrite(file_, from, bytes, static_cast<off_t>(size_));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) refuse("a temporary file cannot be written");
        from += written;
        size_ += static_cast<std::uint64_t>(written);
        bytes -= static_cast<std::size_t>(written);
    }
}

void TemporaryFile::read(void* data, std::size_t bytes, std::uint64_t at) const {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t got = ::pread(file_, to, bytes, static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) refuse("a temporary file cannot be read");
        to += got;
        at += static_cast<std::uint64_t>(got);
        bytes -= static_cast<std::size_t>(got);
    }
}

}  // namespace trunnion::regression
