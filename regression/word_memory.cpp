#include "regression/word_memory.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "regression/hash_mix.h"

namespace trunnion::regression {

namespace {

/// Modal groups whose repetition has no effect. Codes are G * 10.
struct ModalCode {
    int code, group;
};
constexpr int motion = 1, plane = 2, distance = 3, feed_mode = 5, units = 6, cutter = 7,
              cycle_return = 10, speed_mode = 13, path_mode = 15;
constexpr std::array<ModalCode, 25> modal_codes{
    {{0, motion},      {10, motion},        {20, motion},        {30, motion},
     {170, plane},     {180, plane},        {190, plane},        {900, distance},
     {910, distance},  {930, feed_mode},    {940, feed_mode},    {950, feed_mode},
     {200, units},     {210, units},        {400, cutter},       {410, cutter},
     {420, cutter},    {980, cycle_return}, {990, cycle_return}, {640, path_mode},
     {610, path_mode}, {620, path_mode},    {630, path_mode},    {960, speed_mode},
     {970, speed_mode}}};

int group_of(int code) {
    for (const ModalCode& m : modal_codes)
        if (m.code == code) return m.group;
    return 0;
}

/// Other groups whose codes may be in any order within a block: G49, G80, G54-G59.
int order_group_of(int code) {
    constexpr int length = 20, cycle = 21, work = 22;
    if (code == 490) return length;
    if (code == 800) return cycle;
    return code >= 540 && code <= 590 && code % 10 == 0 ? work : 0;
}

std::uint64_t bits_of(double value) {
    const double plain = value + 0.0;  // -0 is 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &plain, sizeof bits);
    return bits;
}

/// Letters whose meaning changes without decimal point (parameter 3401#0).
bool point_counts(char letter) {
    return std::strchr("XYZABCUVWIJKRQrc", letter) != nullptr;
}
bool is_position(char letter) {
    return std::strchr("XYZABC", letter) != nullptr;
}
int g_code(const interpreter::Item& item) {
    return static_cast<int>(std::lround(item.value * 10.0));
}

/// M codes that neither move axes nor change the interpretation of positions.
bool plain_m(double value) {
    return (value >= 3.0 && value <= 9.0 && value != 6.0) || value == 0.0 || value == 1.0;
}

bool is_known(std::optional<std::uint64_t>& known, std::uint64_t value, bool allowed) {
    const bool same = allowed && known == value;
    known = allowed ? std::optional(value) : std::nullopt;
    return same;
}

std::uint64_t key_of_value(const interpreter::Item& item) {
    const bool no_point = !item.decimal_point && item.value != 0.0 && point_counts(item.letter);
    return mix(bits_of(item.value), no_point ? 1 : 0);
}

}  // namespace

/// Properties of a block's words that the memory needs first.
struct WordMemory::BlockLook {
    bool other_g = false;       ///< a G code outside the table: it may use any word itself
    bool order_counts = false;  ///< two codes of a group, or a repeated letter: the last one counts
    bool calls = false;         ///< G65-G67, M98, M99, M198: the state afterwards is unknown
    bool plain = true;          ///< only words of straight moves, F, S, T and common M codes
};

namespace {

WordMemory::BlockLook look_at(const interpreter::Item* items, std::size_t count) {
    WordMemory::BlockLook look;
    std::uint32_t letters = 0, groups = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const interpreter::Item& item = items[k];
        if (item.letter == 'G') {
            const int code = g_code(item), group = group_of(code);
            // Codes of no known group count as one group (bit 0).
            const std::uint32_t bit = 1U << (group > 0 ? group : order_group_of(code));
            if ((groups & bit) != 0) look.order_counts = true;
            groups |= bit;
            look.other_g = look.other_g || group == 0;
            look.calls = look.calls || (code >= 650 && code < 680);
        } else if (item.letter == 'M') {
            look.calls =
                look.calls || item.value == 98.0 || item.value == 99.0 || item.value == 198.0;
            look.plain = look.plain && plain_m(item.value);
        } else if (item.letter < 'A' || item.letter > 'Z') {
            look.plain = false;
        } else {
            const std::uint32_t bit = 1U << (item.letter - 'A');
            if ((letters & bit) != 0) look.order_counts = true;
            letters |= bit;
            look.plain = look.plain && std::strchr("XYZABCFST", item.letter) != nullptr;
        }
    }
    look.plain = look.plain && !look.other_g;
    return look;
}

}  // namespace

WordMemory::WordMemory() {
    group_[cutter] = 400;
    group_[feed_mode] = 940;
    group_[speed_mode] = 970;
}

void WordMemory::forget() {
    group_.fill(std::nullopt);
    forget_values();
    modal_call_ = true;
}

std::optional<std::uint64_t> WordMemory::key_of(const interpreter::Item* items, std::size_t count) {
    words_.clear();
    const BlockLook look = look_at(items, count);
    if (look.calls) forget();
    if (!look.plain) position_.fill(std::nullopt);
    if (look.other_g) feed_ = speed_ = std::nullopt;
    for (std::size_t k = 0; k < count; ++k)
        if (items[k].letter == 'G') take_g(items[k], look);
    for (std::size_t k = 0; k < count; ++k)
        if (items[k].letter != 'G') take(items[k], look);
    if (look.calls) forget();
    if (words_.empty()) return std::nullopt;
    return hash(look, items, count);
}

void WordMemory::forget_values() {
    position_.fill(std::nullopt);
    feed_ = speed_ = std::nullopt;
}

void WordMemory::take_g(const interpreter::Item& item, const BlockLook& look) {
    const int code = g_code(item), group = group_of(code);
    if (group == 0) {
        group_[motion].reset();  // a cycle replaces the motion group
        if (code == 160) modal_call_ = true;
        if (code >= 682 && code <= 684) forget();  // no other block is allowed between their blocks
    } else {
        auto& known = group_[static_cast<std::size_t>(group)];
        const bool repeats = known == code && !look.order_counts && group != cutter;
        const bool no_offset = known == code && code == 400;
        if (repeats || no_offset) return;
        known = code;
        if (group != motion && group != path_mode && group != cycle_return) forget_values();
    }
    words_.push_back({'G', bits_of(item.value)});
}

void WordMemory::take(const interpreter::Item& item, const BlockLook& look) {
    const std::uint64_t value = key_of_value(item);
    if (!look.order_counts && repeats(item.letter, value, look)) return;
    words_.push_back({item.letter, value});
}

bool WordMemory::repeats(char letter, std::uint64_t value, const BlockLook& look) {
    if (look.other_g) return false;
    if (letter == 'F') return is_known(feed_, value, per_minute());
    if (letter == 'S') return is_known(speed_, value, group_[speed_mode] == 970);
    if (!is_position(letter)) return false;
    auto& known = position_[static_cast<std::size_t>(letter - 'A')];
    return is_known(known, value, look.plain && absolute_straight());
}

bool WordMemory::per_minute() const {
    return group_[feed_mode] == 940 || group_[feed_mode] == 950;
}

bool WordMemory::absolute_straight() const {
    return !modal_call_ && group_[distance] == 900 && group_[cutter] == 400 && per_minute() &&
           (group_[motion] == 0 || group_[motion] == 10);
}

/// M codes act in written order; other words are sorted, unless one is repeated.
std::uint64_t WordMemory::hash(const BlockLook& look, const interpreter::Item* items,
                               std::size_t count) {
    std::uint64_t h = 7;
    if (look.order_counts) {
        for (std::size_t k = 0; k < count; ++k)
            h = mix(mix(h, static_cast<std::uint64_t>(items[k].letter)), key_of_value(items[k]));
        return h;
    }
    const auto before = [](const Word& p, const Word& q) {
        return p.letter != q.letter ? p.letter < q.letter : p.letter != 'M' && p.value < q.value;
    };
    std::stable_sort(words_.begin(), words_.end(), before);
    for (const Word& word : words_)
        h = mix(mix(h, static_cast<std::uint64_t>(word.letter)), word.value);
    return h;
}

}  // namespace trunnion::regression
