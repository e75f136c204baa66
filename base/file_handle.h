// A file descriptor that closes itself, and complete writes.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace trunnion::inline base {

/// Owns one file descriptor; -1: none.
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
    /// False when the system reports a failure of earlier writes; the reason is in errno.
    bool close();

  private:
    int descriptor_ = -1;
};

/// Writes all of `text`, also when interrupted by signals. False on failure; the reason is in
/// errno.
bool write_all(int descriptor, std::string_view text);
/// The system's message for a value of errno.
std::string system_reason(int error);

}  // namespace trunnion::inline base
