// Segments on disk: a path of any length costs a window of memory, not its length.
#pragma once

#include <cstdint>
#include <cstdio>
#include <deque>
#include <memory>
#include <vector>

#include "regression/segment.h"

namespace trunnion {

/// An append-only array of segments in an unnamed temporary file ($TMPDIR or /tmp); the first
/// `kept_in_memory` of them never reach the disk.
class SegmentFile {
  public:
    static constexpr std::size_t chunk = 2048;
    static constexpr std::size_t kept_in_memory = 32 * chunk;

    void append(const Segment& segment);
    std::uint64_t size() const { return size_; }
    /// Reads chunk number `index` (the last one may be short).
    std::vector<Segment> read_chunk(std::uint64_t index) const;
    /// Only segments not yet written can be reached; used to extend the last one.
    Segment* last();

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void spill();

    std::vector<Segment> tail_;  ///< what is not on disk, in memory
    std::uint64_t on_disk_ = 0;
    std::uint64_t size_ = 0;
    std::unique_ptr<std::FILE, Closer> file_;
};

/// A forward-moving window on a SegmentFile: random access from `drop_before` on.
class SegmentWindow {
  public:
    explicit SegmentWindow(const SegmentFile& file) : file_(&file) {}

    const Segment& operator[](std::uint64_t index);
    void drop_before(std::uint64_t index);
    std::uint64_t size() const { return file_->size(); }

  private:
    const SegmentFile* file_;
    std::uint64_t first_chunk_ = 0;
    std::deque<std::vector<Segment>> chunks_;
};

}  // namespace trunnion
