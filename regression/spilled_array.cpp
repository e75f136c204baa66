#include "regression/spilled_array.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

namespace trunnion {

namespace {

int open_temporary() {
    const char* const folder = std::getenv("TMPDIR");
    std::string path = folder != nullptr && *folder != '\0' ? folder : "/tmp";
    path += "/trunnion_XXXXXX";
    const int file = ::mkstemp(path.data());
    if (file < 0) throw std::runtime_error("no room for a temporary file: " + path);
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
        if (written <= 0) throw std::runtime_error("cannot write a temporary file: disk full?");
        from += written;
        size_ += static_cast<std::uint64_t>(written);
        bytes -= static_cast<std::size_t>(written);
    }
}

void TemporaryFile::read(void* data, std::size_t bytes, std::uint64_t at) const {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t got = ::pread(file_, to, bytes, static_cast<off_t>(at));
        if (got <= 0) throw std::runtime_error("cannot read a temporary file");
        to += got;
        at += static_cast<std::uint64_t>(got);
        bytes -= static_cast<std::size_t>(got);
    }
}

}  // namespace trunnion
