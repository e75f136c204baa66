#include "report/packed_columns.h"

#include <zlib.h>

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

void append_column(std::string& out, const PackedColumn& column) {
    std::int64_t before = 0, slope = 0;
    for (const std::int64_t number : column.number) {
        const std::int64_t step = number - before;
        append_varint(out, zigzag(step - slope));
        slope = step;
        before = number;
    }
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                  Z_BEST_COMPRESSION) != Z_OK)
        throw std::logic_error("zlib refused a buffer of sufficient size");
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

std::string packed_base64(const std::vector<PackedColumn>& columns) {
    std::string bytes;
    for (const PackedColumn& column : columns) append_column(bytes, column);
    return base64(deflated(bytes));
}

}  // namespace trunnion::report
