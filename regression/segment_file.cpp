#include "regression/segment_file.h"

#include <unistd.h>

#include <stdexcept>
#include <type_traits>

namespace trunnion {

static_assert(std::is_trivially_copyable_v<Segment>);

void SegmentFile::append(const Segment& segment) {
    if (tail_.size() >= kept_in_memory) spill();
    tail_.push_back(segment);
    ++size_;
}

Segment* SegmentFile::last() {
    return tail_.empty() ? nullptr : &tail_.back();
}

/// Writes all but the last segment's chunk, in whole chunks, so that chunk borders never move.
void SegmentFile::spill() {
    if (!file_) file_.reset(std::tmpfile());
    if (!file_) throw std::runtime_error("no room for a temporary file");
    const std::size_t whole = (tail_.size() - 1) / chunk * chunk;
    std::fseek(file_.get(), 0, SEEK_END);
    if (std::fwrite(tail_.data(), sizeof(Segment), whole, file_.get()) != whole ||
        std::fflush(file_.get()) != 0)
        throw std::runtime_error("cannot write a temporary file: disk full?");
    tail_.erase(tail_.begin(), tail_.begin() + static_cast<std::ptrdiff_t>(whole));
    on_disk_ += whole;
}

std::vector<Segment> SegmentFile::read_chunk(std::uint64_t index) const {
    const std::uint64_t first = index * chunk;
    if (first >= size_) return {};
    const std::uint64_t count = std::min<std::uint64_t>(chunk, size_ - first);
    if (first >= on_disk_) {
        const auto from = tail_.begin() + static_cast<std::ptrdiff_t>(first - on_disk_);
        return {from, from + static_cast<std::ptrdiff_t>(count)};
    }
    std::vector<Segment> segments(count);
    const auto bytes = static_cast<ssize_t>(count * sizeof(Segment));
    const auto place = static_cast<off_t>(first * sizeof(Segment));
    if (pread(fileno(file_.get()), segments.data(), static_cast<std::size_t>(bytes), place) !=
        bytes)
        throw std::runtime_error("cannot read a temporary file");
    return segments;
}

const Segment& SegmentWindow::operator[](std::uint64_t index) {
    const std::uint64_t wanted = index / SegmentFile::chunk;
    if (chunks_.empty() || wanted < first_chunk_) {
        chunks_.clear();
        first_chunk_ = wanted;
    }
    while (first_chunk_ + chunks_.size() <= wanted)
        chunks_.push_back(file_->read_chunk(first_chunk_ + chunks_.size()));
    return chunks_[wanted - first_chunk_][index % SegmentFile::chunk];
}

void SegmentWindow::drop_before(std::uint64_t index) {
    // One chunk stays behind the reader: comparisons look back a few segments.
    while (!chunks_.empty() && first_chunk_ + 1 < index / SegmentFile::chunk) {
        chunks_.pop_front();
        ++first_chunk_;
    }
}

}  // namespace trunnion
