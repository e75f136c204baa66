// Long arrays of plain data on disk: memory is limited to a window, independent of the path length.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <list>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace trunnion::regression {

/// Bytes in an unnamed temporary file ($TMPDIR, else /tmp), removed when the process ends. Throws
/// InputError with the reason when the disk is full.
class TemporaryFile {
  public:
    TemporaryFile() = default;
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&& other) noexcept;
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    void append(const void* data, std::size_t bytes);
    void read(void* data, std::size_t bytes, std::uint64_t at) const;

  private:
    int file_ = -1;
    std::uint64_t size_ = 0;
};

/// An append-only array; data beyond 4 MB are written to a temporary file.
template <typename T>
class SpilledArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    static constexpr std::size_t chunk = 65536 / sizeof(T);
    static constexpr std::size_t kept_in_memory = 64 * chunk;

    void append(const T& item) {
        if (tail_.size() >= kept_in_memory) spill();
        tail_.push_back(item);
    }
    std::uint64_t size() const { return on_disk_ + tail_.size(); }
    /// Reads chunk number `index` (the last one may be shorter).
    void read_chunk(std::uint64_t index, std::vector<T>& items) const {
        const std::uint64_t first = index * chunk;
        const std::uint64_t count =
            first >= size() ? 0 : std::min<std::uint64_t>(chunk, size() - first);
        items.resize(count);
        if (count == 0) return;
        if (first >= on_disk_)
            std::copy_n(tail_.begin() + static_cast<std::ptrdiff_t>(first - on_disk_), count,
                        items.begin());
        else
            file_.read(items.data(), count * sizeof(T), first * sizeof(T));
    }

  private:
    /// Writes whole chunks, so that no chunk is partly on disk.
    void spill() {
        file_.append(tail_.data(), tail_.size() * sizeof(T));
        on_disk_ += tail_.size();
        tail_.clear();
    }

    std::vector<T> tail_;  ///< items not on disk
    std::uint64_t on_disk_ = 0;
    TemporaryFile file_;
};

/// Random access to a SpilledArray through the most recently used chunks. A reference stays valid
/// while fewer than `chunks_kept` - 1 other chunks are read.
template <typename T>
class SpilledWindow {
  public:
    static constexpr std::size_t chunks_kept = 64;  ///< 4 MB

    explicit SpilledWindow(const SpilledArray<T>& array) : array_(&array) {}

    std::uint64_t size() const { return array_->size(); }
    const T& operator[](std::uint64_t index) {
        const std::uint64_t wanted = index / SpilledArray<T>::chunk;
        if (wanted != current_) load(wanted);
        return (*items_)[index % SpilledArray<T>::chunk];
    }

  private:
    struct Chunk {
        std::uint64_t index = 0;
        std::vector<T> items;
    };
    void load(std::uint64_t wanted) {
        const auto known = by_index_.find(wanted);
        if (known != by_index_.end()) {
            chunks_.splice(chunks_.begin(), chunks_, known->second);
        } else {
            if (chunks_.size() < chunks_kept)
                chunks_.emplace_front();
            else {
                by_index_.erase(chunks_.back().index);
                chunks_.splice(chunks_.begin(), chunks_, std::prev(chunks_.end()));
            }
            chunks_.front().index = wanted;
            array_->read_chunk(wanted, chunks_.front().items);
            by_index_[wanted] = chunks_.begin();
        }
        current_ = wanted;
        items_ = &chunks_.front().items;
    }

    const SpilledArray<T>* array_;
    std::list<Chunk> chunks_;  ///< most recently used first
    std::unordered_map<std::uint64_t, typename std::list<Chunk>::iterator> by_index_;
    std::uint64_t current_ = std::numeric_limits<std::uint64_t>::max();
    const std::vector<T>* items_ = nullptr;
};

}  // namespace trunnion::regression
