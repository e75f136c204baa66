#include "interpreter/block_cache.h"

namespace trunnion::interpreter {
namespace {

std::uint64_t key_of(int file, std::uint64_t byte) {
    return static_cast<std::uint64_t>(file) << 44 | byte;
}

}  // namespace

std::size_t BlockCache::slot(std::uint64_t key) const {
    std::size_t at = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 48);
    static_assert(table_size == 1u << 16);
    while (table_[at].block >= 0 && table_[at].key != key) at = (at + 1) % table_size;
    return at;
}

int BlockCache::find(int file, std::uint64_t byte) const {
    return table_.empty() ? -1 : table_[slot(key_of(file, byte))].block;
}

int BlockCache::add(int file, const Block& block) {
    if (table_.empty()) table_.resize(table_size);
    const std::uint64_t key = key_of(file, block.byte);
    const int index = static_cast<int>(blocks.size());
    blocks.push_back(block);
    table_[slot(key)] = {key, index};
    return index;
}

bool BlockCache::full() const {
    return blocks.size() >= most_blocks || code.bytes() >= most_code_bytes;
}

void BlockCache::clear() {
    table_.clear();
    blocks.clear();
    links.clear();
    code.clear();
}

void BlockCache::connect(int open_end, int block) {
    if (open_end >= 0) blocks[static_cast<std::size_t>(open_end)].next = block;
    if (open_end < -1) links[static_cast<std::size_t>(-2 - open_end)].block = block;
}

}  // namespace trunnion::interpreter
