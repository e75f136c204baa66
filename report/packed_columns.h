// Long columns of numbers in compact form for a page; web/src/data.js unpacks them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::report {

/// One column: the value of row i is number[i] * step. Rounding to whole steps is the only loss.
struct PackedColumn {
    std::string name;
    double step = 1.0;
    std::vector<std::int64_t> number;
};

/// Second differences, zigzag, 7 bits a byte (low bits first), column after column, deflated (zlib)
/// and encoded in base64. All columns have the same number of rows; numbers must be below 2^40.
/// Equal columns give equal text.
std::string packed_base64(const std::vector<PackedColumn>& columns);

}  // namespace trunnion::report
