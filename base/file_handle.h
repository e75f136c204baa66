// A file descriptor that closes itself, and reading and writing that do not stop half-way.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace trunnion::inline base {

/// Owns one descriptor of the operating system; -1 owns none.
class FileHandle {
  public:
    FileHandle() = default;
    explicit FileHandle(int descriptor) : descriptor_(descriptor) {}
    FileHandle(FileHandle&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileHandle& operator=(FileHandle&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    FileHandle(const FileHandle&) = delete;
    FileHandle& operator=(const FileHandle&) = delete;
    ~FileHandle();

    int descriptor() const { return descriptor_; }
    bool is_open() const { return descriptor_ >= 0; }
    /// False when the system reports that earlier writes failed; the reason is in errno.
    bool close();

  private:
    int descriptor_ = -1;
};

/// Writes all of `text`. False: it failed, the reason is in errno. Signals do not disturb it.
bool write_all(int descriptor, std::string_view text);
/// Reads at most `size` bytes, less only at the end of the file. -1: it failed, see errno.
std::ptrdiff_t read_some(int descriptor, char* data, std::size_t size);
/// The system's words for the value of errno.
std::string system_reason(int error);

}  // namespace trunnion::inline base
