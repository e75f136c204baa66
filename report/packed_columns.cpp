#include "report/packed_columns.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace trunnion::report {
namespace {

void append_varint(std::string& out, std::uint64_t value) {
    for (; value >= 128; value >>= 7) out += static_cast<char>(128 | (value & 127));
    out += static_cast<char>(value);
}

std::uint64_t zigzag(std::int64_t value) {
    return value < 0 ? 2 * static_cast<std::uint64_t>(-(value + 1)) + 1
                     : 2 * static_cast<std::uint64_t>(value);
}

std::int64_t second_difference(const PackedColumn& column, std::size_t i) {
    const auto at = [&](std::size_t back) { return i < back ? 0 : column.number[i - back]; };
    return at(0) - 2 * at(1) + at(2);
}

void append_column(std::string& out, const PackedColumn& column, const PackedColumn* like) {
    for (std::size_t i = 0; i < column.number.size(); ++i)
        append_varint(out, zigzag(second_difference(column, i) -
                                  (like ? column.sign * second_difference(*like, i) : 0)));
}

/// How far the second differences of the first points are from those of `like`.
std::uint64_t distance(const PackedColumn& column, const PackedColumn* like, int sign) {
    constexpr std::size_t looked_at = 20'000;
    std::uint64_t sum = 0;
    for (std::size_t i = 2; i < std::min(looked_at, column.number.size()); ++i)
        sum +=
            zigzag(second_difference(column, i) - (like ? sign * second_difference(*like, i) : 0));
    return sum;
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(size, '\0');
    const int result = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()),
                                 static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != Z_OK) throw std::logic_error("zlib refused a buffer of sufficient size");
    out.resize(size);
    return out;
}

std::string base64(const std::string& bytes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three =
                three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return out;
}

}  // namespace

void find_likes(std::vector<PackedColumn>& columns) {
    for (std::size_t k = 1; k < columns.size(); ++k) {
        std::uint64_t least = distance(columns[k], nullptr, 1);
        for (std::size_t b = 0; b < k; ++b)
            for (const int sign : {1, -1}) {
                if (columns[b].step != columns[k].step) continue;
                const std::uint64_t size = distance(columns[k], &columns[b], sign);
                if (size >= least) continue;
                least = size;
                columns[k].like = static_cast<int>(b);
                columns[k].sign = sign;
            }
    }
}

std::string packed_base64(const std::vector<PackedColumn>& columns) {
    std::string bytes;
    for (const PackedColumn& column : columns)
        append_column(bytes, column,
                      column.like < 0 ? nullptr : &columns[static_cast<std::size_t>(column.like)]);
    return base64(deflated(bytes));
}

}  // namespace trunnion::report
